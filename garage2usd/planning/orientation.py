"""One-way aisles for finished lanes: an orientation of stretches that reaches every stall, with little detour."""
# Over 300 lines: the orientation, the drives that it is judged by, and the choice of lanes that it decides.

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import GarageConfig
from garage2usd.config.plan import Aisles
from garage2usd.planning.local_search import distinct_plans
from garage2usd.planning.planner import Plan, alternatives
from garage2usd.planning.stall_kinds import WRONG_SHARE_M2, floor_per_stall_m2, with_stall_kinds, wrong_shares
from garage2usd.structure.grid import Cell, Structure, squares_beside
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections, given_directions, lane_squares_graph, stretches_of
from garage2usd.structure.stall_runs import capacity_of_runs
from garage2usd.structure.stalls import square_capacity

Square = tuple[int, int]
_TRIALS_PER_STRETCH = 12
_MOST_TRIALS = 1500
_HOTTEST_M, _COLDEST_M = 15.0, 0.2
_CLOCKWISE_M = 10.0
"""Metres of mean drive that all lanes turning against the side of traffic are worth."""
_MM_PER_M = 1000
_CANDIDATES = 3
"""Plans of the archive that are completed to be compared. With six, stalls at 60 degrees take 0.7 % less floor."""
_DETOUR_M2 = 3.0
"""Floor per stall that drives twice as long are worth."""


class DrivenLengths(NamedTuple):
    """Mean lengths of drives from the nearest entrance to a stall and on to the nearest exit.

    Attributes
    ----------
    two_way_m
        Mean length if all lanes are driven both ways.
    directed_m
        Mean length along the directions of the lanes; infinite if a stall is not reached.
    """

    two_way_m: float
    directed_m: float

    @property
    def detour(self) -> float:
        """Factor of the drives along the directions; 1 without stalls."""
        return self.directed_m / self.two_way_m if self.two_way_m else 1.0


def with_directions(plan: Plan, config: GarageConfig) -> Plan:
    """Turn stretches of lane to one-way aisles, as the settings ask for.

    Parameters
    ----------
    plan
        Lanes with their stalls.
    config
        ``plan.aisles``, ``plan.one_way_share``, ``plan.one_way`` and the seed.

    Returns
    -------
    Plan
        The same lanes with directions; the given plan if all aisles are two-way.

    Raises
    ------
    ConfigError
        If a given step does not lead from a lane to an adjacent one.
    GenerationError
        If a stall is not reached along given directions.

    Notes
    -----
    By Robbins' theorem (1939) lanes without a bridge have an orientation in which each is reached from each; bridges
    stay two-way (Boesch and Tindell, 1980). Lanes are turned without the portals, so that a driver who found no stall
    drives round again instead of out to the street. From the orientation of a depth-first search, simulated annealing
    flips stretches for short drives from an entrance over each stall to an exit, and for loops that turn to the side of
    traffic.
    """
    settings, structure = config.plan, plan.structure
    if settings.one_way:
        directions = given_directions(structure, settings.one_way, field="plan.one_way")
        if not np.isfinite(driven_lengths(plan, config, directions).directed_m):
            reason = "not every stall is reached from an entrance and reaches an exit along the directions given"
            raise GenerationError("plan", reason, seed=config.seed, attempts=1)
    elif settings.aisles is Aisles.TWO_WAY:
        return plan
    else:
        share = settings.one_way_share if settings.aisles is Aisles.MIXED else 1.0
        directions = _Orientation(plan, config).directions(share)
    return replace(plan, directions=directions)


def driven_lengths(plan: Plan, config: GarageConfig, directions: LaneDirections) -> DrivenLengths:
    """Compute the mean lengths of drives over all stalls, with and without directions."""
    drives = _Drives(plan, config)
    return DrivenLengths(drives.mean_m(BOTH_WAYS), drives.mean_m(directions))


