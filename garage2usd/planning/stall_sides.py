"""Sides of squares for stalls of all kinds: lines of squares as deep and as wide as their runs and aisles ask for."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallKind
from garage2usd.planning.dimensions import lines_with_aisles, lines_with_doors
from garage2usd.planning.planner import Plan
from garage2usd.structure.grid import Cell, CellArray, Structure
from garage2usd.structure.lanes import LaneDirections
from garage2usd.structure.packing import Packing, Surroundings, depth_needed_m, lost_at_columns_m
from garage2usd.structure.stall_runs import Square, StallRun, lean_of_traffic, surroundings_of
from garage2usd.structure.stalls import Edge

Sides = NDArray[np.int64]
Line = tuple[int, int]
"""A row (0) or a column (1) of squares, and its number."""

_MM_PER_M = 1000
_STEP_MM = 10
_STALLS_BETWEEN_COLUMNS, _PARALLEL_BETWEEN_COLUMNS = (2, 3), (1, 2)
_PASSES = 4


class StallCounts:
    """Cache of the number of stalls of runs on the lanes of one plan, by the sides of their squares."""

    def __init__(self, cells: CellArray, bay: BayConfig) -> None:
        self._cells, self._bay = cells, bay
        self._known: dict[tuple[StallRun, bool, int, bytes], int] = {}
        self._around: dict[tuple[Square, Square, Edge], Surroundings] = {}

    def of(self, depths_mm: Sides, widths_mm: Sides, run: StallRun, *, is_backed: bool) -> int:
        """Count the stalls of a run; if it is backed, another run shares its squares.

        Parameters
        ----------
        depths_mm, widths_mm
            Sides of the rows and of the columns.
        run, is_backed
            The run.
        """
        along, depth = run.sides_mm(depths_mm, widths_mm)
        key = run, is_backed, depth, along.tobytes()
        if key not in self._known:
            place = run.first, run.last, run.edge
            if place not in self._around:
                self._around[place] = surroundings_of(self._cells, run)
            shares = [1 + is_backed] * len(along)
            packing = Packing(self._bay, run.shape, run.lean, along.tolist(), depth, self._around[place], shares)
            self._known[key] = packing.count
        return self._known[key]


class StallSides:
    """Runs of stalls on the lanes of a plan with the sides of their squares, chosen by the least floor per stall.

    Attributes
    ----------
    runs
        The runs.
    counts
        Number of stalls of each run; of none before `fit`.
    """

    def __init__(self, plan: Plan, config: GarageConfig, runs: Sequence[StallRun], known: StallCounts) -> None:
        structure, bay, spacing = plan.structure, config.bay, config.standard.column_spacing
        self._plan, self._config, self._bay, self._known = plan, config, bay, known
        self._longest_span_mm = (spacing.bounds[1] if spacing else math.inf) * _MM_PER_M
        self._cells, self._is_inside = structure.cells, (structure.cells != Cell.OBSTACLE).astype(np.int64)
        self._sides_mm = [structure.row_depths_mm.copy(), structure.column_widths_mm.copy()]
        self._least_mm = _least_sides_mm(structure, bay)
        self.runs, self.counts = list(runs), [0] * len(runs)
        self._backs = Counter((square, run.edge.along_x) for run in runs for square in run.squares)
        with_aisles = lines_with_aisles(structure)
        self._lines: list[Line] = []
        """Lines whose sides are chosen for the stalls on them."""
        self._aisles: dict[Line, bool] = {}
        """Lines whose sides are chosen for the aisles along them, and whether all of these are one-way."""
        for axis, is_chosen in enumerate(bay.chosen_sides):
            for line in range(structure.shape[axis]) if is_chosen else ():
                if with_aisles[axis][line]:
                    self._aisles[axis, line] = _is_one_way(plan, axis, line)
                elif (structure.cells.take(line, axis=axis) == Cell.FREE).any():
                    self._lines.append((axis, line))
        self._on_line = {
            (axis, line): [
                number for number, run in enumerate(runs) if line in {square[axis] for square in run.squares}
            ]
            for axis, count in enumerate(structure.shape)
            for line in range(count)
        }

    @property
    def structure(self) -> Structure:
        """The lanes with the present sides."""
        return Structure(self._cells, self._sides_mm[1], self._sides_mm[0])

    @property
    def floor_per_stall_m2(self) -> float:
        """Floor inside the contour, obstacles apart, over the number of stalls; infinite without stalls."""
        stalls = sum(self.counts)
        depths_mm, widths_mm = self._sides_mm
        floor_m2 = float(depths_mm @ self._is_inside @ widths_mm) / _MM_PER_M**2
        return round(floor_m2 / stalls, 9) if stalls else math.inf

    def fit(self) -> None:
        """Choose the sides anew: of all lines together, then of one after the other until none gains.

        This is done twice, with lines as deep as their stalls need and half a column deeper, where fewer columns touch
        the rears of angled stalls. The better end is kept.
        """
        for axis, line in self._aisles:
            self._widen_aisle(axis, line)
        deep_mm = [max(int(self._sides_mm[axis][line]), self._needed_mm(axis, line)) for axis, line in self._lines]
        ends = []
        for deeper_mm in (0, rounded_mm(self._bay.column_size_m / 2)):
            for (axis, line), side_mm in zip(self._lines, deep_mm, strict=True):
                self._sides_mm[axis][line] = side_mm + deeper_mm
            self.counts = [self._count(run) for run in self.runs]
            self._improve_together()
            for _ in range(_PASSES):
                if not sum(self._improve(*line) for line in self._lines):
                    break
            ends.append((self.floor_per_stall_m2, [sides_mm.copy() for sides_mm in self._sides_mm], self.counts))
        _, self._sides_mm, self.counts = min(ends, key=lambda end: end[0])

    @contextmanager
    def tried(self, changes: Mapping[int, StallRun]) -> Iterator[None]:
        """Have other runs in the places of some, by number, with the sides of their own lines; then as before."""
        before = self.runs, self._sides_mm, self.counts
        self.runs, self.counts = self.runs.copy(), self.counts.copy()
        self._sides_mm = [sides_mm.copy() for sides_mm in self._sides_mm]
        self.change(changes)
        try:
            yield
        finally:
            self.runs, self._sides_mm, self.counts = before

    def change(self, changes: Mapping[int, StallRun]) -> None:
        """Put other runs in the places of some, by number, and make their lines and aisles as wide as these need."""
        changed: set[Line] = set()
        for number, run in changes.items():
            self.runs[number] = run
            axis = int(not run.edge.along_x)
            changed |= {(axis, run.first[axis]), (axis, run.edge.beyond(run.first)[axis])}
        for axis, line in changed & self._aisles.keys():
            self._widen_aisle(axis, line)
        own = [line for line in self._lines if line in changed]
        for axis, line in own:
            self._sides_mm[axis][line] = self._choices_mm(axis, line)[0]
        for number in {number for line in changed for number in self._on_line[line]}:
            self.counts[number] = self._count(self.runs[number])
        for axis, line in own:
            self._improve(axis, line)

    def _widen_aisle(self, axis: int, line: int) -> None:
        """Make a line as wide as the aisles along it need for their stalls, or a door across its end.

        If all aisles are one-way and have stalls, they are as wide as the profile asks for these stalls, and never
        wider than others.
        """
        width_m = self._bay.aisle_width_m
        if self._aisles[axis, line]:
            widths_m = [
                _aisle_width_m(run, self._plan.directions, self._config)
                for run in self.runs
                if run.edge.along_x == (axis == 0) and run.edge.beyond(run.first)[axis] == line
            ]
            width_m = min(max(widths_m, default=width_m), width_m)
        aisle_mm = rounded_mm(width_m + 2 * self._bay.carriageway_setback_m)
        self._sides_mm[axis][line] = max(aisle_mm, int(self._least_mm[axis][line]))

    def _count(self, run: StallRun) -> int:
        depths_mm, widths_mm = self._sides_mm
        return self._known.of(depths_mm, widths_mm, run, is_backed=self._backs[run.first, run.edge.along_x] > 1)

    def _needed_mm(self, axis: int, line: int) -> int:
        """Depth that the runs along a line need."""
        runs = (self.runs[number] for number in self._on_line[axis, line])
        return max(
            (
                rounded_mm(depth_needed_m(run.shape, self._bay)) * self._backs[square, run.edge.along_x]
                for run in runs
                if run.edge.along_x == (axis == 0)
                for square in run.squares
            ),
            default=0,
        )

    def _choices_mm(self, axis: int, line: int) -> list[int]:
        """Sides to try: as deep as the runs along the line need, and as wide as some stalls of the runs across it."""
        deep = max(self._needed_mm(axis, line), int(self._least_mm[axis][line]))
        found = {deep, deep + rounded_mm(self._bay.column_size_m / 2)} if deep else set()
        shapes = {
            run.shape
            for run in (self.runs[number] for number in self._on_line[axis, line])
            if run.edge.along_x != (axis == 0) and SizeClass(run.shape.size).takes_cars
        }
        # ignore parallel stalls beside other kinds: they would require spans that no other row needs
        spanned = {shape for shape in shapes if shape.kind is not StallKind.PARALLEL} or shapes
        for shape in spanned:
            is_angled = shape.kind is StallKind.ANGLED
            lost_m = {self._bay.row_ends_m, *(lost_at_columns_m(shape, self._bay) if is_angled else ())}
            counts = _PARALLEL_BETWEEN_COLUMNS if shape.kind is StallKind.PARALLEL else _STALLS_BETWEEN_COLUMNS
            found |= {rounded_mm(count * shape.pitch_m + lost) for count in counts for lost in lost_m}
        found = {side for side in found if side <= self._longest_span_mm} or {min(found, default=deep)}
        now = int(self._sides_mm[axis][line])
        return sorted({max(side, deep) for side in found if side} or {now})

    def _improve(self, axis: int, line: int) -> bool:
        """Give a line the side with the least floor per stall, if that is less than now."""
        before_mm = int(self._sides_mm[axis][line])
        best = self.floor_per_stall_m2, before_mm, self.counts
        for side_mm in self._choices_mm(axis, line):
            self._sides_mm[axis][line] = side_mm
            self.counts = best[2].copy()
            for number in self._on_line[axis, line]:
                self.counts[number] = self._count(self.runs[number])
            best = min(best, (self.floor_per_stall_m2, side_mm, self.counts), key=lambda found: found[0])
        _, self._sides_mm[axis][line], self.counts = best
        return best[1] != before_mm

    def _improve_together(self) -> None:
        """Give all lines of an axis that may have it the same side, where that lowers the floor per stall.

        Angled stalls pass the columns in step only if many lines in a row have the same side.
        """
        for axis in range(len(self._sides_mm)):
            choices_mm = {line: self._choices_mm(axis, line) for own, line in self._lines if own == axis}
            sides_mm = self._sides_mm[axis]
            best = self.floor_per_stall_m2, sides_mm, self.counts
            for side_mm in sorted({side_mm for choices in choices_mm.values() for side_mm in choices}):
                self._sides_mm[axis] = sides_mm.copy()
                for line, choices in choices_mm.items():
                    if side_mm in choices:
                        self._sides_mm[axis][line] = side_mm
                self.counts = [self._count(run) for run in self.runs]
                best = min(
                    best, (self.floor_per_stall_m2, self._sides_mm[axis], self.counts), key=lambda found: found[0]
                )
            _, self._sides_mm[axis], self.counts = best


def _least_sides_mm(structure: Structure, bay: BayConfig) -> list[Sides]:
    """Return the least sides of the rows and of the columns: for doors, and for a gate and a waiting car behind one."""
    portals = (structure.cells == Cell.ENTRANCE) | (structure.cells == Cell.EXIT)
    found = []
    for axis, has_door in enumerate(lines_with_doors(structure)):
        least_mm = np.where(has_door, round(bay.portal_side_m * _MM_PER_M), 0)
        has_portal = portals.any(axis=1 - axis)
        least_mm[has_portal] = np.maximum(least_mm[has_portal], rounded_mm(bay.stall_length_m))
        found.append(least_mm)
    return found


def _is_one_way(plan: Plan, axis: int, line: int) -> bool:
    """Return True if cars drive along a row (0) or a column (1) of squares, and everywhere in one direction only."""
    edge = Edge.RIGHT if axis == 0 else Edge.DOWN
    steps = ((square, edge.beyond(square)) for square in plan.structure.where(Cell.LANE) if square[axis] == line)
    between_lanes = [step for step in steps if plan.structure.cell_at(step[1]) is Cell.LANE]
    return bool(between_lanes) and all(plan.directions.is_one_way(*step) for step in between_lanes)


def _aisle_width_m(run: StallRun, directions: LaneDirections, config: GarageConfig) -> float:
    """Return the clear width of a one-way aisle that the stalls of a run need."""
    profile, widest_m = config.standard, config.bay.aisle_width_m
    if run.shape.kind is StallKind.PARALLEL and profile.parallel_aisle_width:
        return profile.parallel_aisle_width.amount
    leans_with_traffic = run.lean == lean_of_traffic(run.first, run.edge, directions)
    if run.shape.kind is StallKind.ANGLED and profile.angled_aisle_widths and leans_with_traffic:
        upright = profile.aisle_width
        return profile.angled_aisle_widths.amount_at(run.shape.angle_deg, upright.amount if upright else widest_m)
    return widest_m


def rounded_mm(length_m: float) -> int:
    """Round up to the centimetre, in millimetres."""
    return math.ceil(round(length_m * _MM_PER_M, 3) / _STEP_MM) * _STEP_MM
