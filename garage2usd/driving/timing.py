"""Timing of a car's path: as fast as the settings allow, with a stop where steering or gear changes abruptly."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.config.outputs import DriveConfig
from garage2usd.driving.car import DesignCar
from garage2usd.driving.path import Floats, Path, Piece
from garage2usd.driving.road import FloorSpan, floor_heights_m, tilt
from garage2usd.driving.trajectory import Trajectory
from garage2usd.native import elementary

_NODE_M, _LEAST_NODES = 0.05, 8
"""Distance in metres between the nodes of a run, with constant acceleration in between, and their least number."""
_SAME_PER_M = 1e-9
_SHORTEST_M = 1e-9


@dataclass(frozen=True, eq=False)
class _Run:
    """A stretch of path from standstill to standstill, in one gear.

    Attributes
    ----------
    path
        Path of the run.
    plan_m
        Distance at each node as seen from above; shape (nodes,).
    way_m
        Distance along the floor; shape (nodes,).
    speed_m_s
        Unsigned speed; shape (nodes,).
    time_s
        Time since the run's start; shape (nodes,).
    acceleration_m_s2
        Acceleration of each interval, negative where the car brakes; shape (nodes - 1,).
    begin_m
        Distance along the whole path at its start, as seen from above.
    """

    path: Path
    plan_m: Floats
    way_m: Floats
    speed_m_s: Floats
    time_s: Floats
    acceleration_m_s2: Floats
    begin_m: float = 0.0

    @property
    def seconds(self) -> float:
        return float(self.time_s[-1])


@dataclass(frozen=True, eq=False)
class Motion:
    """Motion of a car along its path over time; created by `timed`.

    Attributes
    ----------
    runs
        Runs between standstills.
    starts_s
        Start time of each run.
    ends_s
        End time of the motion.
    car
        The car.
    spans
        Floors along the path, part by part; empty for a level floor at height 0.
    steering_rate_rad_s
        Steering rate of the front wheels at a standstill.
    """

    runs: tuple[_Run, ...]
    starts_s: tuple[float, ...]
    ends_s: float
    car: DesignCar
    spans: tuple[FloorSpan, ...]
    steering_rate_rad_s: float

    @property
    def events_s(self) -> Floats:
        """Times at which the car starts, stops, or ends steering at a standstill; ascending, distinct."""
        stops = [start + run.seconds for start, run in zip(self.starts_s, self.runs, strict=True)]
        steered = [stop + self._steering_s(number) for number, stop in enumerate(stops[:-1])]
        events: Floats = np.unique(np.round([0.0, *self.starts_s, *stops, *steered, self.ends_s], 9))
        return events

    def sampled(self, step_s: float) -> Trajectory:
        """Sample the car's motion at a fixed step and at all events, without steps that nearly coincide with events.

        Parameters
        ----------
        step_s
            Time step, more than 0.
        """
        events = self.events_s
        steps = np.arange(0.0, self.ends_s, step_s)
        after = np.searchsorted(events, steps)
        nearest = np.minimum(
            np.abs(steps - events[np.minimum(after, len(events) - 1)]), np.abs(steps - events[np.maximum(after - 1, 0)])
        )
        return self.at(np.sort(np.concatenate([events, steps[nearest > step_s / 10]])))

    def at(self, time_s: ArrayLike) -> Trajectory:
        """Return the car's states at ascending times, shape (n,); it rests before the first run and after the last."""
        times = np.asarray(time_s, dtype=np.float64)
        number = np.clip(np.searchsorted(self.starts_s, times + 1e-9, side="right") - 1, 0, len(self.runs) - 1)
        parts = [
            self._part(index, times[number == index], driven)
            for index, driven in enumerate(np.cumsum([0.0, *(run.way_m[-1] for run in self.runs[:-1])]).tolist())
        ]
        return Trajectory(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))

    def _part(self, index: int, times: Floats, driven_m: float) -> tuple[NDArray[np.float64], ...]:
        """Return the trajectory's columns for times from the start of a run to the start of the next."""
        run = self.runs[index]
        since = np.clip(times - self.starts_s[index], 0.0, None)
        stands = since >= run.seconds
        node = np.clip(np.searchsorted(run.time_s, since, side="right") - 1, 0, len(run.time_s) - 2)
        left = np.minimum(since, run.seconds) - run.time_s[node]
        pace = np.where(stands, 0.0, run.acceleration_m_s2[node])
        way = np.minimum(
            run.way_m[node] + left * (run.speed_m_s[node] + run.acceleration_m_s2[node] * left / 2), run.way_m[-1]
        )
        speed = np.where(stands, 0.0, np.maximum(run.speed_m_s[node] + pace * left, 0.0))
        plan = np.interp(way, run.way_m, run.plan_m)
        points = run.path.at(plan)
        steering = elementary.arctan(self.car.wheelbase_m * points.curvature_per_m)
        if index + 1 < len(self.runs):
            target = self._angle(self.runs[index + 1].path.pieces[0].start_per_m)
            turned = np.clip((since - run.seconds) * self.steering_rate_rad_s, 0.0, np.abs(target - steering))
            steering = np.where(stands, steering + np.sign(target - steering) * turned, steering)
        height, pitch = tilt(self.spans, run.begin_m + plan, points, self.car.wheelbase_m)
        sign = float(run.path.pieces[0].gear.sign)
        return (
            times,
            points.x_m,
            height,
            points.z_m,
            points.yaw_rad,
            pitch,
            sign * speed,
            sign * pace,
            elementary.tan(steering) / self.car.wheelbase_m,
            steering,
            np.full(len(times), sign),
            driven_m + way,
        )

    def _angle(self, curvature_per_m: float) -> float:
        return elementary.arctan(self.car.wheelbase_m * curvature_per_m)

    def _steering_s(self, number: int) -> float:
        """Return the duration of steering at a standstill after a run."""
        return _steering_s(self.runs[number].path, self.runs[number + 1].path, self.car, self.steering_rate_rad_s)


