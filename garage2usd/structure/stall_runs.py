"""Runs of stalls: consecutive squares along a lane whose stalls have one shape, laid out between the columns."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.site import BayConfig
from garage2usd.structure.grid import Cell, CellArray, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.packing import Packing, Surroundings
from garage2usd.structure.stalls import Edge, StallRow, StallShape

Square = tuple[int, int]


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

    @cached_property
    def squares(self) -> tuple[Square, ...]:
        """(row, col) of each square, from `first` to `last`."""
        (row, col), (last_row, last_col) = self.first, self.last
        if self.edge.along_x:
            return tuple((row, at) for at in range(col, last_col + 1))
        return tuple((at, col) for at in range(row, last_row + 1))

    def sides_mm(self, depths_mm: NDArray[np.int64], widths_mm: NDArray[np.int64]) -> tuple[NDArray[np.int64], int]:
        """Return the sides of its squares along it, and their depth, from those of all rows and all columns."""
        (row, col), (last_row, last_col) = self.first, self.last
        if self.edge.along_x:
            return widths_mm[col : last_col + 1], int(depths_mm[row])
        return depths_mm[row : last_row + 1], int(widths_mm[col])


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
    Stalls stand side by side along the whole run, each from the first place at which the rectangle for its car touches
    no column at the mouths or at the rear; stalls that touch one another are moved to the middle of their room. Columns
    divide the mouths of perpendicular and parallel stalls. Angled stalls pass them: the triangles at their mouths and
    rears are free ground. A stall belongs to the square with the middle of its mouth. All of it stays within the ends
    of the run. A run whose squares are not deep enough, or not free beside a lane, has no stalls there. On squares that
    two runs share back to back, each has half the depth.
    """
    runs_on = Counter(square for run in runs for square in run.squares)
    rows = [
        StallRow(*run.squares[number], run.edge, run.shape, starts_m, run.lean)
        for run in runs
        for number, starts_m in packing_of(
            structure, bay, run, surroundings_of(structure.cells, run), runs_on
        ).starts_m()
    ]
    return tuple(sorted(rows, key=lambda row: (row.square, row.edge)))


def capacity_of_runs(structure: Structure, bay: BayConfig, runs: Sequence[StallRun]) -> NDArray[np.int64]:
    """Count the stalls of runs on each square; int64, shape (rows, cols)."""
    capacity = np.zeros(structure.shape, dtype=np.int64)
    for row in rows_of_runs(structure, bay, runs):
        capacity[row.square] += row.count
    return capacity


def surroundings_of(cells: CellArray, run: StallRun) -> Surroundings:
    """Return what is around each square of a run, whatever its sides."""

    def cell_at(square: Square) -> int:
        row, col = square
        return int(cells[row, col]) if 0 <= row < cells.shape[0] and 0 <= col < cells.shape[1] else Cell.OBSTACLE

    behind = [run.edge.opposite.beyond(square) for square in run.squares]
    return Surroundings(
        is_served=tuple(
            cell_at(square) == Cell.FREE and cell_at(run.edge.beyond(square)) == Cell.LANE for square in run.squares
        ),
        has_rear_column=tuple(
            cell_at(square) != Cell.OBSTACLE and cell_at(run.edge.ends[1].beyond(square)) != Cell.OBSTACLE
            for square in behind
        ),
    )


def packing_of(
    structure: Structure, bay: BayConfig, run: StallRun, around: Surroundings, runs_on: Mapping[Square, int]
) -> Packing:
    """Return the stalls of a run, side by side; `runs_on` counts the runs that share each square."""
    along_mm, depth_mm = run.sides_mm(structure.row_depths_mm, structure.column_widths_mm)
    shares = [runs_on[square] for square in run.squares]
    return Packing(bay, run.shape, run.lean, along_mm.tolist(), depth_mm, around, shares)


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
