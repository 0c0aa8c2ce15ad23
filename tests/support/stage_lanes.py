"""Lanes and stalls of a stage, read with pxr alone from the curves that docs/stage.md tells of."""

import json
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import networkx as nx
import numpy as np
import shapely
from pxr import Usd, UsdGeom

from support.label_tables import labelled_objects


@dataclass
class StageLanes:
    """Middles (x, z), clear widths and kinds of lane nodes; edges (from, to, width, one way); stalls by id."""

    middles: np.ndarray
    widths: np.ndarray
    kinds: list
    edges: list
    stalls: dict

    def graph(self):
        """The nodes as they are driven from one to the other."""
        graph = nx.DiGraph()
        graph.add_nodes_from(range(len(self.kinds)))
        for start, end, _, one_way in self.edges:
            graph.add_edge(start, end)
            if not one_way:
                graph.add_edge(end, start)
        return graph


def _curves(stage, name):
    curves = UsdGeom.BasisCurves(stage.GetPrimAtPath(f"/Garage/LaneGraph/{name}"))
    points = np.array(curves.GetPointsAttr().Get())[:, [0, 2]].astype(float)
    lines = np.split(points, np.cumsum(curves.GetCurveVertexCountsAttr().Get())[:-1])
    return lines, lambda attribute: list(curves.GetPrim().GetAttribute(f"garage:{attribute}").Get())


class JudgedStage:
    """What maps of a stage are compared with: its lanes, its prims and the objects in the table of labels beside it."""

    def __init__(self, path):
        self.stage = Usd.Stage.Open(str(path))
        self.lanes = lanes_of(self.stage)
        self.labelled = labelled_objects(path.with_name(f"{path.stem}_labels.json"))
        report = path.with_name(f"{path.stem}_report.json")
        stalls = json.loads(report.read_text(encoding="utf-8"))["levels"][0]["stalls"] if report.exists() else []
        self.blocked = {stall["name"] for stall in stalls if "blocked_by" in stall}

    @cached_property
    def taken(self):
        """Ids of stalls in which the origin of a vehicle lies, by the table of labels and pxr, and of blocked ones."""
        cars = [thing["path"] for thing in self.labelled if thing["class"] in {"car", "motorbike"}]
        places = UsdGeom.XformCache()
        at = [places.GetLocalToWorldTransform(self.stage.GetPrimAtPath(path)).ExtractTranslation() for path in cars]
        tree = shapely.STRtree([shapely.Point(place[0], place[2]) for place in at])
        return {
            name
            for name, stall in self.lanes.stalls.items()
            if name in self.blocked or len(tree.query(shapely.Polygon(stall["corners"]), predicate="contains"))
        }


@lru_cache(maxsize=5)
def judged_stage(path):
    """A stage that stays as it is, which is read once for many maps of it."""
    return JudgedStage(Path(path))


def read_stage(path):
    return lanes_of(Usd.Stage.Open(str(path)))


def lanes_of(stage):
    nodes, of_node = _curves(stage, "Nodes")
    _, of_edge = _curves(stage, "Edges")
    outlines, of_stall = _curves(stage, "Stalls")
    directions = [direction == "forward" for direction in of_edge("lane:direction")]
    edges = list(zip(of_edge("lane:from"), of_edge("lane:to"), of_edge("lane:width"), directions, strict=True))
    names = ("stall:id", "stall:use", "stall:accessNode", "stall:number")
    stalls = {
        name: {"corners": corners, "use": use, "access": access, "number": number}
        for corners, name, use, access, number in zip(outlines, *map(of_stall, names), strict=True)
    }
    middles = np.array([line.mean(axis=0) for line in nodes])
    return StageLanes(middles, np.array(of_node("lane:widths")), of_node("lane:kind"), edges, stalls)
