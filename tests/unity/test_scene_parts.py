"""What a scene says of cameras, shapes, curves, lights and colliders, and how Unity's axes and units see it."""

import itertools
import math

import numpy as np
import pytest
from pxr import Gf, Sdf
from support.unity.agreement import STAGES, scene_of

HEAD = "#usda 1.0\n"


@pytest.fixture
def nodes(usd_dump):
    return scene_of(usd_dump, STAGES / "scene.usda")["nodes"]


def written(folder, text: str):
    path = folder / "scene.usda"
    path.write_text(HEAD + text)
    return path


@pytest.mark.parametrize("axis", ["Y", "Z"])
@pytest.mark.parametrize("metres", [1, 0.01])
def test_axes_and_units_of_unity(usd_dump, tmp_path, axis, metres):
    """Against B M B^-1 of the basis B, whose determinant is -1."""
    path = written(tmp_path, f'(\n metersPerUnit = {metres}\n upAxis = "{axis}"\n)\n')
    basis = np.array([[1, 0, 0], [0, 0, 1], [0, 1, 0]]) if axis == "Z" else np.diag([1, 1, -1])
    assert np.linalg.det(basis) == pytest.approx(-1)
    for quaternion in ((0.5, 0.5, -0.5, 0.5), (0.1, -0.7, 0.1, 0.7), (1, 0, 0, 0)):
        w, *vector = (number / math.hypot(*quaternion) for number in quaternion)
        found = usd_dump.ask("basis", path, w, *vector)
        turn = np.array(Gf.Matrix3d(Gf.Quatd(w, *vector))).T
        wanted = basis @ turn @ basis
        assert np.allclose(found["direction"], basis @ vector)
        assert np.allclose(found["point"], metres * basis @ vector)
        assert np.allclose(np.array(Gf.Matrix3d(Gf.Quatd(*found["rotation"]))).T, wanted)
        assert np.allclose(np.array(found["matrix"]).reshape(4, 4)[:3, :3].T, wanted)
        assert np.allclose(found["matrix"][12:], [*(metres * basis @ vector), 1])


def test_axes_and_units_that_a_stage_does_not_give(usd_dump, tmp_path):
    found = usd_dump.ask("basis", written(tmp_path, ""), 1, 1, 2, 3)
    assert found["direction"] == [1, 2, -3]
    assert found["point"] == pytest.approx([0.01, 0.02, -0.03])


def test_camera(nodes, usd_dump, tmp_path):
    assert nodes["/World/Camera"]["camera"] == {
        "fieldOfView": pytest.approx(2 * math.degrees(math.atan(15.2908 / 2 / 35))),
        "horizontalAperture": pytest.approx(20.955),
        "near": 10,
        "far": 5000,
        "isOrthographic": False,
    }
    path = written(tmp_path, 'def Camera "C" {\n token projection = "orthographic"\n float verticalAperture = 24\n}\n')
    flat = scene_of(usd_dump, path)["nodes"]["/C"]["camera"]
    assert flat["isOrthographic"]
    assert flat["fieldOfView"] == pytest.approx(2 * math.degrees(math.atan(24 / 2 / 50)))


def test_curves(nodes):
    assert nodes["/World/Lanes"]["purpose"] == "guide"
    assert nodes["/World/Lanes"]["curves"] == {
        "type": "linear",
        "wrap": "nonperiodic",
        "counts": [2, 3],
        "points": [0, 0, 0, 10, 0, 0, 0, 5, 0, 5, 5, 0, 5, 9, 0],
        "widths": [pytest.approx(0.1)],
    }


@pytest.mark.parametrize("counts", ["[2, 2]", "[2, -1, 3]", "[5]"])
def test_curves_whose_counts_are_wrong_are_left_out(usd_dump, tmp_path, counts):
    points = "point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0)]"
    path = written(tmp_path, f'def BasisCurves "C" {{\n int[] curveVertexCounts = {counts}\n {points}\n}}\n')
    assert "curves" not in scene_of(usd_dump, path)["nodes"]["/C"]


