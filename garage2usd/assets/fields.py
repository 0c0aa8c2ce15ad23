"""Periodic fields for textures: noise and shapes, and the patterns of floors and walls made of them.

Only sums, products, square roots and integers are used, since sines, exponentials and matrix products differ in the
last bit between CPUs.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
"""Periodic field of float64, shape (rows, columns), about 0 to 1."""
Shape = tuple[int, int]
_SLOPES = np.array(
    [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)]
)
_AROUND = [(down, across) for down in (-1, 0, 1) for across in (-1, 0, 1)]
_FINE = 1024


def noise(rng: np.random.Generator, shape: Shape, cells: Shape) -> Field:
    """Periodic value noise from a lattice of `cells` (down, across), 0 to 1."""
    lattice = rng.integers(0, 1024, size=cells).astype(np.float64) / 1023.0
    (top, bottom, down), (left, right, across) = (
        _lattice_places(side, count) for side, count in zip(shape, cells, strict=True)
    )
    rows = lattice[top] * (1 - down)[:, None] + lattice[bottom] * down[:, None]
    field: Field = rows[:, left] * (1 - across) + rows[:, right] * across
    return field


def _lattice_places(side: int, cells: int) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """For each pixel, the lattice points before and after it, and its fraction between them."""
    place = np.arange(side) * (cells / side)
    low = place.astype(np.int64)
    part = place - low
    return low, (low + 1) % cells, part * part * (3.0 - 2.0 * part)


def _gradient_noise(rng: np.random.Generator, shape: Shape, cells: Shape) -> Field:
    """Periodic gradient noise (Perlin 1985), with less visible lattice than value noise; 0 to 1, mostly near 0.5."""
    down_slope, across_slope = _SLOPES[rng.integers(len(_SLOPES), size=cells)].transpose(2, 0, 1)
    (top, bottom, low), (left, right, far) = (
        _lattice_places(side, count) for side, count in zip(shape, cells, strict=True)
    )
    down, across = (np.arange(side) * (count / side) % 1.0 for side, count in zip(shape, cells, strict=True))
    # interpolates rows first, while the array has only as many columns as lattice cells
    steep = down_slope[top] * (down * (1 - low))[:, None] + down_slope[bottom] * ((down - 1) * low)[:, None]
    level = across_slope[top] * (1 - low)[:, None] + across_slope[bottom] * low[:, None]
    field = steep[:, left] * (1 - far) + steep[:, right] * far
    field += level[:, left] * (across * (1 - far)) + level[:, right] * ((across - 1) * far)
    gradient: Field = 0.5 + 0.75 * field
    return gradient


def clouds(rng: np.random.Generator, shape: Shape, cells: Shape, octaves: int) -> Field:
    """Fractal sum of `octaves` of gradient noise, 0 to 1, with a mean near 0.5."""
    total = np.zeros(shape)
    weight, weights = 1.0, 0.0
    for octave in range(octaves):
        total += weight * _gradient_noise(rng, shape, (cells[0] * 2**octave, cells[1] * 2**octave))
        weights += weight
        weight *= 0.55
    return total / weights


def grain(rng: np.random.Generator, shape: Shape) -> Field:
    """Fine noise of single pixels, 0 to 1."""
    return rng.integers(0, 256, size=shape).astype(np.float64) / 255.0


def ramp(field: Field, low: float, high: float) -> Field:
    """Smooth step from 0 below `low` to 1 above `high`; descending if `low` is the larger."""
    part = np.clip((field - low) / (high - low), 0.0, 1.0)
    return part * part * (3.0 - 2.0 * part)


def spots(rng: np.random.Generator, shape: Shape, count: int, radius: tuple[float, float]) -> Field:
    """Soft round spots, 0 to 1, with radii in pixels."""
    field = np.zeros(shape)
    rows, columns = shape
    for _ in range(count):
        x, y = int(rng.integers(columns)), int(rng.integers(rows))
        size = radius[0] + (radius[1] - radius[0]) * (rng.integers(0, 1000) / 999.0)
        strength = 0.3 + 0.7 * (rng.integers(0, 1000) / 999.0)
        reach = int(size) + 1
        steps = np.arange(-reach, reach + 1)
        fall = 1.0 - (steps[None, :] ** 2 + steps[:, None] ** 2) / size**2
        window = np.ix_((y + steps) % rows, (x + steps) % columns)
        field[window] = np.maximum(field[window], strength * np.clip(fall, 0.0, 1.0))
    return field


class Cells(NamedTuple):
    """Cellular noise of a jittered lattice (Worley 1996).

    Attributes
    ----------
    which
        Index of each pixel's cell; int64, shape (rows, columns).
    from_point
        Distance from the cell's point, in pixels.
    from_edge
        Distance from the nearest edge between two cells, in pixels.
    """

    which: NDArray[np.int64]
    from_point: Field
    from_edge: Field


def cells(rng: np.random.Generator, shape: Shape, count: Shape, warp: tuple[Field, Field] | None = None) -> Cells:
    """Compute periodic cells, irregular polygons, `count` (down, across).

    Parameters
    ----------
    rng, shape
        Random generator, and (rows, columns).
    count
        Cells down and across, at least three each way.
    warp
        Shift of each pixel down and across before the computation, which bends the edges.
    """
    rows, columns = count
    jitter_down, jitter_across = (rng.integers(0, _FINE, size=count) / _FINE for _ in range(2))
    down, across = np.arange(shape[0], dtype=np.float64)[:, None], np.arange(shape[1], dtype=np.float64)[None, :]
    shift_down, shift_across = warp or (0.0, 0.0)
    high, wide = shape[0] / rows, shape[1] / columns
    down, across = (down + shift_down) / high + np.zeros(shape), (across + shift_across) / wide + np.zeros(shape)
    row, column = np.floor(down).astype(np.int64), np.floor(across).astype(np.int64)

    def points() -> Iterator[tuple[NDArray[np.int64], Field, Field]]:
        """Yield the index of each point near a pixel's own, and its distance down and across from the pixel."""
        for step_down, step_across in _AROUND:
            i, j = (row + step_down) % rows, (column + step_across) % columns
            y = (row + step_down + jitter_down[i, j] - down) * high
            yield i * columns + j, y, (column + step_across + jitter_across[i, j] - across) * wide

    nearest = np.full(shape, np.inf)
    which = np.zeros(shape, dtype=np.int64)
    near_y, near_x = np.zeros(shape), np.zeros(shape)
    for number, y, x in points():
        away = y * y + x * x
        is_nearest = away < nearest
        nearest = np.where(is_nearest, away, nearest)
        which = np.where(is_nearest, number, which)
        near_y, near_x = np.where(is_nearest, y, near_y), np.where(is_nearest, x, near_x)
    # an edge is the perpendicular bisector of two points
    from_edge = np.full(shape, np.inf)
    for number, y, x in points():
        apart = np.sqrt((y - near_y) ** 2 + (x - near_x) ** 2)
        from_line = (y * y + x * x - nearest) / (2.0 * np.maximum(apart, 1e-6))
        from_edge = np.where(number == which, from_edge, np.minimum(from_edge, from_line))
    return Cells(which, np.sqrt(nearest), from_edge)


