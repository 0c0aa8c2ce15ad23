"""Each command with long work shows on a terminal what it does and the time that is left, and nothing in a pipe."""

import os
import re

import pytest
from support.sample_files import REPOSITORY
from support.small_garage import SETTINGS
from support.soak import soak_but
from support.terminal import in_pipe, on_terminal

import garage2usd

if os.name != "posix":
    pytest.skip("pseudo-terminals are of POSIX", allow_module_level=True)

LEVELS = """
seed = 7
building = {levels = 3}
site = {width_cells = 9, height_cells = 9}
plan = {episodes = 1500, starts = 1}
parking = {occupancy = 0.2}
"""
_BAR = re.compile(r"^ *(\w+)  \[[#-]+\]  (?: *\d+%| *\d+/\d+)(?:  ((?:\d+d )?\d\d:\d\d:\d\d))?")
_NAME = re.compile(r"^ *(\w+) \.\.\.$")
# arguments of a command; steps that are counted with the time left; steps whose time nobody knows
COMMANDS = {
    "build": (["build", "levels.toml", "-o", "made.usdc"], {"plan", "levels", "layout", "assets"}, {"stage", "files"}),
    "check": (["check", "garage.usdc"], {"rules", "driving"}, {"opening"}),
    "traffic": (
        ["traffic", "garage.usdc", "--minutes", "2", "-o", "t.csv", "-o", "t.usda"],
        {"stalls", "traffic", "files"},
        set(),
    ),
    "check of levels": (["check", "levels.usdc"], {"reading", "rules"}, {"opening"}),
    "drive": (["drive", "garage.usdc"], {"driving"}, {"opening"}),
    "drive to a stall": (["drive", "garage.usdc", "--stall", "A1-01"], set(), {"opening", "drive"}),
    "plan": (["plan", "garage.usdc", "--findings", "-o", "p.svg"], {"rules", "driving"}, {"opening"}),
    "plan with the optimum": (["plan", "garage.usdc", "--optimum", "-o", "p.svg"], {"frontiers"}, set()),
    "import": (
        ["import", REPOSITORY / "samples" / "surveys" / "lot.toml", "-o", "lot.usdc"],
        {"driving"},
        {"reading", "files"},
    ),
    "export": (["export", "garage.usdc", "-o", "g.xodr", "-o", "g.glb", "-o", "g.yaml"], {"export"}, {"reading"}),
    "dataset": (["dataset", "--like", "residential-de", "--count", "3", "-o", "set"], set(), set()),
    "meshes": (["meshes", "baked"], {"shapes"}, set()),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bars")
    garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "garage.usdc")
    (folder / "levels.toml").write_text(LEVELS)
    return folder


@pytest.mark.parametrize("name", soak_but(["build", "check", "traffic"], COMMANDS))
def test_it_shows_bars_with_the_time_left_on_a_terminal_and_none_in_a_pipe(name, folder):
    arguments, counted, unknown = COMMANDS[name]
    if "levels.usdc" in arguments:
        garage2usd.build(garage2usd.load_config(folder / "levels.toml"), folder / "levels.usdc")
    code, lines = on_terminal(arguments, folder=folder)
    assert code in {0, 1}
    bars = [found for found in map(_BAR.match, lines) if found]
    shown, left = {found[1] for found in bars}, {found[1] for found in bars if found[2]}
    assert counted <= left, f"no time left for {counted - left}, of {shown}"
    assert shown or unknown
    assert unknown <= {found[1] for found in map(_NAME.match, lines) if found}
    assert not any("0%" in line and line.split()[0] in unknown for line in lines)
    code, text = in_pipe(redone(arguments), folder=folder)
    assert code in {0, 1}
    # work of more than ten seconds may say in a line how far it is
    assert not re.search(r"\r|\[[#-]+\]| \.\.\.", text), text


def redone(arguments):
    """The command again, with another folder where the first one has to be new."""
    return ["again" if argument == "set" else argument for argument in arguments]
