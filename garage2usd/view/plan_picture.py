"""The plan from above: squares by kind, stalls with numbers, columns, cars, a route, findings, dimensions."""

import math
import re
from collections.abc import Iterator, Sequence

import shapely

from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.grid import Cell
from garage2usd.lanes import LaneGraph, LaneKind, Square
from garage2usd.layout import Layout, ObjectKind, Placement, Stall, StallUse
from garage2usd.layout.placement import to_world
from garage2usd.layout.specs import CarSpec, ColumnSpec, ObstacleSpec, PortalSpec, WallPostSpec, WallSpec, rectangle
from garage2usd.stalls import Edge
from garage2usd.view.drawing import Area, Colour, Disc, Drawing, Line, Point, Text, text_width
from garage2usd.view.plan_sheet import ARROW_END_M, INK, PAPER, Mark, Sheet
from garage2usd.view.route import route_of

__all__ = ["Mark", "draw_plan"]

_Element = Area | Line | Disc | Text

_LANE_COLOUR: dict[LaneKind, Colour] = {
    LaneKind.CROSSROADS: (166, 150, 178),
    LaneKind.T_JUNCTION: (150, 160, 186),
    LaneKind.STRAIGHT: (148, 156, 166),
    LaneKind.ENTRANCE: (72, 160, 96),
    LaneKind.EXIT: (206, 84, 72),
}
_LANE_NAME = {
    LaneKind.CROSSROADS: "crossroads",
    LaneKind.T_JUNCTION: "T-junction",
    LaneKind.STRAIGHT: "straight lane",
    LaneKind.ENTRANCE: "entrance",
    LaneKind.EXIT: "exit",
}
_STALL_COLOUR: dict[StallUse, Colour] = {
    StallUse.STANDARD: (206, 222, 238),
    StallUse.EV: (190, 228, 196),
    StallUse.ACCESSIBLE: (168, 196, 246),
    StallUse.ACCESS_AISLE: (232, 226, 196),
    StallUse.TURNING: (240, 212, 140),
    StallUse.UNREACHABLE: (226, 178, 170),
}
_STALL_WORDS = {
    StallUse.STANDARD: "stall",
    StallUse.EV: "EV stall",
    StallUse.TURNING: "kept for turning",
    StallUse.ACCESS_AISLE: "access aisle",
}
_FREE: Colour = (226, 224, 216)
_SOLID: Colour = (120, 112, 108)
_CAR: Colour = (112, 146, 192)
_SEAM: Colour = (206, 204, 196)
_ARROW: Colour = (236, 238, 242)
_IN: Colour = (16, 96, 208)
_OUT: Colour = (226, 96, 16)
_BODIES = {body.name: body for body in CAR_BODIES}
_LINE_M = 0.12
_NUMBER_M, _NUMBER_WIDTH_M, _NUMBER_FROM_MOUTH_M = 0.75, 2.0, 0.75
_DIGIT = re.compile(r"\d")
_KEEP_RIGHT_M = 1.3
_CHEVRON_M = 0.7
_ROUTE_ASIDE_M, _ROUTE_WIDTH_M, _ROUTE_INTO_STALL_M = 0.45, 0.45, 0.3


def draw_plan(layout: Layout, graph: LaneGraph, *, stall: Stall | None = None, marks: Sequence[Mark] = ()) -> Drawing:
    """Draw a layout from above, +X to the right and +Z down, its first square's corner at (0, 0).

    Parameters
    ----------
    layout, graph
        What to draw.
    stall
        The stall whose route from an entrance and to an exit is drawn.
    marks
        Findings, drawn with a number at their places and listed below.
    """
    rows, cols = layout.structure.shape
    sheet = Sheet(layout.structure, marks, _legend(layout, graph, with_route=stall is not None))

    def elements() -> Iterator[_Element]:
        yield from _squares(layout, graph)
        yield from _stalls(layout)
        yield from _arrows(graph)
        yield from _building(layout)
        yield from _portals(layout, sheet)
        if stall is not None:
            yield from _route(graph, stall)
        yield from sheet.dimensions()
        yield from sheet.legend(layout)
        yield from sheet.marks()

    title = f"Parking garage of {rows} x {cols} squares with {len(layout.stalls)} stalls"
    return Drawing(sheet.low, sheet.high, sheet.px_per_m, PAPER, title, list(elements()))


def _legend(layout: Layout, graph: LaneGraph, *, with_route: bool) -> list[tuple[Colour, str]]:
    """Only what there is."""
    kinds = {kind for _, kind in graph.graph.nodes(data="kind")}
    uses = {stall.use for stall in layout.stalls}
    counts = layout.counts()
    entries = [(_LANE_COLOUR[kind], _LANE_NAME[kind]) for kind in LaneKind if kind in kinds]
    entries += [(_STALL_COLOUR[use], _stall_words(use)) for use in StallUse if use in uses]
    entries += [(_CAR, "parked car")] if counts[ObjectKind.CAR] else []
    entries += [(_FREE, "free")]
    entries += [(_SOLID, "obstacle")] if counts[ObjectKind.OBSTACLE] else []
    entries += [(INK, "column, wall")]
    return entries + ([(_IN, "way in"), (_OUT, "way out")] if with_route else [])


