"""Parking as a Gymnasium environment, ``garage2usd/Parking-v0``: one car, or many at once."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Dict
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.driving import Pose
from garage2usd.environment.episodes import Episodes, Tasks
from garage2usd.environment.picture import draw_task
from garage2usd.environment.task import ParkingTask

_Infos = Mapping[str, Any] | Sequence[Mapping[str, Any]]
_METADATA = {"render_modes": ["rgb_array"], "render_fps": 5}


class ParkingEnvironment(gymnasium.Env[Any, Any]):
    """A car parks in a garage: a kinematic bicycle among exact outlines.

    Parameters
    ----------
    source
        Garages, as of `GarageTasks`, or one of them; or `GarageTasks`, which several environments may share; or a list
        of `ParkingTask`, such as those of published scenes. The default garage if left out.
    observation
        ``"kinematics"``, ``"lidar"`` or ``"occupancy"``.
    action
        ``"continuous"`` or ``"discrete"``.
    reward
        ``"dense"`` or ``"sparse"``.
    tolerance
        Greatest distance in metres and angle in degrees from the goal.
    steps
        Greatest number of steps of an episode.
    render_mode
        ``"rgb_array"``, for which `render` draws the scene from above, or None.
    **settings
        Those of `GarageTasks`, for garages: `task`, `nose`, `distance_m`, `filled`, `tracks`, `car`.

    Attributes
    ----------
    task
        The task of the current episode.
    render_mode
        As given.

    Raises
    ------
    ConfigError
        If a setting is not one of these, or no task is found.

    Notes
    -----
    **Tasks.** The car begins at a standstill on a proven path into a stall, at a drawn distance, and shall stand on the
    goal: the parked pose of the proof, nose in or nose out. All that stands on the floor is an obstacle, without the
    car, wheel stop and cones of the stall itself. With ``task="leave"`` it begins in the stall, and the goal is on the
    proven path towards the street. Agents of `tracks` move at their times, and do not see the car.

    **Dynamics.** A step is 0.2 s, simulated in 5 ticks. The rear axle drives exact arcs, with the curvature
    tan(steering) / wheelbase; the steering angle of an action is there at once. The speed stays within 3 m/s in both
    gears, and is kept at an acceleration of 0: the car does not roll out. Nothing is random but the task.

    **Actions.** ``"continuous"``: ``Box(-1, 1, (2,), float32)``, acceleration (1 is 2 m/s2) and steering (1 is full
    lock to the left). ``"discrete"``: ``Discrete(15)``, for number ``5 i + j`` the acceleration -1, 0 or 1 of i and the
    steering -1, -0.5, 0, 0.5 or 1 of j. *Bad actions:* numbers beyond -1 and 1 are clipped, as in
    ``MountainCarContinuous-v0``. NaN, infinity, another shape or an unknown number raise
    ``gymnasium.error.InvalidAction``, and the state remains.

    **Observations.** Float32.

    - ``"kinematics"``: a ``Dict`` of ``observation``, ``achieved_goal`` and ``desired_goal``, each of shape (6,): x, y,
      vx, vy, cos h, sin h, in the frame of the start pose, x ahead and y to the left, of the rear axle. Positions are
      divided by 20 m and speeds by 3 m/s. It does not tell of obstacles.
    - ``"lidar"``: shape (69,): 64 distances from the middle of the car to the nearest edge, the first ahead and the
      others counterclockwise, divided by the range of 20 m; then the goal as seen from the car: x, y, cos h, sin h;
      then the speed.
    - ``"occupancy"``: a ``Dict`` of ``occupancy``, uint8, shape (2, 64, 64): 255 in cells of 0.3125 m that meet an
      obstacle (0), and the car on its goal (1), around the middle of the car, with its nose up; and ``state``, shape
      (5,): as the end of ``"lidar"``.

    **Rewards.** ``-cost / 100 + is_success - steps / 100 * (is_crashed or is_outside)``. The cost is 1 if ``"sparse"``,
    and sqrt(min(1, d / 30 m + 0.1 abs(sin(turn / 2)))) if ``"dense"``, with the distance d and the turn between car and
    goal. So a failure costs as much as the worst whole episode, and a car gains nothing by ending one.

    **Episodes.** An episode is terminated if the outline of the car touches an obstacle or agent (``is_crashed``), if
    its rear axle is more than 15 m outside the square around start, goal and path (``is_outside``), or if the car is on
    the goal, at no more than 0.3 m/s (``is_success``). It is truncated after `steps` steps.

    **Info.** ``is_success``, ``is_crashed``, ``is_outside``.

    **Reset.** ``options={"task": task}`` begins a given `ParkingTask` instead of a drawn one.
    """

    metadata = _METADATA

    def __init__(self, source: Tasks = None, *, render_mode: str | None = None, **settings: Any) -> None:  # noqa: ANN401
        self.render_mode = render_mode
        self._episodes = Episodes(1, source, is_drawn=render_mode is not None, **settings)
        self.observation_space = self._episodes.single_observation_space
        self.action_space = self._episodes.single_action_space
        self._is_over = True

    @property
    def task(self) -> ParkingTask:
        """The task of the current episode, even if it has ended."""
        return _begun(self._episodes.tasks[0])

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode of a task that is drawn by `seed`, or of that in `options`."""
        super().reset(seed=seed, options=options)
        self._episodes.begin(0, self.np_random, _task_in(options))
        self._is_over = False
        return _at(self._episodes.observed(), 0), self._told()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:  # noqa: ANN401
        """Drive for 0.2 s.

        Raises
        ------
        gymnasium.error.InvalidAction
            If the action is not finite or does not exist.
        gymnasium.error.ResetNeeded
            If no episode was begun, or the last one has ended.
        """
        _begun(self._episodes.tasks[0])
        if self._is_over:
            raise ResetNeeded("step: the episode is over; call reset first")
        rewards, terminated, truncated = self._episodes.advance(np.asarray(action)[None], np.ones(1, np.bool_))
        self._is_over = bool(terminated[0] or truncated[0])
        observed = _at(self._episodes.observed(), 0)
        return observed, float(rewards[0]), bool(terminated[0]), bool(truncated[0]), self._told()

    @property
    def compute_reward(self) -> Callable[[ArrayLike, ArrayLike, _Infos], Any]:
        """Reward of an achieved goal, a desired goal and an info, as replay buffers with hindsight ask for it.

        Goals are features as observed, of shape (6,), with the info of the step; or of shape (n, 6), with n infos, for
        n rewards. Whoever crashed or was outside has failed for any goal.

        Raises
        ------
        AttributeError
            If the observations are not ``"kinematics"``, which alone have goals.
        """
        if "desired_goal" not in (self.observation_space.spaces if isinstance(self.observation_space, Dict) else {}):
            raise AttributeError("compute_reward: only observations of kinematics have goals")
        return self._reward_of

    def _reward_of(self, achieved_goal: ArrayLike, desired_goal: ArrayLike, info: _Infos) -> Any:  # noqa: ANN401
        told = [info] if isinstance(info, Mapping) else list(info)
        failed = np.array([bool(each.get("is_crashed")) or bool(each.get("is_outside")) for each in told])
        rewards = self._episodes.reward(achieved_goal, desired_goal, failed)
        return float(rewards[0]) if np.ndim(achieved_goal) == 1 else rewards

    def render(self) -> NDArray[np.uint8] | None:
        """Draw the scene from above, with the proven path in green; shape (600, 600, 3). None without a render mode."""
        return None if self.render_mode is None else _drawn(self._episodes, 0)

    def _told(self) -> dict[str, Any]:
        return {name: bool(flags[0]) for name, flags in self._episodes.told().items()}


