"""Cars of one's own in every reader: each knows them as cars with ids, and their boxes hold what is seen of them."""

import importlib.util
import io
import json
import os
import subprocess
import sys
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from support.browser import find_browser
from support.foreign_cars import write_glb, write_parts, write_z_up
from support.glb_reader import Glb
from support.label_tables import cars_of_plates, labelled_objects
from support.recordings import Recorded
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge
from support.unity import layer, reader
from support.viewer_page import viewed

import garage2usd
from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.config import GarageConfig
from garage2usd.exports import export
from garage2usd.garage_sources import check, read_built
from garage2usd.maps.parked_cars import parked_cars
from garage2usd.objects import CAR_LABELS
from garage2usd.objects.car import OwnCarSpec
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.render import Picture
from garage2usd.sensors.formats.nuscenes import NUSCENES_VERSION, write_nuscenes
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping
from garage2usd.stage.arrangement import arrange
from garage2usd.view.drawing import Region
from garage2usd.view.plan_picture import draw_plan

pytestmark = pytest.mark.client
needs_blender = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"
)
STRONGEST = {"box.glb": {1, 2}, "van.usdc": {0}, "parts.usda": {1}}
"""Which channels of red, green and blue a model's paint may be strongest in: the GLB is green with a blue cabin."""
CLASS_OF = {"box.glb": "car", "van.usdc": "van", "parts.usda": "truck"}
CATEGORY_OF = {"car": "vehicle.car", "van": "vehicle.car", "truck": "vehicle.truck"}
EDGE_PX = 2
CAMERA = {
    "kind": "pinhole",
    "name": "front",
    "position_m": [1.6, 0.0, 1.6],
    "size_px": [240, 120],
    "focal_px": [100.0, 100.0],
}


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """A garage whose cars are three foreign models, and which of its objects they are, by path."""
    folder = tmp_path_factory.mktemp("own")
    models = folder / "models"
    models.mkdir()
    write_glb(models / "box.glb")
    write_z_up(models / "van.usdc")
    write_parts(models)
    with (models / "models.toml").open("a") as file:
        file.write('semantic_class = "van"\n[parts]\nsemantic_class = "truck"\n')
    config = GarageConfig(
        seed=2,  # in each place of a car one of the models has room
        site={"width_cells": 5, "height_cells": 5},
        parking={"occupancy": 0.9},
        vehicles={"models": str(models), "share": 1.0},
    )
    built = garage2usd.build(config, folder / "garage.usdc")
    layout = built.garage.layout
    paths = arrange(layout, nested=False).paths()
    cars = {
        path: place for path, place in zip(paths, layout.placements, strict=True) if isinstance(place.spec, OwnCarSpec)
    }
    assert {car.spec.model.path for car in cars.values()} == {
        str(models / name) for name in ("box.glb", "van.usdc", "parts.usda")
    }
    entries = {entry["path"]: entry for entry in labelled_objects(built.labels) if entry["class"] in CAR_LABELS}
    assert {path: entry["class"] for path, entry in entries.items()} == {
        path: CLASS_OF[car.spec.model.path.rpartition("/")[2]] for path, car in cars.items()
    }
    return SimpleNamespace(built=built, cars=cars, entries=entries, folder=folder)


def test_checks_and_scenarios_take_each_class_for_parked_cars(own):
    garage = read_built(own.built.stage).garage
    (subject,) = garage.levels
    assert subject.cars.keys() == own.cars.keys()
    assert all(home is not None for _, home in subject.cars.values())
    assert len(parked_cars(garage)) == len(own.cars)
    taken = driven_garage(subject).taken
    assert {car.stall for car in own.cars.values()} <= taken
    findings, _ = check(own.built.stage)
    amiss = {"stall-blocked", "car-outside-stall", "lane-blocked"}
    assert not [finding for finding in findings if finding.rule in amiss]


