"""Outer walls along the outline of a surveyed garage, with doors at its portals."""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.config import FittingsConfig
from garage2usd.config.look import WallsLook
from garage2usd.config.site import DOOR_FRAME_M, DOOR_JAMB_M
from garage2usd.garage import LaneKind
from garage2usd.layout.placement import Placement, placed
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.objects.kind import Point
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.survey.lane_network import Gate
from garage2usd.survey.survey import PortalKind, SurveyedLane, SurveyedPortal

_LEAST_DOOR_WALL_M = 4.2
"""Least length of the piece of wall around a door."""
_DOOR_HEAD_M = 0.3
_LEAST_WALL_M = 0.02
_FROM_RAMP_M = 6.0
"""Distance from a ramp up to which the end of a lane leads to it."""
_KINDS = {
    PortalKind.ENTRANCE: (LaneKind.ENTRANCE,),
    PortalKind.EXIT: (LaneKind.EXIT,),
    PortalKind.BOTH: (LaneKind.ENTRANCE, LaneKind.EXIT),
}
_DIGITS = 6
_TURN_TOLERANCE = 1e-6


class _Side(NamedTuple):
    """A side of the outline from start to end, with the inside on its right, seen from above with z downwards."""

    start: Point
    end: Point

    @property
    def length_m(self) -> float:
        return math.dist(self.start, self.end)

    @property
    def along(self) -> Point:
        length_m = self.length_m
        return (self.end[0] - self.start[0]) / length_m, (self.end[1] - self.start[1]) / length_m

    @property
    def outwards(self) -> Point:
        x, z = self.along
        return z, -x

    def at(self, run_m: float) -> Point:
        x, z = self.along
        return self.start[0] + run_m * x, self.start[1] + run_m * z


def gates_of(
    outline: shapely.Polygon,
    portals: Sequence[SurveyedPortal],
    lanes: Sequence[SurveyedLane],
    *,
    door_wall_m: float,
    keeps_left: bool,
    landings: Sequence[Gate] = (),
) -> list[Gate]:
    """Place the doors of a surveyed garage on its outline.

    Parameters
    ----------
    outline
        The outline.
    portals
        Portals of the survey. Without any, one for both directions is at the end of a lane that is nearest to the
        outline.
    lanes
        Lanes of the survey.
    door_wall_m
        Length of the piece of wall around a door; less where the side of the outline is shorter.
    keeps_left
        True if traffic keeps to the left: the side of the entrance beside the exit of the same portal.
    landings
        Landings of ramps to other levels, where lanes end without a portal.

    Raises
    ------
    ConfigError
        If the outline has no side that is long enough for a door.
    """
    sides = _sides(outline)
    gates: list[Gate] = []
    for portal in portals or [_natural_portal(outline, lanes, landings)]:
        kinds = _KINDS[portal.kind]
        needed_m = len(kinds) * _LEAST_DOOR_WALL_M + 2 * _LEAST_WALL_M
        able = [side for side in sides if side.length_m >= needed_m]
        if not able:
            longest_m = max(side.length_m for side in sides)
            raise ConfigError("outline", f"sides of at most {longest_m:.2f} m", f"a side of {needed_m} m for a portal")
        side = min(able, key=lambda each: round(_distance_m(each, portal.position), _DIGITS))
        wall_m = round(min(door_wall_m, (side.length_m - 2 * _LEAST_WALL_M) / len(kinds)), _DIGITS)
        room_m = len(kinds) * wall_m / 2 + _LEAST_WALL_M
        middle = min(max(_run_m(side, portal.position), room_m), side.length_m - room_m)
        # along the side the inside is on the right, so the start of the side is on the right of cars that come in
        is_start_entrance = not keeps_left
        ordered = kinds if is_start_entrance else kinds[::-1]
        for number, kind in enumerate(ordered):
            run = middle + (number - (len(kinds) - 1) / 2) * wall_m
            x, z = side.at(run)
            gates.append(Gate(kind, (round(x, _DIGITS), round(z, _DIGITS)), side.outwards, wall_m))
    return gates


