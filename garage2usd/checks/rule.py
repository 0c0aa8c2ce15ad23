"""The rule of a garage check: its id, requirement, profile clauses, and the function that finds its violations."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.finding import Finding, Severity
from garage2usd.garage import Point
from garage2usd.profiles import Clause, Length, LengthRange, Profile

__all__ = ["ROUNDING_M", "Miss", "Rule", "RuleBook", "always", "where_laid_out", "where_structure_is_known"]

ROUNDING_M = 1e-3
"""Tolerance in metres when a rule compares lengths."""


class Miss(NamedTuple):
    """A place that violates a rule; see `garage2usd.checks.finding.Finding`.

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
    """

    name: str
    asks: str
    clauses: tuple[str, ...]
    find: Find
    severity: Severity
    asking: int = 1
    hindrance: Hindrance = always

    def asked_by(self, profile: Profile) -> dict[str, Clause]:
        """Return the profile's clauses that state the rule's requirement, by name."""
        asking = {name: getattr(profile, name) for name in self.clauses[: self.asking]}
        return {name: clause for name, clause in asking.items() if clause is not None}

    def applies(self, profile: Profile) -> bool:
        """Return True if a profile requires the rule."""
        return not self.clauses or bool(self.asked_by(profile))

    def severity_in(self, profile: Profile) -> Severity:
        """Return the severity of a violation of the rule under a profile."""
        return next((clause.severity for clause in self.asked_by(profile).values()), self.severity)

    def findings(self, level: BuiltLevel, profile: Profile) -> Iterator[Finding]:
        """Yield the rule's violations in a garage as findings."""
        if not self.applies(profile):
            return
        name, clause = next(iter(self.asked_by(profile).items()), ("", None))
        for miss in self.find(level, profile):
            yield Finding(
                rule=self.name,
                severity=self.severity_in(profile),
                place=miss.place,
                message=miss.message,
                position_m=miss.position,
                measured=None if miss.measured is None else round(miss.measured, 4),
                required=None if miss.required is None else round(miss.required, 4),
                unit="" if miss.measured is None else _unit(clause),
                source=f"{clause.source} ({clause.confidence})" if clause else "garage2usd",
                clause=name,
            )


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
    ) -> Callable[[Find], Find]:
        """Register the decorated function as a rule that yields violations; for the parameters see `Rule`."""

        def added(find: Find) -> Find:
            self.rules.append(Rule(name, asks, clauses, find, severity, asking, hindrance))
            return find

        return added


def _unit(clause: Clause | None) -> str:
    if clause is None or isinstance(clause, Length | LengthRange):
        return "m"
    return str(getattr(clause, "unit", ""))
