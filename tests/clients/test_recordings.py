"""Recordings of drives: what the cameras see agrees with rays through the meshes, the drive, the car and itself."""

import importlib.util
import json
import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import yaml
from PIL import Image
from pxr import Sdf, Usd, UsdGeom
from support.label_tables import cars_of_plates, labelled_objects
from support.rays import Rays
from support.sample_files import REPOSITORY
from support.slot_corners import judge_corners
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.recordings import record
from garage2usd.render import Picture, SlotFormat
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
MOST_STRAY_PIXELS = 0.003
TRUTH = (Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC)
KINDS = (Picture.COLOUR, *TRUTH)
ROOF = {
    "kind": "pinhole",
    "name": "roof",
    "position_m": [1.1, 0.1, 1.6],
    "yaw_deg": 40.0,
    "size_px": [128, 80],
    "focal_px": [70.0, 75.0],
    "centre_px": [60.5, 41.25],
}
COLUMN = {
    "kind": "pinhole",
    "name": "pole",
    "mount": "column",
    "position_m": [0.6, 0.0, 2.2],
    "pitch_deg": 20.0,
    "size_px": [128, 80],
    "focal_px": [64.0, 64.0],
}
SCALE = 0.1


def mixed_rig():
    """A camera of each kind."""
    front, *_ = read_rig("avp_surround").model_dump()["sensors"]
    left = read_rig("woodscape_like").model_dump()["sensors"][2]
    sensors = [front, left]
    for sensor in (ROOF, COLUMN):
        # ten times as large, as the whole rig is scaled
        sizes = {
            key: [value / SCALE for value in sensor[key]]
            for key in ("size_px", "focal_px", "centre_px")
            if key in sensor
        }
        sensors.append({**sensor, **sizes})
    return rig_from_mapping({"name": "mixed", "sensors": sensors})


@pytest.fixture(scope="module")
def drive(builds):
    """A garage, and the way to a stall that a car is parked in."""
    built = builds(HAND_DRAWN, "usdc", "instanced")
    report = json.loads(built.report.read_text())
    stall = next(entry for entry in report["levels"][0]["stalls"] if entry["occupied"] and entry["use"] == "standard")
    return SimpleNamespace(
        report=built.report, stage=built.stage, labels=built.labels, stall=stall["name"], along=f"1:{stall['name']}"
    )


