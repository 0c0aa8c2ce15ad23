"""Patches on the shell of a car body: slabs, discs and ribbons."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.car_shell import Contour, Shell, both_sides, grid_quads, simplified
from garage2usd.assets.mesh import Face

SKIN_M = 0.006
"""Default distance by which a patch protrudes from the shell."""
_SLAB_M = 0.012
_COLUMN_M = 0.01
"""Least width of the columns at the ends of patches on nose or tail."""
_ROW_M = 0.006
_TURN_TOLERANCE_M = 0.0012
_FLATNESS_M = 0.001

Faces = NDArray[np.float64]
"""float64, shape (faces, corners, 3)."""
Place = Callable[[Contour], float]
"""Position along a level cut through nose or tail, in metres from its centre."""
Row = tuple[float, Place, Place]
"""Height of a row, and its ends."""


def planar_faces(quads: Faces) -> list[Face]:
    """Keep planar quads as they are, and split all others into two triangles."""
    a, b, c, d = quads.transpose(1, 0, 2)
    across = np.cross(c - a, d - b)
    size = np.linalg.norm(across, axis=1)
    off = np.abs(((b - a) * across).sum(axis=1)) / np.where(size > 0, size, 1.0)
    is_flat = (off < _FLATNESS_M) & (size > 0)
    bent = quads[~is_flat]
    return [*quads[is_flat], *bent[:, [0, 1, 2]], *bent[:, [0, 2, 3]]]


def at_x(x_m: float) -> Place:
    """Position where a level cut has an X in metres."""
    return lambda contour: contour.arc_at_x(x_m)


def at_depth(depth_m: float) -> Place:
    """Position a distance behind the centre of a level cut, on the right."""
    return lambda contour: contour.arc_at_depth(depth_m)


def slab(outer: NDArray[np.float64], inner: NDArray[np.float64]) -> Faces:
    """A closed slab between two grids of points, shapes (rows, columns, 3); the outer one is counter-clockwise."""
    quads = [grid_quads(outer).reshape(-1, 4, 3), grid_quads(inner).reshape(-1, 4, 3)[:, ::-1]]
    far, near = (np.concatenate([g[0], g[1:, -1], g[-1, -2::-1], g[-2::-1, 0]]) for g in (outer, inner))
    quads.append(np.stack([far[1:], far[:-1], near[:-1], near[1:]], axis=1))
    return np.concatenate(quads)


def end_patch(shell: Shell, rows: Sequence[Row], *, rear: bool, skin_m: float = SKIN_M) -> Faces:
    """A slab that follows nose or tail around its corners; rows in ascending order."""
    low, high = rows[0][0], rows[-1][0]
    wide = shell.contour(high, rear=rear)
    around_corner = rows[-1][2](wide) > wide.corner_m
    between = shell.end_heights(rear=rear, around_corner=around_corner)
    outline = np.array([y for y, _, _ in rows])
    apart = np.abs(between[:, None] - outline).min(axis=1) > _ROW_M
    heights = np.sort(np.concatenate([outline, between[apart & (between > low) & (between < high)]]))
    contours = [shell.contour(y, rear=rear) for y in heights.tolist()]
    ends = [_ends_at(rows, y, contour) for y, contour in zip(heights.tolist(), contours, strict=True)]
    turns = _turns(contours[len(heights) // 2], min(f for f, _ in ends), max(e for _, e in ends), skin_m)
    grids = []
    for skin in (skin_m, -_SLAB_M):
        grid = np.empty((len(heights), len(turns) + 2, 3))
        for row, (contour, (first, last)) in enumerate(zip(contours, ends, strict=True)):
            arcs = np.array([first, *np.clip(contour.arc_at_points(turns), first, last), last])
            grid[row, :, [0, 2]] = contour.place(arcs, skin).T
            grid[row, :, 1] = heights[row]
        grids.append(grid if rear else grid[:, ::-1])
    return slab(grids[0], grids[1])


def _ends_at(rows: Sequence[Row], y: float, contour: Contour) -> tuple[float, float]:
    """Ends of a patch along a contour at a height, interpolated between rows."""
    above = min(next(i for i, row in enumerate(rows) if row[0] >= y), len(rows) - 1)
    low, high = rows[max(above - 1, 0)], rows[above]
    share = (y - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 1.0
    first = low[1](contour) * (1 - share) + high[1](contour) * share
    return first, low[2](contour) * (1 - share) + high[2](contour) * share


def _turns(contour: Contour, first: float, last: float, skin_m: float) -> NDArray[np.int64]:
    """Indices of the contour's points between two positions at which a patch needs columns to follow the corners."""
    numbers = np.arange(1 - len(contour.line), len(contour.line))
    arcs = contour.arc_at_points(numbers)
    numbers = numbers[(arcs > first + _COLUMN_M) & (arcs < last - _COLUMN_M)]
    arcs = np.array([first, *contour.arc_at_points(numbers), last])
    kept = simplified(arcs, contour.place(arcs, 0.0), skin_m / 4)
    chosen: NDArray[np.int64] = numbers[np.array(kept[1:-1], dtype=int) - 1]
    return chosen


def ribbon(shell: Shell, line: Sequence[tuple[float, float]], width_m: float, *, lift_m: float = 0.003) -> Faces:
    """A thin strip on both sides along points of the shell's surface: (metres from the nose, ring point)."""
    places = np.array([shell.surface(s, t) for s, t in line])
    kept = simplified(np.sum(line, axis=1), places, _TURN_TOLERANCE_M)
    places, normals = places[kept], np.array([shell.normal(*line[i]) for i in kept])
    across = np.cross(np.gradient(places, axis=0), normals)
    across *= width_m / 2 / np.linalg.norm(across, axis=1, keepdims=True)
    grids = [
        np.stack([places + normals * lift + side for side in (-across, across)], axis=1) for lift in (lift_m, -0.01)
    ]
    return both_sides(slab(grids[0], grids[1]))


def disc_patch(shell: Shell, middle: tuple[float, float], radius_m: float, *, rear: bool, skin_m: float) -> Faces:
    """A flat octagonal disc on nose or tail, centred at (x, y)."""
    x, y = middle
    wide, narrow = radius_m, radius_m * 0.45
    rows = [
        (y + dy, at_x(x - dx), at_x(x + dx))
        for dy, dx in ((-wide, narrow), (-narrow, wide), (narrow, wide), (wide, narrow))
    ]
    return end_patch(shell, rows, rear=rear, skin_m=skin_m)


def across(low: float, high: float, below_m: float, above_m: float) -> list[Row]:
    """Two rows of a patch whose ends are symmetric to the middle of the car."""
    return [(low, at_x(-below_m), at_x(below_m)), (high, at_x(-above_m), at_x(above_m))]


def at_left_depth(depth_m: float) -> Place:
    """Return the point of a car body's horizontal section at a distance behind its centre, on the left."""
    return lambda contour: -contour.arc_at_depth(depth_m)
