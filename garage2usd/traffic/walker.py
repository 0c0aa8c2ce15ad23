"""A person on a walk: its line, the ground that it holds a few steps ahead, and its track in the end."""
# Over 300 lines: the ground and the motion of a walker, alone and with a trolley, change together.

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.ndimage import uniform_filter1d

from garage2usd.driving.tracks import Agent, AgentClass, AgentState, Track
from garage2usd.native import elementary
from garage2usd.objects.trolley import TrolleySpec
from garage2usd.traffic.ground import Cells, Floats, Raster
from garage2usd.traffic.simulation import STEP_S
from garage2usd.traffic.walking import BREADTH_M, DEPTH_M

SLICE_M = 0.4
"""Length of the slices of a walk whose ground is held at once."""
BESIDE_M = 0.05
"""Least distance from cars and from the building."""
ACCELERATION_M_S2 = 2.5
"""Acceleration with which a person starts and stops within a step or two (Breniere and Do, J. Biomech. 1986)."""
PUSHED_M = 0.95
"""Distance from a person to the middle of the trolley that it pushes or pulls."""
TROLLEY_RADIUS_M = 0.5
_TURN_M, _TURN_STEPS = 0.5, 9
_TROLLEY_HEIGHT_M = 1.02
_AT_END_M, _STILL_M = 0.005, 1e-9

Sample = tuple[int, float, float, int, float]


@dataclass(frozen=True, eq=False)
class Walk:
    """A walk along a line.

    Attributes
    ----------
    corners
        Corners (x, z); shape (n, 2).
    whole
        Stretches whose ground is held at once, as they are too narrow for two: (begin, end) in metres.
    fast
        Stretch that is run, and its speed: (begin, end, speed).
    """

    corners: Floats
    whole: Sequence[tuple[float, float]] = ()
    fast: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @cached_property
    def lengths_m(self) -> Floats:
        """Distance along the walk at each corner."""
        return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(self.corners, axis=0).T))])

    @cached_property
    def length_m(self) -> float:
        """Length of the walk."""
        return float(self.lengths_m[-1])

    @cached_property
    def slices(self) -> int:
        """Number of slices."""
        return max(math.ceil(self.length_m / SLICE_M), 1)

    @cached_property
    def marks(self) -> Floats:
        """Places at the ends and middles of the slices; shape (2 slices + 1, 2)."""
        return self.places(np.linspace(0.0, self.slices * SLICE_M, 2 * self.slices + 1))

    @cached_property
    def groups(self) -> list[int]:
        """For each slice the last one that is held at once with it."""
        found = list(range(self.slices))
        for begin, end in self.whole:
            low, high = max(int(begin / SLICE_M), 0), min(math.ceil(end / SLICE_M), self.slices) - 1
            found[low : high + 1] = [high] * max(high + 1 - low, 0)
        return found

    def places(self, ways: Floats) -> Floats:
        """Return (x, z) at distances along the walk; shape (n, 2)."""
        return np.stack([np.interp(ways, self.lengths_m, self.corners[:, axis]) for axis in (0, 1)], axis=1)

    def cells(self, raster: Raster, radius_m: float, level: int) -> list[Cells]:
        """Return the cells of each slice for a disc."""
        discs = raster.discs(self.marks, radius_m, level)
        return [np.concatenate(discs[2 * number : 2 * number + 3]) for number in range(self.slices)]


@dataclass(frozen=True)
class Person:
    """A person.

    Attributes
    ----------
    car
        Number of the car.
    seat
        Number of the seat, 0 for the driver.
    speed_m_s
        Walking speed; of those who walk together the same.
    height_m
        Stature.
    is_child
        True for a child, who runs across the aisle.
    """

    car: int
    seat: int
    speed_m_s: float
    height_m: float
    is_child: bool = False

    @property
    def size_m(self) -> tuple[float, float]:
        """Breadth and depth as seen from above."""
        return (0.30, 0.21) if self.is_child else (BREADTH_M, DEPTH_M)