class _Drives:
    """Lengths of drives over the lanes of a plan."""

    def __init__(self, plan: Plan, config: GarageConfig) -> None:
        structure = plan.structure
        cells = structure.cells
        self.squares = [(row, col) for row, col in np.argwhere(cells >= Cell.LANE).tolist()]
        self.number_of = {square: number for number, square in enumerate(self.squares)}
        self._steps = [
            (start, end, _length_m(structure, start, end))
            for start in self.squares
            for end in squares_beside(start)
            if end in self.number_of and Cell.LANE in {cells[start], cells[end]}
            # into the garage by an entrance and out of it by an exit
            if cells[end] != Cell.ENTRANCE and cells[start] != Cell.EXIT
        ]
        self._entrances, self._exits = (
            [self.number_of[square] for square in structure.where(kind)] for kind in (Cell.ENTRANCE, Cell.EXIT)
        )
        self._stalls = self._stalls_beside(plan, config)

    def _stalls_beside(self, plan: Plan, config: GarageConfig) -> NDArray[np.float64]:
        """Stalls on the squares beside each lane; float64, shape (squares,)."""
        structure, bay = plan.structure, config.bay
        capacity = capacity_of_runs(structure, bay, plan.runs) if plan.runs else square_capacity(structure, bay)
        stalls = np.zeros(len(self.squares))
        for row, col in np.argwhere(capacity > 0).tolist():
            lanes = [
                lane
                for lane in squares_beside((row, col))
                if lane in self.number_of and structure.cells[lane] == Cell.LANE
            ]
            for lane in lanes:
                stalls[self.number_of[lane]] += capacity[row, col] / len(lanes)
        return stalls

    def mean_m(self, directions: LaneDirections) -> float:
        """Mean length of the drives; infinite if a lane with stalls is not reached or does not reach an exit."""
        from scipy import sparse  # noqa: PLC0415 - slow to import, and few garages have one-way lanes
        from scipy.sparse import csgraph  # noqa: PLC0415

        allowed = [(start, end, length) for start, end, length in self._steps if directions.allows(start, end)]
        rows = [self.number_of[start] for start, _, _ in allowed]
        cols = [self.number_of[end] for _, end, _ in allowed]
        count = len(self.squares)
        graph = sparse.csr_array(([length for *_, length in allowed], (rows, cols)), shape=(count, count))
        there = csgraph.dijkstra(graph, indices=self._entrances, min_only=True)
        onward = csgraph.dijkstra(graph.T.tocsr(), indices=self._exits, min_only=True)
        served = self._stalls > 0
        if not served.any():
            return 0.0
        return round(float(np.average((there + onward)[served], weights=self._stalls[served])), 6)


class _Orientation:
    """Stretches of lane without bridges, and the best directions for them."""

    def __init__(self, plan: Plan, config: GarageConfig) -> None:
        self._drives = _Drives(plan, config)
        self._rng = generator(config.seed, Step.DIRECTIONS)
        self._side = -1 if config.standard.drives_on_left else 1
        structure = plan.structure
        graph = lane_squares_graph(structure)
        bridges = {frozenset(bridge) for bridge in nx.bridges(graph)}
        self._stretches = [path for path in stretches_of(structure) if frozenset(path[:2]) not in bridges]
        self._middles_m = {
            (row, col): (
                float(structure.column_edges_m[col : col + 2].mean()),
                float(structure.row_edges_m[row : row + 2].mean()),
            )
            for row, col in graph
        }
        self._turns = self._turns_of_stretches()
        graph.remove_edges_from(map(tuple, bridges))
        self._forward = self._depth_first(graph)

    def directions(self, share: float) -> LaneDirections:
        """Turn a share of the length of the stretches; the rest stays two-way."""
        chosen = self._paths(self._annealed())
        lengths = [len(path) - 1 for path in chosen]
        left, turned = share * sum(lengths), []
        for index in self._rng.permutation(len(chosen)).tolist():
            # turn the stretch if the share of one-way lanes comes closer to the requested one
            if lengths[index] / 2 <= left:
                turned.append(chosen[index])
                left -= lengths[index]
        return LaneDirections.of_stretches(turned)

    def _depth_first(self, graph: "nx.Graph[Square]") -> list[bool]:
        """Orient edges of the tree of a depth-first search away from the root, and all others back to it."""
        order: dict[Square, int] = {}
        tree: set[frozenset[Square]] = set()
        for component in nx.connected_components(graph):
            for start, end in nx.dfs_edges(graph, min(component)):
                order.setdefault(start, len(order))
                order.setdefault(end, len(order))
                tree.add(frozenset((start, end)))
        return [(order[path[0]] < order[path[1]]) == (frozenset(path[:2]) in tree) for path in self._stretches]

    def _turns_of_stretches(self) -> list[float]:
        """Measure how far each stretch leads around the middle of the lanes in the sense of traffic; -1 to 1."""
        places = np.array(list(self._middles_m.values())).reshape(-1, 2)
        if not len(places):
            return []
        middle = (places.min(axis=0) + places.max(axis=0)) / 2
        areas = []
        for path in self._stretches:
            points = np.array([self._middles_m[square] for square in path]) - middle
            # seen from above, with Z downwards, this is positive for a drive to the left around the middle
            areas.append(-float((points[:-1, 0] * points[1:, 1] - points[1:, 0] * points[:-1, 1]).sum()) / 2)
        total = sum(map(abs, areas)) or 1.0
        return [self._side * area / total for area in areas]

    def _paths(self, forward: list[bool]) -> list[tuple[Square, ...]]:
        """Return the stretches in the order in which they are driven."""
        return [path if ahead else path[::-1] for path, ahead in zip(self._stretches, forward, strict=True)]

    def _cost_m(self, forward: list[bool]) -> float:
        directions = LaneDirections.of_stretches(self._paths(forward))
        turned = sum(turn if ahead else -turn for turn, ahead in zip(self._turns, forward, strict=True))
        return self._drives.mean_m(directions) - _CLOCKWISE_M * turned / 2

    def _annealed(self) -> list[bool]:
        """Flip stretches by simulated annealing (Kirkpatrick et al., 1983) while every stall stays reached."""
        forward = list(self._forward)
        if not forward:
            return forward
        now = self._cost_m(forward)
        best, best_cost = list(forward), now
        trials = min(_TRIALS_PER_STRETCH * len(forward), _MOST_TRIALS)
        for trial in range(trials):
            heat_m = _HOTTEST_M + (_COLDEST_M - _HOTTEST_M) * trial / trials
            flipped = self._rng.integers(len(forward), size=1 + int(self._rng.integers(3)))
            for index in flipped.tolist():
                forward[index] = not forward[index]
            cost = self._cost_m(forward) if self._is_strong(forward) else np.inf
            if cost <= now + heat_m * self._rng.random():
                now = cost
                if cost < best_cost:
                    best, best_cost = list(forward), cost
            else:
                for index in flipped.tolist():
                    forward[index] = not forward[index]
        return best

    def _is_strong(self, forward: list[bool]) -> bool:
        """Return True if every lane reaches every other one within each piece between bridges."""
        from scipy import sparse  # noqa: PLC0415 - likewise
        from scipy.sparse import csgraph  # noqa: PLC0415

        ends: dict[Square, int] = {}
        rows, cols = [], []
        for path, ahead in zip(self._stretches, forward, strict=True):
            start, end = (ends.setdefault(path[at], len(ends)) for at in ((0, -1) if ahead else (-1, 0)))
            rows.append(start)
            cols.append(end)
        graph = sparse.csr_array((np.ones(len(rows)), (rows, cols)), shape=(len(ends), len(ends)))
        weak = csgraph.connected_components(graph, directed=True, connection="weak")[0]
        strong = csgraph.connected_components(graph, directed=True, connection="strong")[0]
        return bool(weak == strong)


