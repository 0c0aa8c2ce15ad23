"""The decision process of the paper: a car that colours squares as lanes, as plain functions over immutable values.

A car drives over a site from an entrance, one square at a time, and every free square that it enters becomes a lane.
`observe`, `actions`, `transition`, `reward` and `terminal` are the verbs of a functional environment.
`garage2usd.planning.reference_sarsa` learns in it in plain Python. `learn` in `garage2usd.planning.sarsa` is the same
process compiled; it shares no code with these functions, and the tests compare it with the reference. Equations are
counted in the order in which the paper prints them, because its labels repeat.
"""

from dataclasses import dataclass, replace
from enum import Enum, IntEnum
from functools import cached_property
from typing import NamedTuple

from garage2usd.config import BayConfig
from garage2usd.config.plan import SarsaParameters
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, CellArray, Structure
from garage2usd.structure.stalls import CapacityTable, capacity_table, served_capacity

Square = tuple[int, int]
"""(row, col)."""


class Action(IntEnum):
    """The action set A of equation 19; the first four in the order of `NEIGHBOUR_STEPS`."""

    UP = 0
    DOWN = 1
    LEFT = 2
    RIGHT = 3
    STAY = 4


_MOVES = (Action.UP, Action.DOWN, Action.LEFT, Action.RIGHT)
_OPPOSITE = dict(zip(_MOVES, (Action.DOWN, Action.UP, Action.RIGHT, Action.LEFT), strict=True))


class Ending(Enum):
    """Outcome of an episode."""

    RETURNED = "returned"
    """The car stayed on the square that it started from: the goal of the paper."""
    FAILED = "failed"
    """The car drove against something, or drove on after it had come back to its start."""


class Observation(NamedTuple):
    """Observation of a state: equation 18, ``S_t = (D, M, A_{t-1})``.

    Attributes
    ----------
    distances
        D: squares that the car could drive straight on, up, down, left and right; empty where the parameters have no
        `sees_distances`.
    window
        M: values of `Cell` of the squares around the car in reading order, (2 r + 1)^2 of them for a
        `window_radius_squares` r.
    last_action
        A_{t-1}.
    """

    distances: tuple[int, ...]
    window: tuple[int, ...]
    last_action: Action


@dataclass(frozen=True)
class DecisionProcess:
    """Constants of an episode.

    Attributes
    ----------
    site
        Contour, obstacles and portals; its lanes, if any, count as free squares.
    bay
        Size of the stalls.
    parameters
        Penalties, view and actions of the agent: those of a preset by `PlanConfig.resolved`.
    """

    site: Structure
    bay: BayConfig
    parameters: SarsaParameters

    @cached_property
    def cells(self) -> dict[Square, Cell]:
        """Kind of each square of the site before the first action."""
        return {
            (row, col): Cell.FREE if cell == Cell.LANE else Cell(cell)
            for row, line in enumerate(self.site.cells.tolist())
            for col, cell in enumerate(line)
        }

    @cached_property
    def capacity(self) -> CapacityTable:
        """Stalls of each square by the lanes beside it."""
        return capacity_table(self.site, self.bay)

    @property
    def entrances(self) -> tuple[Square, ...]:
        """Start squares of episodes, in reading order."""
        return tuple(self.site.where(Cell.ENTRANCE))

    @cached_property
    def horizon(self) -> int:
        """Actions after which an episode is cut off."""
        return self.parameters.max_steps_per_square * list(self.cells.values()).count(Cell.FREE)


@dataclass(frozen=True)
class State:
    """One state of an episode, of which `Observation` is what the agent sees.

    Attributes
    ----------
    start
        The entrance that the car started from.
    square
        Square of the car.
    last_action
        The action that led here; `Action.STAY` at first.
    run_squares
        Moves in a row in the direction of the last one; 0 after `Action.STAY`.
    lanes
        Squares coloured so far.
    ending
        Outcome of the episode; None while it goes on.
    """

    start: Square
    square: Square
    last_action: Action = Action.STAY
    run_squares: int = 0
    lanes: frozenset[Square] = frozenset()
    ending: Ending | None = None


def initial(start: Square) -> State:
    """S_0 of equation 15: the car on an entrance of a site without lanes."""
    return State(start=start, square=start)


def observe(process: DecisionProcess, state: State) -> Observation:
    """Observe a state.

    Notes
    -----
    Equation 18, ``S_t = (D, M, A_{t-1})``. Deviation: M has the 25 squares that the paper gives it, a window of 5 x 5,
    and not the 5 squares at a Manhattan distance below 2 that it describes. Deviation: D counts squares that are free
    or lanes, since the paper measures to free space, borders and obstacles alike; portals end a line, too. Deviation:
    an agent with the preset ``tuned`` sees 3 x 3 squares without D, as it finds better plans so in as many episodes.
    """
    parameters, (row, col) = process.parameters, state.square
    reach = range(-parameters.window_radius_squares, parameters.window_radius_squares + 1)
    steps = NEIGHBOUR_STEPS if parameters.sees_distances else ()
    return Observation(
        distances=tuple(_distance(process, state, step) for step in steps),
        window=tuple(int(_cell(process, state, (row + down, col + across))) for down in reach for across in reach),
        last_action=state.last_action,
    )


