"""Garages of layouts that others made: files, geometry and messages."""

import json
import math
import re
from collections import Counter

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from pxr import Usd
from support.sample_files import REPOSITORY

from garage2usd import GarageConfig
from garage2usd.checks import RULES, usd
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.garage_sources import read_built
from garage2usd.imports import import_layout
from garage2usd.survey.survey import PortalKind, Survey, SurveyedLane, SurveyedPortal, SurveyedStall

LOT = REPOSITORY / "samples/surveys/lot.toml"


def corners(left, top, width, depth):
    return ((left, top), (left + width, top), (left + width, top + depth), (left, top + depth))


def l_shaped():
    """A garage around a corner with two kinds of stall and a portal for both directions."""
    outline = ((0.0, 0.0), (44.0, 0.0), (44.0, 16.0), (16.0, 16.0), (16.0, 40.0), (0.0, 40.0))
    stalls = [
        SurveyedStall(f"n{n}", ((8 + 2.5 * n, 0), (10.5 + 2.5 * n, 0), (10.5 + 2.5 * n, 5), (8 + 2.5 * n, 5)))
        for n in range(12)
    ]
    stalls += [
        SurveyedStall(f"w{n}", ((0, 10 + 6 * n), (2.4, 10 + 6 * n), (2.4, 16 + 6 * n), (0, 16 + 6 * n)))
        for n in range(4)
    ]
    lanes = (SurveyedLane(((5.4, 36.0), (5.4, 8.0), (40.0, 8.0)), 6.0),)
    return Survey(tuple(stalls), lanes, portals=(SurveyedPortal((44.0, 8.0), PortalKind.BOTH),), outline=outline)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return import_layout(l_shaped(), tmp_path_factory.mktemp("import") / "l.usdc", config=GarageConfig(seed=4))


def test_all_stalls_are_where_they_were_drawn(made):
    assert made.garage.layout.source.unplaced == ()
    drawn = {stall.name: shapely.Polygon(stall.corners) for stall in l_shaped().stalls}
    assert len(made.garage.layout.source.fitted) == len(drawn) == len(made.garage.layout.quads)
    for source, stall in zip(made.garage.layout.source.fitted, made.garage.layout.quads, strict=True):
        assert stall.polygon.hausdorff_distance(drawn[source.source.name]) < 1e-3
    assert Counter(stall.kind.value for stall in made.garage.layout.quads) == {"perpendicular": 12, "parallel": 4}


def test_the_stage_is_found_to_be_what_the_import_said(made):
    garage, profile, *_ = read_built(made.stage)
    rules = (rule for rule in RULES if rule not in usd.BOOK.rules)
    found = Counter(finding.rule for rule in rules for finding in rule.findings(garage.levels[0], profile))
    assert Counter(finding.rule for finding in made.findings) == found


def test_walls_and_doors_close_the_outline(made):
    outline = shapely.Polygon(made.garage.layout.source.survey.outline)
    walls = [place for kind in ("wall", "portal") for place in made.garage.layout.of_kind(kind)]
    solid = shapely.union_all([shapely.Polygon(ground) for wall in walls for ground in wall.outlines()])
    opened = outline.exterior.difference(solid.buffer(0.01))
    # what is open is a door for both directions, which leads onto a ramp
    assert made.garage.layout.counts()["portal"] == made.garage.layout.counts()["ramp"] == 1
    assert opened.length == pytest.approx(
        sum(w.spec.door_width_m - 0.16 for w in walls if hasattr(w.spec, "door_width_m")), abs=0.1
    )
    assert solid.intersection(outline).area < 0.2
    assert all(x == pytest.approx(44) for x, _ in shapely.get_coordinates(opened))
    ways = {node.kind: node.position for node in made.garage.layout.source.network.nodes if node.is_portal}
    # drivers who come in from the east keep to the right, which is north
    assert ways["entrance"][1] < ways["exit"][1]


def test_the_floor_is_one_sheet_inside_the_outline(made):
    outline = shapely.Polygon(made.garage.layout.source.survey.outline)
    panels = []
    for place in [*made.garage.layout.of_kind("floor"), *made.garage.layout.of_kind("stall")]:
        ground = place.spec.ground.difference(
            shapely.union_all([shapely.Polygon(hole) for hole in place.spec.openings])
        )
        panels += [
            shapely.Polygon([place.to_world(point) for point in part.exterior.coords])
            for part in shapely.get_parts(ground)
        ]
    assert sum(panel.area for panel in panels) == pytest.approx(outline.area, abs=0.3)
    assert shapely.union_all(panels, grid_size=1e-4).symmetric_difference(outline).area < 0.3