def test_shapes(nodes, usd_dump, tmp_path):
    sphere, cube = nodes["/World/Trees/Oak"]["shape"], nodes["/World/Trees/Box"]["shape"]
    assert (sphere["kind"], sphere["radius"]) == ("Sphere", 2)
    assert (cube["kind"], cube["size"]) == ("Cube", 3)
    texts = {
        "Capsule": ("", {"radius": 0.5, "height": 1, "axis": "Z"}),
        "Cylinder": ("double height = 7\n token axis = 'X'", {"radius": 1, "height": 7, "axis": "X"}),
        "Cone": ("double radius = 3\n token axis = 'Y'", {"radius": 3, "height": 2, "axis": "Y"}),
        "Plane": ("double width = 4", {"width": 4, "length": 2}),
        "Cube": ("", {"size": 2}),
        "Sphere": ("", {"radius": 1}),
    }
    text = "".join(f'def {kind} "{kind}" {{\n {body}\n}}\n' for kind, (body, _) in texts.items())
    found = scene_of(usd_dump, written(tmp_path, text))["nodes"]
    for kind, (_, wanted) in texts.items():
        assert found[f"/{kind}"]["shape"].items() >= wanted.items(), kind


CUBE = """
def Mesh "Cube" {
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
    SCHEME
}
"""


@pytest.mark.parametrize("scheme", ["none", "catmullClark", None])
def test_normals_that_a_mesh_does_not_give(usd_dump, tmp_path, scheme):
    """Those of the faces; between them where the mesh stands for a smooth surface, as it does by default."""
    text = CUBE.replace("SCHEME", "" if scheme is None else f'uniform token subdivisionScheme = "{scheme}"')
    mesh = scene_of(usd_dump, written(tmp_path, text))["nodes"]["/Cube"]["mesh"]
    points = np.array(list(itertools.product((0, 1), repeat=3)))[[0, 4, 6, 2, 1, 5, 7, 3]]
    corners = points[np.array(mesh["corners"]).reshape(-1, 3)]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    smooth = (corners - 0.5) / math.sqrt(0.75)
    wanted = np.repeat(flat[:, np.newaxis], 3, axis=1) if scheme == "none" else smooth
    assert np.allclose(np.array(mesh["normals"]).reshape(-1, 3, 3), wanted, atol=1e-6)
    assert mesh["vertices"] == (24 if scheme == "none" else 8)


def test_mesh_with_colors_subsets_and_a_collider(nodes):
    node = nodes["/World/Mesh"]
    mesh = node["mesh"]
    assert mesh["parts"] == [3, 3]
    assert mesh["materials"] == ["", "/World/Looks/Glass"]
    assert np.array(mesh["colors"]).reshape(-1, 3).tolist() == [[1, 0.5, 0]] * 18
    faces = [[0, 0, -1]] * 9 + [[0, 1, 0]] * 6 + [[-1, 0, 0]] * 3
    assert np.array(mesh["normals"]).reshape(-1, 3).tolist() == faces
    assert not mesh["isDoubleSided"]
    assert node["material"] == "/World/Looks/Paint"
    assert node["collider"] == "convexHull"
    assert [node[key] for key in ("friction", "slidingFriction", "restitution", "density")] == pytest.approx(
        [0.9, 0.8, 0.1, 0]
    )
    assert node["labels"] == {"class": ["wall", "obstacle"]}


def test_a_point_instancer_shows_what_is_not_hidden(nodes):
    node = nodes["/World/Trees"]
    assert node["prototypes"] == ["/World/Trees/Oak", "/World/Trees/Box"]
    assert node["numbers"] == [0, 2]
    assert node["prototypeOf"] == [0, 0]
    half_turn = [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.5, 0], [0, 100, 0, 1]]
    assert np.allclose(np.array(node["instances"]).reshape(-1, 4, 4), [np.eye(4), half_turn])


