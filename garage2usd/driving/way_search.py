"""Manoeuvre searches between a parked pose and a lane, by weighted A* over arcs and straights; in C, `search.c`."""
# Over 300 lines: the arrays that the C search takes stand beside the two searches that fill them.

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear, Manoeuvre, Move
from garage2usd.driving.obstacles import Floats, Obstacles, Scene, touched_shapes
from garage2usd.driving.proof import LanePose, Limits, Search, least_clearance_m
from garage2usd.native import Float64Table, Int64s, elementary, in_c

HEADINGS = 120
"""Number of discrete headings in a full turn."""
_NO_MEMORY = -2
_MOST_PIECES, _MOST_WORDS = 5, 64
_QUARTER = math.pi / 2
_HEADING_ERROR = 1e-6
_SAME = 1e-9
_PASSES = ((0.36, 16_384), (0.24, 65_536), (0.12, 131_072))
"""Length of a straight step in metres and greatest number of nodes of each search pass: coarse first."""
_GUIDED_PASSES = ((0.24, 120), (0.06, 240), (0.02, 480))
"""Length of a straight step in metres and number of headings of each guided search pass: coarse first."""
_PLACES_PER_M2, _FEWEST_PLACES, _MOST_PLACES = 125, 32_768, 1_000_000
"""Node limit of a guided search: per square metre within reach, at least, and at most."""
_MORE_PLACES = 64
"""Assumed growth of the number of nodes per finer guided pass; a pass that would exceed the node limit is skipped."""


class Task(NamedTuple):
    """Input of the A* search for a parking manoeuvre.

    Attributes
    ----------
    scene
        The car and its obstacles.
    start
        x, z, yaw.
    goals
        Heading number, and the least x and z and the greatest x and z of the rear axle's middle; shape (n, 5).
    radius
        Radius of the arcs.
    margin
        Clearance kept around the car.
    reach
        Greatest distance of the rear axle from the start along either axis.
    straight_m
        Length of a straight step.
    max_changes, max_nodes
        Greatest number of gear changes, and of expanded nodes, at least one.
    headings
        Number of headings in a full turn: a multiple of 4.
    is_guided
        True to try Reeds-Shepp words, and to account for obstacles in the remaining cost.
    """

    scene: Scene
    start: Floats
    goals: Float64Table
    radius: float
    margin: float
    reach: float
    straight_m: float
    max_changes: int
    max_nodes: int
    headings: int = HEADINGS
    is_guided: bool = False


class Found(NamedTuple):
    """Result of the A* search for a parking manoeuvre.

    Attributes
    ----------
    outcome
        1 if a manoeuvre was found, 0 if there is none, -1 if `max_nodes` was reached.
    steps
        Steps as gear (1 or -1), steering (1 to the left, -1 or 0) and length in metres; shape (steps, 3).
    places
        Number of nodes reached.
    """

    outcome: int
    steps: Floats
    places: int


def search(task: Task, touched: Int64s) -> Found:
    """Search a low-cost manoeuvre from a parked pose to a goal by weighted A*.

    Parameters
    ----------
    task
        Input of the search.
    touched
        Counter of collisions for each shape.

    Raises
    ------
    MemoryError
        If there is no memory for `max_nodes` nodes.
    """
    steps = np.empty((task.max_nodes + _MOST_PIECES, 3))
    places = np.zeros(1, np.int64)
    found = _find_steps(task, touched, places, steps)
    if found == _NO_MEMORY:
        raise MemoryError(f"{task.max_nodes} places of a search")
    return Found(min(found, 1), steps[: max(found, 0)].copy(), int(places[0]))


@in_c
def _find_steps(task: Task, touched: Int64s, places: Int64s, steps: Floats) -> int:
    raise NotImplementedError


def reeds_shepp_words(start: Floats, end: Floats, radius: float) -> Floats:
    """Enumerate all Reeds-Shepp words between two poses (x, z, yaw), without obstacles.

    Returns
    -------
    array
        Steering (1 to the left, -1, 0) and metres (negative in reverse) of up to five pieces, padded with zeros;
        shape (words, 5, 2).
    """
    rows = np.empty((_MOST_WORDS, _MOST_PIECES, 2))
    return rows[: _write_words(start, end, radius, rows)].copy()


