"""Settings of the planner."""

from enum import StrEnum
from typing import Literal, NamedTuple

from pydantic import Field

from garage2usd.common.settings import Settings
from garage2usd.config.site import SquareIndex

__all__ = [
    "Agent",
    "Aisles",
    "Choice",
    "CirculationMode",
    "DeadEnds",
    "PlanConfig",
    "SarsaParameters",
    "UnreachableStalls",
]


class DeadEnds(StrEnum):
    """What is asked of aisles that end in nothing."""

    ALLOW = "allow"
    """Nothing."""
    FORBID = "forbid"
    """There is none."""
    STANDARD = "standard"
    """One over 26 m keeps a turning stall free."""


class CirculationMode(StrEnum):
    """What is asked of the way traffic circulates."""

    LOOPS = "loops"
    """Short dead ends, at least one loop, lanes one square wide, and cross-aisles on large sites."""
    ALLOW = "allow"
    """Nothing: the score alone decides, and it rewards trees."""
    PAPER = "paper"
    """Nothing, and `DeadEnds.STANDARD` costs nothing either: the agent's own."""


class Aisles(StrEnum):
    """In which directions aisles are driven."""

    TWO_WAY = "two-way"
    ONE_WAY = "one-way"
    """In one, except where a single aisle leads to a part of the garage."""
    MIXED = "mixed"
    """A share of them in one."""


class Agent(StrEnum):
    """What the agent decides over."""

    AUTO = "auto"
    """Squares on small sites and with the preset 'paper', else aisles."""
    SQUARES = "squares"
    AISLES = "aisles"


class Choice(StrEnum):
    """Which plan of the archive becomes the garage."""

    BEST = "best"
    DRAW = "draw"
    """Any above the quality floor, by seed."""


class UnreachableStalls(StrEnum):
    """What becomes of stalls that the design car does not get into and out of without a touch."""

    REFUSE = "refuse"
    """A garage that has some is an error; proven where narrow aisles or stalls leave it in doubt."""
    KEEP = "keep"
    """They are stalls as the others; nothing is proven."""
    MARK = "mark"
    """Each stall is proven, and those without ways are hatched and kept free."""
    DROP = "drop"
    """Each stall is proven, and those without ways are left out; the floor there is bare."""

    @property
    def are_proven(self) -> bool:
        """Whether every stall is proven."""
        return self in {UnreachableStalls.MARK, UnreachableStalls.DROP}


class SarsaParameters(NamedTuple):
    """Every parameter of Sarsa with its value; see the settings of the same names in `PlanConfig`."""

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


# 'paper' is the prototype's reading of the paper, which prints no values; 'tuned' was tuned on the gates G1 to G3 of
# benchmarks/gates.py, and is measured on others too
_PAPER = SarsaParameters(
    alpha=0.1,
    gamma=0.95,
    epsilon_start=1.0,
    epsilon_min=0.01,
    epsilon_decay=0.999,
    epsilon_refresh=0.3,
    patience_episodes=100,
    turn_back_penalty=2.0,
    interval_penalty=2.0,
    min_run_squares=3,
    wheeling_penalty=0.5,
    loop_reward=0.0,
    step_penalty=0.4,
    failure_penalty=20.0,
    window_radius_squares=2,
    sees_distances=True,
    masks_actions=False,
    archives_prefixes=False,
    revisit_rate=0.0,
    max_steps_per_square=2,
    starts=1,
)
_TUNED = _PAPER._replace(
    gamma=0.9,
    epsilon_min=0.05,
    epsilon_decay=0.997,
    turn_back_penalty=0.5,
    interval_penalty=0.5,
    min_run_squares=4,
    wheeling_penalty=2.0,
    step_penalty=0.1,
    failure_penalty=10.0,
    window_radius_squares=1,
    sees_distances=False,
    masks_actions=True,
    archives_prefixes=True,
    revisit_rate=0.7,
    starts=4,
)
_PRESETS = {"paper": _PAPER, "tuned": _TUNED}
_STARTS_ALONE = 12
"""Starts of the preset 'tuned' without polish, which evens out on a small site where learning came to."""

# the agent over aisles starts with values from small sites: it explores less at first and learns in smaller steps
_AISLES = _TUNED._replace(alpha=0.03, gamma=0.9, epsilon_start=0.3, epsilon_min=0.1, revisit_rate=0.9)


