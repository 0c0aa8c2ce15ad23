"""Kinds and sizes of stalls for finished lanes: drawn run by run, and the sides of squares that they need."""
# Over 300 lines: the draw, the shapes that it draws and the sides that they need change together.

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.stalls import GivenRun, SizeClass
from garage2usd.garage import StallKind
from garage2usd.planning.dimensions import lines_with_aisles, lines_with_doors
from garage2usd.planning.planner import Plan
from garage2usd.planning.score import evaluate
from garage2usd.profiles import Length
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.stall_runs import (
    StallRun,
    depth_needed_m,
    lean_of_traffic,
    lost_at_columns_m,
    rows_of_runs,
    runs_of_rows,
    split_for_motorcycles,
)
from garage2usd.structure.stalls import PARALLEL_DEG, PERPENDICULAR_DEG, Edge, StallShape, stall_rows

Sides = NDArray[np.int64]

_MM_PER_M = 1000
_STEP_MM = 10
_STALLS_BETWEEN_COLUMNS, _PARALLEL_BETWEEN_COLUMNS = (2, 3), (1, 2)
_PASSES = 4
_ROUNDS = 2
_LEAST_GAIN = 1e-6
_PARALLEL_LENGTH_M = 6.0
"""Length of parallel stalls where the profile has none."""


def with_stall_kinds(plan: Plan, config: GarageConfig) -> Plan:
    """Draw the kind and size of the stalls of each run, and fit the sides of squares to them.

    Parameters
    ----------
    plan
        Lanes, with R and C for perpendicular stalls of the standard size.
    config
        Shares of the kinds and sizes, given runs, and the seed.

    Returns
    -------
    Plan
        The same S with the runs of its stalls and its score; R and C fit them where they are chosen. The given plan if
        all stalls are perpendicular and of the standard size.

    Raises
    ------
    ConfigError
        If a given run has a square that is not free beside a lane.

    Notes
    -----
    Runs are visited by length, equal ones in random order. Each takes the option furthest below its share of the stalls
    so far, among those that fit: squares whose sides are not chosen must be deep enough. Lines of squares without
    traffic along them then get the sides with the least floor per stall, and single runs change their option while
    that brings the shares closer. If kinds are free, the garage is laid out with each kind and angle alone, and gets
    the one with the least floor per stall; among equal ones the first of perpendicular, angled, parallel.
    """
    if config.stalls.is_free:
        return _least_floor(plan, config)
    if config.stalls.is_uniform:
        return plan
    counts = _Counts(plan.structure, config.bay)
    draw = _Draw(plan, config, counts)
    for _ in range(_ROUNDS):
        draw.even_out(_Fitting(plan, config, draw.runs, counts).fitted())
    return _with_runs(plan, config, draw.runs, counts)


def _least_floor(plan: Plan, config: GarageConfig) -> Plan:
    """Return the plan whose stalls are of the kind with the least floor per stall."""
    stalls = config.stalls
    every = [
        stalls.of_kind(StallKind.PERPENDICULAR),
        *(stalls.of_kind(StallKind.ANGLED, angle_deg) for angle_deg in stalls.angles_deg),
        stalls.of_kind(StallKind.PARALLEL),
    ]
    plans = (with_stall_kinds(plan, config.model_copy(update={"stalls": of_one})) for of_one in every)
    return min(plans, key=_floor_per_stall_m2)


def _floor_per_stall_m2(plan: Plan) -> float:
    """Return the floor of a plan over its stalls, of whatever kind; infinite without stalls."""
    return round(plan.structure.floor_m2 / plan.score.stalls, 9) if plan.score.stalls else math.inf


def with_runs(plan: Plan, config: GarageConfig, runs: Iterable[StallRun]) -> Plan:
    """Give a plan the runs of its stalls.

    Parameters
    ----------
    plan
        Lanes with their directions, and R and C for perpendicular stalls of the standard size.
    config
        Which sides are chosen, and the weights of the score.
    runs
        All stalls, in any order.

    Returns
    -------
    Plan
        The same S and directions. R and C, where they are chosen, and the score are those of the runs.
    """
    return _with_runs(plan, config, runs, _Counts(plan.structure, config.bay))


