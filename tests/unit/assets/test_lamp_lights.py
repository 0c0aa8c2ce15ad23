"""The lights of a car's lamps: where they are, how strongly they shine, and where to."""

import math

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from garage2usd.assets import Asset
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import CAR_BODIES, body_named
from garage2usd.objects.car import CarSpec
from garage2usd.reading.lights import light_of
from garage2usd.sensors.rig.rig import rig_from_mapping
from garage2usd.stage.ego_car import EGO_PATH, lamp_places, write_stage_with_car
from garage2usd.stage.prototype_layer import NITS_PER_INTENSITY

HATCHBACK = body_named("hatchback")


@pytest.fixture
def written(tmp_path):
    """A stage that holds nothing but a car, with its lamps off or on."""

    def write(*, is_lit):
        empty = Usd.Stage.CreateNew(str(tmp_path / f"empty_{is_lit}.usda"))
        UsdGeom.SetStageUpAxis(empty, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(empty, 1.0)
        empty.Save()
        path = tmp_path / f"car_{is_lit}.usda"
        write_stage_with_car(path, empty, HATCHBACK, is_lit=is_lit)
        return Usd.Stage.Open(str(path))

    return write


@pytest.mark.parametrize("body", CAR_BODIES, ids=lambda body: body.name)
def test_lights_are_before_the_lenses_of_each_side(body):
    asset = CarSpec(body.name, "white").asset()
    places = lamp_places(asset)
    assert places.keys() == {"HeadLeft", "HeadRight", "TailLeft", "TailRight"}
    for name, (x, y, z) in places.items():
        points = next(part.points for part in asset.parts if part.name == f"{name[:4]}Lamps")
        own = points[points[:, 0] > 0] if name.endswith("Right") else points[points[:, 0] < 0]
        assert (own.min(axis=0)[:2] < (x, y)).all()
        assert (own.max(axis=0)[:2] > (x, y)).all()
        outermost = own[:, 2].min() if name.startswith("Head") else own[:, 2].max()
        assert abs(z) == pytest.approx(abs(outermost) + 0.03)
        assert 0.3 < y < 1.4
    for end in ("Head", "Tail"):
        assert places[f"{end}Left"] == pytest.approx(places[f"{end}Right"] * (-1.0, 1.0, 1.0), abs=1e-3)


def test_beams_are_700_lumens_below_the_horizon_and_tail_lamps_of_the_red_that_is_allowed(written):
    stage = written(is_lit=True)
    places = lamp_places(CarSpec(HATCHBACK.name, "white").asset())
    for name, place in places.items():
        prim = stage.GetPrimAtPath(f"{EGO_PATH}/Body/{name}Light")
        matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0))
        assert matrix[3, :3] == pytest.approx(place - (0.0, 0.0, HATCHBACK.rear_axle_m), abs=1e-5)
        ahead, light = -matrix[2, :3], light_of(prim, matrix, 1.0)
        candela = light.candela * NITS_PER_INTENSITY
        assert ahead[0] == pytest.approx(0.0, abs=1e-6)
        dip_deg = math.degrees(math.asin(-ahead[1]))
        if name.startswith("Head"):
            assert candela * math.tau * (1 - math.cos(math.radians(light.cone_deg))) == pytest.approx(700, rel=1e-3)
            assert dip_deg - light.cone_deg == pytest.approx(0.6, abs=1e-3)
            assert ahead[2] < 0
        else:
            red, green, blue = light.colour_rgb
            assert 4 <= candela * (0.2126 * red + 0.7152 * green + 0.0722 * blue) <= 17
            assert red > 20 * max(green, blue)
            assert dip_deg > 0
            assert ahead[2] > 0


def test_lenses_glow_where_the_car_is_lit_and_a_dark_one_has_no_light(written):
    lit, dark = written(is_lit=True), written(is_lit=False)
    for name in ("LampFrontLit", "LampRearLit"):
        surface = lit.GetPrimAtPath(f"{EGO_PATH}/Looks/{name}/Surface")
        assert max(surface.GetAttribute("inputs:emissiveColor").Get()) > 1
    assert not [prim for prim in dark.Traverse() if "Light" in str(prim.GetTypeName()) or "Lit" in prim.GetName()]


def test_a_car_without_lamps_cannot_have_them_on():
    with pytest.raises(ConfigError, match=r"lamps.*head lamps"):
        lamp_places(Asset(()))


def test_lamps_are_on_or_off():
    sensors = [{"kind": "spinning", "name": "top"}]
    with pytest.raises(ConfigError, match=r"lamps.*dim"):
        rig_from_mapping({"name": "r", "lamps": "dim", "sensors": sensors})
