"""The simulation of cars on reserved ground, in steps of a tenth of a second.

A car drives on only over ground that it holds, and it holds ground up to a place where it may wait. What lies between
two such places, a junction, a narrow aisle or a manoeuvre, is reserved at once or not at all, so that no car stops
where it blocks others for good.
"""
# Over 300 lines: who holds ground, who waits for whom and who goes first change the same cars.

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from garage2usd.config.outputs import DriveConfig
from garage2usd.driving.tracks import AgentState
from garage2usd.traffic.ground import Cells, Ground
from garage2usd.traffic.trips import SLICE_M, Trip

STEP_S = 0.1
_BRAKING_M_S2 = 1.2
"""Deceleration with which a car stops at the end of its ground; comfortable as in AASHTO's stopping sight distance,
which takes up to 3.4 m/s2."""
_MOST_BRAKING_M_S2 = 3.4
_AHEAD_M = 2.5
"""Ground held beyond the braking distance in metres."""
_RETRY_STEPS, _LOOK_SLICES = 4, 60
"""Steps between two tries to go on, and number of slices ahead whose ground a car is said to want."""
_YIELD_STEPS = 40
"""Steps after which a car that lets others go first goes on all the same, as where one comes from each side."""
_AT_ONCE_M = 3.0
"""Two cars come to a junction at once if the second is within this distance of the place where it would reserve it."""
_ROUNDS = 40
"""Most rounds in which cars drive on by turns to find that they do not lock up."""
_CLAIM_STEPS = 20
"""Steps after which a car that waits for people claims the ground, so that they leave it and nobody else enters it."""
_NEAR_M, _AT_END_M = 0.002, 1e-6


@dataclass(eq=False)
class Driver:
    """A car under way on a trip.

    Attributes
    ----------
    number
        Number of the car, from 1.
    trip
        Its trip.
    way_m, speed_m_s
        Distance driven along the floor, and speed.
    held
        Number of slices held, from the first one on.
    freed
        Number of slices that were released again.
    barrier
        Slice at whose end it waits until this is None again.
    came_at, yields_at
        Steps at which it came to the ground that it wants next, and at which it began to let others go first.
    claimed
        Cells that it has claimed from people.
    samples
        Step, distance, speed and state at each step.
    """

    number: int
    trip: Trip
    way_m: float = 0.0
    speed_m_s: float = 0.0
    held: int = 0
    freed: int = 0
    pause_steps: int = 0
    next_stop: int = 0
    retry_at: int = 0
    waits_since: int = -1
    barrier: int | None = None
    came_at: int = -1
    yields_at: int = -1
    claimed: Cells | None = None
    samples: list[tuple[int, float, float, int]] = field(default_factory=list)

    @property
    def is_done(self) -> bool:
        """True at the end of the trip."""
        return self.way_m >= self.trip.length_m - _AT_END_M and self.next_stop >= len(self.trip.stops)


