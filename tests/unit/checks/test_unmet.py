"""No clause of a profile goes unchecked in silence, and `build` names those that it does not design to."""

import json
from dataclasses import replace

import pytest
from click.testing import CliRunner
from support.random_profiles import random_profile
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd.as_built.garage import garage_as_made
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.checks import (
    RULES,
    Finding,
    Severity,
    clauses_checked,
    findings_of,
    found_in_words,
    judged_layout,
    not_checked,
    not_checked_lines,
    usd,
)
from garage2usd.cli import main
from garage2usd.config import GarageConfig
from garage2usd.pipeline import generate
from garage2usd.profiles import Profile, load_profile, read_profile

TOLD = {"source": "the client", "confidence": "high"}
METRES = {"unit": "m", **TOLD}
PER_CENT = {"unit": "%", **TOLD}
QUICK = {"episodes": 60, "starts": 1}


def profile_of(**clauses):
    return read_profile({"name": "client", **{name: {**TOLD, **clause} for name, clause in clauses.items()}})


def judged(profile, **settings):
    """Findings of the whole check but for USD, and the clauses that build names."""
    config = GarageConfig(profile=profile, **{"plan": QUICK, **settings})
    garage = generate(config)
    subject = level_of_layout(garage.layout, source="", kind="report")
    rules = [rule for rule in RULES if rule not in usd.BOOK.rules]
    findings = [finding for rule in rules for finding in rule.findings(subject, config.standard)]
    return findings, judged_layout(garage.layout, config)[1]


ROOM_FOR_CORES = {"personnel_exits", "exit_distance", "exit_distance_sprinklered"}
"""One stall in ten gives way to stair cores at most. Besides, no grid may be narrower than an aisle."""


@pytest.mark.parametrize("seed", soak_but(4, range(20)))
def test_a_garage_misses_no_clause_that_build_does_not_name(seed):
    findings, unmet = judged(random_profile(seed), seed=seed)
    missed = {finding.clause or finding.rule for finding in findings}
    assert missed <= {entry.clause for entry in unmet}
    # all others are designed to
    assert missed <= ROOM_FOR_CORES | {"column_spacing"}


SECONDS = {
    "column_clearance": {"value": 1.0, **METRES},
    "wall_clearance": {"value": 10.0, **METRES},
    "end_clearance": {"value": 4.0, **METRES},
    "ramp_transition_length": {"value": 5.0, **METRES},
    "ramp_transition_slope": {"value": 8.0, **PER_CENT},
    "fire_compartment_area": {"value": 100.0, "unit": "m2", **TOLD},
    "exit_distance": {"value": 2.0, **METRES},
}
"""Each without the clause that it used to need; all are missed by a garage of twelve squares of other settings."""


@pytest.mark.parametrize("clause", SECONDS)
def test_a_clause_is_checked_without_a_second_one(clause):
    config = GarageConfig(**{**SETTINGS, "fittings": {"ramp_transition_m": 1.0}})
    garage = generate(config)
    subject = garage_as_made(garage, source="", kind="report")
    profile = profile_of(**{clause: SECONDS[clause]})
    assert {finding.clause for finding in findings_of(subject, profile)} - {""} == {clause}
    assert not_checked(subject.levels[0], profile) == {}


ONE_IN_SIX = {"value": 6, "unit": "count"}
VANS = {
    "how many": ({"stalls_per_van_stall": ONE_IN_SIX}, "neither van_stall_width nor van_access_aisle_width"),
    "how wide": ({"van_stall_width": {"value": 3.4, "unit": "m"}}, "no stalls_per_van_stall"),
    "how wide an aisle": ({"van_access_aisle_width": {"value": 2.4, "unit": "m"}}, "no stalls_per_van_stall"),
}


@pytest.mark.parametrize(("clauses", "reason"), VANS.values(), ids=VANS)
def test_a_clause_that_cannot_be_checked_is_named_by_check_and_build(clauses, reason, tmp_path):
    told = {name: {**TOLD, **clause} for name, clause in clauses.items()}
    config = {**SETTINGS, "profile": {"name": "client", **told}}
    report = _built(config, tmp_path)
    (name,) = clauses
    assert [line for line in report["stderr"] if line.startswith("not designed to")] == [
        f"not designed to {name}: not checked, as the profile has {reason}"
    ]
    (entry,) = report["levels"][0]["not_designed_to"]
    assert (entry["clause"], entry["places"]) == (name, 0)
    checked = CliRunner().invoke(main, ["check", str(tmp_path / "g_report.json")]).output.splitlines()
    assert [line for line in checked if "not checked" in line] == [f"not checked: {name}, as the profile has {reason}"]
    as_json = json.loads(CliRunner().invoke(main, ["check", str(tmp_path / "g_report.json"), "--json"]).output)
    assert as_json["not_checked"] == [{"clause": name, "reason": f"the profile has {reason}"}]


