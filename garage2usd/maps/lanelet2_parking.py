"""Stalls of a Lanelet2 map: parking areas, Autoware's parking spaces, access areas and parking lots."""
# Over 300 lines: all forms of a stall share its corners and the points of the lane before it.

import itertools
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltLevel
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.layout.grounds import Grounds, grounds_of
from garage2usd.maps.frame import map_points
from garage2usd.maps.lane_bounds import Bound, LaneBounds
from garage2usd.maps.osm_file import Member, OsmFile, Place
from garage2usd.maps.xml_text import number_text

Floats = NDArray[np.float64]
_MOST_ASIDE = 2.0
"""Ratio of distance ahead to distance beside a corner above which a lane bends away."""
_GRID_M = 1e-4
"""Grid in metres to which outlines are rounded before their union."""
_MOST_ROUNDS = 5
"""Greatest number of times that an outline is made valid; points that are merged may lead it over itself again."""
_FLAT_M2 = 1e-6
"""Greatest area of the ground before a stall whose entry lies on its lane."""
_VEHICLES = "participant:vehicle"
_PARTICIPANTS = {StallUse.MOTORCYCLE: "participant:vehicle:motorcycle"}
_STEP_M, _MOST_STEPS = 0.01, 20
"""Step, and number of steps, in which a foot is moved along its lane bound away from points of others."""
_BEHIND_M = 1e-3
"""Distance inside the stall from which the lane is searched, for entries that touch the lane."""


class _Foot(NamedTuple):
    """The point of a lane bound ahead of a stall corner: its id, the bound and the distance along it.

    Feet on the ends of lanes have no bound.
    """

    point: int
    bound: Bound | None
    run_m: float


class _StallPoints(NamedTuple):
    """The corners of a stall and the ends of its parking space, by their ids."""

    corners: list[int]
    ends: list[int]


class Feet:
    """Points on lane bounds at which the access areas of stalls end.

    Parameters
    ----------
    osm
        The map.
    lanes
        All lanes; lanes that are not level are ignored.
    corners
        Ids of the corners of stalls, with which feet are merged.
    """

    def __init__(self, osm: OsmFile, lanes: Sequence[LaneBounds], corners: Iterable[int] = ()) -> None:
        self._osm, self._corners = osm, frozenset(corners)
        self._bounds: list[Bound | None] = []
        self._points: list[set[int]] = []
        """Ids of the points of each line, with the feet on it."""
        lines: list[shapely.LineString] = []
        own: dict[Bound, set[int]] = {}
        for lane in lanes:
            if not lane.is_level:
                continue
            sides = lane.left, lane.right
            ends = ((None, [side.points[end] for side in sides]) for end in (0, -1))
            for bound, points in (*((bound, bound.points) for bound in lane.outer), *ends):
                self._bounds.append(bound)
                self._points.append(set(points) if bound is None else own.setdefault(bound, set(points)))
                lines.append(shapely.LineString([osm.place(point)[:2] for point in points]))
        self._tree = shapely.STRtree(lines)
        self._on: dict[Bound, dict[float, int]] = {}
        self._runs: dict[Bound, list[float]] = {}
        self.grounds: Grounds = np.empty(0, dtype=object)
        """Outlines of the stalls for cars and of their access areas."""

    def before(self, mouths: Floats, ahead: Floats) -> list[tuple[int, ...]]:
        """Find the points of the lane bound in front of stall entries, from right to left; none if all lanes are ramps.

        Parameters
        ----------
        mouths
            Left and right corner of each entry; shape (n, 2, 2).
        ahead
            Unit vectors out of the stalls; shape (n, 2).
        """
        if not len(self._tree):
            return [() for _ in mouths]
        feet = self._feet(mouths[:, ::-1].reshape(-1, 2), np.repeat(ahead, 2, axis=0))
        found = [self._between(*pair) for pair in zip(feet[::2], feet[1::2], strict=True)]
        rings = [[*mouth, *self.flat(points)] for mouth, points in zip(mouths.tolist(), found, strict=True)]
        # beside a junction the lanes ahead of both corners may lie askew: the area then ends in a point
        grounds = grounds_of(rings)
        is_flat = shapely.area(shapely.convex_hull(grounds)) < _FLAT_M2  # the entry lies on the lane
        crossed = np.flatnonzero(~shapely.is_valid(grounds) & ~is_flat)
        for number, foot in zip(crossed, self._feet(mouths[crossed].mean(axis=1), ahead[crossed]), strict=True):
            found[number] = (foot.point,)
        return found

    def flat(self, points: Iterable[int]) -> list[tuple[float, float]]:
        """Return the positions (x, y) of points."""
        return [self._osm.place(point)[:2] for point in points]

    def _between(self, right: _Foot, left: _Foot) -> tuple[int, ...]:
        """Return the points of a lane bound from one foot to another."""
        bound, between = right.bound, []
        if bound is not None and bound is left.bound:
            low_m, high_m = sorted((right.run_m, left.run_m))
            runs = zip(bound.points, self._runs_of(bound), strict=True)
            between = [point for point, run_m in runs if low_m < run_m < high_m]
        points = right.point, *(between if right.run_m < left.run_m else reversed(between)), left.point
        return tuple(dict.fromkeys(points))

    def along(self, bound: Bound) -> list[int]:
        """Return the points of a lane bound, including feet."""
        first, *inner, last = bound.points
        runs = dict(zip(self._runs_of(bound)[1:-1], inner, strict=True))
        feet = self._on.get(bound, {})
        return [first, *(point for _, point in sorted({**runs, **feet}.items())), last]

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
        # without a crossed line, aim at the nearest one
        missed = np.setdiff1d(np.arange(len(corners)), corner)
        aims = np.concatenate([shapely.intersection(lines[crossed], rays[corner]), lines[nearest[missed]]])
        corner, line = np.concatenate([corner, missed]), np.concatenate([crossed, nearest[missed]])
        ways = shapely.shortest_line(starts[corner], aims)
        order = np.lexsort((line, np.round(shapely.length(ways) / _GRID_M), corner))
        order = order[np.unique(corner[order], return_index=True)[1]]
        ends = shapely.get_point(ways[order], 1)
        runs_m = shapely.line_locate_point(lines[line[order]], ends)
        return [self._foot(index, run_m) for index, run_m in zip(line[order].tolist(), runs_m.tolist(), strict=True)]

    def _foot(self, index: int, run_m: float) -> _Foot:
        """Add the foot at a distance along a line, away from points of other lines, or return the one that is near."""
        line, bound, own = self._tree.geometries[index], self._bounds[index], self._points[index]
        for step, sign in itertools.product(range(_MOST_STEPS), (1, -1)):
            run = run_m + sign * step * _STEP_M
            place = _along(line, run)
            point = self._osm.near(place)
            if point in own:
                return _Foot(point, bound, run)
            if (point is None or point in self._corners) and 0.0 <= run <= line.length:
                break
        else:
            run, bound, place = run_m, None, _along(line, run_m)
        point = self._osm.point(place)
        if bound is not None:
            own.add(point)
            self._on.setdefault(bound, {})[run] = point
        return _Foot(point, bound, run)


