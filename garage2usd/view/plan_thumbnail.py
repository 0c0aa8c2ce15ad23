"""Thumbnail of a plan's squares, for sheets with many plans."""

from collections.abc import Collection, Iterator
from itertools import groupby

import numpy as np

from garage2usd.config.site import DEFAULT_SIDE_M
from garage2usd.garage import LaneKind, StallUse
from garage2usd.objects.outline import rectangle
from garage2usd.planning import measured_circulation
from garage2usd.structure.grid import Cell, CellArray, Structure, edge_neighbour_count, outside_squares
from garage2usd.view.drawing import Colour, Drawing, Line, Point, Region, Text
from garage2usd.view.plan_lanes import DEAD_END, FREE, LANDING, LANE_COLOUR
from garage2usd.view.plan_picture import SOLID, STALL_COLOUR
from garage2usd.view.plan_sheet import PAPER

__all__ = ["THUMBNAIL_COLOURS", "draw_thumbnail"]

THUMBNAIL_COLOURS: dict[str, Colour] = {
    "stalls": STALL_COLOUR[StallUse.STANDARD],
    "lane": LANE_COLOUR[LaneKind.STRAIGHT],
    "dead_end": DEAD_END,
    "entrance": LANE_COLOUR[LaneKind.ENTRANCE],
    "exit": LANE_COLOUR[LaneKind.EXIT],
    "landing": LANDING,
    "free": FREE,
    "obstacle": SOLID,
}
"""Colours of a thumbnail's squares by kind, as in the plan picture."""
_LETTERS = {Cell.ENTRANCE: "E", Cell.EXIT: "X"}
_LETTER: Colour = (255, 255, 255)
_SEAM, _LETTER_HEIGHT = 0.06, 0.8
_PX_PER_SQUARE = 16


def draw_thumbnail(cells: CellArray, title: str, landings: Collection[tuple[int, int]] = ()) -> Drawing:
    """Draw the squares of a plan with sides of one metre, whatever their actual sides.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).
    title
        Title of the drawing.
    landings
        (row, col) of the portals that lead to ramps between levels.

    Notes
    -----
    Free squares beside a lane, which hold stalls, and lanes in dead ends have separate colours. Squares outside the
    garage are left blank.
    """
    rows, cols = cells.shape
    return Drawing(
        (0.0, 0.0), (float(cols), float(rows)), _PX_PER_SQUARE, PAPER, title, list(_elements(cells, landings))
    )


def _elements(cells: CellArray, landings: Collection[tuple[int, int]]) -> Iterator[Region | Line | Text]:
    kinds = _kinds(cells)
    for row, col in landings:
        kinds[row][col] = "landing"
    for row, line in enumerate(kinds):
        for kind, run in groupby(range(len(line)), key=line.__getitem__):
            if kind:
                squares = list(run)
                box = rectangle(squares[0], row, squares[-1] + 1, row + 1)
                yield Region(box, THUMBNAIL_COLOURS[kind], kind)
    rows, cols = cells.shape
    yield Line(_comb(rows, cols), PAPER, _SEAM, "seam")
    yield Line([(x, y) for y, x in _comb(cols, rows)], PAPER, _SEAM, "seam")
    for cell, letter in _LETTERS.items():
        for row, col in np.argwhere(cells == cell).tolist():
            if (row, col) in landings:
                continue
            yield Text((col + 0.5, row + 0.5), letter, _LETTER_HEIGHT, _LETTER, kind="letter")


def _kinds(cells: CellArray) -> list[list[str]]:
    """Kind of each square; empty outside the garage."""
    side_mm = round(1000 * DEFAULT_SIDE_M)
    structure = Structure(cells, np.full(cells.shape[1], side_mm), np.full(cells.shape[0], side_mm))
    is_dead_end = measured_circulation(structure).circulation.rounds > 0
    is_beside = edge_neighbour_count(cells == Cell.LANE) > 0
    kinds = np.select(
        [
            outside_squares(cells),
            cells == Cell.OBSTACLE,
            cells == Cell.ENTRANCE,
            cells == Cell.EXIT,
            (cells == Cell.LANE) & is_dead_end,
            cells == Cell.LANE,
            is_beside,
        ],
        ["", "obstacle", "entrance", "exit", "dead_end", "lane", "stalls"],
        "free",
    )
    found: list[list[str]] = kinds.tolist()
    return found


def _comb(rows: int, cols: int) -> list[Point]:
    """A single polyline along all borders of rows, back and forth."""
    ends = (0.0, float(cols))
    return [(ends[(row + end) % 2], float(row)) for row in range(rows + 1) for end in (0, 1)]
