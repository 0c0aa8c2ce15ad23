"""A path of clothoids along a line that bends, fitted so that front and rear of the car keep to the line."""

import math
from itertools import pairwise

import numpy as np

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.manoeuvre import Gear
from garage2usd.driving.path import Floats, Path, Piece
from garage2usd.garage.path_line import PathLine

_PIECE_M, _LEAST_PIECES = 2.5, 4
_END_WEIGHT, _STEERING_WEIGHT = 1e3, 1.0
_BEYOND_M = 12.0
_DIGITS = 12
_MISS_M = 1e-5


def pieces_along(line: PathLine, start: Pose, end: Pose, car: DesignCar) -> tuple[Piece, ...] | None:
    """Return the pieces of a path between poses whose axles keep to a line, with straight wheels at both ends.

    Curvatures at equal distances are found by nonlinear least squares over the offsets of both axles from the line and
    the changes of curvature, within the car's turning circle.

    Parameters
    ----------
    line
        Line through points (x, z), in metres, in the direction of driving.
    start, end
        Poses at its ends; they may lie beyond, in line with the line's ends.
    car
        The car.

    Returns
    -------
    tuple of Piece or None
        The path's pieces; None if no path that the car can steer ends at the pose.
    """
    from scipy.optimize import least_squares  # noqa: PLC0415 - takes a quarter of a second, for which maps need not wait

    long = _lengthened(line)
    runs, _ = long.foot([start.x_m, end.x_m], [start.z_m, end.z_m])
    whole_m = float(runs[1] - runs[0])
    if whole_m <= 0:
        return None
    count = max(math.ceil(whole_m / _PIECE_M), _LEAST_PIECES)
    most = 1 / car.rear_axle_radius_m

    def pieces(values: Floats) -> tuple[Piece, ...]:
        curvatures = [0.0, *np.round(values[1:], _DIGITS).tolist(), 0.0]
        length_m = round(float(values[0]), _DIGITS) / count
        return tuple(Piece(Gear.FORWARD, length_m, one, other) for one, other in pairwise(curvatures))

    def misses(values: Floats) -> Floats:
        path = Path(start, pieces(values))
        at = path.at(np.linspace(0.0, path.length_m, 2 * count + 1))
        ahead_x, ahead_z = -np.sin(at.yaw_rad), -np.cos(at.yaw_rad)
        _, rear = long.foot(at.x_m, at.z_m)
        _, front = long.foot(at.x_m + car.wheelbase_m * ahead_x, at.z_m + car.wheelbase_m * ahead_z)
        last = at.x_m[-1] - end.x_m, at.z_m[-1] - end.z_m, math.remainder(at.yaw_rad[-1] - end.yaw_rad, math.tau)
        changes = np.diff([0.0, *values[1:], 0.0], 2, prepend=0.0, append=0.0) * count / whole_m
        found: Floats = np.concatenate([rear, front, _END_WEIGHT * np.array(last), _STEERING_WEIGHT * changes])
        return found

    # the turn of the line around each place, over the length of a piece
    middles = runs[0] + whole_m * (np.arange(count + 1) - 0.5) / count
    places = long.at(middles)
    headings = np.unwrap(np.arctan2(-places.along_u, -places.along_v))
    guess = np.clip(np.diff(headings)[1:] * count / whole_m, -0.9 * most, 0.9 * most)
    bounds = [0.5 * whole_m, *[-most] * (count - 1)], [1.5 * whole_m, *[most] * (count - 1)]
    solved = least_squares(misses, np.concatenate([[whole_m], guess]), bounds=bounds, xtol=1e-12, ftol=1e-12)
    found = pieces(solved.x)
    last = Path(start, found).end
    return found if math.hypot(last.x_m - end.x_m, last.z_m - end.z_m) < _MISS_M else None


def _lengthened(line: PathLine) -> PathLine:
    """Return the line with straights beyond both of its ends."""
    ends = line.at([0.0, line.length_m])
    (u, v), (end_u, end_v) = zip(ends.u_m.tolist(), ends.v_m.tolist(), strict=True)
    (way_u, end_way_u), (way_v, end_way_v) = ends.along_u.tolist(), ends.along_v.tolist()
    before = u - _BEYOND_M * way_u, v - _BEYOND_M * way_v
    beyond = end_u + _BEYOND_M * end_way_u, end_v + _BEYOND_M * end_way_v
    return PathLine.through([before, *line.points, beyond], line.width_m)
