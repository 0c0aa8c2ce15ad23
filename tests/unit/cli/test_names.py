"""Paths that mean something to shells, to USD, to YAML or to XML are paths like any other."""

import json
import os
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import yaml
from click.testing import CliRunner
from support.soak import soak_but

import garage2usd
from garage2usd.cli import main
from garage2usd.common.documents import is_file
from garage2usd.common.errors import StageError
from garage2usd.reading.files import open_stage
from garage2usd.view.viewer import read_scene

# of this seed the first stall has a drive; of seed 0 the last one that is tried, which takes each scenario five seconds
QUICK = "seed = 4\n[site]\nwidth_cells = 4\nheight_cells = 4\n[plan]\nepisodes = 40\n[maps.grid]\nresolution_m = 0.5\n"
NAMES = [("*?]b[ q'\"{%d}%20#~$&<a>é😀", "usdz"), ("anon:a", "usdc")]
NOT_UTF8, CONTROL = "a\udcff\udcfe", "a\x01\nb\x85"


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A garage as a package and as layers beside each other, by extension."""
    folder = tmp_path_factory.mktemp("built")
    config = folder / "g.toml"
    config.write_text(QUICK)
    for extension in ("usdz", "usdc"):
        garage2usd.build(garage2usd.load_config(config), folder / extension / f"g.{extension}")
    return folder


def copied(built, extension, folder, name):
    """A stage of a built garage under another name, with what stands beside it; layers refer to their own folder."""
    folder.mkdir(parents=True)
    for path in (built / extension).iterdir():
        if path.is_dir():
            shutil.copytree(path, folder / path.name)
        else:
            shutil.copyfile(path, folder / path.name.replace("g", name, 1))
    shutil.copyfile(built / "g.toml", folder / f"{name}.toml")
    return folder / f"{name}.{extension}"


def run(*arguments):
    """Run a command; a path begins with no dash."""
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def succeeded(*arguments):
    done = run(*arguments)
    assert done.exit_code == 0, (arguments, done.output, done.exception)
    return done.output


@pytest.mark.parametrize(("name", "extension"), soak_but(1, NAMES))
def test_every_command_reads_and_writes_any_name(built, tmp_path, name, extension):
    stage = copied(built, extension, tmp_path / name, name)
    out = tmp_path / "out" / name
    assert run("check", stage).output == run("check", built / extension / f"g.{extension}").output
    succeeded("drive", stage, "-o", out / f"{name}.json")
    succeeded("plan", stage, "-o", out / f"{name}.svg")
    exported = [out / f"{name}.{suffix}" for suffix in ("glb", "xodr", "xosc", "yaml")]
    succeeded("export", stage, *(word for file in exported for word in ("-o", file)))
    plain = garage2usd.export(built / extension / f"g.{extension}", [tmp_path / "plain" / "g.glb"])[0]
    assert exported[0].read_bytes() == plain.read_bytes()
    assert ET.parse(exported[1]).find("header").get("name") == name
    assert ET.parse(exported[2]).find("RoadNetwork/LogicFile").get("filepath") == f"{name}.xodr"
    said = yaml.safe_load(exported[3].read_text(encoding="utf-8"))
    assert is_file(out / said["image"])
    seen, expected = (read_scene(open_stage(path), path) for path in (stage, built / extension / f"g.{extension}"))
    assert seen.counts() == expected.counts()
    report = stage.with_name(f"{name}_report.json")
    succeeded("export", report, "-o", out / "of_report.glb")
    assert (out / "of_report.glb").read_bytes()[:4] == b"glTF"
    if extension == "usdz":
        config = stage.with_name(f"{name}.toml")
        succeeded("build", config, "-o", out / "b" / f"{name}.usda")
        assert run("check", out / "b" / f"{name}.usda").exit_code == 0


@pytest.mark.parametrize("name", soak_but(1, [NOT_UTF8, CONTROL]))
def test_a_name_that_usd_cannot_say_is_refused_in_one_line(built, tmp_path, name):
    stage = copied(built, "usdz", tmp_path / "in", name)
    out = tmp_path / "out"
    for command, *options in (
        ["check"], ["drive"], ["export", "-o", out / "a.glb"], ["render", "-o", out], ["view", "--no-browser"],
    ):  # fmt: skip
        done = run(command, stage, *options)
        assert done.exit_code == 1, (command, done.output, done.exception)
        (line,) = done.output.splitlines()
        assert "not in UTF-8, or has control characters" in line
    for path in (f"{name}.usda", f"{name}.glb"):
        command = (
            ["build", stage.with_suffix(".toml")] if path.endswith("usda") else ["export", built / "usdz" / "g.usdz"]
        )
        done = run(*command, "-o", out / path)
        assert done.exit_code == 2, (done.output, done.exception)
        assert "a file name in UTF-8 without" in done.output
    assert not out.exists()
    folder = tmp_path / "in" / name
    folder.mkdir()
    shutil.copyfile(built / "usdz" / "g.usdz", folder / "g.usdz")
    with pytest.raises(StageError, match="not in UTF-8, or has control characters"):
        open_stage(folder / "g.usdz")


@pytest.mark.soak
@pytest.mark.parametrize("name", [NOT_UTF8, CONTROL])
def test_what_needs_no_usd_takes_any_name(built, tmp_path, name):
    stage = copied(built, "usdz", tmp_path / "in", name)
    report, out = stage.with_name(f"{name}_report.json"), tmp_path / "out"
    for arguments in (
        ["check", report], ["plan", report, "-o", out / f"{name}.svg"],
        ["export", report, "-o", out / "a.xodr", "-o", out / "a.osm"],
    ):  # fmt: skip
        done = in_program(*arguments, capture_output=True)
        assert (done.returncode, done.stderr) == (0, b"")
    for file in ("a.xodr", "a.osm"):
        ET.parse(out / file)
    assert {path.suffix for path in out.iterdir()} == {".svg", ".xodr", ".osm"}


@pytest.mark.soak
def test_endings_in_capitals_are_those_in_small_letters(built, tmp_path):
    config = tmp_path / "C.TOML"
    shutil.copyfile(built / "g.toml", config)
    for extension in ("usdz", "usdc", "usda"):
        stage = tmp_path / f"{extension}.{extension.upper()}"
        succeeded("build", config, "-o", stage)
        succeeded("check", stage)
    stage = tmp_path / "usdz.USDZ"
    assert (
        stage.read_bytes()
        == garage2usd.build(garage2usd.load_config(config), tmp_path / "b" / "usdz.usdz").stage.read_bytes()
    )
    exports = [tmp_path / f"E.{suffix}" for suffix in ("GLB", "OSM", "XOSC", "XODR", "YAML")]
    succeeded("export", stage, *(word for file in exports for word in ("-o", file)))
    assert {path.name for path in tmp_path.glob("E.*")} == {*(path.name for path in exports), "E.pgm"}
    assert ET.parse(exports[2]).find("RoadNetwork/LogicFile").get("filepath") == "E.XODR"
    for path in (exports[0], exports[3]):
        (small,) = garage2usd.export(stage, [tmp_path / "small" / path.name.lower()])
        assert small.read_bytes() == path.read_bytes()
    report = tmp_path / "R.JSON"
    shutil.copyfile(tmp_path / "usdz_report.json", report)
    for source in (stage, report, config):
        succeeded("plan", source, "-o", tmp_path / "P.SVG", "-o", tmp_path / "P.PNG")
        succeeded("drive", source, "-o", tmp_path / "W.JSON")
    succeeded("check", report)
    succeeded("drive", stage, "-o", tmp_path / "W.USDC")
    assert (tmp_path / "W.USDC").read_bytes()[:8] == b"PXR-USDC"
    assert (tmp_path / "P.PNG").read_bytes()[:4] == b"\x89PNG"
    assert json.loads((tmp_path / "W.JSON").read_text())
    profile = tmp_path / "MINE.TOML"
    profile.write_text('name = "mine"\n')
    done = run("check", stage, "--profile", profile)
    assert "a path that ends in .toml" not in done.output


def in_program(*arguments, **options):
    """Run the program itself, as a terminal does."""
    command = [sys.executable, "-m", "garage2usd", *map(str, arguments)]
    return subprocess.run(command, check=False, timeout=100, **options)


@pytest.mark.parametrize("unbuffered", soak_but(1, ["", "1"]))
@pytest.mark.parametrize("encoding", soak_but(["ascii", "utf-16"], ["ascii", "latin-1", "cp1252", "utf-16"]))
def test_a_terminal_of_another_encoding_is_told_in_one_line(built, tmp_path, encoding, unbuffered):
    out = tmp_path / "Ж😀.svg"
    environment = {**os.environ, "PYTHONIOENCODING": encoding, "PYTHONUNBUFFERED": unbuffered}
    done = in_program("plan", built / "usdz" / "g_report.json", "-o", out, env=environment, capture_output=True)
    assert done.returncode == 0, done.stderr
    said = "utf-8" if encoding == "ascii" else encoding  # click takes ASCII for a terminal that was not set up
    assert len(done.stdout.decode(said).splitlines()) == 1
    assert out.read_text().rstrip().endswith("</svg>")
    done = in_program("check", tmp_path / "Ж\udcff.usdz", env=environment, capture_output=True)
    assert done.returncode == 1
    (line,) = done.stderr.decode(said).splitlines()
    assert line.startswith("Error: PATH: got")


@pytest.mark.parametrize(
    ("arguments", "unbuffered"),
    [
        (["--version"], ""),
        (["schema"], "1"),
        (["check", "REPORT"], ""),
        (["check", "REPORT", "--json"], "1"),
        (["plan", "REPORT", "-o", "OUT"], ""),
    ],
)
def test_a_full_standard_output_is_one_line_and_files_are_whole(built, tmp_path, arguments, unbuffered):
    out = tmp_path / "a.svg"
    words = {"REPORT": built / "usdz" / "g_report.json", "OUT": out}
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    command = [words.get(word, word) for word in arguments]
    with Path("/dev/full").open("w") as full:
        done = in_program(*command, stdout=full, stderr=subprocess.PIPE, env=environment)
    assert (done.returncode, done.stderr) == (1, b"Error: standard output: No space left on device\n")
    if "OUT" in arguments:
        assert out.read_text().rstrip().endswith("</svg>")


@pytest.mark.parametrize("closed", soak_but([1], [0, 1, 2]))
def test_a_stream_that_is_closed_loses_what_goes_there(built, tmp_path, closed):
    out = tmp_path / "a.xodr"
    program = [sys.executable, "-m", "garage2usd", "export", str(built / "usdz" / "g.usdz"), "-o", str(out)]
    shell = ["sh", "-c", f'exec "$@" {closed}>&-', "sh", *program]
    done = subprocess.run(shell, check=False, capture_output=True, timeout=100)
    assert (done.returncode, done.stderr) == (0, b"")
    assert ET.parse(out).find("header") is not None


@pytest.mark.parametrize(
    ("arguments", "code"), [(["build", "--sed", "1"], 2), (["build", "-o", "a@b.usda"], 2), (["check", "a.usda"], 1)]
)
def test_a_full_standard_error_changes_no_exit_code(arguments, code):
    with Path("/dev/full").open("w") as full:
        assert in_program(*arguments, stderr=full).returncode == code


@pytest.mark.parametrize(
    "taken", ["g.usdc", "g_plan.png", "g_labels.json", "g_report.json", "g.glb", "g.pgm", "g_keepout.yaml", "g.xodr"]
)
def test_a_folder_in_the_place_of_a_file_is_refused_before_the_work(built, tmp_path, taken):
    (tmp_path / taken).mkdir()
    config = tmp_path / "c.toml"
    config.write_text(f"{QUICK.replace('40', '1000000')}keepout = true\n")  # would plan for minutes
    done = run("build", config, "--with", "glb,yaml,xosc", "-o", tmp_path / "g.usdc")
    assert done.exit_code == 2, done.output
    assert done.output == f"Error: output: got {str(tmp_path / taken)!r}; allowed: a path at which no folder stands\n"
    assert {path.name for path in tmp_path.iterdir()} == {taken, "c.toml"}


@pytest.mark.parametrize(
    ("command", "taken"),
    [
        (["drive", "STAGE", "-o", "w.json"], "w.json"),
        (["plan", "STAGE", "-o", "p.svg"], "p.svg"),
        (["export", "STAGE", "-o", "a.xodr", "-o", "a.yaml"], "a.pgm"),
        (["export", "STAGE", "-o", "a.osm", "-o", "a.xosc"], "a.xodr"),
        (["meshes", "."], "meshes.npz"),
        (["render", "STAGE", "-o", "."], "frames.json"),
    ],
)
def test_every_command_refuses_a_folder_in_the_place_of_a_file(built, tmp_path, monkeypatch, command, taken):
    monkeypatch.chdir(tmp_path)
    (tmp_path / taken).mkdir()
    done = run(*(built / "usdz" / "g.usdz" if word == "STAGE" else word for word in command))
    assert done.exit_code == 2, (done.output, done.exception)
    assert taken in done.output.splitlines()[-1]
    assert [path.name for path in tmp_path.iterdir()] == [taken]
    assert not list((tmp_path / taken).iterdir())


@pytest.mark.parametrize("output", [".", "/"])
def test_an_output_without_a_name_is_refused_with_and_without_exports(output):
    for exports in ([], ["--with", "glb"]):
        done = run("build", *exports, "-o", output)
        assert done.exit_code == 2, (done.output, done.exception)
        (line,) = done.output.splitlines()
        assert line.startswith(f"Error: output: got {output!r}")
