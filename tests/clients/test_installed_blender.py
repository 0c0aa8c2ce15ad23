"""`render` by an installed Blender: a program that runs the module `bpy` stands in for it and takes the same words."""

import importlib.util
import os
import stat
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.cli import main
from garage2usd.common import package, system
from garage2usd.common.errors import ConfigError, MissingExtraError
from garage2usd.render import Picture, blender_process, drawing, render_stage
from garage2usd.render.blender_process import BLENDER_MODULE, Blender, find_blender

PROGRAM = """#!{python}
import runpy, sys
sys.argv[0] = "blender"
words = sys.argv[1:]
if "--version" in words:
    print("Blender {version}\\n\\tbuild date: 2026-01-01")
    sys.exit(0)
assert words[:5] == ["--background", "--factory-startup", "--disable-autoexec", "--python-exit-code", "1"], words
assert words[5] == "--python" and "--" in words, words
print("Blender {version}", flush=True)
runpy.run_path(words[6], run_name="__main__")
print("Blender quit")
"""


@pytest.fixture(autouse=True)
def _forget():
    blender_process._fault.cache_clear()


def program(place, version="5.0.1", text=PROGRAM):
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(text.format(python=sys.executable, version=version))
    place.chmod(place.stat().st_mode | stat.S_IXUSR)
    return place


@pytest.fixture
def without_module(monkeypatch):
    """No module `bpy`, and no Blender on the path or elsewhere."""
    monkeypatch.setattr(package, "find_spec", lambda name: None if name == "bpy" else name)
    monkeypatch.setattr(blender_process, "blender_places", lambda _environment: [])
    monkeypatch.setenv("PATH", "")


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("installed") / "small.usdc")


@pytest.mark.client
@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_a_program_draws_what_the_module_draws_and_tells_how_far_a_picture_is(made, tmp_path, monkeypatch):
    monkeypatch.setattr(drawing, "_TILE_PX", 32)
    asked = {"cameras": ["Inside"], "size_px": (64, 36), "samples": 8, "pictures": (Picture.COLOUR, Picture.DEPTH)}
    installed = program(tmp_path / "Blender 5.0" / "blender")
    told = []
    by_program = render_stage(
        made.stage, tmp_path / "program", blender=installed.parent, progress=lambda *now: told.append(now), **asked
    )
    by_module = render_stage(made.stage, tmp_path / "module", **asked)
    one, other = (np.asarray(Image.open(each.folder / "colour" / "Inside.png")) for each in (by_program, by_module))
    assert (one == other).all()
    assert one.max() > 0
    drawn = [done for step, done, _ in told if step == "render"]
    assert drawn == sorted(drawn)
    assert {0, 2, 4, 6, 8, 9} <= {*drawn}  # a picture of four tiles
    assert told[-1] == ("render", 9, 9)


def test_a_path_that_is_no_blender_is_an_error_in_one_line(made, tmp_path):
    (tmp_path / "empty").mkdir()
    says_nothing = program(tmp_path / "other", text="#!/bin/sh\nexit 0\n")
    no_program = tmp_path / "text"
    no_program.write_text("no program")
    for path, said in (
        (tmp_path / "missing", "there is no such file"),
        (tmp_path / "empty", "there is no such file"),
        (no_program, "it does not start (Permission denied)"),
        (says_nothing, "it does not say that it is Blender"),
        (program(tmp_path / "old" / "blender", "4.5.3 LTS"), "this is 4.5"),
    ):
        run = CliRunner().invoke(main, ["render", str(made.stage), "-o", str(tmp_path / "out"), "--blender", str(path)])
        assert run.exit_code == 1
        (line,) = run.output.strip().splitlines()
        assert line == f"Error: blender: got '{path}'; allowed: the program of Blender 5.0 or later; {said}"
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("without_module")
def test_one_on_the_path_and_then_the_newest_elsewhere_is_found(tmp_path, monkeypatch):
    with pytest.raises(MissingExtraError, match=r"or a Blender 5\.0 or later that is installed: --blender names"):
        package.require("render", blender_process.modules_of(find_blender()), without=blender_process.WITHOUT_MODULE)
    old, new = program(tmp_path / "blender-4.2" / "blender", "4.2.0"), program(tmp_path / "b" / "blender", "5.1.0")
    monkeypatch.setattr(blender_process, "blender_places", lambda _environment: [old, new])
    assert find_blender() == Blender(new)
    on_path = program(tmp_path / "bin" / "blender", "5.0.0")
    monkeypatch.setenv("PATH", str(on_path.parent))
    assert find_blender() == Blender(on_path)
    assert blender_process.modules_of(find_blender()) == ("OpenEXR",)


def test_the_module_comes_before_programs(tmp_path, monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda name: name)
    monkeypatch.setenv("PATH", str(program(tmp_path / "blender").parent))
    assert find_blender() == BLENDER_MODULE
    with pytest.raises(ConfigError, match="no such file"):
        find_blender(tmp_path / "none")


@pytest.mark.parametrize(
    ("platform", "environment", "places"),
    [
        ("win32", {"ProgramFiles": "{}"}, ["Blender Foundation/Blender {}/blender.exe"]),
        ("darwin", {"HOME": "{}"}, ["Applications/Blender {}.app/Contents/MacOS/Blender"]),
    ],
)
def test_the_usual_places_of_a_system_are_looked_at_newest_first(tmp_path, monkeypatch, platform, environment, places):
    made = [tmp_path / place.format(version) for place in places for version in ("5.0", "10.0", "5.1")]
    for place in made:
        place.parent.mkdir(parents=True)
        place.touch()
    monkeypatch.setattr("garage2usd.common.system.sys.platform", platform)
    found = system.blender_places({name: value.format(tmp_path) for name, value in environment.items()})
    monkeypatch.undo()
    assert [path for path in found if path.is_relative_to(tmp_path)] == [made[1], made[2], made[0]]
    assert all(isinstance(path, Path) for path in system.blender_places(os.environ))


def test_an_application_and_a_folder_name_their_program(tmp_path):
    inner = program(tmp_path / "Blender.app" / "Contents" / "MacOS" / "Blender")
    assert find_blender(tmp_path / "Blender.app") == Blender(inner)
