"""Axes of a look: the given value of each, or a value drawn by the seed."""

from collections.abc import Mapping
from typing import TypeVar

import numpy as np

from garage2usd.common.randomness import Step, named_generator
from garage2usd.config.look import LookConfig
from garage2usd.native import elementary

Value = TypeVar("Value")
_BYTE = 255


class Axes:
    """Source of all axes of a look."""

    def __init__(self, look: LookConfig, seed: int) -> None:
        self._look, self._drawn, self._seed = look, frozenset(look.axes), seed

    def of(self, group: str) -> "Group":
        """Return the axes of one group."""
        section = getattr(self._look, group)
        given = {
            key: getattr(section, key) for key in type(section).model_fields if f"{group}.{key}" not in self._drawn
        }
        return Group(group, given, self._seed)


class Group:
    """Axes of one group: each method returns the value of an axis, drawn if it is not given."""

    def __init__(self, name: str, given: Mapping[str, object], seed: int) -> None:
        self._name, self._given, self._seed = name, given, seed

    def one_of(self, axis: str, weights: Mapping[Value, float]) -> Value:
        """Draw one of several values by relative weights."""
        if axis in self._given:
            return self._given[axis]  # type: ignore[return-value]
        return self._pick(self._generator(axis), weights)

    def colour(self, axis: str, weights: Mapping[str, float], *, tone: float = 0.0, hue: float = 0.0) -> str:
        """Draw one of several colours ``#rrggbb``, made darker or lighter.

        Parameters
        ----------
        axis, weights
            As for `one_of`; a value that is not a colour is returned unchanged.
        tone
            Standard deviation of the logarithm of a factor on all three channels.
        hue
            Standard deviation of the logarithm of a factor on each channel.
        """
        if axis in self._given:
            return str(self._given[axis])
        generator = self._generator(axis)
        colour = self._pick(generator, weights)
        factors = elementary.exp(generator.normal(0.0, tone) + generator.normal(0.0, hue, 3))
        if not colour.startswith("#"):
            return colour
        channels = np.array([int(colour[start : start + 2], 16) for start in (1, 3, 5)])
        red, green, blue = np.clip(np.rint(channels * factors), 0, _BYTE).astype(int).tolist()
        return f"#{red:02x}{green:02x}{blue:02x}"

    def between(self, axis: str, low: float, high: float, step: float) -> float:
        """Draw a multiple of `step` between two multiples of it, uniformly."""
        if axis in self._given:
            return float(self._given[axis])  # type: ignore[arg-type]
        steps = round((high - low) / step)
        return round(low + step * int(self._generator(axis).integers(steps + 1)), 6)

    def _generator(self, axis: str) -> np.random.Generator:
        return named_generator(self._seed, Step.LOOK, f"{self._name}.{axis}")

    @staticmethod
    def _pick(generator: np.random.Generator, weights: Mapping[Value, float]) -> Value:
        limits = np.cumsum(list(weights.values()))
        place = generator.random() * limits[-1]
        return list(weights)[int(np.searchsorted(limits, place, side="right"))]
