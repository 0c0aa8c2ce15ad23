"""Smooth paths between two poses: a turn, a straight and a turn, each turn a clothoid, an arc and a clothoid.

The turns are those of Scheuer and Fraichard, "Continuous-curvature path planning for car-like vehicles" (IROS 1997).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from garage2usd.driving.car import Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import GAUSS, WEIGHTS, Floats, Piece

__all__ = ["Steering", "joining_pieces"]

_MOST_RAD = 2.4
"""Most that a car turns on one of the two turns."""
_SCAN_RAD = math.radians(2.0)
_SAME_M, _SAME_RAD = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class Steering:
    """How turns are steered.

    Attributes
    ----------
    curvature_per_m
        The most on any turn.
    sharpness_per_m2
        Change of the curvature by metre of way on the clothoids.
    """

    curvature_per_m: float
    sharpness_per_m2: float

    def turn(self, deflection_rad: float) -> tuple[Piece, ...]:
        """A turn driven forward, straight at both ends; positive to the left."""
        peak, arc_m = (float(value[0]) for value in self._shape(np.array([abs(deflection_rad)])))
        if peak == 0.0:
            return ()
        easing_m = peak / self.sharpness_per_m2
        peak = math.copysign(peak, deflection_rad)
        pieces = [
            Piece(Gear.FORWARD, easing_m, 0.0, peak),
            Piece(Gear.FORWARD, arc_m, peak, peak),
            Piece(Gear.FORWARD, easing_m, peak, 0.0),
        ]
        return tuple(piece for piece in pieces if piece.length_m > 0)

    def chords(self, deflections_rad: Floats) -> NDArray[np.complex128]:
        """Where turns lead to from the origin, heading along the real axis; complex, shape (n,).

        A turn is symmetric, so its chord lies at half its deflection.
        """
        size = np.abs(deflections_rad)
        peak, arc_m = self._shape(size)
        easing_m = peak / self.sharpness_per_m2
        way = easing_m[:, None] / 2 * (1 + GAUSS)
        easing = easing_m / 2 * (np.exp(0.5j * self.sharpness_per_m2 * way**2) @ WEIGHTS)
        eased = peak * easing_m / 2
        # twice the projection of the first half onto the chord
        half_turn = peak * arc_m / 2
        half_arc = np.divide(2 * np.sin(half_turn / 2), peak, out=np.zeros_like(peak), where=peak > 0)
        first_half = easing + half_arc * np.exp(1j * (eased + half_turn / 2))
        length = 2 * (first_half * np.exp(-0.5j * size)).real
        chords: NDArray[np.complex128] = length * np.exp(0.5j * deflections_rad)
        return chords

    def _shape(self, size_rad: Floats) -> tuple[Floats, Floats]:
        """Greatest curvature and length of the arc for turns of some size."""
        peak = np.minimum(np.sqrt(size_rad * self.sharpness_per_m2), self.curvature_per_m)
        arc_turn = np.maximum(size_rad - peak**2 / self.sharpness_per_m2, 0.0)
        return peak, np.where(peak < self.curvature_per_m, 0.0, arc_turn / self.curvature_per_m)


def joining_pieces(start: Pose, end: Pose, steering: Steering) -> Iterator[tuple[Piece, ...]]:
    """Paths driven forward from pose to pose, the shortest first: a turn, a straight and a turn, any of them left out.

    Parameters
    ----------
    start, end
        The poses, where the wheels are straight.
    steering
        How it turns.
    """
    across = complex(end.x_m - start.x_m, start.z_m - end.z_m) * np.exp(-1j * (start.yaw_rad + math.pi / 2))
    turned = math.remainder(end.yaw_rad - start.yaw_rad, math.tau)
    if abs(turned) < _SAME_RAD and abs(across.imag) < _SAME_M:
        if across.real >= 0:
            yield (Piece(Gear.FORWARD, across.real),) if across.real > 0 else ()
        return

    def straight(first_rad: Floats) -> NDArray[np.complex128]:
        """The straight between the turns, along the heading there; real where the path meets the end."""
        first = steering.chords(first_rad)
        left: NDArray[np.complex128] = (across - first) * np.exp(-1j * first_rad) - steering.chords(turned - first_rad)
        return left

    def miss(first_rad: float) -> float:
        return float(straight(np.array([first_rad])).imag[0])

    low, high = max(-_MOST_RAD, turned - _MOST_RAD), min(_MOST_RAD, turned + _MOST_RAD)
    # where the path changes form, so that no root lies unseen between two of the same sign
    scan = np.unique(np.concatenate([np.linspace(low, high, math.ceil((high - low) / _SCAN_RAD)), [0.0, turned]]))
    misses = straight(scan).imag
    roots = scan[np.abs(misses) < _SAME_M].tolist()
    for (one, other), (miss_one, miss_other) in zip(pairwise(scan.tolist()), pairwise(misses.tolist()), strict=True):
        if miss_one * miss_other < 0 and min(abs(miss_one), abs(miss_other)) >= _SAME_M:
            roots.append(brentq(miss, one, other, xtol=1e-13, rtol=1e-13))
    found = []
    for root in roots:
        straight_m = float(straight(np.array([root])).real[0])
        if straight_m >= 0:
            ahead = (Piece(Gear.FORWARD, straight_m),) if straight_m > _SAME_M else ()
            found.append((*steering.turn(root), *ahead, *steering.turn(turned - root)))
    yield from sorted(found, key=lambda pieces: sum(piece.length_m for piece in pieces))
