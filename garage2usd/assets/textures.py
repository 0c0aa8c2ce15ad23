"""The baked texture set: procedural, tileable, in three qualities, the same bytes on every machine."""
# Over 300 lines: one function bakes one texture, and all share the tileable noise and its order of draws.

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from garage2usd.assets.fields import Field, clouds, grain, noise, ramp, spots
from garage2usd.assets.plate_texture import bake_plates
from garage2usd.assets.stain_texture import bake_stains
from garage2usd.config.stage import TextureQuality

__all__ = ["bake_textures", "texture_folder"]

Pixels = NDArray[np.uint8]
"""uint8, shape (rows, columns, 3), or 4 with alpha."""

_SEED = 20_260_101
_DIVISORS = {TextureQuality.LOW: 4, TextureQuality.MEDIUM: 2, TextureQuality.HIGH: 1}
_JPEG_QUALITY = 90
_RGBA = 4
_ALPHA_STEPS = 28
_DRAWN_IN_FEW_COLOURS = frozenset({"plate_characters"})
"""Saved with a palette, in half the bytes."""
_COLOUR_STEP, _PALETTE_BYTES = 12, 768


def texture_folder(quality: TextureQuality) -> Path:
    """The folder of the texture set in a quality: inside the installed package, else at the top of the repository."""
    package = Path(__file__).parents[1]
    shipped = package / "textures"
    return (shipped if shipped.is_dir() else package.parent / "textures") / quality


def bake_textures(folder: Path) -> None:
    """Write the whole set into an existing folder, each quality into a folder of its own.

    A pixel of a lower quality is the mean of those that it covers, so that it still repeats.
    """
    for quality in _DIVISORS:
        (folder / quality).mkdir()
    for name, bake in _BAKERS.items():
        rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence([_SEED, *name.encode()])))
        pixels = bake(rng)
        for quality, divisor in _DIVISORS.items():
            _save(pixels, divisor, folder / quality / name)


def _save(pixels: Pixels, divisor: int, path: Path) -> None:
    picture = Image.fromarray(pixels).reduce(divisor)
    if pixels.shape[2] == _RGBA:
        # its colours are few and each cell has one of them, its opacity is fine where there is little of it
        alpha = np.rint(np.sqrt(np.asarray(picture.getchannel("A")) / 255.0) * _ALPHA_STEPS)
        opaque = np.rint((alpha / _ALPHA_STEPS) ** 2 * 255).astype(np.uint8)
        entries, picture = _palette(np.dstack([pixels[::divisor, ::divisor, :3], opaque]))
        picture.putpalette(entries[:, :3].tobytes())
        picture.save(path, format="PNG", optimize=True, transparency=entries[:, 3].tobytes())
    elif path.stem in _DRAWN_IN_FEW_COLOURS:
        colours = np.rint(np.asarray(picture) / _COLOUR_STEP).astype(np.uint8) * np.uint8(_COLOUR_STEP)
        entries, picture = _palette(colours)
        picture.putpalette(entries.tobytes() + bytes(_PALETTE_BYTES - entries.size))
        picture.save(path, format="PNG", optimize=True)
    elif path.suffix == ".jpg":
        # colours that meet at sharp edges need all their pixels
        subsampling = "4:4:4" if path.stem == "hazard" else "4:2:0"
        picture.save(path, format="JPEG", quality=_JPEG_QUALITY, subsampling=subsampling, optimize=True)
    else:
        picture.save(path, format="PNG", optimize=True)


