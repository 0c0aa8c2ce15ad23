"""Kinds and sizes of stalls for finished lanes: drawn run by run, then changed for less floor and better shares."""
# Over 300 lines: the draw, the shapes that it draws and the moves that improve it change together.

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.stalls import GivenRun, SizeClass
from garage2usd.garage import StallKind
from garage2usd.planning.planner import Plan
from garage2usd.planning.score import evaluate
from garage2usd.planning.stall_sides import StallCounts, StallSides, rounded_mm
from garage2usd.profiles import Length
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections
from garage2usd.structure.packing import depth_needed_m
from garage2usd.structure.stall_runs import (
    StallRun,
    lean_of_traffic,
    rows_of_runs,
    runs_of_rows,
    split_for_motorcycles,
)
from garage2usd.structure.stalls import PARALLEL_DEG, PERPENDICULAR_DEG, Edge, StallShape, stall_rows

_MM_PER_M = 1000
_PASSES = 4
WRONG_SHARE_M2 = 30.0
"""Floor per stall that a sum of 1 over the differences from the wanted shares is worth."""
_LEAST_GAIN = 1e-6
_TOLD_SHARE = 0.05
"""Difference of a share from the wanted one above which it is told: a run of squares has one kind."""
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
    so far, among those that fit: squares whose sides are not chosen must be deep enough. Lines of squares then get the
    sides with the least floor per stall (`garage2usd.planning.stall_sides`). By first improvement, single runs take
    another option and pairs that of each other, while that lowers the floor per stall plus the price of wrong shares.
    If kinds are free, the garage is laid out with each kind and angle alone, and gets the one with the least floor per
    stall; among equal ones the first of perpendicular, angled, parallel.
    """
    if config.stalls.is_free:
        return _least_floor(plan, config)
    if config.stalls.is_uniform:
        return plan
    counts = StallCounts(plan.structure.cells, config.bay)
    draw = _Draw(plan, config, counts)
    draw.improve(StallSides(plan, config, draw.runs, counts))
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
    return min(plans, key=floor_per_stall_m2)


def floor_per_stall_m2(plan: Plan) -> float:
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
    return _with_runs(plan, config, runs, StallCounts(plan.structure.cells, config.bay))


def _with_runs(plan: Plan, config: GarageConfig, runs: Iterable[StallRun], counts: StallCounts) -> Plan:
    ordered = sorted(runs, key=lambda run: (run.first, run.edge))
    sides = StallSides(plan, config, ordered, counts)
    sides.fit()
    structure = sides.structure
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


_Option = tuple[StallKind, SizeClass]
_FOR_MOTORCYCLES: _Option = StallKind.PERPENDICULAR, SizeClass.MOTORCYCLE


class _Draw:
    """Draw of the kinds of all runs of a garage, which tracks the shares of stalls of each kind."""

    def __init__(self, plan: Plan, config: GarageConfig, counts: StallCounts) -> None:
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

    def improve(self, sides: StallSides) -> None:
        """Give single runs other options, and pairs each other's, while that lowers floor per stall and wrong shares.

        `sides` has the given and the drawn runs, and is changed with them.
        """
        sides.fit()
        cost_m2 = self._cost_m2(sides, self._chosen)
        for _ in range(_PASSES):
            before_m2 = cost_m2
            for move in self._moves():
                if any(self._chosen[number] == option for number, option in move.items()):
                    continue
                chosen = [move.get(number, option) for number, option in enumerate(self._chosen)]
                changes = {len(self._given) + number: self._options[number][option] for number, option in move.items()}
                with sides.tried(changes):
                    trial_m2 = self._cost_m2(sides, chosen)
                if trial_m2 < cost_m2 - _LEAST_GAIN:
                    sides.change(changes)
                    self._chosen, cost_m2 = chosen, trial_m2
            if cost_m2 == before_m2:
                break

    def _moves(self) -> Iterator[dict[int, _Option]]:
        """Yield options for single runs by their number, and for pairs the options of each other."""
        for number, options in enumerate(self._options):
            for option in options:
                yield {number: option}
        for one, other in combinations(range(len(self._options)), 2):
            own, of_other = self._chosen[one], self._chosen[other]
            if own != of_other and own in self._options[other] and of_other in self._options[one]:
                yield {one: of_other, other: own}

    def _cost_m2(self, sides: StallSides, chosen: Sequence[_Option]) -> float:
        """Floor per stall, and what shares of the stalls that are not as asked for cost."""
        stalls = Counter[_Option]()
        for count, option in zip(sides.counts[len(self._given) :], chosen, strict=True):
            stalls[option] += count
        return sides.floor_per_stall_m2 + WRONG_SHARE_M2 * _share_error(stalls, self._shares)

    def _options_of(self, run: StallRun, angle_deg: float) -> dict[_Option, StallRun]:
        options = {
            (kind, size): replace(run, shape=_shape(self._config, kind, size, angle_deg))
            for kind, size in self._shares
            if size.takes_cars
        }
        # a single parallel stall takes the depth of a row, and a driver expects none beside other kinds
        rows = {
            option: own
            for option, own in options.items()
            if option[0] is not StallKind.PARALLEL or len(own.squares) > 1
        }
        return rows or options

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


def wrong_shares(plan: Plan, config: GarageConfig) -> float:
    """Return the sum of the differences between the shares of the stalls of each kind and size and the wanted ones."""
    if config.stalls.is_free or not plan.runs:
        return 0.0
    return _share_error(_stalls_of(plan, config), config.stalls.shares)


def _stalls_of(plan: Plan, config: GarageConfig) -> Counter[_Option]:
    """Count the stalls of each kind and size."""
    stalls = Counter[_Option]()
    for row in rows_of_runs(plan.structure, config.bay, plan.runs):
        stalls[row.shape.kind, SizeClass(row.shape.size)] += row.count
    return stalls


def unheld_shares(plans: Iterable[Plan], config: GarageConfig) -> tuple[str, ...]:
    """Return a line on the kinds and one on the sizes of stalls, if a share is more than 0.05 from the wanted one.

    Parameters
    ----------
    plans
        The plan of each level.
    config
        The wanted shares.
    """
    stalls = config.stalls
    if stalls.is_free or stalls.is_uniform or stalls.only_runs:
        return ()
    lines = []
    held = Counter[_Option]()
    for plan in plans:
        held += _stalls_of(plan, config)
    for part, field in enumerate(("kinds", "sizes")):
        shares: dict[str, list[float]] = {}
        for option in {**stalls.shares, **held}:
            of_value = shares.setdefault(option[part].value, [0.0, 0.0])
            of_value[0] += stalls.shares.get(option, 0.0)
            of_value[1] += held[option] / (held.total() or 1)
        if any(abs(asked - got) > _TOLD_SHARE for asked, got in shares.values()):
            wanted, found = (
                ", ".join(f"{value} = {of_value[index]:.2f}" for value, of_value in shares.items()) for index in (0, 1)
            )
            lines.append(f"stalls.{field}: got {wanted}; the lanes planned on this site hold {found}")
    return tuple(lines)


def no_stalls(plan: Plan, config: GarageConfig) -> ConfigError:
    """Return the error of a plan in which no stall fits; if all are angled, it names the nearest angle that does."""
    structure, asked = plan.structure, config.stalls.angles_deg
    if {run.shape.kind for run in plan.runs} != {StallKind.ANGLED}:
        return ConfigError(
            "site.structure", str(structure), "at least one free square beside a lane that takes a stall"
        )
    deepest_m = max(structure.row_depths_mm.max(), structure.column_widths_mm.max()) / _MM_PER_M
    depths_m = {angle: _shape(config, StallKind.ANGLED, SizeClass.STANDARD, angle).depth_m for angle in range(30, 86)}
    fitting = [angle for angle, depth_m in depths_m.items() if depth_m <= deepest_m]
    if not fitting:
        least_m = min(depths_m.values())
        return ConfigError(
            "stalls.angles_deg", list(asked), f"perpendicular stalls, or squares of {least_m:g} m or more"
        )
    nearest = min(fitting, key=lambda angle: min(abs(angle - each) for each in asked))
    return ConfigError("stalls.angles_deg", list(asked), f"{nearest}, the nearest angle on squares of {deepest_m:g} m")


def _share_error(stalls: Mapping[_Option, int], shares: Mapping[_Option, float]) -> float:
    total = sum(stalls.values()) or 1
    return sum(abs(stalls[option] / total - share) for option, share in shares.items())


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
    return 0.0 if clause is None else rounded_mm(clause.amount) / _MM_PER_M


def _deepened(structure: Structure, bay: BayConfig, run: StallRun) -> Structure:
    """Return a structure whose line of a run is as deep as its stalls need, if the sides of such lines are chosen."""
    if not bay.chosen_sides[not run.edge.along_x]:
        return structure
    sides = [structure.column_widths_mm.copy(), structure.row_depths_mm.copy()]
    axis = int(run.edge.along_x)
    line = run.first[0] if run.edge.along_x else run.first[1]
    sides[axis][line] = max(sides[axis][line], rounded_mm(depth_needed_m(run.shape, bay)))
    return Structure(structure.cells, *sides)
