"""Motion blur and rolling shutter against the ways of pixels, which are computed here from the lens's own formula."""

import numpy as np
import pytest
from scipy.linalg import expm

from garage2usd.common.errors import ConfigError
from garage2usd.sensors.motion_blur import exposed_in_motion
from garage2usd.sensors.rays.lenses import KannalaBrandt, Pinhole
from garage2usd.sensors.rig.poses import Twist
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping
from garage2usd.sensors.rig.sensors import CameraEffects

SIZE = 200, 120
PINHOLE = Pinhole(size_px=SIZE, centre_px=(100.0, 60.0), focal_px=(150.0, 150.0))
FISHEYE = KannalaBrandt(
    size_px=SIZE,
    centre_px=(100.0, 60.0),
    focal_px=(140.0, 140.0),
    coefficients=(0.02, -0.01, 0.0, 0.0),
    max_angle_rad=1.6,
)
EVERYWHERE = np.ones(SIZE[::-1], dtype=bool)
COLUMNS, ROWS = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)


def twist(velocity=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
    return Twist(np.array(velocity, dtype=float), np.array(turn, dtype=float))


def dot(column, row, width_px=1.2):
    spot = np.exp(-((COLUMNS - column) ** 2 + (ROWS - row) ** 2) / (2 * width_px**2))
    return np.repeat(spot[..., None], 3, axis=2)


def moments(light):
    """Middle and covariance of where the light is."""
    weight = light[..., 0] / light[..., 0].sum()
    places = np.stack([COLUMNS.ravel(), ROWS.ravel()])
    middle = places @ weight.ravel()
    return middle, np.cov(places, aweights=weight.ravel(), bias=True)


def shown(point, lens):
    """Where a lens shows a point, by its formula."""
    x, y, z = point
    if lens is PINHOLE:
        return np.array([150 * x / z + 100, 150 * y / z + 60])
    across = np.hypot(x, y)
    angle = np.arctan2(across, z)
    radius = 140 * (angle + 0.02 * angle**3 - 0.01 * angle**5)
    return np.array([100 + radius * x / across, 60 + radius * y / across])


def after(point, velocity, turn, seconds):
    """A standing point in a camera that moved on: the solution of p' = -v - w x p."""
    rate = np.zeros((4, 4))
    rate[:3, :3] = -np.cross(turn, np.eye(3)).T
    rate[:3, 3] = -np.array(velocity)
    return (expm(rate * seconds) @ [*point, 1.0])[:3]


@pytest.mark.parametrize("lens", [PINHOLE, FISHEYE], ids=["pinhole", "fisheye"])
@pytest.mark.parametrize(
    ("velocity", "turn"),
    [
        ((3.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        ((0.0, 0.0, 9.0), (0.0, 0.0, 0.0)),
        ((0.0, 0.0, 0.0), (0.0, 2.5, 0.0)),
        ((0.0, 0.0, 0.0), (0.0, 0.0, 4.0)),
        ((1.0, 0.5, 2.0), (0.5, -1.0, 1.0)),
    ],
    ids=["aside", "ahead", "yaw", "roll", "all"],
)
def test_blur_is_as_long_as_the_way_of_the_pixel(lens, velocity, turn):
    point = np.array([0.9, 0.4, 3.0])
    column, row = shown(point, lens)
    # all around the camera at one distance, as the lens has depth
    depth = np.full(SIZE[::-1], point[2] if lens is PINHOLE else np.linalg.norm(point))
    exposure_s = 0.06
    effects = CameraEffects(exposure_s=exposure_s)
    light = dot(column, row)
    blurred = exposed_in_motion(light, depth, EVERYWHERE, lens, twist(velocity, turn), effects)
    first, last = (shown(after(point, velocity, turn, side * exposure_s / 2), lens) for side in (-1, 1))
    way = last - first
    assert np.hypot(*way) > 5
    (middle, covariance), (_, still) = moments(blurred), moments(light)
    along = way / np.hypot(*way)
    # light spread evenly over a way has a twelfth of its square as variance
    assert (12 * along @ (covariance - still) @ along) ** 0.5 == pytest.approx(np.hypot(*way), rel=0.05)
    assert middle == pytest.approx((first + last) / 2, abs=0.3)
    assert blurred.sum() == pytest.approx(light.sum(), rel=0.15)


@pytest.mark.parametrize("lens", [PINHOLE, FISHEYE], ids=["pinhole", "fisheye"])
@pytest.mark.parametrize("turn_rad_s", [0.0, 0.8])
def test_rolling_shutter_shears_an_edge_by_the_way_of_its_pixels(lens, turn_rad_s):
    velocity, turn, readout_s = (2.0, 0.0, 0.0), (0.0, turn_rad_s, 0.0), 0.05
    depth_m = 4.0
    depth = np.full(SIZE[::-1], depth_m)
    rays = lens.rays(lens.middles()).reshape(*SIZE[::-1], 3)
    # a wall's edge at x = 0.5 m where it is seen at once
    points = rays * (depth / (rays[..., 2] if lens is PINHOLE else 1.0))[..., None]
    light = np.repeat((points[..., 0] > 0.5).astype(float)[..., None], 3, axis=2)
    sheared = exposed_in_motion(
        light, depth, EVERYWHERE, lens, twist(velocity, turn), CameraEffects(readout_s=readout_s)
    )
    errors, shears = [], []
    for row in range(10, 110, 10):
        time = ((row + 0.5) / SIZE[1] - 0.5) * readout_s
        edge = SIZE[0] - light[row, :, 0].sum()
        column = int(edge)
        point = points[row, column] + (points[row, column + 1] - points[row, column]) * (edge - column - 0.5)
        wanted = shown(after(point, velocity, turn, time), lens)
        if abs(wanted[1] - row - 0.5) < 0.5:
            errors.append(SIZE[0] - sheared[row, :, 0].sum() - wanted[0])
            shears.append(wanted[0] - edge)
    assert len(errors) >= 8
    assert np.ptp(shears) > 1.5
    assert np.abs(errors).max() < 1.0


def test_what_is_near_is_blurred_over_what_is_far():
    is_bar = (np.abs(COLUMNS - 100) < 15) & (np.abs(ROWS - 60) < 40)
    depth = np.where(is_bar, 2.0, 20.0)
    light = np.repeat(is_bar.astype(float)[..., None], 3, axis=2)
    effects = CameraEffects(exposure_s=0.08)
    blurred = exposed_in_motion(light, depth, EVERYWHERE, PINHOLE, twist((2.0, 0.0, 0.0)), effects)[60, :, 0]
    way_px = 150 * 2.0 * 0.08 / 2.0
    lit, full = np.flatnonzero(blurred > 0.02), np.flatnonzero(blurred > 0.98)
    assert lit[-1] - lit[0] + 1 == pytest.approx(30 + way_px, abs=2)
    assert full[-1] - full[0] + 1 == pytest.approx(30 - way_px, abs=2)
    assert blurred.sum() == pytest.approx(30, rel=0.05)


def test_what_moves_with_the_camera_stays_sharp_and_unmixed():
    moving = ROWS < 80
    light = np.random.default_rng(2).uniform(0, 0.2, (*SIZE[::-1], 3))
    light[80:] = np.random.default_rng(3).uniform(0.8, 1, (40, SIZE[0], 3))
    effects = CameraEffects(exposure_s=0.05, readout_s=0.03)
    blurred = exposed_in_motion(light, np.where(moving, 5.0, 0.5), moving, PINHOLE, twist((0.0, 2.0, 0.0)), effects)
    assert np.allclose(blurred[80:], light[80:])
    assert blurred[:77].max() < 0.2 + 1e-9


@pytest.mark.parametrize("effects", [CameraEffects(), CameraEffects(exposure_s=0.1, readout_s=0.1)])
def test_a_camera_that_stands_or_does_not_expose_in_time_changes_nothing(effects):
    light = np.random.default_rng(2).uniform(0, 1, (*SIZE[::-1], 3))
    depth = np.full(SIZE[::-1], np.inf)
    motion = twist((3.0, 0.0, 0.0)) if not effects.shows_motion else twist()
    assert np.array_equal(exposed_in_motion(light, depth, EVERYWHERE, PINHOLE, motion, effects), light)


def test_a_camera_far_from_the_axle_moves_as_the_vehicle_turns():
    # 3 m ahead of the axle, looking to the left: turning left moves it along its own view
    to_vehicle = np.array([[1.0, 0, 0, 3], [0, 0, 1, 0], [0, -1, 0, 1], [0, 0, 0, 1]])
    part = twist((2.0, 0.0, 0.0), (0.0, 0.0, 0.5)).of_part(to_vehicle)
    assert part.velocity_m_s == pytest.approx([2.0, 0.0, 1.5])
    assert part.turn_rad_s == pytest.approx([0.0, -0.5, 0.0])


def test_twist_between_two_poses_leads_from_one_to_the_other():
    motion = twist((1.0, -0.3, 2.0), (0.2, 0.5, -0.1))
    points = np.eye(3) * 4
    pose = np.eye(4)
    origin = motion.seen_after(np.zeros((1, 3)), 0.02)[0]
    turn = (motion.seen_after(np.eye(3), 0.02) - origin).T
    later = np.eye(4)
    later[:3, :3], later[:3, 3] = turn.T, -turn.T @ origin
    found = Twist.between(pose, later, 0.02)
    assert found.turn_rad_s == pytest.approx(motion.turn_rad_s, abs=1e-9)
    assert found.velocity_m_s == pytest.approx(motion.velocity_m_s, abs=1e-3)
    assert found.seen_after(points, 0.02) == pytest.approx(motion.seen_after(points, 0.02), abs=1e-4)


@pytest.mark.parametrize("name", ["exposure_s", "readout_s"])
def test_around_views_and_long_exposures_are_refused(name):
    around = read_rig("avp_around_view").model_dump(mode="json")
    around["sensors"][0]["effects"] = {name: 0.01}
    with pytest.raises(ConfigError, match=f"without {name}"):
        rig_from_mapping(around)
    front = read_rig("avp_surround").model_dump(mode="json")["sensors"][0]
    with pytest.raises(ConfigError, match=name) as refused:
        rig_from_mapping({"name": "r", "sensors": [{**front, "effects": {name: 3.0}}]})
    assert refused.value.field == f"rig.sensors.0.effects.{name}"
