"""R and C while lanes are annealed: each line of squares is as wide as what it holds asks for. In C, `sizes.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.config import BayConfig
from garage2usd.native import Bools, Float64s, Int32s, Int64s
from garage2usd.planning.dimensions import aisle_side_mm, free_sides_mm
from garage2usd.planning.ground import Ground, capacity_by_edges
from garage2usd.structure.grid import Cell, Structure

__all__ = ["Sizes", "sizes_of"]

_MM_PER_M = 1000


class Sizes(NamedTuple):
    """The sides of the lines of squares; axis 0 has rows with their depths C, axis 1 columns with their widths R.

    Attributes
    ----------
    is_chosen
        bool, shape (2,): whether the sides along an axis are chosen with the plan, or given.
    free_mm
        int64: what a line may be where no car drives along it.
    aisle_mm
        What it is where one does.
    sides_mm
        int64: all sides that a line may have, ascending.
    held
        int32, shape (sides, sides, 16): stalls on a square by the places of its depth and its width in `sides_mm` and
        by its edges open to lanes, as in `Ground.capacity`.
    line_of
        int64, shape (2, padded): row and column of each square.
    kept_mm
        int64, shape (2, lines): side of each line while no car drives along it.
    actual_mm
        int64, shape (2, lines): its side now.
    place
        int64, shape (2, lines): the place of that in `sides_mm`.
    driven
        int64, shape (2, lines): on how many of its squares cars drive along it.
    least_mm
        int64, shape (2, lines): the least side of lines with a vehicle door across their end.
    is_floor
        bool, shape (padded,): squares inside the contour that are not obstacles.
    area_m2
        float64, shape (1,): floor of all those squares.
    hint
        float64, shape (2, lines): what a line is likely to gain, in stalls, if cars begin or cease to drive along it.
    price
        float64, shape (1,): what a square metre of floor costs, in stalls; 0 where no side is chosen.
    change
        int64, shape (3,): what another side of a line would add to stalls, time and unused squares.
    """

    is_chosen: Bools
    free_mm: Int64s
    aisle_mm: int
    sides_mm: Int64s
    held: Int32s
    line_of: Int64s
    kept_mm: Int64s
    actual_mm: Int64s
    place: Int64s
    driven: Int64s
    least_mm: Int64s
    is_floor: Bools
    area_m2: Float64s
    hint: Float64s
    price: Float64s
    change: Int64s


def sizes_of(ground: Ground, bay: BayConfig) -> Sizes:
    """The sides of a ground: chosen where the settings say so and give none, else as they are."""
    rows = len(ground.cells) // ground.stride
    sides = ground.sides_mm.reshape(rows, ground.stride, 2)
    lines = max(rows, ground.stride)
    actual = np.zeros((2, lines), np.int64)
    actual[0, :rows], actual[1, : ground.stride] = sides[:, :, 0].max(axis=1), sides[:, :, 1].max(axis=0)
    is_chosen = np.array(bay.chosen_sides)
    free, aisle = np.array(free_sides_mm(bay), np.int64), aisle_side_mm(bay)
    kept = actual.copy()
    kept[is_chosen] = free[-1]
    least = _door_sides(ground, bay, lines)
    asked = np.append(free, aisle)
    given = actual[actual > 0]  # not of the squares outside
    sides = np.unique(np.concatenate([asked, np.maximum.outer(asked, np.unique(least)).ravel(), given]))
    square = Structure(np.zeros((len(sides), len(sides)), np.int8), sides, sides)
    return Sizes(
        is_chosen,
        free,
        aisle,
        sides,
        capacity_by_edges(square, bay),
        np.array(np.divmod(np.arange(len(ground.cells)), ground.stride)),
        kept,
        actual,
        np.searchsorted(sides, actual),
        np.zeros((2, lines), np.int64),
        least,
        ground.cells != Cell.OBSTACLE,
        np.zeros(1),
        np.zeros((2, lines)),
        np.zeros(1),
        np.zeros(3, np.int64),
    )


def _door_sides(ground: Ground, bay: BayConfig, lines: int) -> Int64s:
    """Least sides of the lines that end in a portal on the border of the site's squares."""
    least = np.zeros((2, lines), np.int64)
    door = round(bay.portal_side_m * _MM_PER_M)
    for portal in ground.portals.tolist():
        row, col = divmod(portal, ground.stride)
        if Cell.OBSTACLE in {ground.cells[portal - ground.stride], ground.cells[portal + ground.stride]}:
            least[1, col] = door
        else:
            least[0, row] = door
    return least