def timed(
    path: Path,
    settings: DriveConfig,
    *,
    car: DesignCar | None = None,
    parked_after: int | None = None,
    spans: Sequence[FloorSpan] = (),
) -> Motion:
    """Time the motion of a car along a path that begins and ends at a standstill.

    Parameters
    ----------
    path
        Path of the car.
    settings
        Limits of speed, acceleration and steering.
    car
        The car.
    parked_after
        Number of the piece before which the car stays parked for as long as the settings say.
    spans
        Floors along the path, part by part; a level floor at height 0 if left out.

    Notes
    -----
    Where the curvatures of two pieces differ, the car stops while its wheels turn; where the gears differ, at least as
    long as shifting takes. In between, the speed at each node is the least of the limits of lane or parking, of the
    lateral acceleration, and of the steering. A forward and a backward pass then limit the acceleration.
    """
    car = car or DesignCar()
    groups, pauses = _groups(path, settings, parked_after)
    start, begin_m, runs = path.start, 0.0, []
    for pieces in groups:
        part = Path(start, pieces)
        runs.append(_run(part, settings, car, spans, begin_m))
        start, begin_m = part.end, begin_m + part.length_m
    starts, now = [], 0.0
    for number, run in enumerate(runs):
        starts.append(now)
        now += run.seconds
        if number + 1 < len(runs):
            steering_s = _steering_s(run.path, runs[number + 1].path, car, settings.steering_rate_rad_s)
            now += max(pauses[number], steering_s)
    return Motion(tuple(runs), tuple(starts), now, car, tuple(spans), settings.steering_rate_rad_s)


def _groups(path: Path, settings: DriveConfig, parked_after: int | None) -> tuple[list[tuple[Piece, ...]], list[float]]:
    """Group the pieces between standstills; return the groups and the least duration of each stop."""
    groups: list[list[Piece]] = [[]]
    pauses = []
    for number, piece in enumerate(path.pieces):
        if piece.length_m < _SHORTEST_M:
            continue
        if groups[-1]:
            last = groups[-1][-1]
            shifts, steers = last.gear is not piece.gear, abs(last.end_per_m - piece.start_per_m) > _SAME_PER_M
            is_parked = number == parked_after
            if shifts or steers or is_parked:
                groups.append([])
                pauses.append(max(settings.parked_s if is_parked else 0.0, settings.shift_s if shifts else 0.0))
        groups[-1].append(piece)
    return [tuple(group) for group in groups], pauses


def _steering_s(one: Path, other: Path, car: DesignCar, rate_rad_s: float) -> float:
    """Return the time in which the wheels turn from the end of one path to the start of another."""
    angles = [
        elementary.arctan(car.wheelbase_m * curvature)
        for curvature in (one.pieces[-1].end_per_m, other.pieces[0].start_per_m)
    ]
    return abs(angles[1] - angles[0]) / rate_rad_s


def _run(
    path: Path,
    settings: DriveConfig,
    car: DesignCar,
    spans: Sequence[FloorSpan],
    begin_m: float,
) -> _Run:
    """Compute the fastest run over pieces that join smoothly."""
    plan, limits = [0.0], []
    for piece in path.pieces:
        count = max(math.ceil(piece.length_m / _NODE_M), _LEAST_NODES)
        ends = plan[-1] + piece.length_m * np.arange(1, count + 1) / count
        curvatures = np.linspace(piece.start_per_m, piece.end_per_m, count + 1)
        plan += ends.tolist()
        limits += [_most_m_s(one, other, piece, count, settings, car) for one, other in pairwise(curvatures.tolist())]
    plan_m = np.array(plan)
    points = path.at(plan_m)
    rise = np.diff(floor_heights_m(spans, begin_m + plan_m, points.x_m, points.z_m))
    steps = elementary.hypot(np.diff(plan_m), rise)
    square = np.append(np.array(limits) ** 2, 0.0)
    square[1:-1] = np.minimum(square[:-2], square[1:-1])
    square[0] = 0.0
    gain = 2 * settings.acceleration_m_s2 * steps
    for node in range(1, len(square)):
        square[node] = min(square[node], square[node - 1] + gain[node - 1])
    for node in range(len(square) - 2, -1, -1):
        square[node] = min(square[node], square[node + 1] + gain[node])
    speed = np.sqrt(square)
    times = np.concatenate([[0.0], np.cumsum(2 * steps / (speed[1:] + speed[:-1]))])
    way = np.concatenate([[0.0], np.cumsum(steps)])
    return _Run(path, plan_m, way, speed, times, np.diff(square) / (2 * steps), begin_m)


def _most_m_s(one: float, other: float, piece: Piece, count: int, settings: DriveConfig, car: DesignCar) -> float:
    """Return the greatest speed between two curvatures of a piece that is divided into some number of intervals."""
    most = settings.parking_speed_m_s if piece.is_parking else settings.lane_speed_m_s
    tightest, widest = max(abs(one), abs(other)), min(abs(one), abs(other))
    if tightest > 0:
        most = min(most, math.sqrt(settings.lateral_acceleration_m_s2 / tightest))
    sharpness = abs(other - one) / (piece.length_m / count)
    if sharpness > 0:
        turning = car.wheelbase_m * sharpness / (1 + (car.wheelbase_m * widest) ** 2)
        most = min(most, settings.steering_rate_rad_s / turning)
    return most
