"""Parking-v0: steps a core-second beside highway-env's parking-v0, the planner's success, and PPO's learning curve.

The packages of ``parking_requirements.txt`` go into an environment of their own with garage2usd.
``python benchmarks/run.py parking parking_learnt`` writes the sections; ``python benchmarks/parking.py SECONDS`` learns
for some processor seconds and prints the curve.
"""

import contextlib
import importlib.metadata
import statistics
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

from garage2usd import GarageConfig
from garage2usd.environment import (
    PARKING_ID,
    GarageTasks,
    ParkingEnvironment,
    ParkingVectorEnvironment,
    reference_actions,
)

__all__ = ["parking", "parking_learnt"]

CARS = (1, 16, 256)
HIGHWAY_ID = "parking-v0"
SECONDS, ROUNDS, ACTIONS = 1.0, 3, 64
TASKS = 500
GAMMA, SHAPED = 0.98, 2.0
LEARNT_S, LEARNING_CARS, LEARNING_STEPS, JUDGED = 600.0, 64, 150, 200
SEEDS, UNSEEN = range(2), range(100, 102)
"""Seeds of the garages that PPO learns in, and of those in which it is judged."""
LEARNT = {"nose": "in", "distance_m": (1.0, 6.0)}
TOLERANCE = 0.5, 10.0


class Point(NamedTuple):
    """A point of a learning curve."""

    steps: int
    seconds: float
    success: float
    crashed: float


def parking() -> str:
    """Table of speed, and the planner's success."""
    tasks = GarageTasks([GarageConfig()])
    rows = [
        "## Parking-v0",
        "",
        (
            f"Steps a core-second with random actions and resets, median of {ROUNDS} rounds in turns of {SECONDS:g} "
            f"processor seconds, in the default garage with all its paths searched before. highway-env "
            f"{importlib.metadata.version('highway-env')}'s `{HIGHWAY_ID}` sees kinematics, has 4 walls and no "
            "other cars; it steps 0.2 s in 3 ticks, this one in 5."
        ),
        "",
        "| environment | observation | cars at once | steps a core-second |",
        "|---|---|---|---|",
    ]
    for name, observation, cars, rate in _rates(tasks):
        rows.append(f"| {name} | {observation} | {cars} | {rate:,.0f} |")
    parked = sum(_is_parked(ParkingEnvironment(tasks), seed) for seed in range(TASKS))
    rows += [
        "",
        f"The planner's path, driven in the environment's dynamics, solves {parked} of {TASKS} tasks there.",
        "",
    ]
    return "\n".join(rows[:-1])


def parking_learnt() -> str:
    """Table of the learning curve of PPO, beside the planner."""
    unseen = GarageTasks([GarageConfig(seed=seed) for seed in UNSEEN], **LEARNT)
    planner = sum(_is_parked(ParkingEnvironment(unseen, tolerance=TOLERANCE), seed) for seed in range(JUDGED)) / JUDGED
    curve = learn(LEARNT_S)
    rows = [
        "## Parking-v0: a baseline that learns",
        "",
        (
            f"PPO of stable-baselines3 {importlib.metadata.version('stable-baselines3')} on LiDAR, {LEARNING_CARS} "
            f"cars at once, one core, nose in from {LEARNT['distance_m'][0]:g} to {LEARNT['distance_m'][1]:g} m of "
            f"path to within {TOLERANCE[0]:g} m and {TOLERANCE[1]:g} degrees, {LEARNING_STEPS} steps at most, in "
            f"{len(SEEDS)} default garages; rewards are shaped by the "
            "potential of the cost (Ng, Harada and Russell, 1999). Success and contacts are those of its last 400 "
            f"episodes while it learns, and in the last line of the first {JUDGED} of {LEARNING_CARS} cars' tasks that "
            f"end in {len(UNSEEN)} garages that it has never seen, without noise, of which the planner solves "
            f"{planner:.1%}."
        ),
        "",
        "| steps | processor seconds | success | contact |",
        "|---|---|---|---|",
    ]
    rows += [f"| {at.steps:,} | {at.seconds:.0f} | {at.success:.1%} | {at.crashed:.1%} |" for at in curve[:-1]]
    rows.append(f"| unseen garages | | {curve[-1].success:.1%} | {curve[-1].crashed:.1%} |")
    return "\n".join(rows)


