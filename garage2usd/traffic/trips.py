"""Trips of cars: a path with its speed limits, the ground along it, and the places where a car may wait."""
# Over 300 lines: speeds, ground and waiting places of a trip are measured on the same poses.

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar
from garage2usd.driving.path import Path
from garage2usd.driving.road import FloorSpan, tilt
from garage2usd.driving.timing import timed
from garage2usd.garage import LaneGraph
from garage2usd.native import elementary
from garage2usd.traffic.ground import Cells, Floats, Raster

SLICE_M = 0.5
"""Length of the slices of a path whose ground is held at once."""
_LIMIT_STEP_M = 0.1
_NODES_A_SLICE = 3
_IN_LINE = 0.995
_SAME_M, _SAME_RAD = 2e-3, 1e-3
_DOOR_CLEAR_M = 1.2
"""Distance of a waiting car from the place in front of the door of a stair core."""
_OWN_HALF_M = 0.05
"""Least distance of a waiting car from the middle of an aisle for two-way traffic."""
_ABREAST_M = 2.1
"""Least width beside a waiting car for one from ahead to pass."""
_BESIDE_SLICES = 60
_NEAR_RAMP_M = 6.0
"""Distance from the end of a ramp within which a car holds the ground of both the ramp and the level."""


@dataclass(frozen=True)
class Stretch:
    """A stretch of a path on one level or ramp.

    Attributes
    ----------
    end_m
        Distance along the path at which it ends, as seen from above.
    layer
        Number of its layer: that of its level, or of its ramp.
    level
        Number of the level; None on a ramp.
    """

    end_m: float
    layer: int
    level: int | None


@dataclass(frozen=True, eq=False)
class Stop:
    """A standstill on a trip, to change gear or to turn the wheels.

    Attributes
    ----------
    way_m
        Distance along the floor.
    pause_s
        Least duration.
    """

    way_m: float
    pause_s: float


