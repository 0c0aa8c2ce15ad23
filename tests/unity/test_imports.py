"""Imports as a whole: what the layer compiles for; colliders, shapes, errors, cancelling, loading in players."""

import itertools
import math
import re
import subprocess

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdShade, Vt
from support.documentation import blocks
from support.sample_files import REPOSITORY
from support.unity import reader
from support.unity.layer import (
    EDITOR,
    LAYER,
    UNITY_6,
    compile_assembly,
    compile_layer,
    compile_package,
    compile_prefab_dump,
    sources_of,
)


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
@pytest.mark.parametrize(
    "defines",
    [
        pytest.param((), marks=pytest.mark.soak),  # as for the script of the guide below
        (UNITY_6,),
        pytest.param((EDITOR, "GARAGE_OTHER_USD_IMPORTER"), marks=pytest.mark.soak),
        pytest.param(("UNITY_WEBGL",), marks=pytest.mark.soak),
    ],
    ids="-".join,
)
def test_the_package_compiles_without_a_warning(tmp_path, defines):
    compile_package(tmp_path, *defines)


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
def test_the_scripts_of_the_guide_compile(tmp_path):
    compile_layer(tmp_path)
    scripts = [block for block in blocks(REPOSITORY / "docs" / "guides" / "unity.md") if block.language == "csharp"]
    assert len(scripts) == 2
    for number, script in enumerate(scripts):
        source = tmp_path / f"Script{number}.cs"
        source.write_text(script.text)
        compile_assembly(tmp_path / f"Guide{number}.dll", [source], LAYER, ())


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
@pytest.mark.parametrize("defines", [(EDITOR,), pytest.param((EDITOR, UNITY_6), marks=pytest.mark.soak)], ids="-".join)
def test_the_tests_for_unity_s_own_runner_pass_on_the_fakes(tmp_path, defines):
    compile_package(tmp_path, *defines)
    names = ["Garage.Usd", "UnityFakes", "Garage.Unity", "Garage.Unity.Editor", "NUnitFakes"]
    program = tmp_path / "TestRun.exe"
    compile_assembly(program, sources_of("Tools~/TestRun"), names, defines)
    tests = [
        tmp_path / f"{name}.dll" for name in ("Garage.Unity.Editor", "Garage.Unity.Editor.Tests", "Garage.Unity.Tests")
    ]
    command = ["mono", program, tmp_path / "project", *tests]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    outcomes = dict(line.split("\t", maxsplit=1) for line in done.stdout.splitlines())
    assert {name: outcome for name, outcome in outcomes.items() if outcome != "passed"} == {}
    assert len(outcomes) == len(
        re.findall(r"\[(?:Unity)?Test\]", "".join(one.read_text() for one in sources_of("Tests")))
    )


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
def test_unity_6_makes_the_same_prefab(tmp_path, prefabs, small_builds):
    build = small_builds("usdc")
    program = reader.Reader(compile_prefab_dump(tmp_path, UNITY_6))
    newer = program.ask("prefab", build.stage)
    program.close()
    older = prefabs(build.stage).found
    assert {asset["type"] for asset in newer["assets"].values()} >= {"PhysicsMaterial"}
    renamed = {name.replace("PhysicsMaterial", "PhysicMaterial"): asset for name, asset in newer["assets"].items()}
    assert renamed.keys() == older["assets"].keys()
    for one, other in zip(newer["objects"], older["objects"], strict=True):
        if "collider" in one:
            one["collider"]["material"] = one["collider"]["material"].replace("PhysicsMaterial", "PhysicMaterial")
        assert one == other


