"""Monotone cubic interpolation, which does not overshoot."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


class MonotoneCurve:
    """Monotone piecewise cubic interpolation, extrapolated beyond both ends.

    Notes
    -----
    Fritsch and Butland, SIAM Journal on Scientific and Statistical Computing 5 (1984): the slope at a point is the
    weighted harmonic mean of those beside it, and zero where these differ in sign. At the ends it is the three-point
    estimate of Moler, Numerical Computing with MATLAB (2004), 3.6. Equal to SciPy's `PchipInterpolator`, which takes
    longer to load than all cars take to make.
    """

    def __init__(self, x: ArrayLike, y: ArrayLike) -> None:
        """Interpolate points; `x` is ascending, both of shape (n,) with n >= 3."""
        self._x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        step = np.diff(self._x)
        slope = np.diff(y) / step
        keeps = slope[:-1] * slope[1:] > 0
        weights = np.stack([2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]])[:, keeps]
        beside = np.stack([slope[:-1], slope[1:]])[:, keeps]
        rise = np.zeros(len(y))
        rise[1:-1][keeps] = 1 / ((weights / beside).sum(axis=0) / weights.sum(axis=0))
        rise[0], rise[-1] = _end_slope(step[:2], slope[:2]), _end_slope(step[:-3:-1], slope[:-3:-1])
        turn = (rise[:-1] + rise[1:] - 2 * slope) / step
        self._cubics = np.stack([y[:-1], rise[:-1], (slope - rise[:-1]) / step - turn, turn / step])

    def __call__(self, x: ArrayLike) -> Array:
        """Evaluate the curve; shape of `x`."""
        piece = np.clip(np.searchsorted(self._x, x, side="right") - 1, 0, len(self._x) - 2)
        along = np.asarray(x) - self._x[piece]
        constant, linear, square, cube = self._cubics[:, piece]
        height: Array = constant + linear * along + square * (along * along) + cube * (along * along * along)
        return height


def _end_slope(step: Array, slope: Array) -> float:
    """Slope at an end, from the two adjacent segments, the outer one first."""
    estimate = float(((2 * step[0] + step[1]) * slope[0] - step[0] * slope[1]) / (step[0] + step[1]))
    if np.sign(estimate) != np.sign(slope[0]):
        return 0.0
    steepest = 3 * float(slope[0])
    return steepest if slope[0] * slope[1] < 0 and abs(estimate) > abs(steepest) else estimate