@pytest.mark.soak
@needs_blender
def test_one_drives_and_carries_cameras_that_see_it_where_their_mask_says(own):
    folder = own.folder / "driven"
    over_roof = {**CAMERA, "name": "roof", "position_m": [0.2, 0.0, 1.75], "pitch_deg": 25.0}
    rig = {"name": "own", "models": str(own.folder / "models"), "car": "box", "ego_visible": True}
    record(
        own.built.stage,
        folder,
        rig=rig_from_mapping({**rig, "sensors": [over_roof, {**CAMERA, "name": "nose", "position_m": [3.4, 0, 0.7]}]}),
        along="1:" + next(iter(own.cars.values())).stall,
        every_m=60.0,
        samples=2,
        pictures=(Picture.COLOUR, Picture.INSTANCE),
    )
    ego = max(entry["id"] for entry in labelled_objects(own.built.labels)) + 1
    frames = json.loads((folder / "frames.json").read_text())["frames"]
    assert len(frames) >= 4
    for frame in frames:
        instance = np.asarray(Image.open(folder / frame["files"]["instance"])).astype(int) @ [1, 256, 65536]
        mask = np.asarray(Image.open(folder / frame["ego_mask"])) > 0
        assert np.mean((instance == ego) != mask) < 0.002
        assert mask.any() == (frame["sensor"] == "roof")
        if mask.any():
            red, green, blue = np.asarray(Image.open(folder / frame["files"]["colour"])).astype(int)[mask].mean(axis=0)
            assert max(green, blue) > red + 5, "a blue cabin, and a bonnet as green as its texture"


def test_a_glb_has_them_with_class_and_id(own):
    path = own.folder / "garage.glb"
    export(own.built.stage, [path])
    glb = Glb(path.read_bytes())
    extras = {node["name"]: node["extras"] for node in glb.nodes if node.get("extras", {}).get("class") in CAR_LABELS}
    assert {name: said["class"] for name, said in extras.items()} == {
        name: entry["class"] for name, entry in own.entries.items()
    }
    assert all("stall" in said for said in extras.values())
    for name, said in extras.items():
        assert said["id"] == own.entries[name]["id"]
        number = next(number for number, node in enumerate(glb.nodes) if node["name"] == name)
        assert np.ptp(glb.points(number), axis=0)[1] == pytest.approx(1.5, abs=0.01)


def test_lidar_and_nuscenes_know_their_points_and_boxes(own):
    made = record(
        own.built.stage,
        own.folder / "drive",
        rig=read_rig("lidar_32"),
        along="1:" + next(iter(own.cars.values())).stall,
        every_m=8.0,
        pictures=(),
        points=(CloudFormat.NPZ,),
        sequences=(Sequence.NUSCENES,),
    )
    ids = {entry["id"] for entry in own.entries.values()}
    classes = {entry["id"]: entry["class"] for entry in labelled_objects(own.built.labels)}
    met = set()
    for file in sorted((own.folder / "drive").rglob("*.npz")):
        met |= set(np.load(file)["instance"].tolist())
    assert len(met & ids) >= 5
    assert not met - classes.keys() - {0}
    folder = next((own.folder / "drive" / "nuscenes").glob("v1.0*"))
    annotations = json.loads((folder / "sample_annotation.json").read_text())
    instances = {each["token"]: each for each in json.loads((folder / "instance.json").read_text())}
    categories = {each["token"]: each["name"] for each in json.loads((folder / "category.json").read_text())}
    sizes = [
        each["size"]
        for each in annotations
        if categories[instances[each["instance_token"]]["category_token"]] in CATEGORY_OF.values()
    ]
    assert {round(size[1], 1) for size in sizes} == {4.2}
    assert made.frames.exists()


@pytest.mark.skipif(bool(reader.missing()), reason=reader.missing() or "")
def test_unity_imports_them_with_colliders(own, tmp_path_factory):
    running = reader.Reader(layer.compile_prefab_dump(tmp_path_factory.mktemp("prefab_dump")))
    try:
        prefab = layer.Prefab(running.ask("prefab", own.built.stage))
    finally:
        running.close()
    for label, count in Counter(entry["class"] for entry in own.entries.values()).items():
        assert len(prefab.labelled(label)) == count
    assert len(prefab.labelled("number_plate")) == len(own.cars)
    hulls = [item for item in prefab.objects if "/Car_" in item["path"] and "collider" in item]
    assert len(hulls) >= len(own.cars)
    assert all(item["collider"].get("convex") for item in hulls)


