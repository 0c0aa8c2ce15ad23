"""A layout, and a plan that could not be laid out, as a subject."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from garage2usd.checks.shapes import Body, MeshShape, Thing, turned_about_y
from garage2usd.checks.subject import Subject
from garage2usd.config import BayConfig
from garage2usd.layout import Layout, Stall, StallUse
from garage2usd.layout.parking import stalls_of
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects import KINDS, Spec
from garage2usd.reading.ground import Fault, LaneNode, StallOutline
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneGraph

__all__ = ["layout_subject", "unlaid_subject"]


def layout_subject(
    layout: Layout, graph: LaneGraph, *, source: str, kind: str, faults: tuple[Fault, ...] = ()
) -> Subject:
    """Everything that a layout tells; what only lies on the floor is left out."""
    lux = layout.illuminance
    return Subject(
        source=source,
        kind=kind,
        stalls=tuple(_outline(stall, graph, layout.blocked) for stall in layout.stalls),
        nodes=_nodes(graph),
        edges=graph.edges,
        things=_things(layout),
        structure=layout.structure,
        compartments=layout.compartments,
        lane_lux=lux.lanes.mean if lux.lanes else None,
        stall_lux=lux.stalls.mean if lux.stalls else None,
        lamps=lux.lamps,
        dead_lamps=lux.dead_lamps,
        faults=faults,
    )


def unlaid_subject(
    structure: Structure, graph: LaneGraph, bay: BayConfig, *, source: str, kind: str, faults: tuple[Fault, ...]
) -> Subject:
    """What a plan tells that cannot be laid out: stalls and lanes, no objects and no light."""
    return Subject(
        source=source,
        kind=kind,
        stalls=tuple(_outline(stall, graph, {}) for stall in stalls_of(TileGrid(structure, graph, bay), graph, bay)),
        nodes=_nodes(graph),
        edges=graph.edges,
        structure=structure,
        faults=faults,
    )


def _outline(stall: Stall, graph: LaneGraph, blocked: Mapping[str, str]) -> StallOutline:
    left, right, rear_right, rear_left = stall.corners_m()
    corners = (left, right, rear_right, rear_left)
    said = {"number": stall.number, "blocked_by": blocked.get(stall.name, "")}
    facts = tuple((fact, value) for fact, value in said.items() if value)
    return StallOutline(stall.name, corners, StallUse(stall.use), graph.number_of[stall.access_square], facts)


def _nodes(graph: LaneGraph) -> tuple[LaneNode, ...]:
    rows = zip(graph.number_of, graph.middles_m.tolist(), graph.clear_m.tolist(), strict=True)
    return tuple(
        LaneNode(graph.kind((row, col)).value, (x, z), (across_x, across_z), f"[{row}, {col}]")
        for (row, col), (x, z), (across_x, across_z) in rows
    )


def _things(layout: Layout) -> tuple[Thing, ...]:
    paths = arrange(layout, nested=False).paths()
    objects = layout.placements
    rows = objects.rows_of(*(kind.name for kind in KINDS if kind.is_solid))
    things = []
    matrices = turned_about_y(objects.yaw_rad[rows], objects.position_m[rows])
    for row, number, matrix in zip(rows.tolist(), objects.spec[rows].tolist(), matrices, strict=True):
        spec = objects.specs[number]
        bodies = tuple(Body(shape, matrix, touches) for shape, touches in _shapes(spec.shape))
        things.append(Thing(paths[row], spec.kind.label, bodies))
    return tuple(things)


@lru_cache(maxsize=1024)
def _shapes(spec: Spec) -> tuple[tuple[MeshShape, bool], ...]:
    """The meshes of a spec, and whether each has a collider."""
    return tuple(
        (
            MeshShape(
                part.points.astype(np.float64), part.face_counts.astype(np.int64), part.face_indices.astype(np.int64)
            ),
            part.collider is not None,
        )
        for part in asset_of(spec).parts
    )
