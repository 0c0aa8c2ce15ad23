"""Lanes on a plan: through lanes, dead ends and driving directions."""

import math
from collections.abc import Iterator

import numpy as np
import shapely

from garage2usd.garage import LaneGraph, LaneKind
from garage2usd.layout import Layout
from garage2usd.objects.floor import FloorSpec
from garage2usd.objects.outline import rectangle
from garage2usd.planning import MeasuredCirculation
from garage2usd.structure.grid import Cell
from garage2usd.view.drawing import Colour, Line, Point, Region

__all__ = ["DEAD_END", "FREE", "LANDING", "LANE_COLOUR", "LINE_M", "arrows", "lane_legend", "ribbons", "squares"]

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
    """Return the floor of a garage without a grid, and its lanes as ribbons of their own width."""
    for floor in layout.of_kind("floor"):
        (x, _, z), spec = floor.position_m, floor.spec
        assert isinstance(spec, FloorSpec)
        half_x, half_z = spec.width_m / 2, spec.depth_m / 2
        yield Region(rectangle(x - half_x, z - half_z, x + half_x, z + half_z), FREE, "free")
    lanes = layout.lane_graph
    for edge in lanes.edges:
        ends = [lanes.nodes[number].position for number in (edge.start, edge.end)]
        ground = shapely.LineString(ends).buffer(edge.width_m / 2, quad_segs=4)
        yield Region(list(ground.exterior.coords)[:-1], LANE_COLOUR[LaneKind.STRAIGHT], "lane")


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
