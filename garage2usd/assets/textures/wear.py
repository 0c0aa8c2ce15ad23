"""Wear masks of paint, 0 to 255, 2.7 m per repeat; `worn_paint` gives them colours."""

from collections.abc import Callable

import numpy as np

from garage2usd.assets.fields import Field, clouds, noise, ramp, spots
from garage2usd.assets.textures.pixels import Bakers, Pixels, levels

__all__ = ["WEAR"]

_SHAPE = 512, 512


def _chips(rng: np.random.Generator, count: int) -> Field:
    """Chips where paint has come off the aggregate."""
    return ramp(spots(rng, _SHAPE, count, (1.0, 4.5)), 0.25, 0.5)


def _fresh(rng: np.random.Generator) -> Field:
    """Fresh paint with a film of dirt and few chips."""
    dirt = 0.2 * ramp(clouds(rng, _SHAPE, (4, 4), 4), 0.42, 0.72)
    return np.maximum(dirt, 0.75 * _chips(rng, 60))


def _worn(rng: np.random.Generator) -> Field:
    """Worn paint: off the aggregate in wide patches, thin between them."""
    where = clouds(rng, _SHAPE, (4, 4), 3)
    grains = clouds(rng, _SHAPE, (40, 40), 3)
    off = ramp(grains + 1.1 * (where - 0.5), 0.52, 0.68)
    thin = 0.12 + 0.3 * ramp(where, 0.4, 0.7)
    return np.maximum(np.maximum(off, thin), _chips(rng, 260))


def _gone(rng: np.random.Generator) -> Field:
    """Remains of paint in the hollows of the ground."""
    where = clouds(rng, _SHAPE, (5, 5), 3)
    grains = clouds(rng, _SHAPE, (36, 36), 4)
    left = ramp(grains + 0.9 * (where - 0.5), 0.52, 0.68)
    thin = 0.25 + 0.5 * noise(rng, _SHAPE, (9, 9))
    return 1.0 - left * (1.0 - 0.6 * thin)


def _ghost(rng: np.random.Generator) -> Field:
    """Trace of a line that was ground off or painted over, with remains of the old film."""
    trace = 0.8 + 0.3 * (clouds(rng, _SHAPE, (6, 6), 4) - 0.5)
    film = ramp(clouds(rng, _SHAPE, (30, 30), 3), 0.66, 0.74)
    return trace - 0.35 * film


def _in_levels(wear: Callable[[np.random.Generator], Field]) -> Callable[[np.random.Generator], Pixels]:
    return lambda rng: levels(255.0 * wear(rng))


WEAR: Bakers = {
    "wear_fresh.png": _in_levels(_fresh),
    "wear_worn.png": _in_levels(_worn),
    "wear_gone.png": _in_levels(_gone),
    "wear_ghost.png": _in_levels(_ghost),
}
