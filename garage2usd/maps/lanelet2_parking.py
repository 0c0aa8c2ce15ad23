"""Stalls of a Lanelet2 map: parking areas, Autoware's parking spaces, access areas and parking lots."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltGarage
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.layout.grounds import Grounds, grounds_of
from garage2usd.maps.frame import map_points
from garage2usd.maps.lane_bounds import Bound, LaneBounds
from garage2usd.maps.osm_file import Member, OsmFile, Place
from garage2usd.maps.xml_text import number_text

__all__ = ["Feet", "add_lots", "add_stalls"]

Floats = NDArray[np.float64]

_MOST_ASIDE = 2.0
"""Ratio of distance ahead to distance beside a corner above which a lane bends away."""
_GRID_M = 1e-4
"""Grid in metres to which outlines are rounded before their union."""
_GAP_M, _WRITTEN_DIGITS = 2e-3, 3
_VEHICLES = "participant:vehicle"
_PARTICIPANTS = {StallUse.MOTORCYCLE: "participant:vehicle:motorcycle"}
_BEHIND_M = 1e-3
"""Distance inside the stall from which the lane is searched, for entries that touch the lane."""


class _Foot(NamedTuple):
    """The point of a lane bound ahead of a stall corner: position, bound and distance along it.

    Feet on the ends of lanes have no bound.
    """

    place: Place
    bound: Bound | None
    run_m: float


class Feet:
    """Points on lane bounds at which the access areas of stalls end.

    Parameters
    ----------
    lanes
        All lanes; lanes that are not level are ignored.
    """

    def __init__(self, lanes: Sequence[LaneBounds]) -> None:
        self._bounds: list[Bound | None] = []
        lines: list[shapely.LineString] = []
        for lane in lanes:
            if any(place[2] for place in lane.left.places):
                continue
            ends = ([side.places[end] for side in (lane.left, lane.right)] for end in (0, -1))
            for bound, places in (*((bound, bound.places) for bound in lane.outer), *((None, end) for end in ends)):
                self._bounds.append(bound)
                lines.append(shapely.LineString([place[:2] for place in places]))
        self._tree = shapely.STRtree(lines)
        self._on: dict[Bound, dict[float, Place]] = {}
        self._runs: dict[Bound, list[float]] = {}
        self.grounds: Grounds = np.empty(0, dtype=object)
        """Outlines of the stalls for cars and of their access areas."""

    def before(self, mouths: Floats, ahead: Floats) -> list[list[Place]]:
        """Find the lane bound in front of stall entries, from right to left; empty if all lanes are ramps.

        Parameters
        ----------
        mouths
            Left and right corner of each entry; shape (n, 2, 2).
        ahead
            Unit vectors out of the stalls; shape (n, 2).
        """
        if not len(self._tree):
            return [[] for _ in mouths]
        feet = self._feet(mouths[:, ::-1].reshape(-1, 2), np.repeat(ahead, 2, axis=0))
        found = [self._between(*pair) for pair in zip(feet[::2], feet[1::2], strict=True)]
        rings = [
            [*mouth, *(place[:2] for place in places)] for mouth, places in zip(mouths.tolist(), found, strict=True)
        ]
        # beside a junction the lanes ahead of both corners may lie askew: the area then ends in a point
        crossed = np.flatnonzero(~shapely.is_valid(grounds_of(rings)))
        for number, foot in zip(crossed, self._feet(mouths[crossed].mean(axis=1), ahead[crossed]), strict=True):
            found[number] = [foot.place]
        return found

    def _between(self, right: _Foot, left: _Foot) -> list[Place]:
        """Return the points of a lane bound between two feet."""
        bound = right.bound
        if bound is None or bound is not left.bound:
            return [right.place, left.place]
        low_m, high_m = sorted((right.run_m, left.run_m))
        runs = zip(bound.places, self._runs_of(bound), strict=True)
        between = [place for place, run_m in runs if low_m < run_m < high_m]
        return [right.place, *(between if right.run_m < left.run_m else reversed(between)), left.place]

    def along(self, bound: Bound) -> list[Place]:
        """Return the points of a lane bound, including feet."""
        feet = self._on.get(bound)
        if not feet:
            return bound.places
        runs = dict(zip(self._runs_of(bound)[1:-1], bound.places[1:-1], strict=True))
        inner = sorted({**runs, **feet}.items())
        return [bound.places[0], *(place for _, place in inner), bound.places[-1]]

    def _runs_of(self, bound: Bound) -> list[float]:
        """Return the distance along a lane bound of each of its points."""
        if bound not in self._runs:
            flat = [place[:2] for place in bound.places]
            self._runs[bound] = shapely.line_locate_point(shapely.LineString(flat), shapely.points(flat)).tolist()
        return self._runs[bound]

    def _feet(self, corners: Floats, ahead: Floats) -> list[_Foot]:
        """Find the lane ahead of corners, or the nearest point of the lane where it bends away."""
        lines = self._tree.geometries
        starts = shapely.points(corners - _BEHIND_M * ahead)
        nearest = self._tree.nearest(starts)
        reach_m = _MOST_ASIDE * shapely.distance(lines[nearest], starts)
        rays = shapely.linestrings(np.stack([shapely.get_coordinates(starts), corners + reach_m[:, None] * ahead], 1))
        corner, crossed = self._tree.query(rays, predicate="intersects")
        # where none is crossed, the way leads to the nearest
        missed = np.setdiff1d(np.arange(len(corners)), corner)
        aims = np.concatenate([shapely.intersection(lines[crossed], rays[corner]), lines[nearest[missed]]])
        corner, line = np.concatenate([corner, missed]), np.concatenate([crossed, nearest[missed]])
        ways = shapely.shortest_line(starts[corner], aims)
        order = np.lexsort((line, np.round(shapely.length(ways) / _GRID_M), corner))
        order = order[np.unique(corner[order], return_index=True)[1]]
        ends = shapely.get_point(ways[order], 1)
        runs_m = shapely.line_locate_point(lines[line[order]], ends)
        feet = []
        for (x, y), index, run_m in zip(
            shapely.get_coordinates(ends).tolist(), line[order].tolist(), runs_m.tolist(), strict=True
        ):
            foot = _Foot((x, y, 0.0), self._bounds[index], run_m)
            if foot.bound is not None:
                self._on.setdefault(foot.bound, {})[run_m] = foot.place
            feet.append(foot)
        return feet


def add_stalls(osm: OsmFile, garage: BuiltGarage, lanes: Sequence[LaneBounds]) -> Feet:
    """Write all stalls to a Lanelet2 map.

    A stall for cars is an area of the subtype `parking` around its corners, and Autoware's parking space: a way from
    the middle of its entry to the middle of its rear, and in a parallel stall from end to end, with its width. The
    ground between entry and lane is an area of the subtype `parking_access`, whose corners are points of the lane bound
    and of the stall. Hatched ground is a polygon of Autoware's type for it.
    """
    taken = garage.taken_stalls
    feet = Feet(lanes)
    parking = [stall for stall in garage.stalls if stall.is_parked_in]
    mouths = map_points([stall.corners[:2] for stall in parking]).reshape(-1, 2, 2)
    outwards = map_points([stall.outwards for stall in parking]).reshape(-1, 2)
    before_of = dict(zip(parking, feet.before(mouths, outwards), strict=True))
    corners_of: Floats = map_points([stall.corners for stall in garage.stalls]).reshape(-1, 4, 2)
    # along the car: from mouth to rear, and in a parallel stall from one side to the other
    first = np.array([int(stall.kind is StallKind.PARALLEL) for stall in garage.stalls], dtype=np.intp)
    order = (first[:, None] + np.arange(4)) % 4
    along: Floats = np.take_along_axis(corners_of, order[:, :, None], axis=1)
    ends_of = along.reshape(-1, 2, 2, 2).mean(axis=2).tolist()
    widths_m = [stall.width_m for stall in garage.stalls]
    grounds = []
    for stall, corners, ends, width_m in zip(garage.stalls, corners_of.tolist(), ends_of, widths_m, strict=True):
        points = [osm.point((x, y, 0.0)) for x, y in corners]
        tags = _stall_tags(stall, is_taken=stall in taken)
        if not stall.is_parked_in:
            osm.polygon(points, {"type": "hatched_road_markings", **tags})
            continue
        sides = [_side(osm, points[index], points[(index + 1) % 4], is_open=index == 0) for index in range(4)]
        participant = _PARTICIPANTS.get(stall.use, _VEHICLES)
        _area(osm, sides, {"subtype": "parking", **tags}, participant)
        middle = [osm.point((x, y, 0.0)) for x, y in ends]
        osm.new_way(middle, {"type": "parking_space", "width": number_text(width_m), **tags})
        grounds.append(corners)
        before = before_of[stall]
        lane = osm.points(before)
        around = [(points[0], points[1]), (points[1], lane[0]), lane, (lane[-1], points[0])] if lane else []
        ways = [_side(osm, *line, is_open=True) for line in around if len(set(line)) > 1]
        if len(ways) > 2:  # noqa: PLR2004 - else the mouth lies on the lane
            _area(osm, ways, {"subtype": "parking_access"}, participant)
            grounds.append([*corners[:2], *(place[:2] for place in before)])
    feet.grounds = grounds_of(grounds)
    return feet


def add_lots(osm: OsmFile, lanes: Sequence[LaneBounds], feet: Feet) -> None:
    """Write the ground of stalls and level lanes as Autoware's parking lots.

    Autoware parks only if car and goal lie within one lot, so lots include the lanes.
    """
    level = grounds_of([lane.ground for lane in lanes if not any(place[2] for place in lane.left.places)])
    # lanes cross each other; stalls and what is before them share whole sides, by which they are joined far sooner
    are_apart = shapely.coverage_is_valid(feet.grounds)
    stalls = shapely.coverage_union_all(feet.grounds) if are_apart else shapely.union_all(_valid(feet.grounds))
    ground = shapely.union(*_valid([shapely.union_all(_valid(level)), stalls]), grid_size=_GRID_M)
    for part in shapely.get_parts(ground):
        if shapely.intersects(part, feet.grounds).any():
            corners = shapely.get_coordinates(shapely.normalize(_simple(part)).exterior)[:-1].tolist()
            osm.polygon(osm.points((x, y, 0.0) for x, y in corners), {"type": "parking_lot"})


def _simple(ground: shapely.Polygon) -> shapely.Polygon:
    """Return a polygon whose outline does not cross itself in the digits of a map, closing narrow gaps if needed."""
    written = shapely.Polygon(shapely.get_coordinates(ground.exterior).round(_WRITTEN_DIGITS))
    if written.is_valid:
        return ground
    closed = ground.buffer(_GAP_M, join_style="mitre").buffer(-_GAP_M, join_style="mitre")
    return max(shapely.get_parts(shapely.set_precision(closed, _GRID_M)), key=lambda part: part.area)


def _valid(grounds: Sequence[shapely.Geometry] | Grounds) -> Grounds:
    valid: Grounds = shapely.make_valid(grounds)
    return valid


def _stall_tags(stall: Stall, *, is_taken: bool) -> dict[str, str]:
    numbered = {} if stall.number is None else {"ref": str(stall.number)}
    return {"name": stall.name, **numbered, "use": str(stall.use), "occupied": "yes" if is_taken else "no"}


def _side(osm: OsmFile, *points: int, is_open: bool) -> int:
    return osm.way(points, {"type": "virtual"} if is_open else {"type": "line_thin", "subtype": "solid"})


def _area(osm: OsmFile, ways: Sequence[int], tags: dict[str, str], participant: str) -> None:
    members = [Member("way", way, "outer") for way in ways]
    osm.relation(members, {"type": "multipolygon", **tags, "location": "urban", participant: "yes"})
