"""Runs of stalls: consecutive squares along a lane whose stalls have one shape, laid out between the columns."""

import math
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby, pairwise, zip_longest

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.site import BayConfig
from garage2usd.garage import StallKind
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.stalls import Edge, StallRow, StallShape

Square = tuple[int, int]
_MM_PER_M = 1000
_BEHIND_CAR_M = 0.25
"""What columns leave clear before the rectangle of an angled stall, where the tail of a parked car is."""
_CLEAR_MOUTH = 0.45
"""Share of an angled stall's mouth, at the corner of its rectangle, that columns leave clear for cars that turn in."""


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
    Stalls stand side by side along the whole run, each from the first place at which the rectangle for its car touches
    no column at the mouths or at the rear; stalls that touch one another are moved to the middle of their room. Columns
    divide the mouths of perpendicular and parallel stalls. Angled stalls pass them: the triangles at their mouths and
    rears are free ground. A stall belongs to the square with the middle of its mouth. All of it stays within the ends
    of the run. A run whose squares are not deep enough, or not free beside a lane, has no stalls there. On squares that
    two runs share back to back, each has half the depth.
    """
    runs_on = Counter(square for run in runs for square in run.squares)
    rows = [
        StallRow(*square, run.edge, run.shape, starts_m, run.lean)
        for run in runs
        for square, starts_m in _Packing(structure, bay, run, runs_on).starts_m()
    ]
    return tuple(sorted(rows, key=lambda row: (row.square, row.edge)))


def capacity_of_runs(structure: Structure, bay: BayConfig, runs: Sequence[StallRun]) -> NDArray[np.int64]:
    """Count the stalls of runs on each square; int64, shape (rows, cols)."""
    capacity = np.zeros(structure.shape, dtype=np.int64)
    for row in rows_of_runs(structure, bay, runs):
        capacity[row.square] += row.count
    return capacity


class _Packing:
    """Positions of the stalls of a run, in millimetres from its beginning and inwards from its mouths."""

    def __init__(self, structure: Structure, bay: BayConfig, run: StallRun, runs_on: Counter[Square]) -> None:
        self._structure, self._run, self._squares = structure, run, run.squares
        sides_mm, self._depths_mm = structure.column_widths_mm, structure.row_depths_mm
        if not run.edge.along_x:
            sides_mm, self._depths_mm = self._depths_mm, sides_mm
        shape = run.shape
        self._pitch_mm, self._rear_mm = round(shape.pitch_m * _MM_PER_M), round(shape.depth_m * _MM_PER_M)
        self._gap_mm = round(bay.row_ends_m * _MM_PER_M / 2)
        self._column_mm = round(bay.column_size_m * _MM_PER_M / 2)
        self._ground_mm = _ground_of_car_mm(shape, run.lean, bay)
        self._borders_mm = [0]
        for square in self._squares:
            self._borders_mm.append(self._borders_mm[-1] + int(sides_mm[self._along(square)]))
        depth_mm = depth_needed_m(shape, bay) * _MM_PER_M
        self._has_stalls = [
            structure.cell_at(square) is Cell.FREE
            and structure.cell_at(run.edge.beyond(square)) is Cell.LANE
            and depth_mm <= self._depth_mm(square) / runs_on[square]
            for square in self._squares
        ]

    def starts_m(self) -> Iterator[tuple[Square, tuple[float, ...]]]:
        """Yield each square on which mouths have their middles, with the starts of these from the edge's middle."""
        starts: dict[int, list[float]] = {}
        for start in self._centred(self._packed()):
            number = bisect_right(self._borders_mm, start + self._pitch_mm / 2) - 1
            left, right = self._borders_mm[number : number + 2]
            # doubled, so that it is a whole number
            starts.setdefault(number, []).append((2 * start - left - right) / (2 * _MM_PER_M))
        for number, found in starts.items():
            yield self._squares[number], tuple(found)

    def _packed(self) -> list[int]:
        """Starts of the mouths, each as near to the beginning as what is taken and the stall before allow."""
        starts: list[int] = []
        place, most = self._reach_mm
        while (place := self._free_from(place)) <= most:
            starts.append(place)
            place += self._pitch_mm
        return starts

    def _centred(self, starts: list[int]) -> Iterator[int]:
        """Yield the starts with stalls that touch one another moved to the middle of the room that they have."""
        most = self._reach_mm[1]
        group: list[int] = []
        for start, following in zip_longest(starts, starts[1:]):
            group.append(start)
            if following == start + self._pitch_mm:
                continue
            room = most - start if following is None else following - self._pitch_mm - start
            room = min([room, *(self._room_after(own) for own in group)])
            yield from (own + room // 2 for own in group)
            group = []

    @cached_property
    def _reach_mm(self) -> tuple[int, int]:
        """Least and greatest start of a mouth with which a stall lies within the ends of the run."""
        ends = 0, self._run.lean * self._run.shape.slope * self._rear_mm
        least = self._gap_mm - math.floor(min(ends))
        return least, self._borders_mm[-1] - self._gap_mm - self._pitch_mm - math.ceil(max(ends))

    @cached_property
    def _taken(self) -> list[tuple[int, int]]:
        """Open intervals of starts at which a stall would touch a column, or a square without stalls; in order."""
        taken = [
            (left - self._pitch_mm, right)
            for (left, right), has_stalls in zip(pairwise(self._borders_mm), self._has_stalls, strict=True)
            if not has_stalls
        ]
        for border, square in zip(self._borders_mm[1:-1], self._squares, strict=False):
            depths_mm = [(-math.inf, self._column_mm)]
            if self._has_rear_column(square):
                depths_mm.append((self._depth_mm(square) - self._column_mm, math.inf))
            columns = (_taken_by_column_mm(self._ground_mm, self._column_mm, *depth_mm) for depth_mm in depths_mm)
            taken.extend((border + low, border + high) for low, high in filter(None, columns))
        return sorted(taken)

    def _free_from(self, place: int) -> int:
        """Return the first start at or after a place that nothing takes."""
        for low, high in self._taken:
            if low < place < high:
                place = high
        return place

    def _room_after(self, start: int) -> int:
        """Return how far a free start can be moved towards the end of the run until something takes it."""
        return min((low - start for low, _ in self._taken if low >= start), default=self._borders_mm[-1])

    def _has_rear_column(self, square: Square) -> bool:
        """Return True if the two squares behind the end of a square are inside, so that a column stands there."""
        behind = self._run.edge.opposite.beyond(square)
        following = self._run.edge.ends[1].beyond(behind)
        return Cell.OBSTACLE not in {self._structure.cell_at(behind), self._structure.cell_at(following)}

    def _depth_mm(self, square: Square) -> int:
        """Depth of a square across the run."""
        return int(self._depths_mm[square[0] if self._run.edge.along_x else square[1]])

    def _along(self, square: Square) -> int:
        return square[1] if self._run.edge.along_x else square[0]


_Corners = tuple[tuple[float, float], ...]


def lost_at_columns_m(shape: StallShape, bay: BayConfig) -> tuple[float, ...]:
    """Return the lengths of a long run that each column may cost: none, by its foot at the mouths, or at both ends.

    A column costs none where it stands in the triangle at the mouth or the rear of an angled stall.
    """
    column_mm, depth_mm = bay.column_size_m * _MM_PER_M / 2, shape.depth_m * _MM_PER_M
    ground_mm = _ground_of_car_mm(shape, 1, bay)
    mouth, rear = (
        _taken_by_column_mm(ground_mm, column_mm, near_mm, far_mm) or (0, 0)
        for near_mm, far_mm in ((-math.inf, column_mm), (depth_mm - column_mm, math.inf))
    )
    both = min(mouth[0], rear[0]), max(mouth[1], rear[1])
    pitch_mm = round(shape.pitch_m * _MM_PER_M)
    return tuple(sorted({max(high - low - pitch_mm, 0) / _MM_PER_M for low, high in (mouth, both)}))


def _ground_of_car_mm(shape: StallShape, lean: int, bay: BayConfig) -> _Corners:
    """Corners of the rectangle for a car and of what columns leave clear around it: along from the start, and inwards.

    That is as much on both sides as between a wall and a stall, and before the mouth of angled stalls.
    """
    margin_mm = (bay.row_ends_m - bay.column_size_m) / 2 * _MM_PER_M
    pitch, depth = shape.pitch_m * _MM_PER_M, shape.depth_m * _MM_PER_M
    if shape.kind is not StallKind.ANGLED:
        return (-margin_mm, 0.0), (pitch + margin_mm, 0.0), (pitch + margin_mm, depth), (-margin_mm, depth)
    angle = math.radians(shape.angle_deg)
    sin, cos = math.sin(angle), math.cos(angle)
    right, left = margin_mm, -shape.width_m * _MM_PER_M - margin_mm
    near, far = -_BEHIND_CAR_M * _MM_PER_M, shape.length_m * _MM_PER_M
    # a stall that leans towards +, from the corner of its rectangle on the line of the mouths
    corners = [
        (pitch + across * sin + inwards * cos, -across * cos + inwards * sin)
        for across, inwards in ((right, near), (right, far), (left, far), (left, near))
    ]
    corners.append(((1 - _CLEAR_MOUTH) * pitch, 0.0))
    return tuple(corners if lean > 0 else [(pitch - x, inwards) for x, inwards in corners])


def _taken_by_column_mm(ground_mm: _Corners, column_mm: float, near_mm: float, far_mm: float) -> tuple[int, int] | None:
    """Return the open interval of starts, from a column's middle, at which the ground of a car touches the column.

    Parameters
    ----------
    ground_mm
        From `_ground_of_car_mm`.
    column_mm
        Half the side of the column.
    near_mm, far_mm
        The depths over which it reaches. None is returned if the ground does not reach over any of them.
    """
    along = [x for x, depth in ground_mm if near_mm < depth < far_mm]
    for (x, depth), (next_x, next_depth) in pairwise((*ground_mm, ground_mm[0])):
        along.extend(
            x + (next_x - x) * (cut - depth) / (next_depth - depth)
            for cut in (near_mm, far_mm)
            if min(depth, next_depth) < cut < max(depth, next_depth)
        )
    if not along:
        return None
    low, high = (round(end, 3) for end in (-column_mm - max(along), column_mm - min(along)))
    return math.floor(low), math.ceil(high)


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