def _along(line: shapely.LineString, run_m: float) -> Place:
    """Return the point at a distance along a line, or at its end."""
    point = line.interpolate(min(max(run_m, 0.0), line.length))
    return point.x, point.y, 0.0


def stall_points(osm: OsmFile, level: BuiltLevel) -> list[_StallPoints]:
    """Add the corners of all stalls and the ends of their parking spaces to a map, before all other points."""
    corners_of: Floats = map_points([stall.corners for stall in level.stalls]).reshape(-1, 4, 2)
    # along the car: from mouth to rear or, in a parallel stall, from side to side
    first = np.array([int(stall.kind is StallKind.PARALLEL) for stall in level.stalls], dtype=np.intp)
    order = (first[:, None] + np.arange(4)) % 4
    along: Floats = np.take_along_axis(corners_of, order[:, :, None], axis=1)
    ends_of: Floats = along.reshape(-1, 2, 2, 2).mean(axis=2)
    corners = [[osm.point((x, y, 0.0)) for x, y in corners] for corners in corners_of.tolist()]
    ends = [[osm.point((x, y, 0.0)) for x, y in ends] for ends in ends_of.tolist()]
    return [_StallPoints(*points) for points in zip(corners, ends, strict=True)]


def add_stalls(
    osm: OsmFile,
    level: BuiltLevel,
    lanes: Sequence[LaneBounds],
    stall_points: Sequence[_StallPoints],
    *,
    only_spaces: bool = False,
) -> Feet:
    """Write all stalls to a Lanelet2 map.

    A stall for cars is an area of the subtype `parking` around its corners, and Autoware's parking space: a way from
    the middle of its entry to the middle of its rear, and in a parallel stall from end to end, with its width. The
    ground between entry and lane is an area of the subtype `parking_access`, whose corners are points of the lane bound
    and of the stall. Hatched ground is a polygon of Autoware's type for it. With `only_spaces` the map has parking
    spaces alone, with the stall's orientation as subtype: Autoware reads no areas, and drives over hatched ground.
    """
    taken = level.taken_stalls
    points_of = dict(zip(level.stalls, stall_points, strict=True))
    feet = Feet(osm, lanes, (point for points in stall_points for point in points.corners))
    parking = [stall for stall in level.stalls if stall.is_parked_in]
    mouths = map_points([stall.corners[:2] for stall in parking]).reshape(-1, 2, 2)
    outwards = map_points([stall.outwards for stall in parking]).reshape(-1, 2)
    before_of = dict(zip(parking, feet.before(mouths, outwards), strict=True))
    grounds = []
    for stall, (corners, ends) in points_of.items():
        tags = _stall_tags(stall, level, is_taken=stall in taken)
        if not stall.is_parked_in:
            if not only_spaces:
                osm.polygon(corners, {"type": "hatched_road_markings", **tags})
            continue
        grounds.append(feet.flat(corners))
        if only_spaces:
            osm.new_way(ends, _space_tags(stall, {"subtype": str(stall.kind), **tags}))
            if len({*corners[:2], *before_of[stall]}) > 3:  # noqa: PLR2004 - else the mouth lies on the lane
                grounds.append(feet.flat([*corners[:2], *before_of[stall]]))
            continue
        sides = [_side(osm, corners[index], corners[(index + 1) % 4], is_open=index == 0) for index in range(4)]
        participant = _PARTICIPANTS.get(stall.use, _VEHICLES)
        _area(osm, sides, {"subtype": "parking", **tags}, participant)
        osm.new_way(ends, _space_tags(stall, tags))
        lane = before_of[stall]
        around = [corners[:2], (corners[1], lane[0]), lane, (lane[-1], corners[0])] if lane else []
        ways = [_side(osm, *line, is_open=True) for line in around if len(set(line)) > 1]
        if len(ways) > 2:  # noqa: PLR2004 - else the mouth lies on the lane
            _area(osm, ways, {"subtype": "parking_access"}, participant)
            grounds.append(feet.flat([*corners[:2], *lane]))
    feet.grounds = grounds_of(grounds)
    return feet


