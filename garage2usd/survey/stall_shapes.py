"""Shapes of stalls: the rectangle or parallelogram of four corners, with the side that cars cross."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.garage import Point

Floats = NDArray[np.float64]
_SQUARE_DEG, _LEAST_ANGLE_DEG, _PARALLEL_SIDES_DEG = 1.0, 25.0, 3.0
_PERPENDICULAR_DEG, PARALLEL_DEG = 90.0, 0.0
_MOST_OFF_M = 0.25
"""Greatest distance in metres of a corner of a stall from the shape that is laid out."""
_LEAST_WIDTH_M, _LEAST_LENGTH_M = 1.0, 2.0
_QUARTER_RAD = 1e-3
"""Angle in radians up to which a stall stands along an axis."""
_DIGITS, _YAW_DIGITS = 6, 9


class FittedShape(NamedTuple):
    """The rectangle or parallelogram of a stall.

    Attributes
    ----------
    centre
        (x, z) of its middle.
    width_m, length_m
        Sides of the rectangle for a car.
    yaw_rad
        Yaw about +Y of a car parked nose in, 0 where its nose points to -Z.
    angle_deg
        Angle of its long sides to the lane: 90 for perpendicular stalls, 0 for parallel ones.
    turn
        1 if cars enter an angled stall by a turn to the right, and for a parallel one with the lane on the left, seen
        towards the nose; else -1.
    outwards
        Unit vector (x, z) from its rear to its mouth.
    """

    centre: Point
    width_m: float
    length_m: float
    yaw_rad: float
    angle_deg: float
    turn: int
    outwards: Point


def stall_shape(given: ArrayLike, side: int, keeps_left: bool) -> FittedShape | str:  # noqa: FBT001 - a fact of the country
    """Return the rectangle or parallelogram of a stall, or the reason that there is none.

    Parameters
    ----------
    given
        (x, z) of the corners in order, either way round; shape (4, 2).
    side
        Number of the side that cars cross, which begins at the corner of that number.
    keeps_left
        True if traffic keeps to the left, which decides which way cars look in parallel stalls.
    """
    corners = np.roll(np.asarray(given, dtype=np.float64), -side, axis=0)
    one, other, beyond_other, beyond_one = corners
    out = (one + other - beyond_other - beyond_one) / 2
    depth_m = float(np.linalg.norm(out))
    along = (other - one + beyond_other - beyond_one) / 2
    out_x, out_z = (out / depth_m).tolist()
    right = np.array([out_z, -out_x])  # to the right of a driver who drives in
    across_m, rise_m = float(along @ right), float(along @ (out / depth_m))
    if across_m < 0:
        across_m, rise_m = -across_m, -rise_m
    centre = corners.mean(axis=0)
    angle_deg = math.degrees(math.atan2(across_m, abs(rise_m)))
    if angle_deg < _LEAST_ANGLE_DEG:
        return f"an angle of {angle_deg:.0f} degrees to its lane, below {_LEAST_ANGLE_DEG:g}"
    turn, width_m, length_m = (1 if rise_m > 0 else -1), across_m, depth_m
    if _PERPENDICULAR_DEG - angle_deg <= _SQUARE_DEG:
        angle_deg, turn = _PERPENDICULAR_DEG, 1
        yaw = math.atan2(out_x, out_z)
        if across_m > depth_m:
            angle_deg, width_m, length_m = PARALLEL_DEG, depth_m, across_m
            # in right-hand traffic a car that faces along the traffic has the lane on its left
            turn = -1 if keeps_left else 1
            yaw = math.atan2(turn * out_z, -turn * out_x)
    else:
        angle_deg = round(angle_deg, 6)
        length_m = depth_m - width_m * abs(rise_m / across_m)
        yaw = math.atan2(out_x, out_z)
    if width_m < _LEAST_WIDTH_M or length_m < _LEAST_LENGTH_M:
        return f"{width_m:.2f} by {length_m:.2f} m for a car, below {_LEAST_WIDTH_M:g} by {_LEAST_LENGTH_M:g}"
    shape = FittedShape(
        (round(float(centre[0]), _DIGITS), round(float(centre[1]), _DIGITS)),
        round(width_m, _DIGITS),
        round(length_m, _DIGITS),
        snapped_yaw_rad(yaw),
        angle_deg,
        turn,
        (out_x, out_z),
    )
    off_m = _off_m(corners, shape)
    if off_m > _MOST_OFF_M:
        return f"a corner is {off_m:.2f} m from the nearest rectangle or parallelogram, above {_MOST_OFF_M:g}"
    return shape


def with_parallel_rear(corners: Floats) -> tuple[Floats, float] | None:
    """Return the corners of a stall with its mouth and its rectangle for a car, but its rear parallel to its mouth.

    Parameters
    ----------
    corners
        Both corners of the mouth, then of the rear; shape (4, 2).

    Returns
    -------
    tuple or None
        The corners and the greatest distance that one was moved; None if the sides are not parallel.
    """
    one, other, beyond_other, beyond_one = corners
    sides = one - beyond_one, other - beyond_other
    lengths_m = [float(np.linalg.norm(side)) for side in sides]
    if min(lengths_m) < _LEAST_WIDTH_M:
        return None
    outs = [side / length_m for side, length_m in zip(sides, lengths_m, strict=True)]
    if outs[0] @ outs[1] < math.cos(math.radians(_PARALLEL_SIDES_DEG)):
        return None
    out = (outs[0] + outs[1]) / np.linalg.norm(outs[0] + outs[1])
    # the rectangle for a car ends at the rear corner that is closer to the mouth
    length_m = min(one @ out, other @ out) - max(beyond_one @ out, beyond_other @ out)
    side_m = length_m + abs((one - other) @ out)
    laid = np.array([one, other, other - side_m * out, one - side_m * out])
    return laid, float(np.linalg.norm(laid - corners, axis=1).max())


def snapped_yaw_rad(yaw_rad: float) -> float:
    """Round a yaw; one within a milliradian of a quarter turn is exact."""
    quarter = round(yaw_rad / (math.pi / 2))
    if abs(yaw_rad - quarter * math.pi / 2) < _QUARTER_RAD:
        return {0: 0.0, 1: math.pi / 2, 2: math.pi, -1: -math.pi / 2, -2: math.pi}[quarter]
    return round(yaw_rad, _YAW_DIGITS)


def _off_m(corners: Floats, shape: FittedShape) -> float:
    """Return the greatest distance of the corners of a stall from those of its shape."""
    out = np.array(shape.outwards)
    right = np.array([out[1], -out[0]])
    across_m, depth_m, slope = shape.width_m, shape.length_m, 0.0
    if shape.angle_deg == PARALLEL_DEG:
        across_m, depth_m = depth_m, across_m
    elif shape.angle_deg != _PERPENDICULAR_DEG:
        slope = shape.turn / math.tan(math.radians(shape.angle_deg))
        depth_m += across_m * abs(slope)
    laid = [
        np.array(shape.centre)
        + right * across * across_m / 2
        + out * (deep * depth_m / 2 + slope * across * across_m / 2)
        for across, deep in ((-1, 1), (1, 1), (1, -1), (-1, -1))
    ]
    return max(min(float(np.linalg.norm(corner - other)) for other in laid) for corner in corners)
