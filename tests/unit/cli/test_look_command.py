"""What ``garage2usd look`` prints is the look that a seed draws, and a configuration takes it back."""

import json
import tomllib

import pytest
from click.testing import CliRunner
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.cli import main
from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.config.look import LookConfig
from garage2usd.look import drawn_look

LOOKS = REPOSITORY / "samples" / "recipes" / "looks.toml"


def told(*arguments):
    run = CliRunner().invoke(main, ["look", *map(str, arguments)])
    assert run.exit_code == 0, run.output
    return tomllib.loads(run.stdout)


@pytest.mark.parametrize("seed", [0, 7, 2**40])
def test_a_look_that_was_told_is_the_same_look_when_it_is_given(seed):
    drawn = drawn_look(LookConfig(drawn=True), seed)
    text = told("--seeds", seed)
    assert config_from_mapping(text).look.model_dump() == drawn.model_dump()
    axes = {f"{group}.{axis}" for group, values in text["look"].items() for axis in values}
    assert axes == set(LookConfig(drawn=True).axes)


def test_the_look_of_a_configuration_has_what_it_gives(tmp_path):
    (tmp_path / "garage.toml").write_text('seed = 5\n[look]\ndrawn = ["floor"]\n[look.markings]\ncolour = "yellow"\n')
    look = config_from_mapping(told(tmp_path / "garage.toml")).look
    assert look == drawn_look(LookConfig(drawn=["floor"], markings={"colour": "yellow"}), 5)
    assert look.columns == LookConfig().columns


def test_a_garage_of_a_recipe_has_its_look():
    look = config_from_mapping(told(LOOKS, "--seeds", 1)).look
    assert look.floor != config_from_mapping(told(LOOKS, "--seeds", 2)).look.floor


def test_the_report_has_the_look_that_was_drawn(tmp_path):
    config = GarageConfig(seed=3, site={"width_cells": 4, "height_cells": 4}, look={"drawn": True})
    report = json.loads(garage2usd.build(config, tmp_path / "garage.usdc").report.read_text())
    assert LookConfig(**report["levels"][0]["look"]) == drawn_look(config.look, 3)


def test_several_looks_are_told_by_pictures_alone():
    run = CliRunner().invoke(main, ["look", "--seeds", "0:2"])
    assert run.exit_code == 2
    assert "--contact-sheet" in run.output
    assert CliRunner().invoke(main, ["look", "--seeds", "3:1"]).exit_code == 2
