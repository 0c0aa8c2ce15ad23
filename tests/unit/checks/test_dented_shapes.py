"""What is no convex polygon takes the ground that it covers and no more, for the rules and for grids."""

import numpy as np
import pytest
import shapely
from pxr import Sdf, Usd, UsdGeom

from garage2usd.as_built.stage_reader import level_of_stage
from garage2usd.maps.occupancy import floor_of

L_SHAPE = [(10, 4), (4, 4), (4, 10), (0, 10), (0, 0), (10, 0)]


def stage_of(label, height, begin=0):
    """A slab in the form of an L, or a sheet; its outline may begin at any corner."""
    outline = L_SHAPE[begin:] + L_SHAPE[:begin]
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    mesh = UsdGeom.Mesh.Define(stage, "/L")
    count = len(L_SHAPE)
    points = [(x, 0, z) for x, z in outline] + [(x, height, z) for x, z in outline]
    faces = [list(range(count))[::-1], list(range(count, 2 * count))] if height else [list(range(count))]
    if height:
        faces += [[k, (k + 1) % count, (k + 1) % count + count, k + count] for k in range(count)]
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr([corner for face in faces for corner in face])
    prim = mesh.GetPrim()
    prim.ApplyAPI("SemanticsLabelsAPI", "class")
    prim.CreateAttribute("semantics:labels:class", Sdf.ValueTypeNames.TokenArray).Set([label])
    return stage


@pytest.mark.parametrize("begin", range(6))
def test_a_wall_leaves_its_corner_free(begin):
    subject = level_of_stage(stage_of("wall", 3.0, begin), source="stage", is_judged=False)
    solids = list(subject.solids.between(0, 3))
    assert shapely.union_all([solid.footprint for solid in solids]).area == pytest.approx(64)
    assert {(solid.bottom_m, solid.top_m) for solid in solids} == {(0.0, 3.0)}
    assert subject.solids.at(shapely.box(6, 6, 9, 9)) == []
    assert subject.solids.at(shapely.box(1, 6, 3, 9)) != []


@pytest.mark.parametrize("height", [0.0, 0.2])
def test_a_floor_ends_where_it_ends(height):
    subject = level_of_stage(stage_of("floor", height), source="stage", is_judged=False)
    assert shapely.union_all(floor_of(subject)).area == pytest.approx(64)
    assert not shapely.intersects(shapely.union_all(floor_of(subject)), shapely.Point(8, 8))


def test_what_is_turned_keeps_its_form():
    stage = stage_of("wall", 3.0)
    UsdGeom.Xformable(stage.GetPrimAtPath("/L")).AddRotateYOp().Set(30)
    subject = level_of_stage(stage, source="stage", is_judged=False)
    footprints = [solid.footprint for solid in subject.solids.between(0, 3)]
    angle = np.radians(-30)
    turned = [(x * np.cos(angle) - z * np.sin(angle), x * np.sin(angle) + z * np.cos(angle)) for x, z in L_SHAPE]
    assert shapely.union_all(footprints).symmetric_difference(shapely.Polygon(turned)).area < 1e-3
