"""The road of a garage as built: its floor, level and sloping on ramps, its portals, and the sides of ramps."""
# Over 300 lines: floors and sides of ramps are measured on the same meshes.

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from garage2usd.as_built.driven_ground import CAR_HEIGHT_M, driven_garage, rounded
from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.openings import Door, is_bent
from garage2usd.as_built.shapes import Array, Face, Thing
from garage2usd.driving import (
    BentFloor,
    DesignCar,
    DrivenRoad,
    Obstacles,
    Portal,
    Pose,
    RampFloor,
    SlopedFloor,
    heights_m,
)
from garage2usd.garage import LaneGraph, LaneKind, LaneNode, Point
from garage2usd.garage.levels import LevelPlace

_GATE, _RAMP = "barrier", "ramp"
_ARM_FROM_M = 0.5
"""Height in metres above which a gate's pieces belong to its arm."""
_UPRIGHT, _LEAST_FACE_M = 0.5, 0.1
_LEAST_FLAT_M = 0.06
"""Length in metres that separates a ramp's lands (longer) from its grooves (narrower)."""
_UNDER_FLOOR_M = 0.01
_LEVEL_SLOPE, _STEEPEST_SLOPE = 0.005, 0.6
_FROM_END_M = 0.5
"""Distance in metres between a car outside the garage and the end of its ramp."""
_FROM_DOOR_M = 0.3
"""Distance in metres between a car and a portal's door without a ramp."""
_DOOR_REACH_M, _RAMP_REACH_M = 1.5, 2.0
_DIGITS = 4
_AXES: tuple[Point, ...] = ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
BEYOND_TOP_M = 1.0
"""Metres beyond the top of a ramp between levels up to which its floor reaches, level."""


class Mouth(NamedTuple):
    """The mouth of a portal: its opening to the outside.

    Attributes
    ----------
    number
        Number of the portal's node.
    outwards
        Unit vector (x, z) along an axis.
    edge_m
        Distance from the node's middle to the edge of its square's clear floor.
    width_m
        Width of the ramp, else of the door's opening, else between the columns.
    ramp
        Floor of the ramp that begins there; None without a ramp.
    """

    number: int
    outwards: Point
    edge_m: float
    width_m: float
    ramp: RampFloor | None

    def top_m(self, middle: Point) -> float:
        """Distance from the node's middle to the end of the road: the ramp's top, else the edge of the floor."""
        if self.ramp is None:
            return self.edge_m
        top = self.ramp.top_m
        return (top[0] - middle[0]) * self.outwards[0] + (top[1] - middle[1]) * self.outwards[1]


def driven_road(level: BuiltLevel, *, car: DesignCar | None = None, height_m: float = CAR_HEIGHT_M) -> DrivenRoad:
    """Find the road through a garage as built.

    Parameters
    ----------
    level
        The level.
    car
        The car.
    height_m
        Height of the car; pieces that begin higher are not obstacles.

    Notes
    -----
    A car starts at the top of the ramp behind a door, half a metre before its end. A door without a ramp is shut; the
    car then starts within the portal's square, 0.3 m from the door. At landings a car that comes up, or drives down,
    may be up to 4 m on a straight ramp, or on the level floor before a helix.
    """
    car = car or DesignCar()
    driven = driven_garage(level, height_m=height_m)
    floors = floors_of_ramps(level.things)
    opened = [thing.name for thing in level.things if thing.label in {_GATE, _RAMP}]
    gates = ((solid.name, solid.footprint) for solid in level.solids.standing(_GATE) if solid.bottom_m < _ARM_FROM_M)
    ramps = [(thing, floors) for thing in level.things if thing.label == _RAMP]
    ramps += [(thing, (*floors, *floors_of_ramps([thing]))) for thing in level.ramps_below]
    sides = ((thing.name, shapely.MultiLineString([*_sides(thing, near, height_m)])) for thing, near in ramps)
    standing = driven.standing.without(opened).joined(Obstacles.of([*gates, *sides]))
    portals = tuple(_portals(level, floors, car))
    return DrivenRoad(driven, standing, portals, floors, keeps_left=level.keeps_left)


