"""Slabs below level sheets, and boxes and cylinders in place of convex hulls."""

import numpy as np
import pytest
import shapely
import trimesh

from garage2usd.maps.sdf_collisions import Collisions
from garage2usd.maps.sdf_ground import slabs

YARD = shapely.Polygon([(0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)], [[(1, 1), (1, 2), (2, 2), (2, 1)]])


def sheets(polygon, height_m=0.0):
    """A polygon as triangles, some of them clockwise."""
    flat = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    corners = shapely.get_coordinates(flat).reshape(-1, 4, 2)[:, :3]
    corners[::2] = corners[::2, ::-1]
    return np.concatenate([corners, np.full((*corners.shape[:2], 1), height_m)], axis=2)


def test_an_outline_along_the_axes_is_boxes():
    paint = sheets(shapely.box(3, 3, 4, 4), 0.0004)
    made = list(slabs(np.concatenate([sheets(YARD), paint, sheets(shapely.box(0, 0, 2, 2), 3.0)])))
    assert all(len(each.corners) == 0 for each in made)
    grounds = [
        shapely.box(
            *(np.array(each.middle_m) - np.array(each.sides_m) / 2)[:2],
            *(np.array(each.middle_m) + np.array(each.sides_m) / 2)[:2],
        )
        for each in made
    ]
    tops = [each.middle_m[2] + each.sides_m[2] / 2 for each in made]
    lower = [ground for ground, top in zip(grounds, tops, strict=True) if top < 1]
    assert tops == pytest.approx([0.0] * len(lower) + [3.0])
    assert shapely.union_all(lower).symmetric_difference(YARD).area < 1e-6
    assert sum(ground.area for ground in lower) == pytest.approx(YARD.area)
    assert len(lower) <= 5


def test_any_other_outline_is_a_prism():
    turned = shapely.affinity.rotate(YARD, 20)
    (made,) = slabs(sheets(turned, -3.6))
    mesh = trimesh.Trimesh(*trimesh.triangles.to_kwargs(made.corners).values())
    mesh.merge_vertices()
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(0.05 * YARD.area, rel=1e-4)
    assert mesh.bounds[:, 2] == pytest.approx([-3.65, -3.6])


@pytest.mark.parametrize(
    ("mesh", "kind"),
    [
        (trimesh.creation.box((0.6, 0.4, 2.0)), "box"),
        (trimesh.creation.cylinder(0.3, 0.2, sections=24), "cylinder"),
        (trimesh.creation.cylinder(0.3, 2.0, sections=5), "mesh"),
        (trimesh.creation.cone(0.3, 1.0), "mesh"),
    ],
    ids=["box", "many sides", "five sides", "cone"],
)
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_hull_keeps_its_volume(mesh, kind, axis):
    points = np.roll(mesh.vertices, axis, axis=1) + np.array([5.0, -2.0, 1.0])
    collisions = Collisions()
    shape = collisions._hull(points)
    assert shape.kind == kind
    if kind == "box":
        made = trimesh.creation.box(shape.sizes_m)
    elif kind == "cylinder":
        made = trimesh.creation.cylinder(*shape.sizes_m, sections=3600)
    else:
        made = trimesh.Trimesh(*trimesh.triangles.to_kwargs(collisions.meshes[shape.mesh]).values())
        made.merge_vertices()
        assert made.is_watertight
    made.apply_transform(shape.place)
    assert made.volume == pytest.approx(mesh.convex_hull.volume, rel=1e-5)
    assert made.bounds == pytest.approx(np.array([points.min(axis=0), points.max(axis=0)]), abs=0.01)
