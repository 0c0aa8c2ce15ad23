"""The parking environment: its contract by Gymnasium's own checker, and many cars as each alone."""

import gymnasium
import numpy as np
import pytest
import shapely
from gymnasium.error import InvalidAction, ResetNeeded
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from PIL import Image

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.driving import DesignCar, Obstacles, Pose
from garage2usd.driving.tracks import Agent, AgentClass, Track, Tracks
from garage2usd.environment import (
    PARKING_ID,
    GarageTasks,
    ParkingEnvironment,
    ParkingTask,
    ParkingVectorEnvironment,
    reference_actions,
)
from garage2usd.maps.track_tables import write_track_parquet

OTHERS = ("lidar", "occupancy")
SMALL = GarageConfig(site={"structure": "......\nE....X\n......\n"}, parking={"occupancy": 0.5})


@pytest.fixture(scope="module")
def tasks():
    return GarageTasks([SMALL])


def empty_task(**changes):
    wall = Obstacles.of([("wall", shapely.box(-10, -14, 10, -13))])
    return ParkingTask(
        **{
            "name": "open",
            "car": DesignCar(),
            "start": Pose(0, 0, 0),
            "goal": Pose(0, -6, 0),
            "obstacles": wall,
            **changes,
        }
    )


@pytest.mark.parametrize("action", ["continuous", "discrete"])
@pytest.mark.parametrize("observation", ["kinematics", "lidar", "occupancy"])
def test_gymnasiums_checker_has_nothing_to_say(tasks, observation, action):
    made = gymnasium.make(
        f"garage2usd.environment:{PARKING_ID}",
        source=tasks,
        observation=observation,
        action=action,
        render_mode="rgb_array" if action == "discrete" else None,
    )
    check_env(made.unwrapped)  # a warning is an error


def same(one, other):
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        return all(same(one[key], other[key]) for key in one)
    one, other = np.asarray(one), np.asarray(other)
    if one.dtype == object:
        return all(same(*pair) if pair[0] is not None else pair[1] is None for pair in zip(one, other, strict=True))
    return one.dtype == other.dtype and np.array_equal(one, other)


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("observation", ["kinematics", "lidar", "occupancy"])
def test_many_cars_drive_as_each_alone(tasks, observation, mode):
    options = {"source": tasks, "observation": observation, "steps": 12}
    ours = gymnasium.make_vec(
        PARKING_ID, num_envs=3, vectorization_mode="vector_entry_point", autoreset_mode=mode, **options
    )
    alone = SyncVectorEnv([lambda: ParkingEnvironment(**options)] * 3, autoreset_mode=mode)
    assert ours.observation_space == alone.observation_space
    assert ours.action_space == alone.action_space
    assert ours.metadata["autoreset_mode"] is mode
    for one, other in zip(ours.reset(seed=5), alone.reset(seed=5), strict=True):
        assert same(one, other)
    ours.action_space.seed(0)
    ends = 0
    for _ in range(40):
        actions = ours.action_space.sample()
        found, expected = ours.step(actions), alone.step(actions)
        for one, other in zip(found, expected, strict=True):
            assert same(one, other)
        ends += int((found[2] | found[3]).sum())
    assert ends > 6


def driven(environment, seed, steps=30):
    environment.reset(seed=seed)
    environment.action_space.seed(seed)
    states = []
    for _ in range(steps):
        observed, earned, *ends, _ = environment.step(environment.action_space.sample())
        states.append((observed.tobytes(), earned, *ends))
        if any(ends):
            break
    return states


def test_the_same_seed_gives_the_same_trajectory(tasks):
    first, again = (ParkingEnvironment(source, observation="lidar") for source in (tasks, SMALL))
    runs = [driven(first, seed) for seed in range(8)]
    assert len(set(map(str, runs))) == 8
    for seed in reversed(range(8)):  # whatever was drawn before
        assert driven(again, seed) == runs[seed]


def test_rewards_are_those_of_the_documentation():
    environment = ParkingEnvironment([empty_task(goal=Pose(1.0, -6.0, 0.3))], steps=50)
    observed, _ = environment.reset(seed=0)
    x, y, *_, cos_h, sin_h = observed["desired_goal"] * [20, 20, 3, 3, 1, 1]
    assert [x, y, cos_h, sin_h] == pytest.approx([6.0, -1.0, np.cos(0.3), np.sin(0.3)], abs=1e-6)
    observed, earned, terminated, truncated, info = environment.step(np.array([1.0, 0.0]))
    # 2 m/s2 for 0.2 s
    assert observed["achieved_goal"] * [20, 20, 3, 3, 1, 1] == pytest.approx([0.04, 0, 0.4, 0, 1, 0], abs=1e-6)
    cost = np.sqrt(np.hypot(5.96, 1.0) / 30 + 0.1 * np.sin(0.15))
    assert (earned, terminated, truncated) == (pytest.approx(-cost / 100, abs=1e-6), False, False)
    assert earned == environment.compute_reward(observed["achieved_goal"], observed["desired_goal"], info)
    goals = np.array([observed["desired_goal"], observed["achieved_goal"] * [1, 1, 0, 0, 1, 1]], np.float32)
    achieved = np.stack([observed["achieved_goal"], goals[1]])
    infos = np.array([info, {"is_crashed": True}])
    assert environment.compute_reward(achieved, goals, [info, info]) == pytest.approx([-cost / 100, 1.0], abs=1e-6)
    assert environment.compute_reward(achieved, goals, infos) == pytest.approx([-cost / 100, -0.5], abs=1e-6)
    sparse = ParkingEnvironment([empty_task()], reward="sparse", steps=50)
    assert sparse.compute_reward(achieved, goals, infos) == pytest.approx([-0.01, -0.51])
    # libraries take an environment that computes rewards for one whose observations have goals
    assert not any(hasattr(ParkingEnvironment([empty_task()], observation=each), "compute_reward") for each in OTHERS)


