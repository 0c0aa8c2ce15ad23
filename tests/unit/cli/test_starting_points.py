"""The first commands of a newcomer: the greeting, and garages like those that one knows."""

import json
import shlex
import tomllib
from importlib import resources

import pytest
from click.testing import CliRunner

from garage2usd import check
from garage2usd.cli import main
from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.config.starting_points import STARTING_POINTS, starting_point
from garage2usd.datasets.recipe import recipe_like

FILES = resources.files("garage2usd.config.starting_points")


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def told(name):
    return tomllib.loads((FILES / f"{name}.toml").read_text())


def test_the_program_alone_greets_with_commands_that_exist():
    said = run()
    assert said.exit_code == 0
    commands = [
        shlex.split(line, comments=True) for line in said.output.splitlines() if line.startswith("  garage2usd")
    ]
    assert len(commands) == 3
    for _, name, *words in commands:
        known = {option for parameter in main.commands[name].params for option in parameter.opts}
        assert {word for word in words if word.startswith("-")} <= known


def test_each_file_is_a_starting_point():
    assert {file.name for file in FILES.iterdir() if file.name.endswith(".toml")} == {
        f"{name}.toml" for name in STARTING_POINTS
    }


@pytest.mark.parametrize("name", STARTING_POINTS)
def test_each_is_a_configuration_of_a_country_and_says_what_is_assumed(name):
    settings = told(name)
    varied = settings.pop("vary")
    assert starting_point(name) == config_from_mapping(settings)
    assert starting_point(name).standard.country.lower() == {"uk": "gb"}.get(name[-2:], name[-2:])
    assert "assumed" in (FILES / f"{name}.toml").read_text()
    recipe = recipe_like(name)
    recipe.check()
    garages = [recipe.drawn(recipe.garage_seed(number, 0), number)[0] for number in range(9)]
    assert len({garage.site for garage in garages}) > 1
    assert all(garage.look.drawn for garage in garages)
    assert varied.keys() <= GarageConfig.model_fields.keys()


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name == "office-uk" else [pytest.mark.soak]) for name in STARTING_POINTS]
)
def test_each_is_built_and_nothing_is_found(name, tmp_path):
    made = run("build", "--like", name, "--seed", 5, "-o", tmp_path / "garage.usdc")
    assert made.exit_code == 0, made.output
    findings, profile = check(tmp_path / "garage.usdc")
    assert profile.name == told(name)["profile"]
    assert findings == []
    config = json.loads((tmp_path / "garage_report.json").read_text())["config"]
    assert config["seed"] == 5
    # the same as of a configuration with these settings
    settings = told(name)
    del settings["vary"]
    assert config_from_mapping({**settings, "seed": 5}).digest() == config_from_mapping(config).digest()


def test_another_profile_may_be_designed_to():
    assert starting_point("office-uk", profile="de-garvo").standard.name == "de-garvo"


def test_a_data_set_is_like_one(tmp_path):
    made = run("dataset", "--like", "residential-de", "--count", 2, "--workers", 1, "-o", tmp_path / "set")
    assert made.exit_code == 0, made.output
    lines = (tmp_path / "set" / "manifest.jsonl").read_text().splitlines()
    assert len(lines) == 2


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("build", "--like", "hotel-fr"), "like: got 'hotel-fr'; allowed: one of airport-us, mall-cn"),
        (("dataset", "--like", "hotel-fr", "-o", "set"), "like: got 'hotel-fr'; allowed: one of airport-us, mall-cn"),
        (("build", "--like", ""), "like: got ''; allowed: one of airport-us, mall-cn"),
        (("build", __file__, "--like", "mall-cn"), "either a CONFIG or --like"),
        (("dataset", __file__, "--like", "mall-cn", "-o", "set"), "a RECIPE or --like"),
        (("dataset", "--like", "mall-cn"), "and --output FOLDER"),
    ],
)
def test_what_cannot_be_is_refused(arguments, said):
    done = run(*arguments)
    assert done.exit_code in {1, 2}
    assert said in done.output


def test_a_build_is_shown_where_asked(tmp_path, monkeypatch):
    shown = []
    monkeypatch.setattr(main.commands["view"], "callback", lambda path, **_: shown.append(path))
    plan = tmp_path / "garage.toml"
    plan.write_text('[site]\nstructure = "E=X\\n..."\n')
    for asked in ((), ("--open",)):
        made = run("build", plan, "-o", tmp_path / "garage.usdc", *asked)
        assert made.exit_code == 0, made.output
    assert shown == [tmp_path / "garage.usdc"]
