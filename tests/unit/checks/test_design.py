"""A garage is designed to its profile: it passes its own check, and what the user sets stays."""

import json
from collections import Counter

import pytest

from garage2usd.checks import Severity, check, check_layout
from garage2usd.checks.layout_reader import layout_subject
from garage2usd.config import GarageConfig, SiteConfig, load_config
from garage2usd.errors import ConfigError
from garage2usd.pipeline import generate
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.profiles import PROFILE_NAMES, load_profile

CLIENT = """
name = "client"
[clear_height]
value = 2.6
unit = "m"
source = "the client"
confidence = "high"
[ramp_slope]
value = 12
unit = "%"
source = "the client"
confidence = "high"
[lane_illuminance]
value = 75
unit = "lx"
source = "the client"
confidence = "high"
"""


def errors_of(config):
    garage = generate(config)
    subject = layout_subject(garage.layout, garage.graph, source="", kind="report")
    return [f for f in check(subject, config.standard) if f.severity is Severity.ERROR], garage


def test_the_default_profile_changes_no_default():
    plain = GarageConfig()
    assert plain.profile == "cn-jgj100"
    assert not plain.site.model_fields_set | plain.bay.model_fields_set | plain.fittings.model_fields_set


@pytest.mark.parametrize("dimensioned", [False, True])
@pytest.mark.parametrize("profile", PROFILE_NAMES)
def test_a_garage_passes_the_profile_that_it_is_designed_to(profile, dimensioned):
    config = GarageConfig(seed=5, profile=profile, plan={"episodes": 150}, bay={"dimensioned": dimensioned})
    errors, garage = errors_of(config)
    assert errors == []
    standard = load_profile(profile)
    stall = garage.layout.stalls[0]
    assert stall.width_m == pytest.approx(standard.stall_width.amount, abs=0.01)
    assert stall.length_m == pytest.approx(standard.stall_length.amount, abs=0.01)


CIRCULATION = {"dead-end-depth", "loop", "lane-field"}


@pytest.mark.parametrize("dimensioned", [False, True])
@pytest.mark.parametrize("profile", PROFILE_NAMES)
@pytest.mark.parametrize("seed", [0, 7])
def test_a_garage_planned_by_the_default_rules_circulates(seed, profile, dimensioned):
    plan = {"episodes": 150, "starts": 1}
    config = GarageConfig(seed=seed, profile=profile, plan=plan, bay={"dimensioned": dimensioned})
    garage = generate(config)
    assert not circulation(garage.plan.structure).faults(rules_of(config.plan, squares=63))
    found = check_layout(garage.layout, garage.graph, config)
    assert not CIRCULATION & {finding.rule for finding in found}


def test_a_garage_planned_for_the_score_alone_does_not_circulate():
    config = GarageConfig(seed=1, plan={"episodes": 150, "circulation": "allow"})
    garage = generate(config)
    found = {finding.rule: finding for finding in check_layout(garage.layout, garage.graph, config)}
    assert {"dead-end-depth", "loop"} <= set(found)
    assert {found[rule].severity for rule in CIRCULATION & set(found)} == {Severity.WARNING}


def test_ada_gives_accessible_stalls_by_its_table():
    config = GarageConfig(profile="us-ada", plan={"episodes": 150})
    uses = Counter(str(stall.use) for stall in generate(config).layout.stalls)
    assert uses["accessible"] == load_profile("us-ada").accessible_stalls.required(uses.total())
    assert uses["accessible"] > 2


@pytest.mark.parametrize("seed", range(25))
def test_default_garages_have_no_errors(seed):
    """500 seeds with all episodes: python benchmarks/reality.py --seeds 500."""
    assert errors_of(GarageConfig(seed=seed, plan={"episodes": 60, "starts": 1}))[0] == []


def test_what_the_user_sets_stays_and_is_found():
    config = GarageConfig(
        profile="us-ada", bay={"stall_width_m": 2.5}, fittings={"clear_height_m": 2.2}, plan={"episodes": 60}
    )
    assert (config.bay.stall_width_m, config.fittings.clear_height_m) == (2.5, 2.2)
    assert {finding.rule for finding in errors_of(config)[0]} == {"stall-width", "van-headroom"}


def test_sections_may_be_models():
    config = GarageConfig(profile="us-ada", bay=GarageConfig().bay, site=SiteConfig(width_cells=11))
    assert config.site.shape == (7, 11)
    assert config.bay.stall_width_m == pytest.approx(2.6)
    assert config.with_seed(4).model_dump() == {**config.model_dump(), "seed": 4}


@pytest.mark.parametrize(
    ("site", "exits"),
    [
        ({}, 1),
        ({"width_cells": 30, "height_cells": 20}, 2),
        ({"width_cells": 30, "height_cells": 20, "entrances": 2}, 1),
        ({"width_cells": 30, "height_cells": 20, "exits": 1}, 1),
        ({"contour": ("." * 30 + "\n") * 20}, 2),
    ],
)
def test_large_garages_get_the_portals_that_their_stalls_need(site, exits):
    assert GarageConfig(site=site).site.exits == exits


def test_a_profile_file_is_carried_by_the_configuration(tmp_path):
    (tmp_path / "client.toml").write_text(CLIENT)
    (tmp_path / "garage.toml").write_text('profile = "client.toml"\n[plan]\nepisodes = 60\n')
    config = load_config(tmp_path / "garage.toml")
    fittings = config.fittings
    assert (fittings.clear_height_m, fittings.ramp_slope_percent, fittings.lane_lux) == (2.6, 12.0, 75.0)
    saved = GarageConfig(**json.loads(json.dumps(config.model_dump(mode="json"))))
    assert saved.standard == config.standard == load_profile(tmp_path / "client.toml")
    assert saved.digest() == config.digest()
    assert errors_of(config)[0] == []
    assert load_config(tmp_path / "garage.toml", profile="us-ada").profile == "us-ada"


@pytest.mark.parametrize(
    ("profile", "said"),
    [("iso", "profile"), ("none.toml", "profile"), (3, "profile"), ({"name": "a", "b": 1}, "profile.b")],
)
def test_a_bad_profile_is_named(profile, said, tmp_path):
    with pytest.raises(ConfigError) as caught:
        GarageConfig(profile=profile)
    assert caught.value.field.startswith(said)
    (tmp_path / "g.toml").write_text(f"profile = {json.dumps(profile)}\n" if not isinstance(profile, dict) else "")
    if not isinstance(profile, dict):
        with pytest.raises(ConfigError):
            load_config(tmp_path / "g.toml")
