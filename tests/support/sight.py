"""Sight lines through the triangles of placed objects, cast by Embree."""

import numpy as np
import trimesh

from garage2usd.stage.prototypes import asset_of

EYE_M = 1.2
"""Height of the eyes of drivers."""
_BEFORE_M = 0.02
"""Part of a sight line at its end that is left out: what is looked at."""


def world(place, points):
    """Points of a placed object's mesh in the garage; float64, shape (n, 3)."""
    x, y, z = place.position_m
    cos, sin = np.cos(place.yaw_rad), np.sin(place.yaw_rad)
    points = np.asarray(points, dtype=float)
    return np.stack(
        [x + points[:, 0] * cos + points[:, 2] * sin, y + points[:, 1], z - points[:, 0] * sin + points[:, 2] * cos],
        axis=1,
    )


def part_named(place, name):
    """A part of a placed object's mesh by its name."""
    return next(part for part in asset_of(place.spec).parts if part.name == name)


def triangles(place, *, only=None):
    """Triangles of a placed object, or of some of its parts, in the garage; float64, shape (n, 3, 3)."""
    found = []
    for part in asset_of(place.spec).parts:
        if only is not None and part.name not in only:
            continue
        corners = world(place, part.points)
        for face in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
            found += [corners[[face[0], face[at], face[at + 1]]] for at in range(1, len(face) - 1)]
    return np.array(found).reshape(-1, 3, 3)


def are_hidden(eyes, targets, faces):
    """True for each target that a triangle hides from its eye; bool, shape (n,)."""
    eyes, ways = np.asarray(eyes, float), np.asarray(targets, float) - np.asarray(eyes, float)
    far = np.linalg.norm(ways, axis=1)
    mesh = trimesh.Trimesh(faces.reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3), process=False)
    places, rays, _ = mesh.ray.intersects_location(eyes, ways / far[:, None], multiple_hits=False)
    hidden = np.zeros(len(eyes), dtype=bool)
    hidden[rays] = np.linalg.norm(places - eyes[rays], axis=1) < far[rays] - _BEFORE_M
    return hidden


def share_hidden(eyes, points, faces):
    """Greatest share of the points of a sign that triangles hide from one of some eyes."""
    points = np.asarray(points, float)
    return max(are_hidden(np.tile(eye, (len(points), 1)), points, faces).mean() for eye in np.asarray(eyes, float))


def spread_over(points, count=12):
    """A grid of points over the front of an upright sign, from its corners."""
    points = np.asarray(points, float)
    low, high = points.min(axis=0), points.max(axis=0)
    across, up = (np.linspace(0.02, 0.98, number) for number in (count, 6))
    flat = low[[0, 2]] + across[:, None] * (high - low)[[0, 2]]
    return np.array([(x, low[1] + at * (high[1] - low[1]), z) for x, z in flat for at in up])
