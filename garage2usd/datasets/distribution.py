"""Distributions of settings in a recipe: choice, range, log range, beta, log-normal, and mixtures."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from garage2usd.common.settings import Settings, validated
from garage2usd.native import elementary

Number = int | float
Weight = Annotated[float, Field(gt=0, le=1e9)]
Shape = Annotated[float, Field(ge=0.05, le=1000)]
_MOST_CHOICES = 10_000
_MOST_REDRAWS = 1000
_LEAST_SHARE = 0.01
"""Least share of a log-normal distribution that lies between its ends, so that redraws end."""


class Choice(Settings):
    """A discrete choice of values."""

    choice: tuple[Any, ...] = Field(min_length=1, max_length=_MOST_CHOICES)
    """The values, of any type that the setting takes."""
    weights: tuple[Weight, ...] | None = None
    """Relative weights of the values; equal if left out."""

    @model_validator(mode="after")
    def _one_weight_each(self) -> Self:
        if self.weights is not None and len(self.weights) != len(self.choice):
            raise ValueError(f"as many weights as values, {len(self.choice)}")
        return self

    def draw(self, random: np.random.Generator) -> Any:  # noqa: ANN401 - a value of any setting
        """Draw one of the values."""
        return self.choice[_weighted(random, self.weights or (1.0,) * len(self.choice))]

    def ends(self) -> tuple[Any, ...]:
        """Return all values."""
        return self.choice


class Range(Settings):
    """A uniform distribution between two numbers, both inclusive; of integers if both are integers."""

    range: tuple[Number, Number]
    """Least and greatest value."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        _check_ordered(self.range, above=-math.inf)
        return self

    def draw(self, random: np.random.Generator) -> Number:
        """Draw a number from the range."""
        low, high = self.range
        if isinstance(low, int) and isinstance(high, int):
            return int(random.integers(low, high, endpoint=True))
        return float(random.uniform(low, high))

    def ends(self) -> tuple[Number, Number]:
        """Return the least and greatest value."""
        return self.range


class LogRange(Settings):
    """A log-uniform distribution between two positive numbers, rounded to integers if both are integers."""

    log_range: tuple[Number, Number]
    """Least and greatest value."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        _check_ordered(self.log_range, above=0)
        return self

    def draw(self, random: np.random.Generator) -> Number:
        """Draw a number from the log range."""
        low, high = self.log_range
        drawn = float(f"{elementary.exp(random.uniform(elementary.log(low), elementary.log(high))):.9g}")
        if isinstance(low, int) and isinstance(high, int):
            return min(max(round(drawn), low), high)
        return min(max(drawn, low), high)

    def ends(self) -> tuple[Number, Number]:
        """Return the least and greatest value."""
        return self.log_range


class Beta(Settings):
    """A beta distribution, by default between 0 and 1."""

    beta: tuple[Shape, Shape]
    """The parameters alpha and beta; the mean is alpha / (alpha + beta)."""
    within: tuple[float, float] = (0.0, 1.0)
    """Least and greatest value, to which the distribution is scaled."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        _check_ordered(self.within, above=-math.inf)
        return self

    def draw(self, random: np.random.Generator) -> float:
        """Draw a number, rounded as logarithms differ in the last digit from processor to processor."""
        low, high = self.within
        return min(max(float(f"{low + (high - low) * random.beta(*self.beta):.9g}"), low), high)

    def ends(self) -> tuple[float, float]:
        """Return the least and greatest value."""
        return self.within