def joint(from_middle: Field, width: Field | float) -> Field:
    """Share of each pixel covered by a line of any width (antialiasing).

    Parameters
    ----------
    from_middle
        Distance of the pixel's centre from the line's centre, in pixels, not negative.
    width
        Width of the line in pixels.
    """
    covered: Field = np.clip(np.minimum(from_middle + 0.5, width / 2) - np.maximum(from_middle - 0.5, -width / 2), 0, 1)
    return covered


def strokes(
    rng: np.random.Generator,
    shape: Shape,
    count: int,
    length: tuple[float, float],
    width: tuple[float, float],
    bend: float = 0.3,
) -> Field:
    """Draw soft strokes in random directions, 0 to 1.

    Parameters
    ----------
    rng, shape, count
        Random generator, (rows, columns), and number of strokes.
    length, width
        Least and greatest value, in pixels.
    bend
        Greatest offset of a stroke's centre from its chord, as a share of its length.
    """
    field = np.zeros(shape)
    for _ in range(count):
        place = np.array([_part(rng) * side for side in shape])
        along = _direction(rng)
        reach = _between(rng, length)
        half = _between(rng, width) / 2
        strength = _between(rng, (0.25, 1.0))
        beside = np.array([-along[1], along[0]]) * (bend * reach * (2.0 * _part(rng) - 1.0))
        parts = np.arange(0.0, 1.0, min(0.7 * max(half, 0.7) / reach, 0.2))[:, None]
        dots = place + along * reach * parts + beside * (4.0 * parts * (1.0 - parts))
        for (y, x), part in zip(dots, parts[:, 0], strict=True):
            ends = min(1.0, 5.0 * part, 5.0 * (1.0 - part))
            _dot(field, float(y), float(x), half, strength * ends)
    return field


