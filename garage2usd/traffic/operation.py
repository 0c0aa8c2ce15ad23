"""A garage in operation: cars arrive, look for a stall, park, stay and leave; their drivers walk."""
# Over 300 lines: arrivals, stays and departures of a run change the same cars and stalls.

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property, lru_cache

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.common.randomness import Step, generator
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.tracks import Track, Tracks
from garage2usd.garage import LaneGraph, Stall, StallUse
from garage2usd.maps.drives import DrivePlanner
from garage2usd.native import elementary
from garage2usd.traffic.demand import drawn_demand
from garage2usd.traffic.fleet import HULLS, Car, drawn_car, standing_cars
from garage2usd.traffic.ground import Ground, Raster
from garage2usd.traffic.people import Walkers
from garage2usd.traffic.simulation import STEP_S, Driver, Simulation
from garage2usd.traffic.trips import Stretch, Trip
from garage2usd.traffic.visits import Visit, car_track, outline

_SPEEDS = DriveConfig(lane_speed_m_s=4.2, parking_speed_m_s=1.0, acceleration_m_s2=1.2, lateral_acceleration_m_s2=1.8)
"""Speeds of drivers who know garages: 15 km/h on aisles."""
_PATIENCE_S, _STUCK_S = 45.0, 180.0
_COUNTED = ("arrivals", "departures", "turned_away", "changed", "queued", "stuck", "walks")
_CHOICES = 24
_TRIED, _MOST = 12, 0.7
_NOISE_M, _WRONG_WAY_M = 15.0, 5.0
_SOON_S, _HALT_S = (10.0, 90.0), (40.0, 90.0)
"""Time until a car leaves for whose stall another one waits, and time for which a car stands double-parked."""
_EASES_M = (0.3, 0.6, 0.9, -0.3, -0.6, -0.9)
"""Distances ahead that a parked car drives straight before it turns, if it cannot turn at once; the nearest first."""


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

    def __init__(self, garage: BuiltGarage, settings: DriveConfig = _SPEEDS, *, progress: Progress = silent) -> None:
        self.garage, self._settings = garage, settings
        self._lanes = [level.lanes for level in garage.levels]
        driven = garage.lanes.driven
        stalls = [stall for stall in garage.stalls if stall.takes_cars and stall.access in driven]
        self.stalls = tuple(stall for stall in stalls if stall.use is not StallUse.ACCESSIBLE)
        self.accessible = tuple(stall for stall in stalls if stall.use is StallUse.ACCESSIBLE)
        if not self.stalls:
            raise ConfigError("PATH", garage.source, "a garage with a stall that lanes join with the street")
        self.hull, self._planner = self._most_common(progress)
        self.trip = lru_cache(maxsize=None)(self._trip)
        self._standing = standing_cars(garage)
        places = [level.lanes.positions_m for level in garage.levels]
        places += [np.array(stall.corners) for stall in garage.stalls]
        every = np.concatenate([each for each in places if len(each)])
        layers = 2 * len(garage.levels)
        self._raster = Raster(np.repeat(np.array([[every.min(axis=0), every.max(axis=0)]]), layers, axis=0))
        self.walkers = Walkers(garage)

    def _most_common(self, progress: Progress) -> tuple[DesignCar, DrivePlanner]:
        """Return the largest outline that most of some stalls take, and its planner."""
        tried = self.stalls[:: max(len(self.stalls) // _TRIED, 1)]
        for hull in HULLS:
            planner = DrivePlanner(self.garage, self._settings, car=hull, are_stalls_changing=True)
            proven = sum(planner.proof_of(stall).is_full for stall in counted("stalls", tried, len(tried), progress))
            if proven >= _MOST * len(tried) or hull is HULLS[-1]:
                break
        return hull, planner

    def new_ground(self) -> Ground:
        """Return the ground of the garage with nobody on it."""
        return Ground(self._raster)

    @cached_property
    def _unruly(self) -> DrivePlanner:
        """Planner of drives for which one-way aisles are open both ways."""
        levels = [
            replace(
                level, lanes=LaneGraph(level.lanes.nodes, tuple(e._replace(one_way=False) for e in level.lanes.edges))
            )
            for level in self.garage.levels
        ]
        garage = replace(self.garage, levels=tuple(levels))
        return DrivePlanner(garage, self._settings, car=self.hull, are_stalls_changing=True)

    def wrong_way(self, stall: Stall) -> Trip | None:
        """Return a trip to a stall that is driven against a one-way aisle for some metres; None if there is none."""
        if all(not edge.one_way for lanes in self._lanes for edge in lanes.edges):
            return None
        trip = self.trip(stall, Leg.IN, obeys=False)
        return trip if trip is not None and trip.against_m() >= _WRONG_WAY_M else None

    def _trip(self, stall: Stall, leg: Leg, parked: Pose | None = None, *, obeys: bool = True) -> Trip | None:
        """Return the trip to a stall or away from it; None if none is clear of cars in all other stalls."""
        found, path = (self._planner if obeys else self._unruly).leg(stall, leg, parked=parked), None
        for ahead_m in _EASES_M if parked is not None and found is None else ():
            # a shorter car stands where the outline would reach into a wall: it drives straight ahead until it does not
            assert parked is not None
            found = self._planner.leg(stall, leg, parked=parked.moved(ahead_m))
            if found is not None:
                ease = Piece(Gear.FORWARD if ahead_m > 0 else Gear.REVERSE, abs(ahead_m), is_parking=True)
                path = Path(parked, (ease, *found.path.pieces))
                break
        if found is None or not found.is_full:
            return None
        end_m = path.length_m - found.path.length_m if path is not None else 0.0
        spans = [span._replace(end_m=span.end_m + end_m) for span in found.spans]
        stretches = []
        for length_m, level, is_ramp in found.stretches:
            end_m += length_m
            layer = len(self.garage.levels) + level if is_ramp else level
            stretches.append(Stretch(end_m, layer, None if is_ramp else level))
        return Trip(
            path or found.path,
            spans,
            stretches,
            car=self.hull,
            settings=self._settings,
            raster=self._raster,
            lanes=self._lanes,
            keeps_left=self._planner.keeps_left,
            doors=[walkways.door_places for walkways in self.walkers.levels],
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
            Function called for each way that is searched before the start, and for each simulated minute.
        """
        return _Run(self, settings, seed, self._standing, progress).tracks(progress)


class _Run:
    """One run of a garage in operation."""

    def __init__(
        self, operation: Operation, settings: TrafficConfig, seed: int, standing: list[Car], progress: Progress
    ) -> None:
        self.operation, self.settings, self.seed = operation, settings, seed
        self.ground = operation.new_ground()
        self.cars = Simulation(self.ground, operation._settings)  # noqa: SLF001 - the run is the operation's own
        self.draw = generator(seed, Step.TRAFFIC_CARS)
        self.people = operation.walkers.begin(self.ground, settings, generator(seed, Step.TRAFFIC_PEOPLE))
        self.people.wanted = self.cars.wanted
        self.log: list[str] = []
        self.counts: Counter[str] = Counter()
        stalls = {stall.name: stall for stall in operation.garage.stalls}
        self.outlines: dict[int, tuple[int, shapely.Polygon]] = {}
        self.taken: set[str] = set()
        self.awaited: set[str] = set()
        self.of_car: dict[int, Visit] = {}
        capacity = len(operation.stalls)
        movable = []
        for car in standing:
            assert car.stands is not None
            stall = stalls.get(car.stands.stall)
            visit = self.of_car[car.number] = Visit(car, stall)
            if stall is not None:
                self.taken.add(stall.name)
                visit.parked = car.parked_pose
            self._stand(visit)
            if stall in operation.stalls and car.body is not None and operation.hull.holds(car.body):
                movable.append(visit)
        for stall in operation.garage.stalls:
            if stall.is_occupied:
                self.taken.add(stall.name)
        staying = sum(visit.stall in operation.stalls for visit in self.of_car.values()) - len(movable)
        demand = drawn_demand(settings, len(movable), capacity, generator(seed, Step.TRAFFIC), staying=staying)
        for visit, leave_s in zip(movable, demand.leave_s, strict=True):
            visit.leave_s = leave_s
        self.staying = self._leaving(movable, progress)
        self.arrivals = list(demand.arrivals)
        self.street: list[tuple[Visit, float]] = []

    def _leaving(self, parked: Sequence[Visit], progress: Progress) -> list[Visit]:
        """Return the parked cars that leave; those that no path leads out hand their time on to one that stays."""
        found: list[Visit] = []
        others = [visit for visit in parked if math.isinf(visit.leave_s)]
        leaving = [visit for visit in parked if math.isfinite(visit.leave_s)]
        for each in counted("ways", leaving, len(leaving), progress):
            visit, leave_s = each, each.leave_s
            while True:
                visit.leave_s = leave_s
                assert visit.stall is not None
                if self.operation.trip(visit.stall, Leg.OUT, visit.parked) is not None:
                    found.append(visit)
                    break
                visit.leave_s = math.inf
                self.log.append(f"{visit.car.agent.name} stays, as no path leads it out of its stall as it is parked")
                if not others:
                    break
                visit = others.pop(0)
        return found

    @property
    def now_s(self) -> float:
        return self.cars.step * STEP_S

    def _stand(self, visit: Visit) -> None:
        """Keep the outline of a car that is parked at the start."""
        stands = visit.car.stands
        assert stands is not None
        half = stands.length_m / 2
        self.outlines[visit.car.number] = stands.level, outline(stands.middle_m, stands.yaw_rad, half, stands.width_m)

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
                self._lift_barriers()
            self.people.advance(self.cars.step)
            self.cars.advance(self._ended)
        self._note_stuck()
        tracks = sorted(self._tracks(), key=lambda track: (track.time_s[0], track.agent.name))
        return Tracks(
            tuple(tracks),
            STEP_S,
            steps * STEP_S,
            self.operation.garage.source,
            {
                "seed": self.seed,
                "settings": self.settings.model_dump(mode="json"),
                **{name: self.counts[name] for name in _COUNTED},
                "cars_of_people": {name: f"car_{car:04}" for name, car in self.people.drivers().items()},
            },
            tuple(self.log),
        ).rounded()

    def _note_stuck(self) -> None:
        """Name the cars that have waited for more than three minutes, and people who have stood so long."""
        self.log += self.people.stuck()
        for visit in self.of_car.values():
            for where, begin_s, waited_s in visit.waits(self.now_s):
                if waited_s > _STUCK_S:
                    self.counts["queued" if where == "on the street" else "stuck"] += 1
                    self.log.append(f"{begin_s:.1f} s: {visit.car.agent.name} has to wait {where} for {waited_s:.0f} s")

    def _admit(self) -> None:
        """Let cars that have arrived drive in from the street."""
        while self.arrivals and self.arrivals[0][0] <= self.now_s:
            time, stay = self.arrivals.pop(0)
            car = drawn_car(len(self.of_car) + 1, self.operation.hull, self.draw)
            visit = self.of_car[car.number] = Visit(car, come_s=time, leave_s=time + stay)
            own = self.settings
            shares = own.permits, own.waits_for_stall, own.double_parks, own.wrong_way
            has_permit, waits, double_parks, errs = (self.draw.uniform(size=len(shares)) < shares).tolist()
            has_permit = has_permit and self._choose(visit, among=self.operation.accessible)
            if has_permit:
                visit.behaviour = "permit"
            if has_permit or (waits and self._wait_for_stall(visit)) or self._choose(visit):
                if double_parks and not visit.behaviour:
                    self._double_park(visit)
                elif errs and not visit.behaviour and visit.stall is not None:
                    visit.wrong_way = self.operation.wrong_way(visit.stall)
                    visit.behaviour = "wrong_way" if visit.wrong_way is not None else ""
                self.street.append((visit, self.now_s))
            else:
                self.counts["turned_away"] += 1
                self.log.append(f"{time:.1f} s: {car.agent.name} is turned away, as no free stall can take it")
        for visit, since in self.street[:]:
            assert visit.stall is not None
            trip = visit.wrong_way or self.operation.trip(visit.stall, Leg.IN)
            assert trip is not None
            driver = self.cars.try_start(visit.car.number, trip, visit.barrier)
            if driver is not None:
                visit.begin(driver)
                self.street.remove((visit, since))
                self.counts["arrivals"] += 1
            elif self.now_s - since > _PATIENCE_S:
                # a driver who cannot go on looks for another stall
                old = visit.stall
                if self._choose(visit):
                    self._give_up(visit, old)
                self.street[self.street.index((visit, since))] = visit, self.now_s

    def _choose(
        self,
        visit: Visit,
        accepts: Callable[[Trip], bool] = lambda _: True,
        *,
        most: int = _CHOICES,
        among: Sequence[Stall] | None = None,
    ) -> bool:
        """Choose a free stall near a stair core for an arriving car, the first whose trip is accepted."""
        stalls = self.operation.stalls if among is None else among
        free = [stall for stall in stalls if stall.name not in self.taken]
        noise = self.draw.exponential(_NOISE_M, len(free))
        costs = [
            self.operation.walkers.distance_m(stall) + far for stall, far in zip(free, noise.tolist(), strict=True)
        ]
        for index in np.argsort(costs, kind="stable").tolist()[:most]:
            trip = self.operation.trip(free[index], Leg.IN)
            leaves = visit.leave_s < 60 * self.settings.minutes
            if trip is None or (leaves and self.operation.trip(free[index], Leg.OUT) is None) or not accepts(trip):
                continue
            visit.stall = free[index]
            self.taken.add(free[index].name)
            return True
        return False

    def _wait_for_stall(self, visit: Visit) -> bool:
        """Let an arriving car wait for a stall whose car leaves soon; return False if there is none."""
        for other in self.staying:
            stall, soon_s = other.stall, other.leave_s - self.now_s
            if stall not in self.operation.stalls or not _SOON_S[0] < soon_s < _SOON_S[1] or stall.name in self.awaited:
                continue
            into, out = self.operation.trip(stall, Leg.IN), self.operation.trip(stall, Leg.OUT, other.parked)
            barrier = into.wait_beside(out) if into is not None and out is not None else None
            if barrier is not None:
                visit.stall, visit.awaits, visit.barrier = stall, other, barrier
                visit.behaviour = "waits_for_stall"
                self.awaited.add(stall.name)
                return True
        return False

    def _double_park(self, visit: Visit) -> None:
        """Let an arriving car stop for a minute or so at some place on its way where others can drive by or wait."""
        assert visit.stall is not None
        trip = self.operation.trip(visit.stall, Leg.IN)
        places = trip.waits() if trip is not None else []
        if places:
            visit.barrier = places[int(self.draw.integers(len(places)))]
            visit.halts_s, visit.behaviour = float(self.draw.uniform(*_HALT_S)), "double_parks"

    def _lift_barriers(self) -> None:
        """Let cars go on that have stood long enough, or whose stall is being left."""
        for driver in self.cars.drivers:
            visit = self.of_car[driver.number]
            if driver.barrier is None:
                continue
            if visit.awaits is not None:
                driver.barrier = None if visit.awaits.has_left else driver.barrier
            elif driver.waits_since >= 0 and driver.held == driver.barrier + 1:
                driver.barrier = (
                    None if (self.cars.step - driver.waits_since) * STEP_S >= visit.halts_s else driver.barrier
                )

    def _give_up(self, visit: Visit, stall: Stall) -> None:
        """Free a stall for others whose visitor has chosen another one."""
        if visit.awaits is None or stall.name not in self.awaited:
            self.taken.discard(stall.name)
        self.awaited.discard(stall.name)
        visit.awaits = visit.barrier = visit.wrong_way = None
        if not visit.begun:
            visit.behaviour = ""

    def _reconsider(self) -> None:
        """Let drivers who cannot go on to their stall choose another one that lies on their way."""
        for driver in self.cars.drivers[:]:
            visit = self.of_car[driver.number]
            waited = self.cars.step - driver.waits_since if driver.waits_since >= 0 else 0
            patience_s = _PATIENCE_S if driver.barrier is None else _STUCK_S
            if waited * STEP_S < patience_s or visit.is_leaving:
                continue
            driver.waits_since = self.cars.step
            old = visit.stall
            others: list[Driver] = []

            def goes_on(trip: Trip, driver: Driver = driver, others: list[Driver] = others) -> bool:
                other = self.cars.change_trip(driver, trip)
                others += [other] if other is not None else []
                return other is not None

            if old is not None and self._choose(visit, goes_on, most=len(self.operation.stalls)):
                self._give_up(visit, old)
                self.counts["changed"] += 1
                visit.begin(others[0])

    def _call(self) -> None:
        """Let drivers walk to their cars when their stays end, and cars leave when the drivers are there."""
        for visit in self.staying[:]:
            if visit.leave_s > self.now_s:
                continue
            if not visit.is_leaving:
                visit.is_leaving = True
                if self.settings.people:
                    self.people.to_car(visit.car.number, visit.stall, self._parked_outline(visit), self.outlines)
            if self.settings.people and not self.people.has_arrived(visit.car.number):
                continue
            visit.ready_s = min(visit.ready_s, self.now_s)
            self._leave(visit)

    def _leave(self, visit: Visit) -> None:
        assert visit.stall is not None
        trip = self.operation.trip(visit.stall, Leg.OUT, visit.parked)
        assert trip is not None
        driver = self.cars.try_start(visit.car.number, trip)
        if driver is None:
            return
        visit.begin(driver)
        self.outlines.pop(visit.car.number, None)
        self.staying.remove(visit)
        visit.has_left = True
        self.counts["departures"] += 1

    def _ended(self, driver: Driver) -> None:
        """Park a car that has reached its stall, or let one drive off that has reached the street."""
        visit = self.of_car[driver.number]
        self.cars.leave_ground(driver)
        if visit.has_left:
            assert visit.stall is not None
            if visit.stall.name not in self.awaited:
                self.taken.discard(visit.stall.name)
            self.awaited.discard(visit.stall.name)
            return
        visit.parked = None
        self.outlines[visit.car.number] = self._parked_outline(visit)
        self.staying.append(visit)
        if self.settings.people:
            self.people.from_car(visit.car.number, visit.stall, self._parked_outline(visit), self.outlines, self.now_s)

    def _parked_outline(self, visit: Visit) -> tuple[int, shapely.Polygon]:
        assert visit.stall is not None
        if visit.driver is None:
            return self.outlines[visit.car.number]
        body = visit.car.body
        assert body is not None
        end = visit.driver.trip.path.end
        ahead_m = body.rear_axle_m
        middle = end.x_m - elementary.sin(end.yaw_rad) * ahead_m, end.z_m - elementary.cos(end.yaw_rad) * ahead_m
        return visit.stall.level, outline(middle, end.yaw_rad, body.length_m / 2, body.width_m)

    def _tracks(self) -> Iterator[Track]:
        for visit in self.of_car.values():
            if visit.begun:
                yield car_track(visit, self.settings.minutes * 60)
        for track in self.people.tracks():
            self.counts["walks"] += 1
            yield track
