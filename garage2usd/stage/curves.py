"""Guide curves above the floor: the lane graph, the stalls, and proven drives into and out of them."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Sdf, UsdGeom, Vt

from garage2usd.driving import Manoeuvre, StallProof, Waypoint
from garage2usd.garage import LaneGraph, Stall
from garage2usd.reading.lanes import GUIDE_LIFT_M
from garage2usd.stage.authoring import attribute, define, new_layer, numbers, words
from garage2usd.stage.variants import BLOCKED_BY, OCCUPIED

_TYPES = Sdf.ValueTypeNames
LANE_GRAPH_FILE = "LaneGraph.usdc"
"""Layer of the lane graph, beside the assets."""
_ROOT = Path(LANE_GRAPH_FILE).stem
STALL_OUTLINES = (_ROOT, "Stalls")
"""Names of the prims on the path to the outlines of all stalls."""
_NODE_RADIUS_M = 0.4
_NODE_CORNERS = 8
_LANE_LINE_M = 0.1
_LIFT_M = 0.06
_WAY_LINE_M = 0.06
_STEP_M = 0.25


def author_curves(
    layer: Sdf.Layer,
    path: Sdf.Path,
    line_m: NDArray[np.float64],
    counts: NDArray[np.int32],
    *,
    lift_m: float | NDArray[np.float64],
    width_m: float,
    closed: bool = False,
) -> Sdf.PrimSpec:
    """Author curves: straight lines from point to point.

    Parameters
    ----------
    layer, path
        Layer and path of the prim that holds all curves.
    line_m
        The points (x, z) of all curves, one after the other; float64, shape (points, 2).
    counts
        Number of points of each curve; int32, shape (curves,).
    lift_m
        Height of the points; one, or float64, shape (points,).
    width_m
        Width of the drawn line.
    closed
        True if the curves are closed.
    """
    points = np.empty((len(line_m), 3), dtype=np.float32)
    points[:, [0, 2]], points[:, 1] = line_m, lift_m
    prim = define(layer, path, "BasisCurves")
    attribute(prim, "type", _TYPES.Token, UsdGeom.Tokens.linear, uniform=True)
    wrap = UsdGeom.Tokens.periodic if closed else UsdGeom.Tokens.nonperiodic
    attribute(prim, "wrap", _TYPES.Token, wrap, uniform=True)
    attribute(prim, "curveVertexCounts", _TYPES.IntArray, Vt.IntArray.FromNumpy(counts))
    vectors = Vt.Vec3fArray.FromNumpy(points)
    attribute(prim, "points", _TYPES.Point3fArray, vectors)
    widths = Vt.FloatArray([width_m])
    attribute(prim, "widths", _TYPES.FloatArray, widths).SetInfo("interpolation", UsdGeom.Tokens.constant)
    attribute(prim, "extent", _TYPES.Float3Array, UsdGeom.Curves.ComputeExtent(vectors, widths))
    return prim


class Drivable(Protocol):
    """Lanes and stalls in metres: of a layout, or of all levels of a building.

    Attributes
    ----------
    lane_graph, quads
        Lane graph and stalls.
    blocked
        Id of each stall that a misparked car blocks, and of the stall of that car.
    """

    @property
    def lane_graph(self) -> LaneGraph: ...  # noqa: D102 - an attribute

    @property
    def quads(self) -> tuple[Stall, ...]: ...  # noqa: D102 - an attribute

    @property
    def blocked(self) -> Mapping[str, str]: ...  # noqa: D102 - an attribute

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) by which files name each lane node; int32, shape (nodes, 2)."""
        ...