def _rates(tasks: GarageTasks) -> list[tuple[str, str, int, float]]:
    """Steps a core-second of each environment, in turns."""
    import highway_env  # noqa: F401, PLC0415 - registers its environments

    random = np.random.default_rng(0)
    for _ in range(TASKS):
        tasks.draw(random)
    ours = [(observation, cars) for observation in ("kinematics", "lidar", "occupancy") for cars in CARS]
    measured: dict[tuple[str, str, int], list[float]] = {}
    for _ in range(ROUNDS):
        measured.setdefault((f"highway-env's {HIGHWAY_ID}", "kinematics", 1), []).append(_rate(_highway()))
        for observation, cars in ours:
            made = gymnasium.make_vec(
                PARKING_ID,
                num_envs=cars,
                vectorization_mode="vector_entry_point",
                source=tasks,
                observation=observation,
            )
            rate = cars * _rate(_steps(made))
            measured.setdefault((PARKING_ID, observation, cars), []).append(rate)
    return [(*key, statistics.median(rates)) for key, rates in measured.items()]


def _highway() -> Callable[[], None]:
    environment = gymnasium.make(HIGHWAY_ID)
    environment.reset(seed=0)
    environment.action_space.seed(0)

    def step() -> None:
        *_, terminated, truncated, _ = environment.step(environment.action_space.sample())
        if terminated or truncated:
            environment.reset()

    return step


def _steps(made: gymnasium.vector.VectorEnv[Any, Any, Any]) -> Callable[[], None]:
    made.reset(seed=0)
    made.action_space.seed(0)
    actions = [made.action_space.sample() for _ in range(ACTIONS)]
    counted = iter(range(1 << 62))
    return lambda: made.step(actions[next(counted) % ACTIONS]) and None


def _rate(step: Callable[[], None]) -> float:
    begun, count = time.process_time(), 0
    while time.process_time() - begun < SECONDS:
        step()
        count += 1
    return count / (time.process_time() - begun)


def _is_parked(environment: ParkingEnvironment, seed: int) -> bool:
    """Whether the planner solves the task of a seed."""
    environment.reset(seed=seed)
    info: dict[str, Any] = {}
    actions = reference_actions(environment.task)
    for action in () if actions is None else actions:
        *_, terminated, truncated, info = environment.step(action)
        if terminated or truncated:
            break
    return bool(info.get("is_success"))


def _potential(observed: Any) -> Any:  # noqa: ANN401 - arrays
    """The negative cost of states by the goal that LiDAR observations end with, a few times."""
    x, y, cos_h, _, _ = observed[:, -5:].T.astype(np.float64)
    turned = np.sqrt(np.maximum(1 - cos_h, 0) / 2)
    return -SHAPED * np.sqrt(np.minimum(np.hypot(x, y) * 20 / 30 + 0.1 * turned, 1))