def test_colliders_of_meshes(prefabs, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.5)
    approximations = (
        "none",
        "convexHull",
        "convexDecomposition",
        "boundingCube",
        "boundingSphere",
        "meshSimplification",
    )
    material = UsdShade.Material.Define(stage, "/Rubber")
    physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    physics.CreateStaticFrictionAttr(0.9)
    physics.CreateDynamicFrictionAttr(0.8)
    physics.CreateRestitutionAttr(0.3)
    points = np.array([(0, 0, 0), (4, 0, 0), (4, 2, 0), (0, 2, 1)], dtype=np.float32)
    for name in approximations:
        mesh = UsdGeom.Mesh.Define(stage, f"/{name}")
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
        mesh.CreateFaceVertexCountsAttr([4])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
        UsdPhysics.CollisionAPI.Apply(mesh.GetPrim()).CreateCollisionEnabledAttr(name != "convexHull")
        UsdPhysics.MeshCollisionAPI.Apply(mesh.GetPrim()).CreateApproximationAttr(name)
        binding = UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim())
        binding.Bind(material, UsdShade.Tokens.weakerThanDescendants, "physics")
    guide = UsdGeom.Mesh.Get(stage, "/none")
    guide.CreatePurposeAttr("guide")
    mirrored = UsdGeom.Xformable(stage.GetPrimAtPath("/meshSimplification"))
    mirrored.AddScaleOp().Set((-1, 1, 1))
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    found = {name: prefab.named(name)["collider"] for name in approximations}
    assert [found[name]["type"] for name in approximations] == [
        "MeshCollider",
        "MeshCollider",
        "MeshCollider",
        "BoxCollider",
        "SphereCollider",
        "MeshCollider",
    ]
    assert [found[name].get("convex") for name in approximations] == [False, True, True, None, None, False]
    assert [found[name]["enabled"] for name in approximations] == [True, False, True, True, True, True]
    assert found["boundingCube"]["size"] == [2, 1, 0.5]
    assert found["boundingCube"]["center"] == [1, 0.5, -0.25]
    sphere = found["boundingSphere"]
    turned = points * [0.5, 0.5, -0.5]
    assert sphere["radius"] == pytest.approx(np.linalg.norm(turned - sphere["center"], axis=1).max())
    friction = prefab.assets[found["none"]["material"]]
    assert (friction["name"], friction["friction"]) == ("Rubber", pytest.approx([0.9, 0.8, 0.3]))
    # guides collide but do not show
    assert "mesh" not in prefab.named("none")
    text = "\n".join(prefab.found["warnings"])
    for words in ("convex decompositions", "not simplified", "mirrored"):
        assert words in text
    boxes = prefabs(tmp_path / "stage.usda", colliders="Boxes")
    assert {boxes.named(name)["collider"]["type"] for name in approximations} == {"BoxCollider"}
    assert not [item for item in prefabs(tmp_path / "stage.usda", colliders="None").objects if "collider" in item]


@pytest.mark.parametrize("outer", [(1, 1, 1), (1, 2, 1)])
def test_round_colliders_under_scale_that_differs_by_axis_are_convex_meshes(prefabs, tmp_path, outer):
    """Unity keeps balls and capsules round, whatever their scale; those that are scaled evenly stay what they are."""
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.Xform.Define(stage, "/World").AddScaleOp().Set(outer)
    scales = {"Even": (2, 2, 2), "Mirrored": (2, -2, 2), "Tall": (1, 2, 3)}
    for (kind, define), (name, scale) in itertools.product(
        (("Ball", UsdGeom.Sphere), ("Pill", UsdGeom.Capsule), ("Box", UsdGeom.Cube)), scales.items()
    ):
        shape = define.Define(stage, f"/World/{kind}{name}")
        UsdGeom.XformCommonAPI(shape).SetScale(scale)
        UsdPhysics.CollisionAPI.Apply(shape.GetPrim())
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    for name in scales:
        is_round = name != "Tall" and outer == (1, 1, 1)
        for kind, usual in (("Ball", "SphereCollider"), ("Pill", "CapsuleCollider")):
            found = prefab.named(f"{kind}{name}")["collider"]
            assert found["type"] == (usual if is_round else "MeshCollider"), (kind, name)
            assert is_round or found["convex"]
        assert prefab.named(f"Box{name}")["collider"]["type"] == "BoxCollider"
    assert not [text for text in prefab.found["warnings"] if "stay round" in text]


