"""Sarsa in plain Python over the decision process: what the compiled loop has to do, number for number.

It knows nothing of hashes, padded arrays or tables: states are values, plans are sets of squares, and scores come from
finished structures. Only the order in which random numbers are drawn is that of the compiled loop.
"""

from collections import defaultdict
from dataclasses import dataclass, field

import numpy as np

from garage2usd.config import PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.planning.decision import (
    Action,
    DecisionProcess,
    Ending,
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
from garage2usd.structure.dead_ends import dead_ends
from garage2usd.structure.grid import Cell

_WORD = (1 << 64) - 1


class SplitMix64:
    """Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, in whole numbers."""

    def __init__(self, seed):
        self.state = seed

    def word(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & _WORD
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & _WORD
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & _WORD
        return z ^ (z >> 31)

    def uniform(self):
        return (self.word() >> 11) / (1 << 53)


@dataclass(frozen=True)
class Entry:
    """A plan that was met, with the actions that led to it."""

    value: float
    lanes: frozenset
    tape: tuple
    start: tuple


@dataclass
class SlowSarsa:
    """Learning on one site; values are kept in single precision, as the table has them."""

    process: DecisionProcess
    plan: PlanConfig
    random: SplitMix64
    archive_size: int
    q: dict = field(default_factory=lambda: defaultdict(lambda: [0.0] * len(Action)))
    worths: dict = field(default_factory=dict)
    archive: list = field(default_factory=list)
    curve: list = field(default_factory=list)
    steps: int = 0
    unchanged: int = 0
    last_plan: frozenset = frozenset()
    epsilon: float = None

    def __post_init__(self):
        self.epsilon = self.process.parameters.epsilon_start

    def episode(self):
        process, p, q = self.process, self.process.parameters, self.q
        state, tape = self._begin()
        best = None
        earned = float(stalls(process, state))
        previous, prize = None, 0.0  # the pair (S_t, A_t) that waits for q(S_{t+1}, A_{t+1}), and R_{t+1}
        while len(tape) < process.horizon and not terminal(process, state):
            seen = observe(process, state)
            action = self._choose(q[seen], actions(process, state))
            if previous:
                self._learn(previous, prize + p.gamma * q[seen][action])
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
            self._learn(previous, prize)
        if not p.archives_prefixes:
            best = self._better(None, state, tape)
        if best:
            self._keep(best)
        self.curve.append(earned)
        self._move_epsilon(state.lanes)

    def _begin(self):
        entrances = self.process.entrances
        state, tape = initial(entrances[self.random.word() % len(entrances)]), []
        if self.archive and self.random.uniform() < self.process.parameters.revisit_rate:
            entry, rival = (self.archive[self.random.word() % len(self.archive)] for _ in range(2))
            entry = max(entry, rival, key=lambda entry: entry.value)
            tape = list(entry.tape[: int(self.random.uniform() * len(entry.tape))])
            state = initial(entry.start)
            for action in tape:
                state = transition(self.process, state, action)
                assert not state.ending
        return state, tape

    def _choose(self, values, allowed):
        if self.random.uniform() < self.epsilon:
            return allowed[int(self.random.uniform() * len(allowed))]
        first = self.random.word() % len(Action)
        turned = [Action((first + offset) % len(Action)) for offset in range(len(Action))]
        return max((action for action in turned if action in allowed), key=lambda action: values[action])

    def _learn(self, pair, target):
        seen, action = pair
        old = self.q[seen][action]
        self.q[seen][action] = float(np.float32(old + self.process.parameters.alpha * (target - old)))

    def _better(self, best, state, tape):
        if state.lanes not in self.worths:
            self.worths[state.lanes] = self._worth(state)
        value = self.worths[state.lanes]
        if value is None or (best and value <= best.value):
            return best
        return Entry(value, state.lanes, tuple(tape), state.start)

    def _worth(self, state):
        """Score less the cost of faults; None for lanes without stalls, or that leave a portal untouched."""
        structure = structure_of(self.process, state)
        if not is_feasible(structure):
            return None
        score = evaluate(structure, bay=self.process.bay, plan=self.plan)
        return score.value - faults(self.process, self.plan, structure) if score.stalls else None

    def _keep(self, entry):
        worst = min(range(len(self.archive)), key=lambda place: self.archive[place].value, default=None)
        full = len(self.archive) == self.archive_size
        if full and entry.value <= self.archive[worst].value:
            return
        if entry.lanes in {other.lanes for other in self.archive}:
            return
        if full:
            self.archive[worst] = entry
        else:
            self.archive.append(entry)

    def _move_epsilon(self, lanes):
        p = self.process.parameters
        self.unchanged = self.unchanged + 1 if lanes == self.last_plan else 0
        self.last_plan = lanes
        self.epsilon = max(self.epsilon * p.epsilon_decay, p.epsilon_min)
        if self.unchanged >= p.patience_episodes:
            self.epsilon, self.unchanged = p.epsilon_refresh, 0


def faults(process, plan, structure):
    """What the faults of circulation cost, from the matrices of a finished structure."""
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
