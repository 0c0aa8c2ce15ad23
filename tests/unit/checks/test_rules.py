"""Every rule is proven by a garage that breaks it, and documented."""

import re

from support import broken_plans, broken_stages, broken_usd

from garage2usd.checks import RULES
from garage2usd.profiles import Profile

BROKEN_ELSEWHERE = {
    # in tests of their own, where two rules speak or figures are compared
    "stall-illuminance",
    "exit-distance",
    "exit-distance-sprinklered",
    "fire-compartment",
    "personnel-exits",
    "dead-end",
    "report-stalls",
    "plan-refused",
    "hydrant-spacing",
    "stretch-length",
    "swept-path-undecided",
    "motorcycle-path",
}


def broken_by_tables():
    tables = (
        broken_stages.BROKEN,
        broken_plans.DRAWN,
        broken_plans.SETTINGS_BROKEN,
        broken_plans.CLIENTS,
        broken_usd.BROKEN,
    )
    return [rule for table in (*tables, broken_plans.KINDS) for rule, *_ in table.values()]


def test_every_rule_has_a_garage_that_breaks_it():
    broken = broken_by_tables()
    assert set(broken) | BROKEN_ELSEWHERE == {rule.name for rule in RULES}
    assert len(broken) >= 40


def test_rules_have_names_of_their_own_and_read_clauses_that_there_are():
    assert len({rule.name for rule in RULES}) == len(RULES)
    for rule in RULES:
        assert re.fullmatch(r"[a-z]+(-[a-z]+)*", rule.name)
        assert set(rule.clauses) <= set(Profile.model_fields)


def test_every_clause_is_read_by_a_rule():
    read = {clause for rule in RULES for clause in rule.clauses}
    # swept-path takes the usual ones where a profile has none
    driven = {"design_car_height", "turning_radius"}
    # ramp-bend, a rule of several levels
    of_levels = {"curved_ramp_slope"}
    assert read | driven | of_levels == set(Profile.model_fields) - {"name", "title", "country", "based_on"}
