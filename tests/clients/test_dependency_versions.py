"""Every command works with the lowest and the newest versions that `pyproject.toml` allows, on each Python it names.

Environments are made anew by uv, one a test, all in `make soak`.
The digests of plans and all that is text are those of what the tests' own environment makes;
pictures and binary stages differ by what Pillow and USD write.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from support.fresh_environments import EXTRAS, NAMED, PROJECT, WITHOUT_WHEELS, compiled, make_environment, pythons, uv
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.datasets import load_recipe

PYTHONS = pythons()
BY_AGE = sorted(PYTHONS, key=lambda version: int(version.partition(".")[2]))
ENVIRONMENTS = [(version, resolution) for version in BY_AGE for resolution in ("lowest-direct", "highest")]
EXTREMES = [ENVIRONMENTS[0], ENVIRONMENTS[-1]]
"""Environments in which data sets and recordings are made too, which take longer than all else."""
SETTINGS = "seed = 3\n[site]\nwidth_cells = 5\nheight_cells = 5\n[plan]\nepisodes = 100\n"
RECIPE = """
name = "small"
count = 2
[garage.site]
width_cells = { range = [5, 6] }
height_cells = 5
[garage.plan]
episodes = 100
[make]
exports = ["add.xml", "glb", "osm", "xodr", "xosc", "yaml"]
"""
RIG = """
name = "top"
[[sensors]]
kind = "spinning_lidar"
name = "top"
position_m = [0.6, 0.0, 1.8]
elevations_deg = [-20.0, -5.0, 5.0]
azimuth_steps = 180
range_m = [0.5, 50.0]
"""
PLAN_BY_AN_AGENT = """
import gymnasium
environment = gymnasium.make("garage2usd.environment:garage2usd/Lanes-v0")
environment.reset(seed=1)
environment.step(environment.unwrapped.action_space.sample())
cars = gymnasium.make_vec("garage2usd/Parking-v0", num_envs=2, vectorization_mode="vector_entry_point")
cars.reset(seed=1)
cars.step(cars.action_space.sample())
"""
EXPORTS = ("garage.xodr", "garage.xosc", "garage.yaml")
GARAGE = (
    "build small.toml -o garage.usdc",
    "check garage.usdc",
    "plan garage.usdc",
    "drive small.toml -o ways.usda",
    f"export garage.usdc -o garage.glb -o garage.osm {' '.join(f'-o {name}' for name in EXPORTS)}",
)
MANY = (
    "dataset recipe.toml -o set --workers 1",
    "dataset --verify set --workers 1",
    "render garage.usdc --rig rig.toml --along Drive --every-m 20 --also nuscenes,ros2 -o recorded",
)
ALIKE = ("garage_labels.json", "garage_plan.svg", "ways.usda", *EXPORTS)
"""What is the same text with all versions; the last digits of a Lanelet2 map's degrees are PROJ's."""


def runner(binaries, folder):
    """Run a program of an environment in a folder with the inputs; it says no word of warning."""
    for name, text in {"small.toml": SETTINGS, "recipe.toml": RECIPE, "rig.toml": RIG}.items():
        (folder / name).write_text(text)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}

    def run(name, *arguments):
        ran = subprocess.run(
            [binaries / name, *arguments],
            cwd=folder,
            env={**environment, "PYTHONWARNINGS": "default"},
            capture_output=True,
            text=True,
            check=False,
        )
        said = f"{name} {' '.join(arguments)}\n{ran.stdout}\n{ran.stderr}"
        assert ran.returncode == 0, said
        assert "Warning" not in ran.stderr, said
        assert "Traceback" not in ran.stderr, said

    return run


def made(folder):
    """What commands made that is the same with all versions."""
    report = json.loads((folder / "garage_report.json").read_text())
    texts = {name: (folder / name).read_text() for name in ALIKE}
    (level,) = report["levels"]
    return texts | {"config_digest": report["config_digest"], "structure_digest": level["structure_digest"]}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    uv("build", "--wheel", "--no-build-isolation", "--python", sys.executable, "--out-dir", folder, REPOSITORY)
    (file,) = folder.glob("*.whl")
    return file


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """What the tests' own environment makes."""
    folder = tmp_path_factory.mktemp("own")
    run = runner(Path(sys.executable).parent, folder)
    for command in GARAGE:
        run("garage2usd", *command.split())
    return made(folder)


def fresh(version, resolution, wheel, folder):
    """A runner of programs in a new environment, and the folder in which they run."""
    environment = make_environment(folder / "environment", PYTHONS[version], resolution, wheel)
    (folder / "work").mkdir()
    return runner(environment / "bin", folder / "work"), folder / "work"


@pytest.mark.soak
@pytest.mark.client
@pytest.mark.parametrize(("version", "resolution"), ENVIRONMENTS)
def test_all_commands_make_the_same_in_a_fresh_environment(version, resolution, wheel, expected, tmp_path):
    run, folder = fresh(version, resolution, wheel, tmp_path)
    for command in GARAGE:
        run("garage2usd", *command.split())
    run("python", "-c", PLAN_BY_AN_AGENT)
    assert made(folder) == expected


@pytest.mark.soak
@pytest.mark.client
@pytest.mark.parametrize(("version", "resolution"), EXTREMES)
def test_data_sets_and_recordings_are_made_in_a_fresh_environment(version, resolution, wheel, tmp_path):
    run, folder = fresh(version, resolution, wheel, tmp_path)
    for command in (GARAGE[0], *MANY):
        run("garage2usd", *command.split())
    rows = [json.loads(line) for line in (folder / "set" / "manifest.jsonl").read_text().splitlines()]
    recipe = load_recipe(folder / "recipe.toml")
    planned = [garage2usd.generate(recipe.drawn(row["seed"])[0]).plan.structure.digest() for row in rows]
    assert [row["structure_digest"] for row in rows] == planned
    assert len(planned) == recipe.count


@pytest.mark.soak
@pytest.mark.client
@pytest.mark.parametrize("resolution", ["lowest-direct", "highest"])
@pytest.mark.parametrize("version", NAMED)
def test_each_python_that_is_named_has_wheels_of_all_it_needs(version, resolution):
    extras = [extra for extra in (*EXTRAS, "blender") if (version, extra) not in WITHOUT_WHEELS]
    found = compiled(version, resolution, extras, "--only-binary", ":all:")
    assert compiled(version, resolution, extras) == found  # the minima are such that they have some
    assert {"numpy", "usd-core"} <= {line.partition("==")[0] for line in found}


def test_every_word_on_pythons_is_the_same():
    assert PROJECT["requires-python"] == f">={NAMED[0]}"
    candidates = re.search(r"for candidate in (.*); do", (REPOSITORY / "environment.sh").read_text())[1].split()
    assert {*candidates} == {"python3", *(f"python{version}" for version in NAMED)}
