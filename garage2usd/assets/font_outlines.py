"""Outlines of the characters of a font as polygons."""

from collections.abc import Iterable

import numpy as np
import shapely
from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont

Point = tuple[float, float]

_CURVE_STEPS = 8


def outline_of(font: TTFont, character: str) -> tuple[shapely.Geometry, float] | None:
    """Return the outline of a character and its advance, in units of the font with y upwards.

    None if the font lacks the character, or its outline is damaged or empty.
    """
    try:
        name = font.getBestCmap().get(ord(character))
        if name is None or name == ".notdef":
            return None
        glyphs = font.getGlyphSet()
        pen = _ContourPen(glyphs)
        glyphs[name].draw(pen)
        outline, advance = _filled(pen.contours), float(glyphs[name].width)
    except Exception:  # noqa: BLE001 - a damaged font raises a dozen kinds
        return None
    return None if outline.is_empty or advance <= 0 else (outline, advance)


class _ContourPen(BasePen):  # type: ignore[misc]
    """A pen that keeps each contour as points, with curves as chords."""

    def __init__(self, glyphs: object) -> None:
        super().__init__(glyphs)
        self.contours: list[list[Point]] = []

    def _moveTo(self, point: Point) -> None:  # noqa: N802 - of fontTools
        self.contours.append([point])

    def _lineTo(self, point: Point) -> None:  # noqa: N802
        self.contours[-1].append(point)

    def _curveToOne(self, first: Point, second: Point, end: Point) -> None:  # noqa: N802
        ends = np.array([self.contours[-1][-1], first, second, end])
        at = np.linspace(0, 1, _CURVE_STEPS + 1)[1:, None]
        weights = np.hstack([(1 - at) ** 3, 3 * at * (1 - at) ** 2, 3 * at**2 * (1 - at), at**3])
        self.contours[-1] += [(x, y) for x, y in (weights @ ends).tolist()]


def _filled(contours: Iterable[list[Point]]) -> shapely.Geometry:
    """Fill contours: those turned like the largest are ground, the others holes, each in the larger ones around it."""
    rings = [shapely.Polygon(contour) for contour in contours if len(contour) > 2]  # noqa: PLR2004 - a triangle
    rings.sort(key=lambda ring: -ring.area)
    outline = shapely.Polygon()
    for ring in rings:
        combine = shapely.union if ring.exterior.is_ccw == rings[0].exterior.is_ccw else shapely.difference
        outline = combine(outline, shapely.make_valid(ring))
    return outline
