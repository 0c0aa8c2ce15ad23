"""Centre lines of lanes, and their extension to the corners and junctions that they stop short of."""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import shapely

from garage2usd.garage import Point

__all__ = ["SAME_M", "CentreLine", "joined_lines"]

SAME_M = 0.75
"""Distance in metres up to which ends and crossings of centre lines are one node."""
_GAP_M = 1.0
"""Gap in metres beyond half a lane's width up to which the end of a centre line joins the next one."""
_AHEAD_M = 8.0
"""Gap in metres straight ahead of its end up to which a centre line joins the next one, where no stall lies between."""


class CentreLine(NamedTuple):
    """A centre line, the width of its lane in metres, and True if cars drive along it only."""

    line: shapely.LineString
    width_m: float
    one_way: bool


def joined_lines(lines: Sequence[CentreLine], grounds: shapely.STRtree) -> list[CentreLine]:
    """Extend the ends of centre lines that stop short of another one."""
    joined = []
    for number, each in enumerate(lines):
        points = list(each.line.coords)
        others = [other for index, other in enumerate(lines) if index != number]
        for place in (0, -1):
            end = shapely.Point(points[place])
            if any(other.line.distance(end) <= SAME_M for other in others):
                continue
            near = [other for other in others if other.line.distance(end) <= other.width_m / 2 + _GAP_M]
            if near:
                other = min(near, key=lambda found: found.line.distance(end))
                foot = other.line.interpolate(other.line.project(end)).coords[0]
            else:
                foot = _ahead(_ends(each.line)[place], others, grounds)
            if foot is not None:
                points.insert(0 if place == 0 else len(points), foot)
        joined.append(each._replace(line=shapely.LineString(points)))
    return joined


def _ahead(points: Sequence[Point], others: Iterable[CentreLine], grounds: shapely.STRtree) -> Point | None:
    """Return the nearest place on another centre line straight ahead of the end of one; None without one."""
    end, ray = shapely.Point(points[-1]), _ray(points)
    met = [other.line.intersection(ray) for other in others if other.line.intersects(ray)]
    # two lines that both stop short of their corner meet in it
    corners = [ray.intersection(_ray(points)) for other in others for points in _ends(other.line)]
    met += [corner for corner in corners if corner.geom_type == "Point" and not corner.is_empty]
    if not met:
        return None
    way = shapely.shortest_line(end, min(met, key=end.distance))
    foot = shapely.Point(way.coords[-1])
    if len(grounds) and len(grounds.query(way, predicate="intersects")):
        return None
    return float(foot.x), float(foot.y)


def _ends(line: shapely.LineString) -> tuple[Sequence[Point], Sequence[Point]]:
    """Return the points of a line towards each of its ends."""
    points = list(line.coords)
    return points[::-1], points


def _ray(points: Sequence[Point]) -> shapely.LineString:
    """Return the line straight ahead of the last of some points."""
    (x, z), (end_x, end_z) = points[-2:]
    scale = _AHEAD_M / math.dist((x, z), (end_x, end_z))
    return shapely.LineString([(end_x, end_z), (end_x + (end_x - x) * scale, end_z + (end_z - z) * scale)])
