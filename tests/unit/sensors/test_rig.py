"""Rigs: what is shipped, how mounts are turned, and what is refused."""

import math

import numpy as np
import pytest
import trimesh

from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.objects.car import CarSpec
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.rig import RIG_NAMES, Rig, read_rig, rig_from_mapping
from garage2usd.sensors.rig.sensors import KannalaBrandtCamera, WoodScapeCamera
from garage2usd.stage.prototypes import asset_of

PINHOLE = {"kind": "pinhole", "name": "a", "position_m": [0, 0, 1], "size_px": [64, 48], "focal_px": [50, 50]}
FISHEYE = {**PINHOLE, "kind": "kannala_brandt", "coefficients": [0.05, -0.01, 0.002, -0.0004], "field_of_view_deg": 190}
SPINNING = {"kind": "spinning_lidar", "name": "l", "position_m": [0, 0, 2], "azimuth_steps": 9, "range_m": [1, 9]}


def rig(*sensors, **settings):
    return rig_from_mapping({"name": "own", "sensors": list(sensors), **settings})


@pytest.mark.parametrize("name", RIG_NAMES)
def test_shipped_rigs_are_read_by_name_and_as_files(name):
    made = read_rig(name)
    assert made.name == name
    assert made.title
    assert read_rig(f"garage2usd/sensors/rigs/{name}.toml") == made
    assert Rig.model_validate_json(made.model_dump_json()) == made


def test_the_shipped_rigs_hold_what_their_names_say():
    surround, woodscape = read_rig("avp_surround"), read_rig("woodscape_like")
    assert [type(each) for each in surround.sensors] == [KannalaBrandtCamera] * 4
    assert [type(each) for each in woodscape.sensors] == [WoodScapeCamera] * 4
    assert [each.name for each in woodscape.sensors] == ["FV", "RV", "MVL", "MVR"]
    (lidar,) = read_rig("lidar_32").lidars
    assert len(lidar.beams_deg) == 32
    assert lidar.beams_deg[0] == -30.67
    assert lidar.beams_deg[-1] == 10.67
    assert [each.mount for each in read_rig("column_camera").sensors] == ["column"]
    around = read_rig("avp_around_view")
    assert [each.name for each in around.cameras] == ["around"]
    assert [each.model_copy(update={"recorded": True}) for each in around.sensors[1:]] == list(surround.sensors)


@pytest.mark.parametrize("name", RIG_NAMES)
def test_sensors_on_cars_stand_outside_of_the_body_and_near_it(name):
    """Of the mesh of the car, whose front looks to -Z and whose middle is at 0."""
    made = read_rig(name)
    body = next(body for body in CAR_BODIES if body.name == made.car)
    axle_m = body.front_overhang_m + body.wheelbase_m - body.length_m / 2
    asset = asset_of(CarSpec(body.name, "blue").shape)
    hull = trimesh.convex.convex_hull(
        np.concatenate([part.points for part in asset.parts if "Mirror" not in part.name])
    )
    for sensor in made.sensors:
        if sensor.mount == "vehicle" and not isinstance(sensor, AroundViewCamera):  # which stands on the ground below
            x, y, z = sensor.position_m
            over_faces = ((np.array([-y, z, axle_m - x]) - hull.triangles[:, 0]) * hull.face_normals).sum(axis=1)
            assert 0.0 < over_faces.max() < 0.4, sensor.name