@pytest.fixture(scope="module")
def recorded(drive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("recording") / "drive"
    made = record(
        drive.stage,
        folder,
        rig=mixed_rig(),
        along=drive.along,
        every_m=40.0,
        scale=SCALE,
        pictures=TRUTH,
        slots=[SlotFormat.COCO],
    )
    table = json.loads((folder / "frames.json").read_text())
    frames = [read_frame(folder, frame) for frame in table["frames"]]
    return SimpleNamespace(folder=folder, table=table, frames=frames, made=made)


def read_frame(folder, frame):
    import OpenEXR

    with OpenEXR.File(str(folder / frame["files"]["depth"]), separate_channels=True) as file:
        depth = np.array(file.channels()["Z"].pixels).astype(float)
    digits = np.asarray(Image.open(folder / frame["files"]["instance"])).astype(int)
    return SimpleNamespace(about=frame, depth=depth, instance=digits @ [1, 256, 65536])


def rays_of(frame):
    """Unit rays through the middles of the pixels in OpenCV's camera axes, from the table alone; NaN for none."""
    (width, height), lens = frame["size_px"], frame["lens"]
    rows, columns = np.mgrid[:height, :width]
    middles = np.stack([columns, rows], axis=-1) + 0.5 - lens["centre_px"]
    if lens["model"] == "pinhole":
        rays = np.concatenate([middles / lens["focal_px"], np.ones((height, width, 1))], axis=-1)
        assert np.array(frame["intrinsics"]).ravel() == pytest.approx(
            [lens["focal_px"][0], 0, lens["centre_px"][0], 0, lens["focal_px"][1], lens["centre_px"][1], 0, 0, 1]
        )
        return rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    assert frame["depth"] == "along_ray"
    theta = np.linspace(0.0, lens["max_angle_rad"], 400_001)  # inverted by a table
    if lens["model"] == "kannala_brandt":
        k1, k2, k3, k4 = lens["coefficients"]
        radius, flat = theta + k1 * theta**3 + k2 * theta**5 + k3 * theta**7 + k4 * theta**9, middles / lens["focal_px"]
    else:
        k1, k2, k3, k4 = lens["coefficients_px"]
        radius = k1 * theta + k2 * theta**2 + k3 * theta**3 + k4 * theta**4
        flat = middles / [1.0, lens["aspect_ratio"]]
    length = np.linalg.norm(flat, axis=-1)
    angle = np.interp(length, radius, theta, right=np.nan)
    across = flat / length[..., None] * np.sin(angle)[..., None]
    return np.concatenate([across, np.cos(angle)[..., None]], axis=-1)


def test_every_pixel_shows_what_its_ray_meets(recorded, drive):
    objects = labelled_objects(drive.labels)
    stage = Usd.Stage.Open(str(drive.stage))
    stains = {entry["id"] for entry in objects if entry["class"] == "floor_stain"}
    ego = max(entry["id"] for entry in objects) + 1
    hidden = recorded.table["frames"][0]["hidden_objects"]
    left_out = {entry["id"] for entry in objects if entry["path"] in hidden}
    car_of = cars_of_plates(drive.labels)
    solid = {
        entry["path"]: car_of.get(entry["id"], entry["id"])
        for entry in objects
        if entry["class"] != "floor_stain" and car_of.get(entry["id"], entry["id"]) not in left_out
    }
    caster, seen_of = Rays(stage, solid), {}
    for frame in recorded.frames:
        rays = rays_of(frame.about)
        to_world = np.linalg.inv(frame.about["world_to_camera"])
        seen = np.isfinite(rays).all(axis=-1)
        assert not frame.instance[~seen].any()
        assert np.isinf(frame.depth[~seen]).all()
        whole = seen & ~np.isin(frame.instance, [*stains, ego])
        directions = rays[whole] @ to_world[:3, :3].T
        owner, place, _ = caster.cast(np.broadcast_to(to_world[:3, 3], directions.shape), directions)
        same = owner == frame.instance[whole]
        met = same & (owner > 0)
        assert met.sum() > 1000
        depth = frame.depth[whole][met]
        far = np.linalg.norm(place[met] - to_world[:3, 3], axis=-1)
        if frame.about["lens"]["model"] == "pinhole":
            far = far * rays[whole][met][:, 2]
        near = np.abs(far - depth) < 1e-4 + 2e-5 * depth
        seen_of.setdefault(frame.about["sensor"], []).append((np.count_nonzero(~same), len(same), near.mean()))
    assert len(seen_of) == 4
    for sensor, found in seen_of.items():
        strays, pixels, near = (np.array(column) for column in zip(*found, strict=True))
        assert strays.sum() / pixels.sum() < MOST_STRAY_PIXELS, sensor
        assert near.mean() > 1 - MOST_STRAY_PIXELS, sensor


def test_the_vehicle_is_where_the_drive_says(recorded, drive, tmp_path):
    trajectory = tmp_path / "way.csv"
    main(
        ["drive", str(drive.stage), "--stall", drive.stall, "--entrance", "1", "--leg", "in", "-o", str(trajectory)],
        standalone_mode=False,
    )
    columns = np.genfromtxt(trajectory, delimiter=",", names=True)
    poses = {frame["pose"]: frame for frame in recorded.table["frames"]}
    distances = [poses[number]["distance_m"] for number in sorted(poses)]
    assert distances[:-1] == pytest.approx(np.arange(len(distances) - 1) * 40.0, abs=1e-3)
    assert distances[-1] == pytest.approx(columns["arc_m"][-1], abs=1e-5)
    for frame in poses.values():
        at = {name: np.interp(frame["time_s"], columns["time_s"], columns[name]) for name in columns.dtype.names}
        assert at["arc_m"] == pytest.approx(frame["distance_m"], abs=2e-3)
        matrix = np.array(frame["vehicle_to_world"])
        assert matrix[:3, 3] == pytest.approx([at["x_m"], at["y_m"], at["z_m"]], abs=2e-3)
        level = np.cos(at["pitch_rad"])
        ahead = [-np.sin(at["yaw_rad"]) * level, np.sin(at["pitch_rad"]), -np.cos(at["yaw_rad"]) * level]
        assert matrix[:3, 0] == pytest.approx(ahead, abs=1e-3)
        assert matrix[1, 2] == pytest.approx(level, abs=1e-3)
        assert np.linalg.det(matrix) == pytest.approx(1.0)
    for frame in recorded.table["frames"]:
        if frame["mount"] == "vehicle":
            sensor = np.array(frame["vehicle_to_world"]) @ frame["sensor_to_vehicle"]
            assert np.array(frame["world_to_camera"]) @ sensor == pytest.approx(np.eye(4), abs=1e-9)


def test_the_parked_car_makes_room_and_the_column_sees_the_one_that_comes(recorded, drive):
    objects = labelled_objects(drive.labels)
    ego = max(entry["id"] for entry in objects) + 1
    (parked,) = recorded.table["frames"][0]["hidden_objects"]
    gone = next(entry for entry in objects if entry["path"] == parked)
    assert gone["class"] == "car"
    assert not any(gone["id"] in frame.instance for frame in recorded.frames)
    on_car = [frame for frame in recorded.frames if frame.about["mount"] == "vehicle"]
    assert not any(ego in frame.instance for frame in on_car)
    *_, last = (frame for frame in recorded.frames if frame.about["sensor"] == "pole")
    shows = last.instance == ego
    assert shows.sum() > 200
    (entry,) = (entry for entry in last.about["instances"] if entry["id"] == ego)
    assert (entry["class"], entry["pixels"]) == ("car", shows.sum())
    rays, to_world = rays_of(last.about), np.linalg.inv(last.about["world_to_camera"])
    in_camera = rays[shows] / rays[shows][:, 2:] * last.depth[shows][:, None]
    in_world = np.concatenate([in_camera, np.ones((len(in_camera), 1))], axis=1) @ to_world.T
    in_vehicle = in_world @ np.linalg.inv(last.about["vehicle_to_world"]).T
    low, high = in_vehicle.min(axis=0), in_vehicle.max(axis=0)
    # a hatchback of 4.05 m with its rear axle 0.70 m before its tail
    assert (low[:3] > [-0.71, -0.99, -0.005]).all()
    assert (high[:3] < [3.36, 0.99, 1.48]).all()


def test_the_slot_that_is_driven_to_is_free_and_others_are_as_the_stage_says(recorded, drive):
    report = json.loads(drive.report.read_text())
    slots = {
        slot["name"]: slot["occupied"] for slot in json.loads((recorded.folder / "slots.json").read_text())["slots"]
    }
    said = {stall["name"]: stall["occupied"] for stall in report["levels"][0]["stalls"]}
    assert said[drive.stall]
    assert not slots[drive.stall]
    others = said.keys() & slots.keys() - {drive.stall}
    assert {name: slots[name] for name in others} == {name: said[name] for name in others}
    assert any(slots.values())


def test_a_corner_that_is_seen_shows_the_floor_or_its_paint(recorded):
    counts = judge_corners(recorded.folder, recorded.table)
    assert min(counts.values()) > 50


def test_masks_show_the_car_that_garage2usd_drives(recorded, drive, tmp_path):
    """Its body as the animation has it, read with pxr: wheels may be turned."""
    layer = tmp_path / "car.usdc"
    arguments = ["drive", str(drive.stage), "--stall", drive.stall, "--animate", "-o", str(layer)]
    main(arguments, standalone_mode=False)
    stage = Usd.Stage.Open(str(layer))
    stage.GetPrimAtPath("/Garage").SetSpecifier(Sdf.SpecifierDef)
    car = stage.GetPrimAtPath("/Garage/DrivingCar")
    UsdGeom.Xformable(car).ClearXformOpOrder()
    caster = Rays(stage, {"/Garage/DrivingCar": 1})
    checked = 0
    for frame in recorded.table["frames"]:
        if frame["pose"] == 0 and frame["mount"] == "vehicle":
            mask = np.asarray(Image.open(recorded.folder / frame["ego_mask"]))
            assert set(np.unique(mask)) <= {0, 255}
            assert mask.shape == tuple(frame["size_px"][::-1])
            rays, place = rays_of(frame), np.array(frame["sensor_to_vehicle"])
            seen = np.isfinite(rays).all(axis=-1)
            directions = rays[seen] @ place[:3, :3].T
            to_car = np.array([[0, -1, 0], [0, 0, 1], [-1, 0, 0]])  # left is -X, up is Y, forward is -Z
            origin = to_car @ place[:3, 3]
            owner, _, _ = caster.cast(np.broadcast_to(origin, directions.shape), directions @ to_car.T)
            assert ((owner > 0) == (mask[seen] > 0)).mean() > 0.995
            assert not mask[~seen].any()
            checked += mask.any()
    assert checked >= 2


def test_calibration_files_give_the_same_pixels(recorded):
    """OpenCV from the YAML files of ROS, and WoodScape's formula from its JSON."""
    for frame in {frame["sensor"]: frame for frame in recorded.table["frames"]}.values():
        lens, folder = frame["lens"], recorded.folder / "calibration"
        (path,) = folder.glob(f"{frame['sensor']}.*")
        rays = rays_of(frame)
        rows, columns = np.indices(rays.shape[:2])
        ahead = rays[..., 2] > 0.01  # as far as OpenCV projects
        points = 5.0 * rays[ahead]
        x, y, z = points.T
        theta, chi = np.arctan2(np.hypot(x, y), z), np.hypot(x, y)
        if lens["model"] == "woodscape":
            said = json.loads(path.read_text())
            intrinsic = said["intrinsic"]
            rho = sum(intrinsic[f"k{power}"] * theta**power for power in (1, 2, 3, 4))
            u = rho * x / chi + intrinsic["cx_offset"] + intrinsic["width"] / 2 - 0.5
            v = rho * y / chi * intrinsic["aspect_ratio"] + intrinsic["cy_offset"] + intrinsic["height"] / 2 - 0.5
            theirs = np.stack([u, v], axis=1)
            i, j, k, w = said["extrinsic"]["quaternion"]
            turn = np.array(
                [
                    [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
                    [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
                    [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)],
                ]
            )
            assert turn == pytest.approx(np.array(frame["sensor_to_vehicle"])[:3, :3], abs=1e-9)
            assert said["extrinsic"]["translation"] == np.array(frame["sensor_to_vehicle"])[:3, 3].tolist()
            assert (said["name"], intrinsic["model"], intrinsic["poly_order"]) == ("MVL", "radial_poly", 4)
        else:
            said = yaml.safe_load(path.read_text())
            assert [said["image_width"], said["image_height"]] == frame["size_px"]
            matrix = np.array(said["camera_matrix"]["data"]).reshape(3, 3)
            distortion = np.array(said["distortion_coefficients"]["data"])
            project = {"equidistant": cv2.fisheye.projectPoints, "plumb_bob": cv2.projectPoints}
            zero = np.zeros(3)
            theirs, _ = project[said["distortion_model"]](points[:, None], zero, zero, matrix, distortion)
            theirs = theirs.reshape(-1, 2)
        # they count from the middle of the first pixel
        assert np.abs(theirs - np.stack([columns[ahead], rows[ahead]], axis=1)).max() < 1e-3


def test_shots_tell_what_was_recorded(recorded):
    shots = recorded.made.recording.shots
    assert [shot.name for shot in shots] == [frame["name"] for frame in recorded.table["frames"]]
    for shot, frame in zip(shots, recorded.table["frames"], strict=True):
        assert {kind: str(path.relative_to(recorded.folder)) for kind, path in shot.files.items()} == frame["files"]
        assert all(path.exists() for path in shot.files.values())
        to_world = shot.mount_to_world @ shot.sensor.sensor_to_vehicle
        assert np.array(frame["world_to_camera"]) @ to_world == pytest.approx(np.eye(4), abs=1e-9)
        assert shot.sensor.lens.parameters() == frame["lens"]


@pytest.mark.soak
def test_what_was_finished_before_a_kill_is_not_drawn_again_and_gives_the_same_bytes(tmp_path):
    stage = build(GarageConfig(**SETTINGS), tmp_path / "small" / "small.usdc").stage
    rig = rig_from_mapping({"name": "two", "sensors": [ROOF, COLUMN]})
    settings = {"along": "1:Stall_r00_c01_2", "every_m": 5.0, "pictures": KINDS}
    whole = record(stage, tmp_path / "whole", rig=rig, samples=2, slots=[SlotFormat.COCO], **settings)
    out, file = tmp_path / "drive", tmp_path / "rig.json"
    file.write_text(rig.model_dump_json())
    program = (
        "from garage2usd.recordings import record; from garage2usd.render import Picture; "
        "from garage2usd.sensors.rig.rig import Rig; "
        f"record({str(stage)!r}, {str(out)!r}, rig=Rig.model_validate_json(open({str(file)!r}).read()), "
        f"along={settings['along']!r}, every_m={settings['every_m']}, samples=2, "
        f"pictures=[Picture(kind) for kind in {[kind.value for kind in KINDS]!r}])"
    )
    process = subprocess.Popen([sys.executable, "-c", program], env=os.environ, stderr=subprocess.DEVNULL)
    finished = tmp_path / "drive.unfinished" / "finished"
    deadline = time.monotonic() + 300
    while len(list((finished / "seen").glob("[!.]*"))) < 2:
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert not out.exists()
    time.sleep(1.0)  # Blender ends with whom it draws for
    kept = {path: path.stat().st_mtime_ns for path in finished.rglob("[!.]*.png")}
    drawn = len(list((finished / "seen").glob("[!.]*")))
    with pytest.raises(ConfigError, match=r"drive\.unfinished is removed"):
        record(stage, out, rig=rig, samples=3, **settings)
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    said = []
    record(
        stage, out, rig=rig, samples=2, slots=[SlotFormat.COCO], progress=lambda *told: said.append(told), **settings
    )
    count = len(whole.recording.shots)
    first = next(told for told in said if told[0] == "render")
    assert first == ("render", 2 * count + drawn, 3 * count)
    assert drawn < count
    assert not finished.parent.exists()
    theirs, ours = (
        {path.relative_to(place): path.read_bytes() for path in place.rglob("*") if path.is_file()}
        for place in (out, whole.folder)
    )
    assert theirs == ours
    assert len(theirs) == len(KINDS) * count + 3 + 2 + 1
