"""Imports of files with levels: a garage of all of them, or of one."""

import json
from dataclasses import replace

import pytest
from click.testing import CliRunner
from support.levels_osm import OsmFile, add_level

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.garage_sources import check, drive, read_built
from garage2usd.imports import import_layout
from garage2usd.survey.reader import read_building

OF_THE_SURVEY = {"stall-length", "portal-distance", "lane-illuminance"}


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    osm = OsmFile()
    for name in ("0", "-1"):
        add_level(osm, name)
    osm.way([(-2, -2), (50, -2), (50, 20), (-2, 20), (-2, -2)], amenity="parking")
    return osm.write(tmp_path_factory.mktemp("levels") / "bare.osm")


@pytest.fixture(scope="module")
def made(source, tmp_path_factory):
    return import_layout(source, tmp_path_factory.mktemp("bare") / "bare.usdc")


def test_levels_that_no_ramp_joins_are_placed_and_named(made):
    assert [(level.name, level.source_name, level.floor_m) for level in made.garage.levels] == [
        ("U1", "0", 0.0),
        ("U2", "-1", -3.6),
    ]
    assert [level.layout.parking_stalls for level in made.garage.levels] == [12, 12]
    assert [remark.split(" is ")[0] for remark in made.remarks if "placed alone" in remark] == [
        "level 0 (U1)",
        "level -1 (U2)",
    ]
    assert {proof.outcome.value for proof in made.proofs} == {"reached"}
    assert len(made.proofs) == 24
    report = json.loads(made.report.read_text())
    assert [level["source_name"] for level in report["levels"]] == ["0", "-1"]
    assert [len([stall for stall in level["stalls"] if stall["proof"] == "reached"]) for level in report["levels"]] == [
        12,
        12,
    ]
    assert set(made.remarks) <= set(report["remarks"])


def test_the_stage_of_levels_is_read_checked_and_driven(made):
    assert {finding.rule for finding in check(made.stage)[0] if finding.severity == "error"} <= OF_THE_SURVEY
    built = read_built(made.stage).garage
    assert [level.place.floor_m for level in built.levels] == [0.0, -3.6]
    assert built.faults == ()
    found = drive(made.stage, "U2/3")
    assert found.route.stall.startswith("U2/")
    height_m = found.trajectory.y_m
    assert (height_m.min(), height_m[0], height_m[-1]) == pytest.approx((-3.6, -0.3, -0.3), abs=0.2)


def test_one_level_is_picked_by_its_name(source, tmp_path):
    ran = CliRunner().invoke(
        main, ["import", str(source), "--level", "-1", "--no-proofs", "-o", str(tmp_path / "one.usdc")]
    )
    assert ran.exit_code == 0, ran.output
    report = json.loads((tmp_path / "one_report.json").read_text())
    assert [(level["name"], level["source_name"]) for level in report["levels"]] == [("U1", "-1")]
    ran = CliRunner().invoke(main, ["import", str(source), "--level", "4", "-o", str(tmp_path / "four.usdc")])
    assert ran.exit_code == 1
    assert "level: got '4'; allowed: 0, -1" in ran.output


@pytest.mark.parametrize(("heights_m", "floors_m", "said"), [((7.0, 4.0), [0, -3], 2), ((7.0, 5.0), [0, -3.6], 3)])
def test_floors_have_the_heights_of_the_file_if_cars_have_room(source, tmp_path, heights_m, floors_m, said):
    building = read_building(source)
    levels = zip(building.in_order, heights_m, strict=True)
    building = replace(building, levels=tuple(replace(level, height_m=height_m) for level, height_m in levels))
    made = import_layout(building, tmp_path / "high.usdc", proves=False)
    assert [level.floor_m for level in made.garage.levels] == floors_m
    assert sum("doors are added" not in remark for remark in made.remarks) == said
    for level, below in zip(made.garage.levels, made.garage.levels[1:], strict=False):
        ceiling = below.layout.of_kind("ceiling")[0]
        assert below.floor_m + ceiling.position_m[1] + ceiling.spec.thickness_m == pytest.approx(level.floor_m)


def test_a_level_that_cannot_be_laid_out_is_left_out(source, tmp_path):
    building = read_building(source)
    upper, lower = building.in_order
    empty = replace(upper, name="2", ordinal=2.0, survey=replace(upper.survey, stalls=()))
    made = import_layout(
        replace(building, levels=(lower, empty, upper)), tmp_path / "a.usdc", config=GarageConfig(), proves=False
    )
    assert [level.source_name for level in made.garage.levels] == ["0", "-1"]
    assert made.remarks[0] == "level 2 is left out: it has no stall"
    with pytest.raises(ConfigError, match="stall"):
        import_layout(replace(building, levels=(empty,)), tmp_path / "b.usdc")
