"""Smooth paths between two poses: a turn, a straight and a turn, each turn a clothoid, an arc and a clothoid.

The turns are those of Scheuer and Fraichard, "Continuous-curvature path planning for car-like vehicles" (IROS 1997).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from garage2usd.driving.car import Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import GAUSS, NODES, WEIGHTS, Floats, Piece
from garage2usd.native import Float64s, elementary, in_c

_MOST_RAD = 2.4
"""Greatest angle of each of the two turns."""
_SCAN_RAD = math.radians(2.0)
_SAME_M, _SAME_RAD = 1e-6, 1e-9


@in_c
def _write_straight(
    curvature: float, sharpness: float, nodes: Float64s, count: int, x: float, y: float,
    first: float, turned: float, straight: Float64s,
) -> None:  # fmt: skip
    raise NotImplementedError


@in_c
def _write_roots(
    curvature: float, sharpness: float, nodes: Float64s, count: int, x: float, y: float,
    turned: float, samples: Float64s, rows: int, same: float, roots: Float64s,
) -> int:  # fmt: skip
    raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Steering:
    """Curvature limits of a car's turns.

    Attributes
    ----------
    curvature_per_m
        Greatest curvature of a turn.
    sharpness_per_m2
        Curvature rate per metre on the clothoids.
    """

    curvature_per_m: float
    sharpness_per_m2: float

    def turn(self, deflection_rad: float) -> tuple[Piece, ...]:
        """Return a forward turn with zero curvature at both ends; positive to the left."""
        size = abs(deflection_rad)
        peak = min(math.sqrt(size * self.sharpness_per_m2), self.curvature_per_m)
        if peak == 0.0:
            return ()
        is_full = peak == self.curvature_per_m
        arc_m = max(size - peak**2 / self.sharpness_per_m2, 0.0) / peak if is_full else 0.0
        easing_m = peak / self.sharpness_per_m2
        peak = math.copysign(peak, deflection_rad)
        pieces = [
            Piece(Gear.FORWARD, easing_m, 0.0, peak),
            Piece(Gear.FORWARD, arc_m, peak, peak),
            Piece(Gear.FORWARD, easing_m, peak, 0.0),
        ]
        return tuple(piece for piece in pieces if piece.length_m > 0)

    def chords(self, deflections_rad: Floats) -> NDArray[np.complex128]:
        """Return the displacements of turns from the origin, heading along the real axis; complex, shape (n,).

        A turn is symmetric, so its chord is at half its deflection.
        """
        size = np.abs(deflections_rad)
        peak, arc_m = self._shape(size)
        easing_m = peak / self.sharpness_per_m2
        way = easing_m[:, None] / 2 * (1 + GAUSS)
        easing = easing_m / 2 * (elementary.turned(0.5 * self.sharpness_per_m2 * way**2) * WEIGHTS).sum(axis=1)
        eased = peak * easing_m / 2
        # the chord is twice the projection of the first half of the turn onto it
        half_turn = peak * arc_m / 2
        half_arc = np.divide(2 * elementary.sin(half_turn / 2), peak, out=np.zeros_like(peak), where=peak > 0)
        first_half = easing + half_arc * elementary.turned(eased + half_turn / 2)
        length = 2 * (first_half * elementary.turned(-0.5 * size)).real
        chords: NDArray[np.complex128] = length * elementary.turned(0.5 * deflections_rad)
        return chords

    def _shape(self, size_rad: Floats) -> tuple[Floats, Floats]:
        """Return the greatest curvature and the length of the arc of turns by some angles."""
        peak = np.minimum(np.sqrt(size_rad * self.sharpness_per_m2), self.curvature_per_m)
        arc_turn = np.maximum(size_rad - peak**2 / self.sharpness_per_m2, 0.0)
        return peak, np.where(peak < self.curvature_per_m, 0.0, arc_turn / self.curvature_per_m)


@lru_cache(maxsize=256)
def _scanned(steering: Steering, turned_rad: float) -> Floats:
    """Sample the first turn for a root search: its angle, chord, rotation, and the second chord; shape (n, 7).

    Nearly all paths turn by a quarter or not at all.
    """
    low, high = max(-_MOST_RAD, turned_rad - _MOST_RAD), min(_MOST_RAD, turned_rad + _MOST_RAD)
    # include the angles at which the path changes form, so that no pair of roots is missed
    steps = np.linspace(low, high, math.ceil((high - low) / _SCAN_RAD))
    scan = np.unique(np.concatenate([steps, [0.0, turned_rad]]))
    columns = steering.chords(scan), elementary.turned(-scan), steering.chords(turned_rad - scan)
    return np.column_stack([scan, *(part for column in columns for part in (column.real, column.imag))])


def joining_pieces(start: Pose, end: Pose, steering: Steering) -> Iterator[tuple[Piece, ...]]:
    """Yield forward paths between two poses, the shortest first: a turn, a straight and a turn, each optional.

    Parameters
    ----------
    start, end
        The poses, with the wheels straight.
    steering
        Curvature limits of the turns.
    """
    across = complex(end.x_m - start.x_m, start.z_m - end.z_m) * elementary.rect(1.0, -(start.yaw_rad + math.pi / 2))
    turned = math.remainder(end.yaw_rad - start.yaw_rad, math.tau)
    if abs(turned) < _SAME_RAD and abs(across.imag) < _SAME_M:
        if across.real >= 0:
            yield (Piece(Gear.FORWARD, across.real),) if across.real > 0 else ()
        return

    # a turn by 180 degrees may go to the left or to the right
    both = (turned, -turned) if math.pi - abs(turned) < _SAME_RAD else (turned,)
    found = [pieces for each in both for pieces in _turning(across, each, steering)]
    yield from sorted(found, key=lambda pieces: sum(piece.length_m for piece in pieces))


def _turning(across: complex, turned: float, steering: Steering) -> Iterator[tuple[Piece, ...]]:
    """Yield a turn, a straight and a turn that lead to a point ahead, and by an angle to the left in all."""
    scan = _scanned(steering, turned)
    roots = np.empty((len(scan), 2))
    limits = steering.curvature_per_m, steering.sharpness_per_m2, NODES, len(NODES)
    found = _write_roots(*limits, across.real, across.imag, turned, scan, len(scan), _SAME_M, roots)
    for root, straight_m in roots[:found].tolist():
        if straight_m >= 0:
            ahead = (Piece(Gear.FORWARD, straight_m),) if straight_m > _SAME_M else ()
            yield (*steering.turn(root), *ahead, *steering.turn(turned - root))
