"""Exact shapes of every piece of every mesh: nothing overhead meets anything or hangs below the clear height."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from garage2usd.config.vehicles import PAINTS
from garage2usd.layout import ObjectKind
from garage2usd.layout.specs import CarSpec
from garage2usd.stage.prototypes import asset_of

SERVICES = (ObjectKind.DUCT, ObjectKind.CABLE_TRAY, ObjectKind.SPRINKLER)
HANGING = (ObjectKind.LIGHT, ObjectKind.BEAM, *SERVICES, ObjectKind.EXIT_SIGN)
STANDING = (ObjectKind.COLUMN, ObjectKind.WALL, ObjectKind.PORTAL, ObjectKind.OBSTACLE)
SOLID = (*HANGING, *STANDING, ObjectKind.MIRROR, ObjectKind.BARRIER, ObjectKind.CAR, ObjectKind.CONE)
TOUCH_M = 1e-4
# flanges of ducts that meet; beams and walls that end in each other's line
MAY_TOUCH = {ObjectKind.DUCT}


def pieces(spec):
    """Points of each connected piece of each part."""
    return pieces_of(replace(spec, paint=PAINTS[0]) if isinstance(spec, CarSpec) else spec)


@lru_cache(maxsize=4096)
def pieces_of(spec):
    found = []
    for part in asset_of(spec).parts:
        after = np.arange(len(part.face_indices)) + 1
        ends = np.cumsum(part.face_counts)
        after[ends - 1] = ends - part.face_counts
        edges = np.stack([part.face_indices, part.face_indices[after]], axis=1)
        size = len(part.points)
        count, label = connected_components(coo_array((np.ones(len(edges)), edges.T), (size, size)), directed=False)
        found += [part.points[label == index].astype(float) for index in range(count)]
    return found


def in_world(placements):
    """Points of each piece in the world, their boxes (float64, shape (B, 2, 3)), and the placement of each piece."""
    shapes, owners = [], []
    for index, place in enumerate(placements):
        cos, sin = np.cos(place.yaw_rad), np.sin(place.yaw_rad)
        turn = np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]])
        for points in pieces(place.spec):
            shapes.append(points @ turn + np.array(place.position_m))
            owners.append(index)
    return shapes, np.array([(points.min(axis=0), points.max(axis=0)) for points in shapes]), np.array(owners)


def meet_in_plan(first, second):
    """Whether the convex outlines of two pieces, seen from above, overlap."""
    outlines = [shapely.MultiPoint(points[:, [0, 2]]).convex_hull for points in (first, second)]
    return outlines[0].intersection(outlines[1]).buffer(-TOUCH_M / 2).area > 0


def clashes(placements):
    shapes, found, owners = in_world(placements)
    order = np.argsort(found[:, 0, 0])
    found, owners = found[order], owners[order]
    for i, (low, high) in enumerate(found):
        end = np.searchsorted(found[:, 0, 0], high[0] - TOUCH_M)
        other = found[i + 1 : end]
        meets = ((other[:, 0] < high - TOUCH_M) & (other[:, 1] > low + TOUCH_M)).all(axis=1)
        for j in np.flatnonzero(meets) + i + 1:
            first, second = placements[owners[i]], placements[owners[j]]
            if owners[i] == owners[j] or {first.kind, second.kind} <= MAY_TOUCH:
                continue
            if {first.kind, second.kind} <= set(STANDING):
                continue
            if meet_in_plan(shapes[order[i]], shapes[order[j]]):
                yield first, second


def assert_nothing_overhead_meets(layout, config):
    placements = [place for place in layout.placements if place.kind in SOLID]
    assert not [(a.name, a.square, b.name, b.square) for a, b in clashes(placements)]
    hanging = [place for place in placements if place.kind in HANGING]
    if not hanging:
        return
    _, found, owners = in_world(hanging)
    lowest = found[:, 0, 1]
    assert lowest.min() >= config.fittings.clear_height_m - TOUCH_M, hanging[owners[lowest.argmin()]]
    assert found[:, 1, 1].max() <= layout.ceiling_height_m + TOUCH_M
