"""Whether a compiled `learn` follows the decision process: the same numbers as the reference, on any site."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning import sarsa
from garage2usd.planning.board import PADDING, ground_of, new_archive, new_board
from garage2usd.planning.decision import Action, DecisionProcess, State, observe
from garage2usd.planning.reference_sarsa import ReferenceSarsa, SplitMix64
from garage2usd.structure.grid import Cell, Structure

BAY = BayConfig(dimensioned=False)


@dataclass(frozen=True)
class Case:
    """A site, the settings of learning on it, and how many episodes there are, of which so many in one call."""

    site: Structure
    plan: PlanConfig
    seed: int
    episodes: int
    batch: int
    table_bits: int

    def __repr__(self):
        widths, depths = self.site.column_widths_mm.tolist(), self.site.row_depths_mm.tolist()
        rest = self.plan.model_dump(exclude_unset=True), self.seed, self.episodes, self.batch, self.table_bits
        return f"Case({str(self.site)!r}, {widths}, {depths}, {rest})"


@st.composite
def sites(draw):
    """Small sites with obstacles, one or two entrances, up to two exits, and squares of several sizes."""
    rows, cols = draw(st.integers(2, 5)), draw(st.integers(2, 8))
    squares = draw(st.permutations(range(rows * cols)))
    kinds = [Cell.FREE, Cell.ENTRANCE, *draw(st.sampled_from(([], [Cell.EXIT], [Cell.ENTRANCE, Cell.EXIT])))]
    kinds += [Cell.OBSTACLE] * draw(st.integers(0, 4))
    cells = np.zeros(rows * cols, np.int8)
    for square, kind in zip(squares, kinds, strict=False):
        cells[square] = kind
    sides = st.sampled_from((8.1, 8.1, 5.5, 11.0))
    widths = draw(st.lists(sides, min_size=cols, max_size=cols))
    depths = draw(st.lists(sides, min_size=rows, max_size=rows))
    return Structure.from_arrays(cells.reshape(rows, cols), widths, depths)


@st.composite
def plans(draw):
    """Either preset as it is, or with some of its parameters changed."""
    preset = draw(st.sampled_from(("paper", "tuned")))
    fixed = {"preset": preset, "circulation": draw(st.sampled_from((None, "allow", "loops")))}
    fixed |= {"longest_stretch_cells": draw(st.sampled_from((None, 2))), "archive_size": draw(st.integers(1, 4))}
    penalties = st.sampled_from((0.0, 0.1, 0.4, 3.0))
    parameters = {
        "alpha": st.sampled_from((0.1, 0.5, 1.0)),
        "gamma": st.sampled_from((0.0, 0.7, 0.95, 1.0)),
        "epsilon_start": st.sampled_from((0.0, 0.3, 1.0)),
        "epsilon_min": st.sampled_from((0.0, 0.05, 0.3)),
        "epsilon_decay": st.sampled_from((0.5, 0.9, 0.997)),
        "epsilon_refresh": st.sampled_from((0.2, 0.8)),
        "patience_episodes": st.integers(1, 4),
        "turn_back_penalty": penalties,
        "interval_penalty": penalties,
        "wheeling_penalty": penalties,
        "loop_reward": penalties,
        "step_penalty": penalties,
        "failure_penalty": penalties,
        "min_run_squares": st.integers(1, 4),
        "window_radius_squares": st.integers(1, 4),
        "sees_distances": st.booleans(),
        "masks_actions": st.booleans(),
        "archives_prefixes": st.booleans(),
        "revisit_rate": st.sampled_from((0.0, 0.5, 1.0)),
        "max_steps_per_square": st.integers(1, 4),
    }
    # None is the preset's value
    return PlanConfig(**fixed, **{name: draw(st.none() | values) for name, values in parameters.items()})


@st.composite
def cases(draw):
    return Case(
        site=draw(sites()),
        plan=draw(plans()),
        seed=draw(st.integers(1, 2**63)),
        episodes=draw(st.integers(1, 30)),
        batch=draw(st.integers(1, 10)),
        table_bits=draw(st.integers(8, 12)),
    )


class Course(NamedTuple):
    """What the reference does of a case.

    Attributes
    ----------
    curve
        Sum of the rewards of each episode.
    states
        Before the first episode and after each: the actions taken so far, the state of the random numbers, epsilon, and
        for how many episodes the plan has stayed the same.
    archive
        Value, lanes, actions and start of each entry.
    values
        Those of all actions of each state that it met, in order.
    """

    curve: list
    states: list
    archive: list
    values: list


def course_of(case):
    """Learn in plain Python."""
    process = DecisionProcess(case.site, BAY, case.plan.resolved())
    slow = ReferenceSarsa(process, case.plan, SplitMix64(case.seed), case.plan.archive_size)
    states = [_state_of(slow)]
    for _ in range(case.episodes):
        slow.episode()
        states.append(_state_of(slow))
    archive = [(entry.value, entry.lanes, entry.tape, entry.start) for entry in slow.archive]
    return Course(slow.curve, states, archive, sorted(slow.q.values()))


def _state_of(slow):
    return slow.steps, slow.random.state, slow.epsilon, slow.unchanged


def check(case):
    """Learn in both ways, and compare."""
    compare(case, course_of(case))


def following(*, examples, phases=(Phase.explicit, Phase.generate), check=check):
    """The property that `learn` follows the decision process."""

    @settings(max_examples=examples, deadline=None, derandomize=True, database=None, phases=phases)
    @given(cases())
    def learn_follows_the_decision_process(case):
        check(case)

    return learn_follows_the_decision_process


def cases_of(examples):
    """The cases over which the property goes."""
    found = []
    following(examples=examples, check=found.append)()
    return found


def compare(case, course):
    """Learn compiled; compare with the reference what episodes leave behind, and at last what was learnt and kept."""
    ground, parameters = ground_of(case.site, bay=BAY, plan=case.plan), case.plan.resolved()
    board, random = new_board(ground), np.array([case.seed], np.uint64)
    horizon = DecisionProcess(case.site, BAY, parameters).horizon
    archive = new_archive(case.plan.archive_size, padded=len(ground.cells), steps=horizon)
    room = sarsa.new_room(ground, archive)
    memory = sarsa.new_memory(parameters, bits=case.table_bits)
    curve, steps, episode = np.zeros(case.episodes), np.zeros(1, np.int64), 0
    while episode < case.episodes:
        last = min(episode + case.batch, case.episodes)
        done = sarsa.learn(ground, board, parameters, memory, archive, room, random, curve, episode, last, steps)
        assert curve[:done].tolist() == course.curve[:done]
        assert (steps[0], random[0], *memory.course.tolist()) == course.states[done]
        if done < last:
            memory = sarsa.grown(memory)
        episode = done
    assert kept(archive, ground) == course.archive
    used = memory.keys != 0
    assert used.sum() == memory.used[0] == len(course.values)
    assert sorted(memory.q[used].tolist()) == course.values
    assert not memory.q[~used].any()


def check_states():
    """The table tells two states apart where the reference does, over sites that have nothing to do with each other."""
    hashes, keys = {}, {}
    for seed in range(150):
        rng = np.random.default_rng(seed)
        cells = rng.choice([-1, 0, 2, 3], p=[0.1, 0.8, 0.05, 0.05], size=rng.integers(2, 7, size=2)).astype(np.int8)
        changed = {"window_radius_squares": int(rng.integers(1, 5)), "sees_distances": bool(rng.integers(2))}
        site, plan = Structure.from_arrays(cells, 8.1, 8.1), PlanConfig(**changed)
        ground, process = ground_of(site, bay=BAY, plan=plan), DecisionProcess(site, BAY, plan.resolved())
        board = new_board(ground)
        lanes = frozenset(at for at in site.where(Cell.FREE) if rng.random() < 0.5)
        for place in ground.squares:
            board.cells[place] = Cell.LANE if square(place, ground) in lanes else Cell.FREE
        for place in ground.squares[rng.random(len(ground.squares)) < 0.5]:
            for action in Action:
                at = square(place, ground)
                key = observe(process, State(start=at, square=at, last_action=action, lanes=lanes))
                hashed = sarsa.observe(ground, board, process.parameters, place, int(action))
                assert hashes.setdefault(key, hashed) == hashed
                assert keys.setdefault(hashed, key) == key
    assert len(keys) > 500


def kept(archive, ground):
    """Value, lanes, actions and start of each entry of a compiled archive."""
    entries = []
    for entry in range(archive.in_use[0]):
        lanes = frozenset(square(place, ground) for place in np.flatnonzero(archive.lanes[entry]))
        tape = tuple(archive.tapes[entry, : archive.lengths[entry]].tolist())
        entries.append((archive.values[entry], lanes, tape, square(archive.starts[entry], ground)))
    return entries


def square(place, ground):
    """(row, col) of an index into the padded matrix."""
    row, col = divmod(int(place), ground.stride)
    return row - PADDING, col - PADDING
