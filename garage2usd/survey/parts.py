"""Parts of a survey, collected by a reader: stalls checked for four corners, unique names, one outline of many."""
# Over 300 lines: each kind of part is read with what can be wrong with it.

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import Point, StallUse
from garage2usd.survey.survey import (
    PortalKind,
    Survey,
    SurveyedColumn,
    SurveyedLane,
    SurveyedPortal,
    SurveyedStall,
    Unplaced,
)
from garage2usd.survey.text import length_of, refuse

Floats = NDArray[np.float64]

STRAIGHT_M = 0.15
"""Distance from the line through its neighbours up to which a point of an outline is not a corner."""
_CORNERS = 4
_LEAST_STALL_M = 1.0
"""Width below which stalls of a row are an error of the source: motorcycles need as much."""
_MOST_CROSSED = 0.01
_DIGITS = 6
_COLUMN_DIGITS = 2
_MOST_OF_NUMBER = 40
_LEAST_SOLID_M2 = 0.01
MOST_STALLS = 20_000
"""Number of stalls and of parts that cannot be read up to which a file is imported."""
_MOST_POINTS, _FINE_M = 1000, 0.01
"""Number of points of a line from which on it is simplified, and the distance up to which it then differs."""
_LEAST_HALF_M = 1.25
"""Half the width of the narrowest lane; stalls that are nearer to its centre line lie on it."""


