"""The Gymnasium environment: its contract by Gymnasium's own checker, its steps by the decision process."""

import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from gymnasium.error import InvalidAction, ResetNeeded
from gymnasium.utils.env_checker import check_env
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import installation_of
from garage2usd.config import GarageConfig
from garage2usd.environment import ENVIRONMENT_ID, LanesEnvironment
from garage2usd.planning import evaluate, is_feasible
from garage2usd.planning.decision import Action, initial, observe, reward, terminal, transition
from garage2usd.structure.grid import Cell, cells_from_text

DRAWING = ".....#\n......\nE....X\n......\n"


def config(preset="tuned", drawing=DRAWING, **plan):
    return GarageConfig(site={"structure": drawing}, plan={"preset": preset, **plan})


def begun(*, seed=0, **settings):
    environment = LanesEnvironment(config(**settings), render_mode="ansi")
    return environment, *environment.reset(seed=seed)


@pytest.mark.parametrize("render_mode", [None, "ansi"])
@pytest.mark.parametrize("preset", ["paper", "tuned"])
def test_gymnasiums_checker_has_nothing_to_say(preset, render_mode):
    made = gymnasium.make(ENVIRONMENT_ID, config=config(preset), render_mode=render_mode)
    check_env(made.unwrapped)  # a warning is an error


def test_the_default_is_the_default_garage():
    made = gymnasium.make(f"garage2usd.environment:{ENVIRONMENT_ID}")
    assert made.unwrapped.process.site == garage2usd.generate(GarageConfig(plan={"episodes": 1, "climb": False})).site


@pytest.mark.parametrize("preset", ["paper", "tuned"])
def test_every_step_is_the_decision_process(preset):
    environment, observation, info = begun(preset=preset)
    environment.action_space.seed(0)
    process, ends = environment.process, set()
    for _ in range(40):
        state, over, steps = initial(process.entrances[0]), False, 0
        while not over:
            assert environment.observation_space.contains(observation)
            seen = observe(process, state)
            assert tuple(observation["window"].ravel().tolist()) == seen.window
            assert tuple(observation.get("distances", ())) == seen.distances
            assert observation["last_action"] == seen.last_action
            structure = environment.structure
            assert set(structure.where(Cell.LANE)) == state.lanes
            assert info["structure"] == str(structure)
            assert (cells_from_text(info["structure"], field="test") == structure.cells).all()
            assert info["score"] == evaluate(structure, bay=process.bay).value
            assert info["is_feasible"] == is_feasible(structure)
            if preset == "paper":
                assert info["action_mask"].all()
            else:
                after = [transition(process, state, action) for action in Action]
                allowed = [one.ending is None and one.square != state.start for one in after]
                allowed[Action.STAY] = False
                assert info["action_mask"].tolist() == allowed
            action = environment.action_space.sample(info["action_mask"])
            following = transition(process, state, Action(action))
            observation, earned, terminated, truncated, info = environment.step(action)
            assert earned == reward(process, state, Action(action), following)
            assert terminated == terminal(process, following)
            state, steps, over = following, steps + 1, terminated or truncated
            assert truncated == (steps == process.horizon and not terminated)
        ends.add((state.ending and state.ending.value, truncated))
        with pytest.raises(ResetNeeded):
            environment.step(action)
        observation, info = environment.reset()
    assert ends == ({("failed", False), ("returned", False)} if preset == "paper" else {(None, True)})


def test_entrances_are_drawn_by_seed():
    drawing = "E....E\n......\nE....X\n"
    starts = [begun(drawing=drawing, seed=seed)[0].render().index("@") for seed in range(20)]
    assert starts == [begun(drawing=drawing, seed=seed)[0].render().index("@") for seed in range(20)]
    assert set(starts) == {0, 5, 14}


def test_a_finished_episode_becomes_a_stage(tmp_path):
    environment, *_ = begun()
    for action in (3, 3, 3, 3):
        *_, info = environment.step(np.int64(action))
    assert info["is_feasible"]
    assert environment.render() == ".....#\n......\nE===@X\n......"
    build = garage2usd.build(GarageConfig(site={"structure": info["structure"]}), tmp_path / "garage.usdz")
    assert str(build.garage.plan.structure) == info["structure"] == str(environment.structure)
    assert build.stage.stat().st_size > 100_000


def test_misuse_is_named():
    environment = LanesEnvironment(config())
    with pytest.raises(ResetNeeded, match="call reset first"):
        environment.step(0)
    environment.reset()
    with pytest.raises(InvalidAction, match="got 5; allowed: whole numbers 0 to 4"):
        environment.step(5)
    assert environment.render() is None
    with pytest.raises(ConfigError, match="portals beside free squares"):
        LanesEnvironment(config(drawing="EX\n"))


def test_without_gymnasium_the_extra_is_named():
    script = "import sys; sys.modules['gymnasium'] = None; import garage2usd.environment"
    run = subprocess.run(
        [sys.executable, "-c", script], cwd=REPOSITORY, capture_output=True, text=True, check=False, timeout=60
    )
    assert run.returncode == 1
    assert f"garage2usd.environment needs Gymnasium: {installation_of('gymnasium')}" in run.stderr