def ended(task, actions, **settings):
    environment = ParkingEnvironment([task], **settings)
    environment.reset(seed=0)
    number = 0
    for action in actions:
        number += 1
        _, earned, terminated, truncated, info = environment.step(np.array(action))
        if terminated or truncated:
            break
    with pytest.raises(ResetNeeded, match="call reset first"):
        environment.step(np.zeros(2))
    return number, earned, terminated, truncated, [name for name, is_so in info.items() if is_so]


def test_episodes_end_as_documented():
    on = [[1.0, 0.0]] * 200
    # the nose, 3.6 m ahead of the axle, meets the wall at 13 m; within the tick of 0.12 m at 3 m/s
    number, earned, *ends = ended(empty_task(), on)
    assert ends == [True, False, ["is_crashed"]]
    assert earned == pytest.approx(-4.0, abs=0.01)
    assert number == 20  # 2.25 m in 1.5 s, then 7.15 m at 3 m/s: 3.88 s
    assert ended(empty_task(), [[-1.0, 0.0]] * 200)[2:] == (True, False, ["is_outside"])
    assert ended(empty_task(), [[0.0, 0.0]] * 200, steps=7) == (7, pytest.approx(-np.sqrt(0.2) / 100), False, True, [])
    task = empty_task()
    number, earned, *ends = ended(task, reference_actions(task))
    assert ends == [True, False, ["is_success"]]
    assert 0.98 < earned <= 1.0
    fast = ended(task, on)
    assert fast[4] == ["is_crashed"]  # it passed the goal too fast
    turned = empty_task(goal=Pose(0, -6, 0.2))
    assert ended(turned, reference_actions(task), steps=25)[2:] == (False, True, [])


def test_discrete_actions_are_those_of_the_documentation(tasks):
    for number, expected in ((0, (-1, -1)), (7, (0, 0)), (13, (1, 0.5))):
        states = []
        for action, order in (("discrete", number), ("continuous", np.array(expected))):
            environment = ParkingEnvironment(tasks, action=action)
            environment.reset(seed=1)
            states.append([environment.step(order)[0]["observation"].tolist() for _ in range(3)])
        assert states[0] == states[1]


def test_misuse_is_named(tasks):
    environment = ParkingEnvironment(tasks)
    with pytest.raises(ResetNeeded, match="call reset first"):
        environment.step(np.zeros(2))
    environment.reset(seed=0)
    for bad in (np.array([np.nan, 0.0]), np.array([np.inf, 0.0]), np.zeros(3), "on", None, 0.5):
        with pytest.raises(InvalidAction, match=r"action: got .* allowed: finite acceleration and steering"):
            environment.step(bad)
    before = environment.step(np.array([0.0, 0.0]))[0]["observation"]
    assert before.tolist() == [0, 0, 0, 0, 1, 0]
    clipped = environment.step(np.array([7.0, -9.0]))[0]["observation"].tolist()
    environment.reset(seed=0)
    assert clipped == environment.step(np.array([1.0, -1.0]))[0]["observation"].tolist()
    discrete = ParkingEnvironment(tasks, action="discrete")
    discrete.reset(seed=0)
    for bad in (15, -1, 2.0, np.zeros(2, int)):
        with pytest.raises(InvalidAction, match="allowed: whole numbers 0 to 14"):
            discrete.step(bad)
    assert environment.render() is None
    with pytest.raises(ConfigError, match=r"options\.task: got 3"):
        environment.reset(options={"task": 3})


@pytest.mark.parametrize(
    ("settings", "field"),
    [
        ({"observation": "camera"}, "observation"),
        ({"action": "wheel"}, "action"),
        ({"reward": "none"}, "reward"),
        ({"tolerance": (0.0, 5.0)}, "tolerance"),
        ({"steps": 0}, "steps"),
        ({"task": "stay"}, "task"),
        ({"nose": "up"}, "nose"),
        ({"distance_m": (5.0, 2.0)}, "distance_m"),
        ({"filled": 2.0}, "filled"),
        ({"source": []}, "source"),
        ({"source": [empty_task()], "nose": "in"}, "nose"),
        ({"source": "missing.usdz"}, "PATH"),
    ],
)
def test_bad_settings_are_named(settings, field):
    with pytest.raises(ConfigError, match=rf"^{field}: got "):
        ParkingEnvironment(**{"source": SMALL, **settings})


