"""R and C while lanes are annealed: each line of squares is as wide as what it holds asks for. Compiled."""
# ruff: noqa: PLR2004 - bits of edges

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled
from garage2usd.config import BayConfig
from garage2usd.grid import Cell
from garage2usd.planning.board import Board, stalls_at
from garage2usd.planning.dimensioning import aisle_side_mm, free_sides_mm
from garage2usd.planning.ground import Ground

__all__ = ["ALONG_X", "ALONG_Z", "Sizes", "driven_ways", "resize", "settle", "sizes_of", "sync"]

ALONG_X, ALONG_Z = 1, 2
_STALLS, _TIME, _UNUSED = 0, 1, 2
_MM2_PER_M2 = 1.0e6


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
    stall_mm
        int64, shape (3,): stall width, stall length, column.
    kept_mm
        int64, shape (2, lines): side of each line while no car drives along it.
    actual_mm
        int64, shape (2, lines): its side now.
    driven
        int64, shape (2, lines): on how many of its squares cars drive along it.
    is_floor
        bool, shape (padded,): squares inside the contour that are no obstacle.
    area_m2
        float64, shape (1,): floor of all those squares.
    price
        What a square metre of floor costs, in stalls; 0 where no side is chosen.
    """

    is_chosen: NDArray[np.bool_]
    free_mm: NDArray[np.int64]
    aisle_mm: int
    stall_mm: NDArray[np.int64]
    kept_mm: NDArray[np.int64]
    actual_mm: NDArray[np.int64]
    driven: NDArray[np.int64]
    is_floor: NDArray[np.bool_]
    area_m2: NDArray[np.float64]
    price: NDArray[np.float64]


def sizes_of(ground: Ground, bay: BayConfig) -> Sizes:
    """The sides of a ground: chosen where the settings say so and give none, else as they are."""
    rows = len(ground.cells) // ground.stride
    sides = ground.sides_mm.reshape(rows, ground.stride, 2)
    lines = max(rows, ground.stride)
    actual = np.zeros((2, lines), np.int64)
    actual[0, :rows], actual[1, : ground.stride] = sides[:, :, 0].max(axis=1), sides[:, :, 1].max(axis=0)
    is_chosen = np.array([bay.row_depths_m is None, bay.column_widths_m is None]) & bay.is_dimensioned
    kept = actual.copy()
    kept[is_chosen] = free_sides_mm(bay)[-1]
    stall = np.array([round(side * 1000) for side in (bay.stall_width_m, bay.stall_length_m, bay.column_size_m)])
    return Sizes(
        is_chosen,
        np.array(free_sides_mm(bay), np.int64),
        aisle_side_mm(bay),
        stall.astype(np.int64),
        kept,
        actual,
        np.zeros((2, lines), np.int64),
        ground.cells != Cell.OBSTACLE,
        np.zeros(1),
        np.zeros(1),
    )


@compiled
def driven_ways(cells: NDArray[np.int8], stride: int, q: int) -> int:
    """Whether cars drive along X on a square, and along Z, as a sum of `ALONG_X` and `ALONG_Z`."""
    least = 1 if cells[q] == 1 else 2
    ways = 0
    if cells[q] == 1:
        ways |= ALONG_X * (cells[q - 1] >= 1 or cells[q + 1] >= 1)
        ways |= ALONG_Z * (cells[q - stride] >= 1 or cells[q + stride] >= 1)
    elif cells[q] >= least:
        ways |= ALONG_X * (cells[q - 1] == 1 or cells[q + 1] == 1)
        ways |= ALONG_Z * (cells[q - stride] == 1 or cells[q + stride] == 1)
    return ways


@compiled
def _set_capacity(ground: Ground, sizes: Sizes, q: int) -> None:
    """Write what a square holds by its open edges into `ground.capacity`."""
    depth, width = sizes.actual_mm[0, q // ground.stride], sizes.actual_mm[1, q % ground.stride]
    stall_width, stall_length, column = sizes.stall_mm[0], sizes.stall_mm[1], sizes.stall_mm[2]
    single_x = max(width - column, 0) // stall_width if depth >= stall_length else 0
    single_z = max(depth - column, 0) // stall_width if width >= stall_length else 0
    double_x = 2 * single_x if depth >= 2 * stall_length else single_x
    double_z = 2 * single_z if width >= 2 * stall_length else single_z
    for edges in range(16):
        x, z = edges & 3, edges >> 2
        along_x = 0 if x == 0 else (double_x if x == 3 else single_x)
        along_z = 0 if z == 0 else (double_z if z == 3 else single_z)
        ground.capacity[q, edges] = max(along_x, along_z)


@compiled
def _line(ground: Ground, axis: int, line: int) -> tuple[int, int, int]:
    """First square of a line, the step along it, and the square after its last."""
    if axis == 0:
        return line * ground.stride, 1, (line + 1) * ground.stride
    return line, ground.stride, len(ground.cells)


@compiled
def resize(ground: Ground, board: Board, sizes: Sizes, axis: int, line: int, side_mm: int, change: NDArray[np.int64]) -> float:  # noqa: E501
    """Give a line another side; adds what stalls, time and unused squares change by, returns the floor added in m2."""
    first, step, last = _line(ground, axis, line)
    longer = side_mm - sizes.actual_mm[axis, line]
    area = 0.0
    for sign in (-1, 1):
        if sign == 1:
            sizes.actual_mm[axis, line] = side_mm
        for q in range(first, last, step):
            if not sizes.is_floor[q]:
                continue
            if sign == 1:
                _set_capacity(ground, sizes, q)
                across = sizes.actual_mm[1, q % ground.stride] if axis == 0 else sizes.actual_mm[0, q // ground.stride]
                area += longer * across / _MM2_PER_M2
            if board.cells[q] == 0:
                count, near = stalls_at(ground, board, q)
                change[_STALLS] += sign * count
                change[_UNUSED] += sign * (count == 0)
                if count > 0:
                    change[_TIME] += sign * count * (1 + near)
    sizes.area_m2[0] += area
    return area


@compiled
def sync(ground: Ground, board: Board, sizes: Sizes) -> None:
    """Count anew where cars drive, and give every line the side that follows."""
    if not (sizes.is_chosen[0] or sizes.is_chosen[1]):
        return
    stride = ground.stride
    for axis in range(2):
        for line in range(sizes.driven.shape[1]):
            sizes.driven[axis, line] = 0
    for q in range(stride, len(board.cells) - stride):
        if board.cells[q] >= 1:
            ways = driven_ways(board.cells, stride, q)
            sizes.driven[0, q // stride] += ways & ALONG_X
            sizes.driven[1, q % stride] += ways >> 1
    changed = sizes.area_m2[0] == 0
    for axis in range(2):
        if not sizes.is_chosen[axis]:
            continue
        count = len(board.cells) // stride if axis == 0 else stride
        for line in range(count):
            side = sizes.aisle_mm if sizes.driven[axis, line] > 0 else sizes.kept_mm[axis, line]
            if side != sizes.actual_mm[axis, line]:
                sizes.actual_mm[axis, line] = side
                changed = True
    if not changed:
        return
    area = 0.0
    for q in range(stride, len(board.cells) - stride):
        if sizes.is_floor[q]:
            _set_capacity(ground, sizes, q)
            area += sizes.actual_mm[0, q // stride] * sizes.actual_mm[1, q % stride] / _MM2_PER_M2
    sizes.area_m2[0] = area


@compiled
def settle(ground: Ground, board: Board, sizes: Sizes, passes: int) -> None:
    """Choose the side of every line without driven squares, one after the other, for most stalls less the floor's price.

    The hops of the board are to be those of its lanes.
    """
    sync(ground, board, sizes)
    change = np.zeros(3, np.int64)
    for _ in range(passes):
        for axis in range(2):
            if not sizes.is_chosen[axis]:
                continue
            count = len(board.cells) // ground.stride if axis == 0 else ground.stride
            for line in range(count):
                if sizes.driven[axis, line] > 0:
                    continue
                best, kept = 0.0, sizes.actual_mm[axis, line]
                change[:] = 0
                area = 0.0
                for side in sizes.free_mm:
                    area += resize(ground, board, sizes, axis, line, side, change)
                    gain = change[_STALLS] - sizes.price[0] * area
                    if gain > best + 1e-9:
                        best, kept = gain, side
                resize(ground, board, sizes, axis, line, kept, change)
                sizes.kept_mm[axis, line] = kept
