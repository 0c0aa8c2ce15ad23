"""A path of the rear axle's middle: pieces whose curvature changes steadily, so clothoids, arcs and straights."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear, Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.sweep import least_clearance

__all__ = ["GAUSS", "WEIGHTS", "Path", "PathPoints", "Piece"]

Floats = NDArray[np.float64]
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(12)  # type: ignore[no-untyped-call]
"""Places from -1 to 1, and weights, of a quadrature that is exact but for rounding on the pieces of paths."""
_STEP_M = 0.1
"""Between the poses at which a path's clearance is looked at."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A clothoid; with equal curvatures an arc, with none a straight.

    Attributes
    ----------
    gear
        Which way it is driven.
    length_m
        Of the rear axle's way, positive in both gears.
    start_per_m, end_per_m
        Curvature at its ends, positive to the driver's left in both gears.
    is_parking
        Whether it is a part of the way between aisle and stall.
    """

    gear: Gear
    length_m: float
    start_per_m: float = 0.0
    end_per_m: float = 0.0
    is_parking: bool = False

    def reversed(self) -> "Piece":
        """The same ground backwards in time."""
        return Piece(self.gear.other, self.length_m, self.end_per_m, self.start_per_m, self.is_parking)


@dataclass(frozen=True, eq=False)
class PathPoints:
    """Points of a path; all arrays have shape (n,).

    Attributes
    ----------
    x_m, z_m, yaw_rad
        Pose of the rear axle; the yaw is continuous along the path.
    curvature_per_m
        Of the path there; of the later piece where two pieces meet.
    """

    x_m: Floats
    z_m: Floats
    yaw_rad: Floats
    curvature_per_m: Floats


@dataclass(frozen=True)
class Path:
    """Pieces one after another; a pose follows from the start and the pieces alone, so that there are no jumps of pose.

    Attributes
    ----------
    start
        Where it begins.
    pieces
        What is driven, in order.
    """

    start: Pose
    pieces: tuple[Piece, ...]

    @classmethod
    def of_way(cls, way: Manoeuvre) -> "Path":
        """A proven way between a lane and a stall."""
        return cls(
            way.start,
            tuple(
                Piece(move.gear, move.length_m, move.curvature_per_m, move.curvature_per_m, is_parking=True)
                for move in way.moves
            ),
        )

    @cached_property
    def length_m(self) -> float:
        """Way of the rear axle's middle."""
        return float(self._ends[-1])

    @property
    def end(self) -> Pose:
        """Where it ends."""
        return self.pose_at(self.length_m)

    def pose_at(self, arc_m: float) -> Pose:
        """The pose after a way."""
        at = self.at([arc_m])
        return Pose(float(at.x_m[0]), float(at.z_m[0]), float(at.yaw_rad[0]))

    def then(self, pieces: Iterable[Piece]) -> "Path":
        """The path with pieces after it."""
        return Path(self.start, (*self.pieces, *pieces))

    def reversed(self) -> "Path":
        """The same ground backwards in time."""
        return Path(self.end, tuple(piece.reversed() for piece in reversed(self.pieces)))

    def at(self, arc_m: ArrayLike) -> PathPoints:
        """Points after ways from the start, shape (n,), in any order; exact but for rounding."""
        arc = np.asarray(arc_m, dtype=np.float64)
        number = np.clip(np.searchsorted(self._ends, arc, side="right") - 1, 0, max(len(self.pieces) - 1, 0))
        if not self.pieces:
            still = np.zeros_like(arc)
            return PathPoints(self.start.x_m + still, self.start.z_m + still, self.start.yaw_rad + still, still)
        into = np.clip(arc - self._ends[number], 0.0, self._table[number, 0])
        return self._within(number, into)

    @cached_property
    def _ends(self) -> Floats:
        """Way driven at the start of each piece and at the end; shape (pieces + 1,)."""
        return np.concatenate([[0.0], np.cumsum([piece.length_m for piece in self.pieces])])

    @cached_property
    def _table(self) -> Floats:
        """Length, sign, curvature at the start and its change by metre, of each piece; shape (pieces, 4)."""
        return np.array(
            [
                (
                    piece.length_m,
                    piece.gear.sign,
                    piece.start_per_m,
                    (piece.end_per_m - piece.start_per_m) / piece.length_m if piece.length_m else 0.0,
                )
                for piece in self.pieces
            ]
        ).reshape(-1, 4)

    @cached_property
    def _starts(self) -> tuple[NDArray[np.complex128], Floats]:
        """Place (x - iz) and yaw at the start of each piece."""
        lengths, signs, curvatures, rates = self._table.T
        turns = signs * lengths * (curvatures + rates * lengths / 2)
        yaws = self.start.yaw_rad + np.concatenate([[0.0], np.cumsum(turns)[:-1]])
        steps = _moved(lengths, signs, curvatures, rates, yaws)
        places = complex(self.start.x_m, -self.start.z_m) + np.concatenate([[0.0], np.cumsum(steps)[:-1]])
        return places, yaws

    def _within(self, number: NDArray[np.int64], into: Floats) -> PathPoints:
        _, signs, curvatures, rates = self._table[number].T
        places, yaws = self._starts[0][number], self._starts[1][number]
        place = places + _moved(into, signs, curvatures, rates, yaws)
        yaw = yaws + signs * into * (curvatures + rates * into / 2)
        return PathPoints(place.real, -place.imag, yaw, curvatures + rates * into)

    def clearance_m(self, car: DesignCar, obstacles: Obstacles, *, most_m: float = 1.0) -> float:
        """What is left at least between a car and all obstacles: a lower bound, at most `most_m`.

        Notes
        -----
        Looked at every 0.1 m. Between two poses a point of the body at distance b from the rear axle strays off its
        chord by at most step^2 / 8 times its second derivative along the way, which is at most
        k + k' b + k^2 b with the curvature k and its change by metre k'.
        """
        counts = np.maximum(np.ceil(self._table[:, 0] / _STEP_M).astype(np.int64), 1)
        owner = np.repeat(np.arange(len(counts)), counts)
        within = (np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[owner]
        length, _, curvature, rate = self._table[owner].T
        points = self._within(np.append(owner, owner[-1]), np.append(within * length, length[-1]))
        poses = np.stack([points.x_m, points.z_m, points.yaw_rad], axis=1)
        body = np.array([car.ahead_m, car.rear_overhang_m, car.width_m / 2])
        reach = float(np.hypot(max(body[:2]), body[2]))
        tightest = np.maximum(np.abs(curvature), np.abs(curvature + rate * length))
        bulges = (length / counts[owner]) ** 2 / 8 * (tightest + np.abs(rate) * reach + tightest**2 * reach)
        low, high = poses[:, :2].min(axis=0), poses[:, :2].max(axis=0)
        near = obstacles.near(tuple((low + high) / 2), float((high - low).max()) / 2 + reach + most_m)
        return least_clearance(near.met_by(car), poses, bulges, most_m)


def _moved(into: Floats, signs: Floats, curvatures: Floats, rates: Floats, yaws: Floats) -> NDArray[np.complex128]:
    """How far pieces lead (x - iz) within some of their lengths, by Gauss's quadrature of the heading."""
    moved: NDArray[np.complex128] = signs * into * np.exp(1j * (np.pi / 2 + yaws))
    bends = (curvatures != 0) | (rates != 0)
    if bends.any():
        into, signs, curvatures, rates, yaws = (values[bends] for values in (into, signs, curvatures, rates, yaws))
        at = into[:, None] / 2 * (1 + GAUSS)
        heading = np.pi / 2 + yaws[:, None] + signs[:, None] * at * (curvatures[:, None] + rates[:, None] * at / 2)
        # not by a product of matrices, for which a BLAS library wakes threads that then wait for more
        moved[bends] = signs * into / 2 * np.einsum("ij,j->i", np.exp(1j * heading), WEIGHTS)
    return moved
