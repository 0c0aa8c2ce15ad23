"""Lights by the formulas of UsdLux, in the three pipelines and the three modes."""

import math

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdLux

PIPELINES = ("BuiltIn", "Universal", "HighDefinition")
METRES = 0.1
LAMPS = {
    "Rect": (UsdLux.RectLight, {"intensity": 80, "exposure": 1, "width": 20, "height": 5}),
    "Even": (UsdLux.RectLight, {"intensity": 80, "width": 20, "height": 5, "normalize": True}),
    "Disk": (UsdLux.DiskLight, {"intensity": 30, "radius": 4}),
    "Ball": (UsdLux.SphereLight, {"intensity": 500, "radius": 1, "exposure": -2}),
    "Tube": (UsdLux.CylinderLight, {"intensity": 70, "radius": 0.3, "length": 12}),
    "Sun": (UsdLux.DistantLight, {"intensity": 40000, "angle": 0.6}),
    "Moon": (UsdLux.DistantLight, {"intensity": 3, "angle": 0.5, "normalize": True}),
}
# luminance, candela and lux by hand
SQUARE = METRES**2
RECT_AREA, DISK_AREA = 100 * SQUARE, math.pi * 16 * SQUARE
EXPECTED = {
    "Rect": (160, 160 * RECT_AREA, 0),
    "Even": (80 / RECT_AREA, 80, 0),
    "Disk": (30, 30 * DISK_AREA, 0),
    "Ball": (125, 125 * math.pi * SQUARE, 0),
    "Tube": (70, 2 * 70 * 0.3 * 12 * SQUARE, 0),
    "Sun": (40000, 0, 40000 * math.pi * math.sin(math.radians(0.3)) ** 2),
    "Moon": (3 / (math.pi * math.sin(math.radians(0.25)) ** 2), 0, 3),
}


