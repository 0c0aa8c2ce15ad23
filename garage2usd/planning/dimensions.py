"""Widths of columns R and depths of rows C: their choice for given lanes, and tables of them for annealing.

`Sizes` is the input of `sizes.c`, which makes every line of squares as wide as its use requires.
"""
# Over 300 lines: both choose sides by the same rules of aisles, stalls and doors.

import math
from functools import lru_cache
from itertools import compress
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig
from garage2usd.native import Bools, Float64s, Float64Table, Int32Cube, Int64s, Int64Table
from garage2usd.planning.board import Ground, capacity_by_edges
from garage2usd.structure.grid import Cell, CellArray, Mask, Structure
from garage2usd.structure.squares import bordered
from garage2usd.structure.stalls import Edge, capacity_table, door_edges, square_capacity

_MM_PER_M = 1000
_MM2_PER_M2 = _MM_PER_M**2
_PASSES = 8
"""At most; a pass that improves nothing ends them."""
_STALLS_BETWEEN_COLUMNS = (2, 3)
_ROUNDING_M2 = 1e-9


def area_per_stall_m2(structure: Structure, bay: BayConfig) -> float:
    """Floor inside the contour, obstacles apart, over the number of stalls; infinite without stalls."""
    stalls = int(square_capacity(structure, bay).sum())
    return structure.floor_m2 / stalls if stalls else math.inf


def dimension(structure: Structure, *, bay: BayConfig, rows: bool = True, columns: bool = True) -> Structure:
    """Choose R and C of a complete structure.

    Parameters
    ----------
    structure
        A structure with lanes; sizes along an axis that is not to be chosen are kept.
    bay
        Stall size, column size, ``aisle_width_m`` and ``portal_width_m``.
    rows, columns
        True to choose C, and R.

    Returns
    -------
    Structure
        The same S; every aisle is ``aisle_width_m`` wide between columns, every other line of squares as deep as a
        stall is long or as wide as two or three stalls between columns, whichever gives least floor a stall, and every
        line that is crossed by a vehicle door wide enough for it.

    Notes
    -----
    A line of squares is an aisle's if cars drive along it on one of its squares. One line after the other takes the
    size that lowers the area per stall, until none does: once from the shortest sizes and once from the longest, as
    either may end better. A line's trial changes only its own squares, so that only these are counted again.
    """
    aisle, free_sizes = aisle_side_mm(bay), free_sides_mm(bay)
    door = round(bay.portal_side_m * _MM_PER_M)
    is_aisle = lines_with_aisles(structure)
    has_door = lines_with_doors(structure)

    def allowed(axis: int, line: int) -> list[int]:
        least = door if has_door[axis][line] else 0
        sizes = [aisle] if is_aisle[axis][line] else free_sizes
        return sorted({max(size, least) for size in sizes})

    sides = [structure.row_depths_mm.copy(), structure.column_widths_mm.copy()]
    lines = [
        (axis, line, allowed(axis, line))
        for axis, is_chosen in ((0, rows), (1, columns))
        if is_chosen
        for line in range(structure.shape[axis])
    ]
    open_lines = [(axis, line, sizes) for axis, line, sizes in lines if len(sizes) > 1]
    ends = []
    for first in (0, -1):
        for axis, line, sizes in lines:
            sides[axis][line] = sizes[first]
        sized = _Sized(structure.cells, sides, [size for _, _, sizes in lines for size in sizes], bay)
        for _ in range(_PASSES):
            if not sum(sized.improve(*line) for line in open_lines):
                break
        ends.append(sized)
    best = min(ends, key=lambda sized: sized.area_per_stall_m2)
    return Structure(structure.cells, best.side_mm(1), best.side_mm(0))


def dimensioned(structure: Structure, bay: BayConfig) -> Structure:
    """Choose R and C where the settings give none; S stays."""
    rows, columns = bay.chosen_sides
    return dimension(structure, bay=bay, rows=rows, columns=columns) if rows or columns else structure


def lines_with_aisles(structure: Structure) -> tuple[Mask, Mask]:
    """Mark the rows, and the columns, along which cars drive on some square."""
    along_x, along_z = driven_squares(structure.cells)
    return along_x.any(axis=1), along_z.any(axis=0)


