"""Judge of garages of several levels by their written stages: pxr, networkx and trimesh, not garage2usd's readers."""

import re
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
import shapely
import trimesh
from pxr import Usd, UsdGeom

from garage2usd.checks import Severity
from garage2usd.pipeline import build
from support.rays import fans

ALLOWED = {"personnel-exits", "exit-distance", "exit-distance-sprinklered", "column-spacing", "portal-count"}
"""Rules of `check` that may find something: where there is no room for more cores, and of columns around stalls across
shallow rows."""
WHEELBASE_M, CLEARANCE_M, CAR_LENGTH_M, REAR_OVERHANG_M = 2.9, 0.12, 5.0, 0.95
"""Of a large car."""
GROUND = (
    "crossing",
    "drain",
    "floor",
    "hatching",
    "lane_arrow",
    "lane_line",
    "parking_stall",
    "ramp",
    "stall_line",
    "stall_number",
    "stall_symbol",
)
"""Classes of the floor, and of the paint that is let into it."""
FLOORS = ("floor", "parking_stall", "ramp", "hatching", "crossing", "stall_symbol", "stall_line", "stall_number")
"""Classes of what lies on floors of stalls: paint is cut out of them."""
ON_M = 1e-4
"""Distance from a triangle, seen from above, within which a place counts as on it."""


class Ground:
    """Triangles of a stage that one can stand on."""

    def __init__(self, triangles):
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        lengths = np.linalg.norm(normals, axis=1)
        is_up = normals[:, 1] > 0.5 * lengths
        self.corners, self.normals = triangles[is_up], normals[is_up] / lengths[is_up, None]
        self.tree = shapely.STRtree(shapely.polygons(self.corners[:, :, [0, 2]]))

    def nearest(self, places):
        """Heights under places of the surface nearest to each, NaN for none, and the normal of that surface."""
        places = np.asarray(places, dtype=float)
        place, triangle = self.tree.query(shapely.points(places[:, [0, 2]]), predicate="dwithin", distance=ON_M)
        first, normal = self.corners[triangle, 0], self.normals[triangle]
        away = places[place] - first
        heights = first[:, 1] - (away[:, 0] * normal[:, 0] + away[:, 2] * normal[:, 2]) / normal[:, 1]
        order = np.lexsort([np.abs(heights - places[place, 1]), place])
        found, at = np.unique(place[order], return_index=True)
        result, normals = np.full(len(places), np.nan), np.zeros((len(places), 3))
        result[found], normals[found] = heights[order][at], normal[order][at]
        return result, normals


def label_of(prim):
    while prim and not prim.IsPseudoRoot():
        labels = prim.GetAttribute("semantics:labels:class") if prim else None
        if labels and labels.Get():
            return labels.Get()[0]
        prim = prim.GetParent()
    return ""


