"""Lanes of a Lanelet2 map: centre lines between the bounds of lanelets, in their direction."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.survey.osm_elements import OsmElements, OsmRelation
from garage2usd.survey.survey import Unplaced

Floats = NDArray[np.float64]

_NOT_FOR_CARS = {
    "bicycle_lane", "bus_lane", "crosswalk", "pedestrian_lane", "rail", "shared_walkway", "stairs", "walkway",
}  # fmt: skip
_STRAIGHT_M = 0.01
_SAME_GROUND = 0.9
"""Share of the larger of two grounds from which both are the same."""
_NO = {"no", "false", "0"}


class CentreLine(NamedTuple):
    """The centre line (x, z) of one lanelet, or of the two of an aisle, with its mean width and heights at its ends."""

    name: str
    tags: Mapping[str, str]
    points: list[tuple[float, float]]
    width_m: float
    one_way: bool
    heights_m: tuple[float | None, float | None] = (None, None)


class Lanelet(NamedTuple):
    """A lanelet: its relation, the numbers of its bounds' ways, and the bounds as (x, z) in its direction."""

    relation: OsmRelation
    left: tuple[int, ...]
    right: tuple[int, ...]
    left_line: Floats
    right_line: Floats

    @property
    def is_one_way(self) -> bool:
        """True unless it is tagged otherwise."""
        return self.relation.tags.get("one_way", "yes").lower() not in _NO

    @property
    def ground(self) -> shapely.Geometry:
        """The ground between the bounds."""
        return shapely.make_valid(shapely.Polygon(np.concatenate([self.left_line, self.right_line[::-1]])))


def lanes_of_lanelets(osm: OsmElements) -> Iterator[CentreLine | Unplaced]:
    """Yield the lanes of all lanelets for vehicles, or the reason why a lanelet is not a lane.

    Two one-way lanelets in opposite directions are one two-way lane if they share the bound between them, or lie on the
    same ground.
    """
    lanelets: list[Lanelet] = []
    for relation in osm.relations.values():
        if relation.tags.get("type") == "lanelet" and _is_for_cars(relation.tags):
            lanelet = _lanelet(osm, relation)
            if isinstance(lanelet, Unplaced):
                yield lanelet
            else:
                lanelets.append(lanelet)
    taken: set[int] = set()
    for index, (other, side) in enumerate(_partners(lanelets)):
        lanelet = lanelets[index]
        if index in taken:
            continue
        left, right = lanelet.left_line, lanelet.right_line
        if other is not None:
            taken.add(other)
            if side == "left":  # both lanelets lie to the right of the middle line
                left = lanelets[other].right_line[::-1]
            elif side == "right":
                right = lanelets[other].left_line[::-1]
        line, width_m = line_between(left, right)
        one_way = other is None and lanelet.is_one_way
        heights_m = _height_m(osm, lanelet, line[0]), _height_m(osm, lanelet, line[-1])
        yield CentreLine(lanelet.relation.name, lanelet.relation.tags, line, width_m, one_way, heights_m)


def _height_m(osm: OsmElements, lanelet: Lanelet, point: tuple[float, float]) -> float | None:
    """Return the mean height of the nodes of both bounds that are nearest to a point; None without heights."""
    heights = []
    for ways in (lanelet.left, lanelet.right):
        nodes = [osm.nodes[node] for number in ways if number in osm.ways for node in osm.ways[number].nodes]
        heights.append(min(nodes, key=lambda node: math.dist(node.position, point)).height_m)
    known = [height for height in heights if height is not None]
    return sum(known) / len(known) if known else None


def _partners(lanelets: Sequence[Lanelet]) -> list[tuple[int | None, str]]:
    """Return for each lanelet the one in the opposite direction beside it or on it, and the bound that both share.

    For two lanelets on the same ground the bound is empty.
    """
    partners: list[tuple[int | None, str]] = [(None, "")] * len(lanelets)
    one_way = [index for index, lanelet in enumerate(lanelets) if lanelet.is_one_way]
    beside: dict[tuple[str, tuple[int, ...]], list[int]] = {}
    for index in one_way:
        for side, ways in (("left", lanelets[index].left), ("right", lanelets[index].right)):
            beside.setdefault((side, tuple(sorted(ways))), []).append(index)
    pairs = [(pair[0], pair[1], side) for (side, _), pair in beside.items() if len(pair) == 2]  # noqa: PLR2004
    grounds = np.array([lanelets[index].ground for index in one_way], dtype=object)
    first, second = shapely.STRtree(grounds).query(grounds, predicate="intersects")
    for here, there in sorted(zip(first.tolist(), second.tolist(), strict=True)):
        if here < there:
            common_m2 = grounds[here].intersection(grounds[there]).area
            if common_m2 > _SAME_GROUND * max(grounds[here].area, grounds[there].area):
                pairs.append((one_way[here], one_way[there], ""))
    for one, other, side in pairs:
        if partners[one][0] is partners[other][0] is None and _are_opposite(lanelets[one], lanelets[other]):
            partners[one], partners[other] = (other, side), (one, side)
    return partners