@pytest.fixture
def lamps(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageUpAxis(stage, "Z")
    UsdGeom.SetStageMetersPerUnit(stage, METRES)
    for name, (kind, inputs) in LAMPS.items():
        prim = kind.Define(stage, f"/{name}").GetPrim()
        for key, value in inputs.items():
            prim.GetAttribute(f"inputs:{key}").Set(value)
    stage.Save()
    return tmp_path / "stage.usda"


@pytest.mark.parametrize("stops", [0, -1.5])
@pytest.mark.parametrize("pipeline", PIPELINES)
def test_strengths(prefabs, lamps, pipeline, stops):
    prefab = prefabs(lamps, pipeline=pipeline, exposureStops=stops, nitsPerUnit=27)
    # shaders of the others leave out the 1 / pi of a white surface
    factor = 2**stops * (27 if pipeline == "HighDefinition" else 1 / math.pi)
    for name, (luminance, candela, lux) in EXPECTED.items():
        item = prefab.named(name)
        given, light = item["usdLight"], item["light"]
        assert given["luminance"] == pytest.approx(luminance, rel=1e-5)
        assert given["candela"] == pytest.approx(candela, rel=1e-5)
        assert given["lux"] == pytest.approx(lux, rel=1e-5)
        area = {"Rect": RECT_AREA, "Even": RECT_AREA, "Disk": DISK_AREA, "Ball": 4 * math.pi * SQUARE}.get(name)
        if area is not None:
            assert given["lumen"] == pytest.approx(math.pi * luminance * area, rel=1e-5)
        expected = (lux or candela) * factor
        assert light["intensity"] == pytest.approx(expected, rel=1e-5)
        kinds = {"Rect": "Spot", "Even": "Spot", "Disk": "Spot", "Sun": "Directional", "Moon": "Directional"}
        assert light["type"] == kinds.get(name, "Point")
        assert light["shadows"] == "None"
        if not lux:
            # where it brings a twentieth of white
            reach = math.sqrt(candela / math.pi * 2**stops / 0.05)
            assert light["range"] == pytest.approx(min(max(reach, 1), 100), rel=1e-5)


def test_spots_for_panels_have_their_strength_ahead_and_all_their_lumens(prefabs, lamps):
    light = prefabs(lamps).named("Rect")["light"]
    outer, inner = (math.cos(math.radians(light[key] / 2)) for key in ("spotAngle", "innerSpotAngle"))
    cosines = (np.arange(200000) + 0.5) / 200000
    fading = np.clip((cosines - outer) / (inner - outer), 0, 1) ** 2
    # of a panel: pi lumens a candela; over the half-space the solid angle is 2 pi times the cosine
    assert 2 * math.pi * fading.mean() == pytest.approx(math.pi, rel=1e-3)
    assert fading[-1] == 1


def test_baked_rectangles(prefabs, lamps):
    prefab = prefabs(lamps, lightMode="BakedRectangle", lightShadows=True)
    for name, kind, area in (("Rect", "Rectangle", [2, 0.5]), ("Disk", "Disc", [0.4, 0])):
        light = prefab.named(name)["light"]
        assert (light["type"], light["baked"]) == (kind, "Baked")
        assert light["area"] == pytest.approx(area)
        assert light["intensity"] == pytest.approx(EXPECTED[name][0] / math.pi, rel=1e-5)
        assert light["shadows"] == "Soft"
    assert prefab.named("Ball")["light"]["type"] == "Point"
    assert not [item for item in prefab.objects if item["path"].endswith("/Glow")]
    for mesh in prefab.of_type("Mesh").values():
        assert mesh["lightmapCoordinates"] == mesh["vertexCount"]


def test_emissive_only(prefabs, lamps):
    prefab = prefabs(lamps, lightMode="EmissiveOnly")
    assert {item["path"] for item in prefab.objects if "light" in item} == {"stage/Sun", "stage/Moon"}
    assert len([item for item in prefab.objects if "usdLight" in item]) == len(LAMPS)
    glows = {
        item["path"]: prefab.assets[item["materials"][0]] for item in prefab.objects if item["path"].endswith("Glow")
    }
    assert glows.keys() == {"stage/Rect/Glow", "stage/Even/Glow", "stage/Disk/Glow"}
    for path, material in glows.items():
        luminance = EXPECTED[path.split("/")[1]][0]
        assert material["colors"]["_EmissionColor"] == pytest.approx([luminance] * 3 + [1], rel=1e-5)
        assert material["colors"]["_Color"] == [0, 0, 0, 1]


@pytest.mark.parametrize("linear_intensity", [True, False])
def test_colors(prefabs, tmp_path, linear_intensity):
    """What reaches a shader is the light's own color times its strength, however Unity counts."""
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    light = UsdLux.SphereLight.Define(stage, "/Lamp")
    light.CreateColorAttr((2, 0.5, 0.1))
    light.CreateIntensityAttr(3)
    stage.Save()
    settings = {} if linear_intensity else {"curved": 1}
    found = prefabs(tmp_path / "stage.usda", **settings).named("Lamp")["light"]
    color, intensity = np.array(found["color"]), found["intensity"]
    assert color.max() == pytest.approx(1)

    def linear(value):
        return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)

    shown = linear(color) * intensity if linear_intensity else linear(color * intensity)
    assert shown == pytest.approx(np.array([2, 0.5, 0.1]) * 3 * 0.25, rel=1e-4)


@pytest.mark.parametrize("kelvin", [1800, 2700, 4000, 6500, 9000])
def test_temperatures(prefabs, tmp_path, kelvin):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    light = UsdLux.SphereLight.Define(stage, "/Lamp")
    light.CreateEnableColorTemperatureAttr(True)
    light.CreateColorTemperatureAttr(kelvin)
    stage.Save()
    found = prefabs(tmp_path / "stage.usda").named("Lamp")["light"]
    strength = found["intensity"] / (0.25 * 0.01**2)
    linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04045 else c / 12.92 for c in found["color"]]
    expected = UsdLux.BlackbodyTemperatureAsRgb(kelvin)
    assert [strength * value for value in linear] == pytest.approx(list(expected), abs=0.06)


