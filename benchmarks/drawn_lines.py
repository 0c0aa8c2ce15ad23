"""Drawn garages by the lines of their stalls, which are what a detector has to see."""

import colorsys
import json
from pathlib import Path

from drawn_folder import ABOUT_FILE
from PIL import ImageColor

from garage2usd.common.errors import ConfigError
from garage2usd.config.look import StallPattern
from garage2usd.datasets import Recipe
from garage2usd.look.draws import drawn_look

__all__ = ["lines"]

_CLOSED = {StallPattern.CLOSED, StallPattern.DASHED}
_LEAST_SATURATION = 0.25


def lines(recipe: Recipe, garage: Path) -> str:
    """Whether the lines of a garage close its stalls at the aisle, and whether they are white, in words.

    Parameters
    ----------
    recipe
        What it was drawn of.
    garage
        Its folder of strips.

    Raises
    ------
    ConfigError
        If the folder does not have its seed.
    """
    about = garage / ABOUT_FILE
    try:
        seed = int(json.loads(about.read_text(encoding="utf-8"))["seed"])
    except (OSError, ValueError, LookupError, TypeError):
        raise ConfigError("drawn", str(about), "a table with the garage's seed, which `real.py draw` writes") from None
    config = recipe.drawn(seed)[0]
    markings = drawn_look(config.look, config.seed).markings
    _, saturation, _ = colorsys.rgb_to_hsv(*ImageColor.getrgb(markings.colour)[:3])
    form = "closed" if markings.pattern in _CLOSED else "open"
    return f"{form}, {'coloured' if saturation >= _LEAST_SATURATION else 'white'}"
