"""Each class of people and things comes through every format of labels: masks, COCO, LiDAR, nuScenes and Unity."""

import importlib.util
import json
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from support.label_tables import labelled_objects
from support.unity import layer, reader

import garage2usd
from garage2usd.as_built.garage import garage_of_stage
from garage2usd.checks import findings_of
from garage2usd.common.progress import silent
from garage2usd.garage_sources import read_built
from garage2usd.objects import KINDS
from garage2usd.objects.car import OpenCarSpec
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.render.drawing import Drawing
from garage2usd.render.free_views import birds_eye_view, free_view, looked_through
from garage2usd.render.pictures import Picture, read_ids
from garage2usd.sensors.formats.coco import coco_panoptic, panoptic_segments
from garage2usd.sensors.formats.nuscenes_tables import BOXED, CATEGORIES, categories_of_classes
from garage2usd.sensors.rays.birds_eye import FREE_CLASSES, BirdsEye
from garage2usd.sensors.rays.lidar import scan, spinning_beams
from garage2usd.sensors.rays.ray_scene import read_ray_scene

pytestmark = pytest.mark.client
needs_blender = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"
)
KINDS_OF_CLUTTER = {kind.label: kind for kind in KINDS if kind.group == "Clutter"}
SETTINGS = ("people", "bicycles", "motorbikes", "trolleys", "prams", "bins", "boxes", "pallets", "bags")
SIZE = 96, 72
NUSCENES = {
    "person": "human.pedestrian.adult",
    "bicycle": "vehicle.bicycle",
    "motorbike": "vehicle.motorcycle",
    "pram": "human.pedestrian.stroller",
    "shopping_trolley": "movable_object.pushable_pullable",
    "waste_bin": "movable_object.pushable_pullable",
    "cardboard_box": "movable_object.debris",
    "pallet": "movable_object.debris",
    "bag": "movable_object.debris",
}
CITYSCAPES = {"person": "person", "bicycle": "bicycle", "motorbike": "motorcycle"}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A garage with all of them, and one object of each class, by the class."""
    config = garage2usd.GarageConfig(
        seed=4,
        site={"height_cells": 5, "width_cells": 5},
        clutter=dict.fromkeys(SETTINGS, 12.0) | {"open_boots": 10.0},
        stage={"texture_quality": "low"},
    )
    built = garage2usd.build(config, tmp_path_factory.mktemp("clutter") / "garage.usdc")
    stage = open_stage(built.stage)
    objects = {}
    for entry in labelled_objects(built.labels):
        if entry["class"] in KINDS_OF_CLUTTER:
            objects.setdefault(entry["class"], SimpleNamespace(**entry))
    return SimpleNamespace(
        built=built, stage=stage, labels=read_labels(stage, built.stage), objects=objects, table=built.labels
    )


def middle(entry):
    return (np.array(entry.min_m) + np.array(entry.max_m)) / 2


def test_the_table_has_the_nine_classes_with_their_cityscapes_names(made):
    assert len(made.objects) == len(NUSCENES) == 9
    classes = {entry["name"]: entry for entry in json.loads(made.table.read_text())["classes"]}
    for label, kind in KINDS_OF_CLUTTER.items():
        assert classes[label]["id"] == kind.number
        assert classes[label]["cityscapes"] == CITYSCAPES.get(label, "dynamic")


def test_stage_and_report_are_judged_as_the_garage(made):
    """A report holds no people and things, and none of them changes what is found."""
    built = made.built
    assert any(isinstance(place.spec, OpenCarSpec) for place in built.garage.layout.placements)
    expected = Counter(finding.rule for finding in built.findings)
    profile = built.garage.config.standard
    for subject in (garage_of_stage(made.stage, source="stage"), read_built(built.report).garage):
        assert Counter(finding.rule for finding in findings_of(subject, profile)) == expected, subject.source


@pytest.fixture(scope="module")
def drawn(made, tmp_path_factory):
    """Masks of each object from a little over it, and from above as a bird's-eye view has it."""
    views, hidden = [], []
    above = BirdsEye(metres_per_px=0.02, size_px=SIZE, centre_m=(0.0, 0.0))
    for label, entry in made.objects.items():
        x, y, z = middle(entry)
        view = free_view(made.stage, (x + 0.9, y + 1.3, z + 0.9), (x, y, z), SIZE, [view.name for view in views])
        pose = np.eye(4)
        pose[:3, :3] = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        pose[:3, 3] = x, 0.0, z
        views += [view, birds_eye_view(f"above_{label}", above, pose)]
        hidden += [[], looked_through(made.labels, above)]
    folder = tmp_path_factory.mktemp("masks")
    kinds = Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC
    Drawing(made.stage, made.labels, views, hidden, kinds, 1, 0, folder).draw(tmp_path_factory.mktemp("work"), silent)
    return folder, dict(zip(made.objects, zip(views[::2], views[1::2], strict=True), strict=True))


