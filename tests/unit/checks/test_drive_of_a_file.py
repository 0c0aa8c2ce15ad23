"""`garage2usd drive` of a stage that is there already, and of its report."""

import json

import pytest
from click.testing import CliRunner
from support.small_garage import SETTINGS, with_trolley

from garage2usd import GarageConfig, build
from garage2usd.cli import main


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("driven") / "small.usda")


def driven(path, *options):
    return CliRunner().invoke(main, ["drive", str(path), *options])


def test_a_stage_and_its_report_have_the_same_ways(made, tmp_path):
    ways = []
    for number, path in enumerate((made.stage, made.report)):
        result = driven(path, "-o", str(tmp_path / f"{number}.json"))
        assert (result.exit_code, result.stdout.splitlines()[0]) == (
            0,
            "11 of 11 stalls are driven into and out of without a touch",
        )
        ways.append(json.loads((tmp_path / f"{number}.json").read_text())["stalls"])
    clearances_m = [[stall[leg].pop("clearance_m") for stall in found for leg in ("in", "out")] for found in ways]
    assert ways[0] == ways[1]
    # a lower bound by steps, of outlines that a stage has in single precision
    assert clearances_m[0] == pytest.approx(clearances_m[1], abs=1e-4)


def test_what_was_put_into_a_stage_is_driven_around_or_named(made, tmp_path):
    result = driven(with_trolley(made.stage, tmp_path / "edited.usdc", label="static"))
    assert result.exit_code == 1
    assert "Stall_r00_c01_2: no way; in the way: /Garage/Trolley" in result.stdout


def test_a_garage_that_is_made_takes_no_seed(made):
    result = driven(made.stage, "--seed", "3")
    assert result.exit_code != 0
    assert "this garage is made already" in result.output + str(result.exception)