def test_a_mount_turns_to_the_left_looks_down_and_rolls_to_the_right():
    def looks(**turns):
        return rig({**PINHOLE, **turns}).sensors[0].sensor_to_vehicle

    ahead = looks()
    assert ahead[:3, :3] @ [0, 0, 1] == pytest.approx([1, 0, 0])
    assert ahead[:3, :3] @ [1, 0, 0] == pytest.approx([0, -1, 0])
    assert ahead[:3, :3] @ [0, 1, 0] == pytest.approx([0, 0, -1])
    assert ahead[:, 3].tolist() == [0, 0, 1, 1]
    assert looks(yaw_deg=90)[:3, 2] == pytest.approx([0, 1, 0])
    assert looks(pitch_deg=30)[:3, 2] == pytest.approx([math.cos(math.pi / 6), 0, -0.5])
    assert looks(roll_deg=90)[:3, 0] == pytest.approx([0, 0, -1])
    both = looks(yaw_deg=90, pitch_deg=30)
    assert both[:3, 2] == pytest.approx([0, math.cos(math.pi / 6), -0.5])
    lidar = rig({**SPINNING, "elevations_deg": [0], "yaw_deg": 90}).sensors[0].sensor_to_vehicle
    assert lidar[:3, :3] @ [1, 0, 0] == pytest.approx([0, 1, 0])
    assert np.linalg.det(both[:3, :3]) == pytest.approx(1.0)


def test_the_middle_of_the_picture_is_the_centre_unless_told():
    assert rig(PINHOLE).cameras[0].lens.centre_px == (32, 24)
    assert rig({**PINHOLE, "centre_px": [3, 4]}).cameras[0].lens.centre_px == (3, 4)
    woodscape = {**PINHOLE, "kind": "woodscape", "coefficients_px": [9, 0, 0, 0], "field_of_view_deg": 180}
    del woodscape["focal_px"]
    assert rig({**woodscape, "centre_offset_px": [3, -4]}).cameras[0].lens.centre_px == (35, 20)


@pytest.mark.parametrize(
    ("sensors", "field", "allowed"),
    [
        ([PINHOLE, {**FISHEYE, "name": "A"}], "rig.sensors", "sensors of different names; 2 are a"),
        ([{**FISHEYE, "field_of_view_deg": 320}], "rig.sensors.0.field_of_view_deg", "at most 256.2"),
        ([{**FISHEYE, "coefficients": [1, 2, 3]}], "rig.sensors.0.coefficients.3", "a value"),
        ([PINHOLE, {**PINHOLE, "kind": "thermal"}], "rig.sensors.1.kind", "one of pinhole, kannala_brandt"),
        ([{"name": "a"}], "rig.sensors.0.kind", "one of pinhole, kannala_brandt"),
        ([{**PINHOLE, "focal": 3}], "rig.sensors.0.focal", "one of the keys"),
        ([{**PINHOLE, "size_px": [64, 4]}], "rig.sensors.0.size_px.1", "greater than or equal to 16"),
        ([{**PINHOLE, "name": "a/b"}], "rig.sensors.0.name", "pattern"),
        ([], "rig.sensors", "at least 1"),
        ([SPINNING], "rig.sensors.0", "elevations_deg alone, or channels"),
        ([{**SPINNING, "elevations_deg": [1], "channels": 2}], "rig.sensors.0", "elevations_deg alone, or channels"),
        ([{**SPINNING, "elevations_deg": [1], "range_m": [9, 1]}], "rig.sensors.0.range_m", "a nearest distance"),
    ],
)
def test_what_is_wrong_is_named(sensors, field, allowed):
    with pytest.raises(ConfigError) as refused:
        rig(*sensors)
    assert refused.value.field == field
    assert allowed in refused.value.allowed


def test_a_key_of_another_kind_of_sensor_is_not_offered():
    with pytest.raises(ConfigError) as refused:
        rig({**PINHOLE, "channels": 3})
    assert "focal_px" in refused.value.allowed
    assert "channels" not in refused.value.allowed


def test_unknown_rigs_and_cars_are_named(tmp_path):
    with pytest.raises(
        ConfigError, match="one of avp_around_view, avp_surround, column_camera, lidar_32, woodscape_like, or a path"
    ):
        read_rig("surround")
    with pytest.raises(ConfigError, match="readable file"):
        read_rig(tmp_path / "none.toml")
    file = tmp_path / "own.toml"
    file.write_text("sensors = [")
    with pytest.raises(ConfigError, match="TOML"):
        read_rig(file)
    with pytest.raises(ConfigError, match=r"rig\.car: got 'truck'; allowed: one of hatchback"):
        rig(PINHOLE, car="truck")
