"""Classification of a garage's contour: rectangle, L, T, U or other."""

from enum import StrEnum
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.structure.grid import CellArray, Mask, outside_squares

__all__ = ["ContourShape", "contour_shape"]


class ContourShape(StrEnum):
    """Shape of a garage's contour, independent of rotation and reflection."""

    RECTANGLE = "rectangle"
    L = "L"
    T = "T"
    U = "U"
    OTHER = "other"


_SHAPE_OF = {
    "1111": ContourShape.RECTANGLE,
    "011111": ContourShape.L,
    "01101111": ContourShape.T,
    "00111111": ContourShape.U,
}
"""Contour shapes by their sequence of corners, 1 convex and 0 reflex, rotated to the least numeral."""


def contour_shape(cells: CellArray) -> ContourShape:
    """Classify the contour of a garage by the sequence of its corners.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Notes
    -----
    A rectangle has four convex corners; an L has one reflex corner in addition. The two reflex corners of a U are
    adjacent, at the bottom of its recess. Those of a T have the two corners of its stem between them. Every other
    shape, such as a step or a Z, is other. The contour is that of squares, not metres; obstacles inside are ignored.
    """
    return _SHAPE_OF.get(_least_turned(_corners(~outside_squares(cells))), ContourShape.OTHER)


def _corners(is_inside: Mask) -> str:
    """Return the corners of an outline in order, as in `_SHAPE_OF`; empty unless the outline is a single ring."""
    rows, cols = np.nonzero(is_inside)
    ground = shapely.union_all(shapely.box(cols, rows, cols + 1, rows + 1))
    if not isinstance(ground, shapely.Polygon) or ground.is_empty or ground.interiors:
        return ""
    ring = [*shapely.orient_polygons(ground).exterior.coords]
    steps = [(x - before_x, y - before_y) for (before_x, before_y), (x, y) in pairwise([*ring, ring[1]])]
    turns = [x * next_y - y * next_x for (x, y), (next_x, next_y) in pairwise(steps)]
    return "".join(str(int(turn > 0)) for turn in turns if turn)


def _least_turned(corners: str) -> str:
    """Rotate and reflect a sequence of corners to its least numeral."""
    both = (corners, corners[::-1])
    return min((way[start:] + way[:start] for way in both for start in range(len(way))), default="")