def actions(process: DecisionProcess, state: State) -> tuple[Action, ...]:
    """List the actions that the agent may choose; empty if it is enclosed.

    Notes
    -----
    Equation 19, ``A = {UP, DOWN, LEFT, RIGHT, STAY}``. Deviation: only moves onto free squares and
    lanes can be chosen with ``masks_actions``, as in the preset ``tuned``, so that no episode fails or returns to its
    start.
    """
    if not process.parameters.masks_actions:
        return tuple(Action)
    return tuple(move for move in _MOVES if _cell(process, state, _ahead(state.square, move)) in {Cell.FREE, Cell.LANE})


def transition(process: DecisionProcess, state: State, action: Action) -> State:
    """S_{t+1} of equation 15, for any action, whether `actions` allows it or not.

    Notes
    -----
    "The goal is to colour the road as much as possible until it comes back to the start and takes action STAY,
    leading to a terminate state." Deviation: the paper does not say what fails; an episode fails at a square that is
    neither free nor a lane nor the start, and at any move away from the start once the car has come back to it.
    """
    if action is Action.STAY:
        returned = state.square == state.start
        return replace(state, last_action=action, run_squares=0, ending=Ending.RETURNED if returned else None)
    ahead = _ahead(state.square, action)
    cell = _cell(process, state, ahead)
    has_come_back = state.square == state.start and state.last_action is not Action.STAY
    if has_come_back or not (cell in {Cell.FREE, Cell.LANE} or ahead == state.start):
        return replace(state, ending=Ending.FAILED)
    return replace(
        state,
        square=ahead,
        last_action=action,
        run_squares=state.run_squares + 1 if action is state.last_action else 1,
        lanes=state.lanes | {ahead} if cell is Cell.FREE else state.lanes,
    )


def reward(process: DecisionProcess, state: State, action: Action, following: State) -> float:
    """R_{t+1}, where `following` is the `transition` of `state` by `action`.

    Notes
    -----
    "Agent receives rewards depending on the increment of the number of parking spaces", N_S(S_{t+1}) - N_S(S_t), less
    the four penalties of "Penalty design", of which the paper prints neither formulas nor weights. Deviation: staying
    costs the step penalty twice, so that an agent does not wait. Deviation: the wheeling penalty is taken for each
    lane beside a new one other than the one that it continues. Deviation: a new lane that closes a loop earns
    ``loop_reward``, which is 0 in both presets. A failure is R_T, which the return E of equation 16 leaves out.
    """
    parameters = process.parameters
    if following.ending is Ending.FAILED:
        return -parameters.failure_penalty
    if action is Action.STAY:
        return -2 * parameters.step_penalty
    penalty = parameters.step_penalty + _turning_penalty(parameters, state, action)
    if following.lanes == state.lanes:
        return -penalty
    # "at an improper position with a certain direction": beside lanes other than the one that it continues
    beside = sum(_ahead(following.square, move) in state.lanes for move in _MOVES)
    wheeling = parameters.wheeling_penalty * max(0, beside - 1)
    loop = parameters.loop_reward if beside > 1 else 0.0
    return -penalty - wheeling + loop + (stalls(process, following) - stalls(process, state))


def terminal(process: DecisionProcess, state: State) -> bool:
    """Test whether the episode is over: t = T of equation 15, or no action is left.

    Runners also cut episodes off after `DecisionProcess.horizon` actions.
    """
    return state.ending is not None or not actions(process, state)


def structure_of(process: DecisionProcess, state: State) -> Structure:
    """Build the structure of a state: the site with its coloured lanes."""
    return process.site.with_cells(_coloured(process, state))


def stalls(process: DecisionProcess, state: State) -> int:
    """Count N_S of the lanes that are coloured in a state."""
    return int(served_capacity(_coloured(process, state), process.capacity).sum())


def _coloured(process: DecisionProcess, state: State) -> CellArray:
    """Matrix S of a state."""
    cells = process.site.cells.copy()
    cells[cells == Cell.LANE] = Cell.FREE
    for square in state.lanes:
        cells[square] = Cell.LANE
    return cells


def _turning_penalty(parameters: SarsaParameters, state: State, action: Action) -> float:
    """Turn-back penalty for "the opposite action from the last action", else interval penalty for an early turn."""
    if state.last_action is Action.STAY or action is state.last_action:
        return 0.0
    if action is _OPPOSITE[state.last_action]:
        return parameters.turn_back_penalty
    return parameters.interval_penalty if state.run_squares < parameters.min_run_squares else 0.0


def _distance(process: DecisionProcess, state: State, step: Square) -> int:
    """Squares that are free or lanes in a line from the car."""
    row, col = state.square
    squares = 0
    while _cell(process, state, (row + step[0], col + step[1])) in {Cell.FREE, Cell.LANE}:
        row, col, squares = row + step[0], col + step[1], squares + 1
    return squares


def _ahead(square: Square, move: Action) -> Square:
    down, across = NEIGHBOUR_STEPS[move]
    return square[0] + down, square[1] + across


def _cell(process: DecisionProcess, state: State, square: Square) -> Cell:
    """Equation 1 on any square: the site's, or a lane that was coloured; squares beyond the matrix are outside."""
    return Cell.LANE if square in state.lanes else process.cells.get(square, Cell.OBSTACLE)
