"""Runs of stalls: consecutive squares along a lane whose stalls have one shape, laid out between the columns."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.site import BayConfig
from garage2usd.garage import StallKind
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.stalls import Edge, StallRow, StallShape

Square = tuple[int, int]
_MM_PER_M = 1000


@dataclass(frozen=True)
class StallRun:
    """Consecutive squares of one line of the structure whose stalls open onto one side and have one shape.

    Attributes
    ----------
    first, last
        (row, col) of the squares at the two ends, `first` nearer to the origin.
    edge
        The edge of each square with the mouths.
    shape
        Shape of the stalls.
    lean
        Direction along the run in which angled stalls lean from mouth to rear: 1 towards +X or +Z, else -1.
    """

    first: Square
    last: Square
    edge: Edge
    shape: StallShape
    lean: int = 1

    @property
    def squares(self) -> tuple[Square, ...]:
        """(row, col) of each square, from `first` to `last`."""
        (row, col), (last_row, last_col) = self.first, self.last
        if self.edge.along_x:
            return tuple((row, at) for at in range(col, last_col + 1))
        return tuple((at, col) for at in range(row, last_row + 1))


def lean_of_traffic(square: Square, edge: Edge, directions: LaneDirections = BOTH_WAYS) -> int:
    """Return the lean of angled stalls for the traffic before them.

    Parameters
    ----------
    square, edge
        The square of the stalls, and its edge with the mouths.
    directions
        One-way lanes; on all others traffic keeps to the right.
    """
    lane = edge.beyond(square)
    low, high = (end.beyond(lane) for end in edge.ends)
    if {(lane, high), (low, lane)} & directions.one_way:
        return 1
    if {(lane, low), (high, lane)} & directions.one_way:
        return -1
    return _lean_to_the_right(edge)


def turn_of(row: StallRow) -> int:
    """Return 1 if the stalls of a row are entered by a turn to the right off the lane, -1 if to the left."""
    return row.lean * _lean_to_the_right(row.edge)


def _lean_to_the_right(edge: Edge) -> int:
    return 1 if edge in {Edge.UP, Edge.RIGHT} else -1


def depth_needed_m(shape: StallShape, bay: BayConfig) -> float:
    """Return the depth of a square for stalls of a shape: parallel ones keep the wall gap behind them."""
    return round(shape.depth_m + (bay.wall_gap_m if shape.kind is StallKind.PARALLEL else 0.0), 6)


def runs_of_rows(rows: Iterable[StallRow]) -> list[StallRun]:
    """Join the rows of consecutive squares with the same edge, shape and lean to runs."""

    def line(row: StallRow) -> tuple[Edge, int, int]:
        return (row.edge, row.row, row.col) if row.edge.along_x else (row.edge, row.col, row.row)

    runs = []
    ordered = sorted(rows, key=line)
    numbered = ((line(row)[2] - number, row) for number, row in enumerate(ordered))
    for (edge, _, _, shape, lean), group in groupby(
        numbered, key=lambda found: (found[1].edge, line(found[1])[1], found[0], found[1].shape, found[1].lean)
    ):
        squares = [row.square for _, row in group]
        runs.append(StallRun(squares[0], squares[-1], edge, shape, lean))
    return sorted(runs, key=lambda run: (run.first, run.edge))


def rows_of_runs(structure: Structure, bay: BayConfig, runs: Sequence[StallRun]) -> tuple[StallRow, ...]:
    """Lay out the stalls of runs, in reading order of the squares.

    Notes
    -----
    The columns at the corners of squares divide the mouths of a run, so that the mouth of each stall lies on one
    square. Angled stalls lean over the borders between squares; they stay within the ends of the run and keep clear of
    the columns at the mouths and at the rear. A run whose squares are not deep enough, or not free beside a lane, has
    no stalls there. On squares that two runs share back to back, each has half the depth.
    """
    runs_on = Counter(square for run in runs for square in run.squares)
    rows = [
        StallRow(*square, run.edge, run.shape, starts_m, run.lean)
        for run in runs
        for square, starts_m in _starts_m(structure, bay, run, runs_on)
        if starts_m
    ]
    return tuple(sorted(rows, key=lambda row: (row.square, row.edge)))


def capacity_of_runs(structure: Structure, bay: BayConfig, runs: Sequence[StallRun]) -> NDArray[np.int64]:
    """Count the stalls of runs on each square; int64, shape (rows, cols)."""
    capacity = np.zeros(structure.shape, dtype=np.int64)
    for row in rows_of_runs(structure, bay, runs):
        capacity[row.square] += row.count
    return capacity


def _starts_m(
    structure: Structure, bay: BayConfig, run: StallRun, runs_on: Counter[Square]
) -> Iterator[tuple[Square, tuple[float, ...]]]:
    """Yield each square of a run with the starts of its mouths from the edge's middle."""
    packing = _Packing(structure, bay, run)
    for number, square in enumerate(run.squares):
        is_served = structure.cell_at(square) is Cell.FREE and structure.cell_at(run.edge.beyond(square)) is Cell.LANE
        is_deep = depth_needed_m(run.shape, bay) * _MM_PER_M <= packing.depth_mm(square) / runs_on[square]
        yield square, packing.starts_m(number) if is_served and is_deep else ()


