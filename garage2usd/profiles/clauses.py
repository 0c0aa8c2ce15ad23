"""What one clause of a standard asks for: a value with its unit, source and confidence."""

import math
from enum import StrEnum
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from garage2usd.common.settings import Settings

__all__ = [
    "Amount",
    "Area",
    "Clause",
    "Confidence",
    "Count",
    "Illuminance",
    "Length",
    "LengthRange",
    "LengthsByAngle",
    "Ratio",
    "Severity",
    "Steps",
]

_METRES = {"m": 1.0, "mm": 0.001, "cm": 0.01, "ft": 0.3048, "in": 0.0254}
LengthUnit = Literal["m", "mm", "cm", "ft", "in"]


class Confidence(StrEnum):
    """How well a value is known."""

    HIGH = "high"
    """Several sources agree."""
    MEDIUM = "medium"
    """One or two sources."""
    LOW = "low"
    """A weak source."""


class Severity(StrEnum):
    """How grave it is to miss a clause."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


class Clause(Settings):
    """What every clause says of itself."""

    source: str = Field(min_length=1, max_length=500)
    """Where the value was found."""
    confidence: Confidence
    """'high': several sources agree, 'medium': one or two, 'low': a weak one."""
    verified: bool = False
    """Whether the value was read in the wording of the source, not in what others say of it."""
    severity: Severity = Severity.ERROR
    """'error', 'warning' or 'info': what a finding of this clause is."""
    text: str = Field("", max_length=2000)
    """What the clause asks for, in words."""


class Amount(Clause):
    """A clause with one value, the least or the most that is allowed."""

    value: float = Field(gt=0, le=1e6)
    """The value, in `unit`."""

    @property
    def amount(self) -> float:
        """The value in the unit of `reported_in`."""
        return self.value

    @property
    def reported_in(self) -> str:
        """The unit of `amount`."""
        unit: str = self.unit  # type: ignore[attr-defined]
        return unit


class Length(Amount):
    """A length."""

    unit: LengthUnit
    """'m', 'mm', 'cm', 'ft' or 'in'."""

    @property
    def amount(self) -> float:
        """The length in metres."""
        return round(self.value * _METRES[self.unit], 9)

    @property
    def reported_in(self) -> str:
        """Metres."""
        return "m"


class Area(Amount):
    """A floor area."""

    unit: Literal["m2"]
    """'m2'."""


class Illuminance(Amount):
    """A mean illuminance."""

    unit: Literal["lx"]
    """'lx'."""


class Ratio(Amount):
    """A slope."""

    unit: Literal["%"]
    """'%'."""


class Count(Amount):
    """A number of things."""

    value: Annotated[int, Field(ge=1, le=1_000_000)]
    """The number."""
    unit: Literal["count"]
    """'count'."""


class LengthRange(Clause):
    """A length between two values."""

    least: float = Field(gt=0, le=1e6)
    """The least, in `unit`."""
    most: float = Field(gt=0, le=1e6)
    """The most, in `unit`."""
    unit: LengthUnit
    """'m', 'mm', 'cm', 'ft' or 'in'."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.most < self.least:
            raise ValueError(f"most of at least {self.least}")
        return self

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and most in metres."""
        factor = _METRES[self.unit]
        return round(self.least * factor, 9), round(self.most * factor, 9)


class LengthsByAngle(Clause):
    """A least length for stalls at several angles to their aisle, interpolated between these."""

    angles_deg: tuple[Annotated[float, Field(gt=0, lt=90)], ...] = Field(min_length=1)
    """Angles of stalls to their aisle, ascending."""
    values: tuple[Annotated[float, Field(gt=0, le=1e6)], ...] = Field(min_length=1)
    """The least length for each angle, in `unit`."""
    unit: LengthUnit
    """'m', 'mm', 'cm', 'ft' or 'in'."""

    @model_validator(mode="after")
    def _a_value_each(self) -> Self:
        if list(self.angles_deg) != sorted(set(self.angles_deg)):
            raise ValueError("angles in ascending order, each once")
        if len(self.values) != len(self.angles_deg):
            raise ValueError("as many values as angles")
        return self

    @property
    def reported_in(self) -> str:
        """Metres."""
        return "m"

    def amount_at(self, angle_deg: float, perpendicular_m: float | None = None) -> float:
        """The least length in metres for an angle; that of the nearest angle outside their range.

        Parameters
        ----------
        angle_deg
            Angle of the stalls.
        perpendicular_m
            The length for 90 degrees, if it is known from another clause.
        """
        angles_deg, values_m = list(self.angles_deg), [value * _METRES[self.unit] for value in self.values]
        if perpendicular_m is not None:
            angles_deg, values_m = [*angles_deg, 90.0], [*values_m, perpendicular_m]
        return round(float(np.interp(angle_deg, angles_deg, values_m)), 9)


class Steps(Clause):
    """A least number that grows with the number of stalls."""

    steps: tuple[tuple[Annotated[int, Field(ge=1)], Annotated[int, Field(ge=0)]], ...] = Field(min_length=1)
    """[number of stalls, least number up to it], ascending."""
    above: Annotated[int, Field(ge=0)] | None = None
    """Least number over the last step."""
    above_percent: float | None = Field(None, gt=0, le=100)
    """Least number over the last step, as a share of the stalls."""
    unit: Literal["count"]
    """'count'."""

    @model_validator(mode="after")
    def _ascending(self) -> Self:
        ends = [end for end, _ in self.steps]
        if ends != sorted(set(ends)):
            raise ValueError("steps in ascending order, each number of stalls once")
        if (self.above is None) == (self.above_percent is None):
            raise ValueError("one of above and above_percent")
        return self

    def required(self, stalls: int) -> int:
        """Least number for so many stalls."""
        for end, number in self.steps:
            if stalls <= end:
                return number
        if self.above is not None:
            return self.above
        return math.ceil((self.above_percent or 0.0) * stalls / 100 - 1e-9)
