"""Stalls of a survey as rectangles and parallelograms that open onto a lane, and those that cannot be placed."""
# Over 300 lines: a stall's mouth is searched in several manners, and each failure has its reason.

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.garage import Arc, LaneGraph, Point
from garage2usd.survey.stall_shapes import PARALLEL_DEG, FittedShape, snapped_yaw_rad, stall_shape, with_parallel_rear
from garage2usd.survey.survey import Survey, SurveyedStall, Unplaced

Floats = NDArray[np.float64]
_SIDES = 4
_REACH_M = 9.0
"""Greatest distance in metres from the mouth of a stall to the middle of its lane."""
_FAR_M = 5.0
"""Distance in metres from the mouth of a stall to the middle of its lane that is more than usual."""
_LEAST_WIDTH_M, _LEAST_LENGTH_M, _LEAST_GROUND_M2 = 1.0, 2.0, 0.25
_MOST_OVERLAP = 0.05
"""Greatest share of a stall's ground that another one covers."""
_INSIDE_M = 0.1
_LEAST_AHEAD = 0.25
"""Cosine of the angle ahead of a stall's mouth up to which a lane lies aside of it and not beside the stall."""
_BEHIND_M = 0.5


@dataclass(frozen=True)
class FittedStall:
    """A stall of a survey with its mouth and its lane.

    Attributes
    ----------
    source
        The stall in the survey.
    shape
        Rectangle or parallelogram of the stall.
    access
        Number of the lane node in front of its mouth.
    note
        Difference of the shape from that in the survey; empty if they are equal.
    """

    source: SurveyedStall
    shape: FittedShape
    access: int
    note: str = ""


class _Mouth(NamedTuple):
    """A side of a stall that opens onto a lane: its number, and the distance in metres to the lane's middle."""

    side: int
    away_m: float
    foot: Point


class Fitting(NamedTuple):
    """The stalls of a survey that are placed, and why the others are not.

    Attributes
    ----------
    stalls
        The stalls in their order.
    unplaced
        Those that cannot be placed, each with the reason.
    cut_off
        Lane nodes before the mouths of stalls that have no way from an entrance, or to an exit.
    laneless
        Numbers, in the survey, of the stalls without a lane.
    """

    stalls: tuple[FittedStall, ...]
    unplaced: tuple[Unplaced, ...]
    cut_off: tuple[int, ...] = ()
    laneless: tuple[int, ...] = ()


def fitted_stalls(
    survey: Survey, lanes: LaneGraph, *, keeps_left: bool, walls: shapely.Geometry | None = None
) -> Fitting:
    """Find the mouth and the lane of each stall of a survey.

    Parameters
    ----------
    survey
        The stalls.
    lanes
        The lane graph.
    keeps_left
        True if traffic keeps to the left, which decides which way cars look in parallel stalls of two-way lanes.
    walls
        Lines of walls and of blocks, through which no car drives.

    Notes
    -----
    The mouth is the short side from which the middle of a lane is in reach, else the long one, else one before which a
    lane ends or bends, else one from which a free way leads aside to a lane; of two such sides the one that most
    adjacent stalls prefer, else the one nearer to its lane.
    """
    return _Fitting(survey, lanes, walls or shapely.MultiLineString(), keeps_left=keeps_left).result()


_Reach = Callable[[Floats, Floats, Floats], list[tuple[bool, float, Point]]]
"""Function that finds lanes before a side, given its ends and the unit vector out of the stall."""


