"""Settings of the lane planner."""

from enum import StrEnum
from typing import Literal, NamedTuple

from pydantic import Field

from garage2usd.common.documents import shipped_toml
from garage2usd.common.settings import Settings
from garage2usd.config.site import SquareIndex


class DeadEnds(StrEnum):
    """Rule on dead-end aisles."""

    ALLOW = "allow"
    """Dead ends are unrestricted."""
    FORBID = "forbid"
    """Dead ends are forbidden."""
    STANDARD = "standard"
    """A dead end longer than 26 m keeps a turning stall free."""


class CirculationMode(StrEnum):
    """Rules on the circulation of traffic."""

    LOOPS = "loops"
    """Short dead ends, at least one loop, lanes one square wide, and cross-aisles on large sites."""
    ALLOW = "allow"
    """None: the score alone decides, which favours trees."""
    PAPER = "paper"
    """None, and `DeadEnds.STANDARD` costs nothing either: plans as the agent leaves them."""


class Aisles(StrEnum):
    """Driving directions of aisles."""

    TWO_WAY = "two-way"
    ONE_WAY = "one-way"
    """One direction, except where a single aisle leads to a part of the garage."""
    MIXED = "mixed"
    """A share of the aisles is one-way."""


class Agent(StrEnum):
    """Unit of the agent's decisions: squares or whole aisles."""

    AUTO = "auto"
    """Squares on small sites and with the preset 'paper', else aisles."""
    SQUARES = "squares"
    AISLES = "aisles"


class Choice(StrEnum):
    """Selection of the garage's plan from the archive."""

    BEST = "best"
    DRAW = "draw"
    """A plan above the quality floor, drawn by the seed."""


class UnreachableStalls(StrEnum):
    """Treatment of stalls that the design car cannot enter and leave without a collision."""

    REFUSE = "refuse"
    """Raise an error; stalls are proven where narrow aisles or stalls leave it in doubt."""
    KEEP = "keep"
    """Keep them as stalls; nothing is proven."""
    MARK = "mark"
    """Prove each stall; those without a path are hatched and kept free."""
    DROP = "drop"
    """Prove each stall; those without a path are left out, and their floor is bare."""

    @property
    def are_proven(self) -> bool:
        """True if every stall is proven."""
        return self in {UnreachableStalls.MARK, UnreachableStalls.DROP}


class SarsaParameters(NamedTuple):
    """All parameters of Sarsa with their values; `PlanConfig` describes the settings of the same names."""

    alpha: float
    gamma: float
    epsilon_start: float
    epsilon_min: float
    epsilon_decay: float
    epsilon_refresh: float
    patience_episodes: int
    turn_back_penalty: float
    interval_penalty: float
    min_run_squares: int
    wheeling_penalty: float
    loop_reward: float
    step_penalty: float
    failure_penalty: float
    window_radius_squares: int
    sees_distances: bool
    masks_actions: bool
    archives_prefixes: bool
    revisit_rate: float
    max_steps_per_square: int
    starts: int


_GIVEN = shipped_toml("garage2usd.config", "sarsa")
_PRESETS = {name: SarsaParameters(**{**_GIVEN["paper"], **given}) for name, given in _GIVEN.items()}
_STARTS_ALONE = 12
"""Starts of the preset 'tuned' without hill climbing, which otherwise evens out differences between starts on small
sites."""

# the agent over aisles starts with values learned on small sites, so that it explores less and learns in smaller steps
_AISLES = _PRESETS["tuned"]._replace(alpha=0.03, gamma=0.9, epsilon_start=0.3, epsilon_min=0.1, revisit_rate=0.9)


