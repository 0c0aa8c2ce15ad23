"""What a check says of a surveyed garage: its own measures as remarks, and the standard of its country."""

import json
from dataclasses import replace

import pytest

from garage2usd import GarageConfig
from garage2usd.checks import RULES, Severity
from garage2usd.checks.levels import findings_of_whole
from garage2usd.garage_sources import read_built
from garage2usd.imports import import_layout
from garage2usd.profiles import PROFILE_NAMES, load_profile, read_profile
from garage2usd.profiles.countries import profile_at
from garage2usd.survey.survey import Survey, SurveyedLane, SurveyedStall
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel


def lot(count=6, *, width_m=2.5, aisle_m=6.0, depth_m=5.0, **parts):
    stalls = tuple(
        SurveyedStall(f"s{number}", ((x, 0), (x + width_m, 0), (x + width_m, depth_m), (x, depth_m)))
        for number in range(count)
        for x in [width_m * number]
    )
    middle = depth_m + aisle_m / 2
    outline = ((0, 0), (width_m * count, 0), (width_m * count, depth_m + aisle_m), (0, depth_m + aisle_m))
    lane = SurveyedLane(((0, middle), (width_m * count, middle)), aisle_m)
    return Survey(stalls, (lane,), outline=outline, **parts)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return import_layout(lot(), tmp_path_factory.mktemp("six") / "six.usdc")


def test_a_plain_lot_of_six_stalls_has_no_error(made):
    found = {finding.rule: finding for finding in made.findings}
    assert [finding.rule for finding in made.findings if finding.severity is Severity.ERROR] == []
    short = found["stall-length"]
    assert (short.severity, short.measured, short.required) == (Severity.INFO, 5.0, 5.3)
    assert short.message == "the stall is too short, as surveyed"
    assert short.source.startswith("JGJ 100")
    assert sum(finding.rule == "stall-length" for finding in made.findings) == 6
    assert "portal-distance" not in found
    assert {finding.severity for finding in made.findings if finding.message.endswith("as the import chose it")} <= {
        Severity.WARNING
    }


def test_the_stage_is_judged_as_the_import_was(made):
    again = read_built(made.stage)
    assert all(level.is_surveyed for level in again.garage.levels)
    told = {(finding.rule, finding.severity, finding.message) for finding in made.findings}
    assert told <= {(finding.rule, finding.severity, finding.message) for finding in again.findings()}


def test_what_cannot_be_driven_is_an_error(tmp_path):
    made = import_layout(lot(3, width_m=1.7), tmp_path / "narrow.usdc")
    errors = {finding.rule for finding in made.findings if finding.severity is Severity.ERROR}
    assert errors == {"swept-path"}
    assert "stall-width" in {finding.rule for finding in made.findings if finding.severity is Severity.INFO}


def test_rules_on_all_levels_tell_measures_of_the_survey_from_what_cannot_be_driven(tmp_path):
    levels = tuple(SurveyedLevel(name, lot(), ordinal) for name, ordinal in (("0", 0.0), ("-1", -1.0)))
    made = import_layout(SurveyedBuilding(levels), tmp_path / "two.usdc", proves=False)
    built = read_built(made.stage)
    told = {"source": "a test", "confidence": "high", "text": "Roomy."}
    high, doors = {"value": 5, "unit": "m", **told}, {"steps": [[1, 9]], "above": 9, "unit": "count", **told}
    profile = read_profile({"name": "strict", "clear_height": high, "portals": doors})
    found = {each.rule: each for each in findings_of_whole(built.garage, profile)}
    assert found["level-height"].severity is Severity.INFO
    assert found["level-height"].message.endswith("lie too close together, as surveyed")
    assert found["portal-count"].severity is Severity.WARNING
    upper, lower = built.garage.levels
    near = replace(lower, place=lower.place._replace(floor_m=-1.2))
    found = {each.rule: each for each in findings_of_whole(replace(built.garage, levels=(upper, near)), profile)}
    assert found["level-height"].severity is Severity.ERROR


def test_a_generated_garage_is_judged_as_before():
    level = type("Level", (), {"is_surveyed": False})()
    for name in PROFILE_NAMES:
        profile = load_profile(name)
        for rule in RULES:
            asked = next((clause.severity for clause in rule.asked_by(profile).values()), rule.severity)
            assert rule.severity_in(profile, level) is asked


@pytest.mark.parametrize(
    ("place", "profile"),
    [
        *(((40.71, -74.01), "us-ada"), ((21.3, -157.86), "us-ada"), ((61.22, -149.9), "us-ada")),
        *(((50.8, -1.09), "uk-istructe"), ((54.6, -5.93), "uk-istructe"), ((60.15, -1.14), "uk-istructe")),
        *(((52.52, 13.4), "de-garvo"), ((50.77, 6.08), "de-garvo"), ((54.32, 10.14), "de-garvo")),
        *(((31.24, 121.49), "cn-jgj100"), ((22.54, 114.06), "cn-jgj100"), ((36.07, 120.38), "cn-jgj100")),
        *(
            (place, None)
            for place in ((48.58, 7.75), (47.8, 13.04), (53.35, -6.26), (42.3, -83.02), (22.3, 114.17), (0, 0))
        ),
    ],
)
def test_places_have_the_profile_of_their_country(place, profile):
    assert profile_at(*place) == profile


@pytest.mark.parametrize(
    ("place", "config", "profile", "remark"),
    [
        ((52.52, 13.4), None, "de-garvo", "the profile de-garvo is used, that of the country at 52.52, 13.40"),
        ((52.52, 13.4), GarageConfig(profile="us-ada"), "us-ada", None),
        ((48.58, 7.75), GarageConfig(seed=2), "cn-jgj100", "no profile is of the country at 48.58, 7.75"),
        (None, None, "cn-jgj100", None),
    ],
)
def test_the_profile_follows_the_country(place, config, profile, remark, tmp_path):
    made = import_layout(lot(2, origin_deg=place), tmp_path / "a.usdc", config=config, proves=False)
    assert made.garage.config.standard.name == profile
    assert made.garage.config.seed == (0 if config is None else config.seed)
    remarks = json.loads(made.report.read_text())["remarks"]
    assert [line.startswith(remark) for line in remarks if "profile" in line] == ([True] if remark else [])
