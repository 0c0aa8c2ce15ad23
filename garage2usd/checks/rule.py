"""The rules of checks: what a rule is, the findings of its violations, and the clauses that a garage does not meet."""
# Over 300 lines: findings are summed up beside the rules that make them.

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, NamedTuple

from garage2usd.as_built.level import BuiltLevel
from garage2usd.garage import Point
from garage2usd.profiles import Clause, Length, LengthRange, Profile, Severity
from garage2usd.reading.report import UnmetClause

_WHOLE_FROM = 1000
_ORDER = {Severity.ERROR: 0, Severity.WARNING: 1, Severity.INFO: 2}
_OF_SURVEYS = {Severity.INFO: ", as surveyed", Severity.WARNING: ", as the import chose it"}
ROUNDING_M = 1e-3
"""Tolerance in metres when a rule compares lengths."""
_RULES_NAMED = 3
_SEVERITIES = (("error", "error"), ("warning", "warning"), ("info", "remark"))


@dataclass(frozen=True)
class Finding:
    """A place that violates a rule of the garage check.

    Attributes
    ----------
    rule
        Id of the rule.
    severity
        Severity of the violation.
    place
        Prim path, stall or square; empty for the whole garage.
    position_m
        (x, z) of the place in metres; None without a single place.
    measured, required
        Measured and required values; None if the rule measures nothing.
    unit
        Unit of both values.
    source
        Source of the requirement.
    message
        Violation in words.
    clause
        Name of the profile clause that states the requirement; empty without one.
    """

    rule: str
    severity: Severity
    place: str
    message: str
    position_m: tuple[float, float] | None = None
    measured: float | None = None
    required: float | None = None
    unit: str = ""
    source: str = "garage2usd"
    clause: str = ""

    def in_survey(self, greatest: Severity) -> "Finding":
        """Return the finding in a surveyed garage: of a greatest severity, and with who answers for it."""
        severity = max(self.severity, greatest, key=_ORDER.__getitem__)
        return replace(self, severity=severity, message=self.message + _OF_SURVEYS.get(greatest, ""))

    def sort_key(self) -> tuple[int, str, str]:
        """Key that sorts errors first, then findings by rule and place."""
        return _ORDER[self.severity], self.rule, self.place