def aisle_side_mm(bay: BayConfig) -> int:
    """Side across an aisle of a line of squares."""
    return round(bay.aisle_side_m * _MM_PER_M)


def free_sides_mm(bay: BayConfig) -> list[int]:
    """Possible sides of lines without traffic along them, ascending: a stall's length, the widths of two and three."""
    length, width, ends = (round(side * _MM_PER_M) for side in (bay.stall_length_m, bay.stall_width_m, bay.row_ends_m))
    return sorted({length, *(max(count * width + ends, length) for count in _STALLS_BETWEEN_COLUMNS)})


class _Sized:
    """Squares with their sides; floor and stalls are counted line by line.

    Plain numbers: on such short lines calls of NumPy cost more than their work.
    """

    def __init__(
        self, cells: CellArray, sides_mm: list[NDArray[np.int64]], tried_mm: list[int], bay: BayConfig
    ) -> None:
        """Store the sides by axis, rows first, and the sides that lines may take instead."""
        self._sides_mm: list[list[int]] = [side.tolist() for side in sides_mm]
        self._held = _stalls_held(tuple(sorted({*self._sides_mm[0], *self._sides_mm[1], *tried_mm})), bay)
        inside, service = cells != Cell.OBSTACLE, _service(cells)
        self._inside: list[list[list[bool]]] = [inside.tolist(), inside.T.tolist()]
        self._service: list[list[list[int]]] = [service.tolist(), service.T.tolist()]
        self._area_mm2 = sum(self._sides_mm[0][row] * self._floor_mm(0, row) for row in range(len(cells)))
        self._stalls = sum(self._stalls_on(0, row, self._sides_mm[0][row]) for row in range(len(cells)))

    def side_mm(self, axis: int) -> NDArray[np.int64]:
        """Depths of the rows (0) or widths of the columns (1)."""
        return np.array(self._sides_mm[axis], dtype=np.int64)

    @property
    def area_per_stall_m2(self) -> float:
        """Floor over stalls; infinite without stalls."""
        return _ratio_m2(self._area_mm2, self._stalls)

    def improve(self, axis: int, line: int, sizes_mm: list[int]) -> bool:
        """Give a line the size with the least area per stall, if that is less than now."""
        now = self._sides_mm[axis][line]
        floor, kept = self._floor_mm(axis, line), self._stalls - self._stalls_on(axis, line, now)
        found = [(self._area_mm2 + floor * (size - now), kept + self._stalls_on(axis, line, size)) for size in sizes_mm]
        ratios = [_ratio_m2(*area_and_stalls) for area_and_stalls in found]
        least = min(ratios)
        if not least < self.area_per_stall_m2 - _ROUNDING_M2:
            return False
        best = ratios.index(least)
        self._sides_mm[axis][line] = sizes_mm[best]
        self._area_mm2, self._stalls = found[best]
        return True

    def _floor_mm(self, axis: int, line: int) -> int:
        """Length of the floor on a line."""
        return sum(compress(self._sides_mm[1 - axis], self._inside[axis][line]))

    def _stalls_on(self, axis: int, line: int, side_mm: int) -> int:
        """Count the stalls on a line for another side."""
        held, across = self._held[axis][side_mm], self._sides_mm[1 - axis]
        return sum([held[side][service] for side, service in zip(across, self._service[axis][line], strict=True)])


def _ratio_m2(area_mm2: int, stalls: int) -> float:
    """Floor over stalls; infinite without stalls."""
    return area_mm2 / (stalls * _MM2_PER_M2) if stalls > 0 else math.inf


def _service(cells: CellArray) -> NDArray[np.intp]:
    """Number the service of each square by lanes: edges open along Z times three plus edges open along X."""
    lane, free = bordered(cells == Cell.LANE).astype(np.intp), cells == Cell.FREE
    return np.where(free, 3 * (lane[:-2, 1:-1] + lane[2:, 1:-1]) + lane[1:-1, :-2] + lane[1:-1, 2:], 0)


