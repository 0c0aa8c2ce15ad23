"""Rasterisation of a drawing to an image."""

import math
from functools import lru_cache
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from garage2usd.view.drawing import Disc, Drawing, Line, Region, Text

__all__ = ["to_image", "write_png"]

_LEAST_LETTERS_PX = 6
_ROOM_PX = 2
"""Padding in pixels around text, which may exceed its nominal width."""
_SHADES = 3
"""Number of shades at the rim of a letter."""
_SHADE_OF = [round(round(share / 255 * (_SHADES - 1)) * 255 / (_SHADES - 1)) for share in range(256)]
_COMPRESSION, _COMPRESSION_OF_LARGE = 8, 7
"""Compression levels of zlib. A plan of 7 x 9 squares takes 35 KB and 32 ms with 8, 43 KB and 17 ms with 7, 34 KB and
74 ms with 9; one of 20 x 30 takes 214 KB and 240 ms with 8, 239 KB and 100 ms with 7, the difference being
1 % of its stage."""
_LARGE_PX = 4_000_000


def to_image(drawing: Drawing) -> Image.Image:
    """Rasterise a drawing as RGB; text lower than 6 pixels is left out.

    Notes
    -----
    The same drawing gives the same pixels.
    """
    (left, top), (right, bottom), scale = drawing.low, drawing.high, drawing.px_per_m
    image = Image.new("RGB", (round((right - left) * scale), round((bottom - top) * scale)), drawing.paper)
    draw = ImageDraw.Draw(image)

    def pixel(point: tuple[float, float]) -> tuple[float, float]:
        return (point[0] - left) * scale, (point[1] - top) * scale

    for element in drawing.elements:
        match element:
            case Region():
                draw.polygon([pixel(point) for point in element.points], fill=element.fill)
            case Line():
                width = max(1, round(element.width_m * scale))
                draw.line([pixel(point) for point in element.points], fill=element.colour, width=width, joint="curve")
            case Disc():
                width = max(1, round(element.rim_width_m * scale))
                draw.circle(pixel(element.centre), element.radius_m * scale, element.fill, element.rim, width)
            case Text():
                _write(image, element, pixel(element.at), round(element.height_m * scale))
    return image


def write_png(image: Image.Image, path: Path) -> None:
    """Write an image as a PNG with a palette of 256 colours, at half the bytes and time of true colour.

    The colour of an area changes by at most one step of 255, and that of a letter's rim by few more.
    """
    few = image.quantize(256, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    if few.width * few.height > _LARGE_PX:
        few.save(path, format="PNG", compress_level=_COMPRESSION_OF_LARGE)
        return
    # only the used entries: a full palette takes 0.6 KB more
    used = [colour for colour, pixels in enumerate(few.histogram()) if pixels]
    few.remap_palette(used).save(path, format="PNG", compress_level=_COMPRESSION)


def _write(image: Image.Image, text: Text, at: tuple[float, float], size_px: int) -> None:
    """Draw text in few shades at whole pixels, since the rims of letters make up most of a plan's bytes."""
    if size_px < _LEAST_LETTERS_PX:
        return
    font = _font(size_px)
    width = math.ceil(font.getlength(text.text)) + 2 * _ROOM_PX
    letters = Image.new("L", (width, 2 * size_px))
    ImageDraw.Draw(letters).text((_ROOM_PX, size_px), text.text, fill=255, font=font, anchor="lm")
    letters = letters.point(_SHADE_OF)
    if text.is_turned:
        letters = letters.transpose(Image.Transpose.ROTATE_90)
    left = at[0] - (_ROOM_PX if text.is_left and not text.is_turned else letters.width / 2)
    image.paste(text.colour, (round(left), round(at[1] - letters.height / 2)), letters)


@lru_cache(maxsize=64)
def _font(size_px: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size=size_px)
