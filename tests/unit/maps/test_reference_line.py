"""Reference lines: lengths, tangents and feet, by independent geometry."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage2usd.maps.road_nodes import straight, turn

lengths = st.floats(0.5, 40.0)
headings = st.floats(-math.pi, math.pi)
angles = st.floats(0.2, 2.6).flatmap(lambda angle: st.sampled_from([angle, -angle]))


def ahead(point, heading, length):
    return point[0] + length * math.cos(heading), point[1] + length * math.sin(heading)


@given(lengths, lengths, headings, angles)
def test_a_turn_touches_both_sides_and_has_no_kink(before, after, heading, angle):
    start = (3.0, -2.0)
    corner = ahead(start, heading, before)
    end = ahead(corner, heading + angle, after)
    line = turn(start, corner, end)
    assert line.at(0.0)[:2] == pytest.approx(start, abs=1e-9)
    assert line.at(line.length_m)[:2] == pytest.approx(end, abs=1e-7)
    places = np.array([line.at(s) for s in np.linspace(0.0, line.length_m, 4000)])
    steps = np.diff(places[:, :2], axis=0)
    # a polyline of chords is as long as the line, and each chord points where the line does in its middle
    assert np.linalg.norm(steps, axis=1).sum() == pytest.approx(line.length_m, rel=1e-3)
    said = np.exp(1j * places[1:, 2]) + np.exp(1j * places[:-1, 2])
    off = np.angle((steps[:, 0] + 1j * steps[:, 1]) / said)
    assert np.abs(off).max() < 0.05
    # it stays on the inner side of the corner, no farther away than the shorter side
    assert np.linalg.norm(places[:, :2] - corner, axis=1).max() <= max(before, after) + 1e-6
    radius = min(before, after) / math.tan(abs(angle) / 2)
    assert max(abs(arc.curvature_per_m) for arc in line.arcs) == pytest.approx(1 / radius)


def test_a_turn_without_an_angle_is_one_straight():
    assert turn((0.0, 0.0), (2.0, 0.0), (5.0, 0.0)) == straight((0.0, 0.0), (5.0, 0.0))


@given(lengths, headings, st.floats(-5.0, 45.0), st.floats(-8.0, 8.0))
def test_a_foot_is_where_the_line_is_beside_it(length, heading, s, t):
    line = straight((1.0, 2.0), ahead((1.0, 2.0), heading, length))
    assert line.foot(line.beside(s, t)) == pytest.approx((s, t), abs=1e-9)


def test_a_line_that_bends_has_no_foot():
    with pytest.raises(ValueError, match="bends"):
        turn((0.0, 0.0), (2.0, 0.0), (2.0, 2.0)).foot((1.0, 1.0))
