"""The finding of a check: the violated rule, its place, the measured and required values, and their source."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from garage2usd.profiles import Severity

__all__ = ["Finding", "Severity", "as_json", "as_table", "figure"]

_WHOLE_FROM = 1000
_ORDER = {Severity.ERROR: 0, Severity.WARNING: 1, Severity.INFO: 2}


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