@lru_cache(maxsize=64)
def _stalls_held(sizes_mm: tuple[int, ...], bay: BayConfig) -> tuple[dict[int, dict[int, list[int]]], ...]:
    """Tabulate the stalls of a square for both axes: by its side along the axis, the one across, and its service."""
    count, sides = len(sizes_mm), np.array(sizes_mm, dtype=np.int64)
    table = capacity_table(Structure(np.zeros((count, count), dtype=np.int8), sides, sides), bay)
    none = np.zeros_like(table.along_x)
    along_x = (none, table.along_x, table.along_x_double)
    along_z = (none, table.along_z, table.along_z_double)
    held = np.stack([np.maximum(one, other) for one in along_x for other in along_z], axis=-1)
    by_axis = (held.tolist(), held.transpose(1, 0, 2).tolist())
    return tuple(
        {side: dict(zip(sizes_mm, across, strict=True)) for side, across in zip(sizes_mm, lines, strict=True)}
        for lines in by_axis
    )


def lines_with_doors(structure: Structure) -> tuple[Mask, Mask]:
    """Mark the rows and the columns with a vehicle door across their end."""
    rows, columns = (np.zeros(count, dtype=np.bool_) for count in structure.shape)
    for (row, col), edge in door_edges(structure.cells).items():
        if edge in {Edge.UP, Edge.DOWN}:
            columns[col] = True
        else:
            rows[row] = True
    return rows, columns


def driven_squares(cells: NDArray[np.int8]) -> tuple[Mask, Mask]:
    """Mark the squares that cars drive on along X, and along Z, and whose width is a lane's; portals count too."""
    lane, drivable = bordered(cells == Cell.LANE), bordered(cells >= Cell.LANE)
    here, here_lane = drivable[1:-1, 1:-1], lane[1:-1, 1:-1]

    def driven(one: Mask, other: Mask, one_lane: Mask, other_lane: Mask) -> Mask:
        joined: Mask = here & np.where(here_lane, one | other, one_lane | other_lane)
        return joined

    along_x = driven(drivable[1:-1, :-2], drivable[1:-1, 2:], lane[1:-1, :-2], lane[1:-1, 2:])
    along_z = driven(drivable[:-2, 1:-1], drivable[2:, 1:-1], lane[:-2, 1:-1], lane[2:, 1:-1])
    return along_x, along_z


class Sizes(NamedTuple):
    """Sides of the lines of squares; axis 0 has rows with their depths C, axis 1 columns with their widths R.

    Attributes
    ----------
    is_chosen
        bool, shape (2,): whether the sides along an axis are chosen with the plan, or given.
    free_mm
        int64: sides of a line without traffic along it.
    aisle_mm
        Side of a line with traffic along it.
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
        int64, shape (2, lines): present side of each line.
    place
        int64, shape (2, lines): index of the present side in `sides_mm`.
    driven
        int64, shape (2, lines): number of squares of each line on which cars drive along it.
    least_mm
        int64, shape (2, lines): the least side of lines with a vehicle door across their end.
    is_floor
        bool, shape (padded,): squares inside the contour that are not obstacles.
    area_m2
        float64, shape (1,): floor of all those squares.
    hint
        float64, shape (2, lines): estimated gain of a line, in stalls, if cars begin or cease to drive along it.
    price
        float64, shape (1,): price of a square metre of floor, in stalls; 0 if no side is chosen.
    change
        int64, shape (3,): change of stalls, time and unused squares by another side of a line.
    """

    is_chosen: Bools
    free_mm: Int64s
    aisle_mm: int
    sides_mm: Int64s
    held: Int32Cube
    line_of: Int64Table
    kept_mm: Int64Table
    actual_mm: Int64Table
    place: Int64Table
    driven: Int64Table
    least_mm: Int64Table
    is_floor: Bools
    area_m2: Float64s
    hint: Float64Table
    price: Float64s
    change: Int64s


def sizes_of(ground: Ground, bay: BayConfig) -> Sizes:
    """Set up the sides of a ground: chosen where the settings give none, else kept."""
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
    given = actual[actual > 0]  # without squares outside the contour
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