def surveyed_walls(
    ground: SurveyedGround, gates: Iterable[Gate], fittings: FittingsConfig, look: WallsLook
) -> list[Placement]:
    """Place walls outside every side of the outline, and a vehicle door at each gate.

    Walls are cut at the lines of columns. Posts stand in convex right-angled corners. At others the last wall of a side
    is longer by the thickness of the next side's in a convex corner, and shorter in a reflex one.
    """
    walls: list[Placement] = []
    gates, sides = list(gates), _sides(ground.polygon)
    for number, side in enumerate(sides):
        following = sides[(number + 1) % len(sides)]
        turn = side.along[0] * following.along[1] - side.along[1] * following.along[0]
        is_square = turn > 1 - _TURN_TOLERANCE
        corner_m = 0.0 if is_square else fittings.wall_thickness_m * turn
        if is_square:
            walls.append(_post(number, side, following, fittings))
        doors = sorted(
            (_run_m(side, gate.foot), gate)
            for gate in gates
            if _distance_m(side, gate.foot) < _LEAST_WALL_M and gate.outwards == side.outwards
        )
        bounds = [0.0]
        for run, gate in doors:
            bounds += [run - gate.wall_m / 2, run + gate.wall_m / 2]
        bounds.append(side.length_m)
        cuts: list[tuple[float, Gate | None]] = [(0.0, None)]
        for index, (low, high) in enumerate(pairwise(bounds)):
            if index % 2:
                cuts.append((high, doors[index // 2][1]))
            else:
                cuts += [(low + cut, None) for cut in ground.lines.cuts_m(side.at(low), side.at(high))[1:]]
        cuts[-1] = side.length_m + corner_m, None
        for piece, ((start, _), (end, door)) in enumerate(pairwise(cuts)):
            if end - start < _LEAST_WALL_M:
                continue
            spec = _spec(end - start, fittings, look, door)
            name = f"{'Wall' if door is None else 'Portal'}_{number + 1:02d}_{piece + 1}"
            # the inner face looks to +Z, which is inwards
            inwards = -side.outwards[0], -side.outwards[1]
            walls.append(placed(name, spec, side.at((start + end) / 2), yaw_rad=_yaw_rad(inwards)))
    return walls


def _post(number: int, side: _Side, following: _Side, fittings: FittingsConfig) -> Placement:
    """Return the post in the convex right-angled corner at the end of a side."""
    half_m = fittings.wall_thickness_m / 2
    (x, z), (out_x, out_z), (next_x, next_z) = side.end, side.outwards, following.outwards
    place = x + half_m * (out_x + next_x), z + half_m * (out_z + next_z)
    spec = WallPostSpec(fittings.wall_thickness_m, fittings.ceiling_height_m)
    yaw_rad = math.remainder(_yaw_rad(side.outwards), math.pi / 2)
    return placed(f"Post_{number + 1:02d}", spec, place, yaw_rad=0.0 if abs(yaw_rad) < _TURN_TOLERANCE else yaw_rad)


def _spec(length_m: float, fittings: FittingsConfig, look: WallsLook, door: Gate | None) -> WallSpec | PortalSpec:
    length_m = round(length_m, _DIGITS)
    height, thickness = fittings.ceiling_height_m, fittings.wall_thickness_m
    if door is None:
        return WallSpec(length_m, height, thickness, look.dado_m, look.has_stripe)
    return PortalSpec(
        length_m,
        height,
        thickness,
        door_width_m=round(length_m - 2 * DOOR_JAMB_M, _DIGITS),
        door_height_m=round(max(fittings.clear_height_m + DOOR_FRAME_M, height - 2 * _DOOR_HEAD_M), _DIGITS),
        is_entrance=door.kind is LaneKind.ENTRANCE,
    )


def _natural_portal(
    outline: shapely.Polygon, lanes: Sequence[SurveyedLane], landings: Sequence[Gate]
) -> SurveyedPortal:
    """Return a portal for a survey without any: the end of a lane nearest to the outline, away from ramps."""
    every = [lane.points[place] for lane in lanes for place in (0, -1)]
    if not every:
        raise ConfigError("lanes", [], "a lane or more")
    ends = [end for end in every if all(math.dist(end, gate.foot) > _FROM_RAMP_M for gate in landings)] or every
    boundary = outline.exterior
    return SurveyedPortal(min(ends, key=lambda end: (round(boundary.distance(shapely.Point(end)), 3), end)))


def _sides(outline: shapely.Polygon) -> list[_Side]:
    """Return the sides of an outline in order, the inside on the right of each, seen from above with z downwards."""
    corners = np.array(outline.exterior.coords)[:, :2]
    # seen with z downwards, a positive area in x and z runs clockwise
    clockwise = float(np.sum(corners[:-1, 0] * corners[1:, 1] - corners[1:, 0] * corners[:-1, 1])) > 0
    points = corners if clockwise else corners[::-1]
    rounded = [(round(float(x), _DIGITS), round(float(z), _DIGITS)) for x, z in points]
    return [_Side(start, end) for start, end in pairwise(rounded) if math.dist(start, end) > _LEAST_WALL_M]


def _distance_m(side: _Side, point: Point) -> float:
    return float(shapely.LineString([side.start, side.end]).distance(shapely.Point(point)))


def _run_m(side: _Side, point: Point) -> float:
    x, z = side.along
    return (point[0] - side.start[0]) * x + (point[1] - side.start[1]) * z


def _yaw_rad(direction: Point) -> float:
    """Return the yaw that turns +Z to a direction; exact for quarter turns."""
    x, z = direction
    yaw = math.atan2(x, z)
    quarter = round(yaw / (math.pi / 2))
    if abs(yaw - quarter * math.pi / 2) < 1e-9:  # noqa: PLR2004 - rounding
        return {0: 0.0, 1: math.pi / 2, 2: math.pi, -1: -math.pi / 2, -2: math.pi}[quarter]
    return yaw
