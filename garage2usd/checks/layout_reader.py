"""A layout, and a plan that could not be laid out, as a subject."""

from functools import lru_cache

import numpy as np

from garage2usd.checks.shapes import Body, Shape, Thing, turned_about_y
from garage2usd.checks.subject import Fault, LaneEdge, LaneNode, StallOutline, Subject
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.driving.layout_garage import numbered_squares
from garage2usd.layout import Layout, Stall, StallUse
from garage2usd.layout.parking import stalls_of
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects import KINDS, Spec
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneGraph, Square

__all__ = ["layout_subject", "unlaid_subject"]


def layout_subject(
    layout: Layout, graph: LaneGraph, config: GarageConfig, *, source: str, kind: str, faults: tuple[Fault, ...] = ()
) -> Subject:
    """Everything that a layout tells; what only lies on the floor is left out."""
    number = numbered_squares(graph)
    lux = layout.illuminance
    return Subject(
        source=source,
        kind=kind,
        stalls=tuple(_outline(stall, number) for stall in layout.stalls),
        nodes=_nodes(layout.structure, graph, number, config.bay),
        edges=_edges(layout.structure, graph, number, config.bay),
        things=_things(layout),
        structure=layout.structure,
        compartments=layout.compartments,
        lane_lux=lux.lanes.mean if lux.lanes else None,
        stall_lux=lux.stalls.mean if lux.stalls else None,
        faults=faults,
    )


def unlaid_subject(
    structure: Structure, graph: LaneGraph, bay: BayConfig, *, source: str, kind: str, faults: tuple[Fault, ...]
) -> Subject:
    """What a plan tells that cannot be laid out: stalls and lanes, no objects and no light."""
    number = numbered_squares(graph)
    return Subject(
        source=source,
        kind=kind,
        stalls=tuple(_outline(stall, number) for stall in stalls_of(TileGrid(structure, graph, bay), graph, bay)),
        nodes=_nodes(structure, graph, number, bay),
        edges=_edges(structure, graph, number, bay),
        structure=structure,
        faults=faults,
    )


def _outline(stall: Stall, number: dict[Square, int]) -> StallOutline:
    left, right, rear_right, rear_left = stall.corners_m()
    corners = (left, right, rear_right, rear_left)
    return StallOutline(stall.name, corners, StallUse(stall.use), number[stall.access_square])


def _nodes(structure: Structure, graph: LaneGraph, number: dict[Square, int], bay: BayConfig) -> tuple[LaneNode, ...]:
    nodes = []
    for row, col in number:
        at = graph.graph.nodes[row, col]
        sides = _clear_m(structure, (row, col), bay)
        nodes.append(LaneNode(graph.kind((row, col)).value, (at["x_m"], at["z_m"]), sides, f"[{row}, {col}]"))
    return tuple(nodes)


def _edges(structure: Structure, graph: LaneGraph, number: dict[Square, int], bay: BayConfig) -> tuple[LaneEdge, ...]:
    edges = []
    for first, second, one_way in graph.directed_edges():
        across = 0 if first[1] == second[1] else 1
        width = min(_clear_m(structure, square, bay)[across] for square in (first, second))
        edges.append(LaneEdge(number[first], number[second], width, one_way))
    return tuple(edges)


def _clear_m(structure: Structure, square: Square, bay: BayConfig) -> tuple[float, float]:
    """Metres between the columns across X and Z."""
    sides = structure.column_widths_mm[square[1]], structure.row_depths_mm[square[0]]
    width, depth = (float(side) / 1000 - 2 * bay.carriageway_setback_m for side in sides)
    return width, depth


def _things(layout: Layout) -> tuple[Thing, ...]:
    paths = arrange(layout, nested=False).paths()
    objects = layout.placements
    rows = objects.rows_of(*(kind.name for kind in KINDS if kind.is_solid))
    things = []
    for row, placement in zip(rows.tolist(), objects.at(rows), strict=True):
        matrix = turned_about_y(placement.yaw_rad, placement.position_m)
        bodies = tuple(Body(shape, matrix, touches) for shape, touches in _shapes(placement.spec))
        things.append(Thing(paths[row], placement.spec.kind.label, bodies))
    return tuple(things)


@lru_cache(maxsize=1024)
def _shapes(spec: Spec) -> tuple[tuple[Shape, bool], ...]:
    """The meshes of a spec, and whether each has a collider."""
    return tuple(
        (
            Shape(
                part.points.astype(np.float64), part.face_counts.astype(np.int64), part.face_indices.astype(np.int64)
            ),
            part.collider is not None,
        )
        for part in asset_of(spec).parts
    )
