"""Motion blur and rolling shutter: the motion of a camera during its exposure."""

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.rays.lenses import Lens, Pinhole
from garage2usd.sensors.rig.poses import Twist
from garage2usd.sensors.rig.sensors import CameraEffects

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
_COMPLEX = np.array([1, 1j])
_FARTHEST_M = 1e6
"""Assumed depth of pixels without a surface."""
_SHORT_S = 1e-5
_ITERATIONS = 4
_NEAR_PX = 0.75
"""Distance in pixels below which a source is shown at a pixel."""
_ELSEWHERE_PX = 1e6
_SAME = 0.02
"""Relative difference in depth up to which pixels belong to one surface."""
_MOST_TIMES = 128
"""Maximum number of sampled times; longer motion, of surfaces a hand's breadth before the lens, has gaps."""
_WINDOWS = 0.25, 1.0
"""Half sides of the search windows for the nearest surface that may cover a pixel, relative to the longest motion."""


def exposed_in_motion(
    light: NDArray[np.float32] | Floats,
    depth_m: NDArray[np.float32] | Floats,
    moving: NDArray[np.bool_],
    lens: Lens,
    twist: Twist,
    effects: CameraEffects,
) -> Floats:
    """Compute the light that a moving camera gathers from a picture of the middle of its exposure.

    Each pixel is the mean over the exposure of its row, at each time of the surface point that is projected to the
    pixel then. The nearest surface wins. Surfaces hidden at mid-exposure are filled from neighbouring pixels, and areas
    outside the picture from its edge.

    Parameters
    ----------
    light
        Linear light; shape (rows, columns, 3).
    depth_m
        Depth as in recordings: along the axis for `Pinhole`, along the ray for other lenses; infinite where nothing is
        hit; shape (rows, columns).
    moving
        Mask of the pixels that move by `twist`; the others are at rest relative to the camera; bool, shape (rows,
        columns).
    lens
        Lens of the camera; not an around view.
    twist
        Motion of the camera in its own axes.
    effects
        Effects, of which `exposure_s` and `readout_s` are used.
    """
    from scipy.ndimage import map_coordinates  # noqa: PLC0415 - slow to import, and not always needed

    given = np.asarray(light, dtype=np.float64)
    if not effects.shows_motion:
        return given
    flow = _Flow(depth_m, moving, lens, twist, (effects.exposure_s + effects.readout_s) / 2)
    longest_px = flow.longest_px(effects.exposure_s)
    count = 1 if effects.exposure_s == 0 else min(int(np.ceil(longest_px)) + 1, _MOST_TIMES)
    rows = (np.arange(given.shape[0]) + 0.5) / given.shape[0] - 0.5
    gathered = np.zeros(given.shape)
    for step in range(count):
        times = rows * effects.readout_s + ((step + 0.5) / count - 0.5) * effects.exposure_s
        places = flow.sources(times)
        for channel in range(given.shape[2]):
            gathered[..., channel] += map_coordinates(given[..., channel], places, order=1, mode="nearest")
    return gathered / count


class _Flow:
    """The optical flow of a picture as a parabola in time for each pixel.

    Positions and displacements are complex numbers, columns + rows * i.
    """

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
        is_lost = ~np.isfinite(steady).all(axis=1)  # points that leave the field of view
        steady[is_lost], growing[is_lost] = slow[is_lost], 0.0
        stands = ~moving.ravel() | ~np.isfinite(steady).all(axis=1)
        steady[stands], growing[stands] = 0.0, 0.0
        self._moving = ~stands
        self._depth = depth
        self._shape = moving.shape
        self._steady, self._growing = steady @ _COMPLEX, growing @ _COMPLEX
        self._grid = (middles - 0.5) @ _COMPLEX
        self._seeds = self._nearest(reach_s)

    def longest_px(self, seconds: float) -> float:
        """Return the longest displacement within a time around mid-exposure, at most the picture's diagonal."""
        return float(min(np.abs(self._steady).max(initial=0.0) * seconds, np.linalg.norm(self._shape)))

    def sources(self, times_s: Floats) -> Floats:
        """Find the source position of each pixel at the time of its row, shape (rows,); shape (2, rows, columns)."""
        times = np.repeat(times_s, self._shape[1])
        best = self._grid.copy()
        best_px, best_m = (np.full(best.shape, np.inf) for _ in range(2))
        for steady, growing in [(self._steady, self._growing), *self._seeds]:
            place = self._grid - (steady + growing * times) * times
            for _ in range(_ITERATIONS):
                at = self._pixel(place)
                moved = (self._steady[at] + self._growing[at] * times) * times
                off = place + moved - self._grid
                off_px = np.maximum(np.abs(off.real), np.abs(off.imag))
                # uncovered ground shows no part of the vehicle, and nothing from outside the field of view
                off_px[(off_px > _NEAR_PX) & (self._moving[at] != self._moving)] = _ELSEWHERE_PX
                depth = self._depth[at]
                fits, fitted = off_px <= _NEAR_PX, best_px <= _NEAR_PX
                # take the nearest surface that reaches the pixel, and on it the point closest to the pixel
                same = np.abs(depth - best_m) <= _SAME * depth
                better = np.where(fits & fitted & ~same, depth < best_m, off_px < best_px)
                for old, new in ((best, place), (best_px, off_px), (best_m, depth)):
                    np.copyto(old, new, where=better)
                place = self._grid - moved
        places: Floats = np.stack([best.imag, best.real]).reshape(2, *self._shape)
        return places

    def _pixel(self, place: Complexes) -> NDArray[np.intp]:
        """Return the index of the nearest pixel."""
        rows, columns = self._shape
        row = np.clip(np.rint(place.imag), 0, rows - 1)
        pixel: NDArray[np.intp] = (row * columns + np.clip(np.rint(place.real), 0, columns - 1)).astype(np.intp)
        return pixel

    def _nearest(self, reach_s: float) -> list[tuple[Complexes, Complexes]]:
        """Return the flow of the nearest surface around each pixel, for search windows from small to large."""
        from scipy.ndimage import minimum_filter  # noqa: PLC0415 - as above

        order = np.argsort(self._depth, kind="stable")
        rank = np.empty(order.size, dtype=np.int64)
        rank[order] = np.arange(order.size)
        widest_px = self.longest_px(reach_s)
        sides = [2 * int(np.ceil(share * widest_px)) + 1 for share in _WINDOWS]
        ranks = rank.reshape(self._shape)
        found = [order[minimum_filter(ranks, size=side).ravel()] for side in sides if side > 1]
        return [(self._steady[nearest], self._growing[nearest]) for nearest in found]


def _parabola(points_m: Floats, lens: Lens, twist: Twist, reach_s: float) -> tuple[Floats, Floats]:
    """Fit the optical flow of points by velocity and acceleration, in pixels per second and second squared."""
    before, now, after = (lens.project(twist.seen_after(points_m, time)) for time in (-reach_s, 0.0, reach_s))
    return (after - before) / (2 * reach_s), (after + before - 2 * now) / (2 * reach_s**2)
