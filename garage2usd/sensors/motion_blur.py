"""What moves while a camera exposes: motion blur, and the shear of a rolling shutter."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.camera_effects import CameraEffects
from garage2usd.sensors.lenses import Lens, Pinhole
from garage2usd.sensors.twist import Twist

__all__ = ["exposed_in_motion"]

Floats = NDArray[np.float64]
_FARTHEST_M = 1e6
"""Where what has no depth is thought to be."""
_SHORT_S = 1e-5
_ITERATIONS = 5
_NEAR_PX = 0.75
"""A source that comes as near to a pixel as this is shown there."""
_ELSEWHERE_PX = 1e6
_WINDOWS = 0.25, 1.0
"""Half sides of the squares whose nearest surfaces may come over a pixel, in ways of the fastest one."""


def exposed_in_motion(
    light: NDArray[np.float32] | Floats,
    depth_m: NDArray[np.float32] | Floats,
    moving: NDArray[np.bool_],
    lens: Lens,
    twist: Twist,
    effects: CameraEffects,
) -> Floats:
    """Light that a moving camera gathers, of the light that it meets in the middle of the exposure of its middle row.

    Each pixel takes the mean over the times at which its row is open, of the place whose point is at the pixel then:
    that of the nearest surface where there are several. What was hidden in the middle of the exposure is taken from
    beside it, and what was outside of the picture from its edge.

    Parameters
    ----------
    light
        Linear; shape (rows, columns, 3).
    depth_m
        As recordings have it: along the axis for `Pinhole`, along the ray for others; infinite where there is nothing;
        shape (rows, columns).
    moving
        Which pixels show what moves by `twist`; the others show what stands before the camera; bool, shape (rows,
        columns).
    lens
        Not one of several eyes.
    twist
        How the camera moves, in its axes.
    effects
        Of which `exposure_s` and `readout_s` count.
    """
    from scipy.ndimage import map_coordinates  # noqa: PLC0415 - all who import this module would wait for it

    given = np.asarray(light, dtype=np.float64)
    if not effects.shows_motion:
        return given
    flow = _Flow(depth_m, moving, lens, twist, (effects.exposure_s + effects.readout_s) / 2)
    longest_px = flow.longest_px(effects.exposure_s)
    count = 1 if effects.exposure_s == 0 else int(np.ceil(longest_px)) + 1
    rows = (np.arange(given.shape[0]) + 0.5) / given.shape[0] - 0.5
    gathered = np.zeros(given.shape)
    for step in range(count):
        times = rows * effects.readout_s + ((step + 0.5) / count - 0.5) * effects.exposure_s
        places = flow.sources(times)
        for channel in range(given.shape[2]):
            gathered[..., channel] += map_coordinates(given[..., channel], places, order=1, mode="nearest")
    return gathered / count


class _Flow:
    """Where the points that pixels show are a while later: steady and growing in time, as a parabola."""

    def __init__(
        self,
        depth_m: NDArray[np.float32] | Floats,
        moving: NDArray[np.bool_],
        lens: Lens,
        twist: Twist,
        reach_s: float,
    ) -> None:
        middles = lens.middles()
        rays = lens.rays(middles)
        depth = np.minimum(np.nan_to_num(np.asarray(depth_m, dtype=np.float64), nan=np.inf), _FARTHEST_M).ravel()
        along = depth / rays[:, 2] if isinstance(lens, Pinhole) else depth
        points_m = rays * along[:, None]
        steady, growing = _parabola(points_m, lens, twist, reach_s)
        slow, _ = _parabola(points_m, lens, twist, _SHORT_S)
        is_lost = ~np.isfinite(steady).all(axis=1)  # what leaves the field of the lens
        steady[is_lost], growing[is_lost] = slow[is_lost], 0.0
        stands = ~moving.ravel() | ~np.isfinite(steady).all(axis=1)
        steady[stands], growing[stands] = 0.0, 0.0
        rows, columns = moving.shape
        shape = rows, columns
        self._moving = ~stands.reshape(shape)
        self._depth = depth.reshape(shape)
        self._steady = steady[:, ::-1].reshape(*shape, 2)  # rows first, as arrays have them
        self._growing = growing[:, ::-1].reshape(*shape, 2)
        self._grid = np.moveaxis(np.indices(shape).astype(np.float64), 0, -1)
        self._seeds = self._nearest(reach_s)

    def longest_px(self, seconds: float) -> float:
        """Of the ways that points take in a time around the middle, the picture's diagonal at most."""
        ways = np.hypot(*np.moveaxis(self._steady, -1, 0)) * seconds
        return float(min(ways.max(initial=0.0), np.linalg.norm(self._depth.shape)))

    def sources(self, times_s: Floats) -> Floats:
        """Which place each pixel shows at the time of its row, shape (rows,); shape (2, rows, columns)."""
        times = times_s[:, None, None]
        best, best_px, best_m = self._grid, np.full(self._depth.shape, np.inf), np.full(self._depth.shape, np.inf)
        for steady, growing in [(self._steady, self._growing), *self._seeds]:
            place = self._grid - (steady + growing * times) * times
            for _ in range(_ITERATIONS):
                at = self._at(place)
                moved = (self._steady[at] + self._growing[at] * times) * times
                off_px = np.abs(place + moved - self._grid).max(axis=-1)
                # what is uncovered shows no part of the vehicle, and nothing from outside of the field
                off_px += _ELSEWHERE_PX * ((off_px > _NEAR_PX) & (self._moving[at] != self._moving))
                depth = self._depth[at]
                fits, fitted = off_px <= _NEAR_PX, best_px <= _NEAR_PX
                # of surfaces that come to the pixel the nearest, of places on it the one that comes closest
                same = np.abs(depth - best_m) <= 0.02 * best_m
                better = np.where(fits & fitted & ~same, depth < best_m, off_px < best_px)
                best = np.where(better[..., None], place, best)
                best_px, best_m = np.where(better, off_px, best_px), np.where(better, depth, best_m)
                place = self._grid - moved
        return np.moveaxis(best, -1, 0)

    def _at(self, place: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        rows, columns = self._depth.shape
        row = np.clip(np.rint(place[..., 0]), 0, rows - 1).astype(np.intp)
        return row, np.clip(np.rint(place[..., 1]), 0, columns - 1).astype(np.intp)

    def _nearest(self, reach_s: float) -> list[tuple[Floats, Floats]]:
        """The flow of the nearest surface around each pixel, for windows from small to large."""
        from scipy.ndimage import minimum_filter  # noqa: PLC0415 - as above

        order = np.argsort(self._depth, axis=None, kind="stable")
        rank = np.empty(order.size, dtype=np.int64)
        rank[order] = np.arange(order.size)
        widest_px = self.longest_px(reach_s)
        sides = [2 * int(np.ceil(share * widest_px)) + 1 for share in _WINDOWS]
        flat = self._steady.reshape(-1, 2), self._growing.reshape(-1, 2)
        found = [order[minimum_filter(rank.reshape(self._depth.shape), size=side)] for side in sides if side > 1]
        return [(flat[0][nearest], flat[1][nearest]) for nearest in found]


def _parabola(points_m: Floats, lens: Lens, twist: Twist, reach_s: float) -> tuple[Floats, Floats]:
    """Pixels a second and a second squared, through where points are shown before, in and after the middle."""
    before, now, after = (lens.project(twist.seen_after(points_m, time)) for time in (-reach_s, 0.0, reach_s))
    return (after - before) / (2 * reach_s), (after + before - 2 * now) / (2 * reach_s**2)
