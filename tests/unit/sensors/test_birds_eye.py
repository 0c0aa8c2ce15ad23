"""Bird's-eye views as geometry, and their masks."""

import numpy as np
import pytest
from pydantic import ValidationError

from garage2usd.objects import CLASSES
from garage2usd.sensors.rays.birds_eye import FREE_CLASSES, BirdsEye, free_space
from garage2usd.sensors.rays.sight import seen_points


def test_forwards_is_up_and_left_is_left():
    view = BirdsEye(metres_per_px=0.05, size_px=(400, 200), centre_m=(1.0, 0.5))
    assert view.places([(1.0, 0.5), (2.0, 0.5), (1.0, 1.5)]).tolist() == [[200, 100], [200, 80], [180, 100]]


def test_lens_and_places_agree_at_every_height():
    view = BirdsEye(metres_per_px=0.03, size_px=(64, 48), centre_m=(2.0, -1.0))
    rng = np.random.default_rng(1)
    points = rng.uniform(-5, 5, (50, 3))
    to_camera = np.linalg.inv(view.sensor_to_vehicle())
    in_camera = points @ to_camera[:3, :3].T + to_camera[:3, 3]
    assert np.abs(view.lens.project(in_camera) - view.places(points[:, :2])).max() < 1e-9
    assert np.linalg.det(view.sensor_to_vehicle()[:3, :3]) == pytest.approx(1.0)


def test_depth_gives_the_place_below_each_pixel():
    view = BirdsEye(metres_per_px=0.1, size_px=(40, 20))
    depth = np.full((20, 40), 20.0, dtype=np.float32)
    depth[3, 4] = np.inf
    seen = seen_points(view.lens, depth, view.sensor_to_vehicle())
    assert not np.isfinite(seen[3, 4]).any()
    seen[3, 4] = seen[3, 5]
    assert np.abs(seen[..., 2]).max() < 1e-6  # on the ground under a camera at 20 m
    places = view.places(seen.reshape(-1, 3)[:, :2]).reshape(20, 40, 2)
    rows, columns = np.mgrid[:20, :40] + 0.5
    apart = np.abs(places - np.stack([columns, rows], axis=-1)).max(axis=-1)
    assert np.delete(apart.ravel(), 3 * 40 + 4).max() < 1e-6


def test_the_ego_mask_is_its_ground():
    view = BirdsEye(metres_per_px=0.02, size_px=(400, 400), centre_m=(1.4, 0.0))
    body = [(-0.8, -0.9), (3.4, -0.9), (3.4, 0.9), (-0.8, 0.9)]
    mirrors = [(2.0, -1.1), (2.2, -1.1), (2.2, 1.1), (2.0, 1.1)]
    mask = view.ground_mask([body, mirrors])
    assert mask.sum() * 0.02**2 == pytest.approx(4.2 * 1.8 + 0.2 * 0.4, rel=0.01)
    column, row = (int(value) for value in view.places([(0.0, 0.0)])[0])
    assert mask[row, column]
    assert (mask == mask[:, ::-1]).all()


def test_free_space_is_the_ground_that_is_seen():
    names = {entry.number: entry.label for entry in CLASSES}
    assert set(names.values()) > FREE_CLASSES
    classes = np.arange(256, dtype=np.uint8).reshape(16, 16)
    free = free_space(classes, names)
    for number, is_free in zip(classes.ravel().tolist(), free.ravel().tolist(), strict=True):
        assert is_free == (names.get(number) in FREE_CLASSES)
    assert not {"car", "column", "wall", "wheel_stop", "traffic_cone"} & FREE_CLASSES


@pytest.mark.parametrize("wrong", [{"metres_per_px": 0.0}, {"size_px": (8, 600)}, {"centre_m": (2e3, 0)}])
def test_settings_are_checked(wrong):
    with pytest.raises(ValidationError):
        BirdsEye(**wrong)


def test_a_lens_keeps_square_pixels():
    lens = BirdsEye(metres_per_px=0.02, size_px=(400, 200)).lens
    small = lens.resized((200, 100))
    assert (small.metres_per_px, small.centre_px) == (0.04, (100, 50))
    with pytest.raises(ValueError, match="another scale"):
        lens.resized((200, 200))
