"""People who walk between cars and stair cores, on ground that they hold a few steps ahead.

Nobody walks onto ground that a moving car holds, nor close to ground that another person holds, and cars wait for
ground that people hold. Parked cars and the building are kept clear of by exact outlines when a walk is chosen.
"""
# Over 300 lines: walks, ways around cars and the ground of both change together.

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import Track
from garage2usd.garage import Stall
from garage2usd.traffic.ground import Cells, Floats, Ground
from garage2usd.traffic.parties import drawn_party
from garage2usd.traffic.simulation import STEP_S
from garage2usd.traffic.walker import BESIDE_M, PUSHED_M, SLICE_M, TROLLEY_RADIUS_M, Person, Stage, Walk, Walker
from garage2usd.traffic.walking import BREADTH_M, PERSON_RADIUS_M, Walkways

_OUT_M = 0.6
_GET_OUT_S, _GET_IN_S, _LOADS_S = (6.0, 14.0), (4.0, 8.0), (12.0, 25.0)
_APART_M, _SLACK_M = 0.06, 0.03
"""Least distance between the discs of two people, and what may be missing where one begins another walk."""
_SAME_M, _TURN_COS = 0.1, 0.5
"""Distance within which two corners are one, and cosine of the most that a trolley turns at once."""
_RIGHT_M, _ABREAST_M = 0.3, 0.75
"""How far to the right of the shortest way people walk, and distance between two who walk side by side."""
_FAST_M_S, _RUN_ON_M = (2.2, 3.0), 1.0
_ROLL_M, _ROLL_M_S = (2.0, 6.0), 0.5
_RETRY_STEPS, _MOST_PATIENCE_STEPS, _TAIL_STEPS = 3, 80, 150
_MARKS_AHEAD, _DOOR_M, _BEHIND_M = 40, 1.2, 0.3
_STUCK_STEPS = round(180 / STEP_S)

Outlines = Mapping[int, tuple[int, shapely.Polygon]]


class Walkers:
    """The walks of a garage, level by level; kept from run to run."""

    def __init__(self, garage: BuiltGarage) -> None:
        self.levels = [Walkways(level) for level in garage.levels]
        self.floors_m = [level.place.floor_m for level in garage.levels]
        self._far: dict[str, float] = {}

    def begin(self, ground: Ground, settings: TrafficConfig, draw: np.random.Generator) -> "People":
        """Return the people of a run, nobody yet."""
        return People(self, ground, settings, draw)

    def distance_m(self, stall: Stall) -> float:
        """Return the length of the walk from a stall to the nearest stair core, 200 m without one."""
        if stall.name not in self._far:
            far = self.levels[stall.level].distance_m(_mouth(stall))
            self._far[stall.name] = far if math.isfinite(far) else 200.0
        return self._far[stall.name]


def _mouth(stall: Stall) -> tuple[float, float]:
    (x, z), (to_x, to_z) = stall.corners[:2]
    return (x + to_x) / 2, (z + to_z) / 2


def _outwards(stall: Stall) -> Floats:
    """Return the direction (x, z) from the middle of a stall to its mouth."""
    outwards = np.array(_mouth(stall)) - np.array(stall.centre)
    direction: Floats = outwards / (np.hypot(*outwards) or 1.0)
    return direction