def portal_mouths(level: BuiltLevel) -> tuple[Mouth, ...]:
    """Return the mouth of each portal of a garage, in the order of the nodes."""
    return tuple(_mouths(level, floors_of_ramps(level.things)))


def _mouths(level: BuiltLevel, ramps: Sequence[RampFloor]) -> Iterator[Mouth]:
    for number, node in enumerate(level.lanes.nodes):
        if not node.is_portal:
            continue
        door, outwards, edge_m = _outwards(level, number)
        middle = rounded(node.position)
        ramp = next((ramp for ramp in ramps if _is_behind(ramp, middle, outwards, edge_m)), None)
        width_m = node.widths_m[0] if outwards[0] == 0 else node.widths_m[1]
        if ramp is not None:
            width_m = 2 * ramp.half_width_m
        elif door is not None and door.clear_width_m is not None:
            width_m = door.clear_width_m
        yield Mouth(number, outwards, edge_m, width_m, ramp)


def _portals(level: BuiltLevel, ramps: Sequence[RampFloor], car: DesignCar) -> Iterator[Portal]:
    for mouth in _mouths(level, ramps):
        node = level.lanes.nodes[mouth.number]
        is_entrance = node.kind == LaneKind.ENTRANCE
        yaw = math.atan2(mouth.outwards[0] + 0.0, mouth.outwards[1] + 0.0)  # into the garage
        x, z = rounded(node.position)
        end_m = mouth.top_m((x, z)) - (_FROM_DOOR_M if mouth.ramp is None else _FROM_END_M)
        end_m += level.way_beyond_m.get(node.name, 0.0)
        axle_m = end_m - (car.rear_overhang_m if is_entrance else car.ahead_m)
        pose = Pose(x + axle_m * mouth.outwards[0], z + axle_m * mouth.outwards[1], yaw if is_entrance else _about(yaw))
        yield Portal(mouth.number, node.name, LaneKind.ENTRANCE if is_entrance else LaneKind.EXIT, pose)


def _about(yaw_rad: float) -> float:
    turned = yaw_rad + math.pi
    return turned - math.tau if turned > math.pi else turned


def _outwards(level: BuiltLevel, number: int) -> tuple[Door | None, Point, float]:
    """Return a portal's door, its direction along an axis, and the distance to the square's edge there."""
    node = level.lanes.nodes[number]
    if node.name in level.landings:
        return None, level.landings[node.name], _half_m(level, number, level.landings[node.name])
    ways = [(way, door) for door in level.doors if (way := _towards(node, door.position)) is not None]
    if ways:
        (_, outwards), door = min(ways, key=lambda found: found[0])
    else:
        door = None
        ways_in = [
            _axis(level.lanes.nodes[other].position, node.position) for other in sorted(level.lanes.beside[number])
        ]
        taken = {(-x, -z) for x, z in ways_in}
        outwards = next((way for way in (*ways_in, *_AXES) if way not in taken), _AXES[0])
    return door, outwards, _half_m(level, number, outwards)


def _axis(start: Point, end: Point) -> Point:
    """Return the axis direction closest to the vector between two points."""
    dx, dz = end[0] - start[0], end[1] - start[1]
    return (math.copysign(1.0, dx), 0.0) if abs(dx) > abs(dz) else (0.0, math.copysign(1.0, dz))


def _towards(node: LaneNode, door: Point) -> tuple[float, Point] | None:
    """Return distance and direction of a door in the outer wall around a portal; None for a door elsewhere."""
    dx, dz = door[0] - node.position[0], door[1] - node.position[1]
    along, aside, half = (
        (abs(dx), abs(dz), node.widths_m[0]) if abs(dx) > abs(dz) else (abs(dz), abs(dx), node.widths_m[1])
    )
    if aside > _DOOR_REACH_M or along > half / 2 + _DOOR_REACH_M:
        return None
    return along, _axis(node.position, door)


