"""Point cloud map of a garage: points on all surfaces of the building that a LiDAR on the lanes sees."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Usd
from scipy.spatial import cKDTree

from garage2usd.objects import MOVABLE_LABELS, barrier, number_plate
from garage2usd.reading.labels import read_labels
from garage2usd.sensors.rays.point_cloud import write_pcd
from garage2usd.sensors.rays.ray_scene import RayScene, read_ray_scene
from garage2usd.sensors.rig.poses import MAP_TO_Y_UP, y_up_to_stage

Floats = NDArray[np.float64]

_MOVABLE = MOVABLE_LABELS | {barrier.KIND.label, number_plate.KIND.label}
"""Classes of things that move: points on them would mislead localization, and hide the things from perception."""
_SPACING_M = 0.2
"""Distance between points, as of maps that are downsampled for NDT; a cell of NDT of 2 m then holds a hundred."""
_MOST_POINTS = 4_000_000
"""Number of points from which on they are further apart, for files of at most 48 MB."""
_EYES_M, _EYES_APART_M = 1.9, 2.0
"""Height of the LiDAR over the lanes, and the side of the cells of which each has one place of it."""
_NEAREST = 8
"""Number of the nearest places of the LiDAR from which a point is looked for."""
_SEEN_M = 0.005
_CHUNK = 500_000
_LARGEST_M, _TILE_M = 100.0, 20
"""Side of a map from which on it is divided, and side of its tiles, both as Autoware recommends."""
_POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4")])
_GOLDEN, _SECOND = 0.7548776662466927, 0.5698402909980532
"""Steps of Roberts's sequence, which fills the unit square evenly: powers of the inverse of the plastic number."""


def point_cloud(stage: Usd.Stage, eyes_m: Floats) -> NDArray[np.float32]:
    """Sample the surfaces of a stage that can be seen from above its lanes, without anything that moves.

    Parameters
    ----------
    stage
        The stage.
    eyes_m
        Places on the lanes, in the frame of `garage2usd.maps.frame`; shape (n, 3).

    Returns
    -------
    ndarray
        Points in that frame; float32, shape (n, 3).

    Notes
    -----
    Points are drawn by area: systematic sampling along the triangles, and within each triangle by Roberts's sequence. A
    point is kept if a ray from one of the nearest places of the LiDAR meets it first, rather than something before it,
    or something behind it through a hole in its surface's texture.
    """
    labels = read_labels(stage, None)
    whole = read_ray_scene(stage, labels)
    moving = [number for number, kind in labels.classes.items() if kind.name in _MOVABLE]
    scene = whole.of_triangles(~np.isin(whole.class_id, moving))
    to_stage = (y_up_to_stage(stage) @ MAP_TO_Y_UP)[:3, :3]
    eyes_m = eyes_m + np.array([0.0, 0.0, _EYES_M])
    _, first = np.unique(np.floor(eyes_m / _EYES_APART_M), axis=0, return_index=True)
    eyes = eyes_m[np.sort(first)] @ to_stage.T
    tree = cKDTree(eyes)
    points = [chunk[_is_seen(scene, chunk, eyes, tree)] for chunk in _on_surfaces(scene)]
    found: NDArray[np.float32] = (np.concatenate(points) @ to_stage).astype(np.float32)
    return found


def _on_surfaces(scene: RayScene) -> Iterator[Floats]:
    """Yield points evenly on all triangles, in parts."""
    first, second, third = scene.vertices_m[scene.triangles].transpose(1, 0, 2)
    areas = np.cumsum(np.linalg.norm(np.cross(second - first, third - first), axis=1) / 2)
    count = max(1, math.ceil(min(areas[-1] / _SPACING_M**2, 2 * _MOST_POINTS)))
    for start in range(0, count, _CHUNK):
        numbers = np.arange(start, min(start + _CHUNK, count))
        triangle = np.minimum(np.searchsorted(areas, (numbers + 0.5) * (areas[-1] / count)), len(areas) - 1)
        along, across = (numbers * _GOLDEN) % 1.0, (numbers * _SECOND) % 1.0
        is_beyond = along + across > 1
        along, across = np.where(is_beyond, (1 - along, 1 - across), (along, across))[..., None]
        corner = first[triangle]
        yield corner + along * (second[triangle] - corner) + across * (third[triangle] - corner)


def _is_seen(scene: RayScene, points: Floats, eyes: Floats, tree: cKDTree) -> NDArray[np.bool_]:
    """Return True for each point that is seen from one of the nearest places."""
    _, nearest = tree.query(points, k=min(_NEAREST, len(eyes)))
    nearest = nearest.reshape(len(points), -1)
    is_seen = np.zeros(len(points), dtype=np.bool_)
    for column in nearest.T:
        hidden = np.flatnonzero(~is_seen)
        begins = eyes[column[hidden]]
        ways = points[hidden] - begins
        far_m = np.linalg.norm(ways, axis=1)
        hits = scene.cast(begins, ways / np.maximum(far_m, _SEEN_M)[:, None])
        is_seen[hidden] = np.abs(hits.range_m - far_m) < _SEEN_M
    return is_seen


def write_point_cloud(points: NDArray[np.float32], folder: Path) -> None:
    """Write a point cloud map into the folder of Autoware's maps: one file, or tiles and their metadata if it is large.

    Parameters
    ----------
    points
        The points; shape (n, 3).
    folder
        An existing folder.
    """
    rows = np.ascontiguousarray(points).view(_POINT).ravel()
    if np.ptp(points[:, :2], axis=0).max(initial=0.0) <= _LARGEST_M:
        write_pcd(rows, folder / "pointcloud_map.pcd")
        return
    tiles, which = np.unique(np.floor(points[:, :2] / _TILE_M).astype(int) * _TILE_M, axis=0, return_inverse=True)
    (folder / "pointcloud_map.pcd").mkdir()
    lines = [f"{axis}_resolution: {_TILE_M:.1f}" for axis in "xy"]
    order = np.argsort(which.ravel(), kind="stable")
    parts = np.split(order, np.cumsum(np.bincount(which.ravel(), minlength=len(tiles)))[:-1])
    for (x, y), part in zip(tiles.tolist(), parts, strict=True):
        name = f"tile_{x}_{y}.pcd"
        write_pcd(rows[part], folder / "pointcloud_map.pcd" / name)
        lines.append(f"{name}: [{x}, {y}]")
    (folder / "pointcloud_map_metadata.yaml").write_text("\n".join([*lines, ""]), encoding="utf-8", newline="\n")
