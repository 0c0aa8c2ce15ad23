"""The profile clauses that a garage does not meet: those violated, and those without a possible check."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from garage2usd.checks.finding import Finding, figure
from garage2usd.reading.report import UnmetClause

__all__ = ["clauses_in_words", "found_in_words", "not_checked_lines", "unmet_clauses"]

_RULES_NAMED = 3
_SEVERITIES = (("error", "error"), ("warning", "warning"), ("info", "remark"))


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
    """Sum up a check: the number of clauses of a profile that were checked, and what was found by which rules."""
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