class _Fitting:
    def __init__(self, survey: Survey, lanes: LaneGraph, walls: shapely.Geometry, *, keeps_left: bool) -> None:
        self._lanes, self._keeps_left, self._walls = lanes, keeps_left, walls
        self._stalls = survey.stalls
        self._grounds = np.array(survey.stall_polygons(), dtype=object)
        self._tree = shapely.STRtree(self._grounds)
        arcs = [(edge.start, edge.end) for edge in lanes.edges]
        before_doors = [arc for arc in arcs if self._is_gate(*arc)]
        arcs = [arc for arc in arcs if not self._is_gate(*arc)]
        self._line_tree, self._door_tree = (shapely.STRtree(self._lines(found)) for found in (arcs, before_doors))
        widths_m = np.array([lanes.arcs[arc].width_m for arc in arcs])
        self._carriageways = np.asarray(shapely.buffer(self._line_tree.geometries, widths_m / 2, quad_segs=2))
        self._carriageway_tree = shapely.STRtree(self._carriageways)

    def _lines(self, arcs: Sequence[Arc]) -> NDArray[np.object_]:
        ends = self._lanes.positions_m[np.array(arcs, dtype=np.intp).reshape(-1, 2)]
        return np.asarray(shapely.linestrings(ends)) if len(ends) else np.empty(0, dtype=object)

    def result(self) -> Fitting:
        fitted: list[FittedStall] = []
        unplaced: list[Unplaced] = []
        cut_off: list[int] = []
        laneless: list[int] = []
        mouths = self._voted([list(self._mouths(number)) for number in range(len(self._stalls))])
        for number, (stall, mouth) in enumerate(zip(self._stalls, mouths, strict=True)):
            reason = self._hindrance(number)
            if not reason and mouth is None:
                laneless.append(number)
                reason = self._reason_without_lane(number)
            note = ""
            shape = None if reason or mouth is None else stall_shape(stall.corners, mouth.side, self._keeps_left)
            if isinstance(shape, str) and mouth is not None:
                reason = shape
                shape, note = self._reshaped(number, mouth)
                reason = "" if shape is not None else reason
            if reason or mouth is None or shape is None or isinstance(shape, str):
                unplaced.append(Unplaced(stall.name, reason))
                continue
            access = self._access(mouth)
            reason = "no lane before it" if access is None else self._reason_without_way(access)
            if access is None or reason:
                unplaced.append(Unplaced(stall.name, reason))
                cut_off += [] if access is None else [access]
                continue
            if shape.angle_deg == PARALLEL_DEG:
                shape = self._along_traffic(shape, access)
            fitted.append(FittedStall(stall, shape, access, note))
        return Fitting(tuple(fitted), tuple(unplaced), tuple(dict.fromkeys(cut_off)), tuple(laneless))

    def _reshaped(self, number: int, mouth: _Mouth) -> tuple[FittedShape | None, str]:
        """Return the shape of a stall with its rear made parallel to its mouth, and a description of the change."""
        laid = with_parallel_rear(np.roll(np.array(self._stalls[number].corners), -mouth.side, axis=0))
        if laid is None:
            return None, ""
        corners, moved_m = laid
        shape = stall_shape(corners, 0, self._keeps_left)
        ground = shapely.Polygon(corners)
        beside = self._grounds[[at for at in self._tree.query(ground).tolist() if at != number]]
        is_free = shapely.area(shapely.intersection(beside, ground)).sum() <= _MOST_OVERLAP * ground.area
        if isinstance(shape, str) or not is_free:
            return None, ""
        return shape, f"its rear is laid parallel to its mouth, by which a corner moves {moved_m:.2f} m"

    def _is_gate(self, *nodes: int) -> bool:
        return any(self._lanes.nodes[node].is_portal for node in nodes)

    def _hindrance(self, number: int) -> str:
        """Explain why a stall cannot be placed on its ground; empty if it can."""
        ground = self._grounds[number]
        if not ground.is_valid or ground.area < _LEAST_WIDTH_M * _LEAST_LENGTH_M:
            return f"its ground of {ground.area:.2f} m2 is too small or crosses itself"
        for other in sorted(self._tree.query(ground, predicate="intersects").tolist()):
            if other >= number:
                continue
            share = ground.intersection(self._grounds[other]).area / ground.area
            if share > _MOST_OVERLAP:
                return f"{share:.0%} of its ground is that of stall {self._stalls[other].name}"
        return ""

    def _mouths(self, number: int) -> Iterator[_Mouth]:
        """Yield the sides of a stall from which a lane is in reach without another stall between, the best first."""
        found = self._sides(number, self._reached)
        return iter(found or self._sides(number, self._reached_aside))

    def _sides(self, number: int, reached_from: _Reach) -> list[_Mouth]:
        """Return the sides of a stall from which a lane is reached in some manner, the best first."""
        stall = self._stalls[number]
        corners = np.array(stall.corners)
        centre = corners.mean(axis=0)
        found = []
        for side in range(_SIDES) if stall.mouth is None else (stall.mouth,):
            start, end = corners[side], corners[(side + 1) % _SIDES]
            middle = (start + end) / 2
            opposite = (corners[(side + 2) % _SIDES] + corners[(side + 3) % _SIDES]) / 2
            along = middle - opposite
            depth_m = float(np.linalg.norm(along))
            if depth_m < _LEAST_WIDTH_M or np.linalg.norm(end - start) < _LEAST_WIDTH_M:
                continue
            # cars leave an angled stall along its sides, but its lane is searched at right angles to its mouth
            square = np.array([end[1] - start[1], start[0] - end[0]])
            square = square / np.linalg.norm(square) * (1.0 if square @ (middle - centre) > 0 else -1.0)
            is_long = bool(np.linalg.norm(end - start) > depth_m)
            for is_beside, away_m, foot in reached_from(start, end, square):
                if not self._is_blocked(number, middle + _INSIDE_M * square, foot):
                    found.append((is_beside, is_long, round(away_m, 3), side, _Mouth(side, away_m, foot)))
                    break
        return [mouth for *_, mouth in sorted(found, key=lambda entry: entry[:4])]

    def _reached(self, start: Floats, end: Floats, ahead: Floats) -> list[tuple[bool, float, Point]]:
        """Return whether a lane ends or bends ahead of a side, its distance and its place; nothing without a lane."""
        middle = (start + end) / 2
        reached = self._lane_ahead(middle, ahead, self._line_tree)
        is_beside = reached is None
        if reached is None or reached[0] > _FAR_M:
            # a lane that ends in front of the mouth is nearer than one that crosses beyond it
            ended = self._ground_ahead(start, end, ahead)
            if reached is None or (ended is not None and ended[0] < reached[0] - _FAR_M):
                reached = ended
            # beside a door, a stall may open onto the way from it to the lane
            reached = reached or self._lane_ahead(middle, ahead, self._door_tree)
        return [] if reached is None else [(is_beside, *reached)]

    def _reached_aside(self, start: Floats, end: Floats, ahead: Floats) -> list[tuple[bool, float, Point]]:
        """Return the distances and nearest places of the lanes within reach that lie ahead of a side, or aside."""
        before = (start + end) / 2 + _INSIDE_M * ahead
        found = []
        for tree in (self._line_tree, self._door_tree):
            for index in tree.query(shapely.Point(before), predicate="dwithin", distance=_REACH_M).tolist():
                way = shapely.shortest_line(shapely.Point(before), tree.geometries[index])
                x, z = way.coords[-1]
                if way.length and (np.array((x, z)) - before) @ ahead > _LEAST_AHEAD * way.length:
                    found.append((True, float(way.length), (x, z)))
        return sorted(found)

    def _lane_ahead(self, middle: Floats, ahead: Floats, lines: shapely.STRtree) -> tuple[float, Point] | None:
        """Return the distance and the place of the nearest middle of a lane ahead of the middle of a side."""
        ray = shapely.LineString([middle - _BEHIND_M * ahead, middle + _REACH_M * ahead])
        crossed = [
            point
            for index in lines.query(ray, predicate="intersects").tolist()
            for point in shapely.get_coordinates(lines.geometries[index].intersection(ray)).tolist()
        ]
        if not crossed:
            return None
        away, (x, z) = min((math.dist(point, middle), point) for point in crossed)
        return away, (x, z)

    def _ground_ahead(self, start: Floats, end: Floats, ahead: Floats) -> tuple[float, Point] | None:
        """Return the distance and nearest place of the carriageway of a lane that ends or bends in front of a side."""
        strip = shapely.Polygon([start, end, end + _REACH_M * ahead, start + _REACH_M * ahead])
        parts = self._carriageways[self._carriageway_tree.query(strip, predicate="intersects")]
        ground = shapely.union_all(shapely.intersection(parts, strip))
        if ground.area < _LEAST_GROUND_M2:
            return None
        way = shapely.shortest_line(ground, shapely.Point((start + end) / 2))
        return float(way.length), way.coords[0]

    def _is_blocked(self, number: int, start: Floats, foot: Point) -> bool:
        way = shapely.LineString([start, foot])
        return bool(self._walls.crosses(way)) or any(
            other != number and self._grounds[other].intersection(way).length > _INSIDE_M
            for other in self._tree.query(way, predicate="intersects").tolist()
        )

    def _voted(self, mouths: Sequence[Sequence[_Mouth]]) -> list[_Mouth | None]:
        """Choose the mouth of each stall: of its possible ones that whose direction most adjacent stalls prefer."""
        directions = [[self._direction(number, mouth) for mouth in found] for number, found in enumerate(mouths)]
        chosen: list[_Mouth | None] = []
        for number, found in enumerate(mouths):
            if not found:
                chosen.append(None)
                continue
            beside = [
                directions[other][0]
                for other in self._tree.query(self._grounds[number], predicate="dwithin", distance=_INSIDE_M).tolist()
                if other != number and mouths[other] and self._shares_side(number, other)
            ]
            votes = [
                sum(math.dist(direction, other) < 0.5 for other in beside)  # noqa: PLR2004 - within 30 degrees
                for direction in directions[number]
            ]
            chosen.append(found[votes.index(max(votes))])
        return chosen

    def _shares_side(self, number: int, other: int) -> bool:
        """Return True if two stalls have most of a side in common."""
        common = self._grounds[number].buffer(_INSIDE_M).intersection(self._grounds[other])
        return bool(common.length / 2 > _LEAST_LENGTH_M)

    def _direction(self, number: int, mouth: _Mouth) -> Point:
        corners = np.array(self._stalls[number].corners)
        middle = (corners[mouth.side] + corners[(mouth.side + 1) % _SIDES]) / 2
        away = middle - corners.mean(axis=0)
        x, z = (away / np.linalg.norm(away)).tolist()
        return x, z

    def _access(self, mouth: _Mouth) -> int | None:
        """Return the number of the node nearest to the place before a mouth; None without one."""
        away_m = np.hypot(*(self._lanes.positions_m - mouth.foot).T)
        order = (int(node) for node in np.argsort(away_m, kind="stable"))
        return next((node for node in order if not self._lanes.nodes[node].is_portal), None)

    def _reason_without_way(self, access: int) -> str:
        """Explain why no car gets to a node and out again; empty if one does."""
        if access in self._lanes.driven:
            return ""
        missing = [
            words
            for words, arcs in (("from an entrance", self._lanes.arriving), ("to an exit", self._lanes.leaving))
            if all(access not in arc for arc in arcs)
        ]
        return f"no route {' and '.join(missing) or 'without a turn on the spot'} over its lane"

    def _reason_without_lane(self, number: int) -> str:
        """Explain what keeps a stall from the lanes: their distance, or what stands between."""
        ground = self._grounds[number]
        lines = [tree.geometries for tree in (self._line_tree, self._door_tree) if len(tree)]
        if not lines:
            return "there is no lane"
        ways = shapely.shortest_line(ground, np.concatenate(lines))
        way = min(ways, key=lambda line: line.length)
        between = [
            self._stalls[other].name
            for other in self._tree.query(way, predicate="intersects").tolist()
            if other != number and self._grounds[other].intersection(way).length > _INSIDE_M
        ]
        if way.length > _REACH_M:
            return f"the nearest lane is {way.length:.1f} m away, more than {_REACH_M:g}"
        if between:
            return f"stall {between[0]} lies between it and its lane, {way.length:.1f} m away"
        return f"the lane {way.length:.1f} m away lies before none of its free sides"

    def _along_traffic(self, shape: FittedShape, access: int) -> FittedShape:
        """Turn a parallel stall so that its car looks along the traffic of a one-way lane beside it."""
        arcs: list[Arc] = [arc for arc, edge in self._lanes.arcs.items() if access in arc and edge.one_way]
        arcs = [arc for arc in arcs if not self._is_gate(*arc)]
        ahead = -math.sin(shape.yaw_rad), -math.cos(shape.yaw_rad)
        for start, end in arcs:
            (x, z), (end_x, end_z) = self._lanes.nodes[start].position, self._lanes.nodes[end].position
            along = ahead[0] * (end_x - x) + ahead[1] * (end_z - z)
            if along < -0.5 * math.hypot(end_x - x, end_z - z):
                turned = snapped_yaw_rad(math.remainder(shape.yaw_rad + math.pi, math.tau))
                return shape._replace(yaw_rad=turned, turn=-shape.turn)
        return shape