class PlanConfig(Settings):
    """Settings of the lane planner. A parameter of Sarsa that is left out has the preset's value."""

    preset: Literal["paper", "tuned"] = "tuned"
    """'paper': state D, 5x5 squares and the last action; a collision ends an episode. 'tuned': 3x3 squares, no
    collisions, and the best prefix of every episode is archived and resumed."""
    agent: Agent = Agent.AUTO
    """Unit of the agent's decisions: 'squares', 'aisles', or 'auto' for aisles on large sites except with the preset
    'paper'."""
    episodes: int = Field(5000, ge=1, le=1_000_000)
    """Learning episodes of each start; the default is the paper's."""
    archive_size: int = Field(200, ge=1, le=10_000)
    """Number of best plans that are kept; the default is the paper's."""
    climb: bool | None = None
    """Improve the best plans after learning by hill climbing over squares; if left out, true except with the preset
    'paper'."""
    climb_top: int = Field(40, ge=1, le=10_000)
    """Number of best plans that are improved."""
    dead_ends: DeadEnds = DeadEnds.STANDARD
    """'allow', 'forbid', or 'standard': a dead-end aisle over 26 m keeps a turning stall free, which costs the plan one
    stall."""

    circulation: CirculationMode | None = None
    """'loops': every dead end disappears within `dead_end_cells` rounds of pruning (R1), there is a loop (R2), no block
    of two by two lanes (R3), and no stretch without a junction longer than `longest_stretch_cells` (R4). 'allow':
    the score alone decides. 'paper': plans as the agent leaves them, without the cost of `dead_ends` = 'standard'.
    If left out, 'paper' with the preset 'paper', else 'loops'."""
    dead_end_cells: int = Field(2, ge=0, le=1000)
    """R1: greatest depth of a dead end in squares."""
    longest_stretch_cells: int | None = Field(None, ge=0, le=1_000_000)
    """R4: most squares of a stretch between two junctions or portals, 0 for no limit; if left out, 12 on sites of 400
    free squares or more, else no limit."""
    strict: bool = False
    """Raise an error if no plan keeps the rules of circulation; if false, the report names the violated rules."""

    unreachable_stalls: UnreachableStalls = UnreachableStalls.REFUSE
    """Treatment of stalls that a car of 4.8 x 1.8 m with a turning radius of 6 m cannot enter and leave without a
    collision. 'refuse': an error, checked where aisles under 5.5 m or stalls under 2.3 m leave it in doubt; 'keep':
    no treatment; 'mark': they are hatched and kept free; 'drop': they are left out."""

    aisles: Aisles = Aisles.TWO_WAY
    """'two-way'; 'one-way': every aisle has one direction, except where a single aisle leads to a part of the garage;
    'mixed': `one_way_share` of the aisles are one-way."""
    one_way_share: float = Field(0.5, ge=0, le=1)
    """With 'mixed', share of the length of aisles that is one-way, among those that can be."""
    one_way: tuple[tuple[SquareIndex, SquareIndex], ...] = ()
    """[from, to] pairs of adjacent lane squares, instead of drawn directions; each makes its aisle one-way from
    junction to junction."""
    choice: Choice = Choice.BEST
    """'best', or 'draw' for any plan of the archive above `quality_floor`, drawn by the seed."""
    quality_floor: float = Field(0.95, ge=0, le=1)
    """Lowest value of a drawn plan, as a share of the best plan's value."""

    stall_weight: float = Field(1.0, ge=0, le=1000)
    """k_1, weight of the stalls N_S in the score."""
    parking_time_weight: float = Field(-5.0, ge=-1000, le=0)
    """k_2, weight of the mean parking time T_S in the score."""
    unused_weight: float = Field(-1.0, ge=-1000, le=0)
    """k_3, weight of the unused squares U_S in the score."""

    alpha: float | None = Field(None, gt=0, le=1)
    """Learning rate."""
    gamma: float | None = Field(None, ge=0, le=1)
    """Discount factor."""
    epsilon_start: float | None = Field(None, ge=0, le=1)
    """Initial share of random actions."""
    epsilon_min: float | None = Field(None, ge=0, le=1)
    """Lowest share of random actions."""
    epsilon_decay: float | None = Field(None, gt=0, le=1)
    """Factor on epsilon after each episode."""
    epsilon_refresh: float | None = Field(None, ge=0, le=1)
    """Epsilon after `patience_episodes` episodes without a change."""
    patience_episodes: int | None = Field(None, ge=1)
    """Number of episodes with the same plan after which epsilon is refreshed."""
    turn_back_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for reversing the last action."""
    interval_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for a turn after fewer than `min_run_squares` equal actions."""
    min_run_squares: int | None = Field(None, ge=1, le=100)
    """Number of equal actions in a row after which a turn is free."""
    wheeling_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for each lane beside a new lane square, other than the one that it continues."""
    loop_reward: float | None = Field(None, ge=0, le=1000)
    """Reward for a new lane square that closes a loop, which means that it touches a lane other than the one it
    continues."""
    step_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for every action, twice for staying."""
    failure_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty R_T for an action that ends an episode in a failure."""
    window_radius_squares: int | None = Field(None, ge=1, le=4)
    """Radius of the agent's view: 2 for the paper's 5x5 squares."""
    sees_distances: bool | None = None
    """Include D in the state: the distance to the next obstacle or border in each direction."""
    masks_actions: bool | None = None
    """Exclude actions that would end in a failure."""
    archives_prefixes: bool | None = None
    """Archive the best state of an episode, in addition to its last state without a failure."""
    revisit_rate: float | None = Field(None, ge=0, le=1)
    """Share of the episodes that start from part of an archived plan instead of the empty site."""
    max_steps_per_square: int | None = Field(None, ge=1, le=100)
    """Most actions in an episode, per free square of the site."""
    starts: int | None = Field(None, ge=1, le=1000)
    """Number of independent learning runs, each with all episodes; the best plans of all are kept. If left out, the
    preset's: 4 with 'tuned', 12 if plans are not improved by hill climbing, and 1 with 'paper'."""

    @property
    def polishes(self) -> bool:
        """True if plans are improved by hill climbing after learning."""
        return self.preset != "paper" if self.climb is None else self.climb

    @property
    def circulation_mode(self) -> CirculationMode:
        """Rules on circulation: the user's choice, or the preset's."""
        preset = CirculationMode.PAPER if self.preset == "paper" else CirculationMode.LOOPS
        return self.circulation or preset

    def resolved(self, *, aisles: bool = False) -> SarsaParameters:
        """Return all parameters of Sarsa: the user's values, the preset's, or those of the agent over aisles."""
        preset = _AISLES if aisles else _PRESETS[self.preset]
        if self.preset == "tuned" and not aisles and not self.polishes:
            preset = preset._replace(starts=_STARTS_ALONE)
        given = {name: getattr(self, name) for name in preset._fields}
        return preset._replace(**{name: value for name, value in given.items() if value is not None})
