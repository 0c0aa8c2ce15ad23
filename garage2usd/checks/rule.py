"""A rule: an id, what it asks for, the clauses that it reads, how it finds what misses it, and when it cannot tell."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.checks.finding import Finding, Severity
from garage2usd.garage import Point
from garage2usd.profiles import Clause, Length, LengthRange, Profile

__all__ = ["ROUNDING_M", "Miss", "Rule", "RuleBook", "always", "where_laid_out", "where_structure_is_known"]

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


Find = Callable[[BuiltGarage, Profile], Iterable[Miss]]
Hindrance = Callable[[BuiltGarage, Profile], str]
"""Why a rule cannot be checked; empty where it can."""


def always(_: BuiltGarage, __: Profile) -> str:
    """Nothing hinders it."""
    return ""


def where_laid_out(garage: BuiltGarage, _: Profile) -> str:
    """A plan that could not be laid out has no objects."""
    return "" if garage.things else "there are no objects, only a plan"


def where_structure_is_known(garage: BuiltGarage, _: Profile) -> str:
    """The stages of others have no S, R and C."""
    return "" if garage.structure is not None else "the stage does not tell S, R and C"


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
        The clauses of a profile that it reads.
    asking
        How many of them, from the first on, ask for something; without all of these in a profile it asks for nothing.
        Unit, source and severity are those of the first one that there is.
    find
        Gives every place that misses it.
    hindrance
        Why it cannot be checked.
    severity
        Of a rule that reads no clause.
    """

    name: str
    asks: str
    clauses: tuple[str, ...]
    find: Find
    severity: Severity
    asking: int = 1
    hindrance: Hindrance = always

    def asked_by(self, profile: Profile) -> dict[str, Clause]:
        """The clauses of a profile that ask for it, by name."""
        asking = {name: getattr(profile, name) for name in self.clauses[: self.asking]}
        return {name: clause for name, clause in asking.items() if clause is not None}

    def applies(self, profile: Profile) -> bool:
        """Whether it asks for anything."""
        return not self.clauses or bool(self.asked_by(profile))

    def severity_in(self, profile: Profile) -> Severity:
        """How grave it is to miss it."""
        return next((clause.severity for clause in self.asked_by(profile).values()), self.severity)

    def findings(self, garage: BuiltGarage, profile: Profile) -> Iterator[Finding]:
        """What misses the rule."""
        if not self.applies(profile):
            return
        name, clause = next(iter(self.asked_by(profile).items()), ("", None))
        for miss in self.find(garage, profile):
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
    """The rules of one module, in the order in which they are written."""

    def __init__(self) -> None:
        """An empty one."""
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
        """Make a rule of the function that finds what misses it; for the rest see `Rule`."""

        def added(find: Find) -> Find:
            self.rules.append(Rule(name, asks, clauses, find, severity, asking, hindrance))
            return find

        return added


def _unit(clause: Clause | None) -> str:
    if clause is None or isinstance(clause, Length | LengthRange):
        return "m"
    return str(getattr(clause, "unit", ""))
