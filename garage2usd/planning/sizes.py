"""R and C while lanes are annealed: each line of squares is as wide as what it holds asks for. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0912 - bits of edges, and loops over two axes

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled_inlined, compiled_inner, copy_row
from garage2usd.config import BayConfig
from garage2usd.planning.board import FAR, Board
from garage2usd.planning.dimensioning import aisle_side_mm, free_sides_mm
from garage2usd.planning.ground import Ground, capacity_by_edges
from garage2usd.structure.grid import Cell, Structure

__all__ = [
    "ALONG_X",
    "ALONG_Z",
    "Sizes",
    "copy_sides",
    "driven_ways",
    "floor_cost",
    "foresee",
    "resize",
    "settle",
    "side_now",
    "sizes_of",
    "sync",
    "weigh",
]

ALONG_X, ALONG_Z = 1, 2
_STALLS, _TIME, _UNUSED = 0, 1, 2
_MM_PER_M, _MM2_PER_M2 = 1000, 1.0e6


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

    is_chosen: NDArray[np.bool_]
    free_mm: NDArray[np.int64]
    aisle_mm: int
    sides_mm: NDArray[np.int64]
    held: NDArray[np.int32]
    line_of: NDArray[np.int64]
    kept_mm: NDArray[np.int64]
    actual_mm: NDArray[np.int64]
    place: NDArray[np.int64]
    driven: NDArray[np.int64]
    least_mm: NDArray[np.int64]
    is_floor: NDArray[np.bool_]
    area_m2: NDArray[np.float64]
    hint: NDArray[np.float64]
    price: NDArray[np.float64]
    change: NDArray[np.int64]


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


def _door_sides(ground: Ground, bay: BayConfig, lines: int) -> NDArray[np.int64]:
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


@compiled_inlined
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


@compiled_inner
def _set_capacity(ground: Ground, sizes: Sizes, q: int) -> None:
    """Write what a square holds by its open edges into `ground.capacity`."""
    depth, width = sizes.place[0, sizes.line_of[0, q]], sizes.place[1, sizes.line_of[1, q]]
    copy_row(ground.capacity[q], sizes.held[depth, width])


@compiled_inlined
def _place_of(sizes: Sizes, side_mm: int) -> int:
    """The place of a side in `sides_mm`."""
    place = 0
    while sizes.sides_mm[place] != side_mm:
        place += 1
    return place


@compiled_inlined
def _line(ground: Ground, axis: int, line: int) -> tuple[int, int, int]:
    """First square of a line, the step along it, and the square after its last."""
    if axis == 0:
        return line * ground.stride, 1, (line + 1) * ground.stride
    return line, ground.stride, len(ground.cells)


@compiled_inner
def weigh(ground: Ground, board: Board, sizes: Sizes, axis: int, line: int, side_mm: int) -> float:
    """Set `change` to what another side of a line would add; returns the floor that it would add, in m2."""
    cells, stride, change = board.cells, ground.stride, sizes.change
    for figure in range(3):
        change[figure] = 0
    first, step, last = _line(ground, axis, line)
    across, place = 0, _place_of(sizes, side_mm)
    for index in range((last - first + step - 1) // step):
        q = first + index * step
        if not sizes.is_floor[q]:
            continue
        # the index on a line is the number of the line across
        across += sizes.actual_mm[1 - axis, index]
        if cells[q] != 0:
            continue
        edges, near = np.int64(0), FAR
        for way in range(4):
            p = q + (-stride, stride, -1, 1)[way]
            if cells[p] == 1:
                edges |= 1 << way
                near = min(near, board.hops[p])
        if edges == 0:
            continue
        before = ground.capacity[q, edges]
        other = sizes.place[1 - axis, index]
        after = sizes.held[place, other, edges] if axis == 0 else sizes.held[other, place, edges]
        change[_STALLS] += after - before
        change[_TIME] += (after - before) * (1 + near)
        change[_UNUSED] += (after == 0) - (before == 0)
    return float((side_mm - sizes.actual_mm[axis, line]) * across / _MM2_PER_M2)


@compiled_inner
def resize(ground: Ground, sizes: Sizes, axis: int, line: int, side_mm: int) -> None:
    """Give a line another side."""
    first, step, last = _line(ground, axis, line)
    longer = side_mm - sizes.actual_mm[axis, line]
    sizes.actual_mm[axis, line] = side_mm
    sizes.place[axis, line] = _place_of(sizes, side_mm)
    across = 0
    for index in range((last - first + step - 1) // step):
        q = first + index * step
        if sizes.is_floor[q]:
            _set_capacity(ground, sizes, q)
            across += sizes.actual_mm[1 - axis, index]
    sizes.area_m2[0] += longer * across / _MM2_PER_M2


@compiled_inner
def sync(ground: Ground, board: Board, sizes: Sizes) -> None:
    """Count anew where cars drive, and give every line the side that follows."""
    if not (sizes.is_chosen[0] or sizes.is_chosen[1]):
        return
    stride = ground.stride
    for axis in range(2):
        for line in range(sizes.driven.shape[1]):
            sizes.driven[axis, line] = 0
    for squares in (ground.squares, ground.portals):
        for q in squares:
            if board.cells[q] >= 1:
                ways = driven_ways(board.cells, stride, q)
                sizes.driven[0, sizes.line_of[0, q]] += ways & ALONG_X
                sizes.driven[1, sizes.line_of[1, q]] += ways >> 1
    is_new = sizes.area_m2[0] == 0
    for axis in range(2):
        if not sizes.is_chosen[axis]:
            continue
        for line in range(len(board.cells) // stride if axis == 0 else stride):
            side = side_now(sizes, axis, line)
            if side == sizes.actual_mm[axis, line]:
                continue
            if is_new:
                sizes.actual_mm[axis, line] = side
                sizes.place[axis, line] = _place_of(sizes, side)
            else:
                resize(ground, sizes, axis, line, side)
    if is_new:
        for q in range(stride, len(board.cells) - stride):
            if sizes.is_floor[q]:
                _set_capacity(ground, sizes, q)
                row, col = sizes.line_of[0, q], sizes.line_of[1, q]
                sizes.area_m2[0] += sizes.actual_mm[0, row] * sizes.actual_mm[1, col] / _MM2_PER_M2


@compiled_inner
def copy_sides(target: NDArray[np.int64], source: NDArray[np.int64]) -> None:
    """Copy the sides of all lines, shape (2, lines)."""
    copy_row(target[0], source[0])
    copy_row(target[1], source[1])


@compiled_inlined
def side_now(sizes: Sizes, axis: Whole, line: Whole) -> int:
    """The side that a line is to have, by whether cars drive along it and whether a door is across its end."""
    side = sizes.aisle_mm if sizes.driven[axis, line] > 0 else sizes.kept_mm[axis, line]
    return int(max(side, sizes.least_mm[axis, line]))


@compiled_inlined
def foresee(ground: Ground, board: Board, sizes: Sizes) -> None:
    """Set `hint`, from the hops of the board's lanes."""
    for axis in range(2):
        if not sizes.is_chosen[axis]:
            continue
        for line in range(len(board.cells) // ground.stride if axis == 0 else ground.stride):
            other = sizes.aisle_mm if sizes.driven[axis, line] == 0 else sizes.kept_mm[axis, line]
            area = weigh(ground, board, sizes, axis, line, max(other, sizes.least_mm[axis, line]))
            sizes.hint[axis, line] = ground.weights[0] * sizes.change[_STALLS] - sizes.price[0] * area


@compiled_inlined
def floor_cost(sizes: Sizes) -> float:
    """What the floor costs, in stalls."""
    return float(sizes.price[0] * sizes.area_m2[0])


@compiled_inner
def settle(ground: Ground, board: Board, sizes: Sizes, passes: int) -> None:
    """Choose the side of every line without traffic, one after the other, for most stalls less the price of the floor.

    The hops of the board are to be those of its lanes.
    """
    sync(ground, board, sizes)
    for _ in range(passes):
        for axis in range(2):
            if not sizes.is_chosen[axis]:
                continue
            count = len(board.cells) // ground.stride if axis == 0 else ground.stride
            for line in range(count):
                if sizes.driven[axis, line] > 0:
                    continue
                best, kept = 0.0, sizes.kept_mm[axis, line]
                for side in sizes.free_mm:
                    area = weigh(ground, board, sizes, axis, line, max(side, sizes.least_mm[axis, line]))
                    gain = sizes.change[_STALLS] - sizes.price[0] * area
                    if gain > best + 1e-9:
                        best, kept = gain, side
                sizes.kept_mm[axis, line] = kept
                if side_now(sizes, axis, line) != sizes.actual_mm[axis, line]:
                    resize(ground, sizes, axis, line, side_now(sizes, axis, line))