@dataclass(frozen=True, eq=False)
class Stage:
    """A part of what a walker does.

    Attributes
    ----------
    walk
        The line.
    tail
        Number of corners at the end that stay when the walk is changed.
    begin_m
        Distance along the line at which the person begins.
    pause_steps
        Steps that the person stands at the end.
    trolley
        1 with a trolley that is pushed ahead, -1 with one that is pulled, 0 without.
    roll_m
        Distance that the trolley rolls away at the end.
    """

    walk: Walk
    tail: int = 1
    begin_m: float = 0.0
    pause_steps: int = 0
    trolley: int = 0
    roll_m: float = 0.0

    @property
    def end_m(self) -> float:
        """Distance along the line at which the person stops."""
        return self.walk.length_m - max(self.trolley, 0) * PUSHED_M - self.roll_m


@dataclass(eq=False)
class Walker:
    """A person on a walk.

    Attributes
    ----------
    name
        Name of the track.
    person
        The person.
    level
        Number of the level.
    stages
        What is left to do, the present part first.
    begin_step
        Step at which the walk may begin.
    is_coming
        True for a person on the way to the car.
    goal
        Corners at the end of the walk of a person who has stepped aside for a car.
    legs
        Parts that are over, with their samples.
    """

    name: str
    person: Person
    level: int
    stages: list[Stage]
    raster: Raster
    begin_step: int
    is_coming: bool
    way_m: float = 0.0
    now_m_s: float = 0.0
    trolley_m: float = 0.0
    trolley_m_s: float = 0.0
    held: int = 0
    freed: int = 0
    retry_at: int = 0
    blocked_steps: int = 0
    patience_steps: int = 12
    pause_steps: int = 0
    still_since: int = -1
    longest_steps: int = 0
    goal: Floats | None = None
    cells: list[Cells] = field(default_factory=list)
    box: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    samples: list[Sample] = field(default_factory=list)
    legs: list[tuple[Stage, list[Sample]]] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Enter the first stage."""
        self.enter(self.stages[0])

    @property
    def stage(self) -> Stage:
        """The present part."""
        return self.stages[0]

    @property
    def walk(self) -> Walk:
        """The present line."""
        return self.stages[0].walk

    @property
    def radius_m(self) -> float:
        """Radius of a disc that holds the person, and the width of a trolley."""
        return TROLLEY_RADIUS_M if self.stage.trolley else math.hypot(*self.person.size_m) / 2

    @property
    def marks(self) -> Floats:
        """Places of the ground that is held; shape (n, 2)."""
        return self.walk.marks[2 * self.freed : 2 * self.held + 1]

    def enter(self, stage: Stage) -> None:
        """Begin a stage, on ground that is not held yet."""
        self.stages[0] = stage
        self.cells = stage.walk.cells(self.raster, self.radius_m + BESIDE_M, self.level)
        self.way_m, self.now_m_s, self.retry_at, self.pause_steps = stage.begin_m, 0.0, 0, stage.pause_steps
        self.trolley_m, self.trolley_m_s = stage.begin_m + stage.trolley * PUSHED_M, 0.0
        self.held = self.freed = int(max(min(self.way_m, self.trolley_m if stage.trolley else self.way_m), 0) / SLICE_M)

    def leave(self) -> None:
        """End the present stage, whose samples are kept."""
        self.legs.append((self.stage, self.samples))
        self.samples = []

    def needs_slice(self) -> int:
        """Return the last slice that the person wants to hold now."""
        front = max(self.way_m, self.trolley_m) if self.stage.trolley else self.way_m
        ahead = front + self.now_m_s * (self.now_m_s / (2 * ACCELERATION_M_S2) + STEP_S) + SLICE_M
        return min(int(ahead / SLICE_M), self.walk.slices - 1)

    def step_on(self, step: int, end_m: float) -> None:
        """Walk on for a step, up to a distance."""
        before, way, a = self.now_m_s, self.way_m, ACCELERATION_M_S2
        low, high, speed = self.walk.fast
        end_m = max(end_m, way)
        limit = speed if low <= way < high else self.person.speed_m_s
        left, half = end_m - way - before * STEP_S / 2, a * STEP_S / 2
        most = math.sqrt(half * half + 2 * a * left) - half if left > 0 else 0.0
        now = max(min(before + a * STEP_S, limit, most), before - a * STEP_S, 0.0)
        to = min(way + (before + now) / 2 * STEP_S, end_m)
        if end_m - to < _AT_END_M:
            to, now = end_m, 0.0
        is_still = to - way < _STILL_M
        self.way_m, self.now_m_s = to, now
        if self.stage.trolley and not self.trolley_m_s and self.trolley_m - to < PUSHED_M:
            self.trolley_m = to + self.stage.trolley * PUSHED_M
        self.note(step, is_still=is_still)

    def note(self, step: int, *, is_still: bool) -> None:
        """Keep a sample."""
        state = AgentState.STANDS if is_still else AgentState.WALKS
        self.samples.append((step, self.way_m, self.now_m_s, int(state), self.trolley_m))
        if not is_still:
            self.still_since = -1
        elif self.still_since < 0:
            self.still_since = step
        else:
            self.longest_steps = max(self.longest_steps, step - self.still_since)

    def tracks(self, floor_m: float) -> Iterator[Track]:
        """Yield the track of the person, and that of the trolley."""
        breadth, depth = self.person.size_m
        behaviour = "runs" if self.person.is_child else ""
        agent = Agent(self.name, AgentClass.PERSON, depth, breadth, round(self.person.height_m, 2), behaviour=behaviour)
        parts = [(stage, np.array(samples)) for stage, samples in [*self.legs, (self.stage, self.samples)] if samples]
        if sum(len(rows) for _, rows in parts) > 1:
            yield self._track(agent, parts, floor_m, _TURN_M)
        pushed = [(stage, rows) for stage, rows in parts if stage.trolley]
        if sum(len(rows) for _, rows in pushed) > 1:
            outline = np.array(TrolleySpec().outlines()[0])
            wide, long = np.ptp(outline, axis=0).tolist()
            rolls = any((rows[:, 4] > rows[:, 1] + PUSHED_M + ACCELERATION_M_S2 * STEP_S).any() for _, rows in pushed)
            name = self.name.replace("person", "trolley")
            behaviour = "rolls_away" if rolls else "pushed"
            cart = Agent(name, AgentClass.TROLLEY, long, wide, _TROLLEY_HEIGHT_M, behaviour=behaviour)
            yield self._trolley_track(cart, pushed, floor_m)

    def _track(self, agent: Agent, parts: Sequence[tuple[Stage, Floats]], floor_m: float, turn_m: float) -> Track:
        columns, headings = [], []
        for stage, rows in parts:
            steps, ways, speed, state, _ = rows.T
            columns.append(np.stack([steps, *stage.walk.places(ways).T, speed, state], axis=1))
            headings.append(_headings(stage.walk, ways, turn_m))
        step, x, z, speed, state = np.concatenate(columns).T
        # a person turns within a second; the ground held is that of a disc, so that any heading fits
        yaw = uniform_filter1d(np.unwrap(np.concatenate(headings)), _TURN_STEPS, mode="nearest")
        return _assembled(agent, self.level, floor_m, (step, x, z, yaw, speed, state))

    def _trolley_track(self, agent: Agent, parts: Sequence[tuple[Stage, Floats]], floor_m: float) -> Track:
        columns = []
        for stage, rows in parts:
            places = stage.walk.places(rows[:, 4])
            yaw = _headings(stage.walk, rows[:, 4], PUSHED_M / 2) + (np.pi if stage.trolley < 0 else 0.0)
            columns.append(np.stack([rows[:, 0], *places.T, yaw, np.gradient(rows[:, 4]) / STEP_S], axis=1))
        step, x, z, yaw, speed = np.concatenate(columns).T
        state = np.where(np.abs(speed) > _STILL_M, AgentState.DRIVES, AgentState.STANDS)
        yaw = uniform_filter1d(np.unwrap(yaw), 5, mode="nearest")
        return _assembled(agent, self.level, floor_m, (step, x, z, yaw, speed, state))


def _headings(walk: Walk, ways: Floats, turn_m: float) -> Floats:
    ahead = walk.places(np.minimum(ways + turn_m, walk.length_m)) - walk.places(np.maximum(ways - turn_m, 0.0))
    yaw: Floats = elementary.arctan2(-ahead[:, 0], -ahead[:, 1])
    return yaw


def _assembled(agent: Agent, level: int, floor_m: float, columns: tuple[Floats, ...]) -> Track:
    """Return a track of steps, x, z, yaw, speed and state on a level."""
    step, x, z, yaw, speed, state = columns
    zero = np.zeros(len(step))
    return Track(
        agent,
        np.round(step * STEP_S, 3),
        x,
        zero + floor_m,
        z,
        yaw,
        zero,
        speed,
        np.diff(speed, append=speed[-1]) / STEP_S,
        zero,
        state.astype(np.int8),
        np.full(len(step), level, dtype=np.int8),
    )
