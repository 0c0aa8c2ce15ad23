"""Picture of a plan from above: squares by kind, stalls with numbers, cars, a shortest route, findings, dimensions."""
# Over 300 lines: each layer of the picture, from the squares to the findings, is drawn in turn.

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import shapely

from garage2usd.assets.lettering import font_with
from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import find_named
from garage2usd.config.font_file import FontFile
from garage2usd.config.vehicles import CarBody
from garage2usd.garage import LaneGraph, LaneKind, Stall, StallUse
from garage2usd.layout import Layout, Placement
from garage2usd.objects import KINDS
from garage2usd.objects.car import CarSpec
from garage2usd.planning import MeasuredCirculation, measured_circulation
from garage2usd.view.drawing import Colour, Disc, Drawing, Line, Point, Region, Text, text_width
from garage2usd.view.plan_lanes import (
    FREE,
    LINE_M,
    RAMP,
    arrows,
    lane_legend,
    level_title,
    portals,
    ramps,
    ribbons,
    squares,
    wells,
)
from garage2usd.view.plan_sheet import INK, PAPER, Mark, Sheet

_SHOWN_NUMBERS = 3
_Element = Region | Line | Disc | Text
STALL_COLOUR: dict[StallUse, Colour] = {
    StallUse.STANDARD: (206, 222, 238),
    StallUse.EV: (190, 228, 196),
    StallUse.ACCESSIBLE: (168, 196, 246),
    StallUse.ACCESS_AISLE: (232, 226, 196),
    StallUse.TURNING: (240, 212, 140),
    StallUse.UNREACHABLE: (226, 178, 170),
    StallUse.MOTORCYCLE: (222, 206, 238),
}
_STALL_WORDS = {
    StallUse.STANDARD: "stall",
    StallUse.EV: "EV stall",
    StallUse.TURNING: "kept for turning",
    StallUse.ACCESS_AISLE: "access aisle",
}
SOLID: Colour = (120, 112, 108)
_ON_FOOT: Colour = (20, 150, 70)
_DOOR_M = 1.2
_CAR: Colour = (112, 146, 192)
_STANDING: Colour = (176, 58, 122)
_CLUTTER = tuple(kind for kind in KINDS if kind.group == "Clutter")
_IN: Colour = (16, 96, 208)
_OUT: Colour = (226, 96, 16)
_NUMBER_M, _NUMBER_WIDTH_M, _NUMBER_FROM_MOUTH_M = 0.75, 2.0, 0.75
_DIGIT = re.compile(r"\d")
_ROUTE_ASIDE_M, _ROUTE_WIDTH_M, _ROUTE_INTO_STALL_M = 0.45, 0.45, 0.3


@dataclass(frozen=True)
class Route:
    """Lane nodes of the shortest routes from an entrance to the lane before a stall, and from there to an exit."""

    to_stall: tuple[int, ...]
    from_stall: tuple[int, ...]


@dataclass(frozen=True)
class Ways:
    """Places (x, z) of the routes to a stall and away from it on one level, in the direction of driving."""

    to_stall: tuple[Point, ...]
    from_stall: tuple[Point, ...]


def find_stall(stalls: Sequence[Stall], number: str) -> Stall:
    """Find a stall by its number (``B2-07``) or id (``Stall_r03_c07_2``), ignoring case.

    Raises
    ------
    ConfigError
        If there is no such stall.
    """
    names = {stall: [str(name) for name in (stall.number, stall.name) if name] for stall in stalls}
    found = find_named(number, names)
    if len(found) == 1:
        return found[0]
    some = sorted(str(stall.number) for stall in stalls if stall.number)
    known = f"numbers as {', '.join(some[:_SHOWN_NUMBERS])}" if some else "ids as in the report"
    raise ConfigError("stall", number, known)


def route_of(lanes: LaneGraph, stall: Stall) -> Route:
    """Find the shortest routes from any entrance to a stall and from it to any exit, not through other portals."""
    arrivals = (lanes.shortest_way(portal, stall.access) for portal in lanes.portals(LaneKind.ENTRANCE))
    departures = (lanes.shortest_way(stall.access, portal) for portal in lanes.portals(LaneKind.EXIT))
    # both exist, as every stall is reachable
    to_stall, from_stall = (min(filter(None, ways), key=lanes.way_m) for ways in (arrivals, departures))
    return Route(tuple(to_stall), tuple(from_stall))


def ways_on_level(lanes: LaneGraph, stall: Stall, level: int = 0) -> Ways:
    """Return the routes of `route_of` as far as they are on a level, with the ramps down to it."""
    route = route_of(lanes, stall)
    to_stall, from_stall = (
        tuple(node.position for node in map(lanes.nodes.__getitem__, way) if node.level == level)
        for way in (route.to_stall, route.from_stall)
    )
    return Ways(to_stall, from_stall)


