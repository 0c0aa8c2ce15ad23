"""The lines on which the columns and walls of a surveyed garage stand, by which its floor is cut into fields."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.objects.outline import Point
from garage2usd.survey.survey import SurveyedColumn

__all__ = ["OFF_LINE_M", "PIECE_M", "StructuralLines", "structural_lines"]

PIECE_M = 8.1
"""Usual side of a piece of floor."""
OFF_LINE_M = 0.15
"""Greatest distance of a column from the line of its row."""
_MOST_PIECES = 1.5
"""Length of a stretch in usual pieces from which it is cut although no line crosses it."""
_LEAST_SIDE_M = 1.5
"""Least distance between two lines."""
_LEAST_WALL_M = 3.0
"""Least length of a wall that makes a line."""
_AXIS_M = 1e-3


class StructuralLines(NamedTuple):
    """Places of the lines across X and across Z, in metres from the origin, ascending; the first and last are walls."""

    x_m: tuple[float, ...]
    z_m: tuple[float, ...]

    def cuts_m(self, start: Point, end: Point) -> list[float]:
        """Return the distances along a stretch at which it is cut: at the lines across it, and between distant ones.

        Parameters
        ----------
        start, end
            (x, z) of its ends.

        Returns
        -------
        list of float
            Ascending from 0 to its length, which are included.
        """
        length_m = math.dist(start, end)
        found = [0.0]
        for axis, lines in enumerate(self):
            if abs(end[1 - axis] - start[1 - axis]) > _AXIS_M:
                continue
            way = 1 if end[axis] > start[axis] else -1
            found += sorted(run for line in lines if _LEAST_SIDE_M <= (run := way * (line - start[axis])) < length_m)
        found = [run for run in found if length_m - run >= _LEAST_SIDE_M or not run]
        cuts: list[float] = []
        for low, high in pairwise([*found, length_m]):
            parts = math.ceil((high - low) / PIECE_M - 1e-9) if high - low > _MOST_PIECES * PIECE_M else 1
            cuts += [low + (high - low) * part / parts for part in range(parts)]
        return [*cuts, length_m]


def structural_lines(outline: shapely.Polygon, columns: Sequence[SurveyedColumn]) -> StructuralLines:
    """Find the lines of walls along the axes, and of rows of two columns or more.

    Parameters
    ----------
    outline
        Inner faces of the outer walls; its least x and z are 0.
    columns
        The columns.
    """
    corners = shapely.get_coordinates(outline.exterior)
    feet = np.array([column.centre for column in columns]).reshape(-1, 2)
    return StructuralLines(*(_lines_m(feet[:, axis], corners, axis) for axis in (0, 1)))


def _lines_m(feet_m: NDArray[np.float64], corners: NDArray[np.float64], axis: int) -> tuple[float, ...]:
    starts, ends = corners[:-1], corners[1:]
    is_across = np.abs(ends[:, axis] - starts[:, axis]) < _AXIS_M
    is_long = np.linalg.norm(ends - starts, axis=1) >= _LEAST_WALL_M
    last = math.ceil(round(float(corners[:, axis].max()) * 1000, 3)) / 1000
    walls = sorted(starts[is_across & is_long, axis].round(3).tolist())
    ordered = np.sort(feet_m)
    rows = np.split(ordered, np.flatnonzero(np.diff(ordered) > OFF_LINE_M) + 1) if len(ordered) else []
    columns = [round(float(row.mean()), 3) for row in rows if len(row) > 1]
    found = [0.0, last]
    for line in (*walls, *columns):
        if all(abs(line - other) >= _LEAST_SIDE_M for other in found):
            found.append(line)
    return tuple(sorted(found))
