"""nuScenes: a recording as the tables of its schema, with boxes of objects and lidarseg classes of points."""

import json
import shutil
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from pxr import Usd

from garage2usd.common.errors import ConfigError
from garage2usd.objects import CAR_LABELS
from garage2usd.reading.labels import Labels
from garage2usd.sensors.formats.nuscenes_boxes import ATTRIBUTES, PARKED, VISIBILITY, TrafficAt, add_boxes, object_boxes
from garage2usd.sensors.formats.nuscenes_scenes import GlobalFrame, Location, Stretch, locations_of, stretches_of
from garage2usd.sensors.formats.nuscenes_tables import (
    BOXED,
    CATEGORIES,
    Record,
    Tables,
    categories_of_classes,
    place_fields,
    token_of,
)
from garage2usd.sensors.formats.recording import Recording, Shot
from garage2usd.sensors.rays.point_cloud import PointCloud, read_npz
from garage2usd.sensors.rays.ray_scene import RayScene
from garage2usd.sensors.rig.sensors import Lidar, PinholeCamera, Sensor

NUSCENES_VERSION = "v1.0-garage2usd"
"""Name of the folder of tables, which nuscenes-devkit calls the version."""

_MICROSECONDS = 1e6
_DATE = "2000-01-01"
"""Constant date of every recording, so that files are reproducible."""


def write_nuscenes(
    recording: Recording,
    folder: Path,
    *,
    stage: Usd.Stage,
    labels: Labels,
    scene: RayScene,
    traffic: TrafficAt | None = None,
) -> tuple[Path, ...]:
    """Write a recording in the nuScenes format.

    Parameters
    ----------
    recording
        Pictures of pinhole cameras and points of LiDARs, as ``npz``. Other cameras are omitted, since nuScenes supports
        pinhole lenses only.
    folder
        Existing folder in which ``samples``, ``lidarseg``, ``maps`` and the folder of tables are written.
    stage, labels, scene
        The recorded stage, its table of labels, and its solid surfaces.
    traffic
        Surfaces and boxes of agents at each pose, for a recording in traffic. Annotations then have a ``velocity`` in
        the global frame.

    Returns
    -------
    tuple of Path
        Paths written in the folder, the tables last.

    Raises
    ------
    ConfigError
        If no sensor's recording fits the tables, or a sensor is not mounted on the vehicle.

    Notes
    -----
    Each pose of the drive is a sample, all of whose data are key frames. In a garage of several levels each level is a
    location with a log and a map, and a stretch of the drive on one level is a scene; prev and next, and instances, do
    not cross scenes. The global frame is the stage with z up, translated to positive coordinates as in nuScenes' maps;
    the map's record holds the transform (``stage_to_global``). Objects of `nuscenes_classes.BOXED` have a box if a
    point was measured on them or any part is in line of sight of a sensor. Boxes have a margin of a centimetre against
    rounding. The visibility is the share of an object's directions in free line of sight, regardless of the sensor's
    field of view.
    """
    shots = [shot for shot in recording.shots if _is_told(shot)]
    if not shots:
        raise ConfigError("rig", recording.rig, "a rig with a LiDAR or a pinhole camera, for nuScenes")
    for shot in shots:
        if shot.sensor.mount != "vehicle":
            raise ConfigError("rig", shot.sensor.name, "sensors on the vehicle, for nuScenes")
    world = GlobalFrame(stage, scene)
    tables = Tables()
    channels = _channels([shot.sensor for shot in shots])
    stretches = stretches_of(shots, locations_of(stage, recording.stage), world)
    _add_words(tables)
    for location in dict.fromkeys(stretch.location for stretch in stretches):
        _add_location(tables, location, world, scene, labels, folder, recording)
    _add_sensors(tables, shots, channels)
    boxed, cars = (
        [number for number, each in labels.classes.items() if each.name in names] for names in (BOXED, CAR_LABELS)
    )
    boxes = object_boxes(stage, scene, boxed, parked_ids=cars)
    for stretch in stretches:
        _add_scene(tables, stretch, channels, recording)
        clouds = _add_data(tables, stretch, channels, folder, world, labels)
        add_boxes(tables, stretch, boxes, clouds, world, labels, scene, traffic)
    table_folder = folder / NUSCENES_VERSION
    table_folder.mkdir()
    for name, records in tables.records.items():
        if name == "lidarseg" and not records:
            continue  # nuscenes-devkit would look for their folder
        text = json.dumps(records, indent=0)
        (table_folder / f"{name}.json").write_text(text + "\n", encoding="utf-8", newline="\n")
    return (*(path for path in sorted(folder.iterdir()) if path != table_folder), table_folder)


