"""The light that `check` finds follows UsdLux, whoever's the lights are."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdLux
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.as_built.stage_reader import level_of_stage

MAINTENANCE = 0.8


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("lights") / "small.usdc")


def edited(made):
    """The garage, to be edited in memory."""
    stage = Usd.Stage.Open(str(made.stage))
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def lux(stage):
    subject = level_of_stage(stage, source="stage")
    return np.array([subject.lane_lux, subject.stall_lux])


def tubes(stage):
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdLux.RectLight):
            yield prim


def switched_off(stage):
    for prim in stage.Traverse():
        if "power" in prim.GetVariantSets().GetNames():
            prim.GetVariantSets().SetSelection("power", "off")
    return stage


def test_what_is_switched_off_is_dark(made):
    assert (lux(edited(made)) > 10).all()
    assert lux(switched_off(edited(made))).tolist() == [0, 0]


def test_intensity_and_exposure_count(made):
    stage = edited(made)
    before = lux(stage)
    for prim in stage.Traverse():
        if prim.IsInstance() and any(
            below.IsA(UsdLux.RectLight) for below in prim.GetFilteredChildren(Usd.TraverseInstanceProxies())
        ):
            prim.SetInstanceable(False)
    for prim in tubes(stage):
        UsdLux.LightAPI(prim).CreateExposureAttr(1.0)
        UsdLux.LightAPI(prim).CreateIntensityAttr(UsdLux.LightAPI(prim).GetIntensityAttr().Get() / 4)
    assert lux(stage) == pytest.approx(before / 2)


@pytest.mark.parametrize("kind", [UsdLux.SphereLight, UsdLux.DiskLight])
def test_lights_of_others_light_the_floor(kind, made):
    """A small lamp over one point is its candela over the square of its height, and less aside."""
    stage = switched_off(edited(made))
    nodes = [node for node in level_of_stage(stage, source="stage").lanes.nodes if not node.is_portal]
    (x, z), height = nodes[0].position, 3.0
    light = kind.Define(stage, "/Lamp")
    light.CreateIntensityAttr(1000.0)
    light.CreateRadiusAttr(0.0)
    light.CreateNormalizeAttr(True)
    light.AddTranslateOp().Set(Gf.Vec3d(x, height, z))
    light.AddRotateXOp().Set(-90)
    candela = {UsdLux.SphereLight: 250.0, UsdLux.DiskLight: 1000.0}[kind]
    points = np.array([stall.centre for stall in level_of_stage(stage, source="stage").stalls])
    far = np.hypot(np.hypot(points[:, 0] - x, points[:, 1] - z), height)
    ahead = height / far if kind is UsdLux.DiskLight else 1.0
    expected = MAINTENANCE * candela * ahead * height / far**3
    assert lux(stage)[1] == pytest.approx(expected.mean(), rel=1e-6)
    light.GetPrim().GetAttribute("xformOp:rotateX").Set(90.0)
    assert lux(stage)[1] == pytest.approx(0 if kind is UsdLux.DiskLight else expected.mean())
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1
