"""Around views: which place stands for which ground, what is smeared where, and what is refused."""

import numpy as np
import pytest

from garage2usd.common.errors import ConfigError, StageError
from garage2usd.recordings import record
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

CAMERA = {
    "kind": "kannala_brandt",
    "size_px": [640, 480],
    "focal_px": [165.0, 165.0],
    "coefficients": [0.05, -0.01, 0.002, -0.0004],
    "field_of_view_deg": 190.0,
    "pitch_deg": 30.0,
    "recorded": False,
}
FRONT = {**CAMERA, "name": "front", "position_m": [3.4, 0, 0.6]}
REAR = {**CAMERA, "name": "rear", "position_m": [-0.75, 0, 0.8], "yaw_deg": 180}
LEFT = {**CAMERA, "name": "left", "position_m": [1.9, 1.0, 1.0], "yaw_deg": 90}
RIGHT = {**CAMERA, "name": "right", "position_m": [1.9, -1.0, 1.0], "yaw_deg": -90}
AROUND = {"kind": "around_view", "name": "around", "size_px": [400, 500], "metres_per_px": 0.02}


def rig_of(around, *others):
    return rig_from_mapping({"name": "own", "sensors": [{**AROUND, **around}, *(others or (FRONT, REAR, LEFT, RIGHT))]})


def lens_of(**around):
    return rig_of(around).cameras[0].lens


def to_view(*points):
    """From the vehicle's axes to those of a view whose middle is 1.4 m before the rear axle."""
    return np.array([(-y, 1.4 - x, -z) for x, y, z in points])


def test_a_pixel_is_a_square_of_the_ground_with_the_nose_at_the_top():
    lens = lens_of()
    found = lens.project(to_view((1.4, 0, 0), (4.4, 0, 0), (1.4, 3, 0), (-1.6, -2, 0)))
    assert found == pytest.approx(np.array([(200, 250), (200, 100), (50, 250), (300, 400)]))
    assert lens.ground(found) == pytest.approx(to_view((1.4, 0, 0), (4.4, 0, 0), (1.4, 3, 0), (-1.6, -2, 0))[:, :2])


def test_rays_lead_from_the_cameras_to_the_ground_and_back():
    lens = lens_of()
    middles = lens.middles()
    rays, starts = lens.rays(middles), lens.starts(middles)
    seen = np.isfinite(rays).all(axis=1)
    assert np.linalg.norm(rays[seen], axis=1) == pytest.approx(1)
    assert {tuple(np.round(place, 6)) for place in starts} == {
        tuple(place) for place in to_view((3.4, 0, 0.6), (-0.75, 0, 0.8), (1.9, 1, 1), (1.9, -1, 1)).round(6)
    }
    ground = starts[seen] - rays[seen] * (starts[seen, 2] / rays[seen, 2])[:, None]
    assert lens.project(ground) == pytest.approx(middles[seen], abs=1e-6)
    assert not seen.reshape(500, 400)[250, 200]
    assert (~seen).sum() == lens.over_car(middles).sum()


@pytest.mark.parametrize(("eye", "away"), [((3.4, 0), (1, 0.3)), ((-0.75, 0), (-1, 0.2)), ((1.9, 1), (0.2, 1))])
def test_what_is_high_lies_farther_away_on_the_same_ray(eye, away):
    lens = lens_of()
    foot, eye_m = np.add(eye, away), {3.4: 0.6, -0.75: 0.8, 1.9: 1.0}[eye[0]]
    low, high = lens.project(to_view((*foot, 0), (*foot, eye_m / 2)))
    start = lens.project(to_view((*eye, 0)))[0]
    assert high - start == pytest.approx(2 * (low - start))
    assert np.isnan(lens.project(to_view((*foot, eye_m), (*foot, 2.5)))).all()


def test_what_is_high_is_shown_by_the_nearest_camera_that_has_it_on_its_side_or_at_a_seam_by_none():
    lens = lens_of()
    generator = np.random.default_rng(5)
    points = np.column_stack([generator.uniform(-5, 5, (4000, 2)), generator.uniform(-0.55, 0, 4000)])
    shown = lens.project(points)
    counts = []
    for point, place in zip(points, shown, strict=True):
        seen = []
        for side, eye in enumerate(lens.eyes):
            stretch = eye.place_m[2] / (eye.place_m[2] - point[2])
            ground = eye.place_m[:2] + (point[:2] - eye.place_m[:2]) * stretch
            if lens.sectors([ground])[0] == side:
                seen.append((np.linalg.norm(point - eye.place_m), tuple(ground)))
        counts.append(len(seen))
        if seen:
            assert lens.ground([place])[0] == pytest.approx(min(seen)[1])
        else:
            assert np.isnan(place).all()
    assert {0, 1} <= set(counts)


