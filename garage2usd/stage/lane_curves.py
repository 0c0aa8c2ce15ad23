"""The lane graph and the stalls as guide curves, so that a program can drive on the stage alone."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Kind, Sdf, UsdGeom, Vt

from garage2usd.lanes import LaneGraph, Square
from garage2usd.layout import Layout, Stall
from garage2usd.stage.authoring import attribute, define, set_units
from garage2usd.stalls import Edge

__all__ = ["LANE_GRAPH_FILE", "write_lane_graph"]

LANE_GRAPH_FILE = "LaneGraph.usdc"
"""Layer of the lane graph, beside the assets."""

_LIFT_M = 0.05
_NODE_RADIUS_M = 0.4
_NODE_CORNERS = 8
_LINE_WIDTH_M = 0.1
_TYPES = Sdf.ValueTypeNames
_EDGE_NAMES = {edge: edge.name.lower() for edge in Edge}


def write_lane_graph(path: Path, layout: Layout, graph: LaneGraph, *, setback_m: float) -> None:
    """Write a layer of its own, as text is slow with long arrays, with the curves ``Nodes``, ``Edges`` and ``Stalls``.

    Notes
    -----
    All are of the purpose guide, and each attribute holds one value a curve. ``Nodes`` has a ring for each lane square
    and portal, with ``garage:lane:kind``, ``:row``, ``:column`` and the metres between the columns across X and Z in
    ``:widths``. ``Edges`` has a line from middle to middle for each pair that joins, with ``garage:lane:from`` and
    ``:to`` (numbers of nodes), ``:length``, ``:width`` (metres) and ``:direction`` (``both``, or ``forward`` from an
    entrance and into an exit). ``Stalls`` has the outline of each stall, mouth left, mouth right, rear right, rear
    left, with ``garage:stall:id``, ``:number``, ``:type``, ``:use``, ``:row``, ``:column``, ``:accessNode`` (number of
    a node) and ``:entryEdge``. No attribute is ``int2[]`` or ``string[]``, which three.js cannot read from a crate.
    """
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    root = Sdf.Path.absoluteRootPath.AppendChild(path.stem)
    with Sdf.ChangeBlock():
        set_units(layer)
        layer.defaultPrim = path.stem
        group = define(layer, root, "Xform", kind=Kind.Tokens.group)
        attribute(group, "purpose", _TYPES.Token, UsdGeom.Tokens.guide, uniform=True)
        squares = sorted(graph.graph.nodes)
        number_of = {square: number for number, square in enumerate(squares)}
        _author_nodes(layer, root.AppendChild("Nodes"), layout, graph, squares, setback_m)
        _author_edges(layer, root.AppendChild("Edges"), layout, graph, number_of, setback_m)
        _author_stalls(layer, root.AppendChild("Stalls"), layout.stalls, number_of)
    layer.Export(str(path))


def _author_nodes(
    layer: Sdf.Layer, path: Sdf.Path, layout: Layout, graph: LaneGraph, squares: Sequence[Square], setback_m: float
) -> None:
    angles = np.arange(_NODE_CORNERS) * math.tau / _NODE_CORNERS
    ring = _NODE_RADIUS_M * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    prim = _author_curves(layer, path, _middles(graph, squares)[:, None] + ring, closed=True)
    kinds = [graph.kind(square).value for square in squares]
    attribute(prim, "garage:lane:kind", _TYPES.TokenArray, Vt.TokenArray(kinds))
    _author_squares(prim, "garage:lane", squares)
    widths = (_sides_m(layout, squares) - 2 * setback_m).astype(np.float32)
    attribute(prim, "garage:lane:widths", _TYPES.Float2Array, Vt.Vec2fArray.FromNumpy(widths))


def _author_edges(
    layer: Sdf.Layer,
    path: Sdf.Path,
    layout: Layout,
    graph: LaneGraph,
    number_of: Mapping[Square, int],
    setback_m: float,
) -> None:
    edges = [_directed(graph, *pair) for pair in sorted(tuple(sorted(edge)) for edge in graph.graph.edges)]
    starts, ends = [edge[0] for edge in edges], [edge[1] for edge in edges]
    ways = np.stack([_middles(graph, starts), _middles(graph, ends)], axis=1)
    prim = _author_curves(layer, path, ways, closed=False)
    _author_numbers(prim, "garage:lane:from", [number_of[square] for square in starts])
    _author_numbers(prim, "garage:lane:to", [number_of[square] for square in ends])
    attribute(prim, "garage:lane:direction", _TYPES.TokenArray, Vt.TokenArray([edge[2] for edge in edges]))
    lengths = np.linalg.norm(ways[:, 1] - ways[:, 0], axis=1).astype(np.float32)
    attribute(prim, "garage:lane:length", _TYPES.FloatArray, Vt.FloatArray.FromNumpy(lengths))
    across = np.array([int(start[1] == end[1]) for start, end in zip(starts, ends, strict=True)])
    sides = np.minimum(_sides_m(layout, starts), _sides_m(layout, ends))
    widths = (sides[np.arange(len(edges)), 1 - across] - 2 * setback_m).astype(np.float32)
    attribute(prim, "garage:lane:width", _TYPES.FloatArray, Vt.FloatArray.FromNumpy(widths))


def _author_stalls(layer: Sdf.Layer, path: Sdf.Path, stalls: Sequence[Stall], number_of: Mapping[Square, int]) -> None:
    prim = _author_curves(layer, path, _outlines(stalls), closed=True)
    words = {
        "id": [stall.name for stall in stalls],
        "number": [stall.number for stall in stalls],
        "type": [str(stall.stall_type) for stall in stalls],
        "use": [str(stall.use) for stall in stalls],
        "entryEdge": [_EDGE_NAMES[stall.edge] for stall in stalls],
    }
    for name, values in words.items():
        attribute(prim, f"garage:stall:{name}", _TYPES.TokenArray, Vt.TokenArray(values))
    _author_squares(prim, "garage:stall", [stall.square for stall in stalls])
    _author_numbers(prim, "garage:stall:accessNode", [number_of[stall.access_square] for stall in stalls])


def _outlines(stalls: Sequence[Stall]) -> NDArray[np.float64]:
    """Corners (x, z) of stalls as `Stall.corners_m` has them; float64, shape (stalls, 4, 2)."""
    measures = np.array([(*s.centre_m, s.yaw_rad, s.width_m / 2, s.length_m / 2) for s in stalls]).T
    x, z, yaw, half_width, half_length = measures[:, :, None]
    across, along = np.array([-1, 1, 1, -1]) * half_width, np.array([1, 1, -1, -1]) * half_length
    cos, sin = np.cos(yaw), np.sin(yaw)
    return np.stack([x + across * cos + along * sin, z - across * sin + along * cos], axis=2)


def _directed(graph: LaneGraph, one: Square, other: Square) -> tuple[Square, Square, str]:
    """From an entrance, into an exit, or both ways."""
    kinds = graph.kind(one).value, graph.kind(other).value
    if kinds[1] == "entrance" or kinds[0] == "exit":
        return other, one, "forward"
    return one, other, "forward" if "entrance" in kinds or "exit" in kinds else "both"


def _middles(graph: LaneGraph, squares: Sequence[Square]) -> NDArray[np.float64]:
    nodes = graph.graph.nodes
    return np.array([(nodes[square]["x_m"], nodes[square]["z_m"]) for square in squares])


def _sides_m(layout: Layout, squares: Sequence[Square]) -> NDArray[np.float64]:
    """Extent of squares along X and Z; float64, shape (n, 2)."""
    rows, cols = np.array(squares).T
    structure = layout.structure
    sides: NDArray[np.float64] = (
        np.stack([structure.column_widths_mm[cols], structure.row_depths_mm[rows]], axis=1) / 1000
    )
    return sides


def _author_squares(prim: Sdf.PrimSpec, namespace: str, squares: Sequence[Square]) -> None:
    _author_numbers(prim, f"{namespace}:row", [row for row, _ in squares])
    _author_numbers(prim, f"{namespace}:column", [col for _, col in squares])


def _author_numbers(prim: Sdf.PrimSpec, name: str, numbers: Sequence[int]) -> None:
    attribute(prim, name, _TYPES.IntArray, Vt.IntArray.FromNumpy(np.array(numbers, dtype=np.int32)))


def _author_curves(layer: Sdf.Layer, path: Sdf.Path, lines: NDArray[np.float64], *, closed: bool) -> Sdf.PrimSpec:
    """Curves over the floor through (x, z) points, shape (curves, points, 2)."""
    count, corners, _ = lines.shape
    points = np.full((count * corners, 3), _LIFT_M, dtype=np.float32)
    points[:, [0, 2]] = lines.reshape(-1, 2)
    prim = define(layer, path, "BasisCurves")
    attribute(prim, "type", _TYPES.Token, UsdGeom.Tokens.linear, uniform=True)
    wrap = UsdGeom.Tokens.periodic if closed else UsdGeom.Tokens.nonperiodic
    attribute(prim, "wrap", _TYPES.Token, wrap, uniform=True)
    counts = np.full(count, corners, dtype=np.int32)
    attribute(prim, "curveVertexCounts", _TYPES.IntArray, Vt.IntArray.FromNumpy(counts))
    attribute(prim, "points", _TYPES.Point3fArray, Vt.Vec3fArray.FromNumpy(points))
    width = attribute(prim, "widths", _TYPES.FloatArray, Vt.FloatArray([_LINE_WIDTH_M]))
    width.SetInfo("interpolation", UsdGeom.Tokens.constant)
    extent = UsdGeom.Curves.ComputeExtent(Vt.Vec3fArray.FromNumpy(points), Vt.FloatArray([_LINE_WIDTH_M]))
    attribute(prim, "extent", _TYPES.Float3Array, extent)
    return prim
