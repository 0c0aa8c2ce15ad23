"""A garage in operation: cars arrive, look for a stall, park, stay and leave; their drivers walk."""
# Over 300 lines: arrivals, stays and departures of one visit, and the tracks of it, belong together.

import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent
from garage2usd.common.randomness import Step, generator
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving import DesignCar, Pose
from garage2usd.driving.tracks import AgentState, Track, Tracks
from garage2usd.garage import Stall, StallUse
from garage2usd.maps.drives import DrivePlanner
from garage2usd.native import elementary
from garage2usd.traffic.demand import drawn_demand
from garage2usd.traffic.fleet import HULLS, Car, drawn_car, lies_within, standing_cars
from garage2usd.traffic.ground import Ground
from garage2usd.traffic.people import Walkers
from garage2usd.traffic.simulation import STEP_S, Driver, Simulation
from garage2usd.traffic.trips import Stretch, Trip

_SPEEDS = DriveConfig(lane_speed_m_s=4.2, parking_speed_m_s=1.0, acceleration_m_s2=1.2, lateral_acceleration_m_s2=1.8)
"""Speeds of drivers who know garages: 15 km/h on aisles."""
_RETRY_S, _PATIENCE_S, _STUCK_S = 1.0, 45.0, 180.0
_CHOICES = 24
_TRIED, _MOST = 12, 0.7
_NOISE_M = 15.0


@dataclass(eq=False)
class _Visit:
    """A car's visit: where it is, and what it waits for."""

    car: Car
    stall: Stall | None = None
    parked: Pose | None = None
    leave_s: float = math.inf
    driver: Driver | None = None
    trips: list[tuple[Driver, float, float]] = field(default_factory=list)
    asked_s: float = math.inf
    before: list[Driver] = field(default_factory=list)
    is_called: bool = False


