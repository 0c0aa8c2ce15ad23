"""The ground within walls: the inner faces of those around the stalls, with doors closed, and what stands on it."""

import math
from collections.abc import Sequence

import shapely

from garage2usd.garage import Point
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import PortalKind

_CLOSED_M = (0.05, 0.5, 1.5, 3.0)
"""Half the widths of gaps, as of doors, that are closed in turn until walls surround the stalls."""
_HELD = 0.9
"""Share of the stalls that an outline contains."""
_STRAIGHT_M = 0.12
_THIN_M = 0.6
_LEAST_SOLID_M2 = 0.02
_TOUCHES_M = 0.02
_LEAST_COLUMN_M, _MOST_COLUMN_M, _SLENDER = 0.1, 1.6, 4.0


def ground_within(walls: Sequence[shapely.Geometry], stalls: Sequence[shapely.Polygon]) -> shapely.Polygon | None:
    """Return the ground that walls enclose and that holds most stalls, without holes; None if they enclose none.

    Parameters
    ----------
    walls
        Lines of faces of walls, or their footprints, (x, z) in metres.
    stalls
        Ground of each stall.

    Notes
    -----
    The walls are dilated by a structuring element, whose hole is dilated back: a morphological closing.
    """
    if not walls or not stalls:
        return None
    middles = shapely.centroid(list(stalls))
    standing = shapely.union_all(list(walls))
    for half_m in _CLOSED_M:
        wider = shapely.buffer(standing, half_m, cap_style="square", join_style="mitre")
        holes = [shapely.Polygon(ring) for part in shapely.get_parts(wider) for ring in part.interiors]
        for hole in sorted(holes, key=lambda hole: -hole.area):
            grown = shapely.Polygon(hole).buffer(half_m, join_style="mitre")
            free = shapely.get_parts(_bodies(shapely.difference(grown, _bodies(standing))))
            largest = max(free, key=lambda part: part.area, default=shapely.Polygon())
            ground = shapely.Polygon(largest.exterior).simplify(_STRAIGHT_M)
            if ground.is_valid and int(shapely.contains(ground, middles).sum()) >= _HELD * len(stalls):
                return ground
    return None


def solids_within(
    walls: Sequence[shapely.Geometry], ground: shapely.Polygon, stalls: Sequence[shapely.Polygon]
) -> list[shapely.Polygon]:
    """Return the walls, and rooms within walls, that stand on a ground clear of its boundary and of stalls."""
    bodies = shapely.get_parts(shapely.union_all([_bodies(wall) for wall in walls]))
    are_areas = any(wall.geom_type.endswith("Polygon") for wall in walls)
    faces = shapely.polygonize([shapely.union_all(shapely.boundary(list(walls)) if are_areas else list(walls))])
    thin = [face for face in shapely.get_parts(faces) if 2 * face.area < _THIN_M * face.length]
    around = shapely.union_all(list(stalls)) if len(stalls) else shapely.Polygon()
    merged = shapely.get_parts(shapely.union_all([*bodies, *thin]))
    solids = [shapely.Polygon(part.exterior).simplify(_STRAIGHT_M) for part in merged if part.geom_type == "Polygon"]
    return [
        solid
        for solid in solids
        if solid.area > _LEAST_SOLID_M2
        and ground.buffer(-_TOUCHES_M).contains(solid)
        and not around.intersects(solid.buffer(-_TOUCHES_M))
    ]


def sides_m(ground: shapely.Geometry) -> tuple[float, float]:
    """Return the sides in metres of the smallest rectangle around a geometry, the shorter one first."""
    around = shapely.oriented_envelope(ground)
    if around.geom_type != "Polygon":
        return 0.0, float(around.length)
    one, other, third = shapely.get_coordinates(around)[:3]
    short, long = sorted((math.dist(one, other), math.dist(other, third)))
    return short, long


def add_column(parts: SurveyParts, name: str, ground: shapely.Polygon) -> None:
    """Add a column by its footprint; a slender or large one, as a pier of a wall, is a block."""
    short_m, long_m = sides_m(ground)
    if short_m < _LEAST_COLUMN_M:
        return  # a line or a cross where columns are drawn
    if long_m > _MOST_COLUMN_M or long_m > _SLENDER * short_m:
        parts.add_solid(name, ring_of(ground))
    else:
        parts.add_column(name, ground.exterior.coords)


def add_doors(parts: SurveyParts, doors: Sequence[tuple[Point, PortalKind]]) -> None:
    """Add doors; if all of them are entrances, or all exits, cars leave and enter there too."""
    kinds = {kind for _, kind in doors}
    one_kind = len(kinds) == 1 and PortalKind.BOTH not in kinds
    for position, kind in doors:
        parts.add_portal(position, PortalKind.BOTH if one_kind else kind)


def ring_of(ground: shapely.Polygon) -> list[Point]:
    """Return the corners (x, z) of a polygon, without the first one again at the end."""
    return [(float(x), float(z)) for x, z in shapely.get_coordinates(ground.exterior)[:-1]]


def _bodies(shape: shapely.Geometry) -> shapely.Geometry:
    """Return the areas of a geometry."""
    return shapely.union_all([part for part in shapely.get_parts(shape) if part.geom_type == "Polygon"])