def _with_runs(plan: Plan, config: GarageConfig, runs: Iterable[StallRun], counts: "_Counts") -> Plan:
    ordered = sorted(runs, key=lambda run: (run.first, run.edge))
    structure = _Fitting(plan, config, ordered, counts).fitted()
    score = evaluate(structure, bay=config.bay, plan=config.plan, runs=ordered)
    return replace(plan, structure=structure, score=score, runs=tuple(ordered))


def runs_of_settings(
    runs: Iterable[GivenRun], config: GarageConfig, directions: LaneDirections = BOTH_WAYS
) -> list[StallRun]:
    """Convert the runs of settings or of a report to runs of a structure, for traffic in some directions."""
    found = []
    for run in runs:
        edge = Edge[run.edge.upper()]
        shape = _shape(config, run.kind, run.size, run.angle_deg or PERPENDICULAR_DEG)
        sign = -1 if run.leans == "against traffic" else 1
        found.append(StallRun(run.first, run.last, edge, shape, sign * lean_of_traffic(run.first, edge, directions)))
    return found


def settings_of_runs(runs: Iterable[StallRun], directions: LaneDirections = BOTH_WAYS) -> tuple[GivenRun, ...]:
    """Convert runs of a structure to settings; the inverse of `runs_of_settings`."""
    return tuple(
        GivenRun(
            first=run.first,
            last=run.last,
            edge=run.edge.name.lower(),
            kind=run.shape.kind,
            angle_deg=run.shape.angle_deg if run.shape.kind is StallKind.ANGLED else None,
            size=SizeClass(run.shape.size),
            leans="with traffic" if run.lean == lean_of_traffic(run.first, run.edge, directions) else "against traffic",
        )
        for run in runs
    )


class _Counts:
    """Cache of the number of stalls of runs on the lanes of one plan, by the sides of their squares."""

    def __init__(self, structure: Structure, bay: BayConfig) -> None:
        self._cells, self._bay = structure.cells, bay
        self._known: dict[tuple[StallRun, bool, int, bytes], int] = {}

    def of(self, depths_mm: Sides, widths_mm: Sides, run: StallRun, *, is_backed: bool) -> int:
        """Count the stalls of a run; if it is backed, another run shares its squares.

        Parameters
        ----------
        depths_mm, widths_mm
            Sides of the rows and of the columns.
        run, is_backed
            The run.
        """
        (row, col), (last_row, last_col) = run.first, run.last
        if run.edge.along_x:
            depth, along = int(depths_mm[row]), widths_mm[col : last_col + 1]
        else:
            depth, along = int(widths_mm[col]), depths_mm[row : last_row + 1]
        key = run, is_backed, depth, along.tobytes()
        if key not in self._known:
            backs = [replace(run, edge=run.edge.opposite)] if is_backed else []
            structure = Structure(self._cells, widths_mm, depths_mm)
            rows = rows_of_runs(structure, self._bay, [run, *backs])
            self._known[key] = sum(stalls.count for stalls in rows if stalls.edge is run.edge)
        return self._known[key]


_Option = tuple[StallKind, SizeClass]
_FOR_MOTORCYCLES: _Option = StallKind.PERPENDICULAR, SizeClass.MOTORCYCLE


