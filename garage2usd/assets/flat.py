"""Flat sheets of any outline, level or upright."""

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.mesh import Collider, Part, make_part

__all__ = ["GRID_M", "flat_part", "level_triangles", "upright_triangles"]

GRID_M = 1e-6
"""The grid that corners of sheets which meet are snapped to."""


def flat_part(
    name: str,
    area: shapely.Geometry,
    material: str,
    *,
    height_m: float = 0.0,
    collider: Collider | None = Collider.MESH,
    piece: str = "",
) -> Part:
    """A level sheet that looks up, of an (x, z) area."""
    faces = [np.insert(corners, 1, height_m, axis=1) for corners in level_triangles(area)]
    return make_part(name, faces, material, collider=collider, piece=piece, project=_from_above)


def level_triangles(area: shapely.Geometry) -> NDArray[np.float64]:
    """Triangles of an (x, z) area, counter-clockwise seen from above, where +Z runs down the plan.

    Returns
    -------
    NDArray
        float64, shape (triangles, 3, 2).
    """
    # constrained Delaunay, because no edge of it passes through another vertex
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(area))
    corners: NDArray[np.float64] = np.stack([shapely.get_coordinates(triangle)[:3] for triangle in triangles])
    first, second, third = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac = second - first, third - first
    # looking up, with +Z down the plan, is clockwise in (x, z)
    turned = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0] > 0
    corners[turned] = corners[turned][:, ::-1]
    return corners


def upright_triangles(shape: shapely.Geometry, *, middle_m: float, front_m: float) -> NDArray[np.float64]:
    """Triangles of a shape that stands upright and looks to +Z.

    Parameters
    ----------
    shape
        In (x, y), its second coordinate downwards.
    middle_m
        Height of its origin.
    front_m
        Where it stands along Z.

    Returns
    -------
    NDArray
        float64, shape (triangles, 3, 3).
    """
    corners = level_triangles(shape)
    return np.stack([corners[..., 0], middle_m - corners[..., 1], np.full(corners.shape[:2], front_m)], axis=2)


def _from_above(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([face[:, 0], -face[:, 2]], axis=1)
