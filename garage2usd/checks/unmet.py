"""The profile clauses that a garage does not meet: those violated, and those without a possible check."""

from collections.abc import Iterable, Mapping

from garage2usd.checks.finding import Finding, figure
from garage2usd.reading.report import UnmetClause

__all__ = ["not_checked_lines", "unmet_clauses"]


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
