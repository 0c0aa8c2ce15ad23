"""The rays of a picture's pixels."""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from garage2usd.render.lit_scene import Floats, dots
from garage2usd.sensors.rays.lenses import Lens


class PixelRays:
    """The rays of a picture's pixels.

    Attributes
    ----------
    origins, ways
        Of the middle of each pixel, in the world; float32, shape (pixels, 3).
    pixels
        Numbers of the pixels that have a ray.
    angle
        Between the rays of neighbouring pixels; float32, shape (pixels,).
    unseen
        Ids of the objects that they pass through.
    """

    def __init__(self, lens: Lens, to_world: NDArray[np.float64], unseen: Collection[int]) -> None:
        self.unseen = unseen
        places_px, (columns, rows) = lens.middles(), lens.size_px
        ways = lens.rays(places_px) @ to_world[:3, :3].T
        self.origins = (lens.starts(places_px) @ to_world[:3, :3].T + to_world[:3, 3]).astype(np.float32)
        self.ways = ways.astype(np.float32)
        self.pixels = np.flatnonzero(np.isfinite(ways).all(axis=1))
        grid = self.ways.reshape(rows, columns, 3)
        self._steps = [_step_along(grid, axis) for axis in (0, 1)]
        down, across = (np.linalg.norm(step, axis=1) for step in self._steps)
        self.angle = np.sqrt(down * across)

    def within(self, random: np.random.Generator) -> Floats:
        """Draw directions through points at random within the pixels that have a ray; float32, shape (n, 3)."""
        shares = random.random((2, len(self.pixels), 1), dtype=np.float32) - np.float32(0.5)
        ways = self.ways[self.pixels]
        for step, share in zip(self._steps, shares, strict=True):
            ways += step[self.pixels] * share
        ways /= np.sqrt(dots(ways, ways))[:, None]
        return ways


def _step_along(ways: Floats, axis: int) -> Floats:
    """Return how rays change from pixel to pixel along an axis, to the nearer neighbour; shape (pixels, 3)."""
    step = np.diff(ways, axis=axis)
    nothing = np.full_like(np.take(ways, [0], axis=axis), np.nan)
    behind, ahead = np.concatenate([nothing, step], axis=axis), np.concatenate([step, nothing], axis=axis)
    sizes = [np.nan_to_num(np.linalg.norm(each, axis=2), nan=np.inf) for each in (behind, ahead)]
    smaller = np.where((sizes[0] < sizes[1])[..., None], behind, ahead)
    return np.nan_to_num(smaller.reshape(-1, 3), nan=0.0)
