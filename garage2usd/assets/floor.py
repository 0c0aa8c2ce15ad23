"""Floor panels, partitioned into coating and markings so that nothing lies on anything else."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import mapbox_earcut
import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part

__all__ = ["Marking", "floor_panel"]

Polygon = tuple[tuple[float, float], ...]

_GRID_M = 1e-6


@dataclass(frozen=True)
class Marking:
    """A painted polygon: corners (x, z) in metres from the panel's middle, and its material."""

    polygon: Polygon
    material: str


def floor_panel(
    *,
    width_m: float,
    depth_m: float,
    base_material: str,
    markings: Sequence[Marking],
    openings: Sequence[Polygon],
    label: str,
) -> Asset:
    """A floor panel at y = 0 with its origin in its middle.

    Parameters
    ----------
    width_m, depth_m
        Extent along X and Z.
    base_material
        Coating of what is not marked.
    markings
        Polygons that do not overlap; each material becomes a mesh of its own in the same plane.
    openings
        Polygons left free for other panels.
    label
        Semantic class.
    """
    by_material: dict[str, list[shapely.Polygon]] = defaultdict(list)
    for marking in markings:
        by_material[marking.material].append(shapely.Polygon(marking.polygon))
    areas = {material: shapely.union_all(shapes, grid_size=_GRID_M) for material, shapes in by_material.items()}
    base = shapely.box(-width_m / 2, -depth_m / 2, width_m / 2, depth_m / 2)
    base = shapely.difference(base, shapely.union_all([shapely.Polygon(shape) for shape in openings]), grid_size=_GRID_M)
    areas = {material: shapely.intersection(area, base, grid_size=_GRID_M) for material, area in areas.items()}
    base = shapely.difference(base, shapely.union_all(list(areas.values())), grid_size=_GRID_M)
    parts = [
        _flat_part(_pascal(material), area, material)
        for material, area in [(base_material, base), *areas.items()]
        if area.area > 0
    ]
    return Asset(label, tuple(parts))


def _flat_part(name: str, area: shapely.Geometry, material: str) -> Part:
    polygons = [shape for shape in getattr(area, "geoms", [area]) if isinstance(shape, shapely.Polygon)]
    faces = [face for polygon in polygons for face in _triangles(shapely.orient_polygons(polygon))]
    return make_part(name, faces, material, collider=Collider.MESH, project=_from_above)


def _triangles(polygon: shapely.Polygon) -> list[Face]:
    """Triangles that look up: with +Z down the plan, that is clockwise in (x, z)."""
    rings = [np.asarray(ring.coords)[:-1] for ring in (polygon.exterior, *polygon.interiors)]
    corners = np.concatenate(rings)
    ends = np.cumsum([len(ring) for ring in rings]).astype(np.uint32)
    indices = mapbox_earcut.triangulate_float64(corners, ends).reshape(-1, 3)
    flat = np.stack([corners[:, 0], np.zeros(len(corners)), corners[:, 1]], axis=1)
    triangles = []
    for triangle in flat[indices]:
        up = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])[1] > 0
        triangles.append(triangle if up else triangle[::-1])
    return triangles


def _from_above(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([face[:, 0], -face[:, 2]], axis=1)


def _pascal(key: str) -> str:
    return "".join(word.capitalize() for word in key.split("_"))