class _Packing:
    """Positions of the stalls of a run, in millimetres from its beginning."""

    def __init__(self, structure: Structure, bay: BayConfig, run: StallRun) -> None:
        self._structure, self._run, self._squares = structure, run, run.squares
        self._sides_mm, self._depths_mm = structure.column_widths_mm, structure.row_depths_mm
        if not run.edge.along_x:
            self._sides_mm, self._depths_mm = self._depths_mm, self._sides_mm
        shape = run.shape
        self._pitch_mm, self._rear_mm = round(shape.pitch_m * _MM_PER_M), round(shape.depth_m * _MM_PER_M)
        self._slope = shape.slope * run.lean
        self._gap_mm = round(bay.row_ends_m * _MM_PER_M / 2)
        self._column_mm = round(bay.column_size_m * _MM_PER_M / 2)
        self._borders_mm = [0]
        for square in self._squares:
            self._borders_mm.append(self._borders_mm[-1] + int(self._sides_mm[self._along(square)]))

    def depth_mm(self, square: Square) -> int:
        """Depth of a square across the run."""
        return int(self._depths_mm[self._across(square)])

    def starts_m(self, number: int) -> tuple[float, ...]:
        """Starts of the mouths on one square of the run, from the middle of its edge."""
        left, right = self._borders_mm[number], self._borders_mm[number + 1]
        least, most = self._reach_mm(number)
        taken = [(low, high) for low, high in self._taken_by_rear_columns if low < most and high > least]
        starts: list[int] = []
        place = least
        while (place := _beyond(place, taken)) <= most:
            starts.append(place)
            place += self._pitch_mm
        if starts and all(high <= least or low >= starts[-1] for low, high in taken):
            room = min([most, *(low for low, _ in taken if low >= starts[-1])]) - starts[-1]
            starts = [start + room // 2 for start in starts]
        # from the middle; doubled, so that it is a whole number
        return tuple((2 * start - left - right) / (2 * _MM_PER_M) for start in starts)

    def _reach_mm(self, number: int) -> tuple[int, int]:
        """Least and greatest start of a mouth between the columns at the mouths and within the ends of the run."""
        left, right = self._borders_mm[number], self._borders_mm[number + 1]
        low, high = self._offsets_mm(0, self._column_mm)
        least, most = left + self._gap_mm - low, right - self._gap_mm - self._pitch_mm - high
        low, high = self._offsets_mm(0, self._rear_mm)
        least = max(least, self._gap_mm - low)
        return least, min(most, self._borders_mm[-1] - self._gap_mm - self._pitch_mm - high)

    @cached_property
    def _taken_by_rear_columns(self) -> list[tuple[int, int]]:
        """Open intervals of starts at which a stall would touch a column at the rear of the run."""
        taken = []
        for border, square in zip(self._borders_mm[1:-1], self._squares, strict=False):
            near = self.depth_mm(square) - self._column_mm
            if near < self._rear_mm and self._has_rear_column(square):
                low, high = self._offsets_mm(near, self._rear_mm)
                taken.append((border - self._gap_mm - self._pitch_mm - high, border + self._gap_mm - low))
        return taken

    def _has_rear_column(self, square: Square) -> bool:
        """Return True if the two squares behind the end of a square are inside, so that a column stands there."""
        behind = self._run.edge.opposite.beyond(square)
        following = self._run.edge.ends[1].beyond(behind)
        return Cell.OBSTACLE not in {self._structure.cell_at(behind), self._structure.cell_at(following)}

    def _offsets_mm(self, near_mm: int, far_mm: int) -> tuple[int, int]:
        """Least and greatest offset of a stall's sides along the run between two depths."""
        ends = self._slope * near_mm, self._slope * far_mm
        return int(min(ends) // 1), int(-(-max(ends) // 1))

    def _along(self, square: Square) -> int:
        return square[1] if self._run.edge.along_x else square[0]

    def _across(self, square: Square) -> int:
        return square[0] if self._run.edge.along_x else square[1]


def _beyond(place: int, taken: Sequence[tuple[int, int]]) -> int:
    """Return the first place at or after a given one that lies in none of the open intervals, which are in order."""
    for low, high in taken:
        if low < place < high:
            place = high
    return place


def split_for_motorcycles(
    runs: Sequence[StallRun],
    shape: StallShape,
    share: float,
    rng: np.random.Generator,
    *,
    count: Callable[[StallRun], int],
    is_whole: Callable[[StallRun], bool],
) -> tuple[list[StallRun], list[StallRun]]:
    """Take squares from runs for motorcycles, from the beginning of one random run after the other.

    Parameters
    ----------
    runs
        Runs of stalls for cars.
    shape
        Shape of the stalls for motorcycles.
    share
        Wanted share of the stalls, from 0 to 1.
    rng
        Decides which runs.
    count
        Number of stalls of a run.
    is_whole
        True for a run that is taken as a whole or not at all.

    Returns
    -------
    tuple
        The runs that are left for cars, and those for motorcycles, whose share is as near as whole squares allow.
    """
    cars, motorcycles = sum(map(count, runs)), 0
    left, taken = list(runs), list[StallRun]()

    def error(more: int, fewer: int) -> float:
        stalls = cars + motorcycles + more - fewer
        return abs((motorcycles + more) / stalls - share) if stalls else share

    for index in rng.permutation(len(runs)).tolist():
        run = runs[index]
        best = error(0, 0), 0, 0, 0
        for length in (len(run.squares),) if is_whole(run) else range(1, len(run.squares) + 1):
            first, _ = _parts(run, length)
            more, fewer = count(replace(first, shape=shape)), count(first)
            best = min(best, (error(more, fewer), length, more, fewer))
        _, length, more, fewer = best
        if not length:
            if taken:
                break
            continue
        first, rest = _parts(run, length)
        taken.append(replace(first, shape=shape))
        left[left.index(run) : left.index(run) + 1] = rest
        cars, motorcycles = cars - fewer, motorcycles + more
        if rest:
            break
    return left, taken


def _parts(run: StallRun, length: int) -> tuple[StallRun, list[StallRun]]:
    """Return the first squares of a run and, if there are more, the run of the others."""
    squares = run.squares
    rest = [replace(run, first=squares[length])] if length < len(squares) else []
    return replace(run, last=squares[length - 1]), rest