class LogNormal(Settings):
    """A log-normal distribution, cut at two ends; of integers if both ends are integers."""

    log_normal: tuple[Annotated[float, Field(gt=0, le=1e9)], Annotated[float, Field(gt=0, le=10)]]
    """Median, and standard deviation of the natural logarithm."""
    within: tuple[Number, Number]
    """Least and greatest value; other draws are repeated."""

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        _check_ordered(self.within, above=0)
        median, spread = self.log_normal
        low, high = (math.log(end / median) / (spread * math.sqrt(2)) for end in self._real_ends())
        if (math.erf(high) - math.erf(low)) / 2 < _LEAST_SHARE:
            raise ValueError(f"ends between which at least {_LEAST_SHARE:.0%} of the distribution lies")
        return self

    def draw(self, random: np.random.Generator) -> Number:
        """Draw a number between the ends."""
        median, spread = self.log_normal
        low, high = self._real_ends()
        for _ in range(_MOST_REDRAWS):
            drawn = float(f"{median * elementary.exp(spread * random.standard_normal()):.9g}")
            if low <= drawn <= high:
                break
        least, most = self.within
        if isinstance(least, int) and isinstance(most, int):
            return min(max(round(drawn), least), most)
        return min(max(drawn, least), most)

    def ends(self) -> tuple[Number, Number]:
        """Return the least and greatest value."""
        return self.within

    def _real_ends(self) -> tuple[float, float]:
        """Return the ends before rounding: integers take half a step on both sides."""
        low, high = self.within
        half = 0.5 if isinstance(low, int) and isinstance(high, int) else 0.0
        return low - half, high + half


class MixPart(Settings):
    """A component of a mixture."""

    weight: Weight = 1.0
    """Weight of the component relative to the others."""
    value: Any
    """A value or a distribution."""


class Mix(Settings):
    """A weighted mixture of distributions and values."""

    mix: tuple[MixPart, ...] = Field(min_length=1, max_length=_MOST_CHOICES)
    """Components of the mixture."""

    @model_validator(mode="after")
    def _readable(self) -> Self:
        for number, part in enumerate(self.mix):
            distribution_of(part.value, field=f"mix.{number}.value")
        return self

    def draw(self, random: np.random.Generator) -> Any:  # noqa: ANN401 - a value of any setting
        """Draw a value from one component."""
        part = self.mix[_weighted(random, [part.weight for part in self.mix])].value
        inner = distribution_of(part, field="mix")
        return part if inner is None else inner.draw(random)

    def ends(self) -> tuple[Any, ...]:
        """Return the extreme values of all components."""
        return tuple(self._ends())

    def _ends(self) -> Iterator[Any]:
        for part in self.mix:
            inner = distribution_of(part.value, field="mix")
            yield from (part.value,) if inner is None else inner.ends()


Distribution = Choice | Range | LogRange | Beta | LogNormal | Mix
_Key = Literal["choice", "range", "log_range", "beta", "log_normal", "mix"]
_KINDS: dict[_Key, type[Distribution]] = {
    "choice": Choice,
    "range": Range,
    "log_range": LogRange,
    "beta": Beta,
    "log_normal": LogNormal,
    "mix": Mix,
}


def distribution_of(value: object, *, field: str) -> Distribution | None:
    """Parse a recipe's value as a distribution; None for a plain value.

    Parameters
    ----------
    value
        A mapping with one of the keys ``choice``, ``range``, ``log_range``, ``beta``, ``log_normal`` and ``mix`` is a
        distribution.
    field
        The setting, for the error.

    Raises
    ------
    ConfigError
        If the mapping has one of these keys but is not a valid distribution.
    """
    if not isinstance(value, Mapping):
        return None
    for key, kind in _KINDS.items():
        if key in value:
            return validated(kind, value, within=field)
    return None


def _weighted(random: np.random.Generator, weights: Sequence[float]) -> int:
    """Draw an index by weights."""
    reached = np.cumsum(weights)
    return int(np.searchsorted(reached, random.random() * reached[-1], side="right"))


def _check_ordered(ends: tuple[Number, Number], *, above: float) -> None:
    low, high = ends
    if not above < low <= high:
        least = "" if above == -math.inf else f" over {above:g}"
        raise ValueError(f"the least and then the largest number{least}")
