"""Lenses against OpenCV, against formulas written out here, and against themselves."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage2usd.sensors.rays.lenses import KannalaBrandt, Pinhole, RadiusPolynomial, WoodScape

KB = KannalaBrandt(
    size_px=(1280, 960),
    centre_px=(641.5, 478.75),
    focal_px=(330.0, 327.5),
    coefficients=(0.05, -0.01, 0.002, -0.0004),
    max_angle_rad=math.radians(95.0),
)
WOODSCAPE = WoodScape(
    size_px=(1280, 966),
    centre_px=(640 + 3.942, 483 - 3.093),
    coefficients_px=(339.749, -31.988, 48.275, -7.201),
    aspect_ratio=1.02,
    max_angle_rad=math.radians(95.0),
)
PINHOLE = Pinhole(size_px=(1600, 900), centre_px=(812.5, 440.0), focal_px=(1266.4, 1250.0))
FISHEYES = pytest.mark.parametrize("lens", [KB, WOODSCAPE], ids=["kannala_brandt", "woodscape"])


def directions(most_deg, count=20_000, seed=3):
    """Points at all distances from 5 cm to 50 m, up to an angle from the axis."""
    draw = np.random.default_rng(seed)
    angle, turn = draw.uniform(0, math.radians(most_deg), count), draw.uniform(0, math.tau, count)
    unit = np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=1)
    return unit * np.exp(draw.uniform(math.log(0.05), math.log(50), count))[:, None]


def test_kannala_brandt_is_opencvs_fisheye():
    """Whose first pixel has its middle at (0, 0)."""
    points = directions(89.0)
    matrix = np.array([[330.0, 0, 641.0], [0, 327.5, 478.25], [0, 0, 1]])
    theirs, _ = cv2.fisheye.projectPoints(points[:, None], np.zeros(3), np.zeros(3), matrix, np.array(KB.coefficients))
    assert np.abs(KB.project(points) - 0.5 - theirs[:, 0]).max() < 1e-6
    pixels = KB.project(points)
    back = cv2.fisheye.undistortPoints(pixels[:, None] - 0.5, matrix, np.array(KB.coefficients))[:, 0]
    ours = KB.rays(pixels)
    near = ours[:, 2] > 0.2  # where a picture on a plane is of a size that can be compared
    assert np.abs(ours[near, :2] / ours[near, 2:] - back[near]).max() < 1e-5


def test_woodscape_is_the_formula_of_its_calibration_files():
    """Of its projection.py, written out: size / 2 + offset - 0.5 is the principal point, from a pixel's middle."""
    points = directions(95.0)
    for point, (column, row) in zip(points[:2000].tolist(), WOODSCAPE.project(points[:2000]).tolist(), strict=True):
        x, y, z = point
        chi = math.sqrt(x * x + y * y)
        theta = math.pi / 2 - math.atan2(z, chi)
        rho = 339.749 * theta - 31.988 * theta**2 + 48.275 * theta**3 - 7.201 * theta**4
        assert column - 0.5 == pytest.approx(rho * x / chi + 3.942 + 1280 / 2 - 0.5, abs=1e-9)
        assert row - 0.5 == pytest.approx(rho * y / chi * 1.02 - 3.093 + 966 / 2 - 0.5, abs=1e-9)


def test_a_pinhole_is_opencvs_without_distortion():
    points = directions(80.0)
    matrix = np.array([[1266.4, 0, 812.0], [0, 1250.0, 439.5], [0, 0, 1]])
    theirs, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, None)
    assert PINHOLE.project(points) - 0.5 == pytest.approx(theirs[:, 0], rel=1e-12, abs=1e-7)


@pytest.mark.parametrize("lens", [KB, WOODSCAPE, PINHOLE], ids=["kannala_brandt", "woodscape", "pinhole"])
def test_the_ray_of_every_pixel_is_shown_in_its_middle(lens):
    middles = lens.middles()
    assert middles[[0, -1]].tolist() == [[0.5, 0.5], [lens.size_px[0] - 0.5, lens.size_px[1] - 0.5]]
    rays = lens.rays(middles)
    seen = np.isfinite(rays).all(axis=1)
    assert seen.mean() > 0.7
    assert np.abs(np.linalg.norm(rays[seen], axis=1) - 1.0).max() <= 1e-12
    assert np.abs(lens.project(rays[seen] * 7.0) - middles[seen]).max() < 1e-8
    assert lens.within(middles).all()
    assert not lens.within([[-0.1, 5.0], [5.0, lens.size_px[1]], [math.nan, 5.0]]).any()


@FISHEYES
def test_nothing_is_seen_beyond_the_field_of_view(lens):
    points = directions(180.0)
    angle = np.degrees(np.arccos(points[:, 2] / np.linalg.norm(points, axis=1)))
    pixels = lens.project(points)
    assert (np.isfinite(pixels).all(axis=1) == (angle <= 95.0)).all()
    (edge,) = lens.project([[math.sin(math.radians(95 - 1e-9)), 0.0, math.cos(math.radians(95 - 1e-9))]])
    within, beyond = lens.rays(edge + np.array([[-1e-3, 0], [1e-3, 0]]))
    assert np.isfinite(within).all()
    assert np.isnan(beyond).all()
    assert np.isnan(lens.project([[0.0, 0.0, 0.0]])).all()


def test_the_axis_is_shown_at_the_centre():
    for lens in (KB, WOODSCAPE, PINHOLE):
        assert lens.project([[0.0, 0.0, 3.0]])[0] == pytest.approx(lens.centre_px)
        assert lens.rays([lens.centre_px])[0] == pytest.approx([0.0, 0.0, 1.0])
    assert np.isnan(PINHOLE.project([[0.1, 0.0, -1.0], [0.1, 0.0, 0.0]])).all()


@pytest.mark.parametrize("lens", [KB, WOODSCAPE, PINHOLE], ids=["kannala_brandt", "woodscape", "pinhole"])
def test_a_lens_before_a_smaller_picture_sees_the_same(lens):
    points = directions(75.0, 500)
    small = lens.resized((333, 250))
    ratio = np.array([333 / lens.size_px[0], 250 / lens.size_px[1]])
    assert small.project(points) == pytest.approx(lens.project(points) * ratio, abs=1e-9)


@given(st.tuples(*[st.floats(-0.3, 0.3)] * 4))
def test_a_polynomial_grows_up_to_the_angle_that_is_told(coefficients):
    k1, k2, k3, k4 = coefficients
    end = RadiusPolynomial((0.0, 1.0, 0.0, k1, 0.0, k2, 0.0, k3, 0.0, k4)).grows_up_to_rad
    assert 0 < end <= math.pi

    def slope(t):
        return 1 + 3 * k1 * t**2 + 5 * k2 * t**4 + 7 * k3 * t**6 + 9 * k4 * t**8

    assert slope(np.linspace(0, end, 3000)).min() > -1e-6
    if end < math.pi:
        assert slope(np.linspace(end, end + math.radians(0.02), 9)).min() <= 0