def learn(seconds: float) -> list[Point]:  # noqa: C901 - classes of a package that is loaded only here
    """Learn for some processor seconds; the last point is that of unseen garages."""
    import torch  # noqa: PLC0415 - only here
    from stable_baselines3 import PPO  # noqa: PLC0415
    from stable_baselines3.common.callbacks import BaseCallback  # noqa: PLC0415
    from stable_baselines3.common.vec_env import VecEnv  # noqa: PLC0415

    torch.set_num_threads(1)

    class Cars(VecEnv):  # type: ignore[misc]
        """The vector environment as stable-baselines3 takes one; `ends` are success and contact of its episodes."""

        def __init__(self, seeds: range) -> None:
            self.tasks = GarageTasks([GarageConfig(seed=seed) for seed in seeds], **LEARNT)
            self.cars = ParkingVectorEnvironment(
                self.tasks,
                num_envs=LEARNING_CARS,
                observation="lidar",
                steps=LEARNING_STEPS,
                tolerance=TOLERANCE,
                autoreset_mode=AutoresetMode.SAME_STEP,
            )
            self.ends: list[tuple[bool, bool]] = []
            super().__init__(LEARNING_CARS, self.cars.single_observation_space, self.cars.single_action_space)

        def reset(self) -> Any:  # noqa: ANN401
            observed = self.cars.reset(seed=0)[0]
            self.before = _potential(observed)
            return observed

        def step_async(self, actions: Any) -> None:  # noqa: ANN401
            self.actions = actions

        def step_wait(self) -> Any:  # noqa: ANN401
            observed, rewards, terminated, truncated, infos = self.cars.step(self.actions)
            told: list[dict[str, Any]] = [{} for _ in range(LEARNING_CARS)]
            for number in np.flatnonzero(terminated | truncated).tolist():
                told[number]["terminal_observation"] = infos["final_obs"][number]
                told[number]["TimeLimit.truncated"] = bool(truncated[number])
                last = infos["final_info"]
                self.ends.append((bool(last["is_success"][number]), bool(last["is_crashed"][number])))
            after = _potential(observed)
            for number, each in enumerate(told):
                if each:
                    after[number] = 0.0 if terminated[number] else _potential(each["terminal_observation"][None])[0]
            rewards += GAMMA * after - self.before
            self.before = _potential(observed)
            return observed, rewards.astype(np.float32), terminated | truncated, told

        def close(self) -> None: ...

        def get_attr(self, name: str, indices: Any = None) -> list[Any]:  # noqa: ANN401, ARG002
            return [None] * LEARNING_CARS

        def set_attr(self, name: str, value: Any, indices: Any = None) -> None: ...  # noqa: ANN401

        def env_method(self, name: str, *arguments: Any, indices: Any = None, **named: Any) -> list[Any]:  # noqa: ANN401, ARG002
            return [None] * LEARNING_CARS

        def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:  # noqa: ANN401, ARG002
            return [False] * LEARNING_CARS

    cars, unseen = Cars(SEEDS), Cars(UNSEEN)
    random, begun = np.random.default_rng(0), 0.0
    for _ in range(JUDGED):
        cars.tasks.draw(random)  # all paths are searched before the clock runs
    curve: list[Point] = []

    class Watch(BaseCallback):  # type: ignore[misc]
        """Notes the curve at doubling counts of steps, and stops in time."""

        def _on_step(self) -> bool:
            return time.process_time() - begun < seconds

        def _on_rollout_end(self) -> None:
            if not curve or self.num_timesteps >= 1.5 * curve[-1].steps:
                self.note()

        def note(self) -> None:
            success, crashed = np.mean(cars.ends[-400:] or [(0, 0)], axis=0).tolist()
            curve.append(Point(self.num_timesteps, time.process_time() - begun, success, crashed))
            print(curve[-1], file=sys.stderr, flush=True)

    agent = PPO(
        "MlpPolicy",
        cars,
        n_steps=128,
        batch_size=1024,
        n_epochs=6,
        learning_rate=5e-4,
        gamma=GAMMA,
        policy_kwargs={"net_arch": [128, 128], "log_std_init": -0.5},
        device="cpu",
        seed=0,
    )
    watch, begun = Watch(), time.process_time()
    with contextlib.suppress(KeyboardInterrupt):  # Ctrl+C ends the learning, and the curve so far is written
        agent.learn(1 << 40, callback=watch)
    watch.note()
    observed = unseen.reset()
    while len(unseen.ends) < JUDGED:
        unseen.step_async(agent.predict(observed, deterministic=True)[0])
        observed = unseen.step_wait()[0]
    success, crashed = np.mean(unseen.ends[:JUDGED], axis=0).tolist()
    return [*curve, Point(0, 0.0, success, crashed)]


if __name__ == "__main__":
    print(*learn(float(sys.argv[1])), sep="\n")