class _Draw:
    """Draw of the kinds of all runs of a garage, which tracks the shares of stalls of each kind."""

    def __init__(self, plan: Plan, config: GarageConfig, counts: _Counts) -> None:
        structure = plan.structure
        self._config, self._bay, self._counts = config, config.bay, counts
        self._shares = config.stalls.shares
        self._given = _checked_runs(plan, config)
        rng = generator(config.seed, Step.STALL_KINDS)
        angles_deg = config.stalls.angles_deg
        bare = [] if config.stalls.only_runs else _bare_runs(plan, config.bay, self._given)
        bare, for_motorcycles = self._without_motorcycles(structure, bare, rng)
        mixed = [bare[index] for index in rng.permutation(len(bare)).tolist()]
        # the longest runs first, so that short ones even out the rest of the shares
        mixed.sort(key=lambda run: -len(run.squares))
        self._options = [self._options_of(run, angles_deg[int(rng.integers(len(angles_deg)))]) for run in mixed]
        self._options += [{_FOR_MOTORCYCLES: run} for run in for_motorcycles]
        self._backed = {squares for squares, count in Counter(run.squares for run in bare).items() if count > 1}
        self._chosen = self._drawn(structure)

    @property
    def runs(self) -> list[StallRun]:
        """The given and the drawn runs."""
        drawn = (options[option] for options, option in zip(self._options, self._chosen, strict=True))
        return [*self._given, *drawn]

    def even_out(self, structure: Structure) -> None:
        """Change the options of single runs while the shares come closer to the requested ones; sizes stay."""
        counts = [{option: self._count(structure, run) for option, run in options.items()} for options in self._options]
        stalls = Counter[_Option]()
        for own, option in zip(counts, self._chosen, strict=True):
            stalls[option] += own[option]
        for _ in counts:
            error, found = self._error(stalls), None
            for number, own in enumerate(counts):
                now = self._chosen[number]
                for option in own:
                    changed = stalls.copy()
                    changed[now] -= own[now]
                    changed[option] += own[option]
                    if own[option] and self._error(changed) < error - _LEAST_GAIN:
                        error, found = self._error(changed), (number, option, changed)
            if found is None:
                break
            number, option, stalls = found
            self._chosen[number] = option

    def _error(self, stalls: Mapping[_Option, int]) -> float:
        total = sum(stalls.values()) or 1
        return sum(abs(stalls[option] / total - share) for option, share in self._shares.items())

    def _options_of(self, run: StallRun, angle_deg: float) -> dict[_Option, StallRun]:
        return {
            (kind, size): replace(run, shape=_shape(self._config, kind, size, angle_deg))
            for kind, size in self._shares
            if size.takes_cars
        }

    def _without_motorcycles(
        self, structure: Structure, bare: list[StallRun], rng: np.random.Generator
    ) -> tuple[list[StallRun], list[StallRun]]:
        """Split runs into those for cars and those for motorcycles."""
        if _FOR_MOTORCYCLES not in self._shares:
            return bare, []

        def alone(run: StallRun) -> int:
            deepened = _deepened(structure, self._bay, run)
            return self._counts.of(deepened.row_depths_mm, deepened.column_widths_mm, run, is_backed=False)

        backs = Counter(run.squares for run in bare)
        return split_for_motorcycles(
            bare,
            _shape(self._config, *_FOR_MOTORCYCLES, PERPENDICULAR_DEG),
            self._shares[_FOR_MOTORCYCLES],
            rng,
            count=alone,
            is_whole=lambda run: backs[run.squares] > 1,
        )

    def _drawn(self, structure: Structure) -> list[_Option]:
        """Give each run the option furthest below its share that fits, or the first one if none does."""
        counts = Counter[_Option]()
        chosen = []
        for options in self._options:
            total, best, best_deficit = sum(counts.values()), next(iter(options)), -np.inf
            for option, run in options.items():
                count = self._count(_deepened(structure, self._bay, run), run)
                deficit = self._shares[option] * (total + count) - counts[option]
                if count and deficit > best_deficit:
                    best, best_deficit, best_count = option, deficit, count
            if best_deficit > -np.inf:
                counts[best] += best_count
            chosen.append(best)
        return chosen

    def _count(self, structure: Structure, run: StallRun) -> int:
        sides = structure.row_depths_mm, structure.column_widths_mm
        return self._counts.of(*sides, run, is_backed=run.squares in self._backed)


