"""Learning on a site: Sarsa over squares as in the paper, or over aisles where squares are too many."""

import sys
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.progress import Progress, silent
from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import Agent, CirculationMode, DeadEnds, SarsaParameters
from garage2usd.native import elementary
from garage2usd.planning import aisles
from garage2usd.planning.board import Board, Ground, Lanes, ground_of, new_archive, new_board, next_random, ranked_lanes
from garage2usd.planning.sarsa import grown, learn, new_memory, new_room
from garage2usd.structure.grid import Cell, Structure

_AISLE_SQUARES = 120
"""Free squares above which the agent decides over aisles: tabular Sarsa over squares does not serve large sites."""
_BATCH_SQUARES = 20_000
"""Episodes times free squares between two calls of `progress`, so that a large site is interrupted as soon."""
_TABLE_BITS = 14
"""Initial size of the table of values; it grows with the number of states."""
_AISLE_EPISODE_SQUARES = 5_000_000
"""Episodes times free squares over aisles: about a second."""
_ELITE = 25
"""Archived episodes that one start over squares goes on from: with 200 the agent alone came to 96.5 % of
the proven optima of ten held-out gates under the rules, with 50 to 97.8 %, with 25 to 98.5 %, in the same time, at
alpha 0.5 and gamma 0.7; with 25, alpha 0.1 and gamma 0.9 it comes to 99.5 %."""
_NURSERY_SIDE, _NURSERY_OBSTACLES, _NURSERY_EPISODES = 26, 6, 3000
"""A small site for cheap episodes; its values hold on any site, as states of aisles are local."""


@dataclass(frozen=True, eq=False)
class Learnt:
    """Result of learning: layouts with their values, best first, and the learning curve.

    Attributes
    ----------
    ranked
        (value, lanes).
    curve
        float64, shape (episodes,): sum of the rewards of each episode.
    steps
        Actions taken.
    """

    ranked: tuple[tuple[float, Lanes], ...]
    curve: NDArray[np.float64]
    steps: int


def uses_aisles(ground: Ground, plan: PlanConfig) -> bool:
    """Test whether the agent decides over aisles on this site."""
    if plan.agent is Agent.AUTO:
        return plan.preset == "tuned" and len(ground.squares) > _AISLE_SQUARES
    return plan.agent is Agent.AISLES


def learn_squares(
    ground: Ground, board: Board, plan: PlanConfig, random: NDArray[np.uint64], progress: Progress = silent
) -> Learnt:
    """Learn over squares from as many starts as the settings say; the curve belongs to the start with the best plan."""
    count = plan.resolved().starts

    def told(start: int) -> Progress:
        return lambda step, done, total: progress(step, start * total + done, count * total)

    starts = [_learn_once(ground, board, plan, random, told(start)) for start in range(count)]
    best = {lanes.tobytes(): (value, lanes) for start in starts for value, lanes in start.ranked}
    ranked = sorted(best.values(), key=lambda entry: (-entry[0], entry[1].tobytes()))[: plan.archive_size]
    leader = max(starts, key=lambda start: start.ranked[0][0] if start.ranked else -np.inf)
    return Learnt(tuple(ranked), leader.curve, sum(start.steps for start in starts))


