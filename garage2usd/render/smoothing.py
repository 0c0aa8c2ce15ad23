"""Means over the surroundings of pixels on their surfaces: the edge-avoiding wavelets of Dammertz et al. (2010)."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from garage2usd.render.lit_scene import Floats

_KERNEL = np.array([1, 4, 6, 4, 1], dtype=np.float32) / 16
_SAME_PLANE_M, _SAME_NORMAL = 0.02, 0.95
_NOWHERE_M = 1e6


class Smoothing:
    """Means over ever wider surroundings of each pixel in one plane with it.

    Parameters
    ----------
    shape
        Rows and columns of the picture.
    pixel
        Numbers of the pixels that see something; int64, shape (n,).
    place_m, normal
        What they see; float32, shape (n, 3).
    """

    def __init__(self, shape: tuple[int, int], pixel: NDArray[np.int64], place_m: Floats, normal: Floats) -> None:
        self._shape, self._pixel = shape, pixel
        self._normal = np.zeros((*shape, 3), np.float32)
        self._normal.reshape(-1, 3)[pixel] = normal
        self._place = np.full((*shape, 3), _NOWHERE_M, np.float32)
        self._place.reshape(-1, 3)[pixel] = place_m
        self._known: dict[tuple[int, int], tuple[list[tuple[int, Floats]], Floats]] = {}

    def __call__(self, values: Floats, steps: Sequence[int]) -> Floats:
        """Smooth values of the pixels that see something, shape (n, 3), over pixels so far apart."""
        rows, columns = self._shape
        picture = np.zeros((rows, columns, 3), np.float32)
        picture.reshape(-1, 3)[self._pixel] = values
        for step in steps:
            for axis in (0, 1):
                picture = self._along(picture, axis, step)
        found: Floats = picture.reshape(-1, 3)[self._pixel]
        return found

    def _along(self, picture: Floats, axis: int, step: int) -> Floats:
        total = picture * _KERNEL[2]
        shares, whole = self._shares(axis, step)
        for shift, own in shares:
            total[_part(axis, shift)] += picture[_part(axis, -shift)] * own
        smoothed: Floats = total / whole
        return smoothed

    def _shares(self, axis: int, step: int) -> tuple[list[tuple[int, Floats]], Floats]:
        """Return what each neighbour along an axis counts, by how far it is away, and the sum of all."""
        if (axis, step) not in self._known:
            whole, shares = np.full((*self._shape, 1), _KERNEL[2], np.float32), []
            for shift in (-2 * step, -step, step, 2 * step):
                if abs(shift) >= self._shape[axis]:
                    continue
                here, there = _part(axis, shift), _part(axis, -shift)
                apart = np.einsum("ijk,ijk->ij", self._place[there] - self._place[here], self._normal[here])
                alike = np.einsum("ijk,ijk->ij", self._normal[here], self._normal[there])
                is_same = (np.abs(apart) < _SAME_PLANE_M) & (alike > _SAME_NORMAL)
                own = (_KERNEL[2 + shift // step] * is_same)[..., None].astype(np.float32)
                whole[here] += own
                shares.append((shift, own))
            self._known[axis, step] = shares, whole
        return self._known[axis, step]


def _part(axis: int, shift: int) -> tuple[slice, slice]:
    """Select the pixels that have a neighbour so far before them, or behind them if the shift is negative."""
    own = slice(shift, None) if shift > 0 else slice(None, shift)
    return (own, slice(None)) if axis == 0 else (slice(None), own)
