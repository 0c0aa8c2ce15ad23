import pytest
from click.testing import CliRunner
from pxr import Usd, UsdGeom
from support.glb_reader import Glb

import garage2usd
from garage2usd.cli import main
from garage2usd.errors import ConfigError, ReportError, StageError

QUICK = "[plan]\nepisodes = 200\n"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("exports")
    config = folder / "g.toml"
    config.write_text(f"{QUICK}[maps.grid]\nresolution_m = 0.1\n")
    run = CliRunner().invoke(main, ["build", str(config), "--with", "glb, yaml", "-o", str(folder / "g.usdc")])
    assert run.exit_code == 0, run.output
    for name in ("g.glb", "g.yaml", "g.pgm"):
        assert f"export  {folder / name}" in run.output
    return folder


def test_a_stage_gives_what_the_build_gave(made, tmp_path):
    outputs = [tmp_path / "new" / "g.glb", tmp_path / "other" / "g.yaml"]
    settings = garage2usd.load_config(made / "g.toml").maps
    files = garage2usd.export(made / "g.usdc", outputs, settings=settings)
    assert files == (outputs[0], outputs[1], outputs[1].with_suffix(".pgm"))
    for file in files:
        assert file.read_bytes() == (made / file.name).read_bytes()


def test_the_command_takes_the_maps_of_a_configuration(made, tmp_path):
    output = tmp_path / "g.yaml"
    for arguments, resolution in (([], "0.05"), (["--config", str(made / "g.toml")], "0.1")):
        run = CliRunner().invoke(main, ["export", str(made / "g.usdc"), "-o", str(output), *arguments])
        assert run.exit_code == 0, run.output
        assert f"resolution: {resolution}\n" in output.read_text()


def test_a_report_gives_the_garage_again_with_its_own_settings(made, tmp_path):
    grid, scene = garage2usd.export(made / "g_report.json", [tmp_path / "g.yaml", tmp_path / "g.glb"])[::2]
    assert grid.read_bytes() == (made / "g.yaml").read_bytes()
    assert (tmp_path / "g.pgm").read_bytes() == (made / "g.pgm").read_bytes()
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
        ("g.usdc", ["a.glb", "b.foo"], ConfigError, ".glb, .yaml"),
        ("g.usdc", [".glb"], ConfigError, ".glb, .yaml"),
        ("g.usdc", ["a.glb", "a.glb"], ConfigError, "each file once"),
        ("g.usdc", [], ConfigError, "one or more"),
        ("g.toml", ["a.glb"], ConfigError, ".usdz, .json"),
        ("g_labels.json", ["a.glb"], ReportError, "report"),
        ("none.usdc", ["a.glb"], StageError, "none.usdc"),
        ("empty.usda", ["a.glb"], StageError, "nothing in it can be drawn"),
        ("empty.usda", ["b.yaml"], StageError, "floor"),
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
    assert "allowed: a path that ends in .glb, .yaml" in run.output
    assert not list(tmp_path.iterdir())


def test_settings_of_maps_that_cannot_be_are_refused():
    with pytest.raises(ConfigError, match=r"maps\.grid"):
        garage2usd.GarageConfig(maps={"grid": {"high_m": 0.05}})
    with pytest.raises(ConfigError, match="latitude"):
        garage2usd.GarageConfig(maps={"latitude_deg": 91.0})