class SurveyParts:
    """Parts of a survey under construction, by (x, z) in metres.

    Attributes
    ----------
    stalls, lanes, columns, portals, solids, unread, remarks
        As in `Survey`.
    clear_heights_m, ceiling_heights_m
        Heights that parts of the source tell, of which the least counts.
    """

    def __init__(self) -> None:
        self.stalls: list[SurveyedStall] = []
        self.lanes: list[SurveyedLane] = []
        self.columns: list[SurveyedColumn] = []
        self.portals: list[SurveyedPortal] = []
        self.solids: list[tuple[Point, ...]] = []
        self.unread: list[Unplaced] = []
        self.remarks: list[str] = []
        self.clear_heights_m: list[float] = []
        self.ceiling_heights_m: list[float] = []
        self._outlines: list[tuple[str, tuple[Point, ...]]] = []
        self._clear_heights: dict[str, object] = {}
        self._named: Counter[str] = Counter()

    def add_stall(
        self,
        name: str,
        ring: Iterable[Sequence[float]],
        *,
        mouth_at: Point | None = None,
        use: StallUse = StallUse.STANDARD,
        size: SizeClass = SizeClass.STANDARD,
        number: str = "",
    ) -> None:
        """Add a stall, or note why it is unusable.

        Parameters
        ----------
        name
            Id in the source. If it was taken before, a number is appended.
        ring
            Points (x, z) of its outline, of which the first may be repeated at the end.
        mouth_at
            Point on the side that cars cross; None if unknown.
        use, size, number
            As in `SurveyedStall`.
        """
        if len(self.stalls) + len(self.unread) >= MOST_STALLS:
            refuse(name, f"more than {MOST_STALLS} stalls", f"{MOST_STALLS} stalls in a file")
        self._named[name] += 1
        if self._named[name] > 1:
            name = f"{name} ({self._named[name]})"
        corners = corners_of(ring)
        reason = _reason_against(corners)
        if reason:
            self.unread.append(Unplaced(name, reason))
            return
        a, b, c, d = corners
        mouth = None if mouth_at is None else side_at(corners, mouth_at)
        self.stalls.append(SurveyedStall(name, (a, b, c, d), mouth, use, size, self._readable(name, number)))

    def add_row(
        self,
        name: str,
        ring: Iterable[Sequence[float]],
        count: int,
        *,
        use: StallUse = StallUse.STANDARD,
        size: SizeClass = SizeClass.STANDARD,
    ) -> None:
        """Add equal stalls side by side along the longer sides of a quadrilateral, or note why there are none."""
        corners = corners_of(ring)
        reason = _reason_against(corners)
        if not reason:
            a, b, c, d = corners
            if math.dist(a, b) + math.dist(c, d) < math.dist(b, c) + math.dist(d, a):
                a, b, c, d = b, c, d, a
            share_m = (math.dist(a, b) + math.dist(c, d)) / 2 / count
            if share_m < _LEAST_STALL_M:
                reason = f"{count} stalls side by side, each {share_m:.2f} m wide"
        if reason:
            self.unread.append(Unplaced(name, reason))
            return
        ends = [
            ((1 - number / count) * np.array([a, d]) + number / count * np.array([b, c])).tolist()
            for number in range(count + 1)
        ]
        for number, ((start, rear), (end, next_rear)) in enumerate(pairwise(ends), 1):
            self.add_stall(f"{name}, stall {number}", [start, end, next_rear, rear], use=use, size=size)

    def add_lane(self, name: str, line: Iterable[Sequence[float]], width_m: float | None, *, one_way: bool) -> None:
        """Add a lane by the points (x, z) of its centre line, or note that it has no length."""
        points = _without_repeats(line, closes=True)
        if len(points) < 2:  # noqa: PLR2004 - a line
            self.unread.append(Unplaced(name, "a lane without length"))
        else:
            self.lanes.append(SurveyedLane(points, None if width_m is None else round(width_m, _DIGITS), one_way))

    def add_column(self, name: str, ring: Iterable[Sequence[float]]) -> None:
        """Add a square column with the middle and the area of an outline, or note that this has no area."""
        polygon = _polygon(_without_repeats(ring))
        if polygon is None:
            self.unread.append(Unplaced(name, "a column without area"))
        else:
            self.columns.append(SurveyedColumn(_point(polygon.centroid.coords[0]), float(polygon.area) ** 0.5))

    def add_solid(self, name: str, corners: Sequence[Point]) -> None:
        """Add a block on the floor; one without area, or that crosses itself, is unread."""
        polygon = shapely.Polygon(corners) if len(corners) > 2 else shapely.Polygon()  # noqa: PLR2004 - a triangle
        if polygon.is_empty or not polygon.is_valid or polygon.area < _LEAST_SOLID_M2:
            self.unread.append(Unplaced(name, "a block without area, or one that crosses itself"))
        else:
            self.solids.append(tuple(map(_point, corners)))

    def add_square_column(self, centre: Point, size_m: float) -> None:
        """Add a column by its middle (x, z) and its side."""
        self.columns.append(SurveyedColumn(_point(centre), size_m))

    def add_clear_height(self, told: object) -> None:
        """Add a height that signs or drawings give for cars, as people write it; words such as ``default`` are none."""
        height_m = length_of(told)
        if height_m is not None:
            self.clear_heights_m.append(height_m)

    def add_portal(self, position: Sequence[float], kind: PortalKind = PortalKind.BOTH) -> None:
        """Add a place where cars enter or leave."""
        self.portals.append(SurveyedPortal(_point(position), kind))

    def add_outline(self, name: str, ring: Iterable[Sequence[float]], *, maxheight: object = None) -> None:
        """Add an outline with its clear height. Of several over each other, that with the most stalls counts."""
        points = _without_repeats(ring)
        polygon = _polygon(points)
        if polygon is not None and not polygon.is_valid:
            polygon = _mended(polygon)
            if polygon is not None:
                points = _without_repeats(polygon.exterior.coords)
                self.remarks.append(f"{name}: spikes and small crossings of this outline are made straight")
        if polygon is None:
            self.unread.append(Unplaced(name, "an outline without area, or one that crosses itself"))
        else:
            self._outlines.append((name, points))
            self._clear_heights[name] = maxheight

    def _readable(self, name: str, number: str) -> str:
        """Return a stall number without control characters, truncated to a readable length."""
        shown = "".join(sign for sign in " ".join(number.split()) if sign.isprintable())
        if len(shown) > _MOST_OF_NUMBER:
            self.unread.append(Unplaced(name, f"a number of {len(shown)} characters, cut to {_MOST_OF_NUMBER}"))
        return shown[:_MOST_OF_NUMBER]

    def stall_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each stall so far."""
        return [shapely.Polygon(stall.corners) for stall in self.stalls]

    def outlines(self) -> list[tuple[Point, ...]]:
        """Return the outlines with stalls that lie apart, the one with the most first; note all others."""
        middles = shapely.centroid(self.stall_polygons())
        grounds = [shapely.Polygon(ring) for _, ring in self._outlines]
        held = [int(shapely.contains(ground, middles).sum()) for ground in grounds]
        kept: list[int] = []
        for number in sorted(range(len(held)), key=lambda number: -held[number]):
            name, _ = self._outlines[number]
            over = next((other for other in kept if grounds[number].intersects(grounds[other])), None)
            if not held[number]:
                self.unread.append(Unplaced(name, "an outline that contains no stall"))
            elif over is not None:
                told = f"an outline over {self._outlines[over][0]}, which contains as many stalls or more"
                self.unread.append(Unplaced(name, told))
            else:
                kept.append(number)
        self._outlines = [self._outlines[number] for number in kept]
        return [ring for _, ring in self._outlines]

    def _narrowed(self, lane: SurveyedLane, stalls: Sequence[shapely.Polygon]) -> SurveyedLane:
        """Narrow a lane to the ground between the stalls beside it, as maps may count stalls as part of a lane."""
        if lane.width_m is None or not stalls:
            return lane
        nearest_m = float(shapely.distance(shapely.LineString(lane.points), stalls).min())
        if not _LEAST_HALF_M <= nearest_m < lane.width_m / 2:
            return lane
        return replace(lane, width_m=round(2 * nearest_m, _DIGITS))

    def survey(self, *, origin_deg: tuple[float, float] | None = None) -> Survey:
        """Return the survey of all parts."""
        outlines, stalls = self.outlines(), self.stall_polygons()
        for name, _ in self._outlines:
            self.add_clear_height(self._clear_heights.pop(name, None))
        return Survey(
            tuple(self.stalls),
            tuple(self._narrowed(lane, stalls) for lane in self.lanes),
            tuple(_single(self.columns)),
            tuple(self.portals),
            next(iter(outlines), None),
            tuple(self.unread),
            origin_deg,
            tuple(self.solids),
            tuple(self.remarks),
            other_outlines=tuple(outlines[1:]),
            clear_height_m=min(self.clear_heights_m, default=None),
            ceiling_height_m=min(self.ceiling_heights_m, default=None),
        )


def _single(columns: Iterable[SurveyedColumn]) -> list[SurveyedColumn]:
    """Return columns without those that stand on the middle of another one; the largest remains."""
    largest: dict[Point, SurveyedColumn] = {}
    for column in columns:
        x, z = column.centre
        place = round(x, _COLUMN_DIGITS) + 0.0, round(z, _COLUMN_DIGITS) + 0.0
        if place not in largest or column.size_m > largest[place].size_m:
            largest[place] = column
    return list(largest.values())


def corners_of(ring: Iterable[Sequence[float]]) -> tuple[Point, ...]:
    """Reduce the outline of a stall to its corners.

    While there are more than four points, the one that lies nearest to the line between its neighbours is removed, if
    it is nearer than `STRAIGHT_M`.
    """
    points = list(_without_repeats(ring))
    while _CORNERS < len(points) <= _MOST_POINTS:
        off_m = _distances_to_neighbours(points)
        straightest = int(np.argmin(off_m.round(_DIGITS)))
        if off_m[straightest] >= STRAIGHT_M:
            break
        del points[straightest]
    return tuple(points)


def side_at(corners: Sequence[Point], place: Point) -> int:
    """Return the number of the side of a quad that is nearest to a point; the lowest of equal ones."""
    sides = [shapely.LineString([corners[side], corners[(side + 1) % len(corners)]]) for side in range(len(corners))]
    return int(np.argmin(shapely.distance(sides, shapely.Point(place)).round(_DIGITS)))


def _reason_against(corners: tuple[Point, ...]) -> str:
    """Explain why points are not the corners of a convex quadrilateral; empty if they are."""
    if len(corners) != _CORNERS:
        return f"a stall of {len(corners)} corners instead of {_CORNERS}"
    polygon = shapely.Polygon(corners)
    if not polygon.is_valid:
        return "a stall whose sides cross or touch each other"
    if (_distances_to_neighbours(corners) < STRAIGHT_M).any():
        return f"a stall of 3 corners instead of {_CORNERS}"
    if len(shapely.get_coordinates(polygon.convex_hull)) != _CORNERS + 1:
        return "a stall with a corner that points inwards"
    return ""


def _distances_to_neighbours(points: Sequence[Point]) -> Floats:
    """Return the distance of each point of a ring from the straight between its two neighbours, in metres."""
    count = len(points)
    chords = [shapely.LineString([points[index - 1], points[(index + 1) % count]]) for index in range(count)]
    distances: Floats = shapely.distance(chords, shapely.points(points))
    return distances


def _without_repeats(line: Iterable[Sequence[float]], *, closes: bool = False) -> tuple[Point, ...]:
    """Return the points of a line or ring, rounded, without those that repeat the one before or, if asked, close it.

    Of very many points, those are left out that lie on the straights between others.
    """
    line = list(line)
    if len(line) > _MOST_POINTS:
        line = shapely.get_coordinates(shapely.LineString([place[:2] for place in line]).simplify(_FINE_M)).tolist()
    points: list[Point] = []
    for place in line:
        point = _point(place)
        if not points or point != points[-1]:
            points.append(point)
    if not closes and len(points) > 2 and points[0] == points[-1]:  # noqa: PLR2004 - a closed ring
        points.pop()
    return tuple(points)


def _polygon(points: Sequence[Point]) -> shapely.Polygon | None:
    """Return the polygon around points, or None if it has no area."""
    polygon = shapely.Polygon(points) if len(points) > 2 else None  # noqa: PLR2004 - a triangle
    return polygon if polygon is not None and polygon.area > 0 else None


def _mended(polygon: shapely.Polygon) -> shapely.Polygon | None:
    """Return a polygon without spikes and small crossings; None if these take more than a hundredth of its area."""
    parts = [part for part in shapely.get_parts(shapely.make_valid(polygon)) if part.geom_type == "Polygon"]
    parts.sort(key=lambda part: -part.area)
    if not parts or sum(part.area for part in parts[1:]) > _MOST_CROSSED * parts[0].area or parts[0].interiors:
        return None
    return parts[0]


def _point(place: Sequence[float]) -> Point:
    x, z = (round(float(value), _DIGITS) + 0.0 for value in place[:2])
    return x, z