class ParkingVectorEnvironment(VectorEnv[Any, Any, Any]):
    """Many cars that park at the same time, each in a task of its own.

    Parameters
    ----------
    source, render_mode, **settings
        As of `ParkingEnvironment`.
    num_envs
        Number of cars.
    autoreset_mode
        ``AutoresetMode.NEXT_STEP`` or ``SAME_STEP``, as of ``gymnasium.vector.SyncVectorEnv``.

    Attributes
    ----------
    tasks
        The current task of each car.

    Notes
    -----
    ``gymnasium.make_vec("garage2usd.environment:garage2usd/Parking-v0", num_envs=64)`` makes one. Cars have the seeds
    seed, seed + 1 and so on, and each drives exactly as a `ParkingEnvironment` of that seed.
    """

    metadata: dict[str, Any] = _METADATA

    def __init__(
        self,
        source: Tasks = None,
        *,
        num_envs: int = 1,
        render_mode: str | None = None,
        autoreset_mode: AutoresetMode = AutoresetMode.NEXT_STEP,
        **settings: Any,  # noqa: ANN401
    ) -> None:
        if autoreset_mode not in {AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP}:
            raise ConfigError("autoreset_mode", autoreset_mode, "AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP")
        self.num_envs, self.render_mode = num_envs, render_mode
        self.metadata = {**_METADATA, "autoreset_mode": autoreset_mode}
        self._episodes = Episodes(num_envs, source, is_drawn=render_mode is not None, **settings)
        self.single_observation_space = self._episodes.single_observation_space
        self.single_action_space = self._episodes.single_action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._is_same_step = autoreset_mode is AutoresetMode.SAME_STEP
        self._randoms: list[np.random.Generator] = []
        self._is_over = np.zeros(num_envs, np.bool_)

    @property
    def tasks(self) -> tuple[ParkingTask, ...]:
        """The current task of each car."""
        return tuple(_begun(task) for task in self._episodes.tasks)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode of each car; see `ParkingEnvironment.reset`."""
        seeds = [seed + number for number in range(self.num_envs)] if isinstance(seed, int) else seed
        if seeds is not None or not self._randoms:
            self._randoms = [gymnasium.utils.seeding.np_random(each)[0] for each in seeds or [None] * self.num_envs]
        for number, random in enumerate(self._randoms):
            self._episodes.begin(number, random, _task_in(options))
        self._is_over[:] = False
        return self._episodes.observed(), self._told()

    def step(
        self,
        actions: Any,  # noqa: ANN401
    ) -> tuple[Any, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Drive each car for 0.2 s, or begin its next episode; errors as of `ParkingEnvironment.step`."""
        _begun(self._episodes.tasks[0])
        rewards, terminated, truncated = self._episodes.advance(actions, ~self._is_over)
        if not self._is_same_step:
            self._begin(self._is_over)
        self._is_over = terminated | truncated
        infos: dict[str, Any] = {}
        if self._is_same_step and self._is_over.any():
            observed, told = self._episodes.observed(), self._episodes.told()
            for number in np.flatnonzero(self._is_over).tolist():
                last = {name: bool(flags[number]) for name, flags in told.items()}
                infos = self._add_info(infos, {"final_obs": _at(observed, number), "final_info": last}, number)
            self._begin(self._is_over)
            self._is_over[:] = False
        return self._episodes.observed(), rewards, terminated, truncated, {**infos, **self._told()}

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Draw the scene of each car as `ParkingEnvironment.render`; None without a render mode."""
        return (
            None if self.render_mode is None else tuple(_drawn(self._episodes, each) for each in range(self.num_envs))
        )

    def _begin(self, are_over: NDArray[np.bool_]) -> None:
        for number in np.flatnonzero(are_over).tolist():
            self._episodes.begin(number, self._randoms[number])

    def _told(self) -> dict[str, Any]:
        told = self._episodes.told()
        return {**told, **{f"_{name}": np.ones(self.num_envs, np.bool_) for name in told}}


def _begun(task: ParkingTask | None) -> ParkingTask:
    if task is None:
        raise ResetNeeded("no episode was begun; call reset first")
    return task


def _task_in(options: Mapping[str, Any] | None) -> ParkingTask | None:
    task = (options or {}).get("task")
    if task is not None and not isinstance(task, ParkingTask):
        raise ConfigError("options.task", task, "a ParkingTask")
    return task


def _at(observed: Any, number: int) -> Any:  # noqa: ANN401
    """Return what one car observes."""
    return {name: part[number] for name, part in observed.items()} if isinstance(observed, dict) else observed[number]


def _drawn(episodes: Episodes, number: int) -> NDArray[np.uint8]:
    lot, task = episodes.simulation.lot, _begun(episodes.tasks[number])
    x, z, yaw_rad, _ = lot.poses[number].tolist()
    trail = np.array([[task.start.x_m, task.start.z_m], *(pose[:2] for pose in episodes.trails[number])])
    return draw_task(
        task, Pose(x, z, yaw_rad), float(episodes.steering_rad[number]), trail=trail, tick=int(lot.ticks[number])
    )
