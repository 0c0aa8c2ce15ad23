"""The baked texture set: procedural, tileable, the same bytes on every machine.

Only sums, products, square roots and integers are used: sines, exponentials and matrix products differ in their last
bit from one CPU to another.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

__all__ = ["bake_textures", "texture_folder"]

Field = NDArray[np.float64]
"""float64, shape (side, side), about 0 to 1, wrapping around."""

_SEED = 20_260_101
_LEVEL_STEP = 3


def texture_folder() -> Path:
    """The folder of the texture set: inside the installed package, else at the top of the repository."""
    package = Path(__file__).parents[1]
    shipped = package / "textures"
    return shipped if shipped.is_dir() else package.parent / "textures"


def bake_textures(folder: Path) -> None:
    """Write the whole set as PNG files into an existing folder."""
    for name, bake in _BAKERS.items():
        rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence([_SEED, *name.encode()])))
        pixels = bake(rng)
        Image.fromarray(pixels).save(folder / name, format="PNG", optimize=True)


def _noise(rng: np.random.Generator, side: int, cells: int) -> Field:
    """Periodic value noise with `cells` lattice cells across, 0 to 1."""
    lattice = rng.integers(0, 1024, size=(cells, cells)).astype(np.float64) / 1023.0
    place = np.arange(side) * (cells / side)
    low = place.astype(np.int64)
    part = place - low
    part = part * part * (3.0 - 2.0 * part)
    high = (low + 1) % cells
    top = lattice[low][:, low] * (1 - part) + lattice[low][:, high] * part
    bottom = lattice[high][:, low] * (1 - part) + lattice[high][:, high] * part
    field: Field = top * (1 - part)[:, None] + bottom * part[:, None]
    return field


def _clouds(rng: np.random.Generator, side: int, cells: int, octaves: int) -> Field:
    """Fractal sum of noise, 0 to 1, with mean near a half."""
    total = np.zeros((side, side))
    weight, weights = 1.0, 0.0
    for octave in range(octaves):
        total += weight * _noise(rng, side, cells * 2**octave)
        weights += weight
        weight *= 0.55
    return total / weights


def _grain(rng: np.random.Generator, side: int) -> Field:
    """Fine noise of single pixels, 0 to 1."""
    return rng.integers(0, 256, size=(side, side)).astype(np.float64) / 255.0


def _smooth_step(field: Field, low: float, high: float) -> Field:
    part = np.clip((field - low) / (high - low), 0.0, 1.0)
    return part * part * (3.0 - 2.0 * part)


def _spots(rng: np.random.Generator, side: int, count: int, radius: tuple[float, float]) -> Field:
    """Round soft spots, 0 to 1, of radii in pixels."""
    field = np.zeros((side, side))
    axis = np.arange(side, dtype=np.float64)
    for _ in range(count):
        x, y = rng.integers(0, side, size=2).tolist()
        size = radius[0] + (radius[1] - radius[0]) * (rng.integers(0, 1000) / 999.0)
        strength = 0.3 + 0.7 * (rng.integers(0, 1000) / 999.0)
        dx = np.abs(axis - x)
        dy = np.abs(axis - y)
        dx, dy = np.minimum(dx, side - dx), np.minimum(dy, side - dy)
        fall = 1.0 - (dx[None, :] ** 2 + dy[:, None] ** 2) / size**2
        field = np.maximum(field, strength * np.clip(fall, 0.0, 1.0))
    return field


def _streaks(rng: np.random.Generator, side: int, count: int, width: float) -> Field:
    """Straight soft bands across the texture, broken along their length: tyre marks; 0 to 1."""
    field = np.zeros((side, side))
    axis = np.arange(side, dtype=np.float64)
    for _ in range(count):
        place = float(rng.integers(0, side))
        away = np.abs(axis - place)
        band = np.clip(1.0 - (np.minimum(away, side - away) / width) ** 2, 0.0, 1.0)
        broken = _smooth_step(_noise(rng, side, 8)[:, :1], 0.45, 0.75)
        mark = band[None, :] * broken
        field = np.maximum(field, mark.T if rng.integers(2) else mark)
    return field


def _bytes(value: Field) -> NDArray[np.uint8]:
    levels: NDArray[np.uint8] = np.clip(np.rint(value), 0, 255).astype(np.uint8)
    return levels


def _rgb(value: Field, tint: tuple[float, float, float]) -> NDArray[np.uint8]:
    """Display values 0 to 255 of one channel, tinted; few levels, so that the files stay small."""
    levels = np.rint(np.clip(value, 0.0, 255.0) / _LEVEL_STEP) * _LEVEL_STEP
    return _bytes(levels[:, :, None] * np.array(tint))


def _mix(base: NDArray[np.uint8], over: tuple[int, int, int], share: Field) -> NDArray[np.uint8]:
    mixed = base * (1.0 - share[:, :, None]) + np.array(over) * share[:, :, None]
    return _bytes(mixed)


def _normal_map(height: Field, strength: float) -> NDArray[np.uint8]:
    """Tangent-space normals of a height field, (n + 1) / 2 in 8 bits."""
    dx = (np.roll(height, 1, axis=1) - np.roll(height, -1, axis=1)) * strength
    dy = (np.roll(height, -1, axis=0) - np.roll(height, 1, axis=0)) * strength
    length = np.sqrt(dx * dx + dy * dy + 1.0)
    normal = np.stack([dx / length, dy / length, 1.0 / length], axis=2)
    return _bytes((normal + 1.0) * 127.5)


def _floor_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 1024
    value = 108.0 + 30.0 * (_clouds(rng, side, 6, 5) - 0.5) + 6.0 * (_noise(rng, side, 3) - 0.5)
    value += 7.0 * (_grain(rng, side) - 0.5)
    value -= 12.0 * _smooth_step(_clouds(rng, side, 12, 4), 0.56, 0.78)
    value -= 15.0 * _streaks(rng, side, 9, 11.0) * _clouds(rng, side, 16, 3)
    value -= 20.0 * _spots(rng, side, 40, (2.0, 12.0)) * _clouds(rng, side, 32, 3)
    value += 20.0 * _spots(rng, side, 60, (1.0, 2.5))
    return _rgb(value, (1.0, 0.995, 0.98))


def _floor_roughness(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    value = 112.0 + 70.0 * (_clouds(rng, side, 5, 4) - 0.5) - 30.0 * _spots(rng, side, 20, (4.0, 20.0))
    return _bytes(np.rint(np.clip(value, 40, 220) / 4) * 4)


def _floor_normal(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    return _normal_map(_clouds(rng, side, 32, 3) + 0.3 * _spots(rng, side, 120, (1.0, 2.5)), 0.3)


def _stall_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    value = 128.0 + 24.0 * (_clouds(rng, side, 4, 5) - 0.5) + 5.0 * (_grain(rng, side) - 0.5)
    value -= 30.0 * _spots(rng, side, 12, (5.0, 22.0)) * _clouds(rng, side, 24, 3)
    value -= 18.0 * _smooth_step(_clouds(rng, side, 5, 4), 0.6, 0.8)
    return _rgb(value, (0.90, 0.97, 1.0))


def _worn_paint(tint: tuple[float, float, float]) -> Callable[[np.random.Generator], NDArray[np.uint8]]:
    def bake(rng: np.random.Generator) -> NDArray[np.uint8]:
        side = 512
        value = 226.0 + 18.0 * (_clouds(rng, side, 6, 4) - 0.5) + 6.0 * (_grain(rng, side) - 0.5)
        worn = _smooth_step(_clouds(rng, side, 20, 4), 0.6, 0.72) * 0.75
        return _mix(_rgb(value, tint), (112, 111, 108), worn)

    return bake


def _wall_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    value = 176.0 + 22.0 * (_clouds(rng, side, 4, 5) - 0.5) + 6.0 * (_grain(rng, side) - 0.5)
    # water marks run down
    runs = _smooth_step(_noise(rng, side, 24)[:1, :], 0.72, 0.95) * _smooth_step(_noise(rng, side, 4), 0.35, 0.8)
    value -= 26.0 * runs
    axis = np.arange(side)
    joint = np.minimum(axis % (side // 2), side // 2 - axis % (side // 2)) < 2  # noqa: PLR2004
    value[:, joint] -= 46.0
    value -= 40.0 * _spots(rng, side, 20, (1.0, 3.0))
    return _rgb(value, (1.0, 0.99, 0.965))


def _wall_normal(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 256
    return _normal_map(_clouds(rng, side, 16, 3), 0.8)


def _band_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    value = 120.0 + 16.0 * (_clouds(rng, side, 4, 4) - 0.5) + 4.0 * (_grain(rng, side) - 0.5)
    base = _rgb(value, (0.72, 0.95, 1.05))
    scuffs = 0.5 * _smooth_step(_noise(rng, side, 40), 0.8, 0.95) * _smooth_step(_clouds(rng, side, 5, 3), 0.5, 0.7)
    return _mix(base, (70, 68, 64), scuffs)


def _ceiling_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 512
    value = 166.0 + 20.0 * (_clouds(rng, side, 5, 5) - 0.5) + 6.0 * (_grain(rng, side) - 0.5)
    axis = np.arange(side)
    boards = (axis % 64) < 1
    value[:, boards] -= 20.0
    value[(axis % 256) < 2, :] -= 24.0  # noqa: PLR2004
    value -= 20.0 * _smooth_step(_clouds(rng, side, 4, 4), 0.62, 0.8)
    return _rgb(value, (1.0, 0.99, 0.97))


def _hazard(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 256
    axis = np.arange(side)
    yellow = ((axis[None, :] + axis[:, None]) % side) < side // 2
    pixels = np.where(yellow[:, :, None], np.array([222, 168, 24]), np.array([28, 28, 30])).astype(np.uint8)
    worn = 0.6 * _smooth_step(_clouds(rng, side, 10, 4), 0.62, 0.74)
    return _mix(pixels, (128, 126, 122), worn)


def _steel_colour(rng: np.random.Generator) -> NDArray[np.uint8]:
    side = 256
    value = 178.0 + 26.0 * (_clouds(rng, side, 10, 3) - 0.5) + 10.0 * (_noise(rng, side, 64) - 0.5)
    return _rgb(value, (0.98, 0.99, 1.0))


_BAKERS: dict[str, Callable[[np.random.Generator], NDArray[np.uint8]]] = {
    "floor_colour.png": _floor_colour,
    "floor_roughness.png": _floor_roughness,
    "floor_normal.png": _floor_normal,
    "stall_colour.png": _stall_colour,
    "paint_white.png": _worn_paint((1.0, 1.0, 0.985)),
    "paint_yellow.png": _worn_paint((0.98, 0.74, 0.16)),
    "wall_colour.png": _wall_colour,
    "wall_normal.png": _wall_normal,
    "band_colour.png": _band_colour,
    "ceiling_colour.png": _ceiling_colour,
    "hazard.png": _hazard,
    "steel_colour.png": _steel_colour,
}
