"""Nothing is mirrored: stages of both axes, windings and units against Unity's left-handed space with Y up."""

import itertools

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdLux, Vt
from support.unity.layer import axes_of, place_of, world_vertices

# a tetrahedron with four different edges from its first corner: not its own mirror image
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=float)
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
AXES = ("Y", "Z")
ORIENTATIONS = ("rightHanded", "leftHanded")
UNITS = (1, 0.01)
TO_UNITY = {"Y": np.diag([1, 1, -1]), "Z": np.array([[1, 0, 0], [0, 0, 1], [0, 1, 0]])}

PLACES = {
    "plain": lambda _: None,
    "turned": lambda form: (form.AddTranslateOp().Set((1, -2, 3)), form.AddRotateXYZOp().Set((20, 50, -70))),
    "scaled": lambda form: (form.AddRotateZYXOp().Set((10, 20, 30)), form.AddScaleOp().Set((2, 0.5, 3))),
    "mirrored": lambda form: (
        form.AddTranslateOp().Set((5, 1, 2)),
        form.AddRotateYOp().Set(33),
        form.AddScaleOp().Set((1, -2, 1)),
    ),
    "inverted": lambda form: form.AddScaleOp().Set((-1, -1, -1)),
    "oriented": lambda form: form.AddOrientOp().Set(Gf.Quatf(0.5, 0.5, -0.5, 0.5)),
    "half turned": lambda form: form.AddRotateXOp().Set(180),
}


def new_stage(path, axis: str, metres: float = 1) -> Usd.Stage:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, axis)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    return stage


def add_tetrahedron(stage: Usd.Stage, path: str, orientation: str = "rightHanded") -> UsdGeom.Mesh:
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(CORNERS.astype(np.float32)))
    faces = FACES if orientation == "rightHanded" else [face[::-1] for face in FACES]
    mesh.CreateFaceVertexCountsAttr([3] * len(faces))
    mesh.CreateFaceVertexIndicesAttr(list(itertools.chain(*faces)))
    mesh.CreateOrientationAttr(orientation)
    mesh.CreateSubdivisionSchemeAttr("none")
    return mesh


def signed_volume(prefab, item) -> float:
    vertices = world_vertices(prefab, item)
    a, b, c = np.array(prefab.assets[item["mesh"]]["parts"][0]).reshape(-1, 3).T
    return float(np.einsum("ij,ij->i", vertices[a], np.cross(vertices[b], vertices[c])).sum() / 6)


@pytest.mark.parametrize("metres", UNITS)
@pytest.mark.parametrize("orientation", ORIENTATIONS)
@pytest.mark.parametrize("axis", AXES)
def test_points_stand_where_the_basis_puts_them_and_fronts_look_out(prefabs, tmp_path, axis, orientation, metres):
    stage = new_stage(tmp_path / "stage.usda", axis, metres)
    root = UsdGeom.Xform.Define(stage, "/Root")
    root.AddTranslateOp().Set((10, 20, 30))
    root.AddRotateYOp().Set(25)
    expected = {}
    for name, place in PLACES.items():
        prim_name = name.title().replace(" ", "")
        mesh = add_tetrahedron(stage, f"/Root/{prim_name}", orientation)
        place(mesh)
        world = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(mesh.GetPrim()))
        expected[prim_name] = (np.hstack([CORNERS, np.ones((4, 1))]) @ world)[:, :3] @ TO_UNITY[axis].T * metres
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    for name, corners in expected.items():
        item = prefab.named(name)
        vertices = world_vertices(prefab, item)
        found = np.unique(np.round(vertices, 5) + 0.0, axis=0)
        assert np.allclose(found, np.unique(np.round(corners, 5) + 0.0, axis=0), atol=2e-5), name
        # Unity turns fronts around where a transform mirrors
        assert signed_volume(prefab, item) * np.linalg.det(axes_of(item)) > 0
        mesh = prefab.assets[item["mesh"]]
        points, normals = (np.array(mesh[key]).reshape(-1, 3) for key in ("vertices", "normals"))
        a, b, c = np.array(mesh["parts"][0]).reshape(-1, 3).T
        assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
        assert (np.einsum("ij,ij->i", np.cross(points[b] - points[a], points[c] - points[a]), normals[a]) > 0).all()


