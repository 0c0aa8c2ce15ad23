"""Stages whose Z points up say what those say whose Y does."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom
from support.small_garage import SETTINGS
from support.small_levels import SMALL_LEVELS

from garage2usd import GarageConfig, build, check, drive, export
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.sensors.formats.nuscenes_boxes import object_boxes
from garage2usd.sensors.formats.nuscenes_scenes import GlobalFrame
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.view.viewer.reading import read_scene

LEVELS = SMALL_LEVELS.model_dump(mode="json", exclude_defaults=True)
AXES = ("Y", "Z")


def both(settings, folder, extension="usdc", **stage):
    """The builds of a garage whose Y and whose Z points up."""
    config = {**settings, "stage": {"texture_quality": "low", **stage}}
    made = []
    for axis in AXES:
        config["stage"]["up_axis"] = axis
        made.append(build(GarageConfig(**config), folder / axis / f"garage.{extension}"))
    return made


@pytest.fixture(scope="module")
def garages(tmp_path_factory):
    return both(SETTINGS, tmp_path_factory.mktemp("axes"))


@pytest.fixture(scope="module")
def levels(tmp_path_factory):
    return both(LEVELS, tmp_path_factory.mktemp("axes"))


def points_of(file):
    """The points of all meshes in the space of their stage, by path."""
    stage, cache = Usd.Stage.Open(str(file)), UsdGeom.XformCache()
    return {
        str(prim.GetPath()): np.array(prim.GetAttribute("points").Get()) @ placed[:3, :3] + placed[3, :3]
        for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
        if prim.IsA(UsdGeom.Mesh)
        for placed in [np.array(cache.GetLocalToWorldTransform(prim))]
    }


def assert_turned(y_up, z_up):
    """The points of the stage with Z up are those of the other, whose -Z is its Y."""
    told, found = points_of(y_up), points_of(z_up)
    assert told.keys() == found.keys()
    assert len(told) > 100
    for path, points in told.items():
        assert np.abs(points[:, [0, 2, 1]] * (1, -1, 1) - found[path]).max() < 1e-5, path


@pytest.mark.parametrize(
    ("form", "extension"), [("instanced", "usdc"), ("instanced", "usdz"), ("nested", "usdc"), ("flat", "usda")]
)
def test_each_form_is_turned_as_a_whole(form, extension, tmp_path):
    y_up, z_up = (made.stage for made in both(SETTINGS, tmp_path, extension, form=form))
    assert UsdGeom.GetStageUpAxis(Usd.Stage.Open(str(z_up))) == "Z"
    assert_turned(y_up, z_up)


def test_levels_are_turned_with_their_building_and_alone(levels):
    assert_turned(*(made.stage for made in levels))
    assert_turned(*(made.stage.parent / "garage_assets" / "U1.usdc" for made in levels))


def test_checks_find_nothing_else(garages, levels):
    for made in (garages, levels):
        told, found = ([finding.rule for finding in check(each.stage)[0]] for each in made)
        assert found == told


@pytest.mark.parametrize("kind", ["garages", "levels"])
def test_exports_are_the_same(kind, request):
    names = ("g.glb", "g.xodr", "g.osm", "g.dxf", "g.yaml")
    written = []
    for made in request.getfixturevalue(kind):
        folder = made.stage.parent / "exports"
        files = export(made.stage, [folder / name for name in names])
        # all but the digest of the configuration, which names the axis
        digest = made.garage.metadata["configDigest"].encode()
        written.append({file.name: file.read_bytes().replace(digest, b"") for file in files})
    assert written[0] == written[1]


def test_cars_drive_the_same_ways(garages):
    told, found = (drive(made.stage).trajectory for made in garages)
    for name in ("time_s", "x_m", "y_m", "z_m", "yaw_rad"):
        assert np.array_equal(getattr(told, name), getattr(found, name)), name


def test_boxes_are_the_same_in_the_global_frame(garages):
    told, found = [], []
    for made, boxes in zip(garages, (told, found), strict=True):
        stage = open_stage(made.stage)
        labels = read_labels(stage, made.labels)
        scene = read_ray_scene(stage, labels)
        matrix = GlobalFrame(stage, scene).matrix
        cars = [number for number, entry in labels.classes.items() if entry.name == "car"]
        for box in object_boxes(stage, scene, cars):
            centre = matrix[:3, :3] @ box.centre_m + matrix[:3, 3]
            boxes.append((box.id, *centre, *(matrix[:3, :3] @ box.axes).ravel(), *box.size_m))
    assert len(told) > 1
    assert np.abs(np.subtract(told, found)).max() < 1e-4


def test_the_viewer_shows_the_same(garages):
    told, found = (read_scene(open_stage(made.stage), made.stage) for made in garages)
    assert [placed.path for placed in found.objects] == [placed.path for placed in told.objects]
    places = [np.stack([placed.matrix for placed in scene.objects]) for scene in (told, found)]
    assert np.abs(places[0] - places[1]).max() < 1e-6
    assert np.abs(told.bounds_m - found.bounds_m).max() < 1e-6


def test_an_unknown_axis_is_refused():
    with pytest.raises(ValueError, match=r"up_axis.*'X'"):
        GarageConfig(stage={"up_axis": "X"})