def test_shaped_lights_are_spots_with_their_cones(prefabs, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    for name, kind in (("Ball", UsdLux.SphereLight), ("Panel", UsdLux.RectLight)):
        prim = kind.Define(stage, f"/{name}").GetPrim()
        shaping = UsdLux.ShapingAPI.Apply(prim)
        shaping.CreateShapingConeAngleAttr(25)
        shaping.CreateShapingConeSoftnessAttr(0.2)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    for name in ("Ball", "Panel"):
        light = prefab.named(name)["light"]
        assert light["type"] == "Spot"
        assert (light["spotAngle"], light["innerSpotAngle"]) == pytest.approx((50, 40))


def test_domes_are_reported(prefabs, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdLux.DomeLight.Define(stage, "/Sky")
    UsdLux.RectLight.Define(stage, "/Off").CreateIntensityAttr(0)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    assert "light" not in prefab.named("Sky")
    assert prefab.named("Sky")["usdLight"]["kind"] == "Dome"
    assert any("dome" in warning for warning in prefab.found["warnings"])
    assert not prefab.named("Off")["light"]["enabled"]


def test_the_projects_color_space_is_looked_at(prefabs, lamps):
    assert any("color space" in warning for warning in prefabs(lamps, gamma=1).found["warnings"])


def test_lights_without_a_size_are_the_limits_of_their_formulas(prefabs, tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "stage.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, METRES)
    kinds = {
        "Bulb": (UsdLux.SphereLight, {"radius": 0}),
        "Spot": (UsdLux.DiskLight, {"radius": 0}),
        "Slit": (UsdLux.RectLight, {"width": 0, "height": 3}),
        "Thread": (UsdLux.CylinderLight, {"radius": 0, "length": 2}),
        "Sun": (UsdLux.DistantLight, {"angle": 0}),
        "Sky": (UsdLux.DistantLight, {"angle": 200}),
        "None": (UsdLux.SphereLight, {"radius": 0, "normalize": False}),
    }
    for name, (kind, inputs) in kinds.items():
        prim = kind.Define(stage, f"/{name}").GetPrim()
        for key, value in {"intensity": 100, "exposure": 1, "normalize": True, **inputs}.items():
            prim.GetAttribute(f"inputs:{key}").Set(value)
    # without an angle, all light comes from one direction, normalized or not
    prim = UsdLux.DistantLight.Define(stage, "/Ray").GetPrim()
    prim.GetAttribute("inputs:intensity").Set(3)
    prim.GetAttribute("inputs:angle").Set(0)
    stage.Save()
    prefab = prefabs(tmp_path / "stage.usda")
    expected = {"Bulb": 200 / 4, "Spot": 200, "Slit": 200, "Thread": 200 / math.pi, "None": 0}
    for name, candela in expected.items():
        given, light = prefab.named(name)["usdLight"], prefab.named(name)["light"]
        # as a very small light of the same kind has them
        assert given["candela"] == pytest.approx(candela, rel=1e-5)
        assert given["lumen"] == pytest.approx(math.pi * 200 if candela else 0, rel=1e-5)
        assert light["enabled"] is bool(candela)
        assert light["intensity"] == pytest.approx(candela / math.pi, rel=1e-5)
    assert prefab.named("Sun")["usdLight"]["lux"] == pytest.approx(200, rel=1e-5)
    assert prefab.named("Sky")["usdLight"]["lux"] == pytest.approx(200, rel=1e-5)
    assert prefab.named("Ray")["usdLight"]["lux"] == pytest.approx(3, rel=1e-5)
    assert not [item for item in prefab.objects if item["path"].endswith("/Glow")]
    (warning,) = [text for text in prefab.found["warnings"] if "without a size" in text]
    assert "/None" in warning
