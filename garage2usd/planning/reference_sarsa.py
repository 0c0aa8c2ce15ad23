"""Tabular Sarsa in plain Python over the decision process: the reference of the compiled `garage2usd.planning.sarsa`.

It has no hashes, padded arrays or tables: states are values, plans are sets of squares, and scores are those of
finished structures. Only the order of its random numbers is that of the compiled loop, so that the tests can compare
both number for number. It is some thousand times slower.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from garage2usd.config import PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.planning.decision import (
    Action,
    DecisionProcess,
    Ending,
    Observation,
    Square,
    State,
    actions,
    initial,
    observe,
    reward,
    stalls,
    structure_of,
    terminal,
    transition,
)
from garage2usd.planning.score import evaluate, is_feasible
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import dead_ends

_WORD = (1 << 64) - 1


class SplitMix64:
    """The generator of Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).

    Attributes
    ----------
    state
        64 bits.
    """

    def __init__(self, seed: int) -> None:
        """Begin with a seed of 64 bits."""
        self.state = seed

    def word(self) -> int:
        """Draw a whole number of 64 bits."""
        self.state = (self.state + 0x9E3779B97F4A7C15) & _WORD
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & _WORD
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & _WORD
        return z ^ (z >> 31)

    def uniform(self) -> float:
        """Draw a number from 0 to below 1."""
        return (self.word() >> 11) / (1 << 53)


@dataclass(frozen=True)
class ArchivedEpisode:
    """A plan of the archive with the episode that led to it.

    Attributes
    ----------
    value
        Score y' less the cost of faults.
    lanes
        (row, col) of its lanes.
    tape
        Actions from `start`.
    start
        The entrance.
    """

    value: float
    lanes: frozenset[Square]
    tape: tuple[Action, ...]
    start: Square


def _no_values() -> defaultdict[Observation, list[float]]:
    return defaultdict(lambda: [0.0] * len(Action))


@dataclass
class ReferenceSarsa:
    """Learning on one site; call `episode` as often as there are episodes.

    Attributes
    ----------
    process, plan, random, archive_size
        The decision process, the weights of the score and the rules, the random numbers, and the size of the archive.
    q
        Values of the five actions by observation; rounded to single precision, as in the compiled table.
    archive
        The best distinct plans met, in no order.
    curve
        E, the sum of the rewards without R_T, of each episode.
    steps
        Actions taken.
    epsilon
        Share of random actions in the next episode.
    unchanged
        Episodes in a row that ended in the same plan.
    """

    process: DecisionProcess
    plan: PlanConfig
    random: SplitMix64
    archive_size: int
    q: defaultdict[Observation, list[float]] = field(default_factory=_no_values)
    archive: list[ArchivedEpisode] = field(default_factory=list)
    curve: list[float] = field(default_factory=list)
    steps: int = 0
    epsilon: float = field(init=False)
    unchanged: int = 0
    _last_lanes: frozenset[Square] = frozenset()
    _values: dict[frozenset[Square], float | None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Begin with the first epsilon."""
        self.epsilon = self.process.parameters.epsilon_start

    def episode(self) -> None:
        """Run one episode.

        Notes
        -----
        On-policy control by temporal differences (Sutton and Barto, Reinforcement Learning, 2nd ed., section 6.4):
        ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))``.
        """
        process, p, q = self.process, self.process.parameters, self.q
        state, tape = self._begin()
        best = None
        earned = float(stalls(process, state))
        previous, prize = None, 0.0  # the pair (S_t, A_t) that waits for q(S_{t+1}, A_{t+1}), and R_{t+1}
        while len(tape) < process.horizon and not terminal(process, state):
            seen = observe(process, state)
            action = self._choose(q[seen], actions(process, state))
            if previous:
                self._learn(*previous, prize + p.gamma * q[seen][action])
            following = transition(process, state, action)
            prize = reward(process, state, action, following)
            previous = seen, action
            self.steps += 1
            if following.ending is Ending.FAILED:
                break
            tape.append(action)
            earned += prize
            if p.archives_prefixes and following.lanes != state.lanes:
                best = self._better(best, following, tape)
            state = following
        if previous:
            self._learn(*previous, prize)
        if not p.archives_prefixes:
            best = self._better(None, state, tape)
        if best:
            self._keep(best)
        self.curve.append(earned)
        self._move_epsilon(state.lanes)

    def _begin(self) -> tuple[State, list[Action]]:
        """Begin at an entrance, or replay part of an archived episode."""
        entrances = self.process.entrances
        state, tape = initial(entrances[self.random.word() % len(entrances)]), []
        if self.archive and self.random.uniform() < self.process.parameters.revisit_rate:
            entry, rival = (self.archive[self.random.word() % len(self.archive)] for _ in range(2))
            entry = max(entry, rival, key=lambda entry: entry.value)
            tape = list(entry.tape[: int(self.random.uniform() * len(entry.tape))])
            state = initial(entry.start)
            for action in tape:
                state = transition(self.process, state, action)
        return state, tape

    def _choose(self, values: Sequence[float], allowed: Sequence[Action]) -> Action:
        """Choose an action epsilon-greedily; ties go to the first from an action drawn at random on."""
        if self.random.uniform() < self.epsilon:
            return allowed[int(self.random.uniform() * len(allowed))]
        first = self.random.word() % len(Action)
        turned = [Action((first + offset) % len(Action)) for offset in range(len(Action))]
        return max((action for action in turned if action in allowed), key=lambda action: values[action])

    def _learn(self, seen: Observation, action: Action, target: float) -> None:
        """Move the value of an action towards a target."""
        old = self.q[seen][action]
        self.q[seen][action] = float(np.float32(old + self.process.parameters.alpha * (target - old)))

    def _better(self, best: ArchivedEpisode | None, state: State, tape: Sequence[Action]) -> ArchivedEpisode | None:
        """Return the better of two plans: a given one and that of a state."""
        if state.lanes not in self._values:
            self._values[state.lanes] = self._value(state)
        value = self._values[state.lanes]
        if value is None or (best and value <= best.value):
            return best
        return ArchivedEpisode(value, state.lanes, tuple(tape), state.start)

    def _value(self, state: State) -> float | None:
        """Score less the cost of faults; None for lanes without stalls, or that leave a portal untouched."""
        structure = structure_of(self.process, state)
        if not is_feasible(structure):
            return None
        score = evaluate(structure, bay=self.process.bay, plan=self.plan)
        return score.value - _faults_cost(self.process, self.plan, structure) if score.stalls else None

    def _keep(self, entry: ArchivedEpisode) -> None:
        """Archive a plan if it is new and better than the worst of a full archive."""
        worst = min(range(len(self.archive)), key=lambda place: self.archive[place].value, default=0)
        full = len(self.archive) == self.archive_size
        if full and entry.value <= self.archive[worst].value:
            return
        if entry.lanes in {other.lanes for other in self.archive}:
            return
        if full:
            self.archive[worst] = entry
        else:
            self.archive.append(entry)

    def _move_epsilon(self, lanes: frozenset[Square]) -> None:
        """Lower epsilon, or raise it where the plan has not changed for long."""
        p = self.process.parameters
        self.unchanged = self.unchanged + 1 if lanes == self._last_lanes else 0
        self._last_lanes = lanes
        self.epsilon = max(self.epsilon * p.epsilon_decay, p.epsilon_min)
        if self.unchanged >= p.patience_episodes:
            self.epsilon, self.unchanged = p.epsilon_refresh, 0


def _faults_cost(process: DecisionProcess, plan: PlanConfig, structure: Structure) -> float:
    """Cost of faults of circulation, from the matrices of a finished structure."""
    rules = rules_of(plan, squares=sum(cell is Cell.FREE for cell in process.cells.values()))
    cost = 0.0
    if plan.dead_ends is DeadEnds.STANDARD and plan.circulation_mode is CirculationMode.ALLOW:
        cost += plan.stall_weight * sum(end.needs_turning_stall for end in dead_ends(structure))
    if rules.is_asked:
        found = circulation(structure)
        deep = int(found.deeper_than(rules.dead_end_squares).sum())
        lengths, squares = np.unique(found.stretches[found.stretches > 0], return_counts=True)
        excess = sum(
            count // length * max(0, length - rules.stretch_squares)
            for length, count in zip(lengths.tolist(), squares.tolist(), strict=True)
            if rules.stretch_squares
        )
        cost += rules.deep_cost * deep + rules.block_cost * len(found.blocks) + rules.stretch_cost * excess
        if rules.asks_loop and found.loops < 1:
            cost += rules.loopless_cost
    return cost
