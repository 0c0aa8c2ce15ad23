"""The ramps between levels on the plan of a level: treads, an arrow in the direction of driving, and where it leads."""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from garage2usd.layout import Layout
from garage2usd.view.drawing import Line, Point, Region, Text
from garage2usd.view.plan_access import RAMP
from garage2usd.view.plan_lanes import LINE_M
from garage2usd.view.plan_sheet import INK, PAPER, Sheet

__all__ = ["level_title", "wells"]

_TREAD_M = 0.8
_ARROW_M, _WING_M = 6.0, 0.9
_ARROW_PARTS = 6
_STROKE_M = 0.25
_WORD_ASIDE_M = 1.6


def level_title(layout: Layout) -> str:
    """Return the level of a layout as the beginning of its title; empty in a garage of one level."""
    return f"{layout.well.name}: " if layout.well else ""


def wells(layout: Layout, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw the ramps that begin or end on a level."""
    if layout.well is None:
        return
    columns, rows = (edges.tolist() for edges in (layout.structure.column_edges_m, layout.structure.row_edges_m))
    for row, col in layout.landings:
        middle = (columns[col] + columns[col + 1]) / 2, (rows[row] + rows[row + 1]) / 2
        yield Text(middle, "landing", sheet.letters_m, INK, kind="landing")
    down, up = layout.well.lanes(layout.structure)
    for lane, is_down in ((down, True), (up, False)):
        line = _Line([(x, z) for x, _, z in lane.points])
        half, run = lane.width_m / 2, line.length_m
        left, right = line.beside(-half), line.beside(half)
        yield from (
            Region([a, b, c, d], RAMP, "ramp") for (a, b), (d, c) in zip(pairwise(left), pairwise(right), strict=True)
        )
        for number in range(1, math.ceil(run / _TREAD_M)):
            tread = [line.at(number * _TREAD_M, -half), line.at(number * _TREAD_M, half)]
            yield Line(tread, PAPER, LINE_M / 2, "ramp")
        tail, tip = (run - _ARROW_M) / 2, (run + _ARROW_M) / 2
        shaft = [line.at(tail + share * _ARROW_M / _ARROW_PARTS, 0) for share in range(_ARROW_PARTS + 1)]
        yield Line(shaft, INK, _STROKE_M, "direction")
        wings = [line.at(tip - _WING_M, -_WING_M), line.at(tip, 0), line.at(tip - _WING_M, _WING_M)]
        yield Line(wings, INK, _STROKE_M, "direction")
        word = ("down" if is_down else "up") + layout.well.way_in_words(is_down=is_down)
        # inside a turn, or beside the arrow
        place = line.middle if math.dist(line.middle, line.at(run / 2, 0)) > lane.width_m else None
        yield Text(place or line.at(run / 2, _WORD_ASIDE_M), word, sheet.letters_m, INK, kind="ramp")


class _Line:
    """A line of straight pieces, with places along it and to its right."""

    def __init__(self, points: list[Point]) -> None:
        self._points = np.array(points)
        steps = np.diff(self._points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        self._runs = np.concatenate([[0.0], np.cumsum(lengths)])
        ways = steps / lengths[:, None]
        mean = np.concatenate([ways[:1], ways[:-1] + ways[1:], ways[-1:]])
        self._along = mean / np.linalg.norm(mean, axis=1, keepdims=True)

    @property
    def length_m(self) -> float:
        return float(self._runs[-1])

    @property
    def middle(self) -> Point:
        """Mean of the places along the line."""
        steps = np.diff(self._runs)[:, None]
        x, z = ((self._points[:-1] + self._points[1:]) / 2 * steps).sum(axis=0) / self.length_m
        return float(x), float(z)

    def beside(self, aside: float) -> list[Point]:
        """Return the corners of the line moved to the right."""
        moved = self._points + aside * np.stack([-self._along[:, 1], self._along[:, 0]], axis=1)
        return [(float(x), float(z)) for x, z in moved]

    def at(self, forward: float, aside: float) -> Point:
        """Return the point at a distance along the line and to its right."""
        x, z, along_x, along_z = (
            float(np.interp(forward, self._runs, values)) for values in (*self._points.T, *self._along.T)
        )
        return x - aside * along_z, z + aside * along_x