def _is_told(shot: Shot) -> bool:
    if isinstance(shot.sensor, Lidar):
        return "npz" in shot.files
    return isinstance(shot.sensor, PinholeCamera) and "colour" in shot.files


def _channels(sensors: Sequence[Sensor]) -> dict[str, str]:
    """Name the nuScenes channel of each sensor: its modality and its name in capitals, as LIDAR_TOP."""
    found = {}
    for sensor in sensors:
        prefix = "LIDAR" if isinstance(sensor, Lidar) else "CAM"
        name = sensor.name.upper().replace("-", "_")
        found[sensor.name] = name if name.startswith(f"{prefix}_") else f"{prefix}_{name}"
    twice = [name for name, channel in found.items() if list(found.values()).count(channel) > 1]
    if twice:
        raise ConfigError("rig", twice[0], f"sensors of other names, as {found[twice[0]]} would be two channels")
    return found


def _add_words(tables: Tables) -> None:
    """Add the categories, visibilities and attributes, which are those of every recording."""
    for index, name in enumerate(CATEGORIES):
        tables.add("category", name, name=name, description="", index=index)
    for token, level, _ in VISIBILITY:
        tables.records["visibility"].append({"token": token, "level": level, "description": f"{level} % in sight"})
    tables.add("attribute", PARKED, name=PARKED, description="stands in a stall")
    for name in dict.fromkeys(ATTRIBUTES.values()):
        if name != PARKED:
            tables.add("attribute", name, name=name, description="")


def _add_location(
    tables: Tables,
    location: Location,
    world: GlobalFrame,
    scene: RayScene,
    labels: Labels,
    folder: Path,
    recording: Recording,
) -> None:
    """Add a location's log and map: a mask of the ground for driving and parking, without columns and walls."""
    log = tables.add(
        "log",
        location.key,
        logfile=recording.stage.name,
        vehicle=recording.rig,
        date_captured=_DATE,
        location=location.name,
    )
    path = folder / "maps" / f"{location.name}.png"
    path.parent.mkdir(exist_ok=True)
    Image.fromarray(world.mask(scene, location, labels)).save(path)
    tables.add(
        "map",
        location.key,
        log_tokens=[log],
        category="semantic_prior",
        filename=path.relative_to(folder).as_posix(),
        stage_to_global=world.matrix.tolist(),
    )


def _add_sensors(tables: Tables, shots: Sequence[Shot], channels: Mapping[str, str]) -> None:
    for sensor in {shot.sensor.name: shot.sensor for shot in shots}.values():
        intrinsic: list[list[float]] = []
        if isinstance(sensor, PinholeCamera):
            lens = sensor.lens
            # the origin of nuScenes is the middle of the first pixel
            (f_x, f_y), (c_x, c_y) = lens.focal_px, (centre - 0.5 for centre in lens.centre_px)
            intrinsic = [[f_x, 0.0, c_x], [0.0, f_y, c_y], [0.0, 0.0, 1.0]]
        modality = "lidar" if isinstance(sensor, Lidar) else "camera"
        token = tables.add("sensor", sensor.name, channel=channels[sensor.name], modality=modality)
        tables.add(
            "calibrated_sensor",
            sensor.name,
            sensor_token=token,
            **place_fields(sensor.sensor_to_vehicle),
            camera_intrinsic=intrinsic,
        )