def _dot(field: Field, y: float, x: float, half: float, strength: float) -> None:
    """Draw a dot by maximum; a dot thinner than a pixel is fainter."""
    reach = int(half) + 2
    rows, columns = int(y) + np.arange(-reach, reach + 1), int(x) + np.arange(-reach, reach + 1)
    away = np.sqrt((rows - y)[:, None] ** 2 + (columns - x)[None, :] ** 2)
    window = np.ix_(rows % field.shape[0], columns % field.shape[1])
    field[window] = np.maximum(field[window], strength * joint(away, 2.0 * half))


def trowel_marks(rng: np.random.Generator, shape: Shape, count: int, radius: tuple[float, float], ring: float) -> Field:
    """Draw arcs of the rotating blades of a power trowel, about -1 to 1, mostly near 0.

    Parameters
    ----------
    rng, shape, count
        Random generator, (rows, columns), and number of positions of the trowel.
    radius
        Least and greatest radius, in pixels.
    ring
        Distance between the arcs of one position, in pixels.
    """
    field = np.zeros(shape)
    rows, columns = shape
    for _ in range(count):
        y, x = int(rng.integers(rows)), int(rng.integers(columns))
        size = _between(rng, radius)
        along = _direction(rng)
        reach = int(size) + 1
        steps = np.arange(-reach, reach + 1, dtype=np.float64)
        away = np.sqrt(steps[:, None] ** 2 + steps[None, :] ** 2)
        tones = rng.integers(0, _FINE, size=int(size / ring) + 3) * (2.0 / _FINE) - 1.0
        low = (away / ring).astype(np.int64)
        part = away / ring - low
        low = np.minimum(low, len(tones) - 2)
        arcs = tones[low] * (1.0 - part) + tones[low + 1] * part
        turned = (along[0] * steps[:, None] + along[1] * steps[None, :]) / np.maximum(away, 1.0)
        side = np.clip((turned - 0.1) / 0.8, 0.0, 1.0)
        rim = np.clip((size - away) / (0.15 * size), 0.0, 1.0) * np.clip(away / (0.5 * size), 0.0, 1.0)
        field[np.ix_((y + steps.astype(int)) % rows, (x + steps.astype(int)) % columns)] += arcs * side * rim
    return field


def _part(rng: np.random.Generator) -> float:
    return int(rng.integers(_FINE)) / _FINE


def _between(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    return ends[0] + (ends[1] - ends[0]) * _part(rng)


def _direction(rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw a random unit vector (down, across)."""
    while True:
        down, across = 2.0 * _part(rng) - 1.0, 2.0 * _part(rng) - 1.0
        square = down * down + across * across
        if 0.01 < square <= 1.0:  # noqa: PLR2004
            length = float(np.sqrt(square))
            return np.array([down / length, across / length])