def draw_plan(
    layout: Layout,
    *,
    stall: Stall | None = None,
    ways: Ways | None = None,
    marks: Sequence[Mark] = (),
    driven: Iterable[Line] = (),
) -> Drawing:
    """Draw a layout from above, +X to the right and +Z down, with the corner of the first square at (0, 0).

    Parameters
    ----------
    layout
        The layout.
    stall
        Stall whose routes from an entrance and to an exit are drawn.
    ways
        These routes as far as they are on this level; found in the layout if left out. Without a stall they lead on to
        another level.
    marks
        Findings, drawn as numbers at their places and listed below.
    driven
        Lines of tracks on this level (`garage2usd.view.plan_tracks`).
    """
    rows, cols = layout.structure.shape
    if stall is not None and ways is None:
        ways = ways_on_level(layout.lane_graph, stall)
    found = None if layout.matrices is None else measured_circulation(layout.structure)
    sheet = Sheet(layout.structure, marks, _legend(layout, found, with_route=ways is not None))

    def elements() -> Iterator[_Element]:
        yield from ribbons(layout) if found is None else squares(layout, found)
        yield from _stalls(layout)
        yield from arrows(layout.lane_graph)
        yield from ramps(layout, sheet)
        yield from wells(layout, sheet)
        yield from _building(layout)
        yield from _clutter(layout)
        yield from portals(layout, sheet)
        if ways is not None:
            yield from _route(ways, stall)
        yield from driven
        yield sheet.title(level_title(layout) + _figures(layout, found))
        yield from sheet.dimensions()
        yield from sheet.legend(layout)
        yield from sheet.marks()

    size = "" if found is None else f" of {rows} x {cols} squares"
    title = f"Parking garage{size} with {layout.parking_stalls} stalls"
    return Drawing(sheet.low, sheet.high, sheet.px_per_m, PAPER, title, list(elements()))


def _figures(layout: Layout, found: MeasuredCirculation | None) -> str:
    """Key figures of the garage in a line: stalls, area per stall, loops, dead ends, stretches."""
    stalls = layout.parking_stalls
    known = [f"{stalls} stalls, {layout.counts()['car']} occupied"]
    known += [layout.area.per_stall(stalls).in_words()] if stalls else []
    if found is None:
        return ", ".join(known)
    loops = found.circulation.loops
    return ", ".join(
        [
            *known,
            f"{loops or 'no'} loop{'s' if loops > 1 else ''}",
            f"longest dead end {found.dead_end_m:.1f} m" if found.dead_ends else "no dead end",
            f"longest stretch without a junction {found.stretch_m:.1f} m",
        ]
    )


def _legend(layout: Layout, found: MeasuredCirculation | None, *, with_route: bool) -> list[tuple[Colour, str]]:
    """Colours and names of the elements on the plan."""
    uses = {stall.use for stall in layout.quads}
    counts = layout.counts()
    entries = lane_legend(layout, found)
    entries += [(STALL_COLOUR[use], _stall_words(use)) for use in StallUse if use in uses]
    entries += [(_CAR, "parked car")] if counts["car"] else []
    motorbikes = len(layout.parked_motorbikes())
    entries += [(_CAR, "parked motorcycle")] if motorbikes and not counts["car"] else []
    entries += [(FREE, "free")]
    entries += [(RAMP, "ramp")] if counts["ramp"] or layout.well else []
    entries += [(SOLID, "obstacle")] if counts["obstacle"] else []
    entries += [(_ON_FOOT, "door of a stair core")] if layout.cores else []
    standing = sum(counts[kind.name] for kind in _CLUTTER) - motorbikes
    entries += [(_STANDING, "people and things")] if standing else []
    entries += [(INK, "column, wall")]
    return entries + ([(_IN, "way in"), (_OUT, "way out")] if with_route else [])


def _stall_words(use: StallUse) -> str:
    return _STALL_WORDS.get(use, f"{use} stall")


def _stalls(layout: Layout) -> Iterator[Region | Line | Text]:
    cars = {car.stall: car for car in layout.of_kind("car")}
    taken = {*cars, *(place.stall for place in layout.of_kind("motorbike") if place.square is not None)}
    for stall in layout.quads:
        corners = stall.corners
        said = " blocked" if stall.blocked_by else " occupied" if stall.name in taken else ""
        kind = f"stall {stall.use}{said}"
        yield Region(corners, STALL_COLOUR[stall.use], kind, stall.name)
        yield Line([corners[0], corners[3], corners[2], corners[1]], PAPER, LINE_M)
    # after all stalls, as some cars reach into the next one
    yield from (
        Region(_car_outline(car, car.spec.measures), _CAR, "car")
        for car in cars.values()
        if isinstance(car.spec, CarSpec)
    )
    yield from (_number(stall, _short_number(stall), layout.look.font) for stall in layout.quads if stall.number)


def _short_number(stall: Stall) -> str:
    """The number of a stall, without its zone where it would reach into the next stall."""
    number = str(stall.number)
    return number.rpartition("-")[2] if stall.use is StallUse.MOTORCYCLE else number