def test_copies_with_round_colliders_under_uneven_scale_are_named(prefabs, tmp_path):
    """What instances share cannot be another collider in one of them."""
    (tmp_path / "stage.usda").write_text(
        """#usda 1.0
(
    metersPerUnit = 1
)
class "Thing" { def Sphere "Ball" ( prepend apiSchemas = ["PhysicsCollisionAPI"] ) { }
}
def Xform "A" ( instanceable = true
    inherits = </Thing>
) { }
def Xform "B" ( instanceable = true
    inherits = </Thing>
) { float3 xformOp:scale = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:scale"]
}
""".replace(" }", "\n}")
    )
    found = prefabs(tmp_path / "stage.usda").found
    (warning,) = [text for text in found["warnings"] if "round colliders" in text]
    assert "/B" in warning


@pytest.mark.parametrize("country", ["de_DE", "tr_TR"])
def test_names_of_assets_and_warnings_are_the_same_in_all_countries(prefab_dump, tmp_path, monkeypatch, country):
    stage = Usd.Stage.CreateNew(str(tmp_path / "INITIAL.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.5)
    material = UsdShade.Material.Define(stage, "/Rubber")
    UsdPhysics.MaterialAPI.Apply(material.GetPrim()).CreateStaticFrictionAttr(0.25)
    cube = UsdGeom.Cube.Define(stage, "/Cube")
    cube.CreateDisplayColorAttr([(0.5, 0.25, 0.125)])
    UsdPhysics.CollisionAPI.Apply(cube.GetPrim())
    UsdShade.MaterialBindingAPI.Apply(cube.GetPrim()).Bind(material, UsdShade.Tokens.weakerThanDescendants, "physics")
    stage.GetRootLayer().subLayerPaths = ["slow.usda"]
    slow = stage.GetRootLayer().CreateNew(str(tmp_path / "slow.usda"))
    slow.timeCodesPerSecond = -1.5
    slow.Save()
    stage.Save()
    wanted = prefab_dump.ask("prefab", tmp_path / "INITIAL.usda")
    assert any("-1.5" in text for text in wanted["warnings"])
    assert any("0.25" in str(asset.get("friction")) for asset in wanted["assets"].values())
    monkeypatch.setenv("LANG", f"{country}.UTF-8")
    monkeypatch.setenv("LC_ALL", f"{country}.UTF-8")
    abroad = reader.Reader(prefab_dump.program)
    assert abroad.ask("prefab", tmp_path / "INITIAL.usda") == wanted
    abroad.close()


SHAPES = {
    "Cube": (UsdGeom.Cube, {"size": 3.0}, 27),
    "Sphere": (UsdGeom.Sphere, {"radius": 2.0}, 4 / 3 * math.pi * 8),
    "Cylinder": (UsdGeom.Cylinder, {"radius": 1.5, "height": 4.0}, math.pi * 2.25 * 4),
    "Capsule": (UsdGeom.Capsule, {"radius": 0.5, "height": 2.0}, math.pi * 0.25 * 2 + 4 / 3 * math.pi * 0.125),
    "Cone": (UsdGeom.Cone, {"radius": 1.0, "height": 3.0}, math.pi),
}


@pytest.mark.parametrize("up", ["Y", "Z"])
@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_shapes(prefabs, tmp_path, axis, up):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, 0.1)
    for name, (kind, attributes, _) in SHAPES.items():
        prim = kind.Define(stage, f"/{name}").GetPrim()
        for key, value in attributes.items():
            prim.GetAttribute(key).Set(value)
        if prim.HasAttribute("axis"):
            prim.GetAttribute("axis").Set(axis)
        UsdPhysics.CollisionAPI.Apply(prim)
    UsdGeom.Plane.Define(stage, "/Plane").CreateAxisAttr(axis)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    unity_axis = {"X": 0, "Y": 1 if up == "Y" else 2, "Z": 2 if up == "Y" else 1}[axis]
    for name, (kind, _, volume) in SHAPES.items():
        item = prefab.named(name)
        mesh = prefab.assets[item["mesh"]]
        points, normals = (np.array(mesh[key]).reshape(-1, 3) for key in ("vertices", "normals"))
        a, b, c = np.array(mesh["parts"][0]).reshape(-1, 3).T
        found = np.einsum("ij,ij->i", points[a], np.cross(points[b], points[c])).sum() / 6
        assert volume * 0.001 * 0.96 < found <= volume * 0.001 * 1.0001, name
        facing = np.einsum("ij,ij->i", np.cross(points[b] - points[a], points[c] - points[a]), normals[a])
        assert (facing > -1e-9).all()
        assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
        prim = kind.Get(stage, f"/{name}")
        extent = np.array(prim.ComputeExtentFromPlugins(prim, Usd.TimeCode.Default())) * 0.1
        size = (extent[1] - extent[0])[[0, 1, 2] if up == "Y" else [0, 2, 1]]
        assert mesh["size"] == pytest.approx(size, rel=0.01)
        collider = item["collider"]
        if name == "Cube":
            assert collider["size"] == pytest.approx([0.3] * 3)
        elif name == "Sphere":
            assert collider["radius"] == pytest.approx(0.2)
        elif name == "Capsule":
            assert (collider["radius"], collider["height"]) == pytest.approx((0.05, 0.3))
            assert collider["direction"] == unity_axis
        else:
            assert (collider["type"], collider["convex"]) == ("MeshCollider", True)
    normals = np.array(prefab.assets[prefab.named("Plane")["mesh"]]["normals"]).reshape(-1, 3)
    expected = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}[axis]
    assert np.allclose(
        normals, np.array(expected)[[0, 1, 2] if up == "Y" else [0, 2, 1]] * [1, 1, -1 if up == "Y" else 1]
    )


