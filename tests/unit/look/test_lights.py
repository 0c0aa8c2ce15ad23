"""Lamps and daylight: that a stage has what is asked for, and everything else where it was."""

import math
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdLux, UsdShade

from garage2usd.as_built.garage import garage_of_file
from garage2usd.assets.light import USUAL_LAMP_RGB, USUAL_TEMPERATURE_K, lamp_colour
from garage2usd.config import GarageConfig
from garage2usd.config.look import LampKind
from garage2usd.garage_sources import check
from garage2usd.layout.ceiling.lighting import MAINTENANCE, direct_lux
from garage2usd.layout.placement import Placement
from garage2usd.objects.lamp import LampSpec
from garage2usd.pipeline import build, generate
from garage2usd.reading.lights import light_of, luminance_of

PLAN = {"episodes": 100}


def garage(**lights):
    return generate(GarageConfig(seed=3, plan=PLAN, look={"lights": lights}))


@pytest.fixture(scope="module")
def usual():
    return garage().layout


def lamps_of(layout):
    return [place.spec for place in layout.of_kind("light")]


def over_squares(layout):
    return [place.spec for place in layout.of_kind("light") if place.square is not None]


def places(layout):
    return [
        (place.name, place.kind, place.position_m, place.yaw_rad, place.square, place.ordinal)
        for place in layout.placements
    ]


@pytest.mark.parametrize(
    "lights",
    [
        {"lamps": "panels"},
        {"lamps": "round", "temperature_k": 3000, "spread_k": 800},
        {"dead_share": 0.4, "daylight": "night"},
        {"emergency_only": True, "daylight": "sun"},
    ],
    ids=["panels", "round", "dead", "emergency"],
)
def test_everything_hangs_and_stands_where_it_did(usual, lights):
    other = garage(**lights).layout
    assert other.structure == usual.structure
    assert places(other) == places(usual)
    assert [(stall.name, stall.number) for stall in other.stalls] == [
        (stall.name, stall.number) for stall in usual.stalls
    ]


@pytest.mark.parametrize(("lamps", "area_m2"), [("panels", 0.595**2), ("round", math.pi * 0.2**2), ("tubes", 0.18)])
def test_lamps_of_all_kinds_light_the_floor_alike(lamps, area_m2):
    layout = garage(lamps=lamps).layout
    light = layout.illuminance
    assert light.lanes.mean == pytest.approx(50, abs=0.2)
    assert light.stalls.mean >= 30
    assert {spec.form for spec in lamps_of(layout)} == {lamps}
    assert lamps_of(layout)[0].area_m2 == pytest.approx(area_m2)
    assert light.flux_lm == pytest.approx(math.pi * light.luminance_nit * area_m2)


def test_the_light_of_a_disc_against_a_fine_integral():
    spec = LampSpec(0.4, 0.4, drop_m=0.105, luminance_nit=1.0, form=LampKind.ROUND)
    lamp = Placement("Lamp", spec, (0.0, 3.2, 0.0))
    points = np.random.default_rng(0).uniform(-6, 6, (30, 2))
    u, v = np.meshgrid(*[(np.arange(60) + 0.5) / 60 * 0.4 - 0.2] * 2)
    inside = np.hypot(u, v) < 0.2
    height = 3.2 - 0.105
    far = np.sqrt((u[inside] - points[:, :1]) ** 2 + (v[inside] - points[:, 1:]) ** 2 + height**2)
    expected = MAINTENANCE * (0.4 / 60) ** 2 * (height**2 / far**4).sum(axis=1)
    assert direct_lux(points, [lamp]) == pytest.approx(expected, rel=0.01)


def test_colours_of_lamps():
    assert lamp_colour(USUAL_TEMPERATURE_K) == USUAL_LAMP_RGB
    warm, cold = lamp_colour(2700.0), lamp_colour(7000.0)
    assert warm[0] == 1 > warm[1] > warm[2]
    assert cold[2] == 1 > cold[0]
    for kelvin in (2700.0, 4000.0, 6500.0):  # USD's own black body, in relation to that of the usual temperature
        body, usual = (np.array(UsdLux.BlackbodyTemperatureAsRgb(each)) for each in (kelvin, USUAL_TEMPERATURE_K))
        expected = body / usual * USUAL_LAMP_RGB
        assert np.array(lamp_colour(kelvin)) == pytest.approx(expected / expected.max(), abs=0.03)


def test_temperatures_spread_in_five_steps():
    kelvin = np.array([spec.temperature_k for spec in over_squares(garage(temperature_k=4000, spread_k=300).layout)])
    assert len(set(kelvin.tolist())) == 5
    assert kelvin.mean() == pytest.approx(4000, abs=120)
    assert kelvin.std() == pytest.approx(300, rel=0.2)