def _learn_once(
    ground: Ground, board: Board, plan: PlanConfig, random: NDArray[np.uint64], progress: Progress
) -> Learnt:
    """Run all episodes in batches, between which progress is reported and signals are handled."""
    parameters = plan.resolved()
    steps = parameters.max_steps_per_square * len(ground.squares)
    kept = min(plan.archive_size, _ELITE) if parameters.revisit_rate else plan.archive_size
    archive = new_archive(kept, padded=len(ground.cells), steps=steps)
    room = new_room(ground, archive)
    memory = new_memory(parameters, bits=max(_TABLE_BITS, (4 * steps).bit_length()))
    curve = np.zeros(plan.episodes)
    batch = max(1, _BATCH_SQUARES // len(ground.squares))
    taken, episode = np.zeros(1, np.int64), 0
    while episode < plan.episodes:
        progress("plan", episode, plan.episodes)
        goal = min(episode + batch, plan.episodes)
        while episode < goal:
            episode = learn(ground, board, parameters, memory, archive, room, random, curve, episode, goal, taken)
            if episode < goal:
                memory = grown(memory)
    return Learnt(ranked_lanes(archive, ground), curve, int(taken[0]))


def learn_aisles(
    ground: Ground, board: Board, plan: PlanConfig, random: NDArray[np.uint64], progress: Progress = silent
) -> Learnt:
    """Learn over aisles on a small site first, and carry the values over to this one.

    Notes
    -----
    The states of aisles are the same on every site, so values learnt on a site of 26 x 26 squares with a few obstacles
    apply to this one. Episodes on this site then decide parts of the best plans anew. Their number is that of the
    settings, or less on sites so large that they would take more than a second.
    """
    parameters = plan.resolved(aisles=True)
    runs = aisles.runs_of(ground)
    if not len(runs.first):
        return Learnt((), np.zeros(plan.episodes), 0)
    archive = new_archive(plan.archive_size, padded=len(ground.cells), steps=len(runs.first))
    greedy = parameters._replace(revisit_rate=0.0)
    whole = 2 * runs.spines.shape[1]
    taken, values, best = 0, aisles.new_values(), -np.inf
    room = aisles.new_room(ground, runs)
    for start in range(parameters.starts):
        progress("plan", start, parameters.starts)
        learnt, steps = _school(ground, greedy, random)
        tried = new_archive(1, padded=len(ground.cells), steps=len(runs.first))
        schedule, curve = np.array([0.0, 1.0, 0.0, 1.0]), np.zeros(whole)
        taken += steps + aisles.learn_aisles(
            ground, board, runs, greedy, learnt, tried, room, random, curve, schedule, 0, whole, sys.maxsize
        )
        if tried.in_use[0] and tried.values[0] > best:
            values, best = learnt, tried.values[0]
    episodes = max(1, min(plan.episodes, _AISLE_EPISODE_SQUARES // len(ground.squares)))
    curve = np.zeros(episodes)
    schedule = _schedule(
        episodes, epsilon=(parameters.epsilon_start, parameters.epsilon_min), alpha=(parameters.alpha, parameters.alpha)
    )
    batch = max(1, _BATCH_SQUARES * 10 // len(ground.squares))
    for first in range(0, episodes, batch):
        progress("plan", first, episodes)
        taken += aisles.learn_aisles(
            ground, board, runs, parameters, values, archive, room, random, curve, schedule,
            first, min(first + batch, episodes), sys.maxsize,
        )  # fmt: skip
    return Learnt(ranked_lanes(archive, ground), curve, taken)


def _school(ground: Ground, parameters: SarsaParameters, random: NDArray[np.uint64]) -> tuple[NDArray[np.float64], int]:
    """Learn over aisles on a small site like this one; return the values and the number of decisions."""
    nursery = _nursery(ground, np.random.Generator(np.random.PCG64(int(next_random(random)))))
    values, runs = aisles.new_values(), aisles.runs_of(nursery)
    archive = new_archive(1, padded=len(nursery.cells), steps=len(runs.first))
    schedule = _schedule(_NURSERY_EPISODES, epsilon=(0.5, 0.02), alpha=(0.3, 0.02))
    taken = aisles.learn_aisles(
        nursery, new_board(nursery), runs, parameters, values, archive, aisles.new_room(nursery, runs), random,
        np.zeros(_NURSERY_EPISODES), schedule, 0, _NURSERY_EPISODES, 1,
    )  # fmt: skip
    return values, taken


def _schedule(episodes: int, *, epsilon: tuple[float, float], alpha: tuple[float, float]) -> NDArray[np.float64]:
    """Schedule of epsilon and alpha: first value and factor per episode of each; 0 stays 0."""
    factors = [elementary.power(last / first, 1 / episodes) if first > 0 else 1.0 for first, last in (epsilon, alpha)]
    return np.array([epsilon[0], factors[0], alpha[0], factors[1]])


def _nursery(ground: Ground, rng: np.random.Generator) -> Ground:
    """Make a small site whose squares have the typical capacity of this site."""
    cells = np.zeros((_NURSERY_SIDE, _NURSERY_SIDE), dtype=np.int8)
    inner = rng.integers(3, _NURSERY_SIDE - 3, size=(_NURSERY_OBSTACLES, 2))
    cells[inner[:, 0], inner[:, 1]] = Cell.OBSTACLE
    cells[-1, _NURSERY_SIDE // 3], cells[0, 2 * _NURSERY_SIDE // 3] = Cell.ENTRANCE, Cell.EXIT
    sides = np.median(ground.sides_mm[ground.squares], axis=0) / 1000
    small = ground_of(
        Structure.from_arrays(cells, sides[1], sides[0]),
        bay=BayConfig(),
        plan=PlanConfig(circulation=CirculationMode.ALLOW, dead_ends=DeadEnds.ALLOW),
    )
    # the typical capacity of this site's squares, whatever the sizes of its bays
    return small._replace(
        capacity=np.tile(np.median(ground.capacity[ground.squares], axis=0).astype(np.int32), (len(small.cells), 1)),
        weights=ground.weights,
    )
