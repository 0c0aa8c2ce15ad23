"""What the floor of a garage holds between two heights, as polygons on the ground."""

from collections.abc import Iterator

import numpy as np
import shapely

from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.openings import section_of
from garage2usd.as_built.placed_pieces import placed_pieces
from garage2usd.as_built.shapes import Body, Thing
from garage2usd.common.errors import StageError
from garage2usd.layout.grounds import Grounds, hulls_of

__all__ = ["floor_of", "occupied_ground", "ramp_floors"]

_DOOR, _RAMP, _FLOOR, _DRIVEN_OVER = "vehicle_door", "ramp", "floor", "speed_bump"
_TOUCH_M = 1e-4
"""Lines of a section that come nearer to each other belong to one body."""
_LEAST_UP = 0.1
"""Of the normals of a floor's faces, which may be ramps with grooves."""


def floor_of(garage: BuiltGarage) -> Grounds:
    """The grounds that the garage's floors and ramps take, (x, z) in metres.

    Raises
    ------
    StageError
        If nothing is labelled as a floor: then nothing says where the garage ends.
    """
    bodies = list(_bodies(garage, _FLOOR))
    if not bodies:
        raise StageError(garage.source, "nothing in it has the class floor, so that nothing says where it ends")
    tiles = placed_pieces(bodies, np.array([not body.shape.is_dented for body in bodies])).hulls
    return np.array([*tiles, *ramp_floors(garage)], dtype=object)


def ramp_floors(garage: BuiltGarage) -> Grounds:
    """The ground that the floor of each ramp takes."""
    sheets = (body for body in _bodies(garage, _RAMP) if _is_sheet(body))
    return hulls_of([body.world_points()[:, [0, 2]] for body in sheets])


def occupied_ground(garage: BuiltGarage, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Convex outlines of all between two heights, to which it reaches at least, (x, z) in metres.

    Notes
    -----
    What counts is what `garage2usd.as_built.solids.Solids` takes as solid, less speed bumps, which cars drive over. A
    vehicle door counts by its sections at every height where its form changes, as its convex outline would shut it;
    ramps count without their floors.
    """
    for solid in garage.solids.between(low_m, high_m):
        if solid.label not in {_DOOR, _RAMP, _DRIVEN_OVER}:
            yield solid.footprint
    for thing in garage.things:
        if thing.label == _DOOR:
            yield from _sections(thing, low_m, high_m)
    for body in _bodies(garage, _RAMP):
        if not _is_sheet(body):
            yield from hulls_of([outline for outline, low, high in body.pieces() if low <= high_m and high >= low_m])


def _bodies(garage: BuiltGarage, label: str) -> Iterator[Body]:
    return (body for thing in garage.things if thing.label == label for body in thing.bodies)


def _is_sheet(body: Body) -> bool:
    """Whether all faces look up, so that it is driven on."""
    return all(face.normal[1] >= _LEAST_UP for face in body.faces())


def _sections(thing: Thing, low_m: float, high_m: float) -> Iterator[shapely.Geometry]:
    """Convex outlines of the parts of an object that level planes cut, one between each two heights of its points."""
    heights = np.unique(np.concatenate([body.world_points()[:, 1].clip(low_m, high_m) for body in thing.bodies]))
    for level in ((heights[1:] + heights[:-1]) / 2).tolist():
        lines = [shapely.LineString(cut) for cut in section_of(thing, level) if len(cut) > 1]
        joined = shapely.union_all(shapely.buffer(lines, _TOUCH_M)) if lines else shapely.GeometryCollection()
        yield from (part.convex_hull for part in shapely.get_parts(joined))
