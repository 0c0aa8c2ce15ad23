"""People who walk between cars and stair cores, on ground that they reserve a step ahead."""
# Over 300 lines: walks, ways around cars and the ground of both change together.

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.driving.tracks import Agent, AgentClass, AgentState, Track
from garage2usd.garage import Stall
from garage2usd.native import elementary
from garage2usd.traffic.ground import Cells, Floats, Ground
from garage2usd.traffic.simulation import STEP_S
from garage2usd.traffic.walking import BREADTH_M, DEPTH_M, PERSON_RADIUS_M, Walkways

_SLICE_M = 0.4
_SPEED_M_S, _SPREAD_M_S = 1.34, 0.2
"""Mean and standard deviation of walking speeds (Weidmann, Transporttechnik der Fussgänger, 1993: 1.34 m/s)."""
_ACCELERATION_M_S2 = 2.5
"""Acceleration with which a person starts and stops within a step or two (Breniere and Do, J. Biomech. 1986)."""
_TURN_M, _LOOK_M = 0.5, 0.8
_BESIDE_M = 0.05
_OUT_M = 0.6
_GET_OUT_S = (6.0, 20.0)
_GET_IN_S = (5.0, 12.0)
_TALL_M = 1.72
_AT_END_M, _STILL_M = 0.01, 1e-9
_RETRY_STEPS, _PATIENCE_STEPS = 3, 18

Outlines = Mapping[int, tuple[int, shapely.Polygon]]


@dataclass(frozen=True, eq=False)
class Walk:
    """A walk along a line.

    Attributes
    ----------
    corners
        Corners (x, z); shape (n, 2).
    """

    corners: Floats

    @cached_property
    def lengths_m(self) -> Floats:
        """Distance along the walk at each corner."""
        return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(self.corners, axis=0).T))])

    @cached_property
    def length_m(self) -> float:
        """Length of the walk."""
        return float(self.lengths_m[-1])

    def places(self, ways: Floats) -> Floats:
        """Return (x, z) at distances along the walk; shape (n, 2)."""
        return np.stack([np.interp(ways, self.lengths_m, self.corners[:, axis]) for axis in (0, 1)], axis=1)


@dataclass(eq=False)
class Walker:
    """A person on a walk.

    Attributes
    ----------
    name
        Name of the person.
    car
        Number of the car that the walk begins or ends at.
    level
        Number of the level.
    walk
        The walk.
    begin_step
        Step at which the walk may begin.
    tail
        Number of corners at the end that stay when the walk is changed: those beside the car.
    goal
        Corners at the end of the walk of a person who has stepped aside for a car.
    legs
        Walks and samples before such changes.
    """

    name: str
    car: int
    level: int
    walk: Walk
    speed_m_s: float
    height_m: float
    begin_step: int
    pause_steps: int = 0
    way_m: float = 0.0
    now_m_s: float = 0.0
    held: int = 0
    freed: int = 0
    retry_at: int = 0
    blocked_steps: int = 0
    tail: int = 0
    goal: Floats | None = None
    cells: list[Cells] = field(default_factory=list)
    samples: list[tuple[int, float, float, int]] = field(default_factory=list)
    legs: list[tuple[Walk, list[tuple[int, float, float, int]]]] = field(default_factory=list)

    @property
    def is_done(self) -> bool:
        """True at the end of the walk."""
        return self.way_m >= self.walk.length_m - 1e-6


class Walkers:
    """The walks of a garage, level by level; kept from run to run."""

    def __init__(self, garage: BuiltGarage) -> None:
        self._levels = [Walkways(level) for level in garage.levels]
        self._floors_m = [level.place.floor_m for level in garage.levels]
        self._far: dict[str, float] = {}

    def begin(self, ground: Ground, draw: np.random.Generator) -> "People":
        """Return the people of a run, nobody yet."""
        return People(self._levels, self._floors_m, ground, draw)

    def distance_m(self, stall: Stall) -> float:
        """Return the length of the walk from a stall to the nearest stair core, 200 m without one."""
        if stall.name not in self._far:
            far = self._levels[stall.level].distance_m(_mouth(stall))
            self._far[stall.name] = far if math.isfinite(far) else 200.0
        return self._far[stall.name]