@pytest.mark.parametrize("metres", UNITS)
def test_the_same_things_on_stages_of_either_axis_become_the_same(prefabs, tmp_path, metres):
    """What stands upright on a stage with Z up is a quarter turn from how a stage with Y up holds it."""
    prefab = {}
    for axis in AXES:
        stage = new_stage(tmp_path / f"{axis}.usda", axis, metres)
        root = UsdGeom.Xform.Define(stage, "/Root")
        if axis == "Z":
            root.AddRotateXOp().Set(90)
        for number, name in enumerate(PLACES):
            mesh = add_tetrahedron(stage, f"/Root/P{number}")
            PLACES[name](mesh)
        light = UsdLux.DiskLight.Define(stage, "/Root/Light")
        light.AddRotateXYZOp().Set((-90, 40, 10))
        camera = UsdGeom.Camera.Define(stage, "/Root/Camera")
        camera.AddRotateYXZOp().Set((-20, 130, 5))
        stage.Save()
        prefab[axis] = prefabs(tmp_path / f"{axis}.usda")
    for number in range(len(PLACES)):
        one, other = (world_vertices(prefab[axis], prefab[axis].named(f"P{number}")) for axis in AXES)
        assert np.allclose(one, other, atol=1e-5)
    for name, key in (("Light", "light"), ("Camera", "camera")):
        one, other = (prefab[axis].named(name) for axis in AXES)
        assert np.allclose(one[key]["forward"], other[key]["forward"], atol=1e-5)
        # which side of them is up
        assert np.allclose(axes_of(one)[:, 1], axes_of(other)[:, 1], atol=1e-5)


@pytest.mark.parametrize("axis", AXES)
def test_lights_and_cameras_look_along_the_stage_s_negative_z(prefabs, tmp_path, axis):
    stage = new_stage(tmp_path / "stage.usda", axis)
    expected = {}
    kinds = {"Sun": UsdLux.DistantLight, "Panel": UsdLux.RectLight, "Disk": UsdLux.DiskLight, "Eye": UsdGeom.Camera}
    for name, kind in kinds.items():
        prim = kind.Define(stage, f"/{name}")
        prim.AddRotateZXYOp().Set((30, -40, 50))
        world = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim.GetPrim()))[:3, :3]
        expected[name] = -world[2] @ TO_UNITY[axis].T, world[1] @ TO_UNITY[axis].T
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    for name, (forward, up) in expected.items():
        item = prefab.named(name)
        assert np.allclose(item["camera" if name == "Eye" else "light"]["forward"], forward, atol=1e-6)
        assert np.allclose(axes_of(item)[:, 1], up, atol=1e-6)


@pytest.mark.parametrize("axis", AXES)
def test_panels_that_nothing_beside_them_glows_for_glow_and_look_where_they_shine(prefabs, tmp_path, axis):
    stage = new_stage(tmp_path / "stage.usda", axis, 0.01)
    light = UsdLux.RectLight.Define(stage, "/Panel")
    light.CreateWidthAttr(200)
    light.CreateHeightAttr(50)
    light.AddRotateXYZOp().Set((15, 25, 35))
    light.AddTranslateOp(opSuffix="late").Set((0, 0, 100))
    UsdGeom.Xform.Define(stage, "/Panel/Below")
    UsdLux.DiskLight.Define(stage, "/Disk").CreateRadiusAttr(50)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    forward = next(item for item in prefab.objects if item.get("light", {}).get("type") == "Spot")["light"]["forward"]
    glow, disk = [item for item in prefab.objects if item["path"].endswith("/Glow")]
    vertices = world_vertices(prefab, glow)
    world = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(light.GetPrim()))
    corners = np.array([[x, y, 0, 1] for x in (-100, 100) for y in (-25, 25)]) @ world
    expected = corners[:, :3] @ TO_UNITY[axis].T / 100
    assert np.allclose(np.unique(np.round(vertices, 4), axis=0), np.unique(np.round(expected, 4), axis=0), atol=2e-4)
    around = world_vertices(prefab, disk)
    # the disk is not turned, and has nothing below it that would keep its object from turning
    for item, points, looks in ((glow, vertices, forward), (disk, around, -TO_UNITY[axis][:, 2])):
        a, b, c = points[np.array(prefab.assets[item["mesh"]]["parts"][0][:3])]
        normal = np.cross(b - a, c - a)
        assert np.allclose(normal / np.linalg.norm(normal), looks, atol=1e-5)
    assert np.allclose(np.linalg.norm(around - place_of(disk), axis=1), 0.5)
    material = prefab.assets[glow["materials"][0]]
    assert material["keywords"] == ["_EMISSION"]
    assert material["colors"]["_EmissionColor"] == [1, 1, 1, 1]