class Simulation:
    """Cars that drive on the ground of a garage.

    Parameters
    ----------
    ground
        The ground.
    settings
        Limits of the cars' motion.
    """

    def __init__(self, ground: Ground, settings: DriveConfig) -> None:
        self.ground, self._settings = ground, settings
        self.step = 0
        self.drivers: list[Driver] = []
        self._stands = np.zeros_like(ground.owner)
        self._is_own = np.zeros(len(ground.owner), dtype=bool)
        self._standing: dict[int, Cells] = {}

    def try_start(self, number: int, trip: Trip, barrier: int | None = None) -> Driver | None:
        """Let a car begin a trip if the ground up to the first place to wait is free."""
        driver = Driver(number, trip, barrier=barrier)
        if not self._extend(driver, 0.0):
            return None
        self.drivers.append(driver)
        driver.samples.append((self.step, 0.0, 0.0, int(AgentState.DRIVES)))
        return driver

    def change_trip(self, driver: Driver, trip: Trip) -> Driver | None:
        """Let a waiting car go on along another trip that passes its pose; None if that is not possible."""
        here = np.array([driver.way_m])
        x, _, z, yaw, _, _ = driver.trip.states(here)[0]
        way_m = trip.way_through(np.array([x, z, yaw]), int(driver.trip.levels(here)[0]))
        if way_m is None or way_m >= trip.length_m - SLICE_M:
            return None
        freed = driver.freed
        self.leave_ground(driver)
        other = Driver(driver.number, trip, way_m)
        other.held = other.freed = int(way_m / SLICE_M)
        other.next_stop = sum(stop.way_m <= way_m for stop in trip.stops)
        if not self._extend(other, way_m + _AHEAD_M):
            held, driver.held, driver.freed = driver.held, freed, freed
            self._hold(driver, held - 1)
            self._stand(driver, driver.held - 1)
            return None
        self.drivers[self.drivers.index(driver)] = other
        return other

    def advance(self, ended: Callable[[Driver], None]) -> None:
        """Advance all cars by a step; those at the ends of their trips are handed over and leave the simulation."""
        self.step += 1
        for driver in self.drivers[:]:
            self._advance(driver)
            if driver.is_done:
                self.drivers.remove(driver)
                ended(driver)

    def wanted(self, number: int) -> list[Cells]:
        """Return the cells that a car wants next: of the slices up to the second place to wait."""
        for driver in self.drivers:
            if driver.number == number and driver.held < driver.trip.slices:
                last = driver.trip.next_wait(driver.held + _LOOK_SLICES)
                return driver.trip.cells[driver.freed : last + 1]
        return []

    def _extend(self, driver: Driver, wanted_m: float) -> bool:
        """Hold the ground up to a distance, and on to a place to wait; return False if some of it is not free."""
        trip = driver.trip
        while driver.held < trip.slices and (driver.held * SLICE_M <= wanted_m or driver.held == 0):
            last = trip.groups[driver.held]
            slices = range(driver.held, last + 1)
            if driver.barrier is not None and last > driver.barrier:
                return False
            driver.came_at = self.step if driver.came_at < 0 else driver.came_at
            if trip.hint in slices and not self.ground.is_free(trip.cells[trip.hint], driver.number):
                return False
            if not self.ground.is_free(trip.cells_between(driver.held, last + 1), driver.number):
                is_free = self.ground.is_free
                trip.hint = next(each for each in slices if not is_free(trip.cells[each], driver.number))
                return False
            if self._locks_up(driver, last) or self._gives_way(driver, last):
                return False
            driver.came_at = driver.yields_at = -1
            self._hold(driver, last)
            self._stand(driver, last)
        return True

    def _gives_way(self, driver: Driver, last: int) -> bool:
        """Return True if a car that wants the same ground, and can have it, goes first by the rule of the road."""
        is_late = driver.yields_at >= 0 and self.step - driver.yields_at > _YIELD_STEPS
        if driver.held in {0, last} or is_late:
            return False
        rivals = [other for other in self.drivers if other is not driver and _wants_on(other)]
        rivals = [other for other in rivals if goes_first(other, driver)]
        own = driver.trip.cells_between(driver.held, last + 1) if rivals else ()
        for other in rivals:
            end = other.trip.groups[other.held]
            cells = other.trip.cells_between(other.held, end + 1)
            self._is_own[own] = True
            is_same = bool(self._is_own[cells].any())
            self._is_own[own] = False
            if is_same and self.ground.is_free(cells, other.number) and not self._locks_up(other, end):
                driver.yields_at = self.step if driver.yields_at < 0 else driver.yields_at
                return True
        return False

    def _hold(self, driver: Driver, last: int) -> None:
        """Hold the ground of a car up to a slice."""
        trip = driver.trip
        for number in range(driver.held, last + 1):
            cells = trip.cells if number == driver.freed else trip.entered
            self.ground.hold(cells[number], driver.number)
        driver.held = last + 1

    def _stand(self, driver: Driver, last: int | None) -> None:
        """Note the ground on which a car will stand at the end of a slice; nowhere if that is None."""
        standing = self._standing.pop(driver.number, None)
        if standing is not None:
            self._stands[standing] = 0
        if last is not None and last < driver.trip.slices - 1:
            cells = driver.trip.cells[last]
            self._stands[cells] = driver.number
            self._standing[driver.number] = cells

    def _locks_up(self, driver: Driver, last: int) -> bool:
        """Return True if cars may lock up when one goes on to the end of a slice.

        Notes
        -----
        This is deadlock avoidance by safe states (Dijkstra's banker's algorithm), with cars in place of processes and
        cells in place of resources. A state is safe if all cars can end their trips one after another, where a car
        whose way is not free yet may drive on to a place to wait. As the present state is safe, the next one is too
        if the way of the car is free of all others, or if it stands in nobody's way.
        """
        trip, number = driver.trip, driver.number
        if last >= trip.slices - 1 or not self._first_taken(driver.number, trip, last):
            return False
        undo = []

        def put(who: int, before: Cells | None, after: Cells | None) -> None:
            for cells, value in ((before, 0), (after, who)):
                if cells is not None:
                    undo.append((cells, self._stands[cells]))
                    self._stands[cells] = value

        put(number, self._standing.get(number), trip.cells[last])
        waiting = [(number, trip, last)]
        waiting += [(each.number, each.trip, each.held - 1) for each in self.drivers if each is not driver]
        found = self._play(number, [each for each in waiting if each[2] < each[1].slices - 1], put)
        for cells, values in reversed(undo):
            self._stands[cells] = values
        return not found

    def _play(
        self,
        number: int,
        waiting: list[tuple[int, Trip, int]],
        put: Callable[[int, Cells | None, Cells | None], None],
    ) -> bool:
        """Let cars that stand at the ends of slices drive on by turns; return True if one of them ends its trip."""
        for _ in range(_ROUNDS):
            left: list[tuple[int, Trip, int]] = []
            stood = [at for _, _, at in waiting]
            for who, trip, at in waiting:
                taken = self._first_taken(who, trip, at)
                if not taken:
                    if who == number:
                        return True
                    put(who, trip.cells[at], None)
                    continue
                to = trip.last_wait(at, taken)
                if to > at:
                    put(who, trip.cells[at], trip.cells[to])
                left.append((who, trip, to))
            if len(left) == len(waiting) and [at for _, _, at in left] == stood:
                return False
            waiting = left
        return False

    def _first_taken(self, number: int, trip: Trip, at: int) -> int:
        """Return the first slice after one on which another car stands; 0 if there is none."""
        cells, starts = trip.flat
        standing = self._stands[cells[starts[at + 1] :]]
        taken = (standing > 0) & (standing != number)
        first = int(taken.argmax())
        return int(np.searchsorted(starts, starts[at + 1] + first, side="right")) - 1 if taken[first] else 0

    def _advance(self, driver: Driver) -> None:
        trip, settings = driver.trip, self._settings
        if driver.pause_steps:
            driver.pause_steps -= 1
            driver.samples.append((self.step, driver.way_m, 0.0, int(AgentState.MANOEUVRES)))
            return
        speed, way = driver.speed_m_s, driver.way_m
        if driver.held < trip.slices and self.step >= driver.retry_at:
            wanted_m = way + speed * speed / (2 * _BRAKING_M_S2) + _AHEAD_M
            self._claim(driver, None)
            if not self._extend(driver, wanted_m):
                driver.retry_at = self.step + _RETRY_STEPS
                if 0 <= driver.waits_since < self.step - _CLAIM_STEPS and driver.barrier is None:
                    self._claim(driver, trip.cells_between(driver.held, trip.groups[driver.held] + 1))
        held_m = trip.length_m if driver.held == trip.slices else driver.held * SLICE_M
        stop = trip.stops[driver.next_stop]
        speed_to = min(speed + settings.acceleration_m_s2 * STEP_S, trip.limit_at(way + speed * STEP_S))
        for end_m, braking in ((held_m, _BRAKING_M_S2), (stop.way_m, settings.acceleration_m_s2)):
            left = end_m - way - speed * STEP_S / 2
            half = braking * STEP_S / 2
            speed_to = min(speed_to, -half + math.sqrt(half * half + 2 * braking * left) if left > 0 else 0.0)
        speed_to = max(speed_to, speed - _MOST_BRAKING_M_S2 * STEP_S, 0.0)
        end_m = min(held_m, stop.way_m)
        way_to = min(way + (speed + speed_to) / 2 * STEP_S, end_m)
        if end_m - way_to < _NEAR_M:
            way_to, speed_to = end_m, 0.0
        driver.way_m, driver.speed_m_s = way_to, speed_to
        if way_to >= stop.way_m - 1e-9 and speed_to == 0.0:
            driver.pause_steps = round(stop.pause_s / STEP_S)
            driver.next_stop += 1
        passed = min(int(way_to / SLICE_M), driver.held - 1)
        while driver.freed < passed:
            self.ground.release(trip.left[driver.freed])
            driver.freed += 1
        low, high = trip.parking_m
        stands = speed_to == 0.0 and way_to < stop.way_m
        state = AgentState.MANOEUVRES if low <= way_to <= high else AgentState.DRIVES
        if stands:
            state = AgentState.WAITS
            driver.waits_since = driver.waits_since if driver.waits_since >= 0 else self.step
        else:
            driver.waits_since = -1
        driver.samples.append((self.step, way_to, speed_to, int(state)))

    def _claim(self, driver: Driver, cells: Cells | None) -> None:
        """Claim ground from people in place of what a car has claimed before; nothing where cars hold it too."""
        if driver.claimed is not None:
            self.ground.claims[driver.claimed] -= 1
        owner = None if cells is None else self.ground.owner[cells]
        is_open = owner is not None and bool(((owner == 0) | (owner == driver.number)).all())
        driver.claimed = np.unique(cells) if is_open and cells is not None else None
        if driver.claimed is not None:
            self.ground.claims[driver.claimed] += 1

    def leave_ground(self, driver: Driver) -> None:
        """Release all ground of a car."""
        self._claim(driver, None)
        trip = driver.trip
        for number in range(driver.freed, driver.held):
            self.ground.release((trip.cells if number == driver.held - 1 else trip.left)[number])
        driver.freed = driver.held
        self._stand(driver, None)


