"""The lane graph as guide curves, so that a program can drive on the stage alone."""

import math

from pxr import Gf, Kind, Sdf, UsdGeom, Vt

from garage2usd.grid import Structure
from garage2usd.lanes import LaneGraph, Square
from garage2usd.stage.authoring import attribute, define

__all__ = ["author_lane_graph", "square_name"]

_LIFT_M = 0.05
_NODE_RADIUS_M = 0.4
_NODE_CORNERS = 8
_LINE_WIDTH_M = 0.1


def square_name(square: Square) -> str:
    """Part of a prim name that tells the square: ``r03_c07``."""
    return f"r{square[0]:02d}_c{square[1]:02d}"


def author_lane_graph(
    layer: Sdf.Layer, path: Sdf.Path, structure: Structure, graph: LaneGraph, *, setback_m: float
) -> None:
    """Author a node curve for each lane square and portal, and an edge curve between those that join.

    Notes
    -----
    A node is a ring with ``garage:lane:kind``, ``:square`` and ``:widths`` (metres across X and Z); an edge leads from
    middle to middle with ``garage:lane:from`` and ``:to`` (squares), ``:length``, ``:width`` (metres of carriageway)
    and ``:direction`` (``both``, or ``forward`` from an entrance and into an exit). All are of the purpose guide.
    """
    group = define(layer, path, "Xform", kind=Kind.Tokens.group)
    attribute(group, "purpose", Sdf.ValueTypeNames.Token, UsdGeom.Tokens.guide, uniform=True)
    nodes, edges = path.AppendChild("Nodes"), path.AppendChild("Edges")
    define(layer, nodes, "Scope")
    define(layer, edges, "Scope")
    graph_nodes = graph.graph.nodes
    for square in sorted(graph_nodes):
        prim = _curve(
            layer, nodes.AppendChild(f"Node_{square_name(square)}"), _ring(*_middle(graph, square)), closed=True
        )
        attribute(prim, "garage:lane:kind", Sdf.ValueTypeNames.Token, graph.kind(square).value)
        attribute(prim, "garage:lane:square", Sdf.ValueTypeNames.Int2, Gf.Vec2i(*square))
        widths = Gf.Vec2f(*(side - setback_m * 2 for side in _sides_m(structure, square)))
        attribute(prim, "garage:lane:widths", Sdf.ValueTypeNames.Float2, widths)
    for pair in sorted(tuple(sorted(edge)) for edge in graph.graph.edges):
        start, end, direction = _directed(graph, *pair)
        name = f"Edge_{square_name(start)}_{square_name(end)}"
        prim = _curve(layer, edges.AppendChild(name), [_middle(graph, start), _middle(graph, end)], closed=False)
        attribute(prim, "garage:lane:from", Sdf.ValueTypeNames.Int2, Gf.Vec2i(*start))
        attribute(prim, "garage:lane:to", Sdf.ValueTypeNames.Int2, Gf.Vec2i(*end))
        attribute(prim, "garage:lane:direction", Sdf.ValueTypeNames.Token, direction)
        length = graph.graph.edges[start, end]["length_m"]
        attribute(prim, "garage:lane:length", Sdf.ValueTypeNames.Float, length)
        across = 1 if start[1] == end[1] else 0
        width = min(_sides_m(structure, square)[1 - across] for square in (start, end)) - 2 * setback_m
        attribute(prim, "garage:lane:width", Sdf.ValueTypeNames.Float, width)


def _directed(graph: LaneGraph, one: Square, other: Square) -> tuple[Square, Square, str]:
    """From an entrance, into an exit, or both ways."""
    kinds = graph.kind(one).value, graph.kind(other).value
    if kinds[1] == "entrance" or kinds[0] == "exit":
        return other, one, "forward"
    return one, other, "forward" if "entrance" in kinds or "exit" in kinds else "both"


def _middle(graph: LaneGraph, square: Square) -> tuple[float, float]:
    node = graph.graph.nodes[square]
    return node["x_m"], node["z_m"]


def _sides_m(structure: Structure, square: Square) -> tuple[float, float]:
    """Extent of a square along X and Z."""
    return float(structure.column_widths_mm[square[1]]) / 1000, float(structure.row_depths_mm[square[0]]) / 1000


def _ring(x: float, z: float) -> list[tuple[float, float]]:
    angles = [index * math.tau / _NODE_CORNERS for index in range(_NODE_CORNERS)]
    return [(x + _NODE_RADIUS_M * math.cos(angle), z + _NODE_RADIUS_M * math.sin(angle)) for angle in angles]


def _curve(layer: Sdf.Layer, path: Sdf.Path, points: list[tuple[float, float]], *, closed: bool) -> Sdf.PrimSpec:
    prim = define(layer, path, "BasisCurves")
    types = Sdf.ValueTypeNames
    attribute(prim, "type", types.Token, UsdGeom.Tokens.linear, uniform=True)
    wrap = UsdGeom.Tokens.periodic if closed else UsdGeom.Tokens.nonperiodic
    attribute(prim, "wrap", types.Token, wrap, uniform=True)
    attribute(prim, "curveVertexCounts", types.IntArray, Vt.IntArray([len(points)]))
    corners = [Gf.Vec3f(x, _LIFT_M, z) for x, z in points]
    attribute(prim, "points", types.Point3fArray, Vt.Vec3fArray(corners))
    width = attribute(prim, "widths", types.FloatArray, Vt.FloatArray([_LINE_WIDTH_M]))
    width.SetInfo("interpolation", UsdGeom.Tokens.constant)
    extent = UsdGeom.Curves.ComputeExtent(Vt.Vec3fArray(corners), Vt.FloatArray([_LINE_WIDTH_M]))
    attribute(prim, "extent", types.Float3Array, extent)
    return prim