def _stall_words(use: StallUse) -> str:
    return _STALL_WORDS.get(use, f"{use} stall")


def _squares(layout: Layout, graph: LaneGraph) -> Iterator[Area | Line]:
    structure = layout.structure
    x, z = structure.column_edges_m.tolist(), structure.row_edges_m.tolist()
    for row, line in enumerate(structure.cells.tolist()):
        for col, cell in enumerate(line):
            if cell == Cell.OBSTACLE:
                continue
            kind = graph.kind((row, col)) if cell != Cell.FREE else None
            box = rectangle(x[col], z[row], x[col + 1], z[row + 1])
            yield Area(box, _LANE_COLOUR[kind] if kind else _FREE, str(kind or "free"))
            yield Line([*box, box[0]], _SEAM, _LINE_M / 4)


def _stalls(layout: Layout) -> Iterator[Area | Line | Text]:
    cars = {(place.square, place.name): place for place in layout.of_kind(ObjectKind.CAR)}
    for stall in layout.stalls:
        corners = stall.corners_m()
        yield Area(corners, _STALL_COLOUR[stall.use], f"stall {stall.use}", stall.name)
        yield Line([corners[0], corners[3], corners[2], corners[1]], PAPER, _LINE_M)
        car = cars.get((stall.square, stall.named("Car")))
        if car:
            yield Area(_car_outline(car), _CAR, "car")
        if stall.number:
            yield _number(stall)


def _car_outline(car: Placement) -> list[Point]:
    """A body with a pointed nose, which tells where it looks."""
    body = _BODIES[car.spec.body] if isinstance(car.spec, CarSpec) else CAR_BODIES[0]
    half_x, half_z = body.width_m / 2, body.length_m / 2
    nose = 0.45 * half_x
    shape = [
        (-half_x, half_z), (half_x, half_z), (half_x, -half_z + nose), (half_x - nose, -half_z),
        (nose - half_x, -half_z), (-half_x, -half_z + nose),
    ]  # fmt: skip
    x, _, z = car.position_m
    return [to_world(point, (x, z), car.yaw_rad) for point in shape]


def _number(stall: Stall) -> Text:
    """Beside the mouth, level; the stall's middle stays clear."""
    # all digits as wide as the widest, so that few are measured
    width = text_width(_DIGIT.sub("8", stall.number), _NUMBER_M)
    height = _NUMBER_M * min(1.0, _NUMBER_WIDTH_M / width)
    is_level = stall.edge in {Edge.UP, Edge.DOWN}
    inwards = _NUMBER_FROM_MOUTH_M if is_level else (_NUMBER_FROM_MOUTH_M + width * height / _NUMBER_M) / 2
    at = to_world((0.0, stall.length_m / 2 - inwards), stall.centre_m, stall.yaw_rad)
    return Text(at, stall.number, height, INK, kind="number")


def _arrows(graph: LaneGraph) -> Iterator[Line]:
    """A chevron for each direction of each pair of lanes that join, on its right; one between a lane and a portal."""
    nodes = graph.graph.nodes
    for one, other in sorted(tuple(sorted(edge)) for edge in graph.graph.edges):
        ends = [(nodes[square]["x_m"], nodes[square]["z_m"]) for square in (one, other)]
        kinds = graph.kind(one), graph.kind(other)
        backwards = kinds[1] is LaneKind.ENTRANCE or kinds[0] is LaneKind.EXIT
        is_one_way = bool({LaneKind.ENTRANCE, LaneKind.EXIT} & set(kinds))
        if not backwards:
            yield _chevron(ends[0], ends[1], 0.0 if is_one_way else _KEEP_RIGHT_M)
        if backwards or not is_one_way:
            yield _chevron(ends[1], ends[0], 0.0 if is_one_way else _KEEP_RIGHT_M)


def _chevron(start: Point, end: Point, aside_m: float) -> Line:
    length = math.dist(start, end)
    dx, dz = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    x, z = (start[0] + end[0]) / 2 - dz * aside_m, (start[1] + end[1]) / 2 + dx * aside_m
    size = _CHEVRON_M
    wings = [(x - (dx + side * dz) * size, z - (dz - side * dx) * size) for side in (1, -1)]
    return Line([wings[0], (x, z), wings[1]], _ARROW, 1.5 * _LINE_M, "direction")


