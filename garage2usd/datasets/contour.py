"""The shape of a garage's contour: rectangle, L, T, U, or other."""

from enum import StrEnum
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.structure.grid import CellArray, Mask, outside_squares

__all__ = ["ContourShape", "contour_shape"]


class ContourShape(StrEnum):
    """What a contour looks like, however it is turned."""

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
"""By the corners in turn, 1 where it juts out and 0 where it is re-entrant, from where the numeral is least."""


def contour_shape(cells: CellArray) -> ContourShape:
    """The shape of a contour by the corners of its outline, one after the other.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Notes
    -----
    A rectangle has four corners that jut out. An L has one re-entrant corner besides. Of the two of a U nothing lies
    between, as the recess has them at its bottom; between the two of a T lie the two corners of its stem. Everything
    else, also a step or a Z, is other. Squares on the ground plan count, not metres; obstacles inside do not count.
    """
    return _SHAPE_OF.get(_least_turned(_corners(~outside_squares(cells))), ContourShape.OTHER)


def _corners(is_inside: Mask) -> str:
    """The corners of an outline in turn, as in `_SHAPE_OF`; empty where it is not one ring."""
    rows, cols = np.nonzero(is_inside)
    ground = shapely.union_all(shapely.box(cols, rows, cols + 1, rows + 1))
    if not isinstance(ground, shapely.Polygon) or ground.is_empty or ground.interiors:
        return ""
    ring = [*shapely.orient_polygons(ground).exterior.coords]
    steps = [(x - before_x, y - before_y) for (before_x, before_y), (x, y) in pairwise([*ring, ring[1]])]
    turns = [x * next_y - y * next_x for (x, y), (next_x, next_y) in pairwise(steps)]
    return "".join(str(int(turn > 0)) for turn in turns if turn)


def _least_turned(corners: str) -> str:
    """The same corners from where they read as the least numeral, in the direction in which they do."""
    both = (corners, corners[::-1])
    return min((way[start:] + way[:start] for way in both for start in range(len(way))), default="")
