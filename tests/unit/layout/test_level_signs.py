"""Signs in garages of several levels: exit signs lead to the street, and others name the levels."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from support.level_judge import LevelJudge
from support.overlaps import Solids
from support.sight import EYE_M, part_named, share_hidden, spread_over, triangles, world
from support.sign_judge import SignJudge
from support.small_levels import SMALL_HELICES, SMALL_LEVELS
from support.soak import soak_but

from garage2usd import GarageConfig, build, export, generate
from garage2usd.assets.countries import Country
from garage2usd.objects.signage import SIGNAGE

STRAIGHT = {**SMALL_LEVELS.model_dump(mode="json"), "look": {"signs": {"of": "profile"}}}
GARAGES = {
    "straight": GarageConfig(**{**STRAIGHT, "profile": "de-garvo"}),
    "helix": SMALL_HELICES,
}


@pytest.fixture(scope="module", params=soak_but(["straight"], GARAGES))
def built(request, tmp_path_factory):
    made = build(GARAGES[request.param], tmp_path_factory.mktemp("signs") / "garage.usdc")
    return made.garage, SignJudge(LevelJudge(made.stage))


def test_exit_signs_lead_from_every_lane_of_all_levels_to_the_street(built):
    _, judge = built
    assert {sign.level for sign in judge.signs if sign.label == "exit_sign"} == set(judge.judge.names)
    judge.signs_lead_to_the_street()


def test_signs_say_where_ramps_lead_and_which_level_this_is(built):
    garage, judge = built
    fittings = garage.config.fittings
    before, plates = judge.levels_are_named(fittings.clear_height_m, fittings.ceiling_height_m)
    assert {(sign.level, sign.text) for sign in before} == {
        (level.layout.well.name, ramp.to) for level in garage.levels for ramp in level.layout.well.departures
    }
    for name, level in zip(judge.judge.names, garage.levels, strict=True):
        assert sum(plate.level == name for plate in plates) == len(level.layout.cores) > 0


def no_entries(judge):
    """Signs with the bar of a no-entry sign."""
    return [sign for sign in judge.signs if sign.label == "lane_sign" and "Bar" in sign.shapes]


def test_signs_forbid_to_drive_against_each_ramp(built):
    """At the foot of each ramp down and the head of each ramp up, facing those who could drive in."""
    garage, judge = built
    fittings, signs = garage.config.fittings, no_entries(judge)
    ramps = judge.judge.ramps()
    assert len(signs) == len(ramps) == 2 * (len(garage.levels) - 1)
    for ramp in ramps:
        end, way = ramp[-1], (ramp[-1] - ramp[-2])[[0, 2]]
        way /= np.linalg.norm(way)
        near = [sign for sign in signs if np.linalg.norm((sign.place - end)[[0, 2]]) < 5 and sign.way @ way < -0.99]
        (sign,) = (sign for sign in near if 0 < sign.place[1] - end[1] < garage.config.building.storey_m)
        aside = (sign.place - end)[[0, 2]] @ [-way[1], way[0]]
        assert abs(aside) < 1.2
        height_m = sign.place[1] - end[1]
        assert height_m + sign.low_m >= fittings.clear_height_m - 1e-4
        assert height_m + sign.high_m <= fittings.ceiling_height_m + 1e-4


def test_no_sign_of_a_ramp_hides_another_one_from_its_readers(built):
    """From the middle of the right half of the lane, at half a square to two before a sign."""
    garage, _ = built
    for level in garage.levels:
        hung = [*level.layout.of_kind("lane_sign"), *level.layout.of_kind("exit_sign")]
        hung += level.layout.of_kind("fire_shutter")
        forbidden = [sign for sign in hung if sign.name.startswith("NoEntry")]
        assert len(forbidden) == len(level.layout.well.arrivals)
        for sign in hung:
            near = [each for each in forbidden if np.linalg.norm(np.subtract(each.position_m, sign.position_m)) < 9]
            if not near or sign.kind == "fire_shutter":
                continue
            name = {"exit_sign": "Box", "lane_sign": "Disc" if sign in forbidden else "Border"}[sign.kind]
            points = spread_over(world(sign, part_named(sign, name).points))
            ground = -sign.position_m[1] + EYE_M
            eyes = world(sign, [(across, ground, far) for across in (0.3, 1.2) for far in (4.0, 8.0, 14.0)])
            # a no-entry sign behind none, and none behind a no-entry sign
            others = [each for each in (hung if sign in forbidden else forbidden) if each is not sign]
            faces = np.concatenate([triangles(each) for each in others])
            assert share_hidden(eyes, points, faces) < 0.1, sign


@pytest.mark.parametrize("built", ["straight"], indirect=True)
def test_maps_have_the_signs_that_forbid_to_enter_ramps(built, tmp_path):
    _, judge = built
    (road,) = export(judge.judge.stage.GetRootLayer().realPath, [tmp_path / "g.xodr"])
    found = [signal for signal in ET.parse(road).getroot().iter("signal") if signal.get("type") == "267"]
    assert len(found) == len(no_entries(judge))
    assert {signal.get("country") for signal in found} == {"DE"}


def test_signs_of_levels_touch_nothing_that_hangs_beside_them(built):
    garage, _ = built
    for level in garage.levels:
        clashes = [(first.name, second.name) for first, second in Solids(level.layout).clashes()]
        assert not [names for names in clashes if any("Sign" in name for name in names)]


def test_signs_of_levels_are_in_the_words_of_the_country(built):
    garage, judge = built
    words = SIGNAGE[Country(garage.levels[0].layout.of_kind("exit_sign")[0].spec.country)]
    named = [sign for sign in judge.signs if sign.text and sign.word]
    assert {sign.word for sign in named} == {words.level, words.exit}


def test_there_are_no_signs_over_lanes_without_room_or_where_they_are_switched_off():
    for fittings in ({"exit_signs": False}, {"clear_height_m": 2.6, "ceiling_height_m": 2.9}):
        config = GarageConfig(**{**SMALL_LEVELS.model_dump(mode="json"), "fittings": fittings})
        for level in generate(config).levels:
            assert not level.layout.of_kind("lane_sign")