@needs_blender
def test_masks_and_panoptic_segments_have_them_from_the_side_and_from_above(made, drawn):
    folder, views = drawn
    assert not FREE_CLASSES & KINDS_OF_CLUTTER.keys()
    for label, pair in views.items():
        number, class_id = made.objects[label].id, KINDS_OF_CLUTTER[label].number
        for view in pair:
            instance = read_ids(folder / "instance" / f"{view.name}.png")
            semantic = np.asarray(Image.open(folder / "semantic" / f"{view.name}.png"))
            own = instance == number
            assert own.sum() > 20, (label, view.name)
            assert (semantic[own] == class_id).all()
            segments, infos = panoptic_segments(instance.astype(np.int32), made.labels)
            (info,) = [info for info in infos if info["id"] == number]
            assert (segments == number).sum() == info["area"] == own.sum()
            assert info["category_id"] == class_id
    categories = {entry["id"]: entry for entry in coco_panoptic([], made.labels, description="")["categories"]}
    for label, kind in KINDS_OF_CLUTTER.items():
        assert categories[kind.number]["name"] == label
        assert categories[kind.number]["isthing"] == 1


def test_lidar_points_have_them_and_their_nuscenes_categories(made):
    scene = read_ray_scene(made.stage, made.labels)
    category_of = categories_of_classes(made.labels)
    beams = spinning_beams(np.linspace(-60, 15, 48), 512)
    for label, entry in made.objects.items():
        x, _, z = middle(entry)
        place = np.eye(4)
        place[:3, :3] = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        place[:3, 3] = x + 0.9, entry.max_m[1] + 0.5, z
        cloud = scan(scene, beams, place, range_m=(0.1, 50.0))
        own = cloud.instance == entry.id
        assert own.sum() > 20, label
        assert (cloud.class_id[own] == KINDS_OF_CLUTTER[label].number).all()
        assert {CATEGORIES[number] for number in category_of[cloud.class_id[own]]} == {NUSCENES[label]}
        assert BOXED[label] == NUSCENES[label]
        points = cloud.points_m[own] @ place[:3, :3].T + place[:3, 3]
        assert (points > np.array(entry.min_m) - 0.005).all()
        assert (points < np.array(entry.max_m) + 0.005).all()


@pytest.mark.skipif(bool(reader.missing()), reason=str(reader.missing()))
@pytest.mark.soak
def test_unity_imports_them_with_their_ids_and_classes(made, tmp_path):
    running = reader.Reader(layer.compile_prefab_dump(tmp_path))
    prefab = layer.Prefab(running.ask("prefab", made.built.stage))
    for label, entry in made.objects.items():
        found = {f"/{item['path'].partition('/')[2]}": item["instance"] for item in prefab.labelled(label)}
        found |= {f"/{item['path']}": item["instance"] for item in prefab.labelled(label)}
        assert found[entry.path] == entry.id, label
    running.close()
