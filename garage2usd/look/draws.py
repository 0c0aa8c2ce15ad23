"""Axes of a look that the seed draws, by the shares in `drawn.toml`."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from garage2usd.common.documents import shipped_toml
from garage2usd.common.randomness import Step, named_generator
from garage2usd.config.look import LookConfig
from garage2usd.native import elementary

_BYTE = 255
_GROUPS = shipped_toml("garage2usd.look", "drawn")


def drawn_look(look: LookConfig, seed: int) -> LookConfig:
    """Complete a look: draw the axes in `drawn` by the seed, and keep the given ones.

    Each axis has its own random generator, so that a given axis does not change the draws of the others.
    """
    drawn, groups = frozenset(look.axes), dict[str, dict[str, Any]]()
    for group, axes in _GROUPS.items():
        values = groups[group] = {}
        for axis, how in axes.items():
            name = f"{group}.{axis}"
            if name in drawn:
                values[axis] = _drawn(named_generator(seed, Step.LOOK, name), how, values)
            else:
                values[axis] = getattr(getattr(look, group), axis)
    return LookConfig.model_validate({**groups, "textures": look.textures, "font": look.font})


def _drawn(generator: np.random.Generator, how: Mapping[str, Any], others: Mapping[str, Any]) -> object:
    """Draw a value as a table of `drawn.toml` tells, after the values of other axes of its group."""
    if "between" in how:
        low, high, step = how["between"]
        return round(low + step * int(generator.integers(round((high - low) / step) + 1)), 6)
    shares = how.get("shares_by", {}).get(others.get(how.get("of", "")), how["shares"])
    weights = {others[value[1:]] if str(value).startswith("=") else value: weight for value, weight in shares}
    limits = np.cumsum(list(weights.values()))
    value = list(weights)[int(np.searchsorted(limits, generator.random() * limits[-1], side="right"))]
    if "tone" not in how:
        return value
    factors = elementary.exp(generator.normal(0.0, how["tone"]) + generator.normal(0.0, how["hue"], 3))
    if not value.startswith("#"):
        return value
    channels = np.array([int(value[start : start + 2], 16) for start in (1, 3, 5)])
    red, green, blue = np.clip(np.rint(channels * factors), 0, _BYTE).astype(int).tolist()
    return f"#{red:02x}{green:02x}{blue:02x}"