def as_json(findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """Convert findings to JSON values."""
    return [asdict(finding) for finding in findings]


def as_table(findings: Iterable[Finding], *, most: int | None = None) -> list[str]:
    """Format findings as lines of a table, at most `most` per rule; no line without findings."""
    rows, shown, left = [], dict[str, int](), dict[str, int]()
    for finding in findings:
        shown[finding.rule] = shown.get(finding.rule, 0) + 1
        if most is not None and shown[finding.rule] > most:
            left[finding.rule] = left.get(finding.rule, 0) + 1
            continue
        rows.append(
            (
                finding.severity.value,
                finding.rule,
                finding.place or "garage",
                "" if finding.position_m is None else "{:.2f}, {:.2f}".format(*finding.position_m),
                figure(finding.measured, finding.unit),
                figure(finding.required, finding.unit),
                finding.source,
                finding.message,
            )
        )
    if not rows:
        return []
    rows.insert(0, ("severity", "rule", "place", "x, z (m)", "measured", "required", "source", ""))
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return lines + [f"... and {count} more of {rule}" for rule, count in left.items()]


def figure(value: float | None, unit: str) -> str:
    """Format a measured value with its unit; empty without a value."""
    if value is None:
        return ""
    digits = f"{value:.0f}" if abs(value) >= _WHOLE_FROM else f"{value:.4g}"
    return digits if unit in {"count", ""} else f"{digits} {unit}"


class Miss(NamedTuple):
    """A place that violates a rule; see `garage2usd.checks.rule.Finding`.

    Attributes
    ----------
    things
        Prim paths of the objects at fault, if they can obstruct other stalls too.
    """

    place: str
    position: Point | None
    message: str
    measured: float | None = None
    required: float | None = None
    things: tuple[str, ...] = ()


Find = Callable[[BuiltLevel, Profile], Iterable[Miss]]

Hindrance = Callable[[BuiltLevel, Profile], str]
"""Function that explains why a rule cannot be checked on a garage; it returns an empty string if the rule can be."""


def always(_: BuiltLevel, __: Profile) -> str:
    """Let a rule be checked on every garage."""
    return ""


def where_laid_out(level: BuiltLevel, _: Profile) -> str:
    """Explain why a rule about objects cannot be checked on a plan without a layout."""
    return "" if level.things else "there are no objects, only a plan"


def where_structure_is_known(level: BuiltLevel, _: Profile) -> str:
    """Explain why a rule about squares cannot be checked on a stage without the matrices S, R and C."""
    return "" if level.structure is not None else "the stage does not tell S, R and C"


@dataclass(frozen=True)
class Rule:
    """A rule of the garage check.

    Attributes
    ----------
    name
        Id of the rule.
    asks
        Requirement in words.
    clauses
        Names of the profile clauses that the rule reads.
    asking
        Number of leading `clauses` that state a requirement; the rule applies only if the profile has one of these.
        Unit, source and severity are those of the first one in the profile.
    find
        Function that yields every violation of the rule.
    hindrance
        Function that explains why the rule cannot be checked.
    severity
        Severity of a rule that reads no clause.
    in_surveys
        Greatest severity in a surveyed garage: of what the survey says a remark, of what its import chose a warning.
    """

    name: str
    asks: str
    clauses: tuple[str, ...]
    find: Find
    severity: Severity
    in_surveys: Severity
    asking: int = 1
    hindrance: Hindrance = always

    def asked_by(self, profile: Profile) -> dict[str, Clause]:
        """Return the profile's clauses that state the rule's requirement, by name."""
        asking = {name: getattr(profile, name) for name in self.clauses[: self.asking]}
        return {name: clause for name, clause in asking.items() if clause is not None}

    def applies(self, profile: Profile) -> bool:
        """Return True if a profile requires the rule."""
        return not self.clauses or bool(self.asked_by(profile))

    def severity_in(self, profile: Profile, level: BuiltLevel) -> Severity:
        """Return the severity of a violation of the rule under a profile on a level."""
        asked = next((clause.severity for clause in self.asked_by(profile).values()), self.severity)
        return max(asked, self.in_surveys, key=_ORDER.__getitem__) if level.is_surveyed else asked

    def findings(self, level: BuiltLevel, profile: Profile) -> Iterator[Finding]:
        """Yield the rule's violations in a garage as findings."""
        if not self.applies(profile):
            return
        name, clause = next(iter(self.asked_by(profile).items()), ("", None))
        for miss in self.find(level, profile):
            found = Finding(
                rule=self.name,
                severity=self.severity if clause is None else clause.severity,
                place=miss.place,
                message=miss.message,
                position_m=miss.position,
                measured=None if miss.measured is None else round(miss.measured, 4),
                required=None if miss.required is None else round(miss.required, 4),
                unit="" if miss.measured is None else _unit(clause),
                source=f"{clause.source} ({clause.confidence})" if clause else "garage2usd",
                clause=name,
            )
            yield found.in_survey(self.in_surveys) if level.is_surveyed else found


class RuleBook:
    """The rules of one module of checks, in source order."""

    def __init__(self) -> None:
        """Create an empty rule book."""
        self.rules: list[Rule] = []

    def rule(
        self,
        name: str,
        *clauses: str,
        asks: str,
        asking: int = 1,
        hindrance: Hindrance = always,
        severity: Severity = Severity.ERROR,
        in_surveys: Severity | None = None,
    ) -> Callable[[Find], Find]:
        """Register a rule by its function; see `Rule`. In surveys, a rule with clauses makes remarks if not told."""
        in_surveys = in_surveys or (Severity.INFO if clauses else Severity.ERROR)

        def added(find: Find) -> Find:
            self.rules.append(Rule(name, asks, clauses, find, severity, in_surveys, asking, hindrance))
            return find

        return added


def _unit(clause: Clause | None) -> str:
    if clause is None or isinstance(clause, Length | LengthRange):
        return "m"
    return str(getattr(clause, "unit", ""))


def unmet_clauses(findings: Iterable[Finding], not_checked: Mapping[str, str]) -> tuple[UnmetClause, ...]:
    """List the profile clauses that a garage does not meet, one entry per clause.

    Parameters
    ----------
    findings
        Findings of the garage, the most severe first.
    not_checked
        Clauses that no rule can check, each with the reason.
    """
    missed: dict[str, list[Finding]] = {}
    for finding in findings:
        if finding.clause:
            missed.setdefault(finding.clause, []).append(finding)
    entries = [_missed(clause, places) for clause, places in missed.items()]
    entries += [
        UnmetClause(clause=clause, places=0, reason=f"not checked, as {reason}")
        for clause, reason in not_checked.items()
    ]
    return tuple(sorted(entries, key=lambda entry: entry.clause))


def clauses_in_words(count: int, name: str) -> str:
    """Tell how many clauses of the profile of a name were checked."""
    return f"{count or 'no'} clause{'' if count in {0, 1} else 's'} of {name} checked"


def found_in_words(findings: Sequence[Finding], clauses: int, name: str) -> str:
    """Summarise a check: the number of checked clauses of a profile, and the findings by rule."""
    told = clauses_in_words(clauses, name)
    counts = Counter(finding.severity.value for finding in findings)
    parts = [f"{counts[key]} {word}{'' if counts[key] == 1 else 's'}" for key, word in _SEVERITIES if counts[key]]
    if not parts:
        return f"{told}: nothing found" if clauses else told
    rules = list(dict.fromkeys(finding.rule for finding in findings))[:_RULES_NAMED]
    return f"{told}: {', '.join(parts)} ({', '.join(rules)})"


def not_checked_lines(not_checked: Mapping[str, str]) -> list[str]:
    """Format one line per reason, with all clauses that are not checked for that reason."""
    by_reason: dict[str, list[str]] = {}
    for clause, reason in not_checked.items():
        by_reason.setdefault(reason, []).append(clause)
    return [f"not checked: {', '.join(clauses)}, as {reason}" for reason, clauses in by_reason.items()]


def _missed(clause: str, places: list[Finding]) -> UnmetClause:
    first = places[0]
    parts = [first.message]
    if first.measured is not None:
        measured, required = (figure(value, first.unit) for value in (first.measured, first.required))
        parts.append(f"{measured} where {required} is asked for")
    if first.place:
        parts.append(f"at {first.place}" + (f" and {len(places) - 1} more" if len(places) > 1 else ""))
    return UnmetClause(
        clause=clause,
        places=len(places),
        measured=first.measured,
        required=first.required,
        unit=first.unit,
        reason=", ".join(parts),
    )
