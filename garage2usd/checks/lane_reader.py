"""Stalls and lane graph of a stage, read from its guide curves, with what contradicts itself in them."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from garage2usd.checks.shapes import Array
from garage2usd.checks.subject import Fault, LaneEdge, LaneNode, Point, StallOutline
from garage2usd.layout import StallUse
from garage2usd.stage.reading import metres_y_up, numbers_of
from garage2usd.structure.lane_graph import LaneKind

__all__ = ["DrivenGround", "read_lanes"]

_GRAPH = "LaneGraph"
_CORNERS = 4
_KINDS = {kind.value for kind in LaneKind}
_USES = {use.value for use in StallUse}
_MOVED_M = 0.05
_NO_WIDTH_M = 0.1
RULE = "lane-graph"


@dataclass
class DrivenGround:
    """What the guide curves say.

    Attributes
    ----------
    nodes, edges, stalls
        As in `garage2usd.checks.subject.Subject`.
    squares
        (row, col) of each node, as far as it is told.
    faults
        What contradicts itself; the curves concerned are left out.
    """

    nodes: list[LaneNode] = field(default_factory=list)
    edges: list[LaneEdge] = field(default_factory=list)
    stalls: list[StallOutline] = field(default_factory=list)
    squares: list[tuple[int, int]] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)


def read_lanes(stage: Usd.Stage) -> DrivenGround:
    """Read the curves ``Nodes``, ``Edges`` and ``Stalls`` of the lane graph below the default prim."""
    ground = DrivenGround()
    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    graph = root.GetChild(_GRAPH)
    curves = {name: _Curves(stage, graph.GetChild(name) if graph else None) for name in ("Nodes", "Edges", "Stalls")}
    missing = [name for name, found in curves.items() if not found.exists]
    if missing:
        place = str(root.GetPath().AppendChild(_GRAPH))
        ground.faults.append(
            Fault(RULE, place, None, f"no curves {', '.join(missing)}: nothing tells where cars drive")
        )
        return ground
    _read_nodes(curves["Nodes"], ground)
    _read_edges(curves["Edges"], ground)
    _read_stalls(curves["Stalls"], ground)
    _compare_prims(stage, root, ground, told=set(map(str, curves["Stalls"].values("garage:stall:id"))))
    return ground


class _Curves:
    """The attributes and the points of one set of curves."""

    def __init__(self, stage: Usd.Stage, prim: Usd.Prim | None) -> None:
        self._prim = prim
        self.exists = prim is not None and bool(prim) and prim.IsA(UsdGeom.BasisCurves)
        self.path = str(prim.GetPath()) if prim else ""
        if prim is None or not self.exists:
            return
        basis = UsdGeom.BasisCurves(prim)
        counts = numbers_of(basis.GetCurveVertexCountsAttr(), np.int64)
        points = numbers_of(basis.GetPointsAttr(), np.float64, width=3)
        local = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)) @ metres_y_up(stage)
        world = points @ local[:3, :3] + local[3, :3]
        ends = np.cumsum(counts)
        fits = len(counts) == 0 or (counts.min() > 0 and ends[-1] == len(world))
        self.is_whole = bool(fits and np.isfinite(world).all())
        self.lines: list[Array] = np.split(world[:, [0, 2]], ends[:-1]) if self.is_whole and len(counts) else []

    def values(self, name: str) -> list[Any]:
        """One value a curve, as plain Python values; empty where there are not as many as curves."""
        attribute = self._prim.GetAttribute(name) if self._prim else None
        value = attribute.Get() if attribute else None
        values = list(value) if value is not None and hasattr(value, "__len__") else []
        return values if len(values) == len(self.lines) else []

    def columns(self, *names: str) -> list[tuple[Any, ...]] | None:
        """The values of some attributes, curve by curve; None where one of them does not fit the curves."""
        columns = [self.values(name) for name in names]
        if not self.is_whole or any(len(column) != len(self.lines) for column in columns):
            return None
        return list(zip(*columns, strict=True))


def _read_nodes(curves: _Curves, ground: DrivenGround) -> None:
    rows = curves.columns("garage:lane:kind", "garage:lane:widths", "garage:lane:row", "garage:lane:column")
    if rows is None:
        _incomplete(curves, ground, "kind, widths, row and column")
        return
    for line, (kind, widths, row, col) in zip(curves.lines, rows, strict=True):
        name = f"[{row}, {col}]"
        if not all(math.isfinite(width) and width > 0 for width in widths):
            ground.faults.append(Fault(RULE, name, _middle(line), "a node without widths"))
            widths = (_NO_WIDTH_M, _NO_WIDTH_M)  # noqa: PLW2901 - the others keep their numbers
        if kind not in _KINDS:
            ground.faults.append(Fault(RULE, name, _middle(line), f"a node of the unknown kind {kind!r}"))
        ground.nodes.append(LaneNode(str(kind), _middle(line), (float(widths[0]), float(widths[1])), name))
        ground.squares.append((int(row), int(col)))


def _read_edges(curves: _Curves, ground: DrivenGround) -> None:
    rows = curves.columns("garage:lane:from", "garage:lane:to", "garage:lane:width", "garage:lane:direction")
    if rows is None:
        _incomplete(curves, ground, "from, to, width and direction")
        return
    for number, (line, (start, end, width, direction)) in enumerate(zip(curves.lines, rows, strict=True)):
        if not (_is_node(start, ground) and _is_node(end, ground)):
            place = f"{curves.path}[{number}]"
            ground.faults.append(Fault(RULE, place, _middle(line), "an edge whose ends are not both nodes"))
            continue
        if not math.isfinite(width):
            ground.faults.append(Fault(RULE, f"{curves.path}[{number}]", _middle(line), "an edge without a width"))
            continue
        ground.edges.append(LaneEdge(int(start), int(end), float(width), direction == "forward"))


def _read_stalls(curves: _Curves, ground: DrivenGround) -> None:
    rows = curves.columns("garage:stall:id", "garage:stall:use", "garage:stall:accessNode")
    if rows is None:
        _incomplete(curves, ground, "id, use and accessNode")
        return
    for line, (name, use, access) in zip(curves.lines, rows, strict=True):
        place = str(name)
        if len(line) != _CORNERS:
            ground.faults.append(Fault(RULE, place, _middle(line), f"a stall with {len(line)} corners"))
        elif use not in _USES:
            ground.faults.append(Fault(RULE, place, _middle(line), f"a stall with the unknown use {use!r}"))
        elif not _is_node(access, ground):
            ground.faults.append(Fault(RULE, place, _middle(line), "a stall that opens onto no node"))
        else:
            left, right, rear_right, rear_left = (_point(corner) for corner in line)
            outline = (left, right, rear_right, rear_left)
            ground.stalls.append(StallOutline(place, outline, StallUse(use), int(access)))


def _compare_prims(stage: Usd.Stage, root: Usd.Prim, ground: DrivenGround, *, told: set[str]) -> None:
    """Stalls that were moved without their outlines, or the other way round."""
    outlines = {stall.name: stall for stall in ground.stalls}
    to_metres, cache = metres_y_up(stage), UsdGeom.XformCache()
    for prim in Usd.PrimRange(root):
        attribute = prim.GetAttribute("garage:stall:id")
        name = attribute.Get() if attribute else None
        if not isinstance(name, str):
            continue
        where = np.array(cache.GetLocalToWorldTransform(prim)) @ to_metres
        place = _point(where[3, [0, 2]])
        if name not in told:
            ground.faults.append(Fault("stall-outline", str(prim.GetPath()), place, "the lane graph has no such stall"))
        elif name in outlines and np.hypot(*np.subtract(place, outlines[name].centre)) > _MOVED_M:
            message = "the stall's prim does not lie where the lane graph has its outline"
            ground.faults.append(Fault("stall-outline", str(prim.GetPath()), place, message))


def _incomplete(curves: _Curves, ground: DrivenGround, names: str) -> None:
    ground.faults.append(Fault(RULE, curves.path, None, f"not one value of {names} a curve"))


def _is_node(number: object, ground: DrivenGround) -> bool:
    return isinstance(number, int) and 0 <= number < len(ground.nodes)


def _middle(line: Array) -> Point:
    return _point(line.mean(axis=0))


def _point(place: Array) -> Point:
    return round(float(place[0]), 6), round(float(place[1]), 6)