def _wants_on(driver: Driver) -> bool:
    """Return True for a car that reserves a junction, or the like, now or within some metres."""
    if not 0 < driver.held < driver.trip.slices or driver.barrier is not None:
        return False
    ahead_m = driver.speed_m_s**2 / (2 * _BRAKING_M_S2) + _AHEAD_M + _AT_ONCE_M
    return driver.held * SLICE_M <= driver.way_m + ahead_m and driver.trip.groups[driver.held] > driver.held


def goes_first(other: Driver, driver: Driver) -> bool:
    """Return True if another car that comes to a junction at once with a car goes first.

    Where traffic keeps to the right, who comes from the right goes first (StVO section 8; Uniform Vehicle Code section
    11-401; China's regulation on the Road Traffic Safety Law, article 52). Where it keeps to the left nobody has
    priority (Highway Code rule 146): who came first goes first. In both, who turns across the oncoming lane lets
    oncoming cars pass (StVO section 9; Uniform Vehicle Code section 11-402; Highway Code rule 180).
    """
    begin, end = driver.trip.turn_at(driver.held)
    its_begin, its_end = other.trip.turn_at(other.held)
    across = math.remainder(its_begin - begin, math.tau)
    outwards = -1.0 if driver.trip.keeps_left else 1.0
    crosses, it_crosses = ((to - start) * outwards > math.pi / 4 for start, to in ((begin, end), (its_begin, its_end)))
    if abs(across) >= 3 * math.pi / 4:
        return crosses and not it_crosses
    if driver.trip.keeps_left:
        return abs(across) > math.pi / 4 and 0 <= other.came_at < driver.came_at
    return math.pi / 4 < across
