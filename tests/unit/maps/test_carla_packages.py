"""Packages for CARLA without Blender: names, descriptions, places, and the program for Unreal's editor."""

import importlib.util
import json
import sys
import zipfile
from collections import Counter

import jsonschema
import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd, UsdGeom, UsdLux
from support.carla_importer import (
    LABELS,
    SCHEMA,
    Collisions,
    fake_unreal,
    imported,
    is_spawned,
    label_of,
    moved_to,
    package_jsons,
)
from support.label_tables import labelled_objects

import garage2usd
from garage2usd import exports
from garage2usd.cli import main
from garage2usd.common import package
from garage2usd.maps.carla_names import BY_NAME, folder_of, mesh_name, plain_name
from garage2usd.objects import CLASSES
from garage2usd.render import blender_process

SMALL = '[site]\nstructure = """\n....\nE==X\n....\n"""\n[bay]\ndimensioned = false\n'
ACTORS = {"car", "van", "truck", "number_plate"}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A small garage, its package with names of dots and blanks, unpacked, and the job that Blender would have got."""
    folder = tmp_path_factory.mktemp("carla")
    config = folder / "small.toml"
    config.write_text(SMALL)
    stage = garage2usd.build(garage2usd.load_config(config), folder / "a signed light.v2.usdc").stage
    jobs = []

    def fake(job, work, done, blender, *, script):
        assert script.name == "carla_fbx.py"
        jobs.append(job)
        with open(job["fbx"], "wb") as file:
            file.write(b"FBX")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(exports, "run_blender", fake)
        patch.setattr(package, "find_spec", lambda module: module)
        (archive,) = garage2usd.export(stage, [folder / "a signed light.v2.carla.zip"])
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(folder / "out")
    (job,) = jobs
    return stage, folder / "out" / "a_si_gned_li_ght_v2", job


def test_a_package_is_what_both_importers_read(made):
    _, folder, _ = made
    (description,) = package_jsons(folder / "Import")
    document = json.loads(description.read_text())
    jsonschema.Draft202012Validator(SCHEMA).validate(document)
    (entry,) = document["maps"]
    assert description.stem == entry["name"] == folder.name
    for name in (entry["source"], entry["xodr"]):
        assert (description.parent / name).is_file()
        assert (description.parent / name).stem == entry["name"]  # xodr and pedestrian navigation follow this name


def test_the_importer_and_the_editor_give_each_mesh_its_class(made, monkeypatch):
    stage, folder, job = made
    garage = json.loads((folder / "garage.json").read_text())
    (description,) = package_jsons(folder / "Import")
    wanted = Counter(
        folder_of(entry["class"])
        for entry in labelled_objects(stage.with_name(f"{stage.stem}_labels.json"))
        if entry["class"] not in ACTORS
    )
    assert Counter(mesh["folder"] for mesh in garage["meshes"]) == wanted
    assert {"Road", "RoadLine", "Wall", "Pole", "Building", "Static", "TrafficSign", "Sky"} <= {*wanted} <= LABELS
    names = [material["name"] for material in job["materials"]]
    assets = imported(description, job["names"])
    assert all(is_spawned(asset.rpartition("/")[2], names) for asset in assets)
    by_importer = Counter(map(label_of, assets))
    others = sum(count for name, count in wanted.items() if name not in BY_NAME)
    assert by_importer == Counter({name: wanted[name] for name in BY_NAME if wanted[name]}) + Counter(Terrain=others)
    unreal = fake_unreal(assets, [f"/Game/{folder.name}/Maps/{folder.name}/{folder.name}"])
    monkeypatch.setitem(sys.modules, "unreal", unreal)
    program = loaded(folder / "finish_in_editor.py")
    for _ in range(2):  # a second time nothing changes
        program.main()
        assert Counter(map(label_of, assets)) == wanted
        assert len(unreal.actors) == len(garage["lamps"]) > 5
    assert unreal.saved == ["level", "packages"] * 2
    assert "could not" not in "".join(unreal.said)


def test_lamps_stand_and_shine_as_in_the_stage(made, monkeypatch):
    path, folder, _ = made
    garage = json.loads((folder / "garage.json").read_text())
    unreal = fake_unreal([], [f"/Game/{folder.name}/Maps/{folder.name}/{folder.name}"])
    monkeypatch.setitem(sys.modules, "unreal", unreal)
    loaded(folder / "finish_in_editor.py").main()
    stage, places = Usd.Stage.Open(str(path)), UsdGeom.XformCache()
    lights = [
        prim
        for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
        if prim.IsA(UsdLux.RectLight) and UsdGeom.Imageable(prim).ComputeVisibility() != "invisible"
    ]
    by_prim = {lamp["prim"]: actor for lamp, actor in zip(garage["lamps"], unreal.actors, strict=True)}
    assert by_prim.keys() == {str(light.GetPath()) for light in lights}
    for light in lights:
        matrix, actor = np.array(places.GetLocalToWorldTransform(light)), by_prim[str(light.GetPath())]
        x, y, z = matrix[3, :3]
        assert np.allclose(actor.place, (100 * x, 100 * z, 100 * y), atol=0.05)
        ahead = -matrix[2, :3] / np.linalg.norm(matrix[2, :3])
        assert np.allclose(actor.turn[0], ahead[[0, 2, 1]], atol=1e-3)
        said = actor.component.properties
        area_m2 = said["source_width"] * said["source_height"] / 1e4
        nits = light.GetAttribute("garage:light:luminance").Get()
        luminance = np.dot(said["light_color"].values[:3], (0.2126, 0.7152, 0.0722)) * said["intensity"] / area_m2
        assert luminance == pytest.approx(nits, rel=0.01)


def test_spots_and_parked_cars_are_those_of_the_report(made):
    stage, folder, _ = made
    garage = json.loads((folder / "garage.json").read_text())
    stalls = json.loads(stage.with_name(f"{stage.stem}_report.json").read_text())["levels"][0]["stalls"]
    spots = {spot["stall"]: spot for spot in garage["parking_spots"]}
    assert len(spots) > 5
    for stall in stalls:
        if stall["name"] in spots:
            spot = spots[stall["name"]]
            assert np.allclose((spot["x"], spot["y"]), stall["centre_m"], atol=1e-3)
            assert (spot["width_m"], spot["length_m"]) == pytest.approx((stall["width_m"], stall["length_m"]), abs=1e-3)
    parked = {car["stall"] for car in garage["parked_cars"]}
    assert parked == {name for name, spot in spots.items() if spot["is_occupied"]}
    for car in garage["parked_cars"]:  # nose or tail first, in their stalls
        spot = spots[car["stall"]]
        assert np.hypot(car["x"] - spot["x"], car["y"] - spot["y"]) < 1
        assert abs(np.sin(np.radians(car["yaw_deg"] - spot["yaw_deg"]))) < 0.1
    assert sum(point["is_entrance"] for point in garage["spawn_points"]) >= 1


def test_colliders_belong_to_one_mesh_each(made):
    _, folder, job = made
    garage = json.loads((folder / "garage.json").read_text())
    found = Collisions(job["names"]).of
    assert found.keys() == {mesh["mesh"] for mesh in garage["meshes"]}
    with_colliders = {mesh["class"] for mesh in garage["meshes"] if found[mesh["mesh"]]}
    assert {"wall", "column", "beam", "wheel_stop"} <= with_colliders
    assert not {"floor", "stall_line", "stall_number"} & with_colliders


@pytest.mark.parametrize("entry", CLASSES, ids=lambda entry: entry.label)
def test_each_class_has_a_folder_that_carla_knows_and_a_name_that_it_does_not_refuse(entry):
    folder = folder_of(entry.label)
    asset = f"a_{mesh_name(folder, 7)}"
    assert folder in LABELS
    assert is_spawned(asset, [])
    assert moved_to(asset) == (folder if folder in BY_NAME else "Terrain")


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("garage", "garage"),
        ("my garage.v2", "my_garage_v2"),
        ("Straße 7", "Strae_7"),
        ("車", "garage"),
        ("my Road", "my_Ro_ad"),
        ("roads markings", "ro_ads_markings"),
        ("Design LIGHT", "Desi_gn_LI_GHT"),
        ("terrain_Tile_0_1", "te_rrain_Ti_le_0_1"),
    ],
)
def test_names_mean_nothing_to_the_importer(name, plain):
    assert plain_name(name) == plain
    assert is_spawned(plain, [])
    assert "_tile_" not in plain.lower()
    for folder in BY_NAME:
        assert moved_to(f"{plain}_{mesh_name(folder, 1)}") == folder


def test_without_blender_the_other_files_are_written_and_one_line_says_what_to_install(made, tmp_path, monkeypatch):
    stage, _, _ = made
    monkeypatch.setattr(package, "find_spec", lambda module: None if module == "bpy" else module)
    monkeypatch.setattr(blender_process, "blender_places", lambda _: [])
    monkeypatch.setattr(blender_process.shutil, "which", lambda _: None)
    asked = ["export", str(stage), "-o", str(tmp_path / "a.carla.zip"), "-o", str(tmp_path / "a.xodr")]
    run = CliRunner().invoke(main, asked)
    assert run.exit_code == 3, run.output
    (line,) = run.stderr.splitlines()
    assert line.startswith(f"Error: {tmp_path / 'a.carla.zip'} is not written: a map for CARLA needs Blender's Python")
    assert "or a Blender 5.0 or later that is installed" in line
    assert line.endswith(package.installation_of("blender"))
    assert [file.name for file in tmp_path.iterdir()] == ["a.xodr"]


def test_an_installed_blender_is_enough(monkeypatch, tmp_path):
    monkeypatch.setattr(package, "find_spec", lambda module: None if module == "bpy" else module)
    monkeypatch.setattr(blender_process, "blender_places", lambda _: [tmp_path / "blender"])
    monkeypatch.setattr(blender_process.shutil, "which", lambda _: None)
    monkeypatch.setattr(blender_process, "_fault", lambda _: None)
    assert exports.without_lacking([tmp_path / "a.carla.zip"]) == ((tmp_path / "a.carla.zip",), ())


def loaded(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
