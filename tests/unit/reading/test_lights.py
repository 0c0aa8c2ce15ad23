"""Lights shine as UsdLux says: its formulas by numbers, and a sum over the surface for what has an area."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdLux
from support.glb_reader import Glb

from garage2usd.maps.glb import write_glb
from garage2usd.reading.files import open_stage
from garage2usd.reading.lights import light_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.view.viewer import read_scene

HEAD = '#usda 1.0\n(\ndefaultPrim = "W"\nmetersPerUnit = {metres}\nupAxis = "Y"\n)\ndef Xform "W"\n{{\n{prims}\n}}\n'
FORMS = {
    "Rect": ("float inputs:width = 2\n float inputs:height = 0.5", 1.0),
    "Disk": ("float inputs:radius = 0.5", np.pi / 4),
    "Sphere": ("float inputs:radius = 0.5", np.pi / 4),
    "Cylinder": ("float inputs:radius = 0.25\n float inputs:length = 2", 1.0),
}
"""What a light says of its size, and the area that is seen of it from ahead."""
AREAS = {"Rect": 1.0, "Disk": np.pi / 4, "Sphere": np.pi, "Cylinder": np.pi}


def stage_of(kind, said, *, metres=1, place=""):
    stage = Usd.Stage.CreateInMemory()
    text = f'def {kind}Light "L"\n{{\n{said}\n{place}\n}}'
    assert stage.GetRootLayer().ImportFromString(HEAD.format(metres=metres, prims=text))
    return stage


def read(stage):
    prim, metres = stage.GetPrimAtPath("/W/L"), UsdGeom.GetStageMetersPerUnit(stage)
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0)) @ np.diag([metres, metres, metres, 1])
    return light_of(prim, matrix, metres)


@pytest.mark.parametrize("kind", FORMS)
def test_candela_are_luminance_times_what_is_seen(kind):
    size, seen = FORMS[kind]
    stage = stage_of(kind, f"float inputs:intensity = 3\n float inputs:exposure = 2\n {size}")
    light = read(stage)
    assert (light.luminance_nit, light.candela) == (pytest.approx(12), pytest.approx(12 * seen, rel=1e-5))


@pytest.mark.parametrize("kind", FORMS)
def test_a_normalized_light_is_divided_by_its_area(kind):
    size, seen = FORMS[kind]
    stage = stage_of(kind, f"float inputs:intensity = 100\n bool inputs:normalize = 1\n {size}")
    assert read(stage).candela == pytest.approx(100 * seen / AREAS[kind], rel=1e-4)


@pytest.mark.parametrize(("kind", "candela"), [("Rect", 100), ("Disk", 100), ("Sphere", 25), ("Cylinder", 100 / np.pi)])
def test_a_normalized_light_without_a_size_is_the_limit_of_small_ones(kind, candela):
    sizes = {"Rect": "width height", "Disk": "radius", "Sphere": "radius", "Cylinder": "radius length"}[kind].split()
    for size in ("0", "1e-4"):
        said = "\n".join(f"float inputs:{name} = {size}" for name in sizes)
        stage = stage_of(kind, f"float inputs:intensity = 100\n bool inputs:normalize = 1\n {said}")
        assert read(stage).candela == pytest.approx(candela, rel=1e-3)


def test_scales_and_units_count():
    scaled = 'float3 xformOp:scale = (3, 2, 7)\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    size, _ = FORMS["Rect"]
    stage = stage_of("Rect", f"float inputs:intensity = 10\n {size}", place=scaled)
    assert read(stage).candela == pytest.approx(60)
    stage = stage_of("Rect", f"float inputs:intensity = 1e6\n {size}", metres=0.01)
    assert read(stage).candela == pytest.approx(100)
    # a normalized light is divided by its area in units of the stage
    normalized = f"float inputs:intensity = 1e6\n bool inputs:normalize = 1\n {size}"
    stage = stage_of("Rect", normalized, metres=0.01)
    assert read(stage).candela == pytest.approx(100)


@pytest.mark.parametrize(
    ("said", "lux"),
    [
        ("float inputs:intensity = 3\n float inputs:angle = 0\n bool inputs:normalize = 1", 3),
        ("float inputs:intensity = 3\n float inputs:angle = 0", 3),
        ("float inputs:intensity = 3\n float inputs:angle = 40\n bool inputs:normalize = 1", 3),
        ("float inputs:intensity = 3\n float inputs:angle = 40", 3 * np.pi * np.sin(np.radians(20)) ** 2),
        ("float inputs:intensity = 3\n float inputs:angle = 180", 3 * np.pi),
        ("float inputs:intensity = 3\n float inputs:exposure = -1\n bool inputs:normalize = 1", 1.5),
        ("bool inputs:normalize = 1", 50000),
    ],
)
def test_suns_have_lux(said, lux):
    stage = stage_of("Distant", said)
    assert read(stage).lux == pytest.approx(lux, rel=1e-6)


def test_a_temperature_is_a_colour():
    said = "color3f inputs:color = (1, 0.5, 1)\n float inputs:colorTemperature = 3000"
    stage = stage_of("Sphere", f"{said}\n bool inputs:enableColorTemperature = 1")
    heat = np.array(UsdLux.BlackbodyTemperatureAsRgb(3000))
    assert read(stage).colour_rgb == pytest.approx(heat * (1, 0.5, 1))
    stage = stage_of("Sphere", said)
    assert read(stage).colour_rgb == (1, 0.5, 1)


BULBS = """
def DistantLight "Sun" {
    float inputs:intensity = 3
    float inputs:angle = 0
    bool inputs:normalize = 1
}
def SphereLight "Bulb" {
    float inputs:intensity = 100
    float inputs:radius = 0
    bool inputs:normalize = 1
    bool treatAsPoint = 1
    color3f inputs:color = (2, 1, 0)
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DiskLight "Spot" (prepend apiSchemas = ["ShapingAPI"]) {
    float inputs:intensity = 100
    float inputs:radius = 0
    bool inputs:normalize = 1
    float inputs:shaping:cone:angle = 30
    float inputs:shaping:cone:softness = 0.25
    float xformOp:rotateX = -90
    float3 xformOp:scale = (2, 3, 4)
    uniform token[] xformOpOrder = ["xformOp:rotateX", "xformOp:scale"]
}
"""


def written(tmp_path, prims):
    (tmp_path / "lights.usda").write_text(HEAD.format(metres=1, prims=prims))
    stage, remarks = Usd.Stage.Open(str(tmp_path / "lights.usda")), Remarks()
    write_glb(stage, tmp_path / "lights.glb", remarks=remarks)
    glb = Glb((tmp_path / "lights.glb").read_bytes())
    lights = {}
    for number, node in enumerate(glb.nodes):
        if "KHR_lights_punctual" in node.get("extensions", {}):
            light = node["extensions"]["KHR_lights_punctual"]["light"]
            lights[node["name"]] = glb.json["extensions"]["KHR_lights_punctual"]["lights"][light], glb.matrix(number)
    return lights, remarks.lines()


def test_a_glb_has_points_spots_and_suns(tmp_path):
    lights, remarks = written(tmp_path, BULBS)
    assert remarks == []
    sun, bulb, spot = (lights[f"/W/{name}"] for name in ("Sun", "Bulb", "Spot"))
    assert sun[0] == {"type": "directional", "intensity": 3.0}
    assert bulb[0] == {"type": "point", "intensity": 50.0, "color": [1.0, 0.5, 0.0]}
    assert bulb[1][:3, 3].tolist() == [1, 2, 3]
    assert (spot[0]["type"], spot[0]["intensity"]) == ("spot", 100.0)
    assert spot[0]["spot"]["outerConeAngle"] == pytest.approx(np.radians(30))
    assert spot[0]["spot"]["innerConeAngle"] == pytest.approx(np.radians(22.5))
    assert spot[1][:3, :3] @ (0, 0, -1) == pytest.approx([0, -1, 0], abs=1e-6)
    assert np.linalg.det(spot[1][:3, :3]) == pytest.approx(1, abs=1e-5)


def test_lights_that_gltf_does_not_have_are_named(tmp_path):
    prims = """
def DomeLight "Sky" { }
def CylinderLight "Tube" { }
def RectLight "Panel" { }
def SphereLight "Dark" { float inputs:radius = 0 }
def Cube "Box" { }
"""
    prims = prims.replace("{ }", "{\n}").replace("{ float inputs:radius = 0 }", "{\nfloat inputs:radius = 0\n}")
    lights, remarks = written(tmp_path, prims)
    assert set(lights) == {"/W/Tube", "/W/Panel"}
    assert remarks == [
        "lights of the type DomeLight are left out (1): /W/Sky",
        "cylinder lights shine as points, as strongly as across their axes (1): /W/Tube",
        "flat lights shine as spots, as strongly as straight ahead (1): /W/Panel",
        "lights without a size shine nothing unless they are normalized (1): /W/Dark",
    ]


UNSAID = {
    "asset inputs:texture:file = @a.png@": "pictures on lights are left out",
    "float inputs:diffuse = 0": "shares of diffuse and specular light are left out",
    "float inputs:specular = 0.5": "shares of diffuse and specular light are left out",
    "bool inputs:shadow:enable = 0": "lights that cast no shadows shine as others do",
    "rel collection:lightLink:includes = </W>": "lights that are linked to some prims shine on all",
    "rel collection:shadowLink:excludes = </W>": "lights that are linked to some prims shine on all",
    "rel light:filters = </W>": "filters of lights are left out",
    "float inputs:shaping:focus = 2": "the focus of lights is left out",
}


@pytest.mark.parametrize("said", UNSAID)
def test_what_gltf_cannot_say_of_a_light_is_named(said, tmp_path):
    schemas = '(prepend apiSchemas = ["ShapingAPI", "ShadowAPI"])'
    _, remarks = written(tmp_path, f'def RectLight "L" {schemas} {{\n{said}\n}}\n')
    flat = "flat lights shine as spots, as strongly as straight ahead (1): /W/L"
    assert remarks == [f"{UNSAID[said]} (1): /W/L", flat]


def test_a_cone_without_an_angle_is_no_light(tmp_path):
    cone = 'def SphereLight "L" (prepend apiSchemas = ["ShapingAPI"]) {\nfloat inputs:shaping:cone:angle = 0\n}\n'
    lights, remarks = written(tmp_path, f'{cone}def Cube "Box" {{\n}}\n')
    assert lights == {}
    assert remarks == ["lights in a cone without an angle shine nothing (1): /W/L"]


def test_the_viewer_gets_the_same_candela(tmp_path):
    (tmp_path / "lights.usda").write_text(HEAD.format(metres=1, prims=BULBS))
    scene = read_scene(open_stage(tmp_path / "lights.usda"), tmp_path / "lights.usda")
    candela = {light.kind: light.candela for shape in scene.shapes for light in shape.lights}
    assert candela == {"DistantLight": 0, "SphereLight": pytest.approx(25), "DiskLight": pytest.approx(100)}
    assert scene.remarks == ["lights of the type DistantLight are not shown (1): /W/Sun"]