def add_lots(osm: OsmFile, lanes: Sequence[LaneBounds], feet: Feet) -> None:
    """Write the ground of stalls and level lanes as Autoware's parking lots.

    Autoware parks only if car and goal lie within one lot, so lots include the lanes.
    """
    level = grounds_of([lane.ground for lane in lanes if lane.is_level])
    # stalls and the ground before them share whole sides, which makes their union much faster than that of lanes
    are_apart = shapely.coverage_is_valid(feet.grounds)
    stalls = shapely.coverage_union_all(feet.grounds) if are_apart else shapely.union_all(_valid(feet.grounds))
    ground = shapely.union(*_valid([shapely.union_all(_valid(level)), stalls]), grid_size=_GRID_M)
    for part in shapely.get_parts(ground):
        if shapely.intersects(part, feet.grounds).any():
            osm.polygon(_outline(osm, part), {"type": "parking_lot"})


def _outline(osm: OsmFile, ground: shapely.Polygon) -> list[int]:
    """Add the points of an outline that does not cross itself, closing gaps narrower than the points of a map allow."""
    for _ in range(_MOST_ROUNDS):
        corners = shapely.get_coordinates(shapely.normalize(ground).exterior)[:-1].tolist()
        points = _without_spikes([osm.point((x, y, 0.0)) for x, y in corners])
        merged = shapely.Polygon([osm.place(point)[:2] for point in points])
        if merged.is_valid:
            break
        parts = shapely.get_parts(shapely.make_valid(merged, method="structure", keep_collapsed=False))
        ground = max(parts, key=lambda part: part.area)
    return points


def _without_spikes(points: Sequence[int]) -> list[int]:
    """Return the points of a ring without repetitions and without spikes."""
    ring: list[int] = []
    for point in points:
        if ring and point == ring[-1]:
            continue
        if len(ring) > 1 and point == ring[-2]:
            ring.pop()
        else:
            ring.append(point)
    while len(ring) > 1 and (ring[0] in ring[-2:] or ring[1] == ring[-1]):  # likewise at the start of the ring
        if ring[1] == ring[-1]:
            del ring[0]
        else:
            ring.pop()
    return ring


def _valid(grounds: Sequence[shapely.Geometry] | Grounds) -> Grounds:
    valid: Grounds = shapely.make_valid(grounds)
    return valid


def _stall_tags(stall: Stall, level: BuiltLevel, *, is_taken: bool) -> dict[str, str]:
    numbered = {} if stall.number is None else {"ref": level.place.own_name(str(stall.number))}
    sized = {} if stall.size == "standard" else {"size": stall.size}
    return {"name": stall.name, **numbered, **sized, "use": str(stall.use), "occupied": "yes" if is_taken else "no"}


def _space_tags(stall: Stall, tags: dict[str, str]) -> dict[str, str]:
    return {"type": "parking_space", "width": number_text(stall.width_m), **tags}


def _side(osm: OsmFile, *points: int, is_open: bool) -> int:
    return osm.way(points, {"type": "virtual"} if is_open else {"type": "line_thin", "subtype": "solid"})


def _area(osm: OsmFile, ways: Sequence[int], tags: dict[str, str], participant: str) -> None:
    members = [Member("way", way, "outer") for way in ways]
    osm.relation(members, {"type": "multipolygon", **tags, "location": "urban", participant: "yes"})