class LevelJudge:
    """One stage: lanes, stalls, columns and triangles by class and by level."""

    def __init__(self, path):
        self.stage = Usd.Stage.Open(str(path))
        root = self.stage.GetDefaultPrim().GetPath()
        self.names = [prim.GetName() for prim in self.stage.GetPrimAtPath(f"{root}/Levels").GetChildren()]
        graph = f"{root}/LaneGraph"
        nodes, edges, stalls = (self.stage.GetPrimAtPath(f"{graph}/{name}") for name in ("Nodes", "Edges", "Stalls"))

        def value(prim, name):
            return list(prim.GetAttribute(name).Get())

        counts = value(nodes, "curveVertexCounts")
        points = np.array(value(nodes, "points"))
        self.places = np.array([part.mean(axis=0) for part in np.split(points, np.cumsum(counts)[:-1])]) - [0, 0.05, 0]
        self.widths = np.array(value(nodes, "garage:lane:widths")).reshape(-1, 2)
        self.kinds, self.levels = value(nodes, "garage:lane:kind"), value(nodes, "garage:lane:level")
        self.lanes = nx.DiGraph()
        self.lanes.add_nodes_from(range(len(counts)))
        for start, end, direction in zip(
            *(value(edges, f"garage:lane:{name}") for name in ("from", "to", "direction")), strict=True
        ):
            self.lanes.add_edge(start, end)
            if direction == "both":
                self.lanes.add_edge(end, start)
        self.stall_ids, self.numbers = value(stalls, "garage:stall:id"), value(stalls, "garage:stall:number")
        self.access, self.stall_levels = value(stalls, "garage:stall:accessNode"), value(stalls, "garage:stall:level")
        self.uses = value(stalls, "garage:stall:use")
        self.outlines = np.array(value(stalls, "points")).reshape(-1, 4, 3) - [0, 0.05, 0]
        self._read()

    def _read(self):
        cache, self._meshes = UsdGeom.XformCache(), {}
        self.triangles, self.columns = {}, {name: [] for name in self.names}
        self.shafts = {name: {} for name in self.names}
        for prim in self.stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)):
            level = str(prim.GetPath()).split("/")[3] if "/Levels/" in str(prim.GetPath()) else ""
            if prim.GetName().startswith("Column_") and prim.GetTypeName() == "Xform" and level:
                self.columns[level].append(np.array(cache.GetLocalToWorldTransform(prim))[3, :3])
            if not prim.IsA(UsdGeom.Mesh):
                continue
            mesh = UsdGeom.Mesh(prim)
            place = np.array(cache.GetLocalToWorldTransform(prim))
            points = np.array(mesh.GetPointsAttr().Get()) @ place[:3, :3] + place[3, :3]
            self.triangles.setdefault((level, label_of(prim)), []).append(points[fans(mesh)])
            shaft = re.search("/((?:Core|Shaft)_[^/]+)/", str(prim.GetPath()))
            if shaft and label_of(prim) == "obstacle" and prim.GetName() == "Core":
                ground = points[:, [0, 2]]
                self.shafts[level][shaft[1]] = np.concatenate([ground.min(axis=0), ground.max(axis=0)])

    def mesh(self, *labels, level=None):
        """The triangles of some classes, or of all; made once, as rays need a tree of them."""
        asked = (frozenset(labels), level)
        if asked not in self._meshes:
            parts = [
                part
                for (own, label), triangles in self.triangles.items()
                if (not labels or label in labels) and level in {None, own}
                for part in triangles
            ]
            corners = np.concatenate(parts).reshape(-1, 3)
            faces = np.arange(len(corners)).reshape(-1, 3)
            self._meshes[asked] = trimesh.Trimesh(corners, faces, process=False, validate=False)
        return self._meshes[asked]

    def ground(self):
        """The floors of all levels, their paint and the ramps."""
        parts = [part for (_, label), own in self.triangles.items() if label in GROUND for part in own]
        return Ground(np.concatenate(parts))

    def unreached(self):
        """Ids of stalls without a route from a street entrance and to a street exit."""
        arriving, leaving = set(), set()
        for node, kind in enumerate(self.kinds):
            if kind == "entrance":
                arriving |= {node} | nx.descendants(self.lanes, node)
            if kind == "exit":
                leaving |= {node} | nx.ancestors(self.lanes, node)
        return [
            name
            for name, node in zip(self.stall_ids, self.access, strict=True)
            if node not in arriving or node not in leaving
        ]

    def ramps(self):
        """Places along each ramp, from landing to landing in the direction of driving; arrays of shape (n, 3)."""
        sloped = [edge for edge in self.lanes.edges if abs(self.places[edge[0]][1] - self.places[edge[1]][1]) > 1e-3]
        found = []
        for part in nx.weakly_connected_components(self.lanes.edge_subgraph(sloped)):
            way = list(nx.topological_sort(self.lanes.subgraph(part)))
            for _ in range(2):  # the level part at the end, and the landing
                way = [*self.lanes.predecessors(way[0])][:1] + way + [*self.lanes.successors(way[-1])][:1]
            found.append(self.places[way])
        return found


def findings_of(made):
    """What `check` finds on a garage of several levels, but for remarks, as words for each severity and rule."""
    found = [finding for finding in made.findings if finding.severity is not Severity.INFO]
    return sorted(f"{finding.severity}: {finding.rule}" for finding in found)


def built_and_judged(config, path):
    """Build a garage of several levels; `check` has nothing against it but for want of room, and all is reached."""
    made = build(config, path)
    assert {words.partition(": ")[2] for words in findings_of(made)} <= ALLOWED
    judge = LevelJudge(made.stage)
    assert judge.unreached() == []
    return made, judge


def above(places, height_m):
    """Places some metres higher; shape (n, 3)."""
    return np.asarray(places) + np.array([0.0, height_m, 0.0])


def first_hits(mesh, origins, directions):
    """Distance to the first surface on each ray; infinite for none."""
    places, rays, _ = mesh.ray.intersects_location(origins, directions, multiple_hits=False)
    far = np.full(len(origins), np.inf)
    far[rays] = np.linalg.norm(places - np.asarray(origins)[rays], axis=1)
    return far