def _building(layout: Layout) -> Iterator[Area]:
    for place in layout.of_kind(ObjectKind.OBSTACLE):
        if isinstance(place.spec, ObstacleSpec):
            yield _placed(place, place.spec.width_m, place.spec.depth_m, _SOLID, "obstacle")
    for place in layout.of_kind(ObjectKind.WALL):
        if isinstance(place.spec, WallSpec):
            half = place.spec.length_m / 2
            yield _turned(place, rectangle(-half, -place.spec.thickness_m, half, 0.0), INK, "wall")
        elif isinstance(place.spec, WallPostSpec):
            yield _placed(place, place.spec.side_m, place.spec.side_m, INK, "wall")
    for place in layout.of_kind(ObjectKind.COLUMN):
        if isinstance(place.spec, ColumnSpec):
            yield _placed(place, place.spec.size_m, place.spec.size_m, INK, "column")


def _portals(layout: Layout, sheet: Sheet) -> Iterator[Area | Line | Text]:
    """The wall beside a door, and outside of it an arrow with a word."""
    for place in layout.of_kind(ObjectKind.PORTAL):
        spec = place.spec
        if not isinstance(spec, PortalSpec):
            continue
        half, door, back = spec.length_m / 2, spec.door_width_m / 2, -spec.thickness_m
        for sides in ((-half, -door), (door, half)):
            yield _turned(place, rectangle(sides[0], back, sides[1], 0.0), INK, "wall")
        kind = LaneKind.ENTRANCE if spec.is_entrance else LaneKind.EXIT
        yield _turned(place, rectangle(-door, back, door, 0.0), _LANE_COLOUR[kind], f"portal {kind}")
        x, _, z = place.position_m
        tail, tip = (-3.0, -0.8) if spec.is_entrance else (-0.8, -3.0)
        wing = tip + math.copysign(0.9, tail - tip)
        strokes = [[(0.0, tail), (0.0, tip)], [(-0.8, wing), (0.0, tip), (0.8, wing)]]
        for stroke in strokes:
            points = [to_world(point, (x, z), place.yaw_rad) for point in stroke]
            yield Line(points, _LANE_COLOUR[kind], 0.35, "direction")
        word = "IN" if spec.is_entrance else "OUT"
        is_beside = abs(math.sin(place.yaw_rad)) > 0.5  # noqa: PLR2004 - a quarter turn
        half = (text_width(word, sheet.letters_m) if is_beside else sheet.letters_m) / 2
        at = to_world((0.0, -ARROW_END_M - half), (x, z), place.yaw_rad)
        yield Text(at, word, sheet.letters_m, _LANE_COLOUR[kind], kind="portal")


def _route(graph: LaneGraph, stall: Stall) -> Iterator[Area | Line]:
    """Both ways on the right side of the lanes, and the stall with a frame."""
    route = route_of(graph, stall)
    corners = stall.corners_m()
    yield Line([*corners, corners[0]], _IN, 2.5 * _LINE_M, "chosen")
    mouth = to_world((0.0, stall.length_m / 2), stall.centre_m, stall.yaw_rad)
    inside = to_world((0.0, stall.length_m / 2 - _ROUTE_INTO_STALL_M), stall.centre_m, stall.yaw_rad)
    yield from _way(graph, route.to_stall, [mouth, inside], _IN, "way in")
    yield from _way(graph, tuple(reversed(route.from_stall)), [mouth, inside], _OUT, "way out", is_reversed=True)


def _way(
    graph: LaneGraph,
    squares: Sequence[Square],
    end: Sequence[Point],
    colour: Colour,
    kind: str,
    *,
    is_reversed: bool = False,
) -> Iterator[Line]:
    """From a portal to a stall, or reversed; with an arrow's head."""
    nodes = graph.graph.nodes
    middles = [(nodes[square]["x_m"], nodes[square]["z_m"]) for square in squares]
    # the lane before the stall is left where the mouth lies
    before, mouth = middles[-1], end[0]
    is_along_x = abs(end[1][0] - mouth[0]) < abs(end[1][1] - mouth[1])
    turn = (mouth[0], before[1]) if is_along_x else (before[0], mouth[1])
    points = [*middles[:-1], turn, *end]
    aside = -_ROUTE_ASIDE_M if is_reversed else _ROUTE_ASIDE_M
    line = shapely.LineString(_distinct(points)).offset_curve(aside, join_style="mitre")
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
    kept = [points[0]]
    for point in points[1:]:
        if math.dist(point, kept[-1]) > _LINE_M:
            kept.append(point)
    return kept


def _placed(place: Placement, width_m: float, depth_m: float, colour: Colour, kind: str) -> Area:
    return _turned(place, rectangle(-width_m / 2, -depth_m / 2, width_m / 2, depth_m / 2), colour, kind)


def _turned(place: Placement, shape: Sequence[Point], colour: Colour, kind: str) -> Area:
    x, _, z = place.position_m
    return Area([to_world(point, (x, z), place.yaw_rad) for point in shape], colour, kind)
