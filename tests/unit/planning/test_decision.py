"""The decision process on small drawings, with rewards worked out by hand."""

import pytest
from support.planning_reference import BAY, drawn

from garage2usd.config import PlanConfig
from garage2usd.planning.decision import (
    Action,
    DecisionProcess,
    Ending,
    Observation,
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
from garage2usd.structure.grid import Cell

U, D, L, R, S = Action

OPEN = """
.....
.....
E...X
.....
"""


def process(text=OPEN, preset="paper", **changes):
    return DecisionProcess(drawn(text), BAY, PlanConfig(preset=preset, **changes).resolved())


def driven(mdp, tape, start=None):
    """The states of an episode from an entrance, and the rewards of its actions."""
    states, rewards = [initial(start or mdp.entrances[0])], []
    for action in tape:
        states.append(transition(mdp, states[-1], action))
        rewards.append(reward(mdp, states[-2], action, states[-1]))
    return states, rewards


def test_an_episode_colours_squares():
    mdp = process()
    states, _ = driven(mdp, (R, R, U))
    assert states[0] == State(start=(2, 0), square=(2, 0))
    assert states[-1].lanes == {(2, 1), (2, 2), (1, 2)}
    assert str(structure_of(mdp, states[-1])) == ".....\n..=..\nE==.X\n....."
    assert [state.run_squares for state in states] == [0, 1, 2, 1]
    assert not any(terminal(mdp, state) for state in states)
    assert mdp.horizon == 2 * 18


def test_lanes_of_the_site_are_free_at_first():
    mdp = process("...\nE=X\n...")
    assert observe(mdp, initial((1, 0))).distances == (1, 1, 0, 1)
    assert mdp.horizon == 2 * 7
    assert stalls(mdp, initial((1, 0))) == 0


def test_stalls_gained_less_the_step():
    mdp = process()
    states, rewards = driven(mdp, (R, R))
    # above and below (2, 1), and (2, 2) ahead of it: three squares of three stalls; then two more, less (2, 2)
    assert [stalls(mdp, state) for state in states] == [0, 9, 15]
    assert rewards == [9 - 0.4, 6 - 0.4]


def test_turning_back_and_turning_early():
    penalties = {"turn_back_penalty": 7.0, "interval_penalty": 3.0, "step_penalty": 0.0, "wheeling_penalty": 0.0}
    mdp = process(**penalties, min_run_squares=3)
    assert driven(mdp, (R, R, L))[1][-1] == -7  # onto a lane: nothing gained
    states, rewards = driven(mdp, (R, R, U))
    assert rewards[-1] == stalls(mdp, states[-1]) - stalls(mdp, states[-2]) - 3
    states, rewards = driven(mdp, (R, R, R, U))
    assert rewards[-1] == stalls(mdp, states[-1]) - stalls(mdp, states[-2])
    states, rewards = driven(mdp, (R, R, S, U))
    assert rewards[-2:] == [0, stalls(mdp, states[-1]) - stalls(mdp, states[-2])]  # staying ends a run


def test_wheeling_beside_lanes_and_closing_a_loop():
    square = (R, R, U, L)
    for settings, extra in (
        ({}, 0),
        ({"wheeling_penalty": 5.0}, -5),
        ({"loop_reward": 2.0}, 2),
    ):
        plain = {"wheeling_penalty": 0.0, "interval_penalty": 0.0, "step_penalty": 0.0}
        mdp = process(**(plain | settings))
        states, rewards = driven(mdp, square)
        assert rewards[-1] == stalls(mdp, states[-1]) - stalls(mdp, states[-2]) + extra
        assert rewards[:3] == driven(process(**plain), square[:3])[1]
        assert driven(mdp, (*square, D))[1][-1] == 0  # onto a lane: neither


def test_the_goal_is_to_stay_at_the_start():
    mdp = process()
    states, rewards = driven(mdp, (R, S, L, S))
    assert [state.ending for state in states] == [None, None, None, None, Ending.RETURNED]
    assert rewards[1::2] == [-0.8, -0.8]
    assert terminal(mdp, states[-1])


@pytest.mark.parametrize(
    "tape", [(U, U, U), (L,), (R, R, R, R), (R, L, R), (R, L, U)], ids=lambda tape: "".join(a.name[0] for a in tape)
)
def test_failures_cost_their_penalty_and_nothing_else(tape):
    """Against the border, outside, a portal that is not the start, and on from the start."""
    mdp = process()
    states, rewards = driven(mdp, tape)
    assert states[-1].ending is Ending.FAILED
    assert rewards[-1] == -20
    assert states[-1].lanes == states[-2].lanes
    assert terminal(mdp, states[-1])
    assert not any(terminal(mdp, state) for state in states[:-1])


def test_what_is_seen():
    mdp = process("#....\nE...X\n.....")
    state = driven(mdp, (R, R, D))[0][-1]
    assert observe(mdp, state) == Observation(
        distances=(2, 0, 2, 2),
        window=(-1, 0, 0, 0, 0, 2, 1, 1, 0, 3, 0, 0, 1, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1),
        last_action=D,
    )
    seen = observe(process("#....\nE...X\n.....", "tuned"), state)
    assert seen == Observation(distances=(), window=(1, 1, 0, 0, 1, 0, -1, -1, -1), last_action=D)


def test_the_window_is_the_cells_around():
    mdp = process(window_radius_squares=4)
    window = observe(mdp, initial((2, 0))).window
    assert len(window) == 81
    assert window[40] == Cell.ENTRANCE
    assert window.count(Cell.OBSTACLE) == 81 - 4 * 5


def test_presets_differ_in_what_may_be_chosen():
    first = initial((2, 0))
    assert actions(process(), first) == tuple(Action)
    masked = process(preset="tuned")
    assert actions(masked, first) == (U, D, R)
    assert actions(masked, driven(masked, (R,))[0][-1]) == (U, D, R)  # the start is not entered again
    assert actions(masked, driven(masked, (R, R, R))[0][-1]) == (U, D, L)  # nor the exit


def test_an_agent_that_is_walled_in_has_ended():
    mdp = process("###\nE.#\n##X", preset="tuned")
    states, _ = driven(mdp, (R,))
    assert [terminal(mdp, state) for state in states] == [False, True]
    assert not actions(mdp, states[-1])
    assert not any(terminal(process("###\nE.#\n##X"), state) for state in states)
