"""Checks of a garage against a standard, feasibility and USD, reported as findings instead of exceptions."""

from collections.abc import Iterable
from dataclasses import replace

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks import access, aisle, circulation, clearance, feasibility, safety, stall, swept_path, usd
from garage2usd.checks.levels import findings_of_whole
from garage2usd.checks.rule import (
    Finding,
    Rule,
    as_json,
    as_table,
    clauses_in_words,
    found_in_words,
    not_checked_lines,
    unmet_clauses,
)
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.config import GarageConfig
from garage2usd.layout import Layout
from garage2usd.profiles import Profile, Severity
from garage2usd.reading.report import UnmetClause

__all__ = [
    "RULES",
    "Finding",
    "Rule",
    "Severity",
    "as_json",
    "as_table",
    "check_layout",
    "clauses_checked",
    "clauses_in_words",
    "findings_of",
    "found_in_words",
    "judged_layout",
    "not_checked",
    "not_checked_lines",
]

RULES: tuple[Rule, ...] = tuple(
    rule
    for module in (
        stall,
        aisle,
        circulation,
        clearance,
        access,
        safety,
        feasibility,
        usd,
        swept_path,  # last: it sets the limit of processor time for its own, slow work
    )
    for rule in module.BOOK.rules
)
"""All rules of the garage check."""
_LONG = (*usd.BOOK.rules, *swept_path.BOOK.rules)


def findings_of(garage: BuiltGarage, profile: Profile, *, progress: Progress = silent) -> list[Finding]:
    """Return the findings of a garage under a profile and the rules that need no profile, errors first.

    Each level is checked with its landings as portals; a finding's place is its path or name in the whole garage.
    `progress` is told the rules that are checked, then the stalls that are driven into.
    """
    asked = [(level, rule) for level in garage.levels for rule in RULES if rule not in swept_path.BOOK.rules]
    checked = [
        (level, finding)
        for level, rule in counted("rules", asked, len(asked), progress)
        for finding in rule.findings(level, profile)
    ]
    for level in garage.levels:
        swept_path.prove(level, profile, progress)
        checked += [(level, finding) for rule in swept_path.BOOK.rules for finding in rule.findings(level, profile)]
    found = [replace(finding, place=level.place.path_in_whole(finding.place)) for level, finding in checked]
    return sorted([*found, *findings_of_whole(garage, profile)], key=Finding.sort_key)


def not_checked(level: BuiltLevel, profile: Profile) -> dict[str, str]:
    """Return the profile clauses that no rule can check on a garage, each with the reason.

    A clause about a part that the garage lacks, such as the slope of ramps, is included.
    """
    reasons = {}
    for clause, _ in profile.clauses():
        rules = [rule for rule in RULES if clause in rule.clauses[: rule.asking]]
        hindrances = [rule.hindrance(level, profile) for rule in rules]
        if hindrances and all(hindrances):
            reasons[clause] = hindrances[0]
    return reasons


def clauses_checked(profile: Profile, left_out: Iterable[str] = ()) -> int:
    """Count the clauses of a profile that rules ask for, without those that cannot be checked on a garage."""
    asked = {clause for rule in RULES for clause in rule.clauses[: rule.asking]}
    return len(asked.intersection(name for name, _ in profile.clauses()).difference(left_out))


def check_layout(layout: Layout, config: GarageConfig) -> list[Finding]:
    """Return the findings of a generated layout under its profile, errors first.

    Notes
    -----
    Skips the rules of USD, which need a stage, and the proof that a car drives into each stall, which is slow.
    """
    return judged_layout(layout, config)[0]


def judged_layout(
    layout: Layout, config: GarageConfig, *, with_ways: bool = False
) -> tuple[list[Finding], tuple[UnmetClause, ...]]:
    """Check a layout as `check_layout` does, and return also the profile clauses that the garage does not meet.

    If `with_ways` is set, it also proves that a car drives into each stall, so that the findings are those of a stage.
    """
    garage = level_of_layout(layout, source="", kind="report")
    left_out = usd.BOOK.rules if with_ways else _LONG
    found = (finding for rule in RULES if rule not in left_out for finding in rule.findings(garage, config.standard))
    findings = sorted(found, key=Finding.sort_key)
    return findings, unmet_clauses(findings, not_checked(garage, config.standard))