def _palette(colours: Pixels) -> tuple[Pixels, Image.Image]:
    """The colours that there are, in order, a row each; and which of them each pixel has."""
    # sorted as whole numbers, which is much faster than as rows
    places = 256 ** np.arange(colours.shape[2], dtype=np.uint32)[::-1]
    numbers, index = np.unique((colours * places).sum(axis=2, dtype=np.uint32), return_inverse=True)
    entries = (numbers[:, None] // places % 256).astype(np.uint8)
    return entries, Image.fromarray(index.reshape(colours.shape[:2]).astype(np.uint8))


def _bytes(value: Field) -> Pixels:
    levels: Pixels = np.clip(np.rint(value), 0, 255).astype(np.uint8)
    return levels


def _rgb(value: Field, tint: tuple[float, float, float]) -> Pixels:
    """Display values 0 to 255 of one channel, tinted."""
    return _bytes(np.clip(value, 0.0, 255.0)[:, :, None] * np.array(tint))


def _mix(base: Pixels, over: tuple[int, int, int], share: Field) -> Pixels:
    mixed = base * (1.0 - share[:, :, None]) + np.array(over) * share[:, :, None]
    return _bytes(mixed)


def _packed(occlusion: Field | float, roughness: Field, metallic: Field | float = 0.0) -> Pixels:
    """Occlusion, roughness and metallic, 0 to 1, in the red, green and blue of one picture; few levels."""
    channels = [np.broadcast_to(value, roughness.shape) for value in (occlusion, roughness, metallic)]
    return _bytes(np.rint(np.stack(channels, axis=2) * 255 / _ROUGHNESS_STEP) * _ROUGHNESS_STEP)


_ROUGHNESS_STEP = 5


def _normal_map(height: Field, strength: float) -> Pixels:
    """Tangent-space normals of a height field, (n + 1) / 2 in 8 bits."""
    dx = (np.roll(height, 1, axis=1) - np.roll(height, -1, axis=1)) * strength
    dy = (np.roll(height, -1, axis=0) - np.roll(height, 1, axis=0)) * strength
    length = np.sqrt(dx * dx + dy * dy + 1.0)
    normal = np.stack([dx / length, dy / length, 1.0 / length], axis=2)
    return _bytes((normal + 1.0) * 127.5)


def _distance_to(shape: tuple[int, int], period: int, axis: int, start: int = 0) -> Field:
    """Pixels from the nearest of the lines that cross the texture every `period` pixels along an axis."""
    place = (np.arange(shape[axis]) - start) % period
    away = np.minimum(place, period - place).astype(np.float64)
    return np.broadcast_to(away[:, None] if axis == 0 else away[None, :], shape)


# floors: 8.1 m a repeat, as wide as a usual square, so that the pattern runs on from square to square


def _floor_colour(rng: np.random.Generator) -> Pixels:
    shape = 2048, 2048
    value = 112.0 + 34.0 * (clouds(rng, shape, (7, 7), 6) - 0.5)
    # pale laitance and darker, denser spots, as a power float leaves them
    value += 9.0 * ramp(clouds(rng, shape, (9, 9), 6), 0.5, 0.75)
    value -= 13.0 * ramp(clouds(rng, shape, (11, 11), 6), 0.5, 0.75)
    value -= 22.0 * spots(rng, shape, 420, (1.5, 6.0)) * clouds(rng, shape, (64, 64), 3)
    value += 16.0 * spots(rng, shape, 500, (1.0, 3.0))
    value += 12.0 * (grain(rng, shape) - 0.5)
    return _rgb(value, (1.0, 0.992, 0.972))


def _floor_packed(rng: np.random.Generator) -> Pixels:
    shape = 512, 512
    rough = 0.43 + 0.20 * (clouds(rng, shape, (12, 12), 4) - 0.5)
    rough += 0.12 * ramp(clouds(rng, shape, (20, 20), 4), 0.54, 0.74)
    rough -= 0.06 * spots(rng, shape, 60, (3.0, 14.0))
    return _packed(1.0, np.clip(rough, 0.2, 0.8))


def _floor_normal(rng: np.random.Generator) -> Pixels:
    shape = 512, 512
    return _normal_map(clouds(rng, shape, (36, 36), 3) + 0.4 * spots(rng, shape, 260, (1.0, 2.0)), 0.22)


def _stall_colour(rng: np.random.Generator) -> Pixels:
    shape = 1024, 1024
    value = 132.0 + 26.0 * (clouds(rng, shape, (6, 6), 6) - 0.5) + 8.0 * (grain(rng, shape) - 0.5)
    value -= 14.0 * ramp(clouds(rng, shape, (9, 9), 5), 0.56, 0.76)
    value -= 24.0 * spots(rng, shape, 110, (1.5, 7.0)) * clouds(rng, shape, (48, 48), 3)
    return _rgb(value, (0.91, 0.97, 1.0))


def _worn_paint(tint: tuple[float, float, float]) -> Callable[[np.random.Generator], Pixels]:
    """Road paint of 2.7 m a repeat, worn to the concrete in places and grey where tyres cross it."""

    def bake(rng: np.random.Generator) -> Pixels:
        shape = 1024, 1024
        value = 222.0 + 20.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 6.0 * (grain(rng, shape) - 0.5)
        value -= 34.0 * ramp(clouds(rng, shape, (5, 5), 5), 0.5, 0.78)
        worn = ramp(clouds(rng, shape, (22, 22), 5), 0.625, 0.67) * 0.85
        worn = np.maximum(worn, 0.8 * ramp(spots(rng, shape, 300, (1.5, 5.0)), 0.3, 0.6))
        return _mix(_rgb(value, tint), (110, 108, 104), worn)

    return bake


# walls and ceilings: sheets of formwork, 2.7 m by 1.35 m, with the holes of their ties

# in repeats of 8.1 m by 4.05 m on walls, 8.1 m by 8.1 m on ceilings
_SHEETS_ACROSS, _SHEETS_UP_WALL, _SHEETS_ALONG_CEILING = 3, 3, 6
_WALL_REPEAT_UP_M = 4.05
_BAND_M = 1.1


def _wall_relief(shape: tuple[int, int]) -> tuple[Field, Field]:
    """How near each pixel is to a joint of the formwork, and to a tie hole; 0 to 1."""
    rows, columns = shape
    up, across = rows // _SHEETS_UP_WALL, columns // _SHEETS_ACROSS
    pixel = 2040 / columns
    joint = np.maximum(
        ramp(_distance_to(shape, across, 1) * pixel, 3.6, 0.8), ramp(_distance_to(shape, up, 0) * pixel, 3.6, 0.8)
    )
    aside, above = _distance_to(shape, across // 2, 1, across // 4), _distance_to(shape, up, 0, up // 2)
    hole = np.sqrt(aside * aside + above * above) * pixel
    return joint, ramp(hole, 7.0, 3.5)


def _below_top(rows: int) -> Field:
    """Metres below the top of a wall."""
    return (np.arange(rows) * (_WALL_REPEAT_UP_M / rows))[:, None]


def _sheet_tones(rng: np.random.Generator, shape: tuple[int, int], sheets: tuple[int, int]) -> Field:
    """A tone of its own for each sheet of formwork, 0 to 1."""
    tones = rng.integers(0, 1024, size=sheets).astype(np.float64) / 1023.0
    return tones.repeat(shape[0] // sheets[0], axis=0).repeat(shape[1] // sheets[1], axis=1)


def _wall_colour(rng: np.random.Generator) -> Pixels:
    shape = 1020, 2040
    value = 172.0 + 24.0 * (clouds(rng, shape, (4, 8), 6) - 0.5) + 10.0 * (grain(rng, shape) - 0.5)
    value += 9.0 * (_sheet_tones(rng, shape, (_SHEETS_UP_WALL, _SHEETS_ACROSS)) - 0.5)
    # air holes, then the water that ran down from the slab, and its soot
    value -= 44.0 * spots(rng, shape, 900, (1.0, 3.6))
    below = _below_top(shape[0])
    columns = noise(rng, shape, (4, 110)) * noise(rng, (1, shape[1]), (1, 16))
    value -= 34.0 * ramp(columns, 0.3, 0.62) * ramp(below / (0.25 + 1.6 * columns), 1.0, 0.1)
    value -= 30.0 * ramp(below + 0.25 * (clouds(rng, shape, (12, 24), 4) - 0.5), 0.42, 0.0)
    joint, hole = _wall_relief(shape)
    value -= 30.0 * joint * (0.55 + 0.45 * noise(rng, shape, (18, 36))) + 62.0 * hole
    return _rgb(value, (1.0, 0.988, 0.962))


def _wall_packed(rng: np.random.Generator) -> Pixels:
    shape = 204, 408
    joint, hole = _wall_relief(shape)
    occlusion = 1.0 - 0.35 * joint - 0.55 * hole - 0.4 * ramp(_below_top(shape[0]), 0.45, 0.0)
    rough = 0.84 + 0.14 * (clouds(rng, shape, (5, 10), 3) - 0.5)
    return _packed(np.clip(occlusion, 0.2, 1.0), np.clip(rough, 0.6, 1.0))


def _wall_normal(rng: np.random.Generator) -> Pixels:
    shape = 516, 1032
    joint, hole = _wall_relief(shape)
    return _normal_map(clouds(rng, shape, (22, 44), 2) - 0.7 * joint - 1.6 * hole, 0.4)


def _above_foot(rows: int) -> Field:
    """Metres above the foot of the painted band of a wall, 1.1 m high."""
    return ((rows - 0.5 - np.arange(rows)) * (_BAND_M / rows))[:, None]


def _band_colour(rng: np.random.Generator) -> Pixels:
    shape = 256, 2048
    value = 122.0 + 14.0 * (clouds(rng, shape, (2, 14), 4) - 0.5) + 5.0 * (grain(rng, shape) - 0.5)
    base = _rgb(value, (0.72, 0.95, 1.05))
    above = _above_foot(shape[0])
    # rubbed by bumpers, chipped, and splashed from the floor
    bumper = ramp(np.abs(above - 0.5), 0.13, 0.02) * ramp(noise(rng, shape, (48, 15)), 0.68, 0.9)
    base = _mix(base, (58, 56, 54), 0.6 * bumper)
    chips = ramp(clouds(rng, shape, (10, 74), 4) - 0.12 * ramp(above, 0.3, 0.8), 0.66, 0.70)
    base = _mix(base, (150, 147, 140), 0.85 * chips)
    splash = ramp(above + 0.34 * (clouds(rng, shape, (4, 30), 5) - 0.5), 0.30, -0.06)
    return _mix(base, (66, 62, 56), np.clip(0.9 * splash, 0.0, 1.0))


def _band_packed(rng: np.random.Generator) -> Pixels:
    shape = 64, 512
    above = _above_foot(shape[0])
    occlusion = 1.0 - 0.45 * ramp(above, 0.35, 0.0) * np.ones(shape)
    rough = 0.42 + 0.45 * ramp(above + 0.3 * (clouds(rng, shape, (4, 30), 3) - 0.5), 0.34, 0.0)
    return _packed(occlusion, np.clip(rough + 0.08 * (noise(rng, shape, (8, 60)) - 0.5), 0.2, 1.0))


def _ceiling_joints(shape: tuple[int, int]) -> Field:
    rows, columns = shape
    pixel = 1024 / columns
    along = _distance_to(shape, rows // _SHEETS_ALONG_CEILING, 0, rows // (2 * _SHEETS_ALONG_CEILING)) * pixel
    across = _distance_to(shape, columns // _SHEETS_ACROSS, 1) * pixel
    return np.maximum(ramp(along, 1.8, 0.4), ramp(across, 1.8, 0.4))


def _ceiling_colour(rng: np.random.Generator) -> Pixels:
    shape = 1020, 1020
    value = 164.0 + 20.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 8.0 * (grain(rng, shape) - 0.5)
    sheets = _sheet_tones(rng, shape, (_SHEETS_ALONG_CEILING, _SHEETS_ACROSS))
    value += 13.0 * (np.roll(sheets, shape[0] // (2 * _SHEETS_ALONG_CEILING), axis=0) - 0.5)
    value -= 20.0 * ramp(clouds(rng, shape, (5, 5), 5), 0.6, 0.8)
    value -= 26.0 * spots(rng, shape, 260, (0.8, 2.4))
    value -= 34.0 * _ceiling_joints(shape) * (0.5 + 0.5 * noise(rng, shape, (24, 24)))
    return _rgb(value, (1.0, 0.99, 0.968))


def _ceiling_normal(rng: np.random.Generator) -> Pixels:
    shape = 516, 516
    return _normal_map(clouds(rng, shape, (20, 20), 2) - 1.2 * _ceiling_joints(shape), 0.3)


def _hazard(rng: np.random.Generator) -> Pixels:
    side = 256
    axis = np.arange(side)
    yellow = ((axis[None, :] + axis[:, None]) % side) < side // 2
    pixels = np.where(yellow[:, :, None], np.array([222, 168, 24]), np.array([28, 28, 30])).astype(np.uint8)
    worn = 0.6 * ramp(clouds(rng, (side, side), (10, 10), 4), 0.62, 0.74)
    return _mix(pixels, (128, 126, 122), worn)


def _steel_colour(rng: np.random.Generator) -> Pixels:
    shape = 256, 256
    value = 178.0 + 26.0 * (clouds(rng, shape, (10, 10), 3) - 0.5) + 10.0 * (noise(rng, shape, (64, 64)) - 0.5)
    return _rgb(value, (0.98, 0.99, 1.0))


def _steel_packed(rng: np.random.Generator) -> Pixels:
    """Spangled zinc, dull where it has turned white."""
    shape = 128, 128
    dull = ramp(clouds(rng, shape, (6, 6), 4), 0.5, 0.75)
    rough = 0.36 + 0.16 * (noise(rng, shape, (28, 28)) - 0.5) + 0.26 * dull
    return _packed(1.0, rough, 0.92 - 0.35 * dull)


_BAKERS: dict[str, Callable[[np.random.Generator], Pixels]] = {
    "floor_colour.jpg": _floor_colour,
    "floor_packed.png": _floor_packed,
    "floor_normal.png": _floor_normal,
    "stall_colour.jpg": _stall_colour,
    "paint_white.jpg": _worn_paint((1.0, 1.0, 0.985)),
    "paint_yellow.jpg": _worn_paint((0.98, 0.74, 0.16)),
    "wall_colour.jpg": _wall_colour,
    "wall_packed.png": _wall_packed,
    "wall_normal.png": _wall_normal,
    "band_colour.jpg": _band_colour,
    "band_packed.png": _band_packed,
    "ceiling_colour.jpg": _ceiling_colour,
    "ceiling_normal.png": _ceiling_normal,
    "hazard.jpg": _hazard,
    "steel_colour.jpg": _steel_colour,
    "steel_packed.png": _steel_packed,
    "stains.png": bake_stains,
    "plate_characters.png": bake_plates,
}