def test_every_stall_is_driven(made):
    assert {proof.stall for proof in made.proofs if proof.is_proven} == {
        stall.name for stall in made.garage.layout.quads
    }


def test_cars_stand_in_their_stalls(made):
    quads = {stall.name: stall.polygon for stall in made.garage.layout.quads}
    cars = made.garage.layout.of_kind("car")
    assert cars
    for car in cars:
        ground = shapely.union_all([shapely.Polygon(outline) for outline in car.outlines()])
        assert ground.difference(quads[car.stall].buffer(0.15)).area < 0.05


def test_the_stage_has_no_s_r_and_c_and_all_of_the_rest(made):
    stage = Usd.Stage.Open(str(made.stage))
    assert not {"S", "R", "C", "fireCompartments", "tape"} & {*stage.GetDefaultPrim().GetCustomData()}
    garage = read_built(made.stage).garage
    (level,) = garage.levels
    assert level.structure is None
    assert not level.faults
    assert [stall.corners for stall in garage.stalls] == [
        tuple(pytest.approx(corner, abs=1e-4) for corner in stall.corners) for stall in made.garage.layout.quads
    ]
    report = json.loads(made.report.read_text())
    assert [stall["id"] for stall in report["levels"][0]["stalls"]] == [
        stall.source.name for stall in made.garage.layout.source.fitted
    ]
    assert {stall["proof"] for stall in report["levels"][0]["stalls"]} == {"reached"}


def test_the_same_survey_gives_the_same_bytes(made, tmp_path):
    again = import_layout(l_shaped(), tmp_path / "l.usdc", config=GarageConfig(seed=4))
    for one, other in ((made.stage, again.stage), (made.labels, again.labels), (made.pictures[0], again.pictures[0])):
        assert one.read_bytes() == other.read_bytes()
    other = import_layout(l_shaped(), tmp_path / "other.usdc", config=GarageConfig(seed=5), proves=False)
    assert [stall.corners for stall in other.garage.layout.quads] == [
        stall.corners for stall in made.garage.layout.quads
    ]
    assert [car.spec for car in other.garage.layout.of_kind("car")] != [
        car.spec for car in made.garage.layout.of_kind("car")
    ]


def test_the_command_tells_what_it_made(tmp_path):
    run = CliRunner().invoke(main, ["import", str(LOT), "-o", str(tmp_path / "lot.usdz"), "--seed", "2"])
    assert run.exit_code == 0, run.output
    assert re.search(r"stalls\s+20 \(11 perpendicular, 9 angled\)", run.output)
    assert re.search(r"driven\s+20 reached", run.output)
    assert {path.name for path in tmp_path.iterdir()} == {
        "lot.usdz",
        "lot_plan.png",
        "lot_labels.json",
        "lot_report.json",
    }


def test_commands_that_need_squares_say_so(made):
    run = CliRunner().invoke(main, ["plan", str(made.stage), "-o", str(made.stage.with_name("plan.svg"))])
    assert run.exit_code == 1
    assert "the report of an import, whose garage has no squares: its plan is l_plan.png" in run.output


def test_columns_stand_where_they_are_given(tmp_path):
    made = import_layout(LOT, tmp_path / "lot.usdc", proves=False)
    assert [place.position_m for place in made.garage.layout.of_kind("column")] == [(3.0, 0.0, 15.0)]


@pytest.mark.parametrize(
    ("settings", "output", "message"),
    [
        ({}, "l.obj", "output: got '.*l.obj'; allowed: a path that ends in .usda, .usdc, .usdz"),
    ],
)
def test_what_cannot_be_imported_is_refused(settings, output, message, tmp_path):
    with pytest.raises(ConfigError, match=message):
        import_layout(l_shaped(), tmp_path / output, config=GarageConfig(**settings))
    assert not [*tmp_path.iterdir()]


def test_an_outline_without_room_for_a_door_is_refused(tmp_path):
    outline = tuple((10 + 5 * math.cos(a), 10 + 5 * math.sin(a)) for a in np.linspace(0, math.tau, 24, endpoint=False))
    stall = SurveyedStall("1", ((8.75, 9.5), (11.25, 9.5), (11.25, 14.0), (8.75, 14.0)))
    survey = Survey((stall,), (SurveyedLane(((6.0, 8.0), (14.0, 8.0)), 5.0),), outline=outline)
    with pytest.raises(ConfigError, match=r"outline: got 'sides of at most 1\.31 m'; allowed: a side of"):
        import_layout(survey, tmp_path / "l.usdc")