class Trip:
    """A path of a car through a garage, ready to be driven step by step.

    Parameters
    ----------
    path, spans, stretches
        The path, the floors along it, and its levels and ramps.
    car, settings
        The car, and the limits of its motion.
    raster
        The raster of the garage.
    lanes
        The lane graph of each level.
    keeps_left
        True where traffic keeps to the left.
    doors
        Places (x, z) in front of the doors of stair cores of each level, which a waiting car keeps clear of.

    Attributes
    ----------
    length_m
        Length along the floor.
    limits_m_s
        Greatest speed at every 0.1 m.
    stops
        Standstills, the end included.
    keeps_left
        True where traffic keeps to the left.
    hint
        Slice that was not free when it was last asked for, to be asked for first.
    """

    hint = -1

    def __init__(
        self,
        path: Path,
        spans: Sequence[FloorSpan],
        stretches: Sequence[Stretch],
        *,
        car: DesignCar,
        settings: DriveConfig,
        raster: Raster,
        lanes: Sequence[LaneGraph],
        keeps_left: bool = False,
        doors: Sequence[Floats] = (),
    ) -> None:
        self.path, self.car, self.stretches, self._lanes, self._doors = path, car, tuple(stretches), lanes, doors
        self._raster, self.keeps_left = raster, keeps_left
        self._spans = tuple(spans)
        motion = timed(path, settings, car=car, spans=spans)
        starts = np.cumsum([0.0, *(float(run.way_m[-1]) for run in motion.runs)])
        self.length_m = float(starts[-1])
        pauses = [
            after - before - run.seconds
            for (before, after), run in zip(pairwise(motion.starts_s), motion.runs, strict=False)
        ]
        self.stops = tuple(Stop(float(way), pause) for way, pause in zip(starts[1:], [*pauses, 0.0], strict=True))
        way = np.concatenate([run.way_m + start for run, start in zip(motion.runs, starts, strict=False)])
        self._plan_of = way, np.concatenate([run.plan_m + run.begin_m for run in motion.runs])
        steps = np.arange(0.0, self.length_m + _LIMIT_STEP_M, _LIMIT_STEP_M)
        limits = np.zeros(len(steps))
        for run, start in zip(motion.runs, starts, strict=False):
            here = (steps >= start - _LIMIT_STEP_M) & (steps <= start + run.way_m[-1])
            # what limits the speed shortly after a standstill is the acceleration, which the simulation limits itself
            ahead = np.interp(steps[here] - start + _LIMIT_STEP_M, run.way_m, run.speed_m_s)
            limits[here] = np.maximum(np.interp(steps[here] - start, run.way_m, run.speed_m_s), ahead)
            # and what limits it before one is the braking, likewise
            braking = np.sqrt(2 * settings.acceleration_m_s2 * np.maximum(start + run.way_m[-1] - steps[here], 0.0))
            limits[here] += np.where(limits[here] > 0.98 * braking, 0.5, 0.0)
        self.limits_m_s: list[float] = np.maximum(limits, 0.1).tolist()

    @cached_property
    def slices(self) -> int:
        """Number of slices."""
        return max(math.ceil(self.length_m / SLICE_M - 1e-9), 1)

    def limit_at(self, way_m: float) -> float:
        """Return the greatest speed at a distance along the floor."""
        place = min(way_m / _LIMIT_STEP_M, len(self.limits_m_s) - 1.001)
        low = int(place)
        return self.limits_m_s[low] + (place - low) * (self.limits_m_s[low + 1] - self.limits_m_s[low])

    def layers_at(self, plan_m: Floats) -> list[tuple[int, ...]]:
        """Return the layers that a car holds ground of at distances along the path as seen from above."""
        ends = [stretch.end_m for stretch in self.stretches[:-1]]
        return [
            tuple(
                dict.fromkeys(
                    self.stretches[int(np.searchsorted(ends, at, side="right"))].layer
                    for at in (plan, max(plan - _NEAR_RAMP_M, 0.0), plan + _NEAR_RAMP_M)
                )
            )
            for plan in plan_m.tolist()
        ]

    @cached_property
    def _nodes(self) -> tuple[Floats, Floats]:
        """Poses (x, z, yaw) at the nodes of the slices, and their distances seen from above."""
        ways = np.linspace(0.0, self.slices * SLICE_M, self.slices * (_NODES_A_SLICE - 1) + 1)
        plan = np.interp(np.minimum(ways, self.length_m), *self._plan_of)
        at = self.path.at(plan)
        return np.stack([at.x_m, at.z_m, at.yaw_rad], axis=1), plan

    @cached_property
    def cells(self) -> list[Cells]:
        """The cells of each slice, ascending."""
        poses, plan = self._nodes
        body = np.array([self.car.ahead_m, self.car.rear_overhang_m, self.car.width_m / 2])
        return self._raster.slices(poses, body, self.layers_at(plan), _NODES_A_SLICE - 1)

    @cached_property
    def entered(self) -> list[Cells]:
        """The cells of each slice that the slice before does not have; of the first slice all."""
        return [self.cells[0], *(_without(after, before) for before, after in pairwise(self.cells))]

    @cached_property
    def left(self) -> list[Cells]:
        """The cells of each slice that the next slice does not have; of the last slice all."""
        return [*(_without(before, after) for before, after in pairwise(self.cells)), self.cells[-1]]

    def cells_between(self, begin: int, end: int) -> Cells:
        """Return the cells of the slices from one up to another."""
        flat, starts = self.flat
        return np.concatenate([self.cells[begin], flat[starts[begin + 1] : starts[max(end, begin + 1)]]])

    @cached_property
    def flat(self) -> tuple[Cells, Cells]:
        """The cells that all slices enter, and where those of each slice begin."""
        return np.concatenate(self.entered), np.cumsum([0, *map(len, self.entered)])

    @cached_property
    def groups(self) -> list[int]:
        """For each slice the first slice at or after it at whose end a car may wait."""
        poses, plan = self._nodes
        step = _NODES_A_SLICE - 1
        ends = slice(step, None, step)
        may_wait = self._may_wait(poses[ends], plan[ends])
        may_wait[-1] = True
        found, after = [0] * self.slices, self.slices - 1
        for number in range(self.slices - 1, -1, -1):
            after = number if may_wait[number] else after
            found[number] = after
        return found

    def next_wait(self, number: int) -> int:
        """Return the first slice at or after one at whose end a car may wait; the last one beyond the end."""
        return self.groups[min(number, self.slices - 1)]

    @cached_property
    def _waits_before(self) -> list[int]:
        """For each slice the last slice at or before it at whose end a car may wait; -1 without one."""
        found, last = [], -1
        for number, end in enumerate(self.groups):
            last = number if end == number else last
            found.append(last)
        return found

    def last_wait(self, at: int, taken: int) -> int:
        """Return the last slice before one that is taken at whose end a car may wait, or else the one it is at."""
        return max(self._waits_before[taken - 1], at)

    def turn_at(self, number: int) -> tuple[float, float]:
        """Return the yaw at the begin of a slice, and at the next place to wait."""
        yaw, step = self._nodes[0][:, 2], _NODES_A_SLICE - 1
        return float(yaw[number * step]), float(yaw[(self.next_wait(number) + 1) * step])

    def waits(self) -> list[int]:
        """Return the slices before the manoeuvre into a stall at whose ends a car may wait on an aisle."""
        most = min(self.parking_m[0], self.length_m) / SLICE_M - 1
        return [number for number, end in enumerate(self.groups) if number == end and number < most]

    def wait_beside(self, other: "Trip") -> int | None:
        """Return the last slice at whose end a car can wait until another one has driven by, if there is one near."""
        passed = np.unique(np.concatenate(other.cells))
        near = self.waits()[-_BESIDE_SLICES:]
        return next((number for number in reversed(near) if not np.isin(self.cells[number], passed).any()), None)

    def against_m(self) -> float:
        """Return the distance that the car drives forward against one-way aisles."""
        poses, plan = self._nodes
        ahead = np.stack([-elementary.sin(poses[:, 2]), -elementary.cos(poses[:, 2])], axis=1)
        ends = [stretch.end_m for stretch in self.stretches[:-1]]
        stretch = np.searchsorted(ends, plan, side="right")
        forward = self.signs(np.interp(plan, self._plan_of[1], self._plan_of[0])) > 0
        is_against = np.zeros(len(poses), dtype=bool)
        for number, each in enumerate(self.stretches):
            for start, along, length_m, width_m, one_way, _ in (
                _aisles(self._lanes[each.level]) if each.level is not None else ()
            ):
                away = poses[:, :2] - start
                run, right = away @ along, away @ np.array([-along[1], along[0]])
                here = (stretch == number) & (run >= 0) & (run <= length_m) & (np.abs(right) <= width_m / 2)
                is_against |= here & forward & one_way & (ahead @ along < -_IN_LINE)
        return float(is_against.sum()) * SLICE_M / (_NODES_A_SLICE - 1)

    def _may_wait(self, poses: Floats, plan: Floats) -> NDArray[np.bool_]:
        """Find the poses at which a waiting car leaves room for oncoming and for crossing traffic.

        It is in line with an aisle, outside of junctions and bends, on its own half of a two-way aisle.
        """
        ends = [stretch.end_m for stretch in self.stretches[:-1]]
        stretch = np.searchsorted(ends, plan, side="right")
        found = np.zeros(len(poses), dtype=bool)
        ahead = np.stack([-elementary.sin(poses[:, 2]), -elementary.cos(poses[:, 2])], axis=1)
        middle = poses[:, :2] + ahead * (self.car.length_m / 2 - self.car.rear_overhang_m)
        half = self.car.length_m / 2
        for number, each in enumerate(self.stretches):
            if each.level is None:
                continue
            own = np.flatnonzero(stretch == number)
            for start, along, length_m, width_m, one_way, lows in _aisles(self._lanes[each.level]):
                away = middle[own] - start
                run, right = away @ along, away @ np.array([-along[1], along[0]])
                same = ahead[own] @ along
                here = (np.abs(same) > _IN_LINE) & (np.abs(right) <= width_m / 2)
                here &= (run >= max(lows[0] + half, 0.0)) & (run <= length_m - max(lows[1] + half, 0.0))
                if one_way:
                    here &= same > 0
                else:
                    aside = right * np.sign(same) * (-1 if self.keeps_left else 1)
                    here &= (aside >= self.car.width_m / 2 + _OWN_HALF_M) & (
                        aside - self.car.width_m / 2 + width_m / 2 >= _ABREAST_M
                    )
                found[own[here]] = True
            if each.level < len(self._doors):
                for door in self._doors[each.level]:
                    away = door - middle[own]
                    run, right = (
                        (away * ahead[own]).sum(axis=1),
                        away[:, 1] * ahead[own][:, 0] - away[:, 0] * ahead[own][:, 1],
                    )
                    beside = np.maximum(np.abs(np.stack([run, right])) - [[half], [self.car.width_m / 2]], 0.0)
                    found[own[np.hypot(*beside) < _DOOR_CLEAR_M]] = False
        return found

    def states(self, ways: Floats) -> NDArray[np.float64]:
        """Return x, y, z, yaw, pitch and steering of the rear axle at distances along the floor; shape (n, 6)."""
        plan = np.interp(ways, *self._plan_of)
        at = self.path.at(plan)
        height, pitch = tilt(self._spans, plan, at, self.car.wheelbase_m)
        steering = elementary.arctan(self.car.wheelbase_m * at.curvature_per_m)
        return np.stack([at.x_m, height, at.z_m, at.yaw_rad, pitch, steering], axis=1)

    @cached_property
    def gears(self) -> tuple[Floats, Floats]:
        """Ends of the pieces along the path as seen from above, and their signs."""
        lengths = np.cumsum([piece.length_m for piece in self.path.pieces])
        return lengths, np.array([float(piece.gear.sign) for piece in self.path.pieces])

    def signs(self, ways: Floats) -> Floats:
        """Return 1 where the car drives forward and -1 in reverse; shape (n,)."""
        ends, signs = self.gears
        plan = np.interp(ways, *self._plan_of)
        found: Floats = signs[np.minimum(np.searchsorted(ends, plan, side="right"), len(signs) - 1)]
        return found

    @cached_property
    def parking_m(self) -> tuple[float, float]:
        """Distances along the floor at which the manoeuvre between aisle and stall begins and ends."""
        lengths = np.cumsum([0.0, *(piece.length_m for piece in self.path.pieces)])
        own = [number for number, piece in enumerate(self.path.pieces) if piece.is_parking]
        if not own:
            return math.inf, math.inf
        way, plan = self._plan_of
        low, high = np.interp([lengths[own[0]], lengths[own[-1] + 1]], plan, way).tolist()
        return low, high

    def levels(self, ways: Floats) -> NDArray[np.int8]:
        """Return the number of the level at distances along the floor; half way along a ramp it changes."""
        plan = np.interp(ways, *self._plan_of)
        ends, levels, begin = [], [], 0.0
        for before, stretch, after in zip(
            [None, *self.stretches], self.stretches, [*self.stretches[1:], None], strict=False
        ):
            if stretch.level is None and before is not None and after is not None:
                ends += [(begin + stretch.end_m) / 2, stretch.end_m]
                levels += [before.level or 0, after.level or 0]
            else:
                ends.append(stretch.end_m)
                levels.append(stretch.level or 0)
            begin = stretch.end_m
        numbers = np.searchsorted(ends[:-1], plan, side="right")
        return np.array(levels, dtype=np.int8)[numbers]

    def way_through(self, pose: Floats, level: int) -> float | None:
        """Return the distance along the floor at which a pose (x, z, yaw) of a level is passed; None if nowhere."""
        poses, _ = self._nodes
        away = np.hypot(*(poses[:, :2] - pose[:2]).T)
        node = int(away.argmin())
        if away[node] > SLICE_M / 2:
            return None
        way = node * SLICE_M / (_NODES_A_SLICE - 1)
        ahead = np.array([-elementary.sin(pose[2]), -elementary.cos(pose[2])])
        way += float((pose[:2] - poses[node, :2]) @ ahead)
        at = self.states(np.array([way]))[0]
        is_same = math.hypot(at[0] - pose[0], at[2] - pose[1]) < _SAME_M
        is_same = is_same and abs(math.remainder(at[3] - pose[2], math.tau)) < _SAME_RAD
        return way if is_same and int(self.levels(np.array([way]))[0]) == level else None


