"""Radius polynomials of fisheye lenses: from the angle of a ray to its distance from the principal point."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["RadiusPolynomial"]

Floats = NDArray[np.float64]
_STEPS = 60
"""Maximum number of Newton steps; that many bisections of pi exhaust double precision."""
_TINY = 1e-300
_SAMPLES = 20_001


@dataclass(frozen=True)
class RadiusPolynomial:
    """A fisheye's radius r(theta) = sum of c_i theta^i, which increases from r(0) = 0.

    Attributes
    ----------
    coefficients
        c_0, which is 0, c_1 and so on.
    """

    coefficients: Sequence[float]

    def __call__(self, angle_rad: ArrayLike) -> Floats:
        """Evaluate the radius at angles, shape (n,)."""
        return _horner(self.coefficients, np.asarray(angle_rad, dtype=np.float64))

    @property
    def slope(self) -> tuple[float, ...]:
        """Coefficients of the derivative, lowest degree first."""
        return tuple(power * factor for power, factor in enumerate(self.coefficients))[1:]

    @property
    def grows_up_to_rad(self) -> float:
        """The angle up to which the radius increases, at most pi.

        The slope is sampled in steps of less than 0.01 degrees, since polynomial root finding is inaccurate for
        coefficients of very different magnitude.
        """
        angles = np.linspace(0.0, math.pi, _SAMPLES)
        falls = np.flatnonzero(_horner(self.slope, angles) <= 0)
        return float(angles[max(falls[0] - 1, 0)]) if len(falls) else math.pi

    def angles_rad(self, radius: ArrayLike, *, most_rad: float) -> Floats:
        """Invert the radius polynomial: the angles of radii, shape (n,); NaN for radii beyond the limit's.

        Parameters
        ----------
        radius
            At least 0.
        most_rad
            Limit of the angle, up to which the radius increases.
        """
        radius = np.asarray(radius, dtype=np.float64)
        slope = self.slope
        seen = radius <= self(most_rad)
        low, high = np.zeros(radius.shape), np.full(radius.shape, most_rad)
        angle = np.clip(radius / slope[0], low, high)
        for _ in range(_STEPS):  # Newton's steps where they stay between what is known, halves elsewhere
            over = self(angle) - radius
            high, low = np.where(over >= 0, angle, high), np.where(over <= 0, angle, low)
            step = angle - over / np.maximum(_horner(slope, angle), _TINY)
            following = np.where((step >= low) & (step <= high), step, (low + high) / 2)
            if (following == angle)[seen].all():
                break
            angle = following
        return np.where(seen, angle, np.nan)


def _horner(coefficients: Sequence[float], values: Floats) -> Floats:
    total = np.zeros(values.shape)
    for factor in reversed(coefficients):
        total = total * values + factor
    return total
