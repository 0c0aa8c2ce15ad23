"""Lane graph and stalls of a stage, read from its guide curves, with their contradictions."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.garage import Fault, LaneEdge, LaneGraph, LaneKind, LaneNode, Point, Stall, StallUse
from garage2usd.reading.whole_garage import GRAPH, garage_root
from garage2usd.scenes.values import READ_AT, metres_y_up, numbers_of

GUIDE_LIFT_M = 0.05
"""Height of the guide curves above the floor in metres."""
_CORNERS = 4
_KINDS = {kind.value for kind in LaneKind}
_USES = {use.value for use in StallUse}
_MOVED_M = 0.05
"""Tolerance in metres between a stall's prim and the middle of its outline, for single precision."""
_NO_WIDTH_M = 0.1
_NO_AREA_M2 = 0.01
_FACTS = ("number", "type", "size", "row", "column", "entryEdge")
_RULE = "lane-graph"


@dataclass
class Lanes:
    """Lane graph and stalls of the guide curves.

    Attributes
    ----------
    nodes, edges, stalls
        The lane graph, and its stalls.
    squares
        (row, col) of each node.
    listed
        Ids of all stalls, including omitted ones.
    faults
        Contradictions; the curves concerned are omitted.
    """

    nodes: list[LaneNode] = field(default_factory=list)
    edges: list[LaneEdge] = field(default_factory=list)
    stalls: list[Stall] = field(default_factory=list)
    squares: list[tuple[int, int]] = field(default_factory=list)
    listed: set[str] = field(default_factory=set)
    faults: list[Fault] = field(default_factory=list)

    @property
    def graph(self) -> LaneGraph:
        """Nodes and edges as a lane graph."""
        return LaneGraph(tuple(self.nodes), tuple(self.edges))


def read_lanes(stage: Usd.Stage) -> Lanes:
    """Read the curves ``Nodes``, ``Edges`` and ``Stalls`` of a stage's lane graph.

    Notes
    -----
    The lane graph is the prim ``LaneGraph`` below the default prim, or the first of that name in a stage that refers to
    a garage. See docs/stage.md for its attributes.
    """
    lanes = Lanes()
    root = garage_root(stage) or stage.GetPseudoRoot()
    graph = root.GetChild(GRAPH)
    curves = {name: _Curves(stage, graph.GetChild(name) if graph else None) for name in ("Nodes", "Edges", "Stalls")}
    missing = [name for name, found in curves.items() if not found.exists]
    if missing:
        place = str(root.GetPath().AppendChild(GRAPH))
        lanes.faults.append(Fault(_RULE, place, None, f"no curves {', '.join(missing)}: nothing says where cars drive"))
        return lanes
    _read_nodes(curves["Nodes"], lanes)
    _read_edges(curves["Edges"], lanes)
    _read_stalls(curves["Stalls"], lanes)
    lanes.listed.update(map(str, curves["Stalls"].values("garage:stall:id")))
    return lanes


def moved_stalls(stage: Usd.Stage, lanes: Lanes) -> list[Fault]:
    """Find stalls whose prim was moved without its outline, or the outline without the prim.

    Parameters
    ----------
    stage
        The stage; all of its prims are visited.
    lanes
        Result of `read_lanes` for the stage.
    """
    if not lanes.listed and not lanes.nodes:
        return []
    outlines = {stall.name: stall for stall in lanes.stalls}
    to_metres, cache = metres_y_up(stage), UsdGeom.XformCache(READ_AT)
    faults = []
    for prim in stage.Traverse():
        attribute = prim.GetAttribute("garage:stall:id")
        name = attribute.Get(READ_AT) if attribute else None
        if not isinstance(name, str):
            continue
        place = _point((np.array(cache.GetLocalToWorldTransform(prim)) @ to_metres)[3, :3])
        if name not in lanes.listed:
            faults.append(Fault("stall-outline", str(prim.GetPath()), place, "the lane graph has no such stall"))
        elif name in outlines and math.dist(place, outlines[name].centre) > _MOVED_M:
            message = "the stall's prim does not lie where the lane graph has its outline"
            faults.append(Fault("stall-outline", str(prim.GetPath()), place, message))
    return faults


class _Curves:
    """Attributes and points of one set of guide curves."""

    def __init__(self, stage: Usd.Stage, prim: Usd.Prim | None) -> None:
        self._prim = prim
        self.exists = prim is not None and bool(prim) and prim.IsActive() and prim.IsA(UsdGeom.BasisCurves)
        self.path = str(prim.GetPath()) if prim else ""
        if prim is None or not self.exists:
            return
        basis = UsdGeom.BasisCurves(prim)
        counts = numbers_of(basis.GetCurveVertexCountsAttr(), np.int64)
        points = numbers_of(basis.GetPointsAttr(), np.float64, width=3)
        to_world = np.array(UsdGeom.XformCache(READ_AT).GetLocalToWorldTransform(prim)) @ metres_y_up(stage)
        world = points @ to_world[:3, :3] + to_world[3, :3]
        ends = np.cumsum(counts)
        fits = len(counts) == 0 or (counts.min() > 0 and ends[-1] == len(world))
        self.is_whole = bool(fits and np.isfinite(world).all())
        self.lines: list[NDArray[np.float64]] = np.split(world, ends[:-1]) if self.is_whole and len(counts) else []

    def values(self, name: str) -> list[Any]:
        """Return one value per curve as plain Python values; empty if their number differs from that of the curves."""
        attribute = self._prim.GetAttribute(name) if self._prim else None
        value = attribute.Get(READ_AT) if attribute else None
        values = list(value) if value is not None and hasattr(value, "__len__") else []
        return values if len(values) == len(self.lines) else []

    def columns(self, *names: str) -> list[tuple[Any, ...]] | None:
        """Return the values of some attributes per curve; None if one of them does not fit the curves."""
        columns = [self.values(name) for name in names]
        if not self.is_whole or any(len(column) != len(self.lines) for column in columns):
            return None
        return list(zip(*columns, strict=True))


