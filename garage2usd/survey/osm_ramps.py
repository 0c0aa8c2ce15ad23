"""Ramps between the levels of an OSM XML file: service roads and lanelets that lead from one level to another."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from garage2usd.garage import Point
from garage2usd.survey.lanelets import CentreLine, lanes_of_lanelets
from garage2usd.survey.osm_elements import OsmElements, OsmWay
from garage2usd.survey.osm_levels import OsmLevels, is_repeated, one_way_of
from garage2usd.survey.survey import PortalKind, Unplaced
from garage2usd.survey.surveyed_building import SurveyedRamp
from garage2usd.survey.text import length_of

_END_DIGITS = 1


class FoundRamps(NamedTuple):
    """The ramps of a file.

    Attributes
    ----------
    ramps
        The ramps.
    unread
        Service roads and lanelets that climb without joining two levels.
    parts
        Names of the service roads and lanelets that are on no level, as they are parts of ramps.
    to_street
        Level of each lanelet that climbs from a level to no other one, by its name.
    portals
        Level of the end of such lanelets on the street, its (x, z), and the direction in which cars drive there.
    """

    ramps: tuple[SurveyedRamp, ...]
    unread: tuple[Unplaced, ...]
    parts: frozenset[str]
    to_street: Mapping[str, str]
    portals: tuple[tuple[str, Point, PortalKind], ...]


class _Piece(NamedTuple):
    """A piece of a ramp: its points, the places of its ends, and the levels on which these lie, as far as known.

    Cars drive along the points only if `way` is 1, and against them if it is -1. The tags have the levels `told`, and
    `climb` is 1 if it leads up along the points, -1 if down, 0 if they do not say so.
    """

    name: str
    points: tuple[Point, ...]
    ends: tuple[object, object]
    levels: tuple[str | None, str | None]
    width_m: float | None
    way: int
    parts: tuple[str, ...]
    told: frozenset[str] = frozenset()
    climb: int = 0

    @property
    def reversed(self) -> "_Piece":
        """The same piece with its points in the other order."""
        (start, end), (first, last) = self.ends, self.levels
        turned = self._replace(points=self.points[::-1], ends=(end, start), levels=(last, first))
        return turned._replace(way=-self.way, climb=-self.climb)


def ramps_of(osm: OsmElements, levels: OsmLevels) -> FoundRamps:
    """Find the ramps between the levels of a file.

    Notes
    -----
    A service road is a ramp if its ends lie on roads of different levels, or if it has two levels by its tags and
    ``incline`` tells which end is the upper one. A lanelet is a part of a ramp if its ends lie at different heights.
    Parts that follow each other are one ramp.
    """
    pieces, ways = [], set()
    for way in osm.ways.values():
        found = [*_of_way(osm, levels, way)]
        if found:
            ways.add(way.name)
            pieces += found
    lanelets = [
        piece for lane in lanes_of_lanelets(osm) if isinstance(lane, CentreLine) for piece in _of_lanelet(levels, lane)
    ]
    ramps, unread = [], []
    to_street: dict[str, str] = {}
    portals: list[tuple[str, Point, PortalKind]] = []
    for piece in (_completed(piece, levels) for piece in _chained([*pieces, *lanelets])):
        start, end = piece.levels
        if start is not None and end is not None and start != end:
            ramps.append(SurveyedRamp(piece.name, piece.points, (start, end), piece.width_m, piece.way != 0))
        elif (level := start or end) is not None and ways.isdisjoint(piece.parts):
            to_street |= dict.fromkeys(piece.parts, level)
            if start is None or end is None:
                kind = PortalKind.BOTH
                if piece.way:
                    kind = PortalKind.ENTRANCE if start is None else PortalKind.EXIT
                portals.append((level, piece.points[0 if start is None else -1], kind))
        else:
            unread.append(Unplaced(piece.name, "a ramp whose ends do not lie on lanes of two levels"))
    parts = frozenset(ways).union(piece.name for piece in lanelets).difference(to_street)
    return FoundRamps(tuple(ramps), tuple(unread), parts, to_street, tuple(portals))


def _of_way(osm: OsmElements, levels: OsmLevels, way: OsmWay) -> Iterator[_Piece]:
    """Yield the pieces of a service road if it is a ramp, from level to level."""
    told = levels.told(way.tags).intersection(levels.names)
    if way.tags.get("highway") != "service" or way.tags.get("area") == "yes" or len(way.nodes) < 2:  # noqa: PLR2004
        return
    is_on_one = len(told) == 1
    if is_repeated(way.tags) or (is_on_one and "incline" not in way.tags) or (way.is_closed and not told):
        return
    met = [levels.met_at(node, beside=way.name) for node in way.nodes]
    if told and not is_on_one:
        met = [each & told for each in met]
    stops = [0, *(number for number in range(1, len(met) - 1) if met[number]), len(met) - 1]
    at = [min(each) if len(each) == 1 else None for each in met]
    spans = [(start, end) for start, end in pairwise(stops)]
    if len(told) < 2 and not any(None not in (at[one], at[other]) and at[one] != at[other] for one, other in spans):  # noqa: PLR2004
        return  # a road that joins no two levels
    direction, climb = one_way_of(way.tags), _climb(way.tags.get("incline", ""))
    width_m = length_of(way.tags["width"]) if "width" in way.tags else None
    for start, end in spans:
        nodes, ends = way.nodes[start : end + 1], (at[start], at[end])
        places = nodes[0], nodes[-1]
        yield _Piece(way.name, osm.line(nodes), places, ends, width_m, direction, (way.name,), frozenset(told), climb)


def _completed(piece: _Piece, levels: OsmLevels) -> _Piece:
    """Return a ramp with the levels of its ends, where the two levels of its tags tell that of an unknown end."""
    if len(piece.told) != 2 or None not in piece.levels:  # noqa: PLR2004 - from one to the other
        return piece
    lower, upper = sorted(piece.told, key=levels.ordinals.__getitem__)
    other = {lower: upper, upper: lower}
    start, end = piece.levels
    if start is not None or end is not None:
        return piece._replace(levels=(start or other.get(str(end)), end or other.get(str(start))))
    if piece.climb:
        return piece._replace(levels=(lower, upper) if piece.climb > 0 else (upper, lower))
    return piece


def _climb(incline: str) -> int:
    """Return 1 for a road that leads up in the direction of its way, -1 for one down, 0 if unknown."""
    word = incline.strip().lower()
    if word in {"up", "down"}:
        return 1 if word == "up" else -1
    has_number = any(sign in "123456789" for sign in word)
    return 0 if not has_number else -1 if word.startswith("-") else 1


def _of_lanelet(levels: OsmLevels, lane: CentreLine) -> Iterator[_Piece]:
    """Yield a lanelet whose ends do not lie at the height of one level."""
    start_m, end_m = lane.heights_m
    if not levels.floors_m or levels.told(lane.tags) or start_m is None or end_m is None:
        return
    start, end = levels.at_height(start_m), levels.at_height(end_m)
    if start == end and start is not None:
        return
    begin, close = (
        (*(round(value, _END_DIGITS) for value in point), round(height_m, _END_DIGITS))
        for point, height_m in ((lane.points[0], start_m), (lane.points[-1], end_m))
    )
    way = int(lane.one_way)
    yield _Piece(lane.name, tuple(lane.points), (begin, close), (start, end), lane.width_m, way, (lane.name,))


def _chained(pieces: Sequence[_Piece]) -> Iterator[_Piece]:
    """Join the pieces that meet two by two between levels."""
    left = list(pieces)
    while left:
        piece = left.pop(0)
        for _ in range(2):  # on from its end, and then from its begin
            while piece.levels[1] is None:
                near = [
                    (number, turned)
                    for number, other in enumerate(left)
                    for turned in (other, other.reversed)
                    if turned.ends[0] == piece.ends[1] and turned.levels[0] is None
                ]
                if len(near) != 1 or near[0][1].way * piece.way < 0:
                    break
                ((number, following),) = near
                del left[number]
                piece = _Piece(
                    piece.name,
                    piece.points + following.points[1:],
                    (piece.ends[0], following.ends[1]),
                    (piece.levels[0], following.levels[1]),
                    min(filter(None, (piece.width_m, following.width_m)), default=None),
                    piece.way or following.way,
                    piece.parts + following.parts,
                    piece.told | following.told,
                    piece.climb or following.climb,
                )
            piece = piece.reversed
        yield piece.reversed if piece.way < 0 else piece