@in_c
def _write_words(start: Floats, end: Floats, radius: float, rows: Floats) -> int:
    raise NotImplementedError


_NOTHING = Found(0, np.empty((0, 3)), 0)


def find_way(
    car: DesignCar, parked: Pose, obstacles: Obstacles, lanes: Sequence[LanePose], limits: Limits | None = None
) -> Search:
    """Find a manoeuvre from a parked pose to any of some lane poses.

    Parameters
    ----------
    car
        The car.
    parked
        Parked pose.
    obstacles
        Obstacles to the car.
    lanes
        Lane poses at which the manoeuvre may end; directions differ by quarter turns.
    limits
        Margin, gear changes, reach and effort.

    Returns
    -------
    Search
        Result of the search. `Manoeuvre.reversed` leads from the lane, in the same direction, into the stall.

    Raises
    ------
    ConfigError
        If the lanes' directions differ by other than quarter turns.

    Notes
    -----
    The search by steps runs first, since it is fast on long lanes. Steps rarely hit a lane pose shorter
    and narrower than a step; there the guided search runs first.
    """
    limits = limits or Limits()
    is_place = all(max(lane.length_m, lane.width_m) < _PASSES[0][0] for lane in lanes)
    if is_place and limits.is_thorough:
        guided = find_guided_way(car, parked, obstacles, lanes, limits)
        return guided if guided.way else _reached(find_way_by_steps(car, parked, obstacles, lanes, limits), guided)
    by_steps = find_way_by_steps(car, parked, obstacles, lanes, limits)
    if by_steps.way or not limits.is_thorough:
        return by_steps
    return _reached(find_guided_way(car, parked, obstacles, lanes, limits), by_steps)


def _reached(later: Search, earlier: Search) -> Search:
    """Return the later of two manoeuvre searches if it succeeded, else a merged failure."""
    if later.way:
        return later
    return Search(None, earlier.touched or later.touched, earlier.is_exhausted and later.is_exhausted)


def find_way_by_steps(
    car: DesignCar, parked: Pose, obstacles: Obstacles, lanes: Sequence[LanePose], limits: Limits
) -> Search:
    """Find a manoeuvre by uniform steps, without a guide; parameters as for `find_way`."""
    task = _task(car, parked, obstacles, lanes, limits)
    if isinstance(task, Search):
        return task
    found = _NOTHING
    for straight_m, effort in _PASSES if limits.is_thorough else _PASSES[:-1]:
        task.touched[:] = 0
        found = task.look(straight_m, effort)
        headings = np.unique(task.goals[:, 0])
        if found.outcome < 0 and len(headings) > 1:
            # an unreachable lane may divert the search from a reachable one, so search for each direction alone
            each = []
            for heading in headings:
                each.append(task.look(straight_m, effort, only=heading))
                if each[-1].outcome > 0:
                    break
            found = max(each, key=lambda one: (one.outcome > 0, -one.outcome))
        if found.outcome > 0:
            break
    return task.search_of(found)


def find_guided_way(
    car: DesignCar, parked: Pose, obstacles: Obstacles, lanes: Sequence[LanePose], limits: Limits
) -> Search:
    """Find a manoeuvre by Reeds-Shepp words and a heuristic around obstacles; parameters as for `find_way`."""
    task = _task(car, parked, obstacles, lanes, limits)
    if isinstance(task, Search):
        return task
    places = round(_PLACES_PER_M2 * (2 * limits.reach_m) ** 2)
    effort = min(max(places, _FEWEST_PLACES), _MOST_PLACES)
    found = _NOTHING
    for straight_m, headings in _GUIDED_PASSES:
        task.touched[:] = 0
        found = task.look(straight_m, effort, guided_by=headings)
        if found.outcome != 0 or found.places > effort / _MORE_PLACES:
            break
    return task.search_of(found)


