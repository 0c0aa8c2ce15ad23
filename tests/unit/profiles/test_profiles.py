"""Profiles are data: shipped or the user's own, validated clause by clause."""

import re
import tomllib

import pytest
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd import GarageConfig, generate, load_config
from garage2usd.checks import judged_layout
from garage2usd.common.errors import ConfigError
from garage2usd.profiles import PROFILE_NAMES, Confidence, Length, Profile, load_profile, read_profile

GUIDANCE = {"dead_end_depth": "warning", "loops": "warning", "lane_field_width": "warning"}
STALL = {"value": 2.5, "unit": "m", "source": "the client", "confidence": "high"}


@pytest.mark.parametrize("name", PROFILE_NAMES)
def test_shipped_profiles_give_each_clause_its_unit_source_and_words(name):
    profile = load_profile(name)
    assert profile.name == name
    clauses = dict(profile.clauses())
    assert {"stall_width", "stall_length", "aisle_width", "clear_height"} <= set(clauses)
    for clause in clauses.values():
        assert clause.source
        assert clause.text.endswith(".")
        assert clause.unit


def test_every_shipped_file_is_a_profile():
    files = (REPOSITORY / "garage2usd" / "profiles").glob("*.toml")
    assert sorted(path.stem for path in files) == sorted(PROFILE_NAMES)


@pytest.mark.parametrize(
    ("name", "clause", "metres"),
    [
        ("cn-jgj100", "stall_width", 2.4),
        ("cn-jgj100", "speed_bump_height", 0.05),
        ("us-ada", "stall_width", 2.5908),
        ("us-ada", "stall_length", 5.4864),
        ("us-ada", "aisle_width", 7.3152),
        ("us-ada", "van_clear_height", 2.4892),
        ("us-ada", "van_stall_width", 3.3528),
        ("uk-istructe", "clear_height", 2.1),
        ("us-ada", "dead_end_depth", 25.908),
        ("de-garvo", "stall_width", 2.4),
        ("de-garvo", "exit_distance", 30.0),
    ],
)
def test_lengths_are_read_in_their_own_unit(name, clause, metres):
    assert getattr(load_profile(name), clause).amount == pytest.approx(metres)


@pytest.mark.parametrize(
    ("stalls", "required"),
    [(1, 1), (25, 1), (26, 2), (50, 2), (51, 3), (100, 4), (101, 5), (500, 9), (501, 11), (1000, 20)],
)
def test_accessible_stalls_grow_with_the_garage_as_ada_208_says(stalls, required):
    assert load_profile("us-ada").accessible_stalls.required(stalls) == required


@pytest.mark.parametrize(("stalls", "required"), [(1, 1), (100, 1), (101, 2), (1000, 2), (1001, 3), (9000, 3)])
def test_portals_grow_with_the_garage(stalls, required):
    assert load_profile("cn-jgj100").portals.required(stalls) == required


def test_guidance_is_no_error_and_every_shipped_profile_has_it():
    for name in PROFILE_NAMES:
        profile = load_profile(name)
        severities = {clause: getattr(profile, clause).severity for clause in GUIDANCE}
        assert severities == GUIDANCE
        # twice the least aisle, so that lanes beside each other are found at any size that a profile designs to
        assert profile.lane_field_width.amount == pytest.approx(2 * profile.aisle_width.amount)


@pytest.mark.parametrize(("stalls", "loops"), [(1, 0), (50, 0), (51, 1), (9000, 1)])
def test_a_loop_is_asked_of_more_than_fifty_stalls(stalls, loops):
    assert {load_profile(name).loops.required(stalls) for name in PROFILE_NAMES} == {loops}


def test_a_profile_of_ones_own_is_read_from_a_file(tmp_path):
    path = tmp_path / "client.toml"
    path.write_text('name = "client"\n[stall_width]\nvalue = 8.5\nunit = "ft"\nsource = "us"\nconfidence = "low"\n')
    for profile in (load_profile(path), load_profile("client.toml", folder=tmp_path)):
        assert profile.stall_width == Length(value=8.5, unit="ft", source="us", confidence=Confidence.LOW)
        assert dict(profile.clauses()).keys() == {"stall_width"}


