"""Images of worn paint: wear as an index, its colour as a palette."""

import struct
import zlib
from bisect import bisect_right
from collections.abc import Iterator

from garage2usd.common.errors import ConfigError

__all__ = ["WEAR_STEPS", "painted", "wear_palette"]

Rgb = tuple[float, float, float]

WEAR_STEPS = 16
"""Number of indices: 0 is fresh paint, the last the bare ground."""
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_LENGTH = struct.Struct(">I")
_PALETTE = b"PLTE"
_SHORTEST = 12
"""Bytes of a PNG chunk without data: length, type and checksum."""


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
