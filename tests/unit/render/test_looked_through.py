"""What views from above look through: all that hangs over the head of a car, by its height over floor and ramps."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom
from support.held_stage import held_aloft
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd.assets.faces import box_faces
from garage2usd.reading.labels import read_labels
from garage2usd.render.drawn_prims import find_overhead, read_drawn_prims

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"


def found_in(stage, ids):
    """Whether each drawn prim hangs, and the height that it is cut at, by the path of its shape; the first of each."""
    scene = read_drawn_prims(stage, ids)
    overhead = find_overhead(stage, scene, {})
    rows = {str(scene.shapes[shape]): row for row, shape in reversed(list(enumerate(scene.shape.tolist())))}
    return {path: (bool(overhead.hangs[row]), float(overhead.cut_m[row])) for path, row in rows.items()}


def define_boxes(stage, path, *boxes):
    mesh = UsdGeom.Mesh.Define(stage, path)
    faces = [face for low, high in boxes for face in box_faces(low, high)]
    mesh.CreatePointsAttr([Gf.Vec3f(*map(float, point)) for face in faces for point in face])
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr(range(sum(len(face) for face in faces)))
    return mesh


@pytest.mark.parametrize("is_z_up", [False, True])
def test_what_hangs_and_where_the_rest_is_cut(is_z_up):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z if is_z_up else UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    held = UsdGeom.Xform.Define(stage, "/Held")
    held.AddScaleOp().Set(Gf.Vec3f(100.0))
    if is_z_up:
        held.AddRotateXOp().Set(90.0)
    define_boxes(stage, "/Held/Slab", ((0, 2.1, 0), (4, 2.3, 4)))
    define_boxes(stage, "/Held/LowSlab", ((0, 1.9, 0), (4, 2.3, 4)))
    define_boxes(stage, "/Held/Wall", ((0, 0, 0), (4, 3, 0.2)))
    define_boxes(stage, "/Held/Gallows", ((0, 0, 0), (0.2, 3, 0.2)), ((0.2, 2.2, 0), (2, 2.5, 0.2)))
    define_boxes(stage, "/Held/LowGallows", ((0, 0, 0), (0.2, 3, 0.2)), ((0.2, 1.5, 0), (2, 2.5, 0.2)))
    found = found_in(stage, {})
    assert {path.rpartition("/")[2]: hangs for path, (hangs, _) in found.items()} == {
        "Slab": True,
        "LowSlab": False,
        "Wall": False,
        "Gallows": False,
        "LowGallows": False,
    }
    cuts = {path.rpartition("/")[2]: cut_m for path, (_, cut_m) in found.items() if np.isfinite(cut_m)}
    assert cuts == {"Gallows": pytest.approx(2.19, abs=1e-3)}


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested", "flat"]))
def test_portals_and_ramps_are_open_from_above_in_every_form(builds, form):
    made = builds(HAND_DRAWN, "usdc", form)
    stage = Usd.Stage.Open(str(made.stage))
    found = found_in(stage, read_labels(stage, made.stage).ids)
    parts = {path.rpartition("/Geom/")[2]: told for path, told in found.items() if "Ramp" in path or "Portal" in path}
    assert all(parts[name] == (True, pytest.approx(np.nan, nan_ok=True)) for name in ("Lintel", "Sign", "Cover"))
    assert parts["Header"][0]
    assert parts["Frame"] == (False, pytest.approx(2.31, abs=1e-3))
    standing = {"LeftJamb", "RightJamb", "Floor", "Threshold", "LeftWall", "RightWall", "LeftKerb", "RightKerb"}
    assert all(parts[name] == (False, pytest.approx(np.nan, nan_ok=True)) for name in standing)
    assert all(hangs for path, (hangs, _) in found.items() if "/Sky_" in path)
    assert not any(hangs for path, (hangs, _) in found.items() if "/Car" in path or "/Column" in path)


@pytest.mark.soak
def test_a_garage_that_stands_elsewhere_is_open_at_the_same_places(builds, tmp_path):
    stage = Usd.Stage.Open(str(builds(HAND_DRAWN, "usdc", "instanced").stage))
    over = held_aloft(stage, tmp_path)
    plain, lifted = (find_overhead(each, read_drawn_prims(each, {}), {}) for each in (stage, over))
    assert plain.hangs.sum() > 100
    assert lifted.hangs.tolist() == plain.hangs.tolist()
    assert lifted.cut_m == pytest.approx(plain.cut_m + 4.5, nan_ok=True, abs=1e-4)
