"""Roughness of floors from mirror-like to matt: packed textures for floors of any colour."""

from collections.abc import Callable

import numpy as np

from garage2usd.assets.fields import clouds, ramp
from garage2usd.assets.patterns import strokes
from garage2usd.assets.textures.pixels import Bakers, Pixels, levels

__all__ = ["GLOSSES"]

_SHAPE = 256, 256
_STEP = 3


def _gloss(smooth: float, rough: float) -> Callable[[np.random.Generator], Pixels]:
    """Texture between two roughness values: polished by use in places, dulled by dust and fine scratches in others."""

    def bake(rng: np.random.Generator) -> Pixels:
        dust = ramp(clouds(rng, _SHAPE, (5, 5), 3), 0.25, 0.75)
        scratches = strokes(rng, _SHAPE, 24, (20.0, 120.0), (1.0, 4.0), 0.12)
        share = np.clip(0.75 * dust + 0.5 * scratches, 0.0, 1.0)
        value = np.rint((smooth + (rough - smooth) * share) * (255 / _STEP)) * _STEP
        return levels(np.stack([np.full(_SHAPE, 255.0), value, np.zeros(_SHAPE)], axis=2))

    return bake


GLOSSES: Bakers = {
    "gloss_mirror.png": _gloss(0.06, 0.12),
    "gloss_polished.png": _gloss(0.15, 0.25),
    "gloss_satin.png": _gloss(0.30, 0.40),
    "gloss_matt.png": _gloss(0.60, 0.80),
}
