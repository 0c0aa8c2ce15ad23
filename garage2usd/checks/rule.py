"""A rule: an id, what it asks for, the clauses that it reads, and how it finds what misses it."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from garage2usd.checks.finding import Finding, Severity
from garage2usd.checks.subject import Subject
from garage2usd.profiles import Clause, Length, LengthRange, Profile
from garage2usd.reading.ground import Point

__all__ = ["ROUNDING_M", "Miss", "Rule", "RuleBook"]

ROUNDING_M = 1e-3
"""Lengths that differ by less are the same."""


class Miss(NamedTuple):
    """A place that misses a rule; see `garage2usd.checks.finding.Finding`.

    Attributes
    ----------
    things
        Prim paths of the objects that are at fault, where they may be in the way of other stalls too.
    """

    place: str
    position: Point | None
    message: str
    measured: float | None = None
    required: float | None = None
    things: tuple[str, ...] = ()


Find = Callable[[Subject, Profile], Iterable[Miss]]


@dataclass(frozen=True)
class Rule:
    """One rule.

    Attributes
    ----------
    name
        Its id.
    asks
        What it asks for, in words.
    clauses
        The clauses of a profile that it reads. Without the first one in a profile it asks for nothing; unit, source and
        severity are that one's.
    find
        Gives every place that misses it.
    severity
        Of a rule that reads no clause.
    """

    name: str
    asks: str
    clauses: tuple[str, ...]
    find: Find
    severity: Severity

    def findings(self, subject: Subject, profile: Profile) -> Iterator[Finding]:
        """What misses the rule."""
        clause: Clause | None = getattr(profile, self.clauses[0]) if self.clauses else None
        if self.clauses and clause is None:
            return
        for miss in self.find(subject, profile):
            yield Finding(
                rule=self.name,
                severity=clause.severity if clause else self.severity,
                place=miss.place,
                message=miss.message,
                position_m=miss.position,
                measured=None if miss.measured is None else round(miss.measured, 4),
                required=None if miss.required is None else round(miss.required, 4),
                unit="" if miss.measured is None else _unit(clause),
                source=f"{clause.source} ({clause.confidence})" if clause else "garage2usd",
            )


class RuleBook:
    """The rules of one module, in the order in which they are written."""

    def __init__(self) -> None:
        """An empty one."""
        self.rules: list[Rule] = []

    def rule(self, name: str, *clauses: str, asks: str, severity: Severity = Severity.ERROR) -> Callable[[Find], Find]:
        """Make a rule of the function that finds what misses it."""

        def added(find: Find) -> Find:
            self.rules.append(Rule(name, asks, clauses, find, severity))
            return find

        return added


def _unit(clause: Clause | None) -> str:
    if clause is None or isinstance(clause, Length | LengthRange):
        return "m"
    return str(getattr(clause, "unit", ""))