def _checked_runs(plan: Plan, config: GarageConfig) -> list[StallRun]:
    """Return the given runs of settings, all of whose squares are free with a lane beyond their edge."""
    structure, runs = plan.structure, runs_of_settings(config.stalls.runs, config, plan.directions)
    for number, run in enumerate(runs):
        for square in run.squares:
            cells = structure.cell_at(square), structure.cell_at(run.edge.beyond(square))
            if cells != (Cell.FREE, Cell.LANE):
                where = f"{list(square)}, {run.edge.name.lower()}"
                raise ConfigError(f"stalls.runs[{number}]", where, "free squares with a lane beyond that edge")
    return runs


def _bare_runs(plan: Plan, bay: BayConfig, given: Iterable[StallRun]) -> list[StallRun]:
    """Return the runs of perpendicular stalls on all squares that no given run has, each with one way of traffic."""
    taken = {square for run in given for square in run.squares}
    return runs_of_rows(
        replace(row, lean=lean_of_traffic(row.square, row.edge, plan.directions))
        for row in stall_rows(plan.structure, bay)
        if row.square not in taken
    )


def _shape(config: GarageConfig, kind: StallKind, size: SizeClass, angle_deg: float) -> StallShape:
    """Return the shape of stalls of a kind and size class, with the sizes of the profile where none are given."""
    bay, stalls, profile = config.bay, config.stalls, config.standard
    width_m, length_m = stalls.size_m(size, (bay.stall_width_m, bay.stall_length_m))
    if size is SizeClass.COMPACT and size not in stalls.sizes_m:
        width_m = max(width_m, _rounded_up_m(profile.compact_stall_width))
        length_m = max(length_m, _rounded_up_m(profile.compact_stall_length))
    if size is SizeClass.MOTORCYCLE and size not in stalls.sizes_m:
        width_m = max(width_m, _rounded_up_m(profile.motorcycle_stall_width))
        length_m = max(length_m, _rounded_up_m(profile.motorcycle_stall_length))
    if kind is StallKind.PARALLEL:
        longer_m = length_m - bay.stall_length_m
        standard_m = stalls.parallel_length_m or _rounded_up_m(profile.parallel_stall_length) or _PARALLEL_LENGTH_M
        length_m = round(standard_m + longer_m, 3)
        width_m = max(width_m, _rounded_up_m(profile.parallel_stall_width))
    of_kind = {StallKind.PERPENDICULAR: PERPENDICULAR_DEG, StallKind.PARALLEL: PARALLEL_DEG}
    return StallShape(width_m, length_m, of_kind.get(kind, angle_deg), size.value)


def _rounded_up_m(clause: Length | None) -> float:
    """Round the length of a clause up to the centimetre; 0 without one."""
    return 0.0 if clause is None else _rounded_mm(clause.amount) / _MM_PER_M


def _deepened(structure: Structure, bay: BayConfig, run: StallRun) -> Structure:
    """Return a structure whose line of a run is as deep as its stalls need, if the sides of such lines are chosen."""
    if not bay.chosen_sides[not run.edge.along_x]:
        return structure
    sides = [structure.column_widths_mm.copy(), structure.row_depths_mm.copy()]
    axis = int(run.edge.along_x)
    line = run.first[0] if run.edge.along_x else run.first[1]
    sides[axis][line] = max(sides[axis][line], _rounded_mm(depth_needed_m(run.shape, bay)))
    return Structure(structure.cells, *sides)


