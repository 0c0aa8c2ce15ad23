"""Outer walls along the outline of a surveyed garage, with doors at its portals."""

import math
from collections.abc import Iterable
from itertools import pairwise

import shapely

from garage2usd.config import FittingsConfig
from garage2usd.config.look import WallsLook
from garage2usd.config.site import DOOR_FRAME_M
from garage2usd.garage import LaneKind
from garage2usd.layout.placement import Placement, placed
from garage2usd.layout.surveyed.gates import LEAST_WALL_M, Side, door_width_m, sides_of_lot
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.objects.kind import Point
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.wall import WallPostSpec, WallSpec
from garage2usd.survey.lane_network import Gate

_DOOR_HEAD_M = 0.3
_DIGITS = 6
_TURN_TOLERANCE = 1e-6


def surveyed_walls(
    ground: SurveyedGround, gates: Iterable[Gate], fittings: FittingsConfig, look: WallsLook
) -> list[Placement]:
    """Place walls outside every side of the outlines, and a vehicle door at each gate.

    Walls are cut at the lines of columns. Posts stand in convex right-angled corners. At others the last wall of a side
    is longer by the thickness of the next side's in a convex corner, and shorter in a reflex one.
    """
    walls: list[Placement] = []
    gates, rings = list(gates), map(sides_of_lot, shapely.get_parts(ground.polygon))
    for number, (side, following) in enumerate(pair for ring in rings for pair in pairwise([*ring, ring[0]])):
        turn = side.along[0] * following.along[1] - side.along[1] * following.along[0]
        is_square = turn > 1 - _TURN_TOLERANCE
        corner_m = 0.0 if is_square else fittings.wall_thickness_m * turn
        if is_square:
            walls.append(_post(number, side, following, fittings))
        on_it = [gate for gate in gates if side.distance_m(gate.foot) < LEAST_WALL_M and gate.outwards == side.outwards]
        # the ways of a door for both directions have it in common
        doors = sorted({gate.door or gate.foot: (side.run_m(gate.door or gate.foot), gate) for gate in on_it}.values())
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
            if end - start < LEAST_WALL_M:
                continue
            spec = _spec(end - start, fittings, look, door)
            name = f"{'Wall' if door is None else 'Portal'}_{number + 1:02d}_{piece + 1}"
            # the inner face looks to +Z, which is inwards
            inwards = -side.outwards[0], -side.outwards[1]
            walls.append(placed(name, spec, side.at((start + end) / 2), yaw_rad=_yaw_rad(inwards)))
    return walls


def _post(number: int, side: Side, following: Side, fittings: FittingsConfig) -> Placement:
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
        door_width_m=door_width_m(length_m, 2 if door.door else 1),
        door_height_m=round(max(fittings.clear_height_m + DOOR_FRAME_M, height - 2 * _DOOR_HEAD_M), _DIGITS),
        is_entrance=None if door.door else door.kind is LaneKind.ENTRANCE,
    )


def _yaw_rad(direction: Point) -> float:
    """Return the yaw that turns +Z to a direction; exact for quarter turns."""
    x, z = direction
    yaw = math.atan2(x, z)
    quarter = round(yaw / (math.pi / 2))
    if abs(yaw - quarter * math.pi / 2) < 1e-9:  # noqa: PLR2004 - rounding
        return {0: 0.0, 1: math.pi / 2, 2: math.pi, -1: -math.pi / 2, -2: math.pi}[quarter]
    return yaw