def _half_m(level: BuiltLevel, number: int, outwards: Point) -> float:
    """Return the distance from a portal's middle to the edge of its clear floor."""
    widths = level.lanes.nodes[number].widths_m
    return float(abs(outwards[0]) * widths[0] + abs(outwards[1]) * widths[1]) / 2


def _is_behind(ramp: RampFloor, middle: Point, outwards: Point, edge_m: float) -> bool:
    """Return True if a ramp begins at the edge of a portal's square, in line with the portal."""
    away = ramp.foot_m[0] - middle[0], ramp.foot_m[1] - middle[1]
    along = away[0] * outwards[0] + away[1] * outwards[1] + float(ramp.runs_m[0])
    aside = abs(away[0] * outwards[1] - away[1] * outwards[0])
    in_line = ramp.uphill[0] * outwards[0] + ramp.uphill[1] * outwards[1]
    return in_line > 0.99 and aside < ramp.half_width_m / 2 and abs(along - edge_m) < _RAMP_REACH_M  # noqa: PLR2004


def bent_floors(things: Iterable[Thing]) -> tuple[BentFloor, ...]:
    """Return the floors of all ramps among objects that bend."""
    found = []
    for thing in things:
        sloping = _sloping(thing) if thing.label == _RAMP else []
        if sloping and is_bent(*_rises(sloping)):
            found.append(_triangulated(sloping))
    return tuple(found)


def _triangulated(faces: Iterable[Face]) -> BentFloor:
    """Return the floor of some convex faces."""
    return BentFloor(np.array([np.stack([face[0], *pair]) for _, face in faces for pair in pairwise(face[1:])]))


def _sloping(thing: Thing) -> list[Face]:
    """Return the faces of a ramp that cars can drive over and that are not level."""
    return [face for face in thing.faces() if _is_floor(face) and _slope(face) > _LEVEL_SLOPE]


def _is_floor(face: Face) -> bool:
    return bool(face.normal[1] > _UPRIGHT) and _slope(face) < _STEEPEST_SLOPE


def _slope(face: Face) -> float:
    return math.hypot(face.normal[0], face.normal[2]) / float(face.normal[1])


def _rises(sloping: Sequence[Face]) -> tuple[Array, Array]:
    """Return the directions downhill (x, z) of faces, as long as they are steep, and how high each reaches."""
    return np.array([normal[[0, 2]] for normal, _ in sloping]), np.array([np.ptp(face[:, 1]) for _, face in sloping])


def ramp_sides(things: Iterable[Thing], height_m: float = CAR_HEIGHT_M) -> Obstacles:
    """Return the obstacles to a car that drives over ramps among objects: their walls and the ends of their slabs."""
    ramps = [thing for thing in things if thing.label == _RAMP]
    floors = [(thing, [face for face in thing.faces() if _is_floor(face)]) for thing in ramps]
    return Obstacles.of(
        (thing.name, shapely.MultiLineString([*_sides(thing, [_triangulated(floor)], height_m)]))
        for thing, floor in floors
    )


def floors_of_ramps(things: Iterable[Thing]) -> tuple[RampFloor, ...]:
    """Return the floors of all straight ramps among objects."""
    floors = (_floor(thing) for thing in things if thing.label == _RAMP)
    return tuple(floor for floor in floors if floor is not None)


