"""Cars of one's own in every reader: Unity's importer, GLB, LiDAR and nuScenes know them as cars with plates."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from support.foreign_cars import write_glb, write_parts, write_z_up
from support.glb_reader import Glb
from support.label_tables import labelled_objects
from support.unity import layer, reader

import garage2usd
from garage2usd.config import GarageConfig
from garage2usd.exports import export
from garage2usd.objects.car import OwnCarSpec
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.sensors.rig import read_rig

pytestmark = pytest.mark.client


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """A garage whose cars are three foreign models, and which of its objects they are, by path."""
    folder = tmp_path_factory.mktemp("own")
    models = folder / "models"
    models.mkdir()
    write_glb(models / "box.glb")
    write_z_up(models / "van.usdc")
    write_parts(models)
    config = GarageConfig(
        site={"width_cells": 5, "height_cells": 5},
        parking={"occupancy": 0.9},
        vehicles={"models": str(models), "share": 1.0},
    )
    built = garage2usd.build(config, folder / "garage.usdc")
    cars = [place for place in built.garage.layout.placements if isinstance(place.spec, OwnCarSpec)]
    assert {car.spec.model.path for car in cars} == {
        str(models / name) for name in ("box.glb", "van.usdc", "parts.usda")
    }
    entries = {entry["path"]: entry for entry in labelled_objects(built.labels) if entry["class"] == "car"}
    assert len(entries) == len(cars)
    return SimpleNamespace(built=built, cars=cars, entries=entries, folder=folder)


def test_a_glb_has_them_with_class_and_id(own):
    path = own.folder / "garage.glb"
    export(own.built.stage, [path])
    glb = Glb(path.read_bytes())
    extras = {node["name"]: node["extras"] for node in glb.nodes if node.get("extras", {}).get("class") == "car"}
    assert extras.keys() == own.entries.keys()
    for name, said in extras.items():
        assert said["id"] == own.entries[name]["id"]
        number = next(number for number, node in enumerate(glb.nodes) if node["name"] == name)
        assert np.ptp(glb.points(number), axis=0)[1] == pytest.approx(1.5, abs=0.01)


def test_lidar_and_nuscenes_know_their_points_and_boxes(own):
    made = record(
        own.built.stage,
        own.folder / "drive",
        rig=read_rig("lidar_32"),
        along="1:" + own.cars[0].stall,
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
    names = {categories[instances[each["instance_token"]]["category_token"]] for each in annotations}
    assert any("car" in name for name in names), names
    sizes = [
        each["size"] for each in annotations if "car" in categories[instances[each["instance_token"]]["category_token"]]
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
    assert len(prefab.labelled("car")) == len(own.cars)
    assert len(prefab.labelled("number_plate")) == len(own.cars)
    hulls = [item for item in prefab.objects if "/Car_" in item["path"] and "collider" in item]
    assert len(hulls) >= len(own.cars)
    assert all(item["collider"].get("convex") for item in hulls)