class _Fitting:
    """Sides of lines without traffic along them, each chosen by the least floor per stall."""

    def __init__(self, plan: Plan, config: GarageConfig, runs: Sequence[StallRun], counts: _Counts) -> None:
        structure, bay, spacing = plan.structure, config.bay, config.standard.column_spacing
        self._longest_span_mm = (spacing.bounds[1] if spacing else math.inf) * _MM_PER_M
        self._cells, self._bay, self._runs, self._known = structure.cells, bay, runs, counts
        self._inside = (structure.cells != Cell.OBSTACLE).astype(np.int64)
        self._sides_mm = [structure.row_depths_mm.copy(), structure.column_widths_mm.copy()]
        self._least_mm = [
            np.where(has_door, round(bay.portal_side_m * _MM_PER_M), 0) for has_door in lines_with_doors(structure)
        ]
        # room behind a door for a gate and a car that waits before it
        portals = (structure.cells == Cell.ENTRANCE) | (structure.cells == Cell.EXIT)
        for axis, least_mm in enumerate(self._least_mm):
            has_portal = portals.any(axis=1 - axis)
            least_mm[has_portal] = np.maximum(least_mm[has_portal], _rounded_mm(bay.stall_length_m))
        self._backs = Counter((square, run.edge.along_x) for run in runs for square in run.squares)
        with_aisles = lines_with_aisles(structure)
        self._lines = [
            (axis, line)
            for axis, is_chosen in enumerate(bay.chosen_sides)
            if is_chosen
            for line in range(structure.shape[axis])
            if not with_aisles[axis][line] and (structure.cells.take(line, axis=axis) == Cell.FREE).any()
        ]
        for axis, is_chosen in enumerate(bay.chosen_sides):
            for line in np.flatnonzero(with_aisles[axis]).tolist() if is_chosen else ():
                side_mm = _aisle_side_mm(plan, config, runs, axis, line)
                self._sides_mm[axis][line] = max(side_mm, int(self._least_mm[axis][line]))
        self._of_line = {line: self._runs_on(*line) for line in self._lines}
        self._deepest_mm = [
            max(int(self._sides_mm[axis][line]), self._needed_mm(axis, line)) for axis, line in self._lines
        ]
        self._counts: list[int] = []

    def fitted(self) -> Structure:
        """Improve all lines together, then one after the other until none gains.

        This is done twice, with lines as deep as their stalls need and half a column deeper, where fewer columns touch
        the rears of angled stalls; the better end is taken.
        """
        ends = []
        for deeper_mm in (0, _rounded_mm(self._bay.column_size_m / 2)):
            for (axis, line), side_mm in zip(self._lines, self._deepest_mm, strict=True):
                self._sides_mm[axis][line] = side_mm + deeper_mm
            self._counts = [self._count(run) for run in self._runs]
            self._improve_together()
            for _ in range(_PASSES):
                if not sum(self._improve(*line) for line in self._lines):
                    break
            ends.append((self._floor_per_stall(self._counts), Structure(self._cells, *self._sides_mm[::-1])))
        return min(ends, key=lambda end: end[0])[1]

    def _improve_together(self) -> None:
        """Give all lines of an axis that may have it the same side, where that lowers the floor per stall.

        Angled stalls pass the columns in step only if many lines in a row have the same side.
        """
        for axis in range(len(self._sides_mm)):
            choices_mm = {line: self._choices_mm(axis, line) for own, line in self._lines if own == axis}
            sides_mm = self._sides_mm[axis]
            best = self._floor_per_stall(self._counts), sides_mm, self._counts
            for side_mm in sorted({side_mm for choices in choices_mm.values() for side_mm in choices}):
                self._sides_mm[axis] = sides_mm.copy()
                for line, choices in choices_mm.items():
                    if side_mm in choices:
                        self._sides_mm[axis][line] = side_mm
                counts = [self._count(run) for run in self._runs]
                trial = self._floor_per_stall(counts), self._sides_mm[axis], counts
                best = min(best, trial, key=lambda found: found[0])
            _, self._sides_mm[axis], self._counts = best

    def _runs_on(self, axis: int, line: int) -> list[int]:
        """Numbers of the runs with a square on a line."""
        return [number for number, run in enumerate(self._runs) if any(square[axis] == line for square in run.squares)]

    def _count(self, run: StallRun) -> int:
        depths_mm, widths_mm = self._sides_mm
        return self._known.of(depths_mm, widths_mm, run, is_backed=self._backs[run.first, run.edge.along_x] > 1)

    def _needed_mm(self, axis: int, line: int) -> int:
        """Depth that the runs along a line need."""
        across = (self._runs[number] for number in self._of_line[axis, line])
        return max(
            (
                _rounded_mm(depth_needed_m(run.shape, self._bay)) * self._backs[square, run.edge.along_x]
                for run in across
                if run.edge.along_x == (axis == 0)
                for square in run.squares
            ),
            default=0,
        )

    def _choices_mm(self, axis: int, line: int) -> list[int]:
        """Sides to try: as deep as the runs along the line need, and as wide as some stalls of the runs across it."""
        deep = max(self._needed_mm(axis, line), int(self._least_mm[axis][line]))
        half_column_m = self._bay.column_size_m / 2
        found = {deep, deep + _rounded_mm(half_column_m)} if deep else set()
        shapes = {
            run.shape
            for run in (self._runs[number] for number in self._of_line[axis, line])
            if run.edge.along_x != (axis == 0) and SizeClass(run.shape.size).takes_cars
        }
        # ignore parallel stalls beside other kinds: they would require spans that no other row needs
        spanned = {shape for shape in shapes if shape.kind is not StallKind.PARALLEL} or shapes
        for shape in spanned:
            is_angled = shape.kind is StallKind.ANGLED
            lost_m = {self._bay.row_ends_m, *(lost_at_columns_m(shape, self._bay) if is_angled else ())}
            counts = _PARALLEL_BETWEEN_COLUMNS if shape.kind is StallKind.PARALLEL else _STALLS_BETWEEN_COLUMNS
            found |= {_rounded_mm(count * shape.pitch_m + lost) for count in counts for lost in lost_m}
        found = {side for side in found if side <= self._longest_span_mm} or {min(found, default=deep)}
        now = int(self._sides_mm[axis][line])
        return sorted({max(side, deep) for side in found if side} or {now})

    def _improve(self, axis: int, line: int) -> bool:
        """Give a line the side with the least floor per stall, if that is less than now."""
        affected, before_mm = self._of_line[axis, line], int(self._sides_mm[axis][line])
        best = self._floor_per_stall(self._counts), before_mm, self._counts
        for side in self._choices_mm(axis, line):
            self._sides_mm[axis][line] = side
            counts = list(self._counts)
            for number in affected:
                counts[number] = self._count(self._runs[number])
            best = min(best, (self._floor_per_stall(counts), side, counts), key=lambda found: found[0])
        _, self._sides_mm[axis][line], self._counts = best
        return best[1] != before_mm

    def _floor_per_stall(self, counts: Sequence[int]) -> float:
        stalls = sum(counts)
        depths_mm, widths_mm = self._sides_mm
        floor_m2 = float(depths_mm @ self._inside @ widths_mm) / _MM_PER_M**2
        return round(floor_m2 / stalls, 9) if stalls else math.inf


