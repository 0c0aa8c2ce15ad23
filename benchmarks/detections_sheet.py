"""Contact sheets of strips with the corners that a network found and missed."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from average_precision import Detections, matched
from PIL import Image, ImageDraw
from strips import SIZE_PX, Strip

__all__ = ["FALSE", "HIDDEN", "HIT", "MISSED", "write_pictures", "write_sheet"]

_COLUMNS, _ROWS = 16, 3
_GAP_PX, _RADIUS_PX = 4, 4
HIT, MISSED, FALSE, HIDDEN = (0, 230, 0), (255, 40, 40), (255, 220, 0), (90, 140, 255)


def write_sheet(strips: Sequence[Strip], found: Sequence[Detections], threshold: float, path: Path) -> None:
    """Draw strips from all over a list with the corners that were found in them.

    Green rings are corners that were found, red ones were missed, and yellow crosses are at none; blue rings are
    occluded corners, which do not count.

    Parameters
    ----------
    strips, found
        The strips, and the corners that are found in each.
    threshold
        What is less sure than this is left out.
    path
        A PNG.
    """
    write_pictures(len(strips), lambda number: _marked(strips[number], found[number], threshold), path)


def write_pictures(count: int, picture: Callable[[int], Image.Image], path: Path) -> None:
    """Write a sheet of some pictures of a size with strips, from all over a list of so many."""
    shown = min(count, _COLUMNS * _ROWS)
    chosen = np.linspace(0, count - 1, shown).round().astype(int).tolist()
    width, height = (side + _GAP_PX for side in SIZE_PX)
    rows = -(-shown // _COLUMNS)
    sheet = Image.new("RGB", (width * min(shown, _COLUMNS), height * rows), "white")
    for place, number in enumerate(chosen):
        sheet.paste(picture(number), (place % _COLUMNS * width, place // _COLUMNS * height))
    sheet.save(path, optimize=True)


def _marked(strip: Strip, found: Detections, threshold: float) -> Image.Image:
    sure = found.confidence >= threshold
    result = matched(Detections(found.places_px[sure], found.confidence[sure]), strip.corners_px, strip.is_occluded)
    picture = Image.fromarray(strip.pixels)
    draw = ImageDraw.Draw(picture)
    hit = set(result.owner.tolist())
    for number, corner in enumerate(strip.seen_px.tolist()):
        _ring(draw, corner, HIT if number in hit else MISSED)
    for corner in strip.corners_px[strip.is_occluded].tolist():
        _ring(draw, corner, HIDDEN)
    for x, y in result.places_px[~result.is_hit].tolist():
        draw.line((x - _RADIUS_PX, y - _RADIUS_PX, x + _RADIUS_PX, y + _RADIUS_PX), fill=FALSE)
        draw.line((x - _RADIUS_PX, y + _RADIUS_PX, x + _RADIUS_PX, y - _RADIUS_PX), fill=FALSE)
    return picture


def _ring(draw: ImageDraw.ImageDraw, corner: Sequence[float], colour: tuple[int, int, int]) -> None:
    x, y = corner
    draw.ellipse((x - _RADIUS_PX, y - _RADIUS_PX, x + _RADIUS_PX, y + _RADIUS_PX), outline=colour)
