"""`garage2usd export`, `build --with` and `garage2usd.export`."""

import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from importlib.util import find_spec

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd, UsdGeom
from support.foreign_materials import RGB, case, material_stage, primvar, texture
from support.glb_reader import Glb
from support.label_tables import labelled_objects
from support.map_reader import read_map

import garage2usd
from garage2usd.cli import main
from garage2usd.common import package
from garage2usd.common.errors import ConfigError, MissingExtraError, ReportError, StageError
from garage2usd.config.outputs import MapsConfig

SUFFIXES = ".add.xml, .autoware, .carla.zip, .dxf, .geojson, .glb, .osm, .osm.xml, .sdf, .xodr, .xosc, .yaml"
needs_blender = pytest.mark.skipif(find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
QUICK = "[plan]\nepisodes = 200\n"
GRID_FILES = tuple(f"g{mask}.{suffix}" for mask in ("", "_keepout", "_speed") for suffix in ("yaml", "pgm"))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("exports")
    config = folder / "g.toml"
    config.write_text(f"{QUICK}[maps.grid]\nresolution_m = 0.1\nkeepout = true\nspeed = true\n")
    run = CliRunner().invoke(
        main,
        [
            "build",
            str(config),
            "--with",
            "add.xml, dxf, geojson, glb, osm, osm.xml, xodr, xosc, yaml",
            "-o",
            str(folder / "g.usdc"),
        ],
    )
    assert run.exit_code == 0, run.output
    for name in (
        "g.add.xml",
        "g.netccfg",
        "g.dxf",
        "g.geojson",
        "g.glb",
        "g.osm",
        "g.osm.xml",
        "g.xodr",
        "g.xosc",
        *GRID_FILES,
    ):
        assert f"export  {folder / name}" in run.output
    return folder


def test_a_stage_gives_what_the_build_gave(made, tmp_path):
    outputs = [
        tmp_path / "new" / "g.glb",
        *(tmp_path / f"g.{suffix}" for suffix in ("dxf", "geojson", "osm", "osm.xml", "xodr", "xosc")),
    ]
    outputs.append(tmp_path / "other" / "g.yaml")
    settings = garage2usd.load_config(made / "g.toml").maps
    files = garage2usd.export(made / "g.usdc", outputs, settings=settings)
    assert files == (*outputs[:-1], *(outputs[-1].with_name(name) for name in GRID_FILES))
    for file in files:
        assert file.read_bytes() == (made / file.name).read_bytes()


def test_the_command_takes_the_maps_of_a_configuration(made, tmp_path):
    output = tmp_path / "g.yaml"
    for arguments, resolution, files in (
        ([], "0.05", {"g.yaml", "g.pgm"}),
        (["--config", str(made / "g.toml")], "0.1", set(GRID_FILES)),
    ):
        run = CliRunner().invoke(main, ["export", str(made / "g.usdc"), "-o", str(output), *arguments])
        assert run.exit_code == 0, run.output
        assert f"resolution: {resolution}\n" in output.read_text()
        assert {file.name for file in tmp_path.iterdir()} == files


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes are copied on Linux only")
def test_the_command_writes_files_at_a_time_and_the_same(made, tmp_path):
    files = ["g.yaml", "g.xodr", "g.xosc", "g.osm", "g.glb"]
    said = "import sys, garage2usd.common.processes as p; p.ProcessPoolExecutor = lambda *_, **__: sys.exit('copied')\n"
    for workers, code, status in (("3", "", 0), ("1", said, 0), ("2", said, 1)):
        outputs = [part for file in files for part in ("-o", tmp_path / workers / file)]
        command = [sys.executable, "-c", f"{code}from garage2usd.cli import run; run()", "export", made / "g.usdc"]
        options = ["--workers", workers, "--config", made / "g.toml"]
        done = subprocess.run([*command, *options, *outputs], check=False, capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        assert (done.stderr == "copied\n") == bool(status)
    written = {file.name for file in (tmp_path / "3").iterdir()}
    assert written == {*files, *GRID_FILES}
    assert not (tmp_path / "2").exists()
    for name in written:
        by_three, by_one = ((tmp_path / workers / name).read_bytes() for workers in "31")
        assert by_three == by_one == (made / name).read_bytes()


def test_parking_areas_bring_their_map_and_netconvert_s_configuration(made, tmp_path):
    files = garage2usd.export(made / "g.usdc", [tmp_path / "G.Add.XML", tmp_path / "G.xosc"])
    assert [file.name for file in files] == ["G.Add.XML", "G.netccfg", "G.xodr", "G.xosc"]
    areas, configuration, road, _ = files
    assert areas.read_bytes() == (made / "g.add.xml").read_bytes()
    assert road.read_bytes() == (made / "g.xodr").read_bytes()
    options = {element.tag: element.get("value") for element in ET.parse(configuration).getroot().iterfind("*/*")}
    assert options["opendrive-files"] == "G.xodr"
    assert options["offset.disable-normalization"] == "true"
    by_row = garage2usd.export(made / "g.usdc", [tmp_path / "row.add.xml"], settings=MapsConfig(sumo={"areas": "row"}))
    counts = [len(ET.parse(file).getroot()) for file in (areas, by_row[0])]
    assert counts[1] < counts[0]


def test_masks_keep_robots_off_hatched_ground_and_slow_on_ramps(made):
    plain, keepout, speed = (read_map(made / f"g{mask}.yaml") for mask in ("", "_keepout", "_speed"))
    assert plain.cells.shape == keepout.cells.shape == speed.cells.shape
    assert plain.origin == keepout.origin == speed.origin
    stalls = json.loads((made / "g_report.json").read_text())["levels"][0]["stalls"]
    hatched = [stall for stall in stalls if stall["use"] in {"access_aisle", "unreachable"}]
    assert hatched
    for stall in stalls:
        (x, z), half = stall["centre_m"], min(stall["width_m"], stall["length_m"]) / 2 - keepout.side
        within = keepout.within((x - half, -z - half), (x + half, -z + half))
        assert (within == (100 if stall in hatched else 0)).all(), stall["name"]
    ramps = [entry for entry in labelled_objects(made / "g_labels.json") if entry["class"] == "ramp"]
    assert ramps
    for ramp in ramps:
        (x0, _, z0), (x1, _, z1) = ramp["min_m"], ramp["max_m"]
        x, z = (x0 + x1) / 2, (z0 + z1) / 2
        assert (speed.within((x - 0.5, -z - 0.5), (x + 0.5, -z + 0.5)) == 50).all()
    assert set(np.unique(keepout.cells)) == {0, 100}
    assert set(np.unique(speed.cells)) == {0, 30, 50}


def test_a_world_names_the_grid_that_is_asked_for_and_spares_folders_of_others(made, tmp_path):
    files = garage2usd.export(made / "g.usdc", [tmp_path / "a b.yaml", tmp_path / "a b.SDF"])
    names = ["a b.yaml", "a b.pgm", "a b.SDF", "a b.launch.py", "a b_meshes"]
    assert [file.name for file in files] == names == [file.name for file in files if file.exists()]
    assert "'Garage': 'a b.yaml'," in files[3].read_text()
    assert all((tmp_path / uri).is_file() for uri in set(re.findall("<uri>(.*)</uri>", files[2].read_text())))
    (tmp_path / "c_meshes").mkdir()
    (tmp_path / "c_meshes" / "mine.stl").touch()
    with pytest.raises(ConfigError, match="nothing stands but the meshes of an earlier export"):
        garage2usd.export(made / "g.usdc", [tmp_path / "c.sdf"])
    assert [file.name for file in (tmp_path / "c_meshes").iterdir()] == ["mine.stl"]


def test_a_mask_does_not_take_the_place_of_another_map(made, tmp_path):
    settings = garage2usd.load_config(made / "g.toml").maps
    outputs = [tmp_path / "out" / "g.yaml", tmp_path / "out" / "g_speed.yaml"]
    with pytest.raises(ConfigError, match="a file that another one brings with it"):
        garage2usd.export(made / "g.usdc", outputs, settings=settings)
    assert not (tmp_path / "out").exists()


def test_a_report_gives_the_garage_again_with_its_own_settings(made, tmp_path):
    *grid, scene = garage2usd.export(made / "g_report.json", [tmp_path / "g.yaml", tmp_path / "g.glb"])
    assert [file.name for file in grid] == list(GRID_FILES)
    for file in grid:
        assert file.read_bytes() == (made / file.name).read_bytes()
    again, first = (Glb(file.read_bytes()) for file in (scene, made / "g.glb"))
    assert again.json["nodes"] == first.json["nodes"]
    assert again.json["meshes"] == first.json["meshes"]


def test_an_edited_stage_is_exported_as_it_stands(made, tmp_path):
    edited = tmp_path / "edited.usda"
    stage = Usd.Stage.CreateNew(str(edited))
    stage.GetRootLayer().subLayerPaths.append(str(made / "g.usdc"))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.GetPrimAtPath("/Garage"))
    cars = [prim for prim in stage.Traverse() if prim.GetName().startswith("Car_")]
    cars[0].SetActive(False)
    stage.Save()
    scene = Glb(garage2usd.export(edited, [tmp_path / "edited.glb"])[0].read_bytes())
    names = {node["name"] for node in scene.json["nodes"]}
    assert str(cars[0].GetPath()) not in names
    assert str(cars[1].GetPath()) in names


@pytest.mark.parametrize(
    ("source", "outputs", "error", "said"),
    [
        ("g.usdc", ["a.glb", "b.foo"], ConfigError, ".glb, .osm, .osm.xml, .sdf, .xodr, .xosc, .yaml"),
        ("g.usdc", [".glb"], ConfigError, SUFFIXES),
        ("g.usdc", [".add.xml"], ConfigError, SUFFIXES),
        ("g.usdc", ["a.xml"], ConfigError, SUFFIXES),
        ("g.usdc", ["a.add.xml", "a.add.xml"], ConfigError, "each file once"),
        ("g.usdc", ["a.glb", "a.glb"], ConfigError, "each file once"),
        ("g.usdc", [], ConfigError, "one or more"),
        ("g.toml", ["a.glb"], ConfigError, ".usdz, .json"),
        ("g_labels.json", ["a.glb"], ReportError, "report"),
        ("none.usdc", ["a.glb"], StageError, "none.usdc"),
        ("empty.usda", ["a.glb"], StageError, "nothing in it can be drawn"),
        ("empty.usda", ["b.yaml"], StageError, "floor"),
        ("empty.usda", ["b.osm"], StageError, "lane graph"),
        ("empty.usda", ["b.xodr"], StageError, "lane graph"),
        ("empty.usda", ["b.add.xml"], StageError, "lane graph"),
        ("empty.usda", ["b.sdf"], StageError, "nothing in it can be drawn"),
        pytest.param("empty.usda", ["b.carla.zip"], StageError, "lane graph", marks=needs_blender),
    ],
)
def test_what_cannot_be_exported_leaves_no_file(made, tmp_path, source, outputs, error, said):
    (made / "empty.usda").write_text('#usda 1.0\n(defaultPrim = "A")\ndef Xform "A" {}\n')
    folder = tmp_path / "out"
    with pytest.raises(error) as raised:
        garage2usd.export(made / source, [folder / output for output in outputs])
    assert said in str(raised.value)
    assert not folder.exists()


def test_build_refuses_formats_before_it_works(tmp_path):
    run = CliRunner().invoke(main, ["build", "--with", "glb,ifc", "-o", str(tmp_path / "g.usdz")])
    assert run.exit_code == 2
    assert f"allowed: a path that ends in {SUFFIXES}" in run.output
    assert not list(tmp_path.iterdir())


def test_without_pyproj_a_lanelet2_map_is_refused_before_a_garage_is_made(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyproj", None)
    with pytest.raises(MissingExtraError, match=r"pyproj.*pip install .*\[maps\]"):
        garage2usd.export(tmp_path / "none.usdc", [tmp_path / "g.osm"])
    run = CliRunner().invoke(main, ["build", "--with", "osm", "-o", str(tmp_path / "g.usdz")])
    assert run.exit_code != 0
    assert "[maps]" in run.output + str(run.exception)
    assert not list(tmp_path.iterdir())


def test_files_that_need_no_extra_are_written_and_the_others_named(made, tmp_path, monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda module: None if module == "scenariogeneration" else module)
    names = "g.xodr", "g.xosc", "g.osm", "g.yaml", "g.add.xml"
    asked = [word for name in names for word in ("-o", str(tmp_path / name))]
    run = CliRunner().invoke(main, ["export", str(made / "g.usdc"), *asked, "--stall", "A1-01"])
    assert run.exit_code == 3, run.output
    line = run.stderr.splitlines()[-1]
    assert line.startswith(
        f"Error: {tmp_path / 'g.xosc'} is not written: a scenario needs scenariogeneration: pip install"
    )
    assert {file.name for file in tmp_path.iterdir()} == {*names, "g.pgm", "g.netccfg"} - {"g.xosc"}
    config = tmp_path / "small.toml"
    config.write_text('[site]\nstructure = """\n....\nE==X\n....\n"""\n[bay]\ndimensioned = false\n')
    run = CliRunner().invoke(
        main, ["build", str(config), "--with", "xosc,xodr", "-o", str(tmp_path / "new" / "a.usdc")]
    )
    assert run.exit_code == 3, run.output
    assert "a.xosc is not written: a scenario needs" in run.stderr
    assert {file.suffix for file in (tmp_path / "new").iterdir()} == {".usdc", ".xodr", ".png", ".json", ""}


def test_settings_of_maps_that_cannot_be_are_refused():
    with pytest.raises(ConfigError, match=r"maps\.grid"):
        garage2usd.GarageConfig(maps={"grid": {"high_m": 0.05}})
    with pytest.raises(ConfigError, match="latitude"):
        garage2usd.GarageConfig(maps={"latitude_deg": 91.0})
    with pytest.raises(ConfigError, match=r"maps\.sumo\.areas.*'bay', 'row' or 'stall'"):
        garage2usd.GarageConfig(maps={"sumo": {"areas": "lane"}})


def test_what_a_scene_cannot_say_is_named_on_standard_error(tmp_path):
    said = case(texture("T", "nowhere.png"), primvar(), diffuseColor=RGB, displacement=0.5)
    material_stage(tmp_path, said)
    stage = tmp_path / "square.usda"
    run = CliRunner().invoke(main, ["export", str(stage), "-o", str(tmp_path / "a.glb")])
    assert run.exit_code == 0
    assert run.stderr.splitlines() == [
        "a.glb: displacement is left out (1): /W/M",
        "a.glb: textures whose file is missing show their fallback (1): nowhere.png",
    ]
    assert run.stdout.splitlines() == [f"      file  {tmp_path / 'a.glb'}"]
    heard = []
    garage2usd.export(stage, [tmp_path / "b.glb"], notice=heard.append)
    assert [line.partition(": ")[2] for line in heard] == [line.partition(": ")[2] for line in run.stderr.splitlines()]


def test_maps_that_keep_to_the_right_say_so_where_cars_keep_to_the_left(tmp_path):
    settings = {"site": {"width_cells": 6, "height_cells": 6}, "plan": {"episodes": 20, "starts": 1}}
    heard = {}
    for profile in ("uk-istructe", "de-garvo"):
        config = garage2usd.GarageConfig(seed=3, profile={"name": profile}, **settings)
        stage = garage2usd.build(config, tmp_path / f"{profile}.usdc").stage
        said = heard[profile] = []
        garage2usd.export(stage, [tmp_path / "a.xodr", tmp_path / "a.geojson"], notice=said.append)
    (line,) = heard["uk-istructe"]
    assert line.startswith("a.xodr: lanes keep to the right, while cars in this garage keep to the left")
    assert not heard["de-garvo"]