def test_the_share_of_dead_lamps_takes_its_light_away(usual):
    layout = garage(dead_share=0.4).layout
    dead = sum(spec.is_dead for spec in over_squares(layout))
    light, whole = layout.illuminance, usual.illuminance
    assert (light.lamps, light.dead_lamps) == (len(over_squares(usual)), dead)
    assert dead / light.lamps == pytest.approx(0.4, abs=0.15)
    assert light.luminance_nit == whole.luminance_nit
    assert light.lumen_method_lux / whole.lumen_method_lux == pytest.approx(1 - dead / light.lamps)
    assert light.lanes.mean / whole.lanes.mean == pytest.approx(1 - dead / light.lamps, abs=0.12)


def test_lamps_that_are_dead_at_less_are_dead_at_more():
    few, many = (
        {
            place.name + str(place.square)
            for place in garage(dead_share=share).layout.of_kind("light")
            if place.spec.is_dead
        }
        for share in (0.1, 0.3)
    )
    assert few
    assert few < many


def test_one_lamp_in_eight_burns_when_the_mains_have_failed():
    layout = garage(emergency_only=True).layout
    burning = np.flatnonzero([not spec.is_dead for spec in over_squares(layout)])
    assert len(burning) == math.ceil(layout.illuminance.lamps / 8)
    assert np.diff(burning).max() < 16
    assert 0 < layout.illuminance.lanes.mean < 20


def built(tmp_path, **lights):
    config = GarageConfig(seed=3, plan=PLAN, look={"lights": lights})
    return Path(build(config, tmp_path / "garage.usda").stage)


def test_a_stage_of_dead_round_lamps(tmp_path):
    path = built(tmp_path, lamps="round", dead_share=0.4, temperature_k=3000, spread_k=300)
    layout = garage(lamps="round", dead_share=0.4, temperature_k=3000, spread_k=300).layout
    stage = Usd.Stage.Open(str(path))
    lights = [prim for prim in prims(stage) if prim.HasAPI(UsdLux.LightAPI)]
    assert {str(prim.GetTypeName()) for prim in lights} == {"DiskLight"}
    read = [light_of(prim, np.eye(4), 1.0) for prim in lights]
    assert sum(light.candela == 0 for light in read) == sum(spec.is_dead for spec in lamps_of(layout))
    assert len({light.colour_rgb for light in read}) > 3
    # all that burn are equally bright to the eye
    shining = [light.luminance_nit * light.brightness for light in read if light.candela]
    expected = layout.illuminance.luminance_nit / 27.0 * luminance_of(USUAL_LAMP_RGB)
    assert shining == pytest.approx([expected] * len(shining), rel=1e-3)
    assert [light.width_m for light in read] == pytest.approx([0.4] * len(read))
    (subject,) = garage_of_file(path).levels
    assert (subject.lamps, subject.dead_lamps) == (len(read), sum(light.candela == 0 for light in read))
    # the stage's ramps add little
    assert subject.lane_lux == pytest.approx(layout.illuminance.lanes.mean, rel=0.02)
    finding = next(found for found in check(path)[0] if found.rule == "lane-illuminance")
    assert f"{subject.dead_lamps} of {subject.lamps} lamps give no light" in finding.message
    # dead ones stay dead whatever the variant says
    stage.GetDefaultPrim().GetVariantSet("lights").SetVariantSelection("off")
    off = sum(light_of(prim, np.eye(4), 1.0).candela == 0 for prim in prims(stage) if prim.HasAPI(UsdLux.LightAPI))
    assert off == len(read)


def test_warm_lamps_glow_warm(tmp_path):
    stage = Usd.Stage.Open(str(built(tmp_path, temperature_k=3000)))
    glows = {tuple(glow) for name, glow in glows_of(stage) if name == "TubeGlow"}
    (glow,) = glows
    assert glow[0] > 1.2 * glow[1] > 1.5 * glow[2]
    assert luminance_of(glow) == pytest.approx(luminance_of((14.0, 13.6, 12.9)), rel=0.01)


@pytest.mark.parametrize(("daylight", "low", "high"), [("night", 0.0, 0.05), ("dusk", 0.1, 1.0), ("sun", 8.0, 20.0)])
def test_the_sky_at_doors(tmp_path, daylight, low, high):
    stage = Usd.Stage.Open(str(built(tmp_path, daylight=daylight)))
    skies = [glow for name, glow in glows_of(stage) if name == "Daylight"]
    assert skies
    assert all(low < luminance_of(glow) < high for glow in skies)


def prims(stage):
    return list(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))


def glows_of(stage):
    for prim in prims(stage):
        if prim.IsA(UsdShade.Material):
            surface = UsdShade.Material(prim).ComputeSurfaceSource()[0]
            glow = surface.GetInput("emissiveColor") if surface else None
            if glow and glow.Get() is not None:
                yield prim.GetName(), glow.Get()