def _length_m(structure: Structure, start: Square, end: Square) -> float:
    """Length from the middle of a square to that of an adjacent one."""
    axis = int(start[0] == end[0])
    sides = (structure.row_depths_mm, structure.column_widths_mm)[axis]
    return float(sides[start[axis]] + sides[end[axis]]) / (2 * _MM_PER_M)


def completed(plan: Plan, config: GarageConfig) -> Plan:
    """Give a plan of lanes its directions and stalls.

    Parameters
    ----------
    plan
        Plan of the lanes.
    config
        Settings of directions and kinds of stalls.

    Raises
    ------
    ConfigError, GenerationError
        As `with_directions` and `with_stall_kinds`.

    Notes
    -----
    Lanes are planned for perpendicular stalls and traffic in both directions. If others are asked for, a few of the
    best plans of the archive are completed, and the one is taken that then has the least floor per stall, with a price
    for detours and for shares of the stalls that are not as asked for.
    """
    done = [with_stall_kinds(with_directions(lanes, config), config) for lanes in _candidates(plan, config)]
    return min(done, key=partial(_cost_m2, config=config)) if len(done) > 1 else done[0]


def _candidates(plan: Plan, config: GarageConfig) -> Iterator[Plan]:
    """Yield a plan of lanes and, where they may serve better, others of its archive with mostly other lanes."""
    is_as_planned = config.stalls.is_uniform and config.plan.aisles is Aisles.TWO_WAY
    is_prescribed = config.plan.one_way or config.stalls.runs
    if is_as_planned or is_prescribed:
        yield plan
        return
    plans = list(alternatives(plan, config))
    lanes = [(float(number), each.structure.cells == Cell.LANE) for number, each in enumerate(plans)]
    yield from (plans[int(number)] for number, _ in distinct_plans(lanes, _CANDIDATES))


def _cost_m2(plan: Plan, config: GarageConfig) -> float:
    """Floor per stall with the prices of detours and of wrong shares."""
    detour = driven_lengths(plan, config, plan.directions).detour
    return floor_per_stall_m2(plan) + _DETOUR_M2 * detour + WRONG_SHARE_M2 * wrong_shares(plan, config)
