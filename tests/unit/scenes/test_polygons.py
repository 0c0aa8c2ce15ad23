"""Polygons of any form are covered once by their triangles; shapely measures them."""

import numpy as np
import pytest
import shapely
from pxr import Sdf, Usd, UsdGeom
from scipy.spatial.transform import Rotation

from garage2usd.scenes.meshes import triangles_of

L_SHAPE = [(10, 4), (4, 4), (4, 10), (0, 10), (0, 0), (10, 0)]
COMB = [(0, 0), (9, 0), (9, 5), (8, 5), (8, 1), (6, 1), (6, 5), (5, 5), (5, 1), (1, 1), (1, 5), (0, 5)]
KEYHOLE = [(0, 0), (6, 0), (6, 6), (0, 6), (0, 0), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2)]
SPIRAL = [(0, 0), (8, 0), (8, 8), (2, 8), (2, 4), (5, 4), (5, 5), (3, 5), (3, 7), (7, 7), (7, 1), (0, 1)]


def star(seed, corners=24):
    """A jagged polygon that does not cross itself."""
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0, 2 * np.pi, corners))
    return np.column_stack([np.cos(angles), np.sin(angles)]) * rng.uniform(0.2, 3, (corners, 1))


def area_of(outline):
    x, y = np.array(outline, dtype=float).T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def mesh_of(*outlines, turn=None, **said):
    """Polygons in one plane, turned."""
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/Mesh")
    points = np.concatenate([np.pad(np.array(own, dtype=float), ((0, 0), (0, 1))) for own in outlines])
    mesh.CreatePointsAttr((turn or Rotation.identity()).apply(points).astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([len(own) for own in outlines])
    mesh.CreateFaceVertexIndicesAttr(list(range(len(points))))
    mesh.CreateSubdivisionSchemeAttr("none")
    for name, value in said.items():
        mesh.GetPrim().GetAttribute(name).Set(value)
    return stage, mesh.GetPrim()


def flat_triangles(prim, turn=None):
    """Its triangles, turned back; shape (n, 3, 2)."""
    triangles = triangles_of(prim)
    places = (turn or Rotation.identity()).inv().apply(triangles.positions_m)
    assert np.abs(places[:, 2]).max() < 1e-4
    return triangles, places[triangles.indices][..., :2]


def signed(corners):
    sides = corners[:, 1:] - corners[:, :1]
    return (sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]) / 2


@pytest.mark.parametrize("turn", [None, Rotation.from_euler("xyz", (0.4, -1.1, 2.0))], ids=["level", "tilted"])
@pytest.mark.parametrize(
    "outline",
    [L_SHAPE, COMB, KEYHOLE, SPIRAL, *(star(seed) for seed in range(6))],
    ids=["L", "comb", "with a hole", "spiral", *(f"star {seed}" for seed in range(6))],
)
def test_a_polygon_is_covered_once_wherever_it_begins(outline, turn):
    whole = area_of(outline)
    sound = shapely.make_valid(shapely.Polygon(outline))
    for begin in range(0, len(outline), 3):
        _, prim = mesh_of(np.roll(outline, begin, axis=0), turn=turn)
        triangles, corners = flat_triangles(prim, turn)
        areas = signed(corners)
        assert (areas * np.sign(whole) > -1e-6).all()
        assert areas.sum() == pytest.approx(whole, rel=1e-4)
        covered = shapely.union_all(shapely.polygons(corners), grid_size=1e-6)
        assert covered.symmetric_difference(sound).area < 1e-3
        normals = (turn or Rotation.identity()).inv().apply(triangles.normals)
        assert np.allclose(normals * np.sign(whole), (0, 0, 1), atol=1e-4)


def test_faces_keep_their_numbers_and_values_at_corners():
    square = [(20, 0), (21, 0), (21, 1), (20, 1)]
    _, prim = mesh_of(L_SHAPE, square, star(9) + 40)
    corners = 6 + 4 + 24
    st = np.random.default_rng(0).uniform(0, 1, (corners, 2)).astype(np.float32)
    primvars = UsdGeom.PrimvarsAPI(prim)
    primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying).Set(st)
    triangles = triangles_of(prim)
    assert (np.diff(triangles.face_of) >= 0).all()
    assert np.bincount(triangles.face_of).tolist() == [4, 2, 22]
    points = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get())
    at = {tuple(point): coordinates for point, coordinates in zip(points.tolist(), st.tolist(), strict=True)}
    for place, coordinates in zip(triangles.positions_m.tolist(), triangles.coordinates[:, 0].tolist(), strict=True):
        assert at[tuple(place)] == pytest.approx(coordinates)


def test_holes_are_not_drawn_and_left_hands_turn_over():
    _, prim = mesh_of(L_SHAPE, [(20, 0), (21, 0), (21, 1), (20, 1)], holeIndices=[1], orientation="leftHanded")
    triangles, corners = flat_triangles(prim)
    assert set(triangles.face_of.tolist()) == {0}
    assert signed(corners).sum() == pytest.approx(-64)


@pytest.mark.parametrize(
    "outline",
    [
        [(0, 0), (1, 1), (1, 0), (0, 1)],
        [(0, 0), (1, 0), (2, 0), (3, 0)],
        [(0, 0), (0, 0), (0, 0), (0, 0), (0, 0)],
        [(0, 0), (1, 0), (1, 1), (1, 1), (0, 1)],
        [(0, 0), (1, 0), (0, 0), (1, 0), (1, 1)],
    ],
    ids=["crossing itself", "a line", "a point", "a corner twice", "a side twice"],
)
def test_what_is_no_polygon_is_no_error(outline):
    _, prim = mesh_of(outline)
    triangles = triangles_of(prim)
    assert np.isfinite(triangles.normals).all()
    assert len(triangles.indices) <= len(outline) - 2


def test_a_bent_square_keeps_its_two_triangles():
    """What is not flat is cut as it was, along its first diagonal."""
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/Mesh")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0.4), (1, 1, 0), (0, 1, 0.4)])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    triangles = triangles_of(mesh.GetPrim())
    assert sorted(
        tuple(sorted(map(tuple, triangles.positions_m[own].tolist()))) for own in triangles.indices
    ) == sorted(
        tuple(sorted(map(tuple, np.array(own, dtype=np.float32).tolist())))
        for own in ([(0, 0, 0), (1, 0, 0.4), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0.4)])
    )