@pytest.mark.soak
def test_a_build_in_another_process_is_the_same_bytes(own, tmp_path):
    config, again = own.folder / "garage.toml", tmp_path / "garage.usdc"
    config.write_text(
        "seed = 2\nsite.width_cells = 5\nsite.height_cells = 5\nparking.occupancy = 0.9\n"
        'vehicles.models = "models"\nvehicles.share = 1.0\n'
    )
    command = [sys.executable, "-m", "garage2usd", "build", str(config), "-o", str(again)]
    subprocess.run(command, check=True, env={**os.environ, "PYTHONHASHSEED": "7"}, capture_output=True)
    for stage in (own.built.stage, again):
        export(stage, [stage.with_name("same.glb")])
    for name in ("garage.usdc", "garage_labels.json", "same.glb"):
        assert again.with_name(name).read_bytes() == own.built.stage.with_name(name).read_bytes(), name
    reports = [json.loads(stage.with_name("garage_report.json").read_text()) for stage in (own.built.stage, again)]
    assert all(report.pop("seconds") for report in reports)
    assert reports[0] == reports[1]


def colour_at(page, car):
    """The colour of the middle of a car from above, red, green and blue."""
    x, _, z = car.position_m
    page.eval(
        f"viewer.setMode('orbit'), viewer.orbit.target.set({x}, 0, {z}),"
        f" viewer.camera.position.set({x + 1}, 22, {z + 4}), viewer.orbit.update(), viewer.touch()"
    )
    page.rest()
    column, row = map(round, page.screen((x, 0.8, z)))
    seen = np.asarray(Image.open(io.BytesIO(page.page.screenshot())).convert("RGB"), dtype=int)
    return seen[row - 3 : row + 4, column - 3 : column + 4].mean(axis=(0, 1))


@pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path")
def test_the_viewer_shows_each_with_its_class_id_and_paint(own):
    with viewed(own.built.stage) as page:
        for label, count in Counter(entry["class"] for entry in own.entries.values()).items():
            shown = page.page.query_selector(f'.class[data-label="{label}"]').get_attribute("data-count")
            assert int(shown) == count
        colours = {}
        for path, car in own.cars.items():
            colours[path] = colour_at(page, car)
            assert int(colours[path].argmax()) in STRONGEST[car.spec.model.path.rpartition("/")[2]], (path, colours)
            x, _, z = car.position_m
            page.page.mouse.click(*page.screen((x, 0.8, z)))
            facts = page.facts()
            assert (facts["Class"], facts["Prim"]) == (own.entries[path]["class"], path)
            assert facts["Instance id"] == str(own.entries[path]["id"])
        page.page.locator("label:has(#layer-cars)").click()
        for path in {entry["class"]: path for path, entry in own.entries.items()}.values():
            assert np.abs(colour_at(page, own.cars[path]) - colours[path]).max() > 20, path
        assert page.complaints == []


