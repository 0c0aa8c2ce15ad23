"""A garage is designed to its profile: it passes its own check, and what the user sets stays."""

import json
from collections import Counter

import pytest
from support.soak import soak_but

from garage2usd.as_built.garage import garage_as_made
from garage2usd.checks import Severity, check_layout, findings_of
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, SiteConfig, load_config
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
    subject = garage_as_made(garage, source="", kind="report")
    return [f for f in findings_of(subject, config.standard) if f.severity is Severity.ERROR], garage


def test_the_default_profile_changes_no_default():
    plain = GarageConfig()
    assert plain.profile == "cn-jgj100"
    assert not plain.site.model_fields_set | plain.bay.model_fields_set | plain.fittings.model_fields_set


@pytest.mark.parametrize("dimensioned", [False, True])
@pytest.mark.parametrize("profile", soak_but(["de-garvo"], PROFILE_NAMES))
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
@pytest.mark.parametrize("profile", soak_but(["de-garvo"], PROFILE_NAMES))
@pytest.mark.parametrize("seed", [0, 7])
def test_a_garage_planned_by_the_default_rules_circulates(seed, profile, dimensioned):
    plan = {"episodes": 150, "starts": 1}
    config = GarageConfig(seed=seed, profile=profile, plan=plan, bay={"dimensioned": dimensioned})
    garage = generate(config)
    assert not circulation(garage.plan.structure).faults(rules_of(config.plan, squares=63))
    found = check_layout(garage.layout, config)
    assert not CIRCULATION & {finding.rule for finding in found}


def test_a_garage_planned_for_the_score_alone_does_not_circulate():
    config = GarageConfig(seed=1, plan={"episodes": 150, "circulation": "allow"})
    garage = generate(config)
    found = {finding.rule: finding for finding in check_layout(garage.layout, config)}
    assert {"dead-end-depth", "loop"} <= set(found)
    assert {found[rule].severity for rule in CIRCULATION & set(found)} == {Severity.WARNING}


def test_ada_gives_accessible_stalls_by_its_table():
    config = GarageConfig(profile="us-ada", plan={"episodes": 150})
    uses = Counter(str(stall.use) for stall in generate(config).layout.stalls)
    assert uses["accessible"] == load_profile("us-ada").accessible_stalls.required(uses.total())
    assert uses["accessible"] > 2


@pytest.mark.parametrize("seed", soak_but(3, range(12)))
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


def clause(value, unit="m"):
    return {"value": value, "unit": unit, "source": "the client", "confidence": "high"}


@pytest.mark.parametrize(
    ("clauses", "section", "expected"),
    [
        ({"end_clearance": clause(0.8)}, "bay", {"stall_length_m": 5.6}),
        ({"stall_length": clause(4.5)}, "bay", {"stall_length_m": 4.8}),
        ({"design_car_length": clause(5.4), "end_clearance": clause(0.3)}, "bay", {"stall_length_m": 5.7}),
        ({"design_car_width": clause(2.0)}, "bay", {"stall_width_m": 2.6}),
        ({"column_clearance": clause(0.45)}, "bay", {"wall_gap_m": 0.45}),
        ({"wall_clearance": clause(0.7)}, "bay", {"wall_gap_m": 0.4}),
        ({"dead_end_depth": clause(10)}, "plan", {"dead_end_cells": 1}),
        ({"stretch_length": clause(61)}, "plan", {"longest_stretch_cells": 7}),
        ({"portal_distance": clause(25)}, "site", {"min_portal_distance_cells": 6}),
        ({"portal_distance": clause(90)}, "site", {"min_portal_distance_cells": 7}),
        ({"ramp_transition_slope": clause(10, "%")}, "fittings", {}),
        ({"ramp_transition_length": clause(4.5)}, "fittings", {"ramp_transition_m": 4.5}),
        ({"ramp_slope": clause(2, "%")}, "fittings", {"ramp_slope_percent": 5}),
        ({"clear_height": clause(7)}, "fittings", {"clear_height_m": 6, "ceiling_height_m": 7.15}),
        ({"portal_width": clause(9)}, "bay", {"portal_width_m": 5.8}),
    ],
)
def test_each_clause_has_its_setting(clauses, section, expected):
    model = getattr(GarageConfig(profile={"name": "client", **clauses}), section)
    assert {
        name: getattr(model, name) for name in model.model_fields_set - {"square_side_m", "dimensioned"}
    } == expected


@pytest.mark.parametrize(
    ("least", "most", "side_m"),
    [(8.1, 8.5, 8.1), (8.25, 8.3, 8.25), (6.8, 7.2, 6.8), (5.3, 8.5, None), (5.4, 6.0, None)],
)
def test_columns_on_a_grid_stand_on_one(least, most, side_m):
    """A uniform one, unless lines that just fit keep it anyway, or aisles do not find room."""
    spacing = {"least": least, "most": most, "unit": "m", "source": "the client", "confidence": "high"}
    bay = GarageConfig(profile={"name": "client", "column_spacing": spacing}).bay
    assert (None if bay.dimensioned else bay.square_side_m) == side_m


@pytest.mark.parametrize("seed", soak_but(1, range(4)))
@pytest.mark.parametrize("profile", soak_but(["de-garvo"], PROFILE_NAMES))
def test_default_garages_get_no_remark_of_their_own_checker(profile, seed):
    config = GarageConfig(seed=seed, profile=profile, plan={"episodes": 150, "starts": 1})
    garage = generate(config)
    assert check_layout(garage.layout, config) == []