def write_lane_graph(path: Path, layout: Drivable) -> None:
    """Write a layer with the lane graph and stalls as the curves ``Nodes``, ``Edges`` and ``Stalls``.

    Notes
    -----
    It is a separate layer, as text is slow with long arrays. All curves have the purpose guide, and each attribute
    holds one value per curve. ``Nodes`` has a ring for each lane square and portal, with ``garage:lane:kind``,
    ``:row``, ``:column`` and, in ``:widths``, the metres between the columns across X and Z. ``Edges`` has a line
    between the centres of each connected pair, with ``garage:lane:from`` and ``:to`` (indices of nodes), ``:length``,
    ``:width`` (metres) and ``:direction`` (``both``, or ``forward`` from an entrance, into an exit and on a one-way
    aisle). ``Stalls`` has the outline of each stall, entry left, entry right, rear right, rear left, with
    ``garage:stall:id``, ``:number``, ``:type``, ``:use``, ``:row``, ``:column``, ``:accessNode`` (index of a node),
    ``:entryEdge`` and ``:occupied`` (1 if a car is parked in it, else 0). If misparked cars block stalls,
    ``:blockedBy`` is the id of the stall of the car, or empty. If not all stalls are perpendicular and of the standard
    size, ``:kind``, ``:angleRad`` (of the long sides to the lane) and ``:size`` (class) are added. In a garage with
    several levels, nodes and stalls have ``:level``, from 0; all curves lie above the floor of their level. No
    attribute is ``bool[]``, ``int2[]`` or ``string[]``, which three.js cannot read from a crate file.
    """
    root = Sdf.Path.absoluteRootPath.AppendChild(_ROOT)
    with new_layer(path, default_prim=_ROOT) as layer:
        group = define(layer, root, "Xform", kind=Kind.Tokens.group)
        attribute(group, "purpose", _TYPES.Token, UsdGeom.Tokens.guide, uniform=True)
        _author_nodes(layer, root.AppendChild("Nodes"), layout)
        _author_edges(layer, root.AppendChild("Edges"), layout.lane_graph)
        _author_stalls(layer, root.AppendChild(STALL_OUTLINES[-1]), layout)


def _author_nodes(layer: Sdf.Layer, path: Sdf.Path, layout: Drivable) -> None:
    angles = np.arange(_NODE_CORNERS) * math.tau / _NODE_CORNERS
    ring = _NODE_RADIUS_M * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    lanes, squares = layout.lane_graph, layout.node_squares()
    prim = _author_curves(layer, path, lanes.positions_m[:, None] + ring, _heights_m(lanes)[:, None], closed=True)
    words(prim, "garage:lane:kind", (node.kind for node in lanes.nodes))
    numbers(prim, "garage:lane:row", squares[:, 0])
    numbers(prim, "garage:lane:column", squares[:, 1])
    widths_m = np.array([node.widths_m for node in lanes.nodes], dtype=np.float32)
    attribute(prim, "garage:lane:widths", _TYPES.Float2Array, Vt.Vec2fArray.FromNumpy(widths_m))
    _author_levels(prim, "garage:lane:level", [node.level for node in lanes.nodes])


def _author_edges(layer: Sdf.Layer, path: Sdf.Path, lanes: LaneGraph) -> None:
    ends = np.array([(edge.start, edge.end) for edge in lanes.edges], dtype=np.int32).reshape(-1, 2)
    lines = lanes.positions_m[ends]
    prim = _author_curves(layer, path, lines, _heights_m(lanes)[ends], closed=False)
    numbers(prim, "garage:lane:from", ends[:, 0])
    numbers(prim, "garage:lane:to", ends[:, 1])
    words(prim, "garage:lane:direction", ("forward" if edge.one_way else "both" for edge in lanes.edges))
    numbers(prim, "garage:lane:length", np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1))
    numbers(prim, "garage:lane:width", np.array([edge.width_m for edge in lanes.edges]))


def _author_stalls(layer: Sdf.Layer, path: Sdf.Path, layout: Drivable) -> None:
    stalls = layout.quads
    corners = np.array([stall.corners for stall in stalls], dtype=np.float64).reshape(-1, 4, 2)
    access = np.array([stall.access for stall in stalls], dtype=np.int32)
    prim = _author_curves(layer, path, corners, _heights_m(layout.lane_graph)[access, None], closed=True)
    words(prim, "garage:stall:id", (stall.name for stall in stalls))
    words(prim, "garage:stall:number", (str(stall.number or "") for stall in stalls))
    facts = [dict(stall.facts) for stall in stalls]
    words(prim, "garage:stall:type", (str(fact["type"]) for fact in facts))
    words(prim, "garage:stall:use", (stall.use.value for stall in stalls))
    if not all(stall.is_usual for stall in stalls):
        words(prim, "garage:stall:kind", (stall.kind.value for stall in stalls))
        angles_rad = np.radians([stall.slant_deg for stall in stalls])
        numbers(prim, "garage:stall:angleRad", angles_rad.round(6).astype(np.float32))
        words(prim, "garage:stall:size", (stall.size for stall in stalls))
    words(prim, "garage:stall:entryEdge", (str(fact["entryEdge"]) for fact in facts))
    for name in ("row", "column"):
        numbers(prim, f"garage:stall:{name}", np.array([fact[name] for fact in facts], dtype=np.int32))
    numbers(prim, "garage:stall:accessNode", access)
    _author_levels(prim, "garage:stall:level", [stall.level for stall in stalls])
    numbers(prim, OCCUPIED, np.array([fact["occupied"] for fact in facts], dtype=np.int32))
    if layout.blocked:
        words(prim, BLOCKED_BY, (stall.blocked_by or "" for stall in stalls))


