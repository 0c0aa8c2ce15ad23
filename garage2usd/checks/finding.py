"""What a check finds: which rule was missed where, by how much, and who asks for it."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from garage2usd.profiles import Severity

__all__ = ["Finding", "Severity", "as_json", "as_table", "figure"]

_WHOLE_FROM = 1000
_ORDER = {Severity.ERROR: 0, Severity.WARNING: 1, Severity.INFO: 2}


@dataclass(frozen=True)
class Finding:
    """One place that misses one rule.

    Attributes
    ----------
    rule
        Id of the rule.
    severity
        How grave it is.
    place
        Prim path, stall or square; empty for the whole garage.
    position_m
        (x, z) of the place in metres; None where there is no one place.
    measured, required
        What is there and what is asked for; None where it is nothing that is measured.
    unit
        Of both.
    source
        Who asks for it.
    message
        What is wrong, in words.
    clause
        Name of the clause that asks for it; empty where no profile does.
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

    def sort_key(self) -> tuple[int, str, str]:
        """Errors first, then by rule and place."""
        return _ORDER[self.severity], self.rule, self.place


def as_json(findings: Iterable[Finding]) -> list[dict[str, Any]]:
    """The findings as plain values."""
    return [asdict(finding) for finding in findings]


def as_table(findings: Iterable[Finding], *, most: int | None = None) -> list[str]:
    """The findings as lines of a table, at most `most` of each rule; without one, no line."""
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
    """A value with its unit as people read it; empty without one."""
    if value is None:
        return ""
    digits = f"{value:.0f}" if abs(value) >= _WHOLE_FROM else f"{value:.4g}"
    return digits if unit in {"count", ""} else f"{digits} {unit}"