def _floor(thing: Thing) -> RampFloor | None:
    """Compute the profile of a straight ramp's floor from its upward faces, without grooves; else None."""
    sloping = _sloping(thing)
    if not sloping:
        return None
    downhill, rises = _rises(sloping)
    if is_bent(downhill, rises):
        return None
    uphill = -(downhill * rises[:, None]).sum(axis=0)
    uphill = np.round(uphill / np.linalg.norm(uphill), _DIGITS + 2)
    across = np.array([-uphill[1], uphill[0]])
    # the grooves of a ramp are very many faces
    points = np.concatenate([corners for _, corners in sloping])
    starts = np.cumsum([0, *(len(corners) for _, corners in sloping[:-1])])
    aside, along = points[:, [0, 2]] @ across, points[:, [0, 2]] @ uphill
    low, high = np.minimum.reduceat(aside, starts), np.maximum.reduceat(aside, starts)
    wide_m = float((high - low).max())
    lengths = np.maximum.reduceat(along, starts) - np.minimum.reduceat(along, starts)
    are_floor = (high - low > 0.9 * wide_m) & (lengths > _LEAST_FLAT_M)
    profile: dict[float, float] = {}
    middle = None
    for face in np.flatnonzero(are_floor).tolist():
        own = slice(starts[face], starts[face] + len(sloping[face].corners))
        middle = float(low[face] + high[face]) / 2
        profile.update(
            {
                round(run, _DIGITS): height
                for run, height in zip(along[own].tolist(), points[own, 1].tolist(), strict=True)
            }
        )
    if middle is None:
        return None
    runs = np.array(sorted(profile))
    start = middle * across
    return RampFloor(
        (round(float(start[0]), _DIGITS), round(float(start[1]), _DIGITS)),
        (float(uphill[0]), float(uphill[1])),
        wide_m / 2,
        runs,
        np.array([profile[run] for run in runs.tolist()]),
    )


def _sides(thing: Thing, ramps: Sequence[SlopedFloor], height_m: float) -> Iterator[Array]:
    """Yield the ends (x, z) of each upright face that is an obstacle to a car on the floor or a ramp."""
    for normal, corners in thing.faces():
        if abs(normal[1]) > _UPRIGHT or np.ptp(corners[:, 1]) < _LEAST_FACE_M:
            continue
        flat = corners[:, [0, 2]]
        along = np.array([-normal[2], normal[0]])
        ends = flat[[int((flat @ along).argmin()), int((flat @ along).argmax())]]
        floor = heights_m(ramps, flat[:, 0], flat[:, 1])
        over_m = corners[:, 1] - floor
        # the ends of a slab that reaches up to the floor are in no car's way
        if over_m.min() < height_m and over_m.max() > _UNDER_FLOOR_M:
            yield np.round(ends, _DIGITS)


@dataclass(frozen=True, eq=False)
class DrivenFloor:
    """The floor for driving, in metres, Y up.

    Attributes
    ----------
    level_m
        Height of the garage's floor.
    ramps
        Floors of its ramps.
    """

    level_m: float
    ramps: tuple[SlopedFloor, ...]

    @classmethod
    def of_levels(
        cls, levels: Sequence[LevelPlace], lanes: LaneGraph, things: Iterable[Thing]
    ) -> "tuple[DrivenFloor, ...]":
        """Find the floor of each level among the objects of all, by the paths of these; ramps belong to their foot."""
        named = list(things)
        floors = []
        for number, level in enumerate(levels):
            own = [thing for thing in named if thing.name.startswith(f"{level.path}/")]
            ramps = floors_of_ramps(own)
            if number:  # those of the top level lead to the street and go on
                ramps = tuple(replace(ramp, end_m=float(ramp.runs_m[-1]) + BEYOND_TOP_M) for ramp in ramps)
            floor_m = lanes.floor_m() if level.is_only else level.floor_m
            floors.append(cls(floor_m, (*ramps, *bent_floors(own))))
        return tuple(floors)

    def heights_m(self, x_m: ArrayLike, z_m: ArrayLike) -> NDArray[np.float64]:
        """Return the floor's heights at points; float64, their shape."""
        return heights_m(self.ramps, x_m, z_m, level_m=self.level_m)
