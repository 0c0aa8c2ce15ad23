"""Textures of worn paint in which paint and ground are combined."""

from collections.abc import Callable

import numpy as np

from garage2usd.assets.fields import clouds, grain, ramp, spots
from garage2usd.assets.textures.pixels import Bakers, Pixels, mixed_over, shaded

__all__ = ["GUARDS", "PAINTS"]

_Colour = tuple[int, int, int]
"""sRGB values."""


def _worn_paint(tint: tuple[float, float, float]) -> Callable[[np.random.Generator], Pixels]:
    """Road paint, 2.7 m per repeat, worn to the concrete in places and grey in the tyre tracks."""

    def bake(rng: np.random.Generator) -> Pixels:
        shape = 1024, 1024
        value = 222.0 + 20.0 * (clouds(rng, shape, (6, 6), 5) - 0.5) + 6.0 * (grain(rng, shape) - 0.5)
        value -= 34.0 * ramp(clouds(rng, shape, (5, 5), 5), 0.5, 0.78)
        worn = ramp(clouds(rng, shape, (22, 22), 5), 0.625, 0.67) * 0.85
        worn = np.maximum(worn, 0.8 * ramp(spots(rng, shape, 300, (1.5, 5.0)), 0.3, 0.6))
        return mixed_over(shaded(value, tint), (110, 108, 104), worn)

    return bake


def _stripes(light: _Colour, dark: _Colour, *, level: bool = False) -> Callable[[np.random.Generator], Pixels]:
    """Stripes of two colours, one of each per repeat, diagonal or level, scuffed to the concrete."""

    def bake(rng: np.random.Generator) -> Pixels:
        side = 256
        axis = np.arange(side)
        across = np.zeros(side, dtype=np.int64) if level else axis
        is_light = ((across[None, :] + axis[:, None]) % side) < side // 2
        pixels = np.where(is_light[:, :, None], np.array(light), np.array(dark)).astype(np.uint8)
        worn = 0.6 * ramp(clouds(rng, (side, side), (10, 10), 4), 0.62, 0.74)
        return mixed_over(pixels, (128, 126, 122), worn)

    return bake


_YELLOW = 222, 168, 24
PAINTS: Bakers = {
    "paint_white.jpg": _worn_paint((1.0, 1.0, 0.985)),
    "paint_yellow.jpg": _worn_paint((0.98, 0.74, 0.16)),
    "hazard.jpg": _stripes(_YELLOW, (28, 28, 30)),
}
GUARDS: Bakers = {
    "guard_red_white.jpg": _stripes((214, 212, 206), (172, 34, 30), level=True),
    "guard_blue_yellow.jpg": _stripes(_YELLOW, (34, 74, 150)),
}