def _without(cells: Cells, others: Cells) -> Cells:
    """Return the cells that are not among others; both ascend."""
    found: Cells = cells[others[np.minimum(np.searchsorted(others, cells), len(others) - 1)] != cells]
    return found


@lru_cache(maxsize=64)
def _aisles(
    lanes: LaneGraph,
) -> list[tuple[Floats, Floats, float, float, bool, tuple[float, float]]]:
    """Return the start, direction, length and width of each lane edge, and the reach of the crossings at its ends."""
    found = []
    for edge in lanes.edges:
        start, end = (np.array(lanes.nodes[number].position) for number in (edge.start, edge.end))
        length_m = float(np.hypot(*(end - start)))
        if length_m == 0:
            continue
        along = (end - start) / length_m
        lows = tuple(_crossing_m(lanes, number, along) for number in (edge.start, edge.end))
        found.append((start, along, length_m, edge.width_m, edge.one_way, (lows[0], lows[1])))
    return found


def _crossing_m(lanes: LaneGraph, number: int, along: Floats) -> float:
    """Return how far the ground of a junction or bend reaches along an aisle; a car may pass a node that is neither."""
    node = lanes.nodes[number]
    others = [np.array(lanes.nodes[other].position) - node.position for other in lanes.beside[number]]
    in_line = all(abs(float(other @ along)) > _IN_LINE * float(np.hypot(*other)) for other in others)
    return -math.inf if in_line and not node.is_portal else node.reach_m((float(along[0]), float(along[1])))