def test_sheared_transforms_are_reported(prefabs, tmp_path):
    stage = new_stage(tmp_path / "stage.usda", "Y")
    mesh = add_tetrahedron(stage, "/Sheared")
    mesh.AddTransformOp().Set(Gf.Matrix4d(1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1))
    straight = add_tetrahedron(stage, "/Straight")
    straight.AddTransformOp().Set(Gf.Matrix4d(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1))
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    (warning,) = prefab.found["warnings"]
    assert "sheared" in warning
    assert "/Sheared" in warning
    assert np.allclose(place_of(prefab.named("Sheared")), [1, 2, -3])
    axes = axes_of(prefab.named("Sheared"))
    assert np.allclose(axes[:, 0], [1, 0, 0])
    assert np.allclose(axes.T @ axes, np.diag(np.diag(axes.T @ axes)), atol=1e-6)


def test_transforms_that_leave_their_parents_aside(prefabs, tmp_path):
    stage = new_stage(tmp_path / "stage.usda", "Y")
    UsdGeom.Xform.Define(stage, "/Moved").AddTranslateOp().Set((5, 0, 0))
    free = UsdGeom.Xform.Define(stage, "/Moved/Free")
    free.AddTranslateOp().Set((0, 1, 0))
    free.SetResetXformStack(True)
    stage.Save()
    assert np.allclose(place_of(prefabs(tmp_path / "stage.usda").named("Free")), [0, 1, 0])


def test_scale_enlarges_everything(prefabs, tmp_path):
    stage = new_stage(tmp_path / "stage.usda", "Z", 0.01)
    mesh = add_tetrahedron(stage, "/Mesh")
    mesh.AddTranslateOp().Set((100, 200, 300))
    light = UsdLux.SphereLight.Define(stage, "/Bulb")
    light.CreateRadiusAttr(10)
    stage.Save()
    one, two = (prefabs(tmp_path / "stage.usda", scale=scale) for scale in (1, 2))
    assert np.allclose(2 * place_of(one.named("Mesh")), place_of(two.named("Mesh")))
    assert np.allclose(2 * world_vertices(one, one.named("Mesh")), world_vertices(two, two.named("Mesh")))
    # twice as far from it, four times as strong: as bright
    strength = [prefab.named("Bulb")["light"]["intensity"] for prefab in (one, two)]
    assert strength[1] == pytest.approx(4 * strength[0])
    assert strength[0] == pytest.approx(0.1**2)


