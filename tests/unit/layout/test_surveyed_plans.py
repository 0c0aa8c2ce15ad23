"""A plan that is written as a survey, without squares, and imported has what the generated garage has."""

import math
from functools import cache

import numpy as np
import pytest
import shapely
from support.surveyed_plans import survey_of

import garage2usd
from garage2usd import GarageConfig
from garage2usd.checks import judged_layout
from garage2usd.imports import import_layout
from garage2usd.layout.surveyed import lay_out_survey
from garage2usd.layout.surveyed.ground import rectangles
from garage2usd.survey.survey import PortalKind, Survey, SurveyedLane, SurveyedPortal, SurveyedStall, aligned

SMALL = {"width_cells": 8, "height_cells": 7}
PLANS = {
    "plain": {"seed": 3, "site": SMALL},
    "larger": {"seed": 4, "site": {"width_cells": 11, "height_cells": 8}},
    "obstacles": {"seed": 5, "site": {**SMALL, "obstacles": 2}},
    "contour": {"seed": 6, "site": {"width_cells": 12, "height_cells": 9, "rectangles": 3}},
    "one way": {"seed": 7, "site": SMALL, "plan": {"aisles": "one-way"}},
    "mixed kinds": {
        "seed": 8,
        "site": SMALL,
        "stalls": {"kinds": {"perpendicular": 0.4, "angled": 0.4, "parallel": 0.2}},
    },
    "german": {"seed": 9, "site": SMALL, "profile": "de-garvo"},
    "wet and patched": {"seed": 10, "site": SMALL, "look": {"floor": {"wet": 0.4, "finish": "patched"}}},
    "channels": {"seed": 11, "site": SMALL, "look": {"floor": {"drains": "channels"}}},
    "no beams": {"seed": 12, "site": SMALL, "fittings": {"beams": False}},
}
QUICK = {"plain", "mixed kinds"}
FEW = {"cone": 5, "no_parking_sign": 5, "speed_bump": 3, "puddle": 4, "floor_stain": 20, "light": 10}
"""Greatest difference of kinds that are drawn for each piece, of which there is another number."""
GREATEST_SHARE = 0.1
PRINCIPLES = {"dead-end", "dead-end-depth", "hydrant-cabinet-distance", "fire-extinguisher-distance"}
"""Rules on the plan, which a survey cannot mend, and on what has too few walls and columns to hang on."""


@cache
def both(name):
    """A generated layout, and that of its survey."""
    config = GarageConfig(**PLANS[name])
    layout = garage2usd.generate(config).layout
    survey, _ = aligned(survey_of(layout))
    return config, layout, lay_out_survey(survey, config)


EACH = [name if name in QUICK else pytest.param(name, marks=pytest.mark.soak) for name in PLANS]


@pytest.mark.parametrize("name", EACH)
def test_it_has_every_kind_of_object(name):
    _, planned, surveyed = both(name)
    assert not surveyed.source.unplaced
    assert planned.counts().keys() == surveyed.counts().keys()
    off = {
        kind: (count, surveyed.counts()[kind])
        for kind, count in planned.counts().items()
        if abs(surveyed.counts()[kind] - count) > max(GREATEST_SHARE * count, FEW.get(kind, 1))
    }
    assert not off


@pytest.mark.parametrize("name", EACH)
def test_check_finds_the_same_but_for_principles_of_plans(name):
    config, *layouts = both(name)
    planned, surveyed = ({finding.rule for finding in judged_layout(layout, config)[0]} for layout in layouts)
    assert surveyed - planned <= PRINCIPLES


@pytest.mark.parametrize("turn_deg", [33.0])
def test_a_garage_that_is_turned_in_its_survey_is_furnished_alike(turn_deg):
    """The survey's frame is not the garage's: its axes are found in it."""
    config, planned, straight = both("plain")
    survey, _ = aligned(survey_of(planned).moved(math.radians(turn_deg), (100.0, -20.0)))
    turned = lay_out_survey(survey, config)
    assert sum(turned.counts().values()) == pytest.approx(sum(straight.counts().values()), rel=0.02)
    assert turned.counts()["duct"] == straight.counts()["duct"]


def test_things_stand_about_in_an_import_where_no_car_drives(tmp_path):
    config = GarageConfig(**PLANS["plain"], clutter={"people": 20, "bags": 10})
    made = import_layout(survey_of(both("plain")[1]), tmp_path / "lot.usdc", config=config)
    assert made.garage.layout.counts()["person"] > 0
    assert {proof.outcome.value for proof in made.proofs} == {"reached"}
    assert not [finding for finding in made.findings if finding.severity == "error"]


def test_lanes_askew_are_furnished_along_their_own_direction():
    """A branch at 30 degrees to the rows: its ducts lie along it, within the walls, and no piece overlaps a stall."""
    lanes = (
        SurveyedLane(((0.0, 10.0), (60.0, 10.0)), 6.0),
        SurveyedLane(((30.0, 10.0), (56.0, 25.0)), 6.0),
    )
    stalls = tuple(
        SurveyedStall(f"{n}", ((3 + 2.5 * n, 1.5), (5.5 + 2.5 * n, 1.5), (5.5 + 2.5 * n, 6.8), (3 + 2.5 * n, 6.8)))
        for n in range(20)
    )
    portals = (SurveyedPortal((0.0, 10.0), PortalKind.ENTRANCE), SurveyedPortal((60.0, 10.0), PortalKind.EXIT))
    survey = Survey(stalls, lanes, (), portals, ((0.0, 0.0), (60.0, 0.0), (60.0, 32.0), (0.0, 32.0)))
    layout = lay_out_survey(aligned(survey)[0], GarageConfig())
    yaws = {round(math.degrees(duct.yaw_rad)) % 180 for duct in layout.of_kind("duct")}
    assert 90 in yaws
    assert any(abs(yaw - 60) <= 1 for yaw in yaws), yaws
    walls = shapely.box(0.0, 0.0, 60.0, 32.0)
    for kind in ("duct", "sprinkler", "cable_tray", "light"):
        for place in layout.of_kind(kind):
            x, _, z = place.position_m
            assert place.square is None or walls.contains(shapely.Point(x, z))


def test_rectangles_fill_a_ground_with_many_corners_without_overlap():
    """A ring with a jagged rim of 400 corners, as the ground around curved lanes is."""
    turns = np.linspace(0.0, math.tau, 400, endpoint=False)
    far = 40.0 + 3.0 * np.random.default_rng(1).random(400)
    rim = shapely.Polygon(np.stack([60.0 + far * np.cos(turns), 60.0 + far * np.sin(turns)], axis=1))
    ground = rim.difference(shapely.Point(60.0, 60.0).buffer(15.0))
    found = list(rectangles(ground, 3.5))
    assert shapely.union_all(found).area == pytest.approx(sum(box.area for box in found), rel=0.01)
    assert shapely.union_all(found).difference(ground.buffer(0.1)).area < 0.01 * ground.area
    assert sum(box.area for box in found) > 0.6 * ground.area
