"""Planar sheets with any outline, level or upright."""

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.materials import MATERIALS
from garage2usd.assets.mesh import MIN_AREA_M2, WELD_DECIMALS, Collider, Part, make_part, unique_rows

GRID_M = 1e-6
"""Grid in metres to which corners of adjacent sheets are snapped."""


def flat_part(
    name: str,
    area: shapely.Geometry,
    material: str,
    *,
    height_m: float = 0.0,
    collider: Collider | None = Collider.MESH,
    piece: str = "",
) -> Part:
    """Make a level sheet that faces upwards from an (x, z) area."""
    corners = level_triangles(area)
    points, triangles = unique_rows(np.round(corners.reshape(-1, 2), WELD_DECIMALS) + 0.0)
    triangles = triangles.reshape(-1, 3)
    (ax, az), (bx, bz) = (np.moveaxis(points[triangles[:, end]] - points[triangles[:, 0]], 1, 0) for end in (1, 2))
    up = az * bx - ax * bz
    if not (up > MIN_AREA_M2).all():
        faces = np.insert(corners, 1, height_m, axis=2)
        return make_part(name, faces, material, collider=collider, piece=piece, project=_from_above)
    # set directly instead of by `make_part`, as all faces point upwards
    corner_of = triangles.ravel().astype(np.int32)
    look, st, st_of = MATERIALS[material], np.empty((0, 2)), np.empty(0, dtype=np.int64)
    if look.textures():
        repeats_m = look.repeat_m, look.repeat_up_m or look.repeat_m
        st, st_of = unique_rows(np.round(points * (1.0, -1.0) / repeats_m, WELD_DECIMALS) + 0.0)
        st_of = st_of[corner_of]
    return Part(
        name=name,
        points=np.insert(points, 1, round(height_m, WELD_DECIMALS), axis=1).astype(np.float32),
        face_counts=np.full(len(triangles), 3, dtype=np.int32),
        face_indices=corner_of,
        normals=np.array([(0.0, 1.0, 0.0)], dtype=np.float32),
        normal_indices=np.zeros(len(corner_of), dtype=np.int32),
        st=st.astype(np.float32),
        st_indices=st_of.astype(np.int32),
        material=material,
        collider=collider,
        piece=piece,
    )


def level_triangles(area: shapely.Geometry) -> NDArray[np.float64]:
    """Triangulate an (x, z) area, counter-clockwise seen from above, where +Z runs down the plan.

    Returns
    -------
    NDArray
        float64, shape (triangles, 3, 2).
    """
    # constrained Delaunay: no edge passes through another vertex
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(area))
    # closed rings of four corners, the last equal to the first
    corners: NDArray[np.float64] = shapely.get_coordinates(triangles).reshape(-1, 4, 2)[:, :3].copy()
    first, second, third = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac = second - first, third - first
    # upward faces are clockwise in (x, z), as +Z runs down the plan
    turned = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0] > 0
    corners[turned] = corners[turned][:, ::-1]
    return corners


def upright_triangles(shape: shapely.Geometry, *, middle_m: float, front_m: float) -> NDArray[np.float64]:
    """Triangulate an upright shape that faces +Z.

    Parameters
    ----------
    shape
        Shape in (x, y), with y downwards.
    middle_m
        Height of its origin.
    front_m
        Its Z.

    Returns
    -------
    NDArray
        float64, shape (triangles, 3, 3).
    """
    corners = level_triangles(shape)
    return np.stack([corners[..., 0], middle_m - corners[..., 1], np.full(corners.shape[:2], front_m)], axis=2)


def _from_above(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([face[:, 0], -face[:, 2]], axis=1)