def _read_nodes(curves: _Curves, lanes: Lanes) -> None:
    rows = curves.columns("garage:lane:kind", "garage:lane:widths", "garage:lane:row", "garage:lane:column")
    if rows is None:
        _incomplete(curves, lanes, "kind, widths, row and column")
        return
    levels = _levels(curves, lanes, "garage:lane:level")
    for line, (kind, widths, row, col), level in zip(curves.lines, rows, levels, strict=True):
        name = f"[{row}, {col}]"
        if not all(math.isfinite(width) and width > 0 for width in widths):
            lanes.faults.append(Fault(_RULE, name, _middle_of(line), "a node without widths"))
            widths = (_NO_WIDTH_M, _NO_WIDTH_M)  # noqa: PLW2901 - the others keep their numbers
        if kind not in _KINDS:
            lanes.faults.append(Fault(_RULE, name, _middle_of(line), f"a node of the unknown kind {kind!r}"))
        sides = float(widths[0]), float(widths[1])
        height_m = float(line[:, 1].mean()) - GUIDE_LIFT_M
        lanes.nodes.append(LaneNode(str(kind), _middle_of(line), sides, name, height_m, level))
        lanes.squares.append((int(row), int(col)))


def _read_edges(curves: _Curves, lanes: Lanes) -> None:
    rows = curves.columns("garage:lane:from", "garage:lane:to", "garage:lane:width", "garage:lane:direction")
    if rows is None:
        _incomplete(curves, lanes, "from, to, width and direction")
        return
    for number, (line, (start, end, width, direction)) in enumerate(zip(curves.lines, rows, strict=True)):
        place = f"{curves.path}[{number}]"
        if not (_is_node(start, lanes) and _is_node(end, lanes)):
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), "an edge whose ends are not both nodes"))
        elif not math.isfinite(width):
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), "an edge without a width"))
        else:
            lanes.edges.append(LaneEdge(int(start), int(end), float(width), direction == "forward"))


def _read_stalls(curves: _Curves, lanes: Lanes) -> None:
    rows = curves.columns("garage:stall:id", "garage:stall:use", "garage:stall:accessNode")
    if rows is None:
        _incomplete(curves, lanes, "id, use and accessNode")
        return
    columns = {name: curves.values(f"garage:stall:{name}") for name in _FACTS}
    columns["blocked_by"] = curves.values("garage:stall:blockedBy")
    columns["occupied"] = [value == 1 for value in curves.values("garage:stall:occupied")]
    known = {name: values for name, values in columns.items() if values}
    levels = _levels(curves, lanes, "garage:stall:level")
    for index, (line, (name, use, access), level) in enumerate(zip(curves.lines, rows, levels, strict=True)):
        place = str(name)
        if len(line) != _CORNERS:
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), f"a stall with {len(line)} corners"))
        elif use not in _USES:
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), f"a stall with the unknown use {use!r}"))
        elif not _is_node(access, lanes):
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), "a stall that opens onto no node"))
        elif _area_m2(line) < _NO_AREA_M2:
            lanes.faults.append(Fault(_RULE, place, _middle_of(line), "a stall without area"))
        else:
            left, right, rear_right, rear_left = (_point(corner) for corner in line)
            said = [(fact, values[index]) for fact, values in known.items() if fact != "blocked_by" or values[index]]
            facts = tuple((fact, value if isinstance(value, int) else str(value)) for fact, value in said)
            outline = (left, right, rear_right, rear_left)
            lanes.stalls.append(Stall(place, outline, StallUse(use), int(access), facts, level))


def _levels(curves: _Curves, lanes: Lanes, name: str) -> list[int]:
    """Return the level of each curve; 0 without levels."""
    told = curves.values(name)
    if not all(isinstance(level, int) for level in told):
        lanes.faults.append(Fault(_RULE, curves.path, None, f"{name} that is not whole numbers"))
        told = []
    return told or [0] * len(curves.lines)


def _incomplete(curves: _Curves, lanes: Lanes, names: str) -> None:
    lanes.faults.append(Fault(_RULE, curves.path, None, f"not one value of {names} a curve"))


def _is_node(number: object, lanes: Lanes) -> bool:
    return isinstance(number, int) and 0 <= number < len(lanes.nodes)


def _area_m2(line: NDArray[np.float64]) -> float:
    """Return the area on the floor between a stall's mouth and its left side, as of a parallelogram."""
    (mouth_x, mouth_z), (side_x, side_z) = line[[1, 3]][:, [0, 2]] - line[0, [0, 2]]
    return float(abs(mouth_x * side_z - mouth_z * side_x))


def _middle_of(line: NDArray[np.float64]) -> Point:
    return _point(line.mean(axis=0))


def _point(place: NDArray[np.float64]) -> Point:
    return round(float(place[0]), 6), round(float(place[2]), 6)
