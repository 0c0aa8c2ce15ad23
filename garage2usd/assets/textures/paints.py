"""Textures of worn paint: masks of wear, images of an index with a palette, paint and ground; and fields as pixels."""

import struct
import zlib
from bisect import bisect_right
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.fields import Field, clouds, grain, noise, ramp, spots
from garage2usd.common.errors import ConfigError

Pixels = NDArray[np.uint8]
"""uint8, shape (rows, columns, 3), or 4 with alpha; (rows, columns) for wear masks."""
Bakers = dict[str, Callable[[np.random.Generator], Pixels]]
"""Generators of textures by file name."""
_ROUGHNESS_STEP = 5
_Colour = tuple[int, int, int]
"""sRGB values."""
Rgb = tuple[float, float, float]
WEAR_STEPS = 16
"""Number of indices: 0 is fresh paint, the last the bare ground."""
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_LENGTH = struct.Struct(">I")
_PALETTE = b"PLTE"
_SHORTEST = 12
"""Bytes of a PNG chunk without data: length, type and checksum."""
_SHAPE = 512, 512


def levels(value: Field) -> Pixels:
    """Quantise sRGB values to 8 bits."""
    return np.clip(np.rint(value), 0, 255).astype(np.uint8)


def shaded(value: Field, tint: tuple[float, float, float]) -> Pixels:
    """Tint a field of sRGB values 0 to 255."""
    return levels(np.clip(value, 0.0, 255.0)[:, :, None] * np.array(tint))


def mixed_over(base: Pixels, over: tuple[int, int, int], share: Field) -> Pixels:
    """Blend a colour over pixels by a share from 0 to 1."""
    mixed = base * (1.0 - share[:, :, None]) + np.array(over) * share[:, :, None]
    return levels(mixed)


def packed(occlusion: Field | float, roughness: Field, metallic: Field | float = 0.0) -> Pixels:
    """Pack occlusion, roughness and metallic, 0 to 1, into red, green and blue, with few levels."""
    channels = [np.broadcast_to(value, roughness.shape) for value in (occlusion, roughness, metallic)]
    return levels(np.rint(np.stack(channels, axis=2) * 255 / _ROUGHNESS_STEP) * _ROUGHNESS_STEP)


def normal_map(height: Field, strength: float) -> Pixels:
    """Tangent-space normal map of a height field, as (n + 1) / 2 in 8 bits."""
    dx = (np.roll(height, 1, axis=1) - np.roll(height, -1, axis=1)) * strength
    dy = (np.roll(height, -1, axis=0) - np.roll(height, 1, axis=0)) * strength
    length = np.sqrt(dx * dx + dy * dy + 1.0)
    normal = np.stack([dx / length, dy / length, 1.0 / length], axis=2)
    return levels((normal + 1.0) * 127.5)


def distance_to(shape: tuple[int, int], period: int, axis: int, start: int = 0) -> Field:
    """Distance in pixels from the nearest of parallel lines, one every `period` pixels along an axis."""
    place = (np.arange(shape[axis]) - start) % period
    away = np.minimum(place, period - place).astype(np.float64)
    return np.broadcast_to(away[:, None] if axis == 0 else away[None, :], shape)


def _worn_paint(tint: tuple[float, float, float]) -> Callable[[np.random.Generator], Pixels]:
    """Road paint, 2.7 m per repeat, worn to the concrete in places and grey in the tyre tracks."""

    def bake(rng: np.random.Generator) -> Pixels:
        shape = 1024, 1024
        value = 222.0 + 20.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 6.0 * (grain(rng, shape) - 0.5)
        value -= 34.0 * ramp(clouds(rng, shape, (5, 5), 5), 0.5, 0.78)
        worn = ramp(clouds(rng, shape, (22, 22), 5), 0.625, 0.67) * 0.85
        worn = np.maximum(worn, 0.8 * ramp(spots(rng, shape, 300, (1.5, 5.0)), 0.3, 0.6))
        return mixed_over(shaded(value, tint), (110, 108, 104), worn)

    return bake


def _stripes(light: _Colour, dark: _Colour, *, level: bool = False) -> Callable[[np.random.Generator], Pixels]:
    """Stripes of two colours, one of each per repeat, diagonal or level, scuffed to the concrete."""

    def bake(rng: np.random.Generator) -> Pixels:
        side = 256
        axis = np.arange(side)
        across = np.zeros(side, dtype=np.int64) if level else axis
        is_light = ((across[None, :] + axis[:, None]) % side) < side // 2
        pixels = np.where(is_light[:, :, None], np.array(light), np.array(dark)).astype(np.uint8)
        worn = 0.6 * ramp(clouds(rng, (side, side), (10, 10), 4), 0.62, 0.74)
        return mixed_over(pixels, (128, 126, 122), worn)

    return bake


_YELLOW = 222, 168, 24

PAINTS: Bakers = {
    "paint_white.jpg": _worn_paint((1.0, 1.0, 0.985)),
    "paint_yellow.jpg": _worn_paint((0.98, 0.74, 0.16)),
    "hazard.jpg": _stripes(_YELLOW, (28, 28, 30)),
}

GUARDS: Bakers = {
    "guard_red_white.jpg": _stripes((214, 212, 206), (172, 34, 30), level=True),
    "guard_blue_yellow.jpg": _stripes(_YELLOW, (34, 74, 150)),
}