@pytest.mark.parametrize(
    ("settings", "field", "allowed"),
    [
        ({}, "profile.name", "a value"),
        ({"name": "a", "stall_with": STALL}, "profile.stall_with", "stall_width"),
        ({"name": "a", "stall_width": {**STALL, "units": "m"}}, "profile.stall_width.units", "value, unit"),
        ({"name": "a", "stall_width": {**STALL, "unit": "yd"}}, "profile.stall_width.unit", "'ft'"),
        ({"name": "a", "stall_width": {**STALL, "unit": "lx"}}, "profile.stall_width.unit", "'m'"),
        ({"name": "a", "stall_width": {**STALL, "value": -1}}, "profile.stall_width.value", "greater than 0"),
        ({"name": "a", "stall_width": {**STALL, "value": float("nan")}}, "profile.stall_width.value", "finite"),
        (
            {"name": "a", "stall_width": {"value": 2.5}},
            "profile.stall_width",
            "profile.stall_width needs source, confidence, value, unit",
        ),
        ({"name": "a", "stall_width": {**STALL, "confidence": "sure"}}, "profile.stall_width.confidence", "'high'"),
        ({"name": "a", "stall_width": 2.5}, "profile.stall_width", "a table with the keys"),
        ({"name": "../a"}, "profile.name", "match pattern"),
        (
            {"name": "a", "portals": {**STALL, "unit": "count", "steps": [[9, 1], [5, 2]], "above": 3}},
            "profile.portals.value",
            "steps",
        ),
        (
            {"name": "a", "column_spacing": {"least": 9, "most": 8, "unit": "m", "source": "a", "confidence": "low"}},
            "profile.column_spacing",
            "most of at least 9",
        ),
    ],
)
def test_what_no_profile_holds_is_named(settings, field, allowed):
    with pytest.raises(ConfigError) as caught:
        read_profile(settings)
    assert caught.value.field.startswith(field)
    assert allowed in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("steps", "allowed"),
    [
        ({"steps": [[9, 1], [5, 2]], "above": 3}, "ascending"),
        ({"steps": [[9, 1]]}, "one of above and above_percent"),
        ({"steps": [[9, 1]], "above": 3, "above_percent": 2}, "one of above and above_percent"),
        ({"steps": [], "above": 3}, "at least 1"),
    ],
)
def test_steps_ascend_and_go_on(steps, allowed):
    with pytest.raises(ConfigError, match=allowed):
        read_profile({"name": "a", "portals": {"unit": "count", "source": "a", "confidence": "low", **steps}})


@pytest.mark.parametrize(
    ("name", "text", "allowed"),
    [
        ("cn-jgj", None, "one of cn-jgj100, de-garvo, uk-istructe, us-ada, or a path"),
        ("none.toml", None, "a readable file"),
        ("bad.toml", b"name = ", "TOML"),
        ("bad.toml", b"\xff", "UTF-8"),
        ("bad.toml", b"a = " + b"[" * 20_000, "TOML"),
    ],
)
def test_what_is_no_profile_is_refused(name, text, allowed, tmp_path):
    if text is not None:
        (tmp_path / name).write_bytes(text)
    with pytest.raises(ConfigError) as caught:
        load_profile(name, folder=tmp_path)
    assert caught.value.field == "profile"
    assert allowed in str(caught.value)


@pytest.mark.parametrize(
    ("settings", "field", "allowed"),
    [
        ({"name": "germany"}, "profile.name", "the nearest is de-garvo"),
        ({"name": "us-adaa", "country": "US"}, "profile.name", "the nearest is us-ada"),
        ({"name": "de-garvo", "stall_width": STALL}, "profile.name", "based_on = 'de-garvo'"),
        ({"name": "a", "based_on": "de", "stall_width": STALL}, "profile.based_on", "the nearest is de-garvo"),
    ],
)
def test_no_profile_passes_for_a_standard_that_it_is_not(settings, field, allowed):
    with pytest.raises(ConfigError) as caught:
        GarageConfig(profile=settings)
    assert caught.value.field == field
    assert allowed in caught.value.allowed