class Operation:
    """A garage ready to be operated: proofs, paths and walks are kept from run to run.

    Parameters
    ----------
    garage
        The garage as built.
    settings
        Limits of the cars' motion.

    Raises
    ------
    ConfigError
        If no stall of the garage can be driven to and left.
    """

    def __init__(self, garage: BuiltGarage, settings: DriveConfig = _SPEEDS) -> None:
        self.garage, self._settings = garage, settings
        self._lanes = [level.lanes for level in garage.levels]
        driven = garage.lanes.driven
        self.stalls = tuple(
            stall
            for stall in garage.stalls
            if stall.takes_cars and stall.access in driven and stall.use is not StallUse.ACCESSIBLE
        )
        if not self.stalls:
            raise ConfigError("PATH", garage.source, "a garage with a stall that lanes join with the street")
        self.hull, self._planner = self._most_common()
        self.trip = lru_cache(maxsize=None)(self._trip)
        self._standing = standing_cars(garage)
        places = [level.lanes.positions_m for level in garage.levels]
        places += [np.array(stall.corners) for stall in garage.stalls]
        every = np.concatenate([each for each in places if len(each)])
        layers = 2 * len(garage.levels)
        self._boxes = np.repeat(np.array([[every.min(axis=0), every.max(axis=0)]]), layers, axis=0)
        self.walkers = Walkers(garage)

    def _most_common(self) -> tuple[DesignCar, DrivePlanner]:
        """Return the largest outline that most of some stalls take, and its planner."""
        tried = self.stalls[:: max(len(self.stalls) // _TRIED, 1)]
        for hull in HULLS:
            planner = DrivePlanner(self.garage, self._settings, car=hull, are_stalls_changing=True)
            proven = sum(planner.proof_of(stall).is_full for stall in tried)
            if proven >= _MOST * len(tried) or hull is HULLS[-1]:
                break
        return hull, planner

    def new_ground(self) -> Ground:
        """Return the ground of the garage with nobody on it."""
        return Ground(self._boxes)

    def _trip(self, stall: Stall, leg: Leg, parked: Pose | None = None) -> Trip | None:
        """Return the trip to a stall or away from it; None if none is clear of cars in all other stalls."""
        found = self._planner.leg(stall, leg, parked=parked)
        if found is None or not found.is_full:
            return None
        stretches, end_m = [], 0.0
        for length_m, level, is_ramp in found.stretches:
            end_m += length_m
            layer = len(self.garage.levels) + level if is_ramp else level
            stretches.append(Stretch(end_m, layer, None if is_ramp else level))
        return Trip(
            found.path,
            found.spans,
            stretches,
            car=self.hull,
            settings=self._settings,
            lanes=self._lanes,
            keeps_left=self._planner.keeps_left,
        )

    def run(self, settings: TrafficConfig, *, seed: int = 0, progress: Progress = silent) -> Tracks:
        """Operate the garage for some minutes.

        Parameters
        ----------
        settings
            Duration and demand.
        seed
            Seed of the run; the same seed gives the same tracks.
        progress
            Function called for each simulated minute.
        """
        return _Run(self, settings, seed, self._standing).tracks(progress)


class _Run:
    """One run of a garage in operation."""

    def __init__(self, operation: Operation, settings: TrafficConfig, seed: int, standing: list[Car]) -> None:
        self.operation, self.settings, self.seed = operation, settings, seed
        self.ground = operation.new_ground()
        self.cars = Simulation(self.ground, operation._settings)  # noqa: SLF001 - the run is the operation's own
        self.draw = generator(seed, Step.TRAFFIC_CARS)
        self.people = operation.walkers.begin(self.ground, generator(seed, Step.TRAFFIC_PEOPLE))
        self.people.wanted = self.cars.wanted
        self.log: list[str] = []
        self.counts: Counter[str] = Counter()
        stalls = {stall.name: stall for stall in operation.garage.stalls}
        self.outlines: dict[int, tuple[int, shapely.Polygon]] = {}
        self.taken: set[str] = set()
        self.visits: list[_Visit] = []
        self.of_car: dict[int, _Visit] = {}
        capacity = len(operation.stalls)
        movable = []
        for car in standing:
            assert car.stands is not None
            stall = stalls.get(car.stands.stall)
            visit = self.of_car[car.number] = _Visit(car, stall)
            if stall is not None:
                self.taken.add(stall.name)
                visit.parked = car.parked_pose
            self._stand(visit)
            if stall in operation.stalls and car.body is not None and lies_within(car.body, operation.hull):
                movable.append(visit)
        for stall in operation.garage.stalls:
            if stall.is_occupied:
                self.taken.add(stall.name)
        demand = drawn_demand(settings, len(movable), capacity, generator(seed, Step.TRAFFIC))
        for visit, leave_s in zip(movable, demand.leave_s, strict=True):
            visit.leave_s = leave_s
        self.staying = [visit for visit in movable if math.isfinite(visit.leave_s) and self._leads_out(visit)]
        self.arrivals = list(demand.arrivals)
        self.number = len(standing)
        self.street: list[tuple[_Visit, float]] = []

    def _leads_out(self, visit: _Visit) -> bool:
        """Return True if a path leads out of a stall for a car as it is parked at the start."""
        assert visit.stall is not None
        return self.operation.trip(visit.stall, Leg.OUT, visit.parked) is not None

    @property
    def now_s(self) -> float:
        return self.cars.step * STEP_S

    def _stand(self, visit: _Visit) -> None:
        """Keep the outline of a car that is parked at the start."""
        stands = visit.car.stands
        assert stands is not None
        half = stands.length_m / 2
        self.outlines[visit.car.number] = stands.level, _outline(stands.middle_m, stands.yaw_rad, half, stands.width_m)

    def tracks(self, progress: Progress) -> Tracks:
        """Run to the end and return the tracks."""
        steps = round(self.settings.minutes * 60 / STEP_S)
        for step in range(steps):
            if step % 600 == 0:
                progress("traffic", step // 600, math.ceil(steps / 600))
            if step % 5 == 0:
                self._admit()
                self._call()
                self._reconsider()
            self.people.advance(self.cars.step, self.now_s)
            self.cars.advance(self._ended)
        return Tracks(
            tuple(sorted(self._tracks(), key=lambda track: (track.time_s[0], track.agent.name))),
            STEP_S,
            steps * STEP_S,
            self.operation.garage.source,
            {
                "seed": self.seed,
                "settings": self.settings.model_dump(mode="json"),
                **{name: self.counts[name] for name in ("arrivals", "departures", "turned_away", "changed", "walks")},
            },
            tuple(self.log),
        )

    def _admit(self) -> None:
        """Let cars that have arrived drive in from the street."""
        while self.arrivals and self.arrivals[0][0] <= self.now_s:
            time, stay = self.arrivals.pop(0)
            self.number += 1
            car = drawn_car(self.number, self.operation.hull, self.draw)
            visit = self.of_car[car.number] = _Visit(car)
            if self._choose(visit):
                visit.leave_s = time + stay
                self.street.append((visit, self.now_s))
            else:
                self.counts["turned_away"] += 1
                self.log.append(f"{time:.1f} s: car_{self.number:04} is turned away, as no free stall can take it")
        for visit, since in self.street[:]:
            assert visit.stall is not None
            trip = self.operation.trip(visit.stall, Leg.IN)
            assert trip is not None
            visit.driver = self.cars.try_start(visit.car.number, trip)
            if visit.driver is not None:
                self.street.remove((visit, since))
                self.visits.append(visit)
                self.counts["arrivals"] += 1
            elif self.now_s - since > _PATIENCE_S:
                # a driver who cannot go on looks for another stall
                self.taken.discard(visit.stall.name)
                self._choose(visit)
                self.street[self.street.index((visit, since))] = visit, self.now_s

    def _choose(
        self, visit: _Visit, accepts: Callable[[Trip], bool] = lambda _: True, *, most: int = _CHOICES
    ) -> bool:
        """Choose a free stall near a stair core for an arriving car, the first whose trip is accepted."""
        free = [stall for stall in self.operation.stalls if stall.name not in self.taken]
        noise = self.draw.exponential(_NOISE_M, len(free))
        costs = [self.operation.walkers.distance_m(stall) + far for stall, far in zip(free, noise.tolist(), strict=True)]
        for index in np.argsort(costs, kind="stable").tolist()[:most]:
            trip = self.operation.trip(free[index], Leg.IN)
            if trip is None or self.operation.trip(free[index], Leg.OUT) is None or not accepts(trip):
                continue
            visit.stall = free[index]
            self.taken.add(free[index].name)
            return True
        return False

    def _reconsider(self) -> None:
        """Let drivers who cannot go on to their stall choose another one that lies on their way."""
        for driver in self.cars.drivers[:]:
            visit = self.of_car[driver.number]
            waited = self.cars.step - driver.waits_since if driver.waits_since >= 0 else 0
            if waited * STEP_S < _PATIENCE_S or visit.is_called:
                continue
            driver.waits_since = self.cars.step
            old, others = visit.stall, []

            def goes_on(trip: Trip, driver: Driver = driver, others: list[Driver] = others) -> bool:
                other = self.cars.change_trip(driver, trip)
                others += [other] if other is not None else []
                return other is not None

            if old is not None and self._choose(visit, goes_on, most=len(self.operation.stalls)):
                self.taken.discard(old.name)
                self.counts["changed"] += 1
                visit.driver = others[0]
                visit.before.append(driver)

    def _call(self) -> None:
        """Let drivers walk to their cars when their stays end, and cars leave when the drivers are there."""
        for visit in self.staying[:]:
            if visit.leave_s > self.now_s:
                continue
            if not visit.is_called:
                visit.is_called = True
                visit.asked_s = self.now_s
                if self.settings.people:
                    self.people.to_car(visit.car.number, visit.stall, self._parked_outline(visit), self.outlines)
            if self.settings.people and not self.people.has_arrived(visit.car.number):
                continue
            self._leave(visit)

    def _leave(self, visit: _Visit) -> None:
        assert visit.stall is not None
        trip = self.operation.trip(visit.stall, Leg.OUT, visit.parked)
        assert trip is not None
        driver = self.cars.try_start(visit.car.number, trip)
        if driver is None:
            return
        visit.driver = driver
        self.outlines.pop(visit.car.number, None)
        self.staying.remove(visit)
        if visit not in self.visits:
            self.visits.append(visit)
        self.counts["departures"] += 1

    def _ended(self, driver: Driver) -> None:
        """Park a car that has reached its stall, or let one drive off that has reached the street."""
        visit = self.of_car[driver.number]
        is_in = not visit.trips or visit.trips[-1][0] is not driver
        is_in = is_in and not visit.is_called
        visit.trips.append((driver, driver.samples[0][0] * STEP_S, self.now_s))
        self.cars.leave_ground(driver)
        if not is_in:
            assert visit.stall is not None
            self.taken.discard(visit.stall.name)
            return
        visit.parked = None
        self.outlines[visit.car.number] = self._parked_outline(visit)
        self.staying.append(visit)
        if self.settings.people:
            self.people.from_car(visit.car.number, visit.stall, self._parked_outline(visit), self.outlines, self.now_s)

    def _parked_outline(self, visit: _Visit) -> tuple[int, shapely.Polygon]:
        assert visit.stall is not None
        if visit.driver is None:
            return self.outlines[visit.car.number]
        body = visit.car.body
        assert body is not None
        end = visit.driver.trip.path.end
        ahead = body.length_m / 2 - (body.length_m - body.ahead_m)
        middle = end.x_m - elementary.sin(end.yaw_rad) * ahead, end.z_m - elementary.cos(end.yaw_rad) * ahead
        return visit.stall.level, _outline(middle, end.yaw_rad, body.length_m / 2, body.width_m)

    def _tracks(self) -> Iterator[Track]:
        for visit in self.visits:
            yield _track_of(visit, self.settings.minutes * 60)
        for track in self.people.tracks():
            self.counts["walks"] += 1
            yield track


def _outline(middle: tuple[float, float], yaw_rad: float, half_m: float, width_m: float) -> shapely.Polygon:
    sin, cos = elementary.sin(yaw_rad), elementary.cos(yaw_rad)
    corners = [(half_m, width_m / 2), (half_m, -width_m / 2), (-half_m, -width_m / 2), (-half_m, width_m / 2)]
    x, z = middle
    return shapely.Polygon([(x - sin * ahead - cos * left, z - cos * ahead + sin * left) for ahead, left in corners])


def _track_of(visit: _Visit, end_s: float) -> Track:
    """Return the track of a car from its trips."""
    agent = visit.car.agent
    drivers = [*visit.before, *(driver for driver, _, _ in visit.trips)]
    if visit.driver is not None and visit.driver not in drivers:
        drivers.append(visit.driver)
    parts, times, states, levels = [], [], [], []
    accelerations, speeds, stalls = [], [], []
    count = 0
    for driver in drivers:
        steps, ways, speed, state = (np.array(column) for column in zip(*driver.samples, strict=True))
        own = driver.trip.states(ways)
        signs = driver.trip.signs(ways)
        own[:, 5] = _steered(own[:, 5], speed)
        parts.append(own)
        times.append(steps * STEP_S)
        states.append(state.astype(np.int8))
        levels.append(driver.trip.levels(ways))
        speeds.append(speed * signs)
        accelerations.append(np.diff(speed, append=speed[-1]) / STEP_S)
        low, high = driver.trip.parking_m
        near = np.flatnonzero((ways >= low) & (ways <= high))
        if len(near) and visit.stall is not None:
            stalls.append((count + int(near[0]), count + int(near[-1]) + 1, visit.stall.name))
        count += len(ways)
    first_is_out = visit.car.stands is not None
    pose, time = np.concatenate(parts), np.concatenate(times)
    state, level = np.concatenate(states), np.concatenate(levels)
    speed, acceleration = np.concatenate(speeds), np.concatenate(accelerations)
    for number in range(len(visit.before), len(drivers) - 1):
        ends = sum(len(each) for each in times[: number + 1])
        state[ends - 1] = state[ends] = int(AgentState.PARKED)
    columns = [pose, time, state, level, speed, acceleration]
    if first_is_out and time[0] > 0:
        columns = [np.concatenate([each[:1], each]) for each in columns]
        columns[1][0], columns[2][0] = 0.0, int(AgentState.PARKED)
        columns[4][0] = columns[5][0] = 0.0
        stalls = [(low + 1, high + 1, name) for low, high, name in stalls]
    if drivers[-1].way_m >= drivers[-1].trip.length_m - 1e-6 and not visit.is_called and columns[1][-1] < end_s:
        columns = [np.concatenate([each, each[-1:]]) for each in columns]
        columns[1][-1], columns[2][-1] = end_s, int(AgentState.PARKED)
    pose, time, state, level, speed, acceleration = columns
    middle = agent.rear_axle_m
    yaw = _continuous(pose[:, 3])
    return Track(
        agent,
        np.round(time, 3),
        pose[:, 0] - elementary.sin(yaw) * middle,
        pose[:, 1],
        pose[:, 2] - elementary.cos(yaw) * middle,
        yaw,
        pose[:, 4],
        speed,
        acceleration,
        pose[:, 5],
        state.astype(np.int8),
        level.astype(np.int8),
        tuple(stalls),
    )


def _steered(angles: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Return the angles of the front wheels, which turn while the car stands between two moves."""
    stands = np.flatnonzero(speed == 0.0)
    if not len(stands):
        return angles
    result = angles.copy()
    for run in np.split(stands, np.flatnonzero(np.diff(stands) > 1) + 1):
        if run[0] > 0 and run[-1] < len(angles) - 1:
            result[run] = np.linspace(angles[run[0] - 1], angles[run[-1] + 1], len(run))
    return result


def _continuous(yaw: np.ndarray) -> np.ndarray:
    return np.unwrap(yaw)