def wear_palette(paint_rgb: Rgb, ground_rgb: Rgb) -> bytes:
    """Palette of a wear image in sRGB, mixed in linear light; 3 bytes per index.

    Parameters
    ----------
    paint_rgb, ground_rgb
        Linear colours of the paint and its ground, 0 to 1.
    """
    bare = [index / (WEAR_STEPS - 1) for index in range(WEAR_STEPS)]
    return bytes(
        _srgb_byte(paint * (1 - share) + ground * share)
        for share in bare
        for paint, ground in zip(paint_rgb, ground_rgb, strict=True)
    )


def painted(png: bytes, paint_rgb: Rgb, ground_rgb: Rgb) -> bytes:
    """Recolour an image of wear by its palette; pixels are not decoded, so all machines give the same bytes.

    Parameters
    ----------
    png
        An indexed PNG of at most `WEAR_STEPS` colours, such as the shipped ``wear_*.png``.
    paint_rgb, ground_rgb
        Linear colours of the paint and its ground, 0 to 1.

    Raises
    ------
    ConfigError
        If `png` is not an indexed PNG with at most `WEAR_STEPS` colours.
    """
    palette = wear_palette(paint_rgb, ground_rgb)
    pieces, replaced = [_SIGNATURE], 0
    for kind, data in _chunks(png):
        if kind == _PALETTE:
            if len(data) > len(palette):
                raise _unfit(f"one of {len(data) // 3} colours")
            replaced += 1
        held = palette[: len(data)] if kind == _PALETTE else data
        pieces += [_LENGTH.pack(len(held)), kind, held, _LENGTH.pack(zlib.crc32(kind + held))]
    if replaced != 1:
        raise _unfit("one without a palette")
    return b"".join(pieces)


def _chunks(png: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield type and data of each chunk of a PNG."""
    if not png.startswith(_SIGNATURE):
        raise _unfit("no PNG")
    place = len(_SIGNATURE)
    while place < len(png):
        rest = len(png) - place
        length = _LENGTH.unpack_from(png, place)[0] if rest >= _SHORTEST else rest
        end = place + _SHORTEST + length
        if end > len(png):
            raise _unfit("one that ends within a chunk")
        yield png[place + 4 : place + 8], png[place + 8 : end - 4]
        place = end


def _unfit(what: str) -> ConfigError:
    return ConfigError("picture of wear", what, f"an indexed PNG of at most {WEAR_STEPS} colours")


def _srgb_byte(linear: float) -> int:
    """Convert a linear value to 8-bit sRGB, by IEC 61966-2-1.

    A power of 1 / 2.4 differs in its last bit between CPUs, so fifth powers are compared with twelfth ones.
    """
    value = min(max(linear, 0.0), 1.0)
    if value <= _LINEAR_BELOW:
        return round(255 * 12.92 * value)
    return bisect_right(_BORDERS, value * value * value * value * value)


def _twelfth_power(value: float) -> float:
    fourth = value * value * value * value
    return fourth * fourth * fourth


_LINEAR_BELOW = 0.0031308

_BORDERS = [_twelfth_power(((byte - 0.5) / 255 + 0.055) / 1.055) for byte in range(1, 256)]
"""Thresholds of the 8-bit sRGB values, as fifth powers of linear values."""


def _chips(rng: np.random.Generator, count: int) -> Field:
    """Chips where paint has come off the aggregate."""
    return ramp(spots(rng, _SHAPE, count, (1.0, 4.5)), 0.25, 0.5)


def _fresh(rng: np.random.Generator) -> Field:
    """Fresh paint with a film of dirt and few chips."""
    dirt = 0.2 * ramp(clouds(rng, _SHAPE, (4, 4), 4), 0.42, 0.72)
    return np.maximum(dirt, 0.75 * _chips(rng, 60))


def _worn(rng: np.random.Generator) -> Field:
    """Worn paint: off the aggregate in wide patches, thin between them."""
    where = clouds(rng, _SHAPE, (4, 4), 3)
    grains = clouds(rng, _SHAPE, (40, 40), 3)
    off = ramp(grains + 1.1 * (where - 0.5), 0.52, 0.68)
    thin = 0.12 + 0.3 * ramp(where, 0.4, 0.7)
    return np.maximum(np.maximum(off, thin), _chips(rng, 260))


def _gone(rng: np.random.Generator) -> Field:
    """Remains of paint in the hollows of the ground."""
    where = clouds(rng, _SHAPE, (5, 5), 3)
    grains = clouds(rng, _SHAPE, (36, 36), 4)
    left = ramp(grains + 0.9 * (where - 0.5), 0.52, 0.68)
    thin = 0.25 + 0.5 * noise(rng, _SHAPE, (9, 9))
    return 1.0 - left * (1.0 - 0.6 * thin)


def _ghost(rng: np.random.Generator) -> Field:
    """Trace of a line that was ground off or painted over, with remains of the old film."""
    trace = 0.8 + 0.3 * (clouds(rng, _SHAPE, (6, 6), 4) - 0.5)
    film = ramp(clouds(rng, _SHAPE, (30, 30), 3), 0.66, 0.74)
    return trace - 0.35 * film


def _in_levels(wear: Callable[[np.random.Generator], Field]) -> Callable[[np.random.Generator], Pixels]:
    return lambda rng: levels(255.0 * wear(rng))


WEAR: Bakers = {
    "wear_fresh.png": _in_levels(_fresh),
    "wear_worn.png": _in_levels(_worn),
    "wear_gone.png": _in_levels(_gone),
    "wear_ghost.png": _in_levels(_ghost),
}