@dataclass(frozen=True, eq=False, slots=True)
class _LocalTask:
    """A manoeuvre search in the frame of the lanes, with the parked rear axle at the origin, and its collisions.

    Attributes
    ----------
    goals
        Number of the heading, of 120, and least and greatest x and z; shape (lanes, 5).
    near, local
        Obstacles within reach, in the garage's frame and in that of the search.
    """

    car: DesignCar
    parked: Pose
    limits: Limits
    start: Floats
    goals: Floats
    near: Obstacles
    local: Obstacles
    touched: Int64s

    def look(self, straight_m: float, effort: int, *, only: float | None = None, guided_by: int | None = None) -> Found:
        """Run the search for any goal or those of one heading; `guided_by` is the number of headings of a guide."""
        goals = self.goals if only is None else self.goals[self.goals[:, 0] == only]
        headings = guided_by or HEADINGS
        task = Task(
            self.local.met_by(self.car),
            self.start,
            goals * (headings / HEADINGS, 1, 1, 1, 1) if guided_by else goals,
            radius=self.car.rear_axle_radius_m,
            margin=self.limits.margin_m,
            reach=self.limits.reach_m,
            straight_m=straight_m,
            max_changes=self.limits.gear_changes,
            max_nodes=effort,
            headings=headings,
            is_guided=guided_by is not None,
        )
        return search(task, self.touched)

    def search_of(self, found: Found) -> Search:
        """Convert the result of an A* search, with the clearance of its manoeuvre."""
        if found.outcome <= 0:
            order = np.argsort(-self.touched, kind="stable")
            touched = self.local.named(order[self.touched[order] > 0])
            return Search(None, touched, is_exhausted=found.outcome == 0)
        way = Manoeuvre(self.parked, _moves(found.steps, self.car.rear_axle_radius_m), 0.0)
        return Search(replace(way, clearance_m=least_clearance_m(self.car, way, self.near)))


def _task(
    car: DesignCar, parked: Pose, obstacles: Obstacles, lanes: Sequence[LanePose], limits: Limits
) -> _LocalTask | Search:
    """Return the local search task, or a finished search if there is no lane or the parked car touches an obstacle."""
    if not lanes:
        return Search(None, (), is_exhausted=True)
    frame = lanes[0].yaw_rad
    goals = np.array([_goal(car, parked, lane, frame) for lane in lanes])
    start = np.array([0.0, 0.0, math.remainder(parked.yaw_rad - frame, math.tau)])
    reach = limits.reach_m + car.length_m
    near = obstacles.near((parked.x_m, parked.z_m), math.sqrt(2) * reach)
    local = near.seen_from(parked.x_m, parked.z_m, frame).near((0.0, 0.0), reach)
    standing = local.named(touched_shapes(local.met_by(car), start, limits.margin_m))
    if standing:
        return Search(None, standing, is_exhausted=True)
    return _LocalTask(car, parked, limits, start, goals, near, local, np.zeros(len(local.pieces), np.int64))


def _goal(car: DesignCar, parked: Pose, lane: LanePose, frame: float) -> tuple[float, float, float, float, float]:
    """Return heading number, and least and greatest x and z of the rear axle's middle, in the frame of the search."""
    turned = lane.yaw_rad - frame
    quarters = round(turned / _QUARTER)
    if abs(turned - quarters * _QUARTER) > _HEADING_ERROR:
        raise ConfigError("lanes", turned, "directions that differ by quarter turns")
    axle = car.centred(lane.middle_m, lane.yaw_rad)
    x, z = axle.x_m - parked.x_m, axle.z_m - parked.z_m
    cos, sin = elementary.cos(frame), elementary.sin(frame)
    x, z = x * cos - z * sin, x * sin + z * cos
    half_x, half_z = lane.width_m / 2, lane.length_m / 2
    if quarters % 2:
        half_x, half_z = half_z, half_x
    heading = (quarters * HEADINGS // 4) % HEADINGS
    return heading, x - half_x - _SAME, z - half_z - _SAME, x + half_x + _SAME, z + half_z + _SAME


def _moves(steps: Floats, radius_m: float) -> tuple[Move, ...]:
    """Convert search steps to moves, merging equal consecutive steps."""
    moves: list[Move] = []
    previous = None
    for gear, steering, length in steps.tolist():
        if (gear, steering) == previous:
            last = moves[-1]
            moves[-1] = Move(last.gear, last.curvature_per_m, last.length_m + length)
        else:
            moves.append(Move(Gear.FORWARD if gear > 0 else Gear.REVERSE, steering / radius_m, length))
        previous = (gear, steering)
    return tuple(moves)