def _add_scene(tables: Tables, stretch: Stretch, channels: Mapping[str, str], recording: Recording) -> None:
    """Add a scene and its samples."""
    by_pose, location = stretch.by_pose, stretch.location
    tokens = [token_of("sample", shots[0].pose) for shots in by_pose]
    scene = tables.add(
        "scene",
        stretch.key(recording.stage.name),
        log_token=token_of("log", location.key),
        nbr_samples=len(tokens),
        first_sample_token=tokens[0],
        last_sample_token=tokens[-1],
        name=stretch.name,
        description=f"{recording.rig} with {', '.join(channels.values())} in {location.key}",
    )
    for shots, before, after in zip(by_pose, ["", *tokens], [*tokens[1:], ""], strict=False):
        stamp = _microseconds(shots[0])
        tables.add("sample", str(shots[0].pose), timestamp=stamp, prev=before, next=after, scene_token=scene)


def _microseconds(shot: Shot) -> int:
    return round(shot.time_s * _MICROSECONDS)


def _add_data(
    tables: Tables,
    stretch: Stretch,
    channels: Mapping[str, str],
    folder: Path,
    world: GlobalFrame,
    labels: Labels,
) -> dict[int, list[PointCloud]]:
    """Copy the recorded sensor data of a scene, and return the point clouds of each pose."""
    lidarseg = categories_of_classes(labels)
    clouds: dict[int, list[PointCloud]] = defaultdict(list)
    last: dict[str, Record] = {}
    for shot in (shot for shots in stretch.by_pose for shot in shots):
        channel, key = channels[shot.sensor.name], f"{shot.pose} {shot.sensor.name}"
        token = token_of("sample_data", key)
        place = folder / "samples" / channel
        place.mkdir(parents=True, exist_ok=True)
        width, height = 0, 0
        if isinstance(shot.sensor, PinholeCamera):
            width, height = shot.sensor.size_px
            picture = shot.files["colour"]
            file, kind = place / f"{shot.name}{picture.suffix}", picture.suffix.removeprefix(".")
            shutil.copyfile(picture, file)
        else:
            file, kind = place / f"{shot.name}.pcd.bin", "pcd"
            cloud = read_npz(shot.files["npz"])
            clouds[shot.pose].append(cloud)
            _write_points(cloud, file)
            classes = folder / "lidarseg" / NUSCENES_VERSION / f"{token}_lidarseg.bin"
            classes.parent.mkdir(parents=True, exist_ok=True)
            classes.write_bytes(lidarseg[cloud.class_id].tobytes())
            tables.records["lidarseg"].append(
                {"token": token, "sample_data_token": token, "filename": classes.relative_to(folder).as_posix()}
            )
        ego = tables.add(
            "ego_pose", key, timestamp=_microseconds(shot), **place_fields(world.matrix @ shot.mount_to_world)
        )
        before = last.get(shot.sensor.name)
        tables.add(
            "sample_data",
            key,
            sample_token=token_of("sample", shot.pose),
            ego_pose_token=ego,
            calibrated_sensor_token=token_of("calibrated_sensor", shot.sensor.name),
            timestamp=_microseconds(shot),
            fileformat=kind,
            is_key_frame=True,
            height=height,
            width=width,
            filename=file.relative_to(folder).as_posix(),
            prev=before["token"] if before else "",
            next="",
        )
        if before:
            before["next"] = token
        last[shot.sensor.name] = tables.records["sample_data"][-1]
    return clouds


def _write_points(cloud: PointCloud, path: Path) -> None:
    """Write a point cloud in nuScenes' binary format: rows of x, y, z, intensity up to 255, and ring."""
    rows = np.column_stack([cloud.points_m, cloud.intensity * 255, cloud.ring])
    path.write_bytes(rows.astype("<f4").tobytes())
