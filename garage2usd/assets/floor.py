"""Floor panels, partitioned into coating and markings so that nothing lies on anything else."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.mesh import Asset, Collider, Part, make_part

__all__ = ["Marking", "flat_part", "floor_panel", "level_triangles"]

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
    base = shapely.difference(
        base, shapely.union_all([shapely.Polygon(shape) for shape in openings]), grid_size=_GRID_M
    )
    areas = {material: shapely.intersection(area, base, grid_size=_GRID_M) for material, area in areas.items()}
    base = shapely.difference(base, shapely.union_all(list(areas.values())), grid_size=_GRID_M)
    parts = [
        flat_part(_pascal(material), area, material)
        for material, area in [(base_material, base), *areas.items()]
        if area.area > 0
    ]
    return Asset(label, tuple(parts))


def flat_part(
    name: str,
    area: shapely.Geometry,
    material: str,
    *,
    height_m: float = 0.0,
    collider: Collider | None = Collider.MESH,
) -> Part:
    """A level sheet that looks up, of an (x, z) area."""
    faces = [np.insert(corners, 1, height_m, axis=1) for corners in level_triangles(area)]
    return make_part(name, faces, material, collider=collider, project=_from_above)


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


def _from_above(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([face[:, 0], -face[:, 2]], axis=1)


def _pascal(key: str) -> str:
    return "".join(word.capitalize() for word in key.split("_"))