def test_an_aisle_alone_may_make_room_for_vans():
    profile = profile_of(
        stalls_per_van_stall=ONE_IN_SIX,
        van_access_aisle_width={"value": 2.44, "unit": "m"},
        stall_width={"value": 2.45, "unit": "m"},
    )
    findings, unmet = judged(profile, seed=3)
    assert (findings, unmet) == ([], ())


def test_what_a_file_does_not_tell_is_not_checked():
    garage = generate(GarageConfig(**SETTINGS))
    subject = level_of_layout(garage.layout, source="", kind="stage")
    standard = load_profile("cn-jgj100")
    assert not_checked(subject, standard) == {}
    circulation = {"dead_end_depth", "loops", "lane_field_width"}
    areas = {"fire_compartment_area", "fire_compartment_area_sprinklered"}
    assert set(not_checked(replace(subject, structure=None), standard)) == circulation | areas
    dark = replace(subject, lane_lux=None, stall_lux=None)
    assert set(not_checked(dark, standard)) == {"lane_illuminance", "stall_illuminance"}
    bare = not_checked(replace(dark, things=()), standard)
    assert {"clear_height", "ramp_slope", "personnel_exits", "hydrant_reach", "wall_clearance"} < set(bare)
    assert {"stall_width", "stall_length", "aisle_width", "portals", "loops"}.isdisjoint(bare)
    lines = not_checked_lines(bare)
    assert len(lines) == 2
    assert all(line.startswith("not checked: ") for line in lines)


def test_a_distance_for_sprinklers_needs_some():
    profile = profile_of(exit_distance_sprinklered={"value": 60, "unit": "m"})
    for sprinklers, named in ((True, set()), (False, {"exit_distance_sprinklered"})):
        _, unmet = judged(profile, seed=1, fittings={"sprinklers": sprinklers})
        assert {entry.clause for entry in unmet} == named


def test_build_names_what_the_user_set_against_the_profile(tmp_path):
    config = {**SETTINGS, "profile": "us-ada", "bay": {"stall_width_m": 2.5, "dimensioned": False}}
    report = _built(config, tmp_path)
    entry = next(entry for entry in report["levels"][0]["not_designed_to"] if entry["clause"] == "stall_width")
    assert (entry["measured"], entry["required"], entry["unit"]) == (2.5, 2.5908, "m")
    assert entry["places"] > 10
    (line,) = (line for line in report["stderr"] if line.startswith("not designed to stall_width: "))
    assert "2.5 m where 2.591 m is asked for" in line


def test_a_garage_that_keeps_its_profile_has_nothing_to_name(tmp_path):
    config = {"seed": 4, "plan": QUICK, "stage": {"texture_quality": "low"}}
    report = _built(config, tmp_path)
    assert report["levels"][0]["not_designed_to"] == []
    assert not any("not designed" in line for line in report["stderr"])


def _built(settings, folder):
    """The report of a build by the command line, and what it said on stderr."""
    profile = settings.get("profile", "cn-jgj100")
    settings = {name: value for name, value in settings.items() if name != "profile"}
    (folder / "g.toml").write_text(_toml(settings))
    if not isinstance(profile, str):
        (folder / "client.toml").write_text(_toml(profile))
        profile = str(folder / "client.toml")
    result = CliRunner().invoke(
        main, ["build", str(folder / "g.toml"), "--profile", profile, "-o", str(folder / "g.usda")]
    )
    assert result.exit_code == 0, result.output
    return {**json.loads((folder / "g_report.json").read_text()), "stderr": result.stderr.splitlines()}


def _toml(document):
    plain = [f"{key} = {json.dumps(value)}" for key, value in document.items() if not isinstance(value, dict)]
    tables = [f"[{key}]\n{_toml(value)}" for key, value in document.items() if isinstance(value, dict)]
    return "\n".join([*plain, *tables])


def test_every_clause_that_asks_for_something_is_asked_by_a_rule():
    asking = {clause for rule in RULES for clause in rule.clauses[: rule.asking]}
    # the car that rules park and drive, and what ramp-bend asks of several levels
    assert set(Profile.model_fields) - asking - {"name", "title", "country", "based_on"} == {
        "curved_ramp_slope",
        "design_car_length",
        "design_car_width",
        "design_car_height",
        "turning_radius",
    }


def test_nothing_is_found_only_where_clauses_were_checked():
    assert found_in_words([], 0, "none") == "no clause of none checked"
    assert found_in_words([], 25, "cn-jgj100") == "25 clauses of cn-jgj100 checked: nothing found"
    finding = Finding("stall-route", Severity.ERROR, "a", "b")
    assert found_in_words([finding], 0, "none") == "no clause of none checked: 1 error (stall-route)"


def test_the_clauses_checked_are_those_that_rules_ask_for():
    profile = load_profile("cn-jgj100")
    every = clauses_checked(profile)
    assert 0 < every < len(dict(profile.clauses()))
    assert clauses_checked(profile, ["stall_width", "design_car_length"]) == every - 1
    assert clauses_checked(Profile(name="none")) == 0