def test_a_table_with_a_name_alone_is_the_shipped_profile():
    assert GarageConfig(profile={"name": "de-garvo"}) == GarageConfig(profile="de-garvo")


def test_a_profile_based_on_a_shipped_one_has_its_other_clauses():
    based = GarageConfig(profile={"name": "a", "based_on": "de-garvo", "stall_width": STALL})
    shipped, own = load_profile("de-garvo"), based.standard
    assert dict(own.clauses()) == {**dict(shipped.clauses()), "stall_width": own.stall_width}
    assert own.stall_width.value == STALL["value"] != shipped.stall_width.value
    # a report holds the clauses themselves
    assert GarageConfig(**based.model_dump(mode="json")) == based


def test_a_profile_may_ask_for_nothing():
    assert list(Profile(name="none").clauses()) == []


def test_shipped_files_are_plain_toml_with_each_clause_once():
    for name in PROFILE_NAMES:
        text = (REPOSITORY / "garage2usd" / "profiles" / f"{name}.toml").read_text()
        clauses = {key for key, _ in load_profile(name).clauses()}
        assert set(tomllib.loads(text)) - {"name", "title", "country"} == clauses


HOME = {
    "cn-jgj100": r"JGJ|GB 5|Chinese practice",
    "de-garvo": r"GarVO|GaVO|GaStellV|GaStplVO|GarBBAnO|EAR",
    "uk-istructe": r"IStructE|BS \d|Hill",
    "us-ada": r"ADA|US practice|NFPA|\bNC\b",
}
NOBODYS = r"^(garage2usd: |practice( of (operators|makers))?[:;]|practice of makers$)"
"""What is the guidance of this project, or what makers and operators do everywhere."""


@pytest.mark.parametrize("name", PROFILE_NAMES)
def test_a_profile_cites_the_standards_of_its_own_country(name):
    for clause, value in load_profile(name).clauses():
        assert re.search(HOME[name], value.source) or re.match(NOBODYS, value.source), (clause, value.source)
        others = [other for country, other in HOME.items() if country != name]
        assert not any(re.search(other, value.source) for other in others), (clause, value.source)


def test_what_was_read_in_the_wording_of_a_source_names_its_section():
    verified = {
        (name, clause): value.source
        for name in PROFILE_NAMES
        for clause, value in load_profile(name).clauses()
        if value.verified
    }
    assert len([name for name, _ in verified if name == "de-garvo"]) >= 12
    for place, source in verified.items():
        assert re.search(r"section \d|\d\.\d", source), place


PROFILE_SAMPLES = REPOSITORY / "samples" / "profiles"
GROSS_M2 = {"cn-jgj100": 28.5, "de-garvo": 33.5, "uk-istructe": 36.0, "us-ada": 33.5}
"""Ground over parking stalls: a few per cent above what the planner reaches."""


def test_each_profile_has_a_sample_of_usual_size():
    assert {file.stem for file in PROFILE_SAMPLES.iterdir()} == {*PROFILE_NAMES} == {*GROSS_M2}
    assert all(load_config(file).profile == file.stem for file in PROFILE_SAMPLES.iterdir())


@pytest.mark.parametrize("name", soak_but(["cn-jgj100"], GROSS_M2))
def test_the_sample_of_a_profile_has_some_350_stalls_and_no_error(name):
    garage = generate(load_config(PROFILE_SAMPLES / f"{name}.toml"))
    assert 330 <= garage.parking_stalls <= 370
    assert sum(level.layout.area.gross_m2 for level in garage.levels) / garage.parking_stalls <= GROSS_M2[name]
    findings = [finding for level in garage.levels for finding in judged_layout(level.layout, level.config)[0]]
    assert [finding for finding in findings if finding.severity == "error"] == []