def test_bad_settings_of_many_cars_are_named(tasks):
    for field, settings in (
        ("num_envs", {"num_envs": 0}),
        ("autoreset_mode", {"autoreset_mode": AutoresetMode.DISABLED}),
    ):
        with pytest.raises(ConfigError, match=rf"^{field}: got "):
            ParkingVectorEnvironment(tasks, **settings)


def test_starts_lie_on_proven_paths_at_the_distance():
    for task, nose in (("park", "in"), ("park", "out"), ("leave", None)):
        drawn = GarageTasks([SMALL], task=task, nose=nose, distance_m=(3.0, 6.0), filled=1.0)
        random = np.random.default_rng(0)
        for _ in range(6):
            each = drawn.draw(random)
            assert 3.0 - 1e-9 <= each.path.length_m <= 6.0 + 1e-9
            assert each.path.clearance_m(each.car, each.obstacles) >= 0.05 - 1e-9
            ends = [each.path.pose_at(arc) for arc in (0.0, each.path.length_m)]
            for found, asked in zip(ends, (each.start, each.goal), strict=True):
                assert [found.x_m, found.z_m, found.yaw_rad] == pytest.approx([asked.x_m, asked.z_m, asked.yaw_rad])
            parked = each.goal if task == "park" else each.start
            home = next(
                stall for stall in each.stalls if shapely.Polygon(stall).contains(shapely.Point(parked.x_m, parked.z_m))
            )
            axle_to_mouth = np.linalg.norm(home[:2].mean(axis=0) - (parked.x_m, parked.z_m))
            axle_to_rear = np.linalg.norm(home[2:].mean(axis=0) - (parked.x_m, parked.z_m))
            if nose:
                assert (axle_to_mouth < axle_to_rear) == (nose == "in")


def crossing(speed_m_s, prim=""):
    """A van that drives along +X through the middle of the open scene, from 30 m away."""
    time_s = np.arange(0.0, 100.05, 0.1)
    still = np.zeros(len(time_s))
    agent = Agent("van", AgentClass.VAN, 5.0, 2.0, 2.0, prim=prim)
    x = -30 + speed_m_s * time_s
    track = Track(
        agent, time_s, x, still, still - 3.0, still - np.pi / 2, still, still + speed_m_s, still, still,
        still.astype(np.int8), still.astype(np.int8),
    )  # fmt: skip
    return Tracks((track,), 0.1, 100.0)


def test_agents_of_tracks_move_at_their_times():
    from garage2usd.environment.garage_tasks import _among

    task = _among(empty_task(), crossing(3.0), 0.0, 401, 0)
    number, _, *ends = ended(task, [[0.0, 0.0]] * 80)
    # its front reaches the car's side, 0.9 m left of the middle, after (30 - 2.5 - 0.9) / 3 s
    assert (number, ends) == (45, [True, False, ["is_crashed"]])
    assert 44 * 0.2 < 26.6 / 3 <= 45 * 0.2
    assert _among(empty_task(), crossing(3.0), 0.0, 401, 1).sizes_m.size == 0  # on another level
    assert _among(empty_task(), crossing(3.0), 10.0, 401, 0) is None  # it stands on the start


def test_cars_that_tracks_move_do_not_stand_there_too(tasks, tmp_path):
    def standing(task):
        return {task.obstacles.names[owner] for owner in task.obstacles.owner.tolist()}

    before = [standing(tasks.draw(np.random.default_rng(seed))) for seed in range(6)]
    moved = min(name for name in set.intersection(*before) if "Car_" in name)
    write_track_parquet(tmp_path / "tracks.parquet", crossing(0.0, prim=moved))
    among = GarageTasks([SMALL], tracks=tmp_path / "tracks.parquet")
    assert [standing(among.draw(np.random.default_rng(seed))) for seed in range(6)] == [
        names - {moved} for names in before
    ]
    with pytest.raises(ConfigError, match=r"^tracks: got '100 s in 1 garages'; allowed: tracks of at least 120 s"):
        GarageTasks([SMALL], tracks=crossing(0.0), steps=600)


def test_pictures_show_car_goal_and_walls(tasks):
    environment = ParkingEnvironment(tasks, render_mode="rgb_array")
    environment.reset(seed=3)
    before = environment.render()
    environment.step(np.array([1.0, 0.5]))
    after = environment.render()
    assert before.shape == (600, 600, 3)
    assert before.dtype == np.uint8
    assert (before != after).any()
    colours = {colour for _, colour in Image.fromarray(after).getcolors(1 << 20)}
    assert {(28, 126, 214), (73, 80, 87), (233, 236, 239)} <= colours