def _are_opposite(one: Lanelet, other: Lanelet) -> bool:
    """Return True if two lanelets that share a bound lead in opposite directions."""
    along, back = (
        np.hypot(*(one.left_line[[0, -1]] + one.right_line[[0, -1]] - ends).T).sum()
        for ends in (
            other.left_line[[0, -1]] + other.right_line[[0, -1]],
            other.left_line[[-1, 0]] + other.right_line[[-1, 0]],
        )
    )
    return bool(back < along)


def _is_for_cars(tags: Mapping[str, str]) -> bool:
    participants = [key for key in tags if key.startswith("participant:")]
    vehicles = [key for key in participants if key.startswith("participant:vehicle") and tags[key].lower() not in _NO]
    return tags.get("subtype") not in _NOT_FOR_CARS and (bool(vehicles) or not participants)


def _lanelet(osm: OsmElements, relation: OsmRelation) -> Lanelet | Unplaced:
    """Return a lanelet with its bounds in its direction, whichever direction their ways have."""
    ways = {role: tuple(relation.ways(role)) for role in ("left", "right")}
    lines = []
    for role, numbers in ways.items():
        line = _joined([osm.line(osm.ways[number].nodes) for number in numbers if number in osm.ways])
        if not line:
            return Unplaced(relation.name, f"a lane without a {role} bound")
        lines.append(np.array(line))
    left, right = lines
    straight, crossed = (np.hypot(*(left[[0, -1]] - ends).T).sum() for ends in (right[[0, -1]], right[[-1, 0]]))
    if crossed < straight:
        right = right[::-1]
    if len(left) + len(right) < 3 or not shapely.Polygon(np.concatenate([left, right[::-1]])).area:  # noqa: PLR2004
        return Unplaced(relation.name, "a lane whose bounds enclose no ground")
    # seen from above with z downwards, a ring along the left bound and back along the right one is clockwise
    ring = shapely.LinearRing(np.concatenate([left, right[::-1]]))
    if shapely.is_ccw(shapely.transform(ring, lambda points: points * (1.0, -1.0))):
        left, right = left[::-1], right[::-1]
    return Lanelet(relation, ways["left"], ways["right"], left, right)


def _joined(lines: list[tuple[tuple[float, float], ...]]) -> list[tuple[float, float]]:
    """Return the points of ways that follow each other, each in the direction in which it does."""
    joined: list[tuple[float, float]] = []
    for index, line in enumerate(lines):
        points = list(line)
        if joined:
            if points[-1] == joined[-1]:
                points.reverse()
        elif index + 1 < len(lines) and points[0] in {lines[index + 1][0], lines[index + 1][-1]}:
            points.reverse()
        joined += points[1:] if joined and points[0] == joined[-1] else points
    return joined


def line_between(left: Floats, right: Floats) -> tuple[list[tuple[float, float]], float]:
    """Return the line in the middle between two bounds, and the mean width between these."""
    # a bound of one point is the pivot of a turn
    sides = [shapely.LineString(bound if len(bound) > 1 else np.repeat(bound, 2, axis=0)) for bound in (left, right)]
    at = np.unique(
        np.concatenate([
            shapely.line_locate_point(side, shapely.points(bound), normalized=True).round(6)
            for side, bound in zip(sides, (left, right), strict=True)
        ] + [np.array([0.0, 1.0])])
    )  # fmt: skip
    halves = [shapely.get_coordinates(shapely.line_interpolate_point(side, at, normalized=True)) for side in sides]
    middle = shapely.LineString((halves[0] + halves[1]) / 2)
    area_m2 = abs(shapely.Polygon(np.concatenate([left, right[::-1]])).area)
    width_m = area_m2 / middle.length if middle.length > 0 else 0.0
    line = shapely.get_coordinates(middle.simplify(_STRAIGHT_M)).tolist()
    return [(x, z) for x, z in line], float(width_m)