def floors_under(mesh, place, *, reach_m=3.0):
    """Heights of the distinct floors that a ray down from 2 m over a place meets within a reach of it."""
    origin = above(np.array([place]), 2.0)
    hits, _, _ = mesh.ray.intersects_location(origin, [[0.0, -1.0, 0.0]])
    heights = sorted(float(height) for height in hits[:, 1] if abs(height - place[1]) <= reach_m)
    return [height for index, height in enumerate(heights) if not index or height - heights[index - 1] > 0.05]


def belly_m(runs, heights):
    """Least distance of a large car's underside from the surface, and of its ends, over all places on a profile."""
    least = np.inf
    for rear in np.arange(runs[0] + REAR_OVERHANG_M, runs[-1] - CAR_LENGTH_M, 0.05):
        axles = np.interp([rear, rear + WHEELBASE_M], runs, heights)
        under = rear + np.linspace(-REAR_OVERHANG_M, CAR_LENGTH_M - REAR_OVERHANG_M, 101)
        line = axles[0] + (under - rear) * (axles[1] - axles[0]) / WHEELBASE_M + CLEARANCE_M
        least = min(least, float((line - np.interp(under, runs, heights)).min()))
    return least


def columns_stand_above_one_another(judge, garage):
    grids = []
    for structure in garage.building.levels:
        grids.append((structure.column_edges_m, structure.row_edges_m))
        assert np.array_equal(grids[0][0], grids[-1][0])
        assert np.array_equal(grids[0][1], grids[-1][1])
    corners = np.stack(np.meshgrid(*grids[0]), axis=-1).reshape(-1, 2)
    stands = []
    for name in judge.names:
        places = np.array(judge.columns[name])[:, [0, 2]]
        far = np.linalg.norm(places[:, None] - corners[None], axis=2)
        assert far.min(axis=1).max() < 1e-3
        stands.append(set(far.argmin(axis=1).tolist()))
    for structure, own in zip(garage.building.levels, stands, strict=True):
        for missing in set().union(*stands) - own:
            # a column that another level has is only missing where four lanes meet
            col = np.argmin(abs(structure.column_edges_m - corners[missing][0]))
            row = np.argmin(abs(structure.row_edges_m - corners[missing][1]))
            assert (structure.cells[row - 1 : row + 1, col - 1 : col + 1] > 0).all()


def stairs_lead_up_to_the_street(judge):
    """Each core stands below one of the level above, on the same ground, with or without a door there."""
    for upper, lower in pairwise(judge.names):
        above_it = np.array([*judge.shafts[upper].values()])
        for ground in judge.shafts[lower].values():
            assert np.abs(above_it - ground).max(axis=1).min() < 1e-3
    assert not any(name.startswith("Shaft_") for name in judge.shafts[judge.names[-1]])


def a_ray_down_each_stall_meets_one_floor(judge, config):
    floors = judge.mesh(*FLOORS)
    for outline, level in zip(judge.outlines, judge.stall_levels, strict=True):
        middle = outline.mean(axis=0)
        assert middle[1] == pytest.approx(-level * config.building.storey_m, abs=1e-4)
        found = floors_under(floors, middle)
        assert len(found) == 1
        assert found[0] == pytest.approx(middle[1], abs=0.06)


def levels_keep_apart(judge, config):
    """Nothing of one level is between the floor of another and its clear height, but for ramps and what is in wells."""
    ramps = [part for (_, label), parts in judge.triangles.items() if label == "ramp" for part in parts]
    wells = shapely.union_all(
        [shapely.box(*part[..., [0, 2]].min((0, 1)), *part[..., [0, 2]].max((0, 1))) for part in ramps]
    )
    shapely.prepare(wells)
    for number, name in enumerate(judge.names):
        floor_m = -number * config.building.storey_m
        for (other, label), parts in judge.triangles.items():
            if other == name or label == "ramp":
                continue
            triangles = np.concatenate(parts)
            is_over = triangles[..., 1].max(axis=1) > floor_m + 0.03
            is_under = triangles[..., 1].min(axis=1) < floor_m + config.fittings.clear_height_m
            middles = shapely.points(triangles[is_over & is_under][..., [0, 2]].mean(axis=1))
            assert shapely.covers(wells, middles).all(), f"{label} of {other or 'all levels'} on {name}"