def _mouth(stall: Stall) -> tuple[float, float]:
    (x, z), (to_x, to_z) = stall.corners[:2]
    return (x + to_x) / 2, (z + to_z) / 2


class People:
    """The people of a run.

    Attributes
    ----------
    wanted
        Returns the ground that a car wants next, by its number.
    """

    def __init__(
        self, levels: list[Walkways], floors_m: list[float], ground: Ground, draw: np.random.Generator
    ) -> None:
        self._floors_m = floors_m
        self._levels, self._ground, self._draw = levels, ground, draw
        self._walking: list[Walker] = []
        self._all: list[Walker] = []
        self._there: set[int] = set()
        self.wanted: Callable[[int], list[Cells]] = lambda _: []
        self._coming: set[int] = set()

    def to_car(self, car: int, stall: Stall | None, outline: tuple[int, shapely.Polygon], others: Outlines) -> None:
        """Let a driver walk from a stair core to a car."""
        assert stall is not None
        corners = self._between(car, stall, outline, others)
        if corners is None:
            self._there.add(car)
            return
        self._coming.add(car)
        self._add(car, stall.level, corners[::-1], 0.0, self._draw.uniform(*_GET_IN_S), tail=2)

    def from_car(
        self, car: int, stall: Stall | None, outline: tuple[int, shapely.Polygon], others: Outlines, now_s: float
    ) -> None:
        """Let a driver get out of a car and walk to a stair core."""
        assert stall is not None
        self._there.discard(car)
        corners = self._between(car, stall, outline, others)
        if corners is not None:
            self._add(car, stall.level, corners, now_s + self._draw.uniform(*_GET_OUT_S), 0.0)

    def has_arrived(self, car: int) -> bool:
        """Return True if the driver of a car has come to it, or can only appear in it."""
        return car in self._there

    def _add(self, car: int, level: int, corners: Floats, begin_s: float, pause_s: float, *, tail: int = 1) -> None:
        speed = float(np.clip(self._draw.normal(_SPEED_M_S, _SPREAD_M_S), 0.8, 1.8))
        height = float(np.clip(self._draw.normal(_TALL_M, 0.08), 1.5, 1.95))
        name = f"person_{len(self._all) + 1:04}"
        walk = Walk(corners)
        walker = Walker(
            name, car, level, walk, speed, height, round(begin_s / STEP_S), round(pause_s / STEP_S), tail=tail
        )
        walker.cells = self._cells(walk, level)
        self._all.append(walker)
        self._walking.append(walker)

    def _cells(self, walk: Walk, level: int) -> list[Cells]:
        """Return the cells of each slice of a walk."""
        count = max(math.ceil(walk.length_m / _SLICE_M), 1)
        ways = np.linspace(0.0, count * _SLICE_M, 2 * count + 1)
        discs = self._ground.raster.discs(walk.places(ways), PERSON_RADIUS_M + _BESIDE_M, level)
        return [np.unique(np.concatenate(discs[2 * number : 2 * number + 3])) for number in range(count)]

    def _go_around(self, walker: Walker) -> None:
        """Change the walk of a person who is blocked, around the ground that cars hold, or out of their way."""
        ((x, z),) = walker.walk.places(np.array([walker.way_m])).tolist()
        tail = walker.goal if walker.goal is not None else walker.walk.corners[-walker.tail :]
        tail_m = float(np.hypot(*np.diff(tail, axis=0).T).sum())
        if walker.goal is None and walker.way_m >= walker.walk.length_m - tail_m - _SLICE_M:
            return
        ways, end = self._levels[walker.level], (float(tail[0][0]), float(tail[0][1]))
        found = ways.around((x, z), end, self._ground, walker.level)
        if found is not None and self._turn(walker, np.concatenate([found, tail])):
            walker.goal = None
            return
        if walker.goal is None:
            blocking = walker.cells[walker.held]
            cars = {int(number) for number in np.unique(self._ground.owner[blocking]) if number > 0}
            wanted = [cells for car in sorted(cars) for cells in self.wanted(car)]
            found = ways.around((x, z), None, self._ground, walker.level, wanted=wanted)
            if found is not None and self._turn(walker, found):
                walker.goal = tail

    def _turn(self, walker: Walker, corners: Floats) -> bool:
        """Let a person go on along other corners if the first step is free."""
        walk = Walk(corners)
        cells = self._cells(walk, walker.level)
        if (self._ground.owner[cells[0]] > 0).any():
            return False
        self._leave_ground(walker)
        self._ground.people[cells[0]] += 1
        walker.legs.append((walker.walk, walker.samples))
        walker.walk, walker.cells, walker.samples = walk, cells, []
        walker.way_m, walker.now_m_s, walker.held, walker.freed, walker.retry_at = 0.0, 0.0, 1, 0, 0
        return True

    def _between(self, car: int, stall: Stall, outline: tuple[int, shapely.Polygon], others: Outlines) -> Floats | None:
        """Return the walk from the door of a car to the stair core."""
        level, ground = outline
        corners = np.array(shapely.get_coordinates(ground))[:4]
        front, rear = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
        along = (front - rear) / np.hypot(*(front - rear))
        left = (corners[0] - corners[1]) / np.hypot(*(corners[0] - corners[1]))
        half_m = float(np.hypot(*(corners[0] - corners[1]))) / 2
        middle = (front + rear) / 2
        mouth = np.array(_mouth(stall))
        outwards = mouth - np.array(stall.centre)
        outwards = outwards / (np.hypot(*outwards) or 1.0)
        near = [shape for number, (own, shape) in others.items() if own == level and number != car]
        near = [shape for shape in near if shape.distance(ground) < 2.0]  # noqa: PLR2004
        for side in (1.0, -1.0):
            aside = side * (half_m + _BESIDE_M + BREADTH_M / 2) * left
            door = middle + 0.3 * along + aside
            out_m = max(float((mouth - door) @ outwards), 0.0) + _OUT_M
            out = door + out_m * outwards
            line = shapely.LineString([door, out])
            if all(shape.distance(line) >= BREADTH_M / 2 + _BESIDE_M for shape in near) and self._is_clear(level, line):
                break
        else:
            end = front if float((front - mouth) @ (front - mouth)) < float((rear - mouth) @ (rear - mouth)) else rear
            door = out = end + (PERSON_RADIUS_M + 0.3) * outwards
        walk = self._levels[level].walk((float(out[0]), float(out[1])))
        if walk is None:
            return None
        return np.array([door, *walk]) if door is not out else walk

    def _is_clear(self, level: int, line: shapely.LineString) -> bool:
        """Return True if nothing of the building is in the way of a person on a line."""
        return not self._levels[level].standing.intersects(line.buffer(PERSON_RADIUS_M + _BESIDE_M))

    def advance(self, step: int) -> None:
        """Advance all people by a step."""
        for walker in self._walking[:]:
            if step < walker.begin_step:
                continue
            self._advance(walker, step)

    def _advance(self, walker: Walker, step: int) -> None:
        if walker.is_done:
            self._stand(walker, step)
            return
        self._hold(walker, step)
        if walker.held == 0:
            return
        if walker.blocked_steps >= _PATIENCE_STEPS:
            walker.blocked_steps = 0
            self._go_around(walker)
        held_m = walker.walk.length_m if walker.held == len(walker.cells) else walker.held * _SLICE_M
        before, left = walker.now_m_s, held_m - walker.way_m
        most = math.sqrt(2 * _ACCELERATION_M_S2 * max(left - before * STEP_S / 2, 0.0))
        speed = min(before + _ACCELERATION_M_S2 * STEP_S, walker.speed_m_s, most)
        way = min(walker.way_m + (before + speed) / 2 * STEP_S, held_m)
        if held_m - way < _AT_END_M:
            way, speed = held_m, 0.0
        stands = way - walker.way_m < _STILL_M
        walker.way_m, walker.now_m_s = way, speed
        while walker.freed < min(int(way / _SLICE_M), walker.held - 1):
            self._ground.people[walker.cells[walker.freed]] -= 1
            walker.freed += 1
        walker.samples.append((step, way, speed, int(AgentState.STANDS if stands else AgentState.WALKS)))

    def _stand(self, walker: Walker, step: int) -> None:
        """Let a person at the end of a walk wait for a car to pass, get into a car, or go."""
        if walker.goal is not None or walker.pause_steps:
            walker.samples.append((step, walker.way_m, 0.0, int(AgentState.STANDS)))
            if walker.goal is None:
                walker.pause_steps -= 1
            elif step % _PATIENCE_STEPS == 0:
                self._go_around(walker)
            return
        self._leave_ground(walker)
        self._walking.remove(walker)
        if walker.car in self._coming:
            self._there.add(walker.car)
            self._coming.discard(walker.car)

    def _leave_ground(self, walker: Walker) -> None:
        """Release all ground of a person."""
        for number in range(walker.freed, walker.held):
            self._ground.people[walker.cells[number]] -= 1
        walker.freed = walker.held

    def _hold(self, walker: Walker, step: int) -> None:
        """Hold the ground of the next steps as far as no car holds it."""
        need = min(int((walker.way_m + _LOOK_M) / _SLICE_M), len(walker.cells) - 1)
        while walker.held <= need and step >= walker.retry_at:
            cells = walker.cells[walker.held]
            if (self._ground.owner[cells] > 0).any():
                walker.retry_at = step + _RETRY_STEPS
                walker.blocked_steps += _RETRY_STEPS
                return
            walker.blocked_steps = 0
            self._ground.people[cells] += 1
            walker.held += 1

    def drivers(self) -> dict[str, int]:
        """Return the number of the car that each person walks from or to."""
        return {walker.name: walker.car for walker in self._all}

    def tracks(self) -> Iterator[Track]:
        """Yield the tracks of all people who have walked."""
        for walker in self._all:
            if len(walker.samples) + sum(len(samples) for _, samples in walker.legs) > 1:
                yield _track(walker, self._floors_m[walker.level])


def _track(walker: Walker, floor_m: float) -> Track:
    columns, headings = [], []
    for walk, samples in [*walker.legs, (walker.walk, walker.samples)]:
        if not samples:
            continue
        steps, ways, speed, state = (np.array(column) for column in zip(*samples, strict=True))
        places = walk.places(ways)
        ahead = walk.places(np.minimum(ways + _TURN_M, walk.length_m)) - walk.places(np.maximum(ways - _TURN_M, 0.0))
        columns.append(np.stack([steps * STEP_S, *places.T, speed, state], axis=1))
        headings.append(elementary.arctan2(-ahead[:, 0], -ahead[:, 1]))
    time, x, z, speed, state = np.concatenate(columns).T
    yaw = np.unwrap(np.concatenate(headings))
    zero = np.zeros(len(time))
    agent = Agent(walker.name, AgentClass.PERSON, DEPTH_M, BREADTH_M, round(walker.height_m, 2))
    return Track(
        agent,
        np.round(time, 3),
        x,
        zero + floor_m,
        z,
        yaw,
        zero,
        speed,
        np.diff(speed, append=speed[-1]) / STEP_S,
        zero,
        state.astype(np.int8),
        np.full(len(time), walker.level, dtype=np.int8),
    )
