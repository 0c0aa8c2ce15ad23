"""Lanes on a plan: through lanes, dead ends and directions, portals with their ramps, and ramps between levels."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import shapely

from garage2usd.garage import LaneGraph, LaneKind
from garage2usd.layout import Layout, Placement
from garage2usd.layout.placement import of_spec
from garage2usd.layout.surveyed import SurveyedFloor
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.kind import rectangle
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.ramp import RampSpec
from garage2usd.planning import MeasuredCirculation
from garage2usd.structure.grid import Cell
from garage2usd.view.drawing import Colour, Line, Point, Region, Text, text_width
from garage2usd.view.plan_sheet import ARROW_END_M, GREY, INK, PAPER, Sheet

LANE_COLOUR: dict[LaneKind, Colour] = {
    LaneKind.CROSSROADS: (98, 146, 148),
    LaneKind.T_JUNCTION: (114, 158, 158),
    LaneKind.STRAIGHT: (132, 172, 170),
    LaneKind.ENTRANCE: (72, 160, 96),
    LaneKind.EXIT: (206, 84, 72),
}
"""Colours of lanes by kind; lanes in dead ends have a tint of their own."""
_LANE_NAME = {
    LaneKind.CROSSROADS: "crossroads",
    LaneKind.T_JUNCTION: "T-junction",
    LaneKind.STRAIGHT: "lane driven through",
    LaneKind.ENTRANCE: "entrance",
    LaneKind.EXIT: "exit",
}
DEAD_END: Colour = (204, 152, 104)
LANDING: Colour = (140, 124, 188)
"""Colour of the squares at head and foot of a ramp between levels, which lead to no street."""
FREE: Colour = (226, 224, 216)
_SEAM: Colour = (206, 204, 196)
_ARROW: Colour = (236, 238, 242)
LINE_M = 0.12
_KEEP_RIGHT_M = 1.3
_CHEVRON_M = 0.7
RAMP: Colour = (214, 216, 214)
_TREAD_M = 0.8
_BREAK_M = 0.35
_ARROW_M, _WING_M = 6.0, 0.9
_ARROW_PARTS = 6
_STROKE_M = 0.25
_LEAST_M2 = 1e-3
_WORD_ASIDE_M = 1.6


def lane_legend(layout: Layout, found: MeasuredCirculation | None) -> list[tuple[Colour, str]]:
    """List the kinds of lane on the plan with their colours."""
    if found is None:
        return [(LANE_COLOUR[LaneKind.STRAIGHT], "lane")]
    is_lane, landings = layout.structure.cells >= Cell.LANE, layout.landings
    tiles = zip(np.argwhere(is_lane).tolist(), found.circulation.rounds[is_lane].tolist(), strict=True)
    kinds = {
        node.kind
        for node, (square, pruned) in zip(layout.lane_graph.nodes, tiles, strict=True)
        if not pruned and tuple(square) not in landings
    }
    entries = [(LANE_COLOUR[kind], _LANE_NAME[kind]) for kind in LaneKind if kind in kinds]
    entries += [(LANDING, "landing of a ramp")] if landings else []
    return entries + ([(DEAD_END, "dead end")] if found.dead_ends else [])


def squares(layout: Layout, found: MeasuredCirculation) -> Iterator[Region | Line]:
    """Draw every square in the colour of its kind; lanes in dead ends have a separate tint."""
    structure, rounds = layout.structure, found.circulation.rounds
    x, z = structure.column_edges_m.tolist(), structure.row_edges_m.tolist()
    nodes = iter(layout.lane_graph.nodes)  # tiles are numbered in reading order
    for row, line in enumerate(structure.cells.tolist()):
        for col, cell in enumerate(line):
            if cell == Cell.OBSTACLE:
                continue
            kind = LaneKind(next(nodes).kind) if cell != Cell.FREE else None
            box = rectangle(x[col], z[row], x[col + 1], z[row + 1])
            if kind is None:
                yield Region(box, FREE, "free")
            elif (row, col) in layout.landings:
                yield Region(box, LANDING, "landing")
            elif rounds[row, col]:
                yield Region(box, DEAD_END, f"{kind} dead_end")
            else:
                yield Region(box, LANE_COLOUR[kind], f"{kind} through")
            yield Line([*box, box[0]], _SEAM, LINE_M / 4)


def ribbons(layout: Layout) -> Iterator[Region]:
    """Return the floor of a garage without a grid, and its lanes as ribbons of their own width, up to the walls."""
    assert isinstance(layout.source, SurveyedFloor)
    inside = layout.source.survey.ground
    for floor in layout.of_kind("floor"):
        (x, _, z), spec = floor.position_m, floor.spec
        assert isinstance(spec, FloorSpec)
        half_x, half_z = spec.width_m / 2, spec.depth_m / 2
        yield from _within(inside, shapely.box(x - half_x, z - half_z, x + half_x, z + half_z), FREE, "free")
    lanes = layout.lane_graph
    for edge in lanes.edges:
        ends = [lanes.nodes[number].position for number in (edge.start, edge.end)]
        ground = shapely.LineString(ends).buffer(edge.width_m / 2, quad_segs=4)
        yield from _within(inside, ground, LANE_COLOUR[LaneKind.STRAIGHT], "lane")


def _within(inside: shapely.Geometry, ground: shapely.Polygon, colour: Colour, name: str) -> Iterator[Region]:
    for part in shapely.get_parts(shapely.normalize(ground.intersection(inside))):
        if part.area > _LEAST_M2:
            yield Region(list(part.exterior.coords)[:-1], colour, name)


def arrows(lanes: LaneGraph) -> Iterator[Line]:
    """Draw a chevron for each direction of each lane edge, on its right; a single one between lane and portal."""
    for (start, end), edge in lanes.arcs.items():
        yield _chevron(lanes.nodes[start].position, lanes.nodes[end].position, 0.0 if edge.one_way else _KEEP_RIGHT_M)


def _chevron(start: Point, end: Point, aside_m: float) -> Line:
    length = math.dist(start, end)
    dx, dz = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    x, z = (start[0] + end[0]) / 2 - dz * aside_m, (start[1] + end[1]) / 2 + dx * aside_m
    size = _CHEVRON_M
    wings = [(x - (dx + side * dz) * size, z - (dz - side * dx) * size) for side in (1, -1)]
    return Line([wings[0], (x, z), wings[1]], _ARROW, 1.5 * LINE_M, "direction")


def ramps(layout: Layout, sheet: Sheet) -> Iterator[Region | Line]:
    """Draw each ramp from its door to its end, or to a break line where the sheet cuts it off."""
    for place, spec in of_spec(layout.of_kind("ramp"), RampSpec):
        half, near = spec.width_m / 2, spec.profile[0][0]
        far = min(spec.profile[-1][0], sheet.ramp_m)
        yield turned(place, rectangle(-half, -far, half, -near), RAMP, "ramp")
        treads = range(1, math.ceil((far - near) / _TREAD_M))
        for run in (near + number * _TREAD_M for number in treads):
            yield _line(place, [(-half, -run), (half, -run)], PAPER, LINE_M / 2)
        for side in (-1, 1):
            outer = side * (half + spec.wall_m)
            yield turned(place, rectangle(min(side * half, outer), -far, max(side * half, outer), -near), INK, "ramp")
        if far < spec.profile[-1][0]:
            out = half + spec.wall_m
            zigzag = [(-out, -far), (-_BREAK_M, -far), (0.0, _BREAK_M - far), (0.0, -_BREAK_M - far)]
            yield _line(place, [*zigzag, (_BREAK_M, -far), (out, -far)], GREY, LINE_M)


def portals(layout: Layout, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw the jambs of each door, and outside of it an arrow with a word."""
    for place, spec in of_spec(layout.of_kind("portal"), PortalSpec):
        half, door, back = spec.length_m / 2, spec.door_width_m / 2, -spec.thickness_m
        for sides in ((-half, -door), (door, half)):
            yield turned(place, rectangle(sides[0], back, sides[1], 0.0), INK, "wall")
        kind = LaneKind.ENTRANCE if spec.is_entrance else LaneKind.EXIT
        yield turned(place, rectangle(-door, back, door, 0.0), LANE_COLOUR[kind], f"portal {kind}")
        is_both = spec.is_entrance is None
        tail, tip = (-3.0, -0.8) if spec.is_entrance else (-0.8, -3.0)
        strokes = [[(0.0, tail), (0.0, tip)]]
        for end, start in ((tip, tail), *(((tail, tip),) if is_both else ())):
            wing = end + math.copysign(0.9, start - end)
            strokes.append([(-0.8, wing), (0.0, end), (0.8, wing)])
        for stroke in strokes:
            yield Line([place.to_world(point) for point in stroke], LANE_COLOUR[kind], 0.35, "direction")
        word = "IN/OUT" if is_both else "IN" if spec.is_entrance else "OUT"
        is_beside = abs(math.sin(place.yaw_rad)) > 0.5  # noqa: PLR2004 - a quarter turn
        half = (text_width(word, sheet.letters_m) if is_beside else sheet.letters_m) / 2
        yield Text(place.to_world((0.0, -ARROW_END_M - half)), word, sheet.letters_m, LANE_COLOUR[kind], kind="portal")


