"""Exact shapes of every piece of every mesh: nothing solid meets, nothing hangs or stands where cars drive."""

from dataclasses import replace
from functools import cached_property, lru_cache

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

from garage2usd.config.vehicles import PAINTS
from garage2usd.objects.car import CarSpec
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell

SERVICES = ("duct", "cable_tray", "sprinkler")
HANGING = ("light", "beam", *SERVICES, "exit_sign", "mirror")
BUILDING = ("column", "wall", "portal", "obstacle", "ramp")
STANDING = (*BUILDING, "barrier", "car", "cone", "wheel_stop", "charger")
STANDING = (*STANDING, "no_parking_sign", "hydrant_cabinet", "fire_extinguisher")
SOLID = (*HANGING, *STANDING, "speed_bump")
TOUCH_M = 1e-4
# flanges of ducts that meet; doors of cores that stand side by side
MAY_TOUCH = {"duct", "obstacle"}
SECTIONS = (1 / 6, 1 / 2, 5 / 6)
"""Where two pieces are compared, as shares of the height that both of them span."""


class Shape:
    """The connected pieces of a spec's parts.

    Attributes
    ----------
    pieces
        Points and edges of each.
    low_m, high_m
        Heights that each spans; float64, shape (P,).
    """

    def __init__(self, spec):
        self.pieces = []
        for part in asset_of(spec).parts:
            after = np.arange(len(part.face_indices)) + 1
            ends = np.cumsum(part.face_counts)
            after[ends - 1] = ends - part.face_counts
            edges = np.stack([part.face_indices, part.face_indices[after]], axis=1)
            size = len(part.points)
            count, label = connected_components(coo_array((np.ones(len(edges)), edges.T), (size, size)), directed=False)
            points = part.points.astype(float)
            self.pieces += [points[edges[label[edges[:, 0]] == index]] for index in range(count)]
        self.low_m, self.high_m = (
            np.array([getattr(lines[..., 1], end)() for lines in self.pieces]) for end in ("min", "max")
        )
        self._sections = {}

    @cached_property
    def _outlines(self):
        """The corners (x, z) of each piece seen from above, one after the other, and where each starts."""
        corners = [hull(lines[..., [0, 2]].reshape(-1, 2)) for lines in self.pieces]
        return np.concatenate(corners), np.cumsum([0, *map(len, corners[:-1])])

    def boxes(self, positions, yaws):
        """Boxes of the pieces of objects at those places; float64, shape (objects, P, 2, 3)."""
        corners, starts = self._outlines
        cos, sin = np.cos(yaws)[:, None], np.sin(yaws)[:, None]
        x, z = corners[:, 0] * cos + corners[:, 1] * sin, corners[:, 1] * cos - corners[:, 0] * sin
        found = np.empty((len(positions), len(self.pieces), 2, 3))
        for end, (reduce, heights) in enumerate(((np.minimum, self.low_m), (np.maximum, self.high_m))):
            found[:, :, end, 0] = reduce.reduceat(x, starts, axis=1)
            found[:, :, end, 1] = heights
            found[:, :, end, 2] = reduce.reduceat(z, starts, axis=1)
        return found + positions[:, None, None]

    def section(self, piece, height_m):
        """The corners (x, z) of a piece's convex outline at a height."""
        key = piece, round(height_m, 4)
        if key not in self._sections:
            start, end = self.pieces[piece][:, 0], self.pieces[piece][:, 1]
            low, high = start[:, 1] - height_m, end[:, 1] - height_m
            crosses = low * high <= 0
            start, end, low, high = start[crosses], end[crosses], low[crosses], high[crosses]
            share = np.divide(low, low - high, out=np.zeros(len(low)), where=low != high)[:, None]
            cut = start + (end - start) * share
            level = low == high
            self._sections[key] = hull(np.concatenate([cut, end[level]])[:, [0, 2]])
        return self._sections[key]


def hull(points):
    """The corners of the convex outline of points; the points themselves where they lie on a line."""
    spread = points - points[:1]
    if len(points) < 3 or np.linalg.matrix_rank(spread, tol=1e-7) < 2:
        return points
    return points[ConvexHull(points).vertices]


def shape_of(spec):
    return _shape_of(replace(spec, paint=PAINTS[0]) if isinstance(spec, CarSpec) else spec)


@lru_cache(maxsize=4096)
def _shape_of(spec):
    return Shape(spec)


