"""The decision process as a Gymnasium environment, ``garage2usd/Lanes-v0``."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.error import InvalidAction, ResetNeeded
from numpy.typing import NDArray

from garage2usd.config import GarageConfig
from garage2usd.planning.decision import (
    Action,
    DecisionProcess,
    State,
    actions,
    initial,
    observe,
    reward,
    structure_of,
    terminal,
    transition,
)
from garage2usd.planning.score import evaluate, is_feasible
from garage2usd.site.levels import level_number, make_level_sites
from garage2usd.structure.grid import Cell, Structure

_CAR = "@"

Observed = dict[str, Any]


class LanesEnvironment(gymnasium.Env[Observed, np.int64]):
    """A car drives over a site and colours squares as lanes: equations 15 to 19 of the paper.

    Parameters
    ----------
    config
        Settings: `site`, `bay` and `seed` define the site as in a build; `plan` defines penalties, observations and
        allowed actions. The default garage if left out. Lanes of a given structure of one level are removed.
    level
        Level of a garage of several whose lanes are coloured, such as ``"U2"``; the top one if left out.
    render_mode
        ``"ansi"``, for which `render` draws the plan as text, or None.

    Attributes
    ----------
    process
        The decision process.
    sites
        Ramps and sites of all levels, a `garage2usd.site.levels.LevelSites`.
    render_mode
        As given.

    Raises
    ------
    ConfigError, GenerationError
        If the site is infeasible, as for `garage2usd.generate`, or there is no such level.

    Notes
    -----
    **Levels.** Each level of a garage of several is an environment of its own, with the obstacles and portals of this
    level in a build, if that keeps the first place of the ramps (it draws them elsewhere where cars could not turn into
    them): squares of ramps are obstacles, landings are entrances and exits. Where R and C are chosen
    (`bay.dimensioned`), all levels have equal squares here, as a garage of one level has. A build plans lower levels on
    R and C of the planned top level instead, so that the same lanes may hold another number of stalls there. Finished
    levels become a garage by `garage2usd.generate` from a tape, which joins ``sites.ramps.tape`` and
    `garage2usd.planning.tape_of` of the `structure` of each level by ``/``.

    **Actions.** ``Discrete(5)``: 0 up, 1 down, 2 left, 3 right, 4 stay. Rows grow downwards.

    **Observations.** A ``Dict`` with the paper's ``S_t = (D, M, A_{t-1})``:

    - ``distances``: int32, shape (4,), number of free squares straight up, down, left and right; only if the plan's
      ``sees_distances`` is true, as in the preset ``paper``.
    - ``window``: int8, shape (2 r + 1, 2 r + 1) for the plan's ``window_radius_squares`` r, values of
      `garage2usd.structure.grid.Cell` around the car.
    - ``last_action``: ``Discrete(5)``, initially 4.

    **Rewards.** Stalls gained by the action, minus the penalties of `garage2usd.config.PlanConfig`.

    **Episodes.** An episode starts at a random entrance. It is terminated when the car stays on its start, fails (by a
    collision, or by driving on after its return) or is enclosed; it is truncated after ``max_steps_per_square`` actions
    for each free square.

    **Info.** ``action_mask``: int8, shape (5,), 1 for actions that the preset allows, for ``action_space.sample``;
    other actions are executed too and may fail. ``score``: y' of the current lanes. ``is_feasible``: whether the lanes
    are a plan: connected, and adjacent to every portal. ``structure``: the structure matrix as text, of the only level
    a valid ``site.structure`` of `garage2usd.config.GarageConfig`.
    """

    metadata = {"render_modes": ["ansi"], "render_fps": 4}  # noqa: RUF012 - Gymnasium's own form

    def __init__(
        self, config: GarageConfig | None = None, *, level: str | None = None, render_mode: str | None = None
    ) -> None:
        config = config or GarageConfig()
        number = level_number(level, config.building.levels)
        self.sites = make_level_sites(config)
        self.process = DecisionProcess(self.sites.site(number), config.bay, config.plan.resolved())
        self.render_mode = render_mode
        self.action_space = spaces.Discrete(len(Action))
        self.observation_space = _observation_space(self.process)
        self._plan = config.plan
        self._state: State | None = None
        self._steps = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observed, dict[str, Any]]:
        """Begin an episode on the site without lanes, at an entrance drawn by `seed`; `options` are ignored."""
        super().reset(seed=seed, options=options)
        entrances = self.process.entrances
        self._state, self._steps = initial(entrances[int(self.np_random.integers(len(entrances)))]), 0
        return self._observed(self._state), self._info(self._state)

    def step(self, action: np.int64 | int) -> tuple[Observed, float, bool, bool, dict[str, Any]]:
        """Execute an action.

        Raises
        ------
        gymnasium.error.InvalidAction
            If the action does not exist.
        gymnasium.error.ResetNeeded
            If no episode was begun, or the last one has ended.
        """
        if not self.action_space.contains(action):
            raise InvalidAction(f"action: got {action!r}; allowed: whole numbers 0 to {len(Action) - 1}")
        state = self._current
        if terminal(self.process, state) or self._steps >= self.process.horizon:
            raise ResetNeeded("step: the episode is over; call reset first")
        following = transition(self.process, state, Action(int(action)))
        earned = reward(self.process, state, Action(int(action)), following)
        self._state, self._steps = following, self._steps + 1
        terminated = terminal(self.process, following)
        truncated = not terminated and self._steps >= self.process.horizon
        return self._observed(following), earned, terminated, truncated, self._info(following)

    def render(self) -> str | None:
        """Draw the plan with the car as ``@``, one line per row; None without a render mode."""
        if self.render_mode is None:
            return None
        lines = [list(line) for line in str(self.structure).splitlines()]
        row, col = self._current.square
        lines[row][col] = _CAR
        return "\n".join("".join(line) for line in lines)

    @property
    def structure(self) -> Structure:
        """The site with the lanes of the current episode, even if it has ended."""
        return structure_of(self.process, self._current)

    def action_mask(self) -> NDArray[np.int8]:
        """Return the mask of actions that the preset allows now; int8, shape (5,)."""
        mask = np.zeros(len(Action), np.int8)
        mask[list(actions(self.process, self._current))] = 1
        return mask

    @property
    def _current(self) -> State:
        if self._state is None:
            raise ResetNeeded("no episode was begun; call reset first")
        return self._state

    def _observed(self, state: State) -> Observed:
        seen = observe(self.process, state)
        side = 2 * self.process.parameters.window_radius_squares + 1
        observed: Observed = {
            "window": np.array(seen.window, np.int8).reshape(side, side),
            "last_action": np.int64(seen.last_action),
        }
        if seen.distances:
            observed["distances"] = np.array(seen.distances, np.int32)
        return observed

    def _info(self, state: State) -> dict[str, Any]:
        structure = structure_of(self.process, state)
        return {
            "action_mask": self.action_mask(),
            "score": evaluate(structure, bay=self.process.bay, plan=self._plan).value,
            "is_feasible": is_feasible(structure),
            "structure": str(structure),
        }


def _observation_space(process: DecisionProcess) -> spaces.Dict:
    side = 2 * process.parameters.window_radius_squares + 1
    seen: dict[str, spaces.Space[Any]] = {
        "window": spaces.Box(int(min(Cell)), int(max(Cell)), (side, side), np.int8),
        "last_action": spaces.Discrete(len(Action)),
    }
    if process.parameters.sees_distances:
        seen["distances"] = spaces.Box(0, max(process.site.shape), (4,), np.int32)
    return spaces.Dict(seen)