def turned(place: Placement, shape: Sequence[Point], colour: Colour, kind: str) -> Region:
    """Transform a shape to a placement."""
    return Region([place.to_world(point) for point in shape], colour, kind)


def _line(place: Placement, shape: Sequence[Point], colour: Colour, width_m: float) -> Line:
    return Line([place.to_world(point) for point in shape], colour, width_m, "ramp")


def level_title(layout: Layout) -> str:
    """Return the level of a layout as the beginning of its title; empty in a garage of one level."""
    return f"{layout.well.name}: " if layout.well else ""


def wells(layout: Layout, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw the ramps that begin or end on a level."""
    if isinstance(layout.source, SurveyedFloor):
        for ramp in (*layout.source.part.ramps.up, *layout.source.part.ramps.down):
            points = [(x, z) for x, _, z in ramp.points()]
            yield from _ramp(points, ramp.line.width_m, "down" if ramp.is_down else "up", sheet)
    if layout.well is None:
        return
    columns, rows = (edges.tolist() for edges in (layout.structure.column_edges_m, layout.structure.row_edges_m))
    for row, col in layout.landings:
        middle = (columns[col] + columns[col + 1]) / 2, (rows[row] + rows[row + 1]) / 2
        yield Text(middle, "landing", sheet.letters_m, INK, kind="landing")
    down, up = layout.well.lanes(layout.structure)
    for lane, is_down in ((down, True), (up, False)):
        word = ("down" if is_down else "up") + layout.well.way_in_words(is_down=is_down)
        yield from _ramp([(x, z) for x, _, z in lane.points], lane.width_m, word, sheet)


def _ramp(points: list[Point], width_m: float, word: str, sheet: Sheet) -> Iterator[Region | Line | Text]:
    """Draw a ramp between levels along a line in the direction of driving."""
    line, half = _Line(points), width_m / 2
    run = line.length_m
    left, right = line.beside(-half), line.beside(half)
    yield from (
        Region([a, b, c, d], RAMP, "ramp") for (a, b), (d, c) in zip(pairwise(left), pairwise(right), strict=True)
    )
    for number in range(1, math.ceil(run / _TREAD_M)):
        tread = [line.at(number * _TREAD_M, -half), line.at(number * _TREAD_M, half)]
        yield Line(tread, PAPER, LINE_M / 2, "ramp")
    tail, tip = (run - _ARROW_M) / 2, (run + _ARROW_M) / 2
    shaft = [line.at(tail + share * _ARROW_M / _ARROW_PARTS, 0) for share in range(_ARROW_PARTS + 1)]
    yield Line(shaft, INK, _STROKE_M, "direction")
    wings = [line.at(tip - _WING_M, -_WING_M), line.at(tip, 0), line.at(tip - _WING_M, _WING_M)]
    yield Line(wings, INK, _STROKE_M, "direction")
    # in the middle of a helix, or beside the arrow of a straight ramp
    place = line.middle if math.dist(line.middle, line.at(run / 2, 0)) > width_m else None
    yield Text(place or line.at(run / 2, _WORD_ASIDE_M), word, sheet.letters_m, INK, kind="ramp")


class _Line:
    """A line of straight pieces, with places along it and to its right."""

    def __init__(self, points: list[Point]) -> None:
        self._points = np.array(points)
        steps = np.diff(self._points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        self._runs = np.concatenate([[0.0], np.cumsum(lengths)])
        ways = steps / lengths[:, None]
        mean = np.concatenate([ways[:1], ways[:-1] + ways[1:], ways[-1:]])
        self._along = mean / np.linalg.norm(mean, axis=1, keepdims=True)

    @property
    def length_m(self) -> float:
        return float(self._runs[-1])

    @property
    def middle(self) -> Point:
        """Mean of the places along the line."""
        steps = np.diff(self._runs)[:, None]
        x, z = ((self._points[:-1] + self._points[1:]) / 2 * steps).sum(axis=0) / self.length_m
        return float(x), float(z)

    def beside(self, aside: float) -> list[Point]:
        """Return the corners of the line moved to the right."""
        moved = self._points + aside * np.stack([-self._along[:, 1], self._along[:, 0]], axis=1)
        return [(float(x), float(z)) for x, z in moved]

    def at(self, forward: float, aside: float) -> Point:
        """Return the point at a distance along the line and to its right."""
        x, z, along_x, along_z = (
            float(np.interp(forward, self._runs, values)) for values in (*self._points.T, *self._along.T)
        )
        return x - aside * along_z, z + aside * along_x