@pytest.mark.soak
@needs_blender
def test_masks_along_a_drive_show_them_within_their_boxes(own):
    folder = own.folder / "pictures"
    record(
        own.built.stage,
        folder,
        rig=rig_from_mapping({"name": "front", "sensors": [CAMERA]}),
        along="1:" + next(iter(own.cars.values())).stall,
        every_m=5.0,
        samples=1,
        pictures=(Picture.INSTANCE, Picture.SEMANTIC),
    )
    classes = {each["name"]: each["id"] for each in json.loads(own.built.labels.read_text())["classes"]}
    class_of = {entry["id"]: classes[entry["class"]] for entry in own.entries.values()}
    boxes = {
        entry["id"]: np.stack(np.meshgrid(*zip(entry["min_m"], entry["max_m"], strict=True)), axis=-1).reshape(-1, 3)
        for entry in own.entries.values()
    }
    seen, whole = set(), 0
    for frame in json.loads((folder / "frames.json").read_text())["frames"]:
        instance = np.asarray(Image.open(folder / frame["files"]["instance"])).astype(int) @ [1, 256, 65536]
        semantic = np.asarray(Image.open(folder / frame["files"]["semantic"]))
        of_cars = np.isin(semantic, [classes["number_plate"], *class_of.values()])  # plates are pixels of their cars
        assert np.array_equal(np.isin(instance, list(boxes)), of_cars)
        for number in np.unique(instance[np.isin(instance, list(boxes))]).tolist():
            seen.add(number)
            assert set(semantic[instance == number].tolist()) <= {class_of[number], classes["number_plate"]}
            at = np.insert(boxes[number], 3, 1.0, axis=1) @ np.array(frame["world_to_camera"]).T
            if (at[:, 2] < 0.1).any():
                continue  # reaches behind the camera
            corners = at[:, :3] @ np.array(frame["intrinsics"]).T
            corners = corners[:, :2] / corners[:, 2:]
            rows, columns = np.nonzero(instance == number)
            pixels = np.stack([columns, rows], axis=1) + 0.5
            assert (pixels > corners.min(axis=0) - EDGE_PX).all()
            assert (pixels < corners.max(axis=0) + EDGE_PX).all()
            whole += len(pixels)
    assert len(seen) >= 8
    assert len({car.spec.model.path for path, car in own.cars.items() if own.entries[path]["id"] in seen}) == 3
    assert whole > 2000


@pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with nuscenes-devkit")
@pytest.mark.soak
def test_nuscenes_devkit_finds_their_points_in_their_boxes(own, tmp_path):
    (tmp_path / "recorded").mkdir()
    (tmp_path / "data").mkdir()
    rig = read_rig("lidar_32")
    exact = [sensor.model_copy(update={"range_noise_m": 0.0}) for sensor in rig.lidars]
    recorded = Recorded(own.built, rig.model_copy(update={"sensors": (*rig.cameras, *exact)}), tmp_path / "recorded")
    parts = {"stage": recorded.stage, "labels": recorded.labels, "scene": recorded.scene}
    write_nuscenes(recorded.recording, tmp_path / "data", **parts)
    run_judge("nuscenes_dump.py", tmp_path / "data", NUSCENES_VERSION, tmp_path / "found.json", folder=tmp_path)
    found = json.loads((tmp_path / "found.json").read_text())
    plates_car = cars_of_plates(own.built.labels)
    class_of = {entry["id"]: entry["class"] for entry in own.entries.values()}
    met = 0
    for sample, cloud in zip(found["samples"], recorded.clouds, strict=True):
        of_cars = {found["instances"][box["instance"]]["id"]: box for box in sample["boxes"]}
        instance = np.array([plates_car.get(number, number) for number in cloud.instance.tolist()])
        for number in class_of.keys() & set(instance.tolist()):
            box = of_cars[number]
            assert box["name"] == CATEGORY_OF[class_of[number]]
            assert box["said"] == np.count_nonzero(instance == number)
            assert set(np.flatnonzero(instance == number).tolist()) <= set(box["inside"])
            met += box["said"]
    assert met > 1000


def test_the_plan_draws_each_as_long_and_wide_as_it_is(own):
    garage = own.built.garage
    elements = draw_plan(garage.layout).elements
    found = [np.array(each.points) for each in elements if isinstance(each, Region) and each.kind == "car"]
    assert len(found) == len(own.cars)
    for points, car in zip(found, own.cars.values(), strict=True):
        body = car.spec.measures
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        assert middle == pytest.approx((car.position_m[0], car.position_m[2]), abs=0.02)
        along = max(np.ptp(points, axis=0))
        assert along == pytest.approx(max(body.half_extents_m(car.yaw_rad, width_m=body.width_m)) * 2, abs=0.03)