def _clutter(layout: Layout) -> Iterator[Region]:
    """Draw people and loose objects."""
    for kind in _CLUTTER:
        for place in layout.of_kind(kind.name):
            colour = _STANDING if place.square is None else _CAR
            yield from (Region(outline, colour, kind.name, place.name) for outline in place.outlines())


def _car_outline(car: Placement, body: CarBody) -> list[Point]:
    """Outline of a car body with a pointed nose, which shows its direction."""
    half_x, half_z = body.width_m / 2, body.length_m / 2
    nose = 0.45 * half_x
    shape = [
        (-half_x, half_z), (half_x, half_z), (half_x, -half_z + nose), (half_x - nose, -half_z),
        (nose - half_x, -half_z), (-half_x, -half_z + nose),
    ]  # fmt: skip
    return [car.to_world(point) for point in shape]


def _number(stall: Stall, number: str, own_font: FontFile | None) -> Text:
    """Draw the number of a stall, horizontal and beside its entry, so that the stall's centre stays clear."""
    font = "" if number.isascii() else font_with(number, own_font)
    # measure all digits as the widest one, so that few widths are computed
    width = text_width(_DIGIT.sub("8", number), _NUMBER_M, font)
    height = _NUMBER_M * min(1.0, _NUMBER_WIDTH_M / width)
    x, z = stall.outwards
    inwards = _NUMBER_FROM_MOUTH_M if abs(z) > abs(x) else (_NUMBER_FROM_MOUTH_M + width * height / _NUMBER_M) / 2
    return Text(_inside(stall, inwards), number, height, INK, kind="number", font=font)


def _inside(stall: Stall, inwards_m: float) -> Point:
    """Point (x, z) at a distance inwards from the centre of a stall's entry."""
    (x, z), (out_x, out_z) = stall.mouth, stall.outwards
    return x - inwards_m * out_x, z - inwards_m * out_z


def _building(layout: Layout) -> Iterator[Region | Line]:
    for place in layout.of_kind("obstacle"):
        yield Region(place.outlines()[0], SOLID, "obstacle")
    for core in layout.cores:
        (x, z), half = core.door_m, _DOOR_M / 2
        ends = [(x - half, z), (x + half, z)] if core.along_x else [(x, z - half), (x, z + half)]
        yield Line(ends, _ON_FOOT, 3 * LINE_M, "exit on_foot")
    for kind in ("wall", "column"):
        for place in layout.of_kind(kind):
            yield Region(place.outlines()[0], INK, kind)


def _route(ways: Ways, stall: Stall | None) -> Iterator[Region | Line]:
    """Draw the routes from an entrance and to an exit on the right side of the lanes, and frame the stall."""
    ends: list[Point] = []
    if stall is not None:
        corners = stall.corners
        yield Line([*corners, corners[0]], _IN, 2.5 * LINE_M, "chosen")
        ends = [stall.mouth, _inside(stall, _ROUTE_INTO_STALL_M)]
    yield from _way(ways.to_stall, ends, _IN, "way in")
    yield from _way(ways.from_stall[::-1], ends, _OUT, "way out", is_reversed=True)


def _way(
    middles: Sequence[Point], end: Sequence[Point], colour: Colour, kind: str, *, is_reversed: bool = False
) -> Iterator[Line]:
    """Draw the route between a portal and a stall, or another portal, in either direction, with an arrow head."""
    points = [*middles]
    if end:
        # the route leaves the lane at the stall's entry
        before, mouth = middles[-1], end[0]
        is_along_x = abs(end[1][0] - mouth[0]) < abs(end[1][1] - mouth[1])
        turn = (mouth[0], before[1]) if is_along_x else (before[0], mouth[1])
        points = [*middles[:-1], turn, *end]
    points = _distinct(points)
    if len(points) < 2:  # noqa: PLR2004 - a line
        return
    aside = -_ROUTE_ASIDE_M if is_reversed else _ROUTE_ASIDE_M
    line = shapely.LineString(points).offset_curve(aside, join_style="mitre")
    way = list(shapely.get_parts(line)[0].coords) if line.geom_type != "LineString" else list(line.coords)
    if is_reversed:
        way.reverse()
    yield Line(way, colour, _ROUTE_WIDTH_M, kind)
    (x0, z0), (x1, z1) = way[-2:]
    length = math.hypot(x1 - x0, z1 - z0)
    dx, dz = (x1 - x0) / length, (z1 - z0) / length
    wings = [(x1 - dx - side * dz, z1 - dz + side * dx) for side in (0.8, -0.8)]
    yield Line([wings[0], (x1, z1), wings[1]], colour, _ROUTE_WIDTH_M, kind)


def _distinct(points: Sequence[Point]) -> list[Point]:
    kept = list(points[:1])
    for point in points[1:]:
        if math.dist(point, kept[-1]) > LINE_M:
            kept.append(point)
    return kept
