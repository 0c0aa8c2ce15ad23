"""Visits of cars: where a car is and what it waits for, and its track in the end."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from garage2usd.driving import Pose
from garage2usd.driving.tracks import AgentState, Floats, Track
from garage2usd.garage import Stall
from garage2usd.native import elementary
from garage2usd.traffic.fleet import Car
from garage2usd.traffic.simulation import STEP_S, Driver
from garage2usd.traffic.trips import Trip


@dataclass(eq=False)
class Visit:
    """A car's visit.

    Attributes
    ----------
    car
        The car.
    stall
        The stall that it is in or drives to.
    parked
        Its pose in the stall, if it is parked there at the start.
    come_s, leave_s
        Times at which it comes to the garage and at which its stay ends.
    ready_s
        Time at which its driver is ready to drive out.
    driver
        The car on its present trip, or on its last.
    begun
        The car on all its trips, those included that it left for another stall.
    behaviour
        Special behaviour that it is labelled with.
    barrier
        Slice of its trip at whose end it waits: for another visit that leaves its stall to it, or double-parked.
    awaits
        That other visit.
    halts_s
        Time for which it stands double-parked.
    wrong_way
        Its trip to the stall, if it drives against a one-way aisle.
    is_leaving
        True after its stay.
    has_left
        True once it drives out of its stall.
    """

    car: Car
    stall: Stall | None = None
    parked: Pose | None = None
    come_s: float = 0.0
    leave_s: float = math.inf
    ready_s: float = math.inf
    driver: Driver | None = None
    begun: list[Driver] = field(default_factory=list)
    behaviour: str = ""
    barrier: int | None = None
    awaits: "Visit | None" = None
    halts_s: float = 0.0
    wrong_way: Trip | None = None
    is_leaving: bool = False
    has_left: bool = False

    def begin(self, driver: Driver) -> None:
        """Begin a trip."""
        self.driver = driver
        self.begun.append(driver)

    def waits(self, end_s: float) -> list[tuple[str, float, float]]:
        """Return the waits of the car up to the end of a run: place, begin and duration in seconds."""
        found = []
        starts = [driver.samples[0][0] * STEP_S for driver in self.begun]
        if self.stall is not None and self.car.stands is None:
            found.append(("on the street", self.come_s, (starts[0] if starts else end_s) - self.come_s))
        if math.isfinite(self.ready_s):
            found.append(("in its stall", self.ready_s, (starts[-1] if self.has_left else end_s) - self.ready_s))
        samples = [(step, state) for driver in self.begun for step, _, _, state in driver.samples]
        steps, states = np.array(samples, dtype=np.int64).reshape(-1, 2).T
        edges = np.flatnonzero(np.diff(states == AgentState.WAITS, prepend=False, append=False))
        for first, past in edges.reshape(-1, 2).tolist():
            found.append(("on an aisle", steps[first] * STEP_S, (past - first) * STEP_S))
        return found


def outline(middle: tuple[float, float], yaw_rad: float, half_m: float, width_m: float) -> shapely.Polygon:
    """Return the outline of a car: its corners front left, front right, rear right and rear left."""
    sin, cos = elementary.sin(yaw_rad), elementary.cos(yaw_rad)
    corners = [(half_m, width_m / 2), (half_m, -width_m / 2), (-half_m, -width_m / 2), (-half_m, width_m / 2)]
    x, z = middle
    return shapely.Polygon([(x - sin * ahead - cos * left, z - cos * ahead + sin * left) for ahead, left in corners])


def car_track(visit: Visit, end_s: float) -> Track:
    """Return the track of a car from its trips, up to the end of the run."""
    agent = replace(visit.car.agent, behaviour=visit.behaviour)
    parts, stalls, count = [], [], 0
    for driver in visit.begun:
        steps, ways, speed, state = (np.array(column) for column in zip(*driver.samples, strict=True))
        own = driver.trip.states(ways)
        own[:, 5] = _steered(own[:, 5], speed)
        moved = np.stack(
            [
                steps * STEP_S,
                speed * driver.trip.signs(ways),
                np.diff(speed, append=speed[-1]) / STEP_S,
                state,
                driver.trip.levels(ways),
            ],
            axis=1,
        )
        low, high = driver.trip.parking_m
        near = np.flatnonzero((ways >= low) & (ways <= high))
        if len(near) and visit.stall is not None:
            stalls.append((count + int(near[0]), count + int(near[-1]) + 1, visit.stall.name))
        is_parked = driver is not visit.begun[-1] and driver.is_done
        if is_parked or (driver.is_done and not visit.has_left):
            moved[-1, 3] = AgentState.PARKED
        parts.append(np.concatenate([own, moved], axis=1))
        count += len(ways)
    table = np.concatenate(parts)
    if visit.car.stands is not None and table[0, 6] > 0:
        table = np.concatenate([_standing(table[:1], 0.0), table])
        stalls = [(low + 1, high + 1, name) for low, high, name in stalls]
    if visit.begun[-1].is_done and not visit.has_left and table[-1, 6] < end_s:
        table = np.concatenate([table, _standing(table[-1:], end_s)])
    x, y, z, yaw, pitch, steering, time, speed, acceleration, state, level = table.T
    yaw, middle = np.unwrap(yaw), agent.rear_axle_m
    return Track(
        agent,
        np.round(time, 3),
        x - elementary.sin(yaw) * middle,
        y,
        z - elementary.cos(yaw) * middle,
        yaw,
        pitch,
        speed,
        acceleration,
        steering,
        state.astype(np.int8),
        level.astype(np.int8),
        tuple(stalls),
    )


def _standing(row: Floats, time_s: float) -> Floats:
    """Return a sample of a car that is parked at a time."""
    found = row.copy()
    found[:, 6:10] = time_s, 0.0, 0.0, AgentState.PARKED
    return found


def _steered(angles: Floats, speed: Floats) -> Floats:
    """Return the angles of the front wheels, which turn while the car stands between two moves."""
    stands = np.flatnonzero(speed == 0.0)
    if not len(stands):
        return angles
    result = angles.copy()
    for run in np.split(stands, np.flatnonzero(np.diff(stands) > 1) + 1):
        if run[0] > 0 and run[-1] < len(angles) - 1:
            result[run] = np.linspace(angles[run[0] - 1], angles[run[-1] + 1], len(run))
    return result
