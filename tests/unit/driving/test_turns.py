"""Smooth paths of two turns, followed step by step."""

import math

import numpy as np
import pytest

from garage2usd.driving import Gear, Pose
from garage2usd.driving.path import Path, Piece
from garage2usd.driving.turns import Steering, joining_pieces

STEERING = Steering(curvature_per_m=0.218, sharpness_per_m2=0.278)
STEP_M = 1e-3


def followed(start, pieces):
    """Pose at the end of forward pieces, by the midpoint rule; at yaw 0 a car looks along -Z."""
    x, z, yaw = start.x_m, start.z_m, start.yaw_rad
    for piece in pieces:
        steps = max(round(piece.length_m / STEP_M), 1)
        step = piece.length_m / steps
        curvatures = np.linspace(piece.start_per_m, piece.end_per_m, 2 * steps + 1)[1::2]
        for curvature in curvatures.tolist():
            middle = yaw + curvature * step / 2
            x, z, yaw = x - step * math.sin(middle), z - step * math.cos(middle), yaw + curvature * step
    return x, z, yaw


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("heading", [0.0, math.pi / 2, math.pi, -math.pi / 2])
def test_about_turns_lead_to_either_side(side, heading):
    ahead = -math.sin(heading), -math.cos(heading)
    right = -ahead[1], ahead[0]
    start = Pose(1.0, 2.0, heading)
    end = Pose(
        1.0 + 2.0 * ahead[0] + side * 10.5 * right[0],
        2.0 + 2.0 * ahead[1] + side * 10.5 * right[1],
        math.remainder(heading + math.pi, math.tau),
    )
    found = list(joining_pieces(start, end, STEERING))
    assert found
    for pieces in found:
        x, z, yaw = followed(start, pieces)
        assert (x, z) == pytest.approx((end.x_m, end.z_m), abs=1e-3)
        assert math.remainder(yaw - end.yaw_rad, math.tau) == pytest.approx(0.0, abs=1e-3)
    # the shortest turns by a half, to the side on which the end lies
    assert followed(start, found[0])[2] - heading == pytest.approx(-side * math.pi, abs=1e-3)
    assert sum(piece.length_m for piece in found[0]) < 22.0


def test_the_rest_of_a_path_is_the_path_from_there_on():
    start = Pose(0.0, 0.0, 0.3)
    forward = next(iter(joining_pieces(start, Pose(4.0, -19.0, 0.2), STEERING)))
    path = Path(start, (*forward, Piece(Gear.REVERSE, 3.0, 0.1, -0.2)))
    for arc_m in np.linspace(0.0, path.length_m, 23).tolist():
        rest = path.rest(arc_m)
        assert rest.length_m == pytest.approx(path.length_m - arc_m)
        along = np.linspace(0.0, rest.length_m, 50)
        found, whole = rest.at(along), path.at(arc_m + along)
        assert found.x_m == pytest.approx(whole.x_m, abs=1e-9)
        assert found.z_m == pytest.approx(whole.z_m, abs=1e-9)
        assert found.yaw_rad == pytest.approx(whole.yaw_rad, abs=1e-9)
        assert found.curvature_per_m[:-1] == pytest.approx(whole.curvature_per_m[:-1], abs=1e-9)
