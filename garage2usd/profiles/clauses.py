"""Clauses of a standard: each a value with its unit, source and confidence."""

import math
from enum import StrEnum
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from garage2usd.common.settings import Settings

_METRES = {"m": 1.0, "mm": 0.001, "cm": 0.01, "ft": 0.3048, "in": 0.0254}
LengthUnit = Literal["m", "mm", "cm", "ft", "in"]


class Confidence(StrEnum):
    """Confidence in the value of a clause."""

    HIGH = "high"
    """Confirmed by several sources."""
    MEDIUM = "medium"
    """Found in one or two sources."""
    LOW = "low"
    """Found in a weak source."""


class Severity(StrEnum):
    """Severity of a violated clause."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


class Clause(Settings):
    """Fields of every clause: source, confidence, severity and wording."""

    source: str = Field(min_length=1, max_length=500)
    """Source of the value."""
    confidence: Confidence
    """'high': several sources agree, 'medium': one or two, 'low': a weak one."""
    verified: bool = False
    """True if the value was read in the original text of the source instead of a secondary one."""
    severity: Severity = Severity.ERROR
    """'error', 'warning' or 'info': severity of a violation."""
    text: str = Field("", max_length=2000)
    """Requirement of the clause in words."""


class Amount(Clause):
    """A clause with one value, the least or the greatest that is allowed."""

    value: float = Field(gt=0, le=1e6)
    """The value, in `unit`."""

    @property
    def amount(self) -> float:
        """The value in the unit of `reported_in`."""
        return self.value

    @property
    def reported_in(self) -> str:
        """Unit of `amount`."""
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
    """A count of objects."""

    value: Annotated[int, Field(ge=1, le=1_000_000)]
    """The number."""
    unit: Literal["count"]
    """'count'."""


class LengthRange(Clause):
    """A length with a lower and an upper bound."""

    least: float = Field(gt=0, le=1e6)
    """Lower bound, in `unit`."""
    most: float = Field(gt=0, le=1e6)
    """Upper bound, in `unit`."""
    unit: LengthUnit
    """'m', 'mm', 'cm', 'ft' or 'in'."""

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.most < self.least:
            raise ValueError(f"most of at least {self.least}")
        return self

    @property
    def bounds(self) -> tuple[float, float]:
        """Lower and upper bound in metres."""
        factor = _METRES[self.unit]
        return round(self.least * factor, 9), round(self.most * factor, 9)


class LengthsByAngle(Clause):
    """A least length for stalls by their angle to the aisle, interpolated between the given angles."""

    angles_deg: tuple[Annotated[float, Field(gt=0, lt=90)], ...] = Field(min_length=1)
    """Angles of stalls to the aisle in degrees, ascending."""
    values: tuple[Annotated[float, Field(gt=0, le=1e6)], ...] = Field(min_length=1)
    """Least length for each angle, in `unit`."""
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
        """Least length in metres for stalls at an angle; outside the given angles, that of the nearest one.

        Parameters
        ----------
        angle_deg
            Angle of the stalls to the aisle.
        perpendicular_m
            Length in metres for 90 degrees, if another clause gives it.
        """
        angles_deg, values_m = list(self.angles_deg), [value * _METRES[self.unit] for value in self.values]
        if perpendicular_m is not None:
            angles_deg, values_m = [*angles_deg, 90.0], [*values_m, perpendicular_m]
        return round(float(np.interp(angle_deg, angles_deg, values_m)), 9)


class Steps(Clause):
    """A least count that grows with the number of stalls."""

    steps: tuple[tuple[Annotated[int, Field(ge=1)], Annotated[int, Field(ge=0)]], ...] = Field(min_length=1)
    """[number of stalls, least count up to this number], ascending."""
    above: Annotated[int, Field(ge=0)] | None = None
    """Least count above the last step."""
    above_percent: float | None = Field(None, gt=0, le=100)
    """Least count above the last step, as a percentage of the stalls."""
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
        """Least count for a number of stalls."""
        for end, number in self.steps:
            if stalls <= end:
                return number
        if self.above is not None:
            return self.above
        return math.ceil((self.above_percent or 0.0) * stalls / 100 - 1e-9)