def test_light_and_its_shaping(nodes, usd_dump, tmp_path):
    lamp = nodes["/World/Lamp"]["light"]
    assert lamp["kind"] == "Rect"
    assert lamp["color"] == pytest.approx([1, 0.9, 0.8])
    # 500 * 2^2 over 0.2 m x 1.2 m
    assert (lamp["luminance"], lamp["candela"]) == pytest.approx((2000 / 0.24, 2000))
    assert (lamp["cone"], lamp["softness"], lamp["temperature"]) == (90, 0, 0)
    text = """
def SphereLight "Spot" {
    float inputs:shaping:cone:angle = 30
    float inputs:shaping:cone:softness = 0.5
    bool inputs:enableColorTemperature = true
    float inputs:colorTemperature = 4000
}
def SphereLight "Untold" {
    bool inputs:enableColorTemperature = true
}
def DomeLight "Sky" {
    float inputs:intensity = 3
}
"""
    found = scene_of(usd_dump, written(tmp_path, text))["nodes"]
    spot, sky = found["/Spot"]["light"], found["/Sky"]["light"]
    assert (spot["cone"], spot["softness"], spot["temperature"]) == (30, 0.5, 4000)
    assert found["/Untold"]["light"]["temperature"] == 6500
    assert (sky["kind"], sky["luminance"], sky["candela"], sky["lumen"], sky["lux"]) == ("Dome", 3, 0, 0, 0)


def test_visibility_and_disabled_colliders(usd_dump, tmp_path):
    text = """
def Mesh "Hidden" (
    prepend apiSchemas = ["PhysicsCollisionAPI"]
) {
    token visibility = "invisible"
    bool physics:collisionEnabled = false
    bool doubleSided = true
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
}
def Cube "Shown" (
    prepend apiSchemas = ["PhysicsCollisionAPI"]
) {}
def Cube "Free" {}
class Cube "Class" {}
over "Over" {}
"""
    found = scene_of(usd_dump, written(tmp_path, text))["nodes"]
    assert found["/Hidden"]["visibility"] == "invisible"
    assert found["/Hidden"]["collider"] == "disabled"
    assert found["/Hidden"]["mesh"]["isDoubleSided"]
    assert found["/Shown"]["collider"] == "none"
    assert "collider" not in found["/Free"]
    assert set(found) == {"/Hidden", "/Shown", "/Free"}


def test_textures_and_constants_of_a_material(usd_dump):
    scene = scene_of(usd_dump, STAGES / "scene.usda")
    paint, glass = scene["materials"]["/World/Looks/Paint"], scene["materials"]["/World/Looks/Glass"]
    texture = paint["diffuseColor"]
    assert (texture["asset"], texture["channel"], texture["wrapS"], texture["coordinates"]) == (
        "textures/paint.png",
        "rgb",
        "mirror",
        "st",
    )
    assert texture["transform"] == [[1, 1], 90, [0, 0]]
    assert paint["roughness"]["value"] == [0.25]
    assert glass["opacity"]["value"] == pytest.approx([0.3])
    assert any("textures/paint.png" in warning and "does not exist" in warning for warning in scene["warnings"])


def test_meshes_that_share_arrays_but_differ_otherwise_stay_apart(usd_dump, tmp_path):
    """A crate has equal arrays once, a text has not; a mesh of its own for each must come of both."""
    shared = {
        "orientation": ("uniform token", '"rightHanded"'),
        "doubleSided": ("uniform bool", "0"),
        "subdivisionScheme": ("uniform token", '"catmullClark"'),
        "holeIndices": ("int[]", "[]"),
        "primvars:displayColor": ("color3f[]", '[(1, 0, 0), (0, 1, 0)] (\n interpolation = "uniform"\n )'),
    }
    differences = {
        "Plain": {},
        "LeftHanded": {"orientation": '"leftHanded"'},
        "DoubleSided": {"doubleSided": "1"},
        "Flat": {"subdivisionScheme": '"none"'},
        "OneHole": {"holeIndices": "[1]"},
        "OneColor": {"primvars:displayColor": '[(1, 0, 0), (0, 1, 0)] (\n interpolation = "constant"\n )'},
    }
    text = "".join(
        f"""def Mesh "{name}" {{
 point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 3), (0, 1, 0)]
 int[] faceVertexCounts = [3, 3]
 int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
"""
        + "".join(f" {kind} {key} = {own.get(key, value)}\n" for key, (kind, value) in shared.items())
        + "}\n"
        for name, own in differences.items()
    )
    path = written(tmp_path, text)
    Sdf.Layer.FindOrOpen(str(path)).Export(str(path.with_suffix(".usdc")))
    wanted, found = (scene_of(usd_dump, path.with_suffix(ending))["nodes"] for ending in (".usda", ".usdc"))
    assert found == wanted
    assert len({str(found[f"/{name}"]["mesh"]) for name in differences}) == len(differences)