def _aisle_side_mm(plan: Plan, config: GarageConfig, runs: Iterable[StallRun], axis: int, line: int) -> int:
    """Return the side of a row (0) or a column (1) of squares across the aisles along it, for their stalls.

    If all of them are one-way and have stalls, they are as wide as the profile asks for these stalls, and never wider
    than others.
    """
    bay, edge = config.bay, Edge.RIGHT if axis == 0 else Edge.DOWN
    steps = ((square, edge.beyond(square)) for square in plan.structure.where(Cell.LANE) if square[axis] == line)
    between_lanes = [step for step in steps if plan.structure.cell_at(step[1]) is Cell.LANE]
    widths_m = [
        _aisle_width_m(run, plan.directions, config)
        for run in runs
        if run.edge.along_x == (axis == 0) and run.edge.beyond(run.first)[axis] == line
    ]
    is_one_way = all(plan.directions.is_one_way(*step) for step in between_lanes)
    width_m = min(max(widths_m), bay.aisle_width_m) if widths_m and between_lanes and is_one_way else bay.aisle_width_m
    return _rounded_mm(width_m + 2 * bay.carriageway_setback_m)


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


def _rounded_mm(length_m: float) -> int:
    """Round up to the centimetre, in millimetres."""
    return math.ceil(round(length_m * _MM_PER_M, 3) / _STEP_MM) * _STEP_MM