class PlanConfig(Settings):
    """How lanes are planned. A parameter of Sarsa that is left out takes the preset's value."""

    preset: Literal["paper", "tuned"] = "tuned"
    """'paper': state D, 5x5 squares and the last action; bumps end an episode. 'tuned': 3x3 squares, no bumps, best
    prefix of every episode kept and gone on from."""
    agent: Agent = Agent.AUTO
    """'squares', 'aisles', or 'auto': aisles on large sites, except with the preset 'paper'."""
    episodes: int = Field(5000, ge=1, le=1_000_000)
    """Episodes of learning, of each start; the default is the paper's."""
    archive_size: int = Field(200, ge=1, le=10_000)
    """How many of the best plans are kept; the default is the paper's."""
    climb: bool | None = None
    """Polish the best plans by flips of squares after learning; left out, except with the preset 'paper'."""
    climb_top: int = Field(40, ge=1, le=10_000)
    """How many of the best plans are polished."""
    dead_ends: DeadEnds = DeadEnds.STANDARD
    """'allow', 'forbid', or 'standard': a dead-end aisle over 26 m keeps a turning stall free, which the planner
    counts as one stall lost."""

    circulation: CirculationMode | None = None
    """'loops': every dead end is gone after `dead_end_cells` rounds of pruning (R1), there is a loop (R2), no block of
    two by two lanes (R3), and no stretch without a junction longer than `longest_stretch_cells` (R4). 'allow': the
    score alone decides. 'paper': the agent's own plans, without the cost of `dead_ends` = 'standard'. Left out, 'paper'
    with the preset 'paper', else 'loops'."""
    dead_end_cells: int = Field(2, ge=0, le=1000)
    """R1: how many squares deep a dead end may be."""
    longest_stretch_cells: int | None = Field(None, ge=0, le=1_000_000)
    """R4: most squares of a stretch between two junctions or portals, 0 for any; left out, 12 on sites of 400 free
    squares or more, else any."""
    strict: bool = False
    """Whether a site on which no plan keeps the rules of circulation is an error; else the report says which rules
    gave way."""

    unreachable_stalls: UnreachableStalls = UnreachableStalls.REFUSE
    """What becomes of stalls that a car of 4.8 x 1.8 m with a turning radius of 6 m does not get into and out of
    without a touch. 'refuse': an error, where aisles under 5.5 m or stalls under 2.3 m leave it in doubt; 'keep':
    nothing; 'mark': they are hatched and kept free; 'drop': they are left out."""

    aisles: Aisles = Aisles.TWO_WAY
    """'two-way'; 'one-way': aisles are driven in one direction, except where a single aisle leads to a part of the
    garage; 'mixed': `one_way_share` of them are."""
    one_way_share: float = Field(0.5, ge=0, le=1)
    """Share of the length of aisles that are one-way with 'mixed', of those that can be."""
    one_way: tuple[tuple[SquareIndex, SquareIndex], ...] = ()
    """[from, to] of steps between adjacent lane squares, each of which makes its aisle from junction to junction
    one-way, instead of drawing them."""
    choice: Choice = Choice.BEST
    """'best', or 'draw': any plan of the archive above `quality_floor`, by seed."""
    quality_floor: float = Field(0.95, ge=0, le=1)
    """Least share of the best plan's value that a drawn plan has."""

    stall_weight: float = Field(1.0, ge=0, le=1000)
    """k_1, weight of the stalls N_S in the score."""
    parking_time_weight: float = Field(-5.0, ge=-1000, le=0)
    """k_2, weight of the mean parking time T_S in the score."""
    unused_weight: float = Field(-1.0, ge=-1000, le=0)
    """k_3, weight of the unused squares U_S in the score."""

    alpha: float | None = Field(None, gt=0, le=1)
    """Learning rate."""
    gamma: float | None = Field(None, ge=0, le=1)
    """Discount."""
    epsilon_start: float | None = Field(None, ge=0, le=1)
    """Share of random actions at first."""
    epsilon_min: float | None = Field(None, ge=0, le=1)
    """Least share of random actions."""
    epsilon_decay: float | None = Field(None, gt=0, le=1)
    """Factor on epsilon after each episode."""
    epsilon_refresh: float | None = Field(None, ge=0, le=1)
    """Epsilon after `patience_episodes` without change."""
    patience_episodes: int | None = Field(None, ge=1)
    """Episodes that end in the same plan before epsilon is refreshed."""
    turn_back_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for the opposite of the last action."""
    interval_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for a turn after fewer than `min_run_squares` equal actions."""
    min_run_squares: int | None = Field(None, ge=1, le=100)
    """Equal actions in a row after which a turn is free."""
    wheeling_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for each lane that a new lane square runs beside, other than the one it continues."""
    loop_reward: float | None = Field(None, ge=0, le=1000)
    """Reward for a new lane square that closes a loop: one that touches another lane than the one it continues."""
    step_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty for every action; staying costs it twice."""
    failure_penalty: float | None = Field(None, ge=0, le=1000)
    """Penalty R_T for the action that ends an episode in a failure."""
    window_radius_squares: int | None = Field(None, ge=1, le=4)
    """How far the agent sees: 2 is the paper's 5x5 squares."""
    sees_distances: bool | None = None
    """Whether the state holds D, the distance to the next obstacle or border in each direction."""
    masks_actions: bool | None = None
    """Whether actions that would end in a failure cannot be chosen."""
    archives_prefixes: bool | None = None
    """Whether the best state on the way is kept, not only the last unfailed one."""
    revisit_rate: float | None = Field(None, ge=0, le=1)
    """Share of the episodes that go on from part of an archived one instead of from the empty site."""
    max_steps_per_square: int | None = Field(None, ge=1, le=100)
    """Actions in an episode, for each free square of the site."""
    starts: int | None = Field(None, ge=1, le=1000)
    """How often learning starts with nothing, each time for all episodes; the best plans of all starts are kept. Left
    out, the preset's: with 'tuned' 4, and 12 where plans are not polished; with 'paper' 1."""

    @property
    def polishes(self) -> bool:
        """Whether plans are polished after learning."""
        return self.preset != "paper" if self.climb is None else self.climb

    @property
    def circulation_mode(self) -> CirculationMode:
        """What is asked of circulation: the user's choice, or the preset's."""
        preset = CirculationMode.PAPER if self.preset == "paper" else CirculationMode.LOOPS
        return self.circulation or preset

    def resolved(self, *, aisles: bool = False) -> SarsaParameters:
        """Every parameter with the user's value or the preset's, or that of the agent over aisles."""
        preset = _AISLES if aisles else _PRESETS[self.preset]
        if self.preset == "tuned" and not aisles and not self.polishes:
            preset = preset._replace(starts=_STARTS_ALONE)
        given = {name: getattr(self, name) for name in preset._fields}
        return preset._replace(**{name: value for name, value in given.items() if value is not None})
