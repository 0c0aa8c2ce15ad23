"""A plan: lanes on a site, learnt by Sarsa or given by the user."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.errors import GenerationError
from garage2usd.grid import Cell, Structure
from garage2usd.planning.score import Score, evaluate
from garage2usd.progress import Progress, silent
from garage2usd.randomness import Step, generator
from garage2usd.stalls import capacity_table

__all__ = ["ArchivedPlan", "Plan", "given_plan", "plan_lanes"]

_BLOCKED, _FREE = -1, 0
_TABLE_BITS, _SMALL_TABLE_BITS = 20, 16
_BATCH_SQUARES = 20_000
_CLIMB_PASSES = 60
_CLIMB_SQUARES = 1_000_000


@dataclass(frozen=True, eq=False)
class ArchivedPlan:
    """One of the best plans met while learning."""

    structure: Structure
    score: Score


@dataclass(frozen=True, eq=False)
class Plan:
    """A complete structure with what is known of it.

    Attributes
    ----------
    structure
        S with lanes; every portal touches them and they form one piece, unless the user gave it otherwise.
    score
        Its figures.
    archive
        The best distinct plans met while learning, best first; empty for a given structure.
    learning_curve
        float64, shape (episodes,): G, the sum of the rewards of each episode without R_T.
    steps
        How many actions were taken while learning.
    """

    structure: Structure
    score: Score
    archive: tuple[ArchivedPlan, ...]
    learning_curve: NDArray[np.float64]
    steps: int = 0


def given_plan(structure: Structure, *, bay: BayConfig, plan: PlanConfig) -> Plan:
    """Take a complete structure as it is: nothing is learnt, `plan` gives the weights of its score."""
    return Plan(structure, evaluate(structure, bay=bay, plan=plan), (), np.zeros(0))


@dataclass(frozen=True, eq=False)
class _Board:
    """A site as the compiled planner wants it: flat arrays on a matrix padded by one blocked square."""

    kind: NDArray[np.int8]
    capacity: NDArray[np.int64]
    stride: int
    squares: NDArray[np.int64]
    entrances: NDArray[np.int64]
    portals: NDArray[np.int64]
    weights: NDArray[np.float64]

    @classmethod
    def of(cls, site: Structure, *, bay: BayConfig, plan: PlanConfig) -> "_Board":
        padded = np.pad(site.cells, 1, constant_values=Cell.OBSTACLE)
        stride = padded.shape[1]
        flat = padded.ravel()
        table = capacity_table(site, bay)
        layers = (table.along_x, table.along_x_double, table.along_z, table.along_z_double)
        capacity = np.stack([np.pad(layer, 1).ravel() for layer in layers], axis=1)
        return cls(
            kind=np.where(flat == Cell.FREE, _FREE, _BLOCKED).astype(np.int8),
            capacity=np.ascontiguousarray(capacity),
            stride=stride,
            squares=np.flatnonzero(flat == Cell.FREE),
            entrances=np.flatnonzero(flat == Cell.ENTRANCE),
            portals=np.flatnonzero((flat == Cell.ENTRANCE) | (flat == Cell.EXIT)),
            weights=np.array([plan.stall_weight, plan.parking_time_weight, plan.unused_weight]),
        )

    def portals_open(self) -> bool:
        """Whether there is a free square beside every portal."""
        beside = self.portals[:, None] + np.array([-self.stride, self.stride, -1, 1])
        return len(self.entrances) > 0 and bool((self.kind[beside] == _FREE).any(axis=1).all())

    def cells(self, site: Structure, lanes: NDArray[np.bool_]) -> NDArray[np.int8]:
        """The structure matrix of `site` with lanes on some of `squares`."""
        padded = np.pad(site.cells, 1, constant_values=Cell.OBSTACLE).ravel()
        padded[self.squares[lanes]] = Cell.LANE
        return padded.reshape(-1, self.stride)[1:-1, 1:-1]


def plan_lanes(site: Structure, *, plan: PlanConfig, bay: BayConfig, seed: int, progress: Progress = silent) -> Plan:
    """Plan the lanes of a site by tabular Sarsa.

    Parameters
    ----------
    site
        Static objects without lanes.
    plan
        Preset and parameters.
    bay
        Size of the stalls.
    seed
        Seed of the step.
    progress
        Told of the episodes done.

    Returns
    -------
    Plan
        The best plan met, always feasible: the lanes form one piece and touch every portal.

    Raises
    ------
    GenerationError
        If no lanes can join the portals.

    Notes
    -----
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))`` with an epsilon-greedy policy over up,
    down, left, right, stay. Deviation: the paper words epsilon opposite to its formula; the formula stands.
    """
    board = _Board.of(site, bay=bay, plan=plan)
    if not board.portals_open():
        raise GenerationError("plan", "a portal has no free square beside it", seed=seed, attempts=0)
    rng = generator(seed, Step.PLAN)
    archive, curve, steps = _learn(board, plan, rng, progress)
    if not archive:
        reason = "no lanes join every portal; free squares between the portals are too few"
        raise GenerationError("plan", reason, seed=seed, attempts=plan.episodes)
    if plan.climb:
        archive = _climb(board, archive, plan, rng)
    scored = [ArchivedPlan(site.with_cells(board.cells(site, lanes)), _score(board, lanes)) for lanes in archive]
    scored = sorted(scored, key=lambda entry: -entry.score.value)[: plan.archive_size]
    return Plan(scored[0].structure, scored[0].score, tuple(scored), curve, steps)


def _learn(
    board: _Board, plan: PlanConfig, rng: np.random.Generator, progress: Progress
) -> tuple[list[NDArray[np.bool_]], NDArray[np.float64], int]:
    """Run all episodes in batches, between which progress is told and signals are heard."""
    from garage2usd.planning.sarsa import learn  # noqa: PLC0415 - only planning pays for the compiler

    settings = plan.resolved()
    zobrist = rng.integers(1, 2**63, size=len(board.squares), dtype=np.uint64)
    random = rng.integers(1, 2**63, size=1, dtype=np.uint64)
    slots = 1 << (_SMALL_TABLE_BITS if settings.window_radius_squares == 1 else _TABLE_BITS)
    values = np.full(plan.archive_size, -np.inf)
    layouts = np.zeros((plan.archive_size, len(board.squares)), dtype=np.bool_)
    hashes = np.zeros(plan.archive_size + 1, dtype=np.uint64)
    curve = np.zeros(plan.episodes)
    batch = max(1, _BATCH_SQUARES // len(board.squares))
    count, steps = 0, 0
    starts = {plan.episodes * index // settings.restarts for index in range(settings.restarts)}
    bounds = sorted({*range(0, plan.episodes, batch), *starts, plan.episodes})
    for first, last in pairwise(bounds):
        progress("plan", first, plan.episodes)
        if first in starts:
            schedule = np.array([settings.epsilon_start, 0.0])
            keys = np.zeros(slots, dtype=np.uint64)
            table = np.zeros((slots, 5), dtype=np.float32)
        count, taken = learn(
            board.kind,
            board.capacity,
            board.stride,
            board.squares,
            board.entrances,
            board.portals,
            board.weights,
            zobrist,
            first,
            last,
            random,
            schedule,
            keys,
            table,
            values,
            layouts,
            hashes,
            curve,
            count,
            settings.alpha,
            settings.gamma,
            settings.epsilon_min,
            settings.epsilon_decay,
            settings.epsilon_refresh,
            settings.patience_episodes,
            settings.turn_back_penalty,
            settings.interval_penalty,
            settings.min_run_squares,
            settings.wheeling_penalty,
            settings.served_reward,
            settings.step_penalty,
            settings.window_radius_squares,
            settings.sees_distances,
            settings.masks_actions,
            settings.archives_prefixes,
            settings.max_steps_per_square * len(board.squares),
        )
        steps += taken
    return [layouts[index] for index in range(count)], curve, steps


def _score(board: _Board, lanes: NDArray[np.bool_]) -> Score:
    """The compiled score of one layout; `evaluate` gives the same from the structure."""
    from garage2usd.planning.kernel import value_of  # noqa: PLC0415

    kind = board.kind.copy()
    kind[board.squares[lanes]] = Cell.LANE
    distance = np.empty(len(kind), dtype=np.int32)
    queue = np.empty(len(kind), dtype=np.int64)
    value, stalls, time, unused = value_of(
        kind, board.capacity, board.stride, board.entrances, board.squares, board.weights, distance, queue
    )
    return Score(float(value), int(stalls), float(time), int(unused))


def _climb(
    board: _Board, archive: list[NDArray[np.bool_]], plan: PlanConfig, rng: np.random.Generator
) -> list[NDArray[np.bool_]]:
    """Polish the best of the archive; returns the polished plans and those they came from."""
    from garage2usd.planning.climbing import climb  # noqa: PLC0415

    best: dict[bytes, NDArray[np.bool_]] = {}
    # a pass costs the square of the number of squares
    affordable = _CLIMB_SQUARES // len(board.squares) ** 2
    for lanes in archive[: min(plan.climb_top, affordable)]:
        kind = board.kind.copy()
        kind[board.squares[lanes]] = Cell.LANE
        seed = rng.integers(1, 2**63, dtype=np.uint64)
        climb(
            kind,
            board.capacity,
            board.stride,
            board.squares,
            board.entrances,
            board.portals,
            board.weights,
            seed,
            _CLIMB_PASSES,
        )
        polished = kind[board.squares] == Cell.LANE
        best[polished.tobytes()] = polished
    for lanes in archive:
        best.setdefault(lanes.tobytes(), lanes)
    return list(best.values())