def test_points_of_an_instancer(prefabs, tmp_path):
    stage = new_stage(tmp_path / "stage.usda", "Z", 0.5)
    holder = UsdGeom.PointInstancer.Define(stage, "/Scattered")
    holder.AddTranslateOp().Set((1, 2, 3))
    kinds = UsdGeom.Xform.Define(stage, "/Scattered/Kinds")
    one = add_tetrahedron(stage, "/Scattered/Kinds/One")
    one.AddTranslateOp().Set((0, 0, 5))
    UsdGeom.Xform.Define(stage, "/Scattered/Kinds/Other").AddRotateZOp().Set(90)
    add_tetrahedron(stage, "/Scattered/Kinds/Other/Deep").AddScaleOp().Set((1, 1, 2))
    holder.CreatePrototypesRel().SetTargets([kinds.GetPath().AppendChild(name) for name in ("One", "Other")])
    holder.CreateProtoIndicesAttr([0, 1, 1, 0])
    holder.CreatePositionsAttr([(0, 0, 0), (10, 0, 0), (0, 10, 0), (0, 0, 10)])
    holder.CreateOrientationsAttr(
        Vt.QuathArray([Gf.Quath(1), Gf.Quath(0.5, 0.5, 0.5, 0.5), Gf.Quath(0, 0, 1, 0), Gf.Quath(1)])
    )
    holder.CreateScalesAttr([(1, 1, 1), (2, 2, 2), (1, 3, 1), (-1, 1, 1)])
    holder.CreateInvisibleIdsAttr([2])
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    matrices = holder.ComputeInstanceTransformsAtTime(0, 0)
    above = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(holder.GetPrim()))
    deep = np.array(Gf.Matrix4d().SetScale((1, 1, 2)))
    found = {item["path"]: item for item in prefab.objects}
    assert not any("Kinds" in path for path in found)
    for index, (number, matrix) in enumerate(zip((0, 1, 3), matrices, strict=True)):
        path = f"stage/Scattered/Scattered[{number}]" + ("/Deep" if index == 1 else "")
        world = (deep if index == 1 else np.eye(4)) @ np.array(matrix) @ above
        corners = (np.hstack([CORNERS, np.ones((4, 1))]) @ world)[:, :3] @ TO_UNITY["Z"].T * 0.5
        vertices = world_vertices(prefab, found.pop(path))
        assert np.allclose(np.unique(np.round(vertices, 4), axis=0), np.unique(np.round(corners, 4), axis=0), atol=2e-4)
    assert len([item for item in found.values() if "mesh" in item]) == 0


def test_instances_share_all_that_is_the_same_and_nothing_else(prefabs, tmp_path):
    """Instances with their own binding at the root, of two materials, one mirrored: as ``pxr`` binds them."""
    (tmp_path / "asset.usda").write_text("""#usda 1.0
( defaultPrim = "Asset" )
def Xform "Asset" ( prepend apiSchemas = ["MaterialBindingAPI"]
    variants = { string paint = "red" }
    prepend variantSets = "paint" )
{
    rel material:binding = </Asset/Looks/Paint>
    def Sphere "Ball" ( prepend apiSchemas = ["PhysicsCollisionAPI"] ) {}
    def Scope "Looks" { def Material "Paint"
        {
            token outputs:surface.connect = </Asset/Looks/Paint/Surface.outputs:surface>
            def Shader "Surface" { uniform token info:id = "UsdPreviewSurface"
                token outputs:surface }
        }
    }
    variantSet "paint" = {
        "red" { over "Looks" { over "Paint" { over "Surface" { color3f inputs:diffuseColor = (1, 0, 0) } } } }
        "blue" { over "Looks" { over "Paint" { over "Surface" { color3f inputs:diffuseColor = (0, 0, 1) } } } }
    }
}
""")
    placed = {"First": "red", "Second": "blue", "Third": "red", "Mirrored": "red"}
    text = "#usda 1.0\n( metersPerUnit = 1 )\n"
    for name, paint in placed.items():
        scale = "(-1, 1, 1)" if name == "Mirrored" else "(1, 1, 1)"
        text += f"""def "{name}" ( instanceable = true
    prepend references = @asset.usda@
    variants = {{ string paint = "{paint}" }} )
{{
    float3 xformOp:scale = {scale}
    uniform token[] xformOpOrder = ["xformOp:scale"]
}}
"""
    (tmp_path / "stage.usda").write_text(text)
    prefab = prefabs(tmp_path / "stage.usda")
    balls = {item["path"].split("/")[1]: item for item in prefab.objects if item["path"].endswith("/Ball")}
    colors = {name: prefab.assets[ball["materials"][0]]["colors"]["_Color"][::2] for name, ball in balls.items()}
    assert {name: color[0] > color[1] for name, color in colors.items()} == {
        name: paint == "red" for name, paint in placed.items()
    }
    assert len({ball["mesh"] for ball in balls.values()}) == 1
    assert len({ball["materials"][0] for ball in balls.values()}) == 2
    (warning,) = [line for line in prefab.found["warnings"] if "mirrored" in line]
    assert "(1)" in warning
