"""A smooth path of the rear axle's middle: clothoids, arcs and straights, whose curvature changes linearly."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear, Manoeuvre
from garage2usd.driving.obstacles import Obstacles, least_clearance
from garage2usd.native import Float64s, Int64s, in_c

Floats = NDArray[np.float64]
# rounded, as eigenvalues differ in the last bits from processor to processor
GAUSS, WEIGHTS = (np.round(each, 15) for each in np.polynomial.legendre.leggauss(12))  # type: ignore[no-untyped-call]
"""Nodes on [-1, 1] and weights of a Gauss quadrature, exact to rounding on the pieces of paths."""
NODES = np.stack([GAUSS, WEIGHTS], axis=1)
"""Both, as C takes them; shape (n, 2)."""
_STEP_M = 0.1
"""Distance in metres between the poses at which the clearance of a path is evaluated."""
_SIDE_STEP_M = 0.25


@in_c
def _write_points(
    x: float, z: float, yaw: float, table: Float64s, pieces: int, nodes: Float64s, count: int,
    numbers: Int64s, intos: Float64s, rows: int, starts: Float64s, points: Float64s,
) -> None:  # fmt: skip
    raise NotImplementedError


@in_c
def _over_middle_m(
    x: float, z: float, yaw: float, table: Float64s, pieces: int, nodes: Float64s, count: int,
    halves: Float64s, rows: int, length: float, width: float, overhang: float, step: float, far_cost: float,
) -> float:  # fmt: skip
    raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Piece:
    """A piece of a path: a clothoid, an arc if its curvatures are equal, or a straight if they are 0.

    Attributes
    ----------
    gear
        Gear of the car.
    length_m
        Length of the rear axle's path, positive in both gears.
    start_per_m, end_per_m
        Curvature at its ends, positive to the driver's left in both gears.
    is_parking
        True if the piece belongs to the manoeuvre between aisle and stall.
    """

    gear: Gear
    length_m: float
    start_per_m: float = 0.0
    end_per_m: float = 0.0
    is_parking: bool = False

    def reversed(self) -> "Piece":
        """Return the piece backwards in time, over the same ground."""
        return Piece(self.gear.other, self.length_m, self.end_per_m, self.start_per_m, self.is_parking)


@dataclass(frozen=True, eq=False)
class PathPoints:
    """Points of a path; all arrays have shape (n,).

    Attributes
    ----------
    x_m, z_m, yaw_rad
        Pose of the rear axle; the yaw is continuous along the path.
    curvature_per_m
        Curvature of the path; where two pieces meet, of the later one.
    """

    x_m: Floats
    z_m: Floats
    yaw_rad: Floats
    curvature_per_m: Floats


@dataclass(frozen=True)
class Path:
    """A path of consecutive pieces; poses are integrated from the start, so that they have no jumps.

    Attributes
    ----------
    start
        First pose.
    pieces
        Clothoids, arcs and straights, in order.
    """

    start: Pose
    pieces: tuple[Piece, ...]

    @classmethod
    def of_way(cls, way: Manoeuvre) -> "Path":
        """Convert a proven manoeuvre between a lane and a stall to a path."""
        return cls(
            way.start,
            tuple(
                Piece(move.gear, move.length_m, move.curvature_per_m, move.curvature_per_m, is_parking=True)
                for move in way.moves
            ),
        )

    @cached_property
    def length_m(self) -> float:
        """Length of the path of the rear axle's middle in metres."""
        return float(self._ends[-1])

    @property
    def end(self) -> Pose:
        """Last pose of the path."""
        return self.pose_at(self.length_m)

    def pose_at(self, arc_m: float) -> Pose:
        """Return the pose at a distance along the path."""
        at = self.at([arc_m])
        return Pose(float(at.x_m[0]), float(at.z_m[0]), float(at.yaw_rad[0]))

    def then(self, pieces: Iterable[Piece]) -> "Path":
        """Return the path with further pieces appended."""
        return Path(self.start, (*self.pieces, *pieces))

    def reversed(self) -> "Path":
        """Return the path backwards in time, over the same ground."""
        return Path(self.end, tuple(piece.reversed() for piece in reversed(self.pieces)))

    def at(self, arc_m: ArrayLike) -> PathPoints:
        """Evaluate points at distances from the path's start, shape (n,), in any order; exact to rounding."""
        arc = np.asarray(arc_m, dtype=np.float64)
        number = np.clip(np.searchsorted(self._ends, arc, side="right") - 1, 0, max(len(self.pieces) - 1, 0))
        if not self.pieces:
            still = np.zeros_like(arc)
            return PathPoints(self.start.x_m + still, self.start.z_m + still, self.start.yaw_rad + still, still)
        into = np.clip(arc - self._ends[number], 0.0, self._table[number, 0])
        return self._within(number, into)

    @cached_property
    def _ends(self) -> Floats:
        """Distance along the path at the start of each piece and at the end; shape (pieces + 1,)."""
        return np.concatenate([[0.0], np.cumsum([piece.length_m for piece in self.pieces])])

    @cached_property
    def _table(self) -> Floats:
        """Length, sign, curvature at the start and curvature rate per metre of each piece; shape (pieces, 4)."""
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

    def _within(self, number: NDArray[np.int64], into: Floats) -> PathPoints:
        points, table = np.empty((4, len(number))), self._table
        start = self.start.x_m, self.start.z_m, self.start.yaw_rad
        _write_points(
            *start, table, len(table), NODES, len(NODES), number, into, len(number), np.empty((len(table), 3)), points
        )
        return PathPoints(*points)

    def clearance_m(self, car: DesignCar, obstacles: Obstacles, *, most_m: float = 1.0) -> float:
        """Compute a lower bound of the clearance between a car and all obstacles along the path, at most `most_m`.

        Notes
        -----
        Evaluated every 0.1 m. Between two poses, a point of the body at distance b from the rear axle deviates from its
        chord by at most step^2 / 8 times its second derivative along the path, which is at most
        k + k' b + k^2 b with the curvature k and its rate k' per metre.
        """
        counts = np.maximum(np.ceil(self._table[:, 0] / _STEP_M).astype(np.int64), 1)
        owner = np.repeat(np.arange(len(counts)), counts)
        within = (np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[owner]
        length, _, curvature, rate = self._table[owner].T
        points = self._within(np.append(owner, owner[-1]), np.append(within * length, length[-1]))
        poses = np.stack([points.x_m, points.z_m, points.yaw_rad], axis=1)
        body = np.array([car.ahead_m, car.rear_overhang_m, car.width_m / 2])
        reach = math.hypot(max(body[:2]), body[2])
        tightest = np.maximum(np.abs(curvature), np.abs(curvature + rate * length))
        bulges = (length / counts[owner]) ** 2 / 8 * (tightest + np.abs(rate) * reach + tightest**2 * reach)
        return least_clearance(obstacles.met_by(car), poses, bulges, most_m)

    def over_middle_m(self, car: DesignCar, halves: Floats, *, far_cost: float) -> float:
        """Compute on how many metres a car is beyond its own half of one of some lanes.

        Parameters
        ----------
        car
            The car.
        halves
            Direction (x, z) and start (x, z) of each lane, the runs between which it has a middle, those between which
            no car turns, and the offset of the own half's line from the middle, to the right; shape (n, 9).
        far_cost
            How many times metres count where no car turns.
        """
        size = car.length_m, car.width_m, car.rear_overhang_m
        start = self.start.x_m, self.start.z_m, self.start.yaw_rad
        table = self._table
        return _over_middle_m(
            *start, table, len(table), NODES, len(NODES), halves, len(halves), *size, _SIDE_STEP_M, far_cost
        )