class People:
    """The people of a run.

    Attributes
    ----------
    wanted
        Returns the ground that a car wants next, by its number.
    """

    def __init__(self, walkers: Walkers, ground: Ground, settings: TrafficConfig, draw: np.random.Generator) -> None:
        self._walkers, self._ground, self._settings, self._draw = walkers, ground, settings, draw
        self._walking: list[Walker] = []
        self._all: list[Walker] = []
        self._parties: dict[int, list[Person]] = {}
        self._missing: dict[int, int] = {}
        self._cars: dict[int, tuple[Stall, tuple[int, shapely.Polygon]]] = {}
        self._others: Outlines = {}
        self.wanted: Callable[[int], list[Cells]] = lambda _: []

    def to_car(self, car: int, stall: Stall | None, outline: tuple[int, shapely.Polygon], others: Outlines) -> None:
        """Let the people of a car walk from a stair core to it."""
        assert stall is not None
        self._cars[car], self._others, level = (stall, outline), others, outline[0]
        self._missing[car] = 0
        for person in self._party(car):
            corners = self._between(person, stall, outline)
            if corners is None:
                continue
            self._missing[car] += 1
            fast = self._run(person, corners, stall)
            walk = _walk(corners if fast is None else fast, is_coming=True)
            pause = round(self._draw.uniform(*_GET_IN_S) / STEP_S)
            stages = [Stage(walk, 2, pause_steps=pause)]
            if person.seat == 0 and self._draw.random() < self._settings.trolleys:
                stages = [*self._with_trolley(stall), *stages]
            self._add(person, level, stages, 0, is_coming=True)

    def from_car(
        self, car: int, stall: Stall | None, outline: tuple[int, shapely.Polygon], others: Outlines, now_s: float
    ) -> None:
        """Let the people of a car get out and walk to a stair core."""
        assert stall is not None
        self._missing.pop(car, None)
        self._cars[car], self._others, level = (stall, outline), others, outline[0]
        self._yield_to(car)
        for person in self._party(car):
            corners = self._between(person, stall, outline)
            if corners is not None:
                fast = self._run(person, corners, stall)
                walk = _walk(corners if fast is None else fast, is_coming=False)
                begin = round((now_s + self._draw.uniform(*_GET_OUT_S)) / STEP_S)
                self._add(person, level, [Stage(walk)], begin, is_coming=False)

    def has_arrived(self, car: int) -> bool:
        """Return True if all people of a car have come to it, or can only appear in it."""
        return self._missing.get(car) == 0

    def _party(self, car: int) -> list[Person]:
        if car not in self._parties:
            self._parties[car] = drawn_party(car, self._settings, self._draw)
        return self._parties[car]

    def _add(self, person: Person, level: int, stages: list[Stage], begin_step: int, *, is_coming: bool) -> None:
        name = f"person_{len(self._all) + 1:04}"
        walker = Walker(name, person, level, stages, self._ground.raster, begin_step, is_coming)
        self._all.append(walker)
        self._walking.append(walker)

    def _run(self, person: Person, corners: Floats, stall: Stall) -> tuple[Floats, float, float, float] | None:
        """Return the way of a child that runs straight across the aisle, with the stretch that is run and its speed."""
        if not person.is_child:
            return None
        ways = self._walkers.levels[stall.level]
        out = corners[1]
        across = ways.across((float(out[0]), float(out[1])), _outwards(stall))
        onward = None if across is None else ways.walk((float(across[0]), float(across[1])))
        if across is not None and onward is not None:
            corners = np.concatenate([corners[:2], onward])
        begin = float(np.hypot(*(corners[1] - corners[0])))
        run_m = float(np.hypot(*(corners[2] - corners[1]))) if across is not None else 8.0
        return corners, begin, begin + run_m + _RUN_ON_M, float(self._draw.uniform(*_FAST_M_S))

    def _with_trolley(self, stall: Stall) -> list[Stage]:
        """Return the stages of a person who brings shopping to a car in a trolley, and takes it back."""
        ways, mouth = self._walkers.levels[stall.level], np.array(_mouth(stall))
        place = mouth + _outwards(stall)
        found = ways.walk((float(place[0]), float(place[1])), is_wide=True)
        if found is None or len(found) < 3 or not self._is_clear(stall.level, found[1:], None, TROLLEY_RADIUS_M):  # noqa: PLR2004
            return []
        corners, roll_m = found[:0:-1], 0.0
        if self._draw.random() < self._settings.loose_trolleys:
            # it stops where it points along the aisle
            most_m = float(self._draw.uniform(*_ROLL_M))
            shorter = [corners[: len(corners) - cut] for cut in range(min(6, len(corners) - 2))]
            rolls = [ways.rolls_m(each, most_m) for each in shorter]
            best = int(np.argmax(rolls))
            if rolls[best] >= _ROLL_M[0] / 2:
                corners, roll_m = shorter[best], rolls[best]
                along = corners[-1] - corners[-2]
                corners = np.concatenate([corners, [corners[-1] + roll_m * along / np.hypot(*along)]])
        walk = Walk(corners)
        if walk.length_m < 4 * PUSHED_M + roll_m:
            return []
        pause = round(self._draw.uniform(*_LOADS_S) / STEP_S)
        return [
            Stage(walk, trolley=1, pause_steps=pause, roll_m=roll_m),
            Stage(Walk(corners[::-1]), trolley=-1),
        ]

    def _between(self, person: Person, stall: Stall, outline: tuple[int, shapely.Polygon]) -> Floats | None:
        """Return the walk from a door of a car to the stair core, clear of all that stands."""
        level = outline[0]
        ways = self._walkers.levels[level]
        for beside in self._doors(person, stall, outline):
            walk = ways.walk((float(beside[1][0]), float(beside[1][1])))
            if walk is None:
                continue
            right = _RIGHT_M + _ABREAST_M * (person.seat % 2)
            for by_m in (right, 0.0):
                corners: Floats = np.concatenate([beside[:1], ways.to_the_right(walk, by_m)])
                if self._is_clear(level, corners, person.car):
                    return corners
        return None

    def _doors(self, person: Person, stall: Stall, outline: tuple[int, shapely.Polygon]) -> Iterator[Floats]:
        """Yield lines from the doors of a car out of the stall, the person's own door first."""
        level, ground = outline
        corners = np.array(shapely.get_coordinates(ground))[:4]
        front, rear = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
        along = (front - rear) / np.hypot(*(front - rear))
        left = (corners[0] - corners[1]) / np.hypot(*(corners[0] - corners[1]))
        half_m = float(np.hypot(*(corners[0] - corners[1]))) / 2
        mouth, outwards = np.array(_mouth(stall)), _outwards(stall)
        own = 1.0 if person.seat % 2 == 0 else -1.0
        for side in (own, -own):
            # the shoulders are turned along the car where there is little room
            for aside_m in (PERSON_RADIUS_M + BESIDE_M, BREADTH_M / 2 + BESIDE_M):
                door = (front + rear) / 2 + (0.3 if person.seat < 2 else -0.6) * along  # noqa: PLR2004 - front seats
                door = door + side * (half_m + aside_m) * left
                out_m = max(float((mouth - door) @ outwards), 0.0) + _OUT_M
                line = np.array([door, door + out_m * outwards])
                if self._walkers.levels[level].is_clear(line, over_stalls=True):
                    yield line
        end = front if float((front - mouth) @ (front - mouth)) < float((rear - mouth) @ (rear - mouth)) else rear
        door = end + (PERSON_RADIUS_M + 2 * BESIDE_M) * outwards
        out_m = max(float((mouth - door) @ outwards) + _OUT_M, SLICE_M)
        yield np.array([door, door + out_m * outwards])

    def _is_clear(self, level: int, corners: Floats, car: int | None, radius_m: float = PERSON_RADIUS_M) -> bool:
        """Return True if a line is clear of all cars that are parked; of the own one without the distance besides."""
        numbers = [number for number, (own, _) in self._others.items() if own == level]
        if not numbers:
            return True
        shapes = np.array([self._others[number][1] for number in numbers])
        apart = shapely.distance(shapely.LineString(corners), shapes)
        least = np.where(np.array(numbers) == car, radius_m, radius_m + BESIDE_M)
        return bool((apart >= least).all())

    def _yield_to(self, car: int) -> None:
        """Let people whose way leads over the place of a car that has just parked choose another way."""
        level, ground = self._cars[car][1]
        shapely.prepare(ground)
        for walker in self._walking[:]:
            if walker.level == level and walker.person.car != car:
                line = self._rest(walker)
                if len(line) > 1 and ground.distance(shapely.LineString(line)) < PERSON_RADIUS_M + BESIDE_M:
                    if walker.is_coming:
                        self._change_side(walker)
                    elif walker.held == walker.freed:
                        self._begin_anew(walker)

    def _begin_anew(self, walker: Walker) -> None:
        """Choose another way for a person who has not got out yet; one without any does not walk."""
        corners = self._between(walker.person, *self._cars[walker.person.car])
        if corners is None:
            self._walking.remove(walker)
        else:
            walker.enter(Stage(_walk(corners, is_coming=False)))

    def _rest(self, walker: Walker) -> Floats:
        """Return the corners that are left."""
        corners = walker.walk.corners[walker.walk.lengths_m > walker.way_m]
        here = walker.walk.places(np.array([walker.way_m]))
        return np.concatenate([here, corners, *([] if walker.goal is None else [walker.goal])])

    def _change_side(self, walker: Walker) -> bool:
        """Let a person go to a door of the car that can be reached, the other one or the car's end."""
        stall, outline = self._cars[walker.person.car]
        if not walker.is_coming or walker.stage.trolley:
            return False
        for beside in self._doors(walker.person, stall, outline):
            tail = beside[::-1]
            if not self._is_clear(walker.level, tail, walker.person.car):
                continue
            if walker.held == walker.freed:
                found = self._walkers.levels[walker.level].walk((float(tail[0][0]), float(tail[0][1])))
                if found is not None:
                    walk = _walk(np.concatenate([beside[:1], found]), is_coming=True)
                    walker.enter(replace(walker.stage, walk=walk))
                    return True
            elif self._turn_to(walker, tail):
                return True
        return False

    def _turn_to(self, walker: Walker, tail: Floats) -> bool:
        """Let a person go on to a line beside a car, or to a door, around cars and people."""
        found = self._around(walker, (float(tail[0][0]), float(tail[0][1])))
        if found is None:
            return False
        corners = np.concatenate([found, tail])
        whole: list[tuple[float, float]] = []
        if len(tail) > 1:
            length_m = Walk(corners).length_m
            whole = [(length_m - float(np.hypot(*(tail[1] - tail[0]))), length_m)]
        return self._turn(walker, self._stage(walker, Walk(corners, whole), len(tail)))

    def _stage(self, walker: Walker, walk: Walk, tail: int) -> Stage:
        """Return the present stage with another walk, from where the person is."""
        begin_m = PUSHED_M if walker.stage.trolley < 0 else 0.0
        return replace(walker.stage, walk=walk, tail=tail, begin_m=begin_m, roll_m=0.0)

    def _around(
        self, walker: Walker, end: tuple[float, float] | None, cells: Iterable[Cells] = (), marks: Floats | None = None
    ) -> Floats | None:
        """Return a walk around cars and people, or out of the way of cells and marks."""
        here, trolley = walker.walk.places(np.array([walker.way_m, walker.trolley_m]))
        first, last = (trolley, here) if walker.stage.trolley < 0 else (here, trolley)
        (x, z) = (last if walker.stage.trolley else here).tolist()
        held = [
            np.insert(other.marks, 2, other.radius_m + walker.radius_m + _APART_M, axis=1)
            for other in self._walking
            if other is not walker and other.level == walker.level and other.held > other.freed
        ]
        wanted = [self._ground.raster.places(each, walker.level) for each in cells]
        found = self._walkers.levels[walker.level].around(
            (x, z),
            end,
            self._ground.of_cars(walker.level),
            np.concatenate([np.empty((0, 3)), *held]),
            wanted=(np.concatenate([np.empty((0, 2)), *wanted]), np.empty((0, 3)) if marks is None else marks),
            parked=[ground for level, ground in self._others.values() if level == walker.level],
            radius_m=walker.radius_m,
        )
        if found is None or not walker.stage.trolley:
            return found
        # a trolley does not turn about
        found = found[np.concatenate([[True], np.hypot(*np.diff(found, axis=0).T) > _SAME_M])]
        if len(found) < 2:  # noqa: PLR2004
            return None
        on, before = found[1] - found[0], last - first
        is_onward = float(on @ before) >= _TURN_COS * float(np.hypot(*on) * np.hypot(*before))
        return np.concatenate([[first], found]) if is_onward else None

    def _go_around(self, walker: Walker) -> None:
        """Change the walk of a person who is blocked, around cars and people, or out of their way."""
        tail = walker.goal if walker.goal is not None else walker.walk.corners[-walker.stage.tail :]
        tail_m = float(np.hypot(*np.diff(tail, axis=0).T).sum())
        is_near = walker.goal is None and walker.way_m >= walker.walk.length_m - tail_m - SLICE_M
        if is_near and walker.blocked_steps > _TAIL_STEPS and self._change_side(walker):
            return
        claimed = self._claimed(walker)
        if claimed and walker.goal is None and self._step_aside(walker, tail, claimed, np.empty((0, 3))):
            return
        if not is_near and self._turn_to(walker, tail):
            walker.goal = None
            return
        if walker.goal is None and not claimed:
            self._step_aside(walker, tail, *self._in_the_way(walker))
        elif walker.goal is not None and claimed:
            self._step_aside(walker, tail, claimed, np.empty((0, 3)))

    def _step_aside(self, walker: Walker, tail: Floats, wanted: list[Cells], marks: Floats) -> bool:
        """Let a person go out of the way of cells and marks, and note where it goes from there."""
        found = self._around(walker, None, wanted, marks) if wanted or len(marks) else None
        if found is None or not self._turn(walker, self._stage(walker, Walk(found), 1)):
            return False
        walker.goal = tail
        return True

    def _claimed(self, walker: Walker) -> list[Cells]:
        """Return the ground that waiting cars claim, if a person is on some of it."""
        return [np.flatnonzero(self._ground.claims)] if self._is_claimed(walker) else []

    def _in_the_way(self, walker: Walker) -> tuple[list[Cells], Floats]:
        """Return the ground that those who block a person want themselves: cells of cars, and (x, z, distance)."""
        first = min(walker.held, walker.walk.slices - 1)
        last = walker.walk.groups[first]
        cars = np.unique(self._ground.owner[np.concatenate(walker.cells[first : last + 1])])
        cells = [cells for car in cars[cars > 0].tolist() for cells in self.wanted(int(car))]
        here = walker.walk.places(np.array([walker.way_m]))
        rests = [np.empty((0, 3))]
        for other, far in self._close(walker, walker.walk.marks[2 * first : 2 * last + 3]):
            rest = other.walk.marks[2 * other.freed : 2 * other.held + _MARKS_AHEAD]
            if np.hypot(*(rest - here).T).min() < far:
                rests.append(np.insert(rest, 2, far, axis=1))
        return cells, np.concatenate(rests)

    def _turn(self, walker: Walker, stage: Stage) -> bool:
        """Let a person go on along another line if the ground for its body is free."""
        if len(stage.walk.corners) < 2 or not self._is_clear(walker.level, stage.walk.corners, walker.person.car):  # noqa: PLR2004
            return False
        is_within = self._is_claimed(walker)
        old = walker.stage, walker.samples
        kept = {name: getattr(walker, name) for name in _OF_STAGE}
        walker.enter(stage)
        front = PUSHED_M if stage.trolley > 0 else max(stage.begin_m - _BEHIND_M, 0.0)
        last = min(int(front / SLICE_M), stage.walk.slices - 1)
        last = stage.walk.groups[last]
        if not self._is_free(walker, walker.held, last, slack_m=_SLACK_M, is_within=is_within):
            walker.stages[0] = old[0]
            for name, value in kept.items():
                setattr(walker, name, value)
            return False
        for number in range(kept["freed"], kept["held"]):
            self._ground.people[kept["cells"][number]] -= 1
        walker.legs.append(old)
        walker.samples = []
        self._take(walker, last)
        return True

    def advance(self, step: int) -> None:
        """Advance all people by a step."""
        for walker in self._walking[:]:
            if step >= walker.begin_step:
                self._advance(walker, step)

    def _advance(self, walker: Walker, step: int) -> None:
        stage = walker.stage
        end_m = stage.end_m
        if walker.goal is not None and walker.way_m >= end_m - 1e-6:
            walker.note(step, is_still=True)
            walker.blocked_steps += 1
            if walker.blocked_steps >= walker.patience_steps:
                self._lose_patience(walker)
            return
        if stage.roll_m and walker.pause_steps == 0:
            end_m = walker.trolley_m - PUSHED_M
        if walker.held > walker.freed and walker.way_m >= end_m - 1e-6:
            self._pause(walker, step)
            return
        self._hold(walker, step)
        if walker.held == walker.freed:
            return
        if walker.blocked_steps >= walker.patience_steps:
            self._lose_patience(walker)
        held_m = walker.held * SLICE_M - (max(walker.stage.trolley, 0) * PUSHED_M if not walker.trolley_m_s else 0.0)
        walker.step_on(step, min(held_m, end_m if walker.stage is stage else walker.stage.end_m))
        back = walker.way_m if walker.stage.trolley >= 0 else walker.trolley_m
        while walker.freed < min(int(max(back, 0.0) / SLICE_M), walker.held - 1):
            self._ground.people[walker.cells[walker.freed]] -= 1
            walker.freed += 1

    def _lose_patience(self, walker: Walker) -> None:
        number = len(walker.legs)
        self._go_around(walker)
        if walker.stage.trolley > 0 and number == len(walker.legs) and walker.blocked_steps > _TAIL_STEPS:
            # who cannot get through takes the trolley back
            self._go_on(walker)
        if len(walker.legs) > number:
            walker.blocked_steps = 0
        else:
            walker.patience_steps = walker.blocked_steps + min(walker.patience_steps, _MOST_PATIENCE_STEPS)

    def _pause(self, walker: Walker, step: int) -> None:
        """Let a person at the end of a stage load, get into a car, or go."""
        walker.now_m_s = 0.0
        if walker.pause_steps > 0:
            walker.pause_steps -= 1
            if walker.stage.roll_m:
                self._roll(walker)
            walker.note(step, is_still=True)
            return
        if len(walker.stages) == 1:
            self._leave_ground(walker)
            self._walking.remove(walker)
            if walker.is_coming:
                self._missing[walker.person.car] -= 1
            return
        self._go_on(walker)
        walker.note(step, is_still=True)

    def _go_on(self, walker: Walker) -> None:
        """Begin the next stage as soon as its first ground is free."""
        following = walker.stages[1]
        if following.trolley < 0:
            here, trolley = walker.walk.places(np.array([walker.way_m, walker.trolley_m]))
            back = self._walkers.levels[walker.level].walk((float(here[0]), float(here[1])), is_wide=True)
            came = walker.walk.corners[walker.walk.lengths_m < walker.way_m - SLICE_M][::-1]
            back = np.concatenate([[here], came]) if back is None else back
            # a person does not walk back through the trolley
            while len(back) > 2 and float((back[1] - here) @ (here - trolley)) <= 0:  # noqa: PLR2004
                back = np.delete(back, 1, axis=0)
            following = replace(following, walk=Walk(np.concatenate([[trolley], back])), begin_m=PUSHED_M)
        old = walker.stages
        walker.stages = [old[0], *old[2:]]
        if following.trolley >= 0 and old[0].trolley:
            # the trolley is back at the core
            following = self._on_foot(walker, following)
        if self._turn(walker, following):
            walker.goal = None
        else:
            walker.stages = old

    def _on_foot(self, walker: Walker, stage: Stage) -> Stage:
        """Return a stage that begins where a person has left a trolley."""
        ((x, z),) = walker.walk.places(np.array([walker.way_m])).tolist()
        found = self._between(walker.person, *self._cars[walker.person.car])
        walk = stage.walk if found is None else _walk(found, is_coming=True)
        return replace(stage, walk=Walk(np.concatenate([[(x, z)], walk.corners[1:]]), walk.whole))

    def _roll(self, walker: Walker) -> None:
        """Let the trolley of a person who loads roll away slowly, as far as its ground is free."""
        front = min(int((walker.trolley_m + SLICE_M) / SLICE_M), walker.walk.slices - 1)
        while walker.held <= front and self._is_free(walker, walker.held, walker.held):
            self._take(walker, walker.held)
        end_m = min(walker.held * SLICE_M, walker.walk.length_m)
        walker.trolley_m_s = min(_ROLL_M_S, (end_m - walker.trolley_m) / STEP_S / 2)
        walker.trolley_m += walker.trolley_m_s * STEP_S

    def _leave_ground(self, walker: Walker) -> None:
        """Release all ground of a person."""
        for number in range(walker.freed, walker.held):
            self._ground.people[walker.cells[number]] -= 1
        walker.freed = walker.held

    def _hold(self, walker: Walker, step: int) -> None:
        """Hold the ground of the next steps as far as nobody holds it."""
        if walker.held > walker.needs_slice() or step < walker.retry_at:
            return
        while walker.held <= walker.needs_slice():
            last = walker.walk.groups[walker.held]
            if walker.held == walker.freed and walker.stage.trolley:
                last = max(last, int((walker.way_m + PUSHED_M) / SLICE_M))
            if not self._is_free(walker, walker.held, last):
                walker.retry_at = step + _RETRY_STEPS
                walker.blocked_steps += _RETRY_STEPS
                return
            walker.blocked_steps, walker.patience_steps = 0, 12
            self._take(walker, last)

    def _take(self, walker: Walker, last: int) -> None:
        for number in range(walker.held, last + 1):
            self._ground.people[walker.cells[number]] += 1
        walker.held = last + 1
        (low_x, low_z), (high_x, high_z) = walker.marks.min(axis=0).tolist(), walker.marks.max(axis=0).tolist()
        walker.box = low_x, low_z, high_x, high_z

    def _is_claimed(self, walker: Walker) -> bool:
        """Return True for a person on ground that a car waits for."""
        return any(self._ground.claims[cells].any() for cells in walker.cells[walker.freed : walker.held])

    def _is_free(
        self, walker: Walker, first: int, last: int, *, slack_m: float = 0.0, is_within: bool | None = None
    ) -> bool:
        """Return True if no car holds some slices or waits for them, and no other person is close.

        Who is on ground that a car waits for may walk on over it.
        """
        ground = self._ground
        is_within = self._is_claimed(walker) if is_within is None else is_within
        for number in range(first, last + 1):
            cells = walker.cells[number]
            if (ground.owner[cells] > 0).any() or (not is_within and ground.claims[cells].any()):
                return False
        return not any(self._close(walker, walker.walk.marks[2 * first : 2 * last + 3], slack_m=slack_m))

    def _close(self, walker: Walker, marks: Floats, *, slack_m: float = 0.0) -> Iterator[tuple[Walker, float]]:
        """Yield people who hold ground too close to some marks, and how far away it should be.

        With some slack also one who is as close to the first mark may be as close to all.
        """
        (low_x, low_z), (high_x, high_z) = marks.min(axis=0).tolist(), marks.max(axis=0).tolist()
        for other in self._walking:
            if other is walker or other.level != walker.level or other.held == other.freed:
                continue
            far = walker.radius_m + other.radius_m + _APART_M
            box = other.box
            if box[0] > high_x + far or box[2] < low_x - far or box[1] > high_z + far or box[3] < low_z - far:
                continue
            away = other.marks[:, None, :] - marks[None]
            squares = (away * away).sum(axis=2)
            least = min(far, max(math.sqrt(squares[:, 0].min()) - 1e-6, far - slack_m)) if slack_m else far
            if squares.min() < least * least:
                yield other, far

    def drivers(self) -> dict[str, int]:
        """Return the number of the car that each person walks from or to."""
        return {walker.name: walker.person.car for walker in self._all}

    def stuck(self) -> Iterator[str]:
        """Yield a line for each person who has stood in one place for more than three minutes."""
        for walker in self._all:
            if walker.longest_steps > _STUCK_STEPS:
                yield f"{walker.name} has stood in one place for {walker.longest_steps * STEP_S:.0f} s"

    def tracks(self) -> Iterator[Track]:
        """Yield the tracks of all people who have walked, and of their trolleys."""
        for walker in self._all:
            yield from walker.tracks(self._walkers.floors_m[walker.level])


def _walk(corners: Floats | tuple[Floats, float, float, float], *, is_coming: bool) -> Walk:
    """Return a walk whose ground beside a car is held at once; corners begin at the car."""
    fast = (0.0, 0.0, 0.0)
    if isinstance(corners, tuple):
        corners, *rest = corners
        fast = (rest[0], rest[1], rest[2])
    beside = float(np.hypot(*(corners[1] - corners[0])))
    if not is_coming:
        length_m = float(np.hypot(*np.diff(corners, axis=0).T).sum())
        return Walk(corners, [(0.0, beside), (max(length_m - _DOOR_M, beside + SLICE_M), length_m)], fast)
    walk = Walk(corners[::-1])
    length_m = walk.length_m
    low, high, speed = fast
    whole = [(0.0, min(_DOOR_M, length_m - beside - SLICE_M)), (length_m - beside, length_m)]
    return Walk(walk.corners, whole, (length_m - high, length_m - low, speed))


_OF_STAGE = (
    "way_m", "now_m_s", "trolley_m", "trolley_m_s", "held", "freed", "retry_at", "pause_steps", "cells", "box",
)  # fmt: skip
