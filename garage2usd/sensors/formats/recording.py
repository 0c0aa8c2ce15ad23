"""Recordings as input of the sequence formats: the files of a rig's sensors along a drive, and their calibration."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.rays.lenses import KannalaBrandt, Lens, Pinhole, WoodScape
from garage2usd.sensors.rig.sensors import Camera, Sensor

_FROM_FIRST_MIDDLE = 0.5
"""Offset between pixel origins: OpenCV, ROS and WoodScape use the first pixel's middle, garage2usd its corner."""


@dataclass(frozen=True, eq=False)
class Shot:
    """The files of one sensor at one time of a recording.

    Attributes
    ----------
    name
        Base name of the files.
    sensor
        The sensor of the rig.
    pose
        Index of the pose on the drive; all shots of a pose share time and vehicle.
    time_s
        Time since the start of the drive.
    mount_to_world
        Transform from the axes of the sensor's mount (x forward, y left, z up) to the stage's, in metres, for column
        vectors; float64, shape (4, 4).
    files
        Files by kind: ``colour`` for a picture, ``pcd``, ``bin`` and ``npz`` for points.
    """

    name: str
    sensor: Sensor
    pose: int
    time_s: float
    mount_to_world: NDArray[np.float64]
    files: Mapping[str, Path]


@dataclass(frozen=True, eq=False)
class Recording:
    """A recording of a drive by a rig.

    Attributes
    ----------
    rig
        Name of the rig.
    stage
        File of the stage.
    shots
        Shots in order of time.
    """

    rig: str
    stage: Path
    shots: tuple[Shot, ...]


def write_calibration(camera: Camera, folder: Path) -> Path:
    """Write a camera's calibration file, named after the camera: ``.json`` for WoodScape, ``.yaml`` for ROS.

    Lenses of the WoodScape model are written as JSON, all others as YAML.
    """
    lens = camera.lens
    if isinstance(lens, WoodScape):
        path = folder / f"{camera.name}.json"
        path.write_text(
            json.dumps(woodscape_calibration(camera, lens), indent=4) + "\n", encoding="utf-8", newline="\n"
        )
    else:
        path = folder / f"{camera.name}.yaml"
        path.write_text(camera_info(camera.name, lens), encoding="utf-8", newline="\n")
    return path


def woodscape_calibration(camera: Camera, lens: WoodScape) -> dict[str, object]:
    """Return the contents of a WoodScape calibration file: camera to vehicle (ISO 8855), rear axle on the ground.

    For a camera mounted on a column or in the world, the extrinsics lead to the frame of the mount.
    """
    from scipy.spatial.transform import Rotation  # noqa: PLC0415 - slow to import, and not always needed

    place = camera.sensor_to_vehicle
    (width, height), (across, down) = lens.size_px, lens.centre_px
    k1, k2, k3, k4 = lens.coefficients_px
    return {
        "extrinsic": {
            "quaternion": Rotation.from_matrix(place[:3, :3]).as_quat(canonical=True).tolist(),
            "translation": place[:3, 3].tolist(),
        },
        "intrinsic": {
            "aspect_ratio": lens.aspect_ratio,
            "cx_offset": across - width / 2,
            "cy_offset": down - height / 2,
            "height": float(height),
            "k1": k1,
            "k2": k2,
            "k3": k3,
            "k4": k4,
            "model": "radial_poly",
            "poly_order": 4,
            "width": float(width),
        },
        "name": camera.name,
    }


def camera_info(name: str, lens: Lens) -> str:
    """Format a camera's ROS calibration file, as camera_info_manager reads it.

    Parameters
    ----------
    name
        Name of the camera.
    lens
        Lens of the camera: a pinhole (``plumb_bob`` without distortion) or Kannala and Brandt's (``equidistant``).

    Raises
    ------
    TypeError
        For other lenses.
    """
    if isinstance(lens, Pinhole):
        model, distortion = "plumb_bob", [0.0] * 5
    elif isinstance(lens, KannalaBrandt):
        model, distortion = "equidistant", list(lens.coefficients)
    else:
        raise TypeError(f"{type(lens).__name__} is no model of ROS")
    (width, height), (focal_x, focal_y) = lens.size_px, lens.focal_px
    across, down = (centre - _FROM_FIRST_MIDDLE for centre in lens.centre_px)
    matrices: list[tuple[str, int, list[float]]] = [
        ("camera_matrix", 3, [focal_x, 0.0, across, 0.0, focal_y, down, 0.0, 0.0, 1.0]),
        ("distortion_coefficients", 1, distortion),
        ("rectification_matrix", 3, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
        ("projection_matrix", 3, [focal_x, 0.0, across, 0.0, 0.0, focal_y, down, 0.0, 0.0, 0.0, 1.0, 0.0]),
    ]
    lines = [f"image_width: {width}", f"image_height: {height}", f"camera_name: {name}"]
    for key, rows, data in matrices:
        if key == "distortion_coefficients":
            lines.append(f"distortion_model: {model}")
        lines += [f"{key}:", f"  rows: {rows}", f"  cols: {len(data) // rows}", f"  data: {list(map(float, data))}"]
    return "\n".join(lines) + "\n"
