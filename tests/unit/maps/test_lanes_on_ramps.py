"""The judge of lanes on ramps, on a site whose ramps pass other portals."""

import numpy as np
import pytest
from support.opendrive_judge import astray_on_ramps
from support.stage_lanes import StageLanes

ENTRANCE, EXIT = (84.3, 11.1), (59.8, 41.8)
"""The ramp of the exit, which goes the same way as that of the entrance, ends beside the square of the entrance."""
LANES = StageLanes(np.array([ENTRANCE, EXIT]), np.full((2, 2), 5.0), ["entrance", "exit"], [], {})
UP, DOWN = -90.0, 90.0


def ramp(road, foot, *, yaw_deg, aside_m=0.0):
    """Rows of a lane on a ramp that rises by 3.5 m towards -Z, from 5 m before the middle of the square at its foot."""
    run = np.linspace(0.0, 25.5, 52)
    rows = np.zeros((52, 7))
    rows[:, 0], rows[:, 1], rows[:, 5], rows[:, 6] = road, -1, yaw_deg, 3.75
    rows[:, 2], rows[:, 3], rows[:, 4] = foot[0] + aside_m, foot[1] - 5 - run, run / 25.5 * 3.5
    return rows


def complaints(*ramps):
    return list(astray_on_ramps(LANES, np.concatenate(ramps)))


def test_a_ramp_belongs_to_the_portal_at_its_foot():
    inwards, outwards = ramp(1, ENTRANCE, yaw_deg=DOWN), ramp(3, EXIT, yaw_deg=UP)
    from_head = np.linalg.norm(outwards[-1, 2:4] - LANES.middles, axis=1)
    assert from_head[0] < from_head[1]
    assert complaints(inwards, outwards) == []


@pytest.mark.parametrize(
    ("astray", "said"),
    [
        ({"yaw_deg": DOWN}, "lanes on the ramp of portal 1 run the wrong way"),
        ({"yaw_deg": UP, "aside_m": 0.1}, "the lane on the ramp of portal 1 is 0.1000 m beside the middle of its door"),
    ],
)
def test_a_lane_astray_is_found(astray, said):
    assert complaints(ramp(1, ENTRANCE, yaw_deg=DOWN), ramp(3, EXIT, **astray)) == [said]


def test_a_portal_without_a_lane_is_found():
    assert complaints(ramp(1, ENTRANCE, yaw_deg=DOWN)) == ["no lane on the ramp of portal 1"]
    level = ramp(1, ENTRANCE, yaw_deg=DOWN)
    level[:, 4] = 0.0
    assert complaints(level) == ["no lane on the ramp of portal 0", "no lane on the ramp of portal 1"]
