"""Episodes of parking, many at once: tasks, actions, observations, rewards and ends."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

import numpy as np
from gymnasium import spaces
from gymnasium.error import InvalidAction
from numpy.typing import ArrayLike, NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.driving.obstacles import Floats
from garage2usd.environment.garage_tasks import GarageTasks, Source
from garage2usd.environment.reference import ACCELERATION_M_S2, steering_rad
from garage2usd.environment.simulation import CELLS, FASTEST_M_S, RANGE_M, RAYS, Simulation
from garage2usd.environment.task import ParkingTask
from garage2usd.native import elementary

Flags = NDArray[np.bool_]
Tasks = Source | GarageTasks | Sequence[Source] | Sequence[ParkingTask] | None
"""Garages, tasks of garages or a list of tasks, from which tasks are drawn; None for the default garage."""
SCALES = np.array([20.0, 20.0, FASTEST_M_S, FASTEST_M_S, 1.0, 1.0])
"""Metres, metres a second and 1 that a feature of 1 stands for."""
DISCRETE = np.array([(push, turn) for push in (-1.0, 0.0, 1.0) for turn in (-1.0, -0.5, 0.0, 0.5, 1.0)])
"""Acceleration and steering of each discrete action; shape (15, 2)."""
_BOUND = 10.0
_STEPS_PER_REWARD = 100.0
_FAR_M, _TURN_WEIGHT, _STANDS_M_S = 30.0, 0.1, 0.3


class Episodes:
    """Episodes of some cars; parameters as of `garage2usd.environment.ParkingEnvironment`.

    Attributes
    ----------
    tasks
        The task of each car, once it has begun.
    single_observation_space, single_action_space
        Spaces of one car.
    steps
        Number of steps since the start of each episode; shape (n,).
    achieved, desired
        Features of each car and of its goal; shape (n, 6).
    is_crashed, is_outside, is_success
        State of each car; shape (n,).
    trails
        Poses of each car since the start, for pictures, if they are asked for.
    """

    def __init__(
        self,
        count: int,
        source: Tasks,
        *,
        observation: str = "kinematics",
        action: str = "continuous",
        reward: str = "dense",
        tolerance: tuple[float, float] = (0.25, 5.0),
        steps: int = 400,
        is_drawn: bool = False,
        **settings: Any,  # noqa: ANN401 - those of GarageTasks
    ) -> None:
        for field, value, allowed in (
            ("observation", observation, ("kinematics", "lidar", "occupancy")),
            ("action", action, ("continuous", "discrete")),
            ("reward", reward, ("dense", "sparse")),
        ):
            if value not in allowed:
                raise ConfigError(field, value, ", ".join(allowed))
        if not (len(tolerance) == 2 and min(tolerance) > 0):  # noqa: PLR2004
            raise ConfigError("tolerance", tolerance, "metres and degrees, more than 0")
        for field, number in (("steps", steps), ("num_envs", count)):
            if number < 1:
                raise ConfigError(field, number, "at least 1")
        self._draw = _drawing(source, steps, settings)
        self._observation, self._is_continuous = observation, action == "continuous"
        self._is_dense, self._most, self._is_drawn = reward == "dense", steps, is_drawn
        self._near_m, self._cos = tolerance[0], float(np.cos(np.radians(tolerance[1])))
        self.simulation = Simulation(count)
        self.tasks: list[ParkingTask | None] = [None] * count
        self.steps, self.trails = np.zeros(count, np.int64), [list[Floats]() for _ in range(count)]
        self._frames, self._goals, self._cars = np.zeros((count, 3)), np.zeros((count, 4)), np.ones((count, 2))
        self.achieved, self.desired = np.zeros((2, count, 6), np.float32)
        self._arenas, self.steering_rad = np.zeros((count, 3)), np.zeros(count)
        self.is_crashed, self.is_outside, self.is_success = (np.zeros(count, np.bool_) for _ in range(3))
        self.single_observation_space = _SPACES[observation]
        self.single_action_space: spaces.Space[Any] = (
            spaces.Box(-1.0, 1.0, (2,), np.float32) if self._is_continuous else spaces.Discrete(len(DISCRETE))
        )

    def begin(self, number: int, random: np.random.Generator, task: ParkingTask | None = None) -> None:
        """Begin an episode of a car, of a given or drawn task."""
        task = task or self._draw(random)
        self.tasks[number] = task
        self.simulation.place(number, task)
        one = slice(number, number + 1)
        self._frames[number] = task.start.x_m, task.start.z_m, task.start.yaw_rad
        self._goals[number] = task.goal.x_m, task.goal.z_m, task.goal.yaw_rad, 0.0
        self.achieved[number] = 0.0, 0.0, 0.0, 0.0, 1.0, 0.0
        self.desired[one] = _features(self._goals[one], self._frames[one])
        self._cars[number] = task.car.wheelbase_m, steering_rad(task.car)
        (x, z), half_m = task.arena
        self._arenas[number] = x, z, half_m
        self.steps[number], self.steering_rad[number], self.trails[number] = 0, 0.0, []
        self.is_crashed[number] = self.is_outside[number] = self.is_success[number] = False

    def advance(self, actions: ArrayLike, is_driven: Flags) -> tuple[Floats, Flags, Flags]:
        """Drive some cars for a step; return rewards, ends by failure or success, and ends by time, each of shape (n,).

        Raises
        ------
        gymnasium.error.InvalidAction
            If an action is not a number, or does not exist.
        """
        ordered = self._ordered(actions)
        wheelbases, full = self._cars.T
        self.steering_rad = np.where(is_driven, ordered[:, 1] * full, self.steering_rad)
        orders = np.stack([ordered[:, 0] * ACCELERATION_M_S2, elementary.tan(self.steering_rad) / wheelbases], axis=1)
        self.is_crashed = self.simulation.drive(orders, is_driven)
        self.steps += is_driven
        away = np.abs(self.simulation.lot.poses[:, :2] - self._arenas[:, :2]).max(axis=1)
        self.is_outside = is_driven & (away > self._arenas[:, 2])
        failed = self.is_crashed | self.is_outside
        self.achieved = _features(self.simulation.lot.poses, self._frames)
        self.is_success = is_driven & ~failed & self.reached(self.achieved, self.desired)
        rewards = np.where(is_driven, self.reward(self.achieved, self.desired, failed), 0.0)
        if self._is_drawn:
            for trail, pose in zip(self.trails, self.simulation.lot.poses.copy(), strict=True):
                trail.append(pose)
        terminated = failed | self.is_success
        return rewards, terminated, is_driven & ~terminated & (self.steps >= self._most)

    def reached(self, achieved: ArrayLike, desired: ArrayLike) -> Flags:
        """Return True where a goal is reached, within the tolerance and nearly at a standstill; shape (...)."""
        far_m, cos, speed_m_s = _between(achieved, desired)
        is_reached: Flags = (far_m <= self._near_m) & (cos >= self._cos) & (speed_m_s <= _STANDS_M_S)
        return is_reached

    def reward(self, achieved: ArrayLike, desired: ArrayLike, failed: ArrayLike) -> Floats:
        """Return the reward of states, of which some have failed; shape (...)."""
        far_m, cos, _ = _between(achieved, desired)
        turned = np.sqrt(np.maximum(1.0 - cos, 0.0) / 2)
        cost = np.sqrt(np.minimum(far_m / _FAR_M + _TURN_WEIGHT * turned, 1.0)) if self._is_dense else 1.0
        failed = np.asarray(failed)
        won = self.reached(achieved, desired) & ~failed
        rewards: Floats = won - (cost + failed * self._most) / _STEPS_PER_REWARD
        return rewards

    def observed(self) -> Any:  # noqa: ANN401 - an array, or a dictionary of them
        """Return new arrays of what each car observes; their first axis counts the cars."""
        if self._observation == "kinematics":
            achieved, desired = self.achieved.copy(), self.desired.copy()
            return {"observation": self.achieved.copy(), "achieved_goal": achieved, "desired_goal": desired}
        state = _features(self._goals, self.simulation.lot.poses)[:, [0, 1, 4, 5]]
        speed = (self.simulation.lot.poses[:, 3:] / FASTEST_M_S).astype(np.float32)
        if self._observation == "occupancy":
            return {"occupancy": self.simulation.occupancy(), "state": np.concatenate([state, speed], axis=1)}
        ranges = (self.simulation.ranges_m() / RANGE_M).astype(np.float32)
        return np.concatenate([ranges, state, speed], axis=1)

    def told(self) -> dict[str, Flags]:
        """Return the information beside the observations, each of shape (n,)."""
        return {name: getattr(self, name).copy() for name in ("is_success", "is_crashed", "is_outside")}

    def _ordered(self, actions: ArrayLike) -> Floats:
        """Return acceleration and steering of each car, in [-1, 1]; shape (n, 2)."""
        asked = np.asarray(actions)
        count = len(self.tasks)
        if not self._is_continuous:
            if (
                asked.shape != (count,)
                or asked.dtype.kind not in "iu"
                or not np.isin(asked, range(len(DISCRETE))).all()
            ):
                raise InvalidAction(f"action: got {actions!r}; allowed: whole numbers 0 to {len(DISCRETE) - 1}")
            return cast("Floats", DISCRETE[asked])
        if asked.shape != (count, 2) or asked.dtype.kind not in "fiu" or not np.isfinite(asked).all():
            raise InvalidAction(f"action: got {actions!r}; allowed: finite acceleration and steering")
        return np.clip(asked, -1.0, 1.0).astype(np.float64)


def _features(poses: Floats, frames: Floats) -> NDArray[np.float32]:
    """Return x, y, vx, vy, cos h and sin h of poses in the frames of others, x ahead and y left; shape (n, 6)."""
    # complex numbers: the real axis is X, the imaginary one -Z
    apart = poses[:, 0] - frames[:, 0] - 1j * (poses[:, 1] - frames[:, 1])
    place = apart * np.conj(1j * elementary.turned(frames[:, 2]))
    heading = elementary.turned(poses[:, 2] - frames[:, 2])
    columns = np.stack([place, heading * poses[:, 3], heading], axis=1)
    return cast("NDArray[np.float32]", (columns.view(np.float64) / SCALES).astype(np.float32))


def _between(achieved: ArrayLike, desired: ArrayLike) -> tuple[Floats, Floats, Floats]:
    """Return distance in metres, cosine of the angle and difference in speed in m/s between features."""
    one, other = np.asarray(achieved, np.float64) * SCALES, np.asarray(desired, np.float64) * SCALES
    apart = one - other
    cos = (one[..., 4:] * other[..., 4:]).sum(axis=-1)
    return np.hypot(apart[..., 0], apart[..., 1]), cos, np.hypot(apart[..., 2], apart[..., 3])


def _drawing(source: Tasks, steps: int, settings: Mapping[str, Any]) -> Callable[[np.random.Generator], ParkingTask]:
    """Return the function that draws the tasks of a source."""
    listed = list(source) if isinstance(source, Sequence) and not isinstance(source, str) else [source]
    if not listed:
        raise ConfigError("source", source, "at least one garage or task")
    tasks = [each for each in listed if isinstance(each, ParkingTask)]
    if len(tasks) < len(listed) and not isinstance(source, GarageTasks):
        garages = cast("list[Source]", [GarageConfig() if each is None else each for each in listed])
        return GarageTasks(garages, steps=steps, **settings).draw
    for field, value in settings.items():
        raise ConfigError(field, value, "left out beside finished tasks")
    return source.draw if isinstance(source, GarageTasks) else lambda random: tasks[int(random.integers(len(tasks)))]


def _box(count: int) -> spaces.Box:
    return spaces.Box(-_BOUND, _BOUND, (count,), np.float32)


_SPACES: dict[str, spaces.Space[Any]] = {
    "kinematics": spaces.Dict({name: _box(6) for name in ("observation", "achieved_goal", "desired_goal")}),
    "lidar": _box(RAYS + 5),
    "occupancy": spaces.Dict({"occupancy": spaces.Box(0, 255, (2, CELLS, CELLS), np.uint8), "state": _box(5)}),
}
