"""Signs in garages of several levels: exit signs lead to the street, and others name the levels."""

import pytest
from support.level_judge import LevelJudge
from support.overlaps import Solids
from support.sign_judge import SignJudge
from support.small_levels import SMALL_HELICES, SMALL_LEVELS

from garage2usd import GarageConfig, build_levels, generate_levels
from garage2usd.assets.countries import Country
from garage2usd.objects.signage import SIGNAGE

STRAIGHT = {**SMALL_LEVELS.model_dump(mode="json"), "look": {"signs": {"of": "profile"}}}
GARAGES = {
    "straight": GarageConfig(**{**STRAIGHT, "profile": "de-garvo"}),
    "helix": SMALL_HELICES,
}


@pytest.fixture(scope="module", params=GARAGES)
def built(request, tmp_path_factory):
    made = build_levels(GARAGES[request.param], tmp_path_factory.mktemp("signs") / "garage.usdc")
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
        for level in generate_levels(config).levels:
            assert not level.layout.of_kind("lane_sign")