class Solids:
    """The solid objects of a layout, with the box of each piece of each."""

    def __init__(self, layout, kinds=SOLID):
        table = layout.placements
        rows = table.rows_of(*kinds)
        self.placements = table.at(rows)
        self.shapes = [shape_of(table.specs[index]) for index in table.spec[rows]]
        self.piece_boxes = [None] * len(rows)
        specs, group = np.unique(table.spec[rows], return_inverse=True)
        for number, index in enumerate(specs.tolist()):
            members = np.flatnonzero(group == number)
            boxes = shape_of(table.specs[index]).boxes(table.position_m[rows[members]], table.yaw_rad[rows[members]])
            for member, its in zip(members.tolist(), boxes, strict=True):
                self.piece_boxes[member] = its
        self.boxes = np.array([(its[:, 0].min(axis=0), its[:, 1].max(axis=0)) for its in self.piece_boxes])

    def near(self):
        """Pairs of objects whose boxes meet; int64, shape (n, 2)."""
        low, high = self.boxes[:, 0], self.boxes[:, 1]
        flat = shapely.box(low[:, 0], low[:, 2], high[:, 0], high[:, 2])
        pairs = shapely.STRtree(flat).query(flat).T
        pairs = pairs[pairs[:, 0] < pairs[:, 1]]
        return pairs[meet(self.boxes[pairs[:, 0]], self.boxes[pairs[:, 1]])]

    def clashes(self):
        """The pairs of placements of which two pieces meet."""
        for one, other in self.near().tolist():
            first, second = self.placements[one], self.placements[other]
            if first.kind is second.kind and first.kind in MAY_TOUCH:
                continue
            candidates = meet(self.piece_boxes[one][:, None], self.piece_boxes[other][None])
            if any(self._meet(one, i, other, j) for i, j in np.argwhere(candidates).tolist()):
                yield first, second

    def _meet(self, one, i, other, j):
        """Whether the convex outlines of two pieces overlap at one of some heights."""
        boxes = self.piece_boxes[one][i], self.piece_boxes[other][j]
        low, high = max(box[0, 1] for box in boxes), min(box[1, 1] for box in boxes)
        for share in SECTIONS:
            height_m = low + (high - low) * share
            outlines = [self._outline(*piece, height_m) for piece in ((one, i), (other, j))]
            if all(len(outline) > 2 for outline in outlines) and apart_m(*outlines) < -TOUCH_M:
                return True
        return False

    def _outline(self, index, piece, height_m):
        place = self.placements[index]
        x, y, z = place.position_m
        cos, sin = np.cos(place.yaw_rad), np.sin(place.yaw_rad)
        return self.shapes[index].section(piece, height_m - y) @ np.array([[cos, -sin], [sin, cos]]) + (x, z)


def meet(first, second):
    """Whether boxes, shape (..., 2, 3), overlap by more than a touch."""
    return ((first[..., 0, :] < second[..., 1, :] - TOUCH_M) & (first[..., 1, :] > second[..., 0, :] + TOUCH_M)).all(
        axis=-1
    )


def apart_m(first, second):
    """Widest gap between two convex outlines along a normal of their sides; negative by how far they overlap."""
    gaps = []
    for outline in (first, second):
        sides = np.roll(outline, -1, axis=0) - outline
        lengths = np.linalg.norm(sides, axis=1)
        normals = np.stack([-sides[:, 1], sides[:, 0]], axis=1)[lengths > 0] / lengths[lengths > 0, None]
        a, b = first @ normals.T, second @ normals.T
        gaps.append(np.maximum(a.min(axis=0) - b.max(axis=0), b.min(axis=0) - a.max(axis=0)).max())
    return max(gaps)


def carriageways(structure, setback_m):
    """Boxes (left, top, right, bottom) of the ground that cars drive on over lanes; float64, shape (n, 4)."""
    x, z, s = structure.column_edges_m, structure.row_edges_m, setback_m
    driven = np.pad(structure.cells >= Cell.LANE, 1)
    boxes = []
    for row, col in structure.where(Cell.LANE):
        left, top, right, bottom = x[col], z[row], x[col + 1], z[row + 1]
        boxes.append((left + s, top + s, right - s, bottom - s))
        arms = (
            (left + s, top, right - s, top + s),
            (left + s, bottom - s, right - s, bottom),
            (left, top + s, left + s, bottom - s),
            (right - s, top + s, right, bottom - s),
        )
        boxes += [
            arm for arm, (dr, dc) in zip(arms, NEIGHBOUR_STEPS, strict=True) if driven[row + 1 + dr, col + 1 + dc]
        ]
    return np.array(boxes)


def assert_solid_objects_keep_apart(layout, config):
    """Nothing solid meets another, hangs below the clear height or over the ceiling, or stands on a carriageway."""
    solids = Solids(layout)
    assert not [(a.name, a.square, b.name, b.square) for a, b in solids.clashes()]
    kinds = np.array([place.kind for place in solids.placements])
    hanging = np.flatnonzero(np.isin(kinds, HANGING))
    if len(hanging):
        low, high = solids.boxes[hanging, 0, 1], solids.boxes[hanging, 1, 1]
        assert low.min() >= config.fittings.clear_height_m - TOUCH_M, solids.placements[hanging[low.argmin()]]
        assert high.max() <= layout.ceiling_height_m + TOUCH_M, solids.placements[hanging[high.argmax()]]
    standing = np.flatnonzero(np.isin(kinds, STANDING))
    owners = np.repeat(standing, [len(solids.piece_boxes[index]) for index in standing])
    boxes = np.concatenate([solids.piece_boxes[index] for index in standing])
    in_the_way = boxes[:, 0, 1] < config.fittings.clear_height_m - TOUCH_M
    (left, top), (right, bottom) = boxes[in_the_way][:, 0, ::2].T, boxes[in_the_way][:, 1, ::2].T
    ways = carriageways(layout.structure, config.bay.carriageway_setback_m - TOUCH_M)
    tree = shapely.STRtree(shapely.box(*ways.T))
    met, way = tree.query(shapely.box(left, top, right, bottom))
    width = np.minimum(right[met], ways[way, 2]) - np.maximum(left[met], ways[way, 0])
    depth = np.minimum(bottom[met], ways[way, 3]) - np.maximum(top[met], ways[way, 1])
    blocking = met[(np.minimum(width, depth) > 2 * TOUCH_M)]
    assert not {solids.placements[index].name for index in owners[in_the_way][blocking]}
