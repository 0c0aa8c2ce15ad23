"""Footprints of obstacles between two heights, and the floor polygons of a garage."""

from collections.abc import Iterator

import numpy as np
import shapely

from garage2usd.as_built import BuiltLevel
from garage2usd.as_built.driven_road import floors_of_ramps
from garage2usd.as_built.openings import section_of
from garage2usd.as_built.placed_pieces import placed_pieces
from garage2usd.as_built.shapes import Body, Thing
from garage2usd.common.errors import StageError
from garage2usd.layout.grounds import Grounds, hulls_of

__all__ = ["floor_of", "occupied_ground", "ramp_floors"]

_DOOR, _RAMP, _FLOOR, _DRIVEN_OVER = "vehicle_door", "ramp", "floor", "speed_bump"
_TOUCH_M = 1e-4
"""Distance below which section lines belong to one body."""
_CARRIED_M = 1e-3
"""Greatest height above a ramp's floor of a body that carries it."""
_LEAST_UP = 0.1
"""Least upward component of a floor face's normal, which allows ramps with grooves."""


def floor_of(level: BuiltLevel) -> Grounds:
    """Return the polygons of the garage's floors and ramps, (x, z) in metres.

    Raises
    ------
    StageError
        If no object is labelled as a floor, so that the garage's extent is unknown.
    """
    bodies = list(_bodies(level, _FLOOR))
    if not bodies:
        raise StageError(level.source, "nothing in it has the class floor, so that nothing says where it ends")
    tiles = placed_pieces(bodies, np.array([not body.shape.is_dented for body in bodies])).hulls
    return np.array([*tiles, *ramp_floors(level)], dtype=object)


def ramp_floors(level: BuiltLevel) -> Grounds:
    """Return the floor polygon of each ramp."""
    sheets = (body for body in _bodies(level, _RAMP) if _is_sheet(body))
    return hulls_of([body.world_points()[:, [0, 2]] for body in sheets])


def occupied_ground(level: BuiltLevel, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Yield convex footprints of all solids between two heights, (x, z) in metres.

    Notes
    -----
    Solids are those of `garage2usd.as_built.solids.Solids`, without speed bumps, which cars drive over. A vehicle door
    is represented by its sections at every height where its shape changes, since its convex hull would close it. Ramps
    are included without their floors and the slabs that carry these.
    """
    for solid in level.solids.between(low_m, high_m):
        if solid.label not in {_DOOR, _RAMP, _DRIVEN_OVER}:
            yield solid.footprint
    for thing in level.things:
        if thing.label == _DOOR:
            yield from _sections(thing, low_m, high_m)
    for thing in level.things:
        if thing.label == _RAMP:
            for body in _beside_floor(thing):
                pieces = body.pieces()
                yield from hulls_of([outline for outline, low, high in pieces if low <= high_m and high >= low_m])


def _bodies(level: BuiltLevel, label: str) -> Iterator[Body]:
    return (body for thing in level.things if thing.label == label for body in thing.bodies)


def _is_sheet(body: Body) -> bool:
    """Test if all faces of a body look up, as those of a floor."""
    return all(face.normal[1] >= _LEAST_UP for face in body.faces())


def _beside_floor(ramp: Thing) -> Iterator[Body]:
    """Yield the bodies of a ramp that rise above its floor."""
    floors = floors_of_ramps([ramp])
    for body in ramp.bodies:
        points = body.world_points()
        lifts = [
            points[:, 1] - np.interp((points[:, [0, 2]] - floor.foot_m) @ floor.uphill, floor.runs_m, floor.heights_m)
            for floor in floors
        ]
        if not (_is_sheet(body) or any(lift.max() <= _CARRIED_M for lift in lifts)):
            yield body


def _sections(thing: Thing, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Yield the convex outlines of an object's horizontal sections, one between each two heights of its points."""
    heights = np.unique(np.concatenate([body.world_points()[:, 1].clip(low_m, high_m) for body in thing.bodies]))
    for level in ((heights[1:] + heights[:-1]) / 2).tolist():
        lines = [shapely.LineString(cut) for cut in section_of(thing, level) if len(cut) > 1]
        joined = shapely.union_all(shapely.buffer(lines, _TOUCH_M)) if lines else shapely.GeometryCollection()
        yield from (part.convex_hull for part in shapely.get_parts(joined))