def test_pictures_of_another_scale_show_the_same_ground():
    whole = rig_of({})
    half = whole.scaled(0.5)
    points = to_view((5, 1, 0), (1, -3, 0), (-2, 0.5, 0))
    assert half.cameras[0].lens.project(points) * 2 == pytest.approx(whole.cameras[0].lens.project(points))
    assert half.cameras[0].lens.car_m == whole.cameras[0].lens.car_m


def test_a_margin_makes_the_black_place_larger():
    plain, wide = lens_of(), lens_of(car_margin_m=0.2)
    assert np.subtract(wide.car_m, plain.car_m) == pytest.approx([-0.2, -0.2, 0.2, 0.2])


def test_what_a_camera_does_not_see_is_not_shown():
    narrow = {**FRONT, "field_of_view_deg": 60.0}
    lens = rig_of({}, narrow, REAR, LEFT, RIGHT).cameras[0].lens
    ahead, beside = lens.project(to_view((4.6, 0.0, 0), (4.2, 1.6, 0)))
    assert np.isfinite(lens.rays([ahead])).all()
    assert np.isnan(lens.rays([beside])).all()
    assert np.isfinite(lens_of().rays([beside])).all()


def test_its_parameters_tell_its_cameras():
    told = lens_of().parameters()
    assert told["model"] == "around_view"
    assert told["cameras"]["left"]["lens"]["model"] == "kannala_brandt"
    assert np.array(told["cameras"]["left"]["camera_to_view"])[:3, 3] == pytest.approx(to_view((1.9, 1, 1))[0])


def test_cameras_may_have_other_names():
    names = {"front": "FV", "rear": "RV", "left": "MVL", "right": "MVR"}
    others = [{**camera, "name": names[camera["name"]]} for camera in (FRONT, REAR, LEFT, RIGHT)]
    lens = rig_of({"cameras": names}, *others).cameras[0].lens
    assert [eye.name for eye in lens.eyes] == ["FV", "RV", "MVL", "MVR"]


@pytest.mark.parametrize(
    ("around", "others", "said"),
    [
        ({"cameras": {"front": "nose"}}, (), "cameras on the vehicle"),
        ({"cameras": {"left": "around"}}, (), "cameras on the vehicle"),
        ({}, (FRONT, REAR, LEFT), "its right is right"),
        ({}, ({**FRONT, "position_m": [3, 0, 0]}, REAR, LEFT, RIGHT), "front over the ground"),
        ({}, (FRONT, REAR, LEFT, {**RIGHT, "mount": "world"}), "cameras on the vehicle"),
        ({"position_m": [1.4, 0, 0.1]}, (), "position_m"),
        ({"yaw_deg": 90}, (), "yaw_deg"),
        ({"mount": "world"}, (), "mount"),
        ({"metres_per_px": 0}, (), "metres_per_px"),
        ({"recorded": False}, (), "recorded"),
    ],
)
def test_what_it_cannot_look_through_is_refused(around, others, said):
    with pytest.raises(ConfigError) as raised:
        rig_of(around, *others)
    assert said in str(raised.value)


def test_the_shipped_rig_sees_all_the_ground_around_the_car():
    (camera,) = read_rig("avp_around_view").cameras
    middles = camera.lens.middles()
    unseen = np.isnan(camera.lens.rays(middles)).any(axis=1)
    assert (unseen == camera.lens.over_car(middles)).all()


def test_scale_is_of_what_is_recorded_and_the_view_looks_through_the_cameras_of_its_rig():
    rig = rig_of({}, {**FRONT, "recorded": True}, REAR, LEFT, RIGHT).scaled(0.5)
    around, front, rear, *_ = rig.sensors
    assert around.size_px == (200, 250)
    assert front.size_px == (320, 240)
    assert rear.size_px == (640, 480)
    assert [eye.lens.size_px for eye in around.lens.eyes] == [(320, 240), *[(640, 480)] * 3]
    assert rig_from_mapping(rig.model_dump(mode="json")) == rig


def test_a_scale_with_pixels_of_more_than_a_metre_is_refused():
    with pytest.raises(ConfigError, match=r"pixels of around are 0\.001 to 1\.0 m wide"):
        rig_of({"metres_per_px": 0.2}).scaled(0.1)


def test_a_camera_that_is_not_recorded_asks_for_no_drive(tmp_path):
    watching = {**CAMERA, "name": "watching", "mount": "world", "position_m": [0, 0, 2], "recorded": True}
    rig = rig_from_mapping({"name": "own", "sensors": [watching, FRONT]})
    assert [sensor.name for sensor in rig.recorded] == ["watching"]
    with pytest.raises(StageError):  # and not for want of a drive
        record(tmp_path / "none.usdz", tmp_path / "out", rig=rig, along=None, pictures=["colour"])
