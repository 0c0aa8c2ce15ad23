"""Buildings that someone moved, turned, lifted, hid or placed in another stage are read as they were built."""

import pytest
from pxr import Gf, Usd, UsdGeom
from support.edited_stages import chosen, edited, hidden, moved
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.exports import export
from garage2usd.garage_sources import read_built

MAPS = (".xodr", ".osm", ".yaml")


def instanced(source, path):
    """Write a stage that holds a garage as an instance, pitched and turned, without a default prim."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    garage = UsdGeom.Xform.Define(stage, "/Garage")
    garage.GetPrim().GetReferences().AddReference(str(source))
    garage.GetPrim().SetInstanceable(True)
    garage.AddTransformOp(opSuffix="world").Set(Gf.Matrix4d(Gf.Rotation(Gf.Vec3d(3, 1, 2), 80), Gf.Vec3d(4, 5, 600)))
    stage.GetRootLayer().Save()
    return path


def over(*edits):
    return lambda source, path: edited(source, path, *edits)


AWAY = {
    "lifted": over(moved(y=5)),
    "moved and turned": over(moved(x=100, y=5, z=7, yaw_deg=30)),
    "tipped over": over(moved(pitch_deg=90)),
    "upside down and hidden": over(moved(y=-3, pitch_deg=180), hidden("/Garage"), chosen(ceiling="hidden")),
    "an instance": instanced,
}


def exported(stage, folder):
    """Return the maps of a stage by their endings, without its name."""
    folder.mkdir()
    export(stage, [folder / f"map{end}" for end in MAPS])
    name = f'name="{stage.stem}"'.encode()
    return {path.name: path.read_bytes().replace(name, b"") for path in sorted(folder.iterdir())}


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("one") / "g.usda").stage


@pytest.fixture(scope="module")
def maps(one, tmp_path_factory):
    return exported(one, tmp_path_factory.mktemp("maps") / "unmoved")


@pytest.mark.parametrize("place", AWAY.values(), ids=AWAY)
def test_maps_of_a_garage_are_the_same_wherever_it_stands(place, one, maps, tmp_path):
    assert exported(place(one, tmp_path / "away.usda"), tmp_path / "maps") == maps


@pytest.mark.parametrize("corner", [1, 3])
def test_a_stall_without_area_is_a_fault_of_the_lane_graph(corner, one, tmp_path):
    def flatten(stage):
        points = stage.GetPrimAtPath("/Garage/LaneGraph/Stalls").GetAttribute("points")
        corners = list(points.Get())
        corners[corner] = corners[0]
        points.Set(corners)

    (level,) = read_built(edited(one, tmp_path / "flat.usda", flatten)).garage.levels
    assert [fault.message for fault in level.faults if fault.rule == "lane-graph"] == ["a stall without area"]