def _heights_m(lanes: LaneGraph) -> NDArray[np.float64]:
    """Height of the floor at each lane node; float64, shape (nodes,)."""
    return np.array([node.height_m for node in lanes.nodes], dtype=np.float64)


def _author_levels(prim: Sdf.PrimSpec, name: str, levels: list[int]) -> None:
    """Author the level of each curve, unless the garage has one level only."""
    if any(levels):
        numbers(prim, name, np.array(levels, dtype=np.int32))


def _author_curves(
    layer: Sdf.Layer, path: Sdf.Path, lines: NDArray[np.float64], floor_m: NDArray[np.float64], *, closed: bool
) -> Sdf.PrimSpec:
    """Author curves through (x, z) points, shape (curves, points, 2), at the height of the floor below them."""
    count, corners, _ = lines.shape
    counts = np.full(count, corners, dtype=np.int32)
    lift_m = np.broadcast_to(floor_m + GUIDE_LIFT_M, (count, corners)).ravel()
    return author_curves(layer, path, lines.reshape(-1, 2), counts, lift_m=lift_m, width_m=_LANE_LINE_M, closed=closed)


def write_driving_layer(
    path: Path, proofs: Sequence[StallProof], *, floors_m: Mapping[str, float] | None = None
) -> None:
    """Write a layer ``over /Garage`` with the curves ``Ways/In`` and ``Ways/Out``.

    Notes
    -----
    A curve is the path of the rear axle's centre for one proven stall, 0.06 m above the floor, whose height under each
    stall `floors_m` has by name; without it all are at 0. Attributes with one
    value per curve: ``garage:way:stall``, ``garage:way:nose`` (``in`` or ``out``), ``garage:way:clearance`` (metres).
    Attributes with one value per point: ``garage:way:arc`` (metres driven), ``garage:way:yaw`` (radians, 0 along -Z),
    ``garage:way:gear`` (1 or -1) and ``garage:way:curvature`` (1/m, positive to the driver's left).
    """
    with new_layer(path, default_prim="Garage") as layer:
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        group = define(layer, garage.path.AppendChild("Ways"), "Xform", kind=Kind.Tokens.group)
        attribute(group, "purpose", Sdf.ValueTypeNames.Token, UsdGeom.Tokens.guide, uniform=True)
        for name in ("In", "Out"):
            ways = [
                (proof, way)
                for proof in proofs
                if (way := proof.way_in if name == "In" else proof.way_out) is not None and proof.is_proven
            ]
            _author_ways(layer, group.path.AppendChild(name), ways, floors_m or {})


def _author_ways(
    layer: Sdf.Layer,
    path: Sdf.Path,
    ways: Sequence[tuple[StallProof, Manoeuvre]],
    floors_m: Mapping[str, float],
) -> None:
    sampled: list[list[Waypoint]] = [list(way.waypoints(_STEP_M)) for _, way in ways]
    counts = np.array([len(samples) for samples in sampled], dtype=np.int32)
    every = [at for samples in sampled for at in samples]
    line_m = np.array([(at.pose.x_m, at.pose.z_m) for at in every]).reshape(-1, 2)
    lifts_m = np.repeat([_LIFT_M + floors_m.get(proof.stall, 0.0) for proof, _ in ways], counts)
    prim = author_curves(layer, path, line_m, counts, lift_m=lifts_m, width_m=_WAY_LINE_M)
    words(prim, "garage:way:stall", (proof.stall for proof, _ in ways))
    words(prim, "garage:way:nose", (proof.nose.value if proof.nose else "" for proof, _ in ways))
    columns = {
        "clearance": [way.clearance_m for _, way in ways],
        "arc": [at.arc_m for at in every],
        "yaw": [math.remainder(at.pose.yaw_rad, math.tau) for at in every],
        "curvature": [at.curvature_per_m for at in every],
    }
    for name, values in columns.items():
        numbers(prim, f"garage:way:{name}", np.array(values, dtype=np.float32))
    numbers(prim, "garage:way:gear", np.array([at.gear.sign for at in every], dtype=np.int32))
