"""Distributions that a recipe has in place of values: choice, range, log range, and mixes of them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from garage2usd.common.settings import Settings, validated

__all__ = ["Choice", "Distribution", "LogRange", "Mix", "Range", "distribution_of"]

Number = int | float
Weight = Annotated[float, Field(gt=0, le=1e9)]
_MOST_CHOICES = 10_000


class Choice(Settings):
    """One of some values."""

    choice: tuple[Any, ...] = Field(min_length=1, max_length=_MOST_CHOICES)
    """The values, of any kind that the setting takes."""
    weights: tuple[Weight, ...] | None = None
    """How often each is drawn in relation to the others; left out, all alike."""

    @model_validator(mode="after")
    def _one_weight_each(self) -> Self:
        if self.weights is not None and len(self.weights) != len(self.choice):
            raise ValueError(f"as many weights as values, {len(self.choice)}")
        return self

    def draw(self, random: np.random.Generator) -> Any:  # noqa: ANN401 - a value of any setting
        """One of the values."""
        return self.choice[_weighted(random, self.weights or (1.0,) * len(self.choice))]

    def ends(self) -> tuple[Any, ...]:
        """All values."""
        return self.choice


class Range(Settings):
    """A number between two, both of them possible: whole where both are, each as likely as any other."""

    range: tuple[Number, Number]
    """The least and the largest."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        _check_ordered(self.range, above=-math.inf)
        return self

    def draw(self, random: np.random.Generator) -> Number:
        """A number of the range."""
        low, high = self.range
        if isinstance(low, int) and isinstance(high, int):
            return int(random.integers(low, high, endpoint=True))
        return float(random.uniform(low, high))

    def ends(self) -> tuple[Number, Number]:
        """The least and the largest."""
        return self.range


class LogRange(Settings):
    """A number over 0 between two, whose logarithm is as likely as any other; rounded to whole where both are whole."""

    log_range: tuple[Number, Number]
    """The least and the largest."""

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        _check_ordered(self.log_range, above=0)
        return self

    def draw(self, random: np.random.Generator) -> Number:
        """A number of the range."""
        low, high = self.log_range
        # nine digits, as machines may differ in the last one of a logarithm
        drawn = float(f"{math.exp(random.uniform(math.log(low), math.log(high))):.9g}")
        if isinstance(low, int) and isinstance(high, int):
            return min(max(round(drawn), low), high)
        return min(max(drawn, low), high)

    def ends(self) -> tuple[Number, Number]:
        """The least and the largest."""
        return self.log_range


class MixPart(Settings):
    """A part of a mix."""

    weight: Weight = 1.0
    """How often it is drawn in relation to the others."""
    value: Any
    """A value, or a distribution."""


class Mix(Settings):
    """One of some distributions or values, by their weights."""

    mix: tuple[MixPart, ...] = Field(min_length=1, max_length=_MOST_CHOICES)
    """The parts."""

    @model_validator(mode="after")
    def _readable(self) -> Self:
        for number, part in enumerate(self.mix):
            distribution_of(part.value, field=f"mix.{number}.value")
        return self

    def draw(self, random: np.random.Generator) -> Any:  # noqa: ANN401 - a value of any setting
        """A value of one of the parts."""
        part = self.mix[_weighted(random, [part.weight for part in self.mix])].value
        inner = distribution_of(part, field="mix")
        return part if inner is None else inner.draw(random)

    def ends(self) -> tuple[Any, ...]:
        """The ends of all parts."""
        return tuple(self._ends())

    def _ends(self) -> Iterator[Any]:
        for part in self.mix:
            inner = distribution_of(part.value, field="mix")
            yield from (part.value,) if inner is None else inner.ends()


Distribution = Choice | Range | LogRange | Mix
_Key = Literal["choice", "range", "log_range", "mix"]
_KINDS: dict[_Key, type[Distribution]] = {"choice": Choice, "range": Range, "log_range": LogRange, "mix": Mix}


def distribution_of(value: object, *, field: str) -> Distribution | None:
    """The distribution that a value of a recipe is; None where it is the value itself.

    Parameters
    ----------
    value
        A mapping with one of the keys ``choice``, ``range``, ``log_range`` and ``mix`` is a distribution.
    field
        The setting, for the error.

    Raises
    ------
    ConfigError
        If it has one of these keys and is no such distribution.
    """
    if not isinstance(value, Mapping):
        return None
    for key, kind in _KINDS.items():
        if key in value:
            return validated(kind, value, within=field)
    return None


def _weighted(random: np.random.Generator, weights: Sequence[float]) -> int:
    """The number of one of some weights."""
    reached = np.cumsum(weights)
    return int(np.searchsorted(reached, random.random() * reached[-1], side="right"))


def _check_ordered(ends: tuple[Number, Number], *, above: float) -> None:
    low, high = ends
    if not above < low <= high:
        least = "" if above == -math.inf else f" over {above:g}"
        raise ValueError(f"the least and then the largest number{least}")
