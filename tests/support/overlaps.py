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
HANGING = ("light", "beam", *SERVICES, "exit_sign", "lane_sign", "fire_shutter", "mirror")
BUILDING = ("column", "wall", "portal", "obstacle", "ramp")
STANDING = (*BUILDING, "barrier", "car", "cone", "wheel_stop", "charger")
STANDING = (*STANDING, "no_parking_sign", "hydrant_cabinet", "fire_extinguisher")
SOLID = (*HANGING, *STANDING, "speed_bump")
TOUCH_M = 1e-4
# flanges of ducts that meet; doors of cores that stand side by side
MAY_TOUCH = {"duct", "obstacle"}
INTO_COLUMN_M = 0.025
"""How far the arm of a mirror is let into a column whose surface it does not meet squarely."""
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
        points, edges, size = [], [], 0
        for part in asset_of(spec).parts:
            after = np.arange(len(part.face_indices)) + 1
            ends = np.cumsum(part.face_counts)
            after[ends - 1] = ends - part.face_counts
            edges.append(size + np.stack([part.face_indices, part.face_indices[after]], axis=1))
            points.append(part.points.astype(float))
            size += len(part.points)
        points, edges = np.concatenate(points), np.concatenate(edges)
        count, label = connected_components(coo_array((np.ones(len(edges)), edges.T), (size, size)), directed=False)
        numbers = np.arange(count)
        owner = label[edges[:, 0]]
        order = np.argsort(owner, kind="stable")
        self.pieces = np.split(points[edges[order]], np.searchsorted(owner[order], numbers[1:]))
        order = np.argsort(label, kind="stable")
        self._points, self._owners = points[order], label[order]
        starts = np.searchsorted(self._owners, numbers)
        self.low_m, self.high_m = (end.reduceat(self._points[:, 1], starts) for end in (np.minimum, np.maximum))
        self._sections = {}

    @cached_property
    def _outlines(self):
        """The corners (x, z) of each piece seen from above, one after the other, and where each starts."""
        hulls = shapely.convex_hull(shapely.linestrings(self._points[:, [0, 2]], indices=self._owners))
        corners, owners = shapely.get_coordinates(hulls, return_index=True)
        return corners, np.searchsorted(owners, np.arange(len(hulls)))

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
        specs, group = np.unique(table.spec[rows], return_inverse=True)
        shapes = [shape_of(table.specs[index]) for index in specs.tolist()]
        self.shapes = [shapes[number] for number in group.tolist()]
        self.piece_boxes = [None] * len(rows)
        self.boxes = np.empty((len(rows), 2, 3))
        for number, shape in enumerate(shapes):
            members = np.flatnonzero(group == number)
            boxes = shape.boxes(table.position_m[rows[members]], table.yaw_rad[rows[members]])
            self.boxes[members] = np.stack([boxes[:, :, 0].min(axis=1), boxes[:, :, 1].max(axis=1)], axis=1)
            for member, its in zip(members.tolist(), boxes, strict=True):
                self.piece_boxes[member] = its

    def near(self):
        """Pairs of objects whose boxes meet; int64, shape (n, 2)."""
        flat = flat_boxes(self.boxes)
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
            most_m = TOUCH_M + (INTO_COLUMN_M if is_let_in(first, second) else 0.0)
            if any(self._meet(one, i, other, j, most_m) for i, j in np.argwhere(candidates).tolist()):
                yield first, second

    def _meet(self, one, i, other, j, most_m):
        """Whether the convex outlines of two pieces overlap by more than that at one of some heights."""
        boxes = self.piece_boxes[one][i], self.piece_boxes[other][j]
        low, high = max(box[0, 1] for box in boxes), min(box[1, 1] for box in boxes)
        for share in SECTIONS:
            height_m = low + (high - low) * share
            outlines = [self._outline(*piece, height_m) for piece in ((one, i), (other, j))]
            if all(len(outline) > 2 for outline in outlines) and apart_m(*outlines) < -most_m:
                return True
        return False

    def _outline(self, index, piece, height_m):
        place = self.placements[index]
        x, y, z = place.position_m
        cos, sin = np.cos(place.yaw_rad), np.sin(place.yaw_rad)
        return self.shapes[index].section(piece, height_m - y) @ np.array([[cos, -sin], [sin, cos]]) + (x, z)


def is_let_in(first, second):
    """Whether one is a mirror and the other a column that does not fill its square."""
    columns = [place for place in (first, second) if place.kind == "column"]
    return {first.kind, second.kind} == {"column", "mirror"} and not columns[0].spec.fills_square


def flat_boxes(boxes):
    """Boxes, shape (n, 2, 3), as rectangles on the floor."""
    (left, top), (right, bottom) = boxes[:, 0, ::2].T, boxes[:, 1, ::2].T
    return shapely.box(left, top, right, bottom)


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
    ways = carriageways(layout.structure, config.bay.carriageway_setback_m - TOUCH_M)
    tree = shapely.STRtree(shapely.box(*ways.T))
    standing = np.flatnonzero(np.isin(kinds, STANDING))
    # no piece is over a carriageway where the box of the whole object is not
    for index in standing[np.unique(tree.query(flat_boxes(solids.boxes[standing]))[0])].tolist():
        boxes = solids.piece_boxes[index]
        boxes = boxes[boxes[:, 0, 1] < config.fittings.clear_height_m - TOUCH_M]
        piece, way = tree.query(flat_boxes(boxes))
        low, high = np.maximum(boxes[piece, 0, ::2], ways[way, :2]), np.minimum(boxes[piece, 1, ::2], ways[way, 2:])
        assert not ((high - low).min(axis=1, initial=np.inf) > 2 * TOUCH_M).any(), solids.placements[index].name