def test_large_meshes_have_32_bit_indices(prefabs, tmp_path):
    count = 70000
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usdc"))
    mesh = UsdGeom.Mesh.Define(stage, "/Large")
    angles = np.arange(count) * 0.1
    points = np.stack([np.cos(angles), np.sin(angles), np.arange(count)], axis=1).astype(np.float32)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    corners = np.stack([np.arange(count - 2), np.arange(1, count - 1), np.arange(2, count)], axis=1)
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(count - 2, 3, dtype=np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(corners.astype(np.int32).ravel()))
    stage.Save()
    (found,) = prefabs(tmp_path / "stage.usdc").of_type("Mesh").values()
    assert found["vertexCount"] == count
    assert found["has32BitIndices"]


def test_cameras_are_there_and_switched_off(prefabs, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    eye = UsdGeom.Camera.Define(stage, "/Eye")
    eye.CreateFocalLengthAttr(24)
    eye.CreateVerticalApertureAttr(20)
    eye.CreateClippingRangeAttr(Gf.Vec2f(0.25, 500))
    eye.AddTranslateOp().Set((0, 1, 2), 5)
    flat = UsdGeom.Camera.Define(stage, "/Flat")
    flat.CreateProjectionAttr("orthographic")
    flat.CreateVerticalApertureAttr(200)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    camera = prefab.named("Eye")["camera"]
    assert not camera["enabled"]
    assert camera["fieldOfView"] == pytest.approx(math.degrees(2 * math.atan(10 / 24)))
    assert (camera["near"], camera["far"]) == (0.25, 500)
    assert prefab.named("Flat")["camera"]["orthographic"]
    # a tenth of a unit each, half of them above the middle
    assert prefab.named("Flat")["camera"]["orthographicSize"] == pytest.approx(10)
    assert any("what moves" in warning for warning in prefab.found["warnings"])
    assert not [item for item in prefabs(tmp_path / "stage.usda", cameras=False).objects if "camera" in item]


def test_bad_files_are_errors_of_the_import_and_nothing_else(prefab_dump, tmp_path):
    (tmp_path / "bad.usda").write_text('#usda 1.0\ndef "A" {')
    (tmp_path / "bad.usdz").write_bytes(b"PK no zip")
    (tmp_path / "bad.usdc").write_bytes(b"PXR-USDC" + bytes(20))
    for name in ("bad.usda", "bad.usdz", "bad.usdc", "none.usda"):
        found = prefab_dump.ask("prefab", tmp_path / name)
        (error,) = found["errors"]
        assert name in error
        assert "objects" not in found
        assert found["progressBarLeft"] is False


def test_what_is_left_out_is_said_and_what_is_missing_is_waited_for(prefabs, tmp_path):
    (tmp_path / "gaps.usda").write_text("""#usda 1.0
def "A" ( references = @./parts/later.usda@ ) {}
def NurbsPatch "Patch" {}
def BasisCurves "Line" { int[] curveVertexCounts = [2]
    point3f[] points = [(0, 0, 0), (1, 0, 0)] }
def Sphere "Empty" ( prepend apiSchemas = ["PhysicsCollisionAPI"] ) {}
def Xform "Nothing" ( prepend apiSchemas = ["PhysicsCollisionAPI"] ) {}
""")
    prefab = prefabs(tmp_path / "gaps.usda")
    text = "\n".join(prefab.found["warnings"])
    for words in ("later.usda", "NurbsPatch", "curves", "/Nothing"):
        assert words in text
    # once the file comes, the stage is imported anew
    assert f"{tmp_path.name}/parts/later.usda" in prefab.found["sources"]
    assert prefab.named("Patch")


SHOT = """#usda 1.0
def Xform "Chair" ( references = @../assets/chair.usda@</Chair> ) {}
def Xform "Later" ( references = @../assets/later.usda@</Later> ) {}
def Xform "Settings" ( references = @../../ProjectSettings/one.usda@</Chair> ) {}
def Xform "Beyond" ( references = @../../../../beyond.usda@</Ball> ) {}
def Xform "Neighbour" ( references = @../../com.other/other.usda@</Ball> ) {}
def Xform "Kept" {}
"""
BALL = '#usda 1.0\ndef Sphere "Ball" {\n}\ndef "Chair" {\n def Sphere "Ball" {\n }\n}\n'


@pytest.mark.parametrize("top", ["Assets", "Packages/com.some.kit"])
def test_a_stage_refers_to_files_of_its_project_or_package(prefabs, tmp_path, top):
    project = tmp_path / "project"
    files = (f"{top}/assets/chair.usda", "ProjectSettings/one.usda", "Packages/com.other/other.usda", "../beyond.usda")
    for name in files:
        (project / name).parent.mkdir(parents=True, exist_ok=True)
        (project / name).write_text(BALL)
    stage = project / top / "shots" / "shot.usda"
    stage.parent.mkdir()
    stage.write_text(SHOT)
    (stage.parent / "shot_labels.json").write_text("{}")
    prefab = prefabs(stage)
    assert prefab.named("Kept")
    text = "\n".join(prefab.found["warnings"])
    assert "beyond.usda@ is not a relative path within the root folder" in text
    assert "later.usda@ does not exist" in text
    # the files of a project's settings may be read, but are no assets that an import waits for
    sources = {f"{top}/assets/chair.usda", f"{top}/assets/later.usda", f"{top}/shots/shot_labels.json"}
    assert set(prefab.found["sources"]) == sources
    others = {
        "Assets": (2, "other.usda@ does not exist"),
        "Packages/com.some.kit": (1, "other.usda@ is not a relative path within the root folder"),
    }
    balls, warning = others[top]
    assert len([item for item in prefab.objects if item["path"].endswith("/Ball") and "mesh" in item]) == balls
    assert warning in text


def test_players_name_a_root_folder(prefab_dump, tmp_path):
    stage = tmp_path / "shots" / "shot.usda"
    stage.parent.mkdir()
    stage.write_text('#usda 1.0\ndef Sphere "Ball" ( references = @../ball.usda@</Ball> ) {}\n')
    (tmp_path / "ball.usda").write_text('#usda 1.0\ndef "Ball" {\n def Sphere "Second" {\n }\n}\n')
    assert prefab_dump.ask("load", stage)["renderers"] == 1
    assert prefab_dump.ask("load", stage, f"root={tmp_path}")["renderers"] == 2
    failed = prefab_dump.ask("load", stage, f"root={tmp_path / 'others'}")
    assert failed["failure"] == f"UsdFormatException: {stage}: file: is not in the root folder {tmp_path / 'others'}"


def test_an_import_that_is_cancelled_leaves_nothing(prefab_dump, small_builds):
    found = prefab_dump.ask("prefab", small_builds("usdc").stage, "cancel=1")
    assert ["cancelled" in error for error in found["errors"]] == [True]
    assert "objects" not in found
    assert found["progressBarLeft"] is False


@pytest.mark.parametrize("extension", ["usdc", "usdz"])
def test_players_load_the_same_as_the_editor_imports(prefab_dump, prefabs, small_builds, extension):
    """From a file with others beside it, and from a package in memory."""
    build = small_builds(extension)
    expected = prefabs(build.stage)
    found = prefab_dump.ask("load", build.stage)
    assert found["objects"] == len(expected.objects)
    assert found["renderers"] == len([item for item in expected.objects if "mesh" in item])
    assert found["steps"] > 2
    assert found["droppedTextures"] == len(expected.of_type("Texture2D")) > 10
    assert found["last"] == 1
    # disposing of it takes all away
    assert found["left"] == 0
    for looks in (1, 2):
        stopped = prefab_dump.ask("load", build.stage, f"cancel={looks}")
        assert "Canceled" in stopped["failure"]
        assert stopped["left"] == 0


def test_players_need_a_reference_material_where_the_shader_is_not_built_in(prefab_dump, tmp_path):
    (tmp_path / "ball.usda").write_text('#usda 1.0\ndef Sphere "Ball" {}')
    failed = prefab_dump.ask("load", tmp_path / "ball.usda", "stripped=1")
    assert failed["failure"].startswith("InvalidOperationException: The shader Standard is not in this build")
    assert failed["left"] == 0
    assert prefab_dump.ask("load", tmp_path / "ball.usda", "reference=1", "stripped=1")["renderers"] == 1
    # that of another pipeline is of no use
    other = prefab_dump.ask("load", tmp_path / "ball.usda", "reference=1", "stripped=1", "pipeline=Universal")
    assert "Universal Render Pipeline/Lit" in other["failure"]


def test_the_navmesh_is_made_of_what_one_can_drive_on_and_bump_into(prefabs, small_builds):
    build = small_builds("usdc")
    prefab = prefabs(build.stage)
    classes = set(prefab.found["navMesh"]["classes"])
    assert classes >= {"floor", "parking_stall", "wall", "column", "ramp"}
    assert not classes & {"ceiling", "beam", "duct", "light", "car", "sky"}
    size = prefab.found["navMesh"]["size"]
    structure = build.garage.layout.structure
    assert size[0] > structure.column_widths_mm.sum() / 1000
    assert size[2] > structure.row_depths_mm.sum() / 1000


def test_the_inspector_shows_every_setting_once(prefabs, small_builds):
    drawn = [name for name in prefabs(small_builds("usdc").stage).found["inspector"] if name.startswith("settings.")]
    source = (reader.PACKAGE / "Runtime" / "ImportSettings.cs").read_text()
    fields = [
        line.split("=")[0].rstrip(" ;").split()[-1] for line in source.splitlines() if "public " in line and ";" in line
    ]
    assert sorted(drawn) == sorted(f"settings.{field}" for field in fields)
    assert len(list(itertools.groupby(sorted(drawn)))) == len(drawn) > 10
