"""ROS 2 bags of recordings: pictures with calibration, point clouds, and transforms of vehicle and sensors."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra
from garage2usd.sensors.formats.recording import Recording, Shot
from garage2usd.sensors.rays.lenses import KannalaBrandt, Pinhole
from garage2usd.sensors.rays.point_cloud import POINT_ROW, PointCloud, point_rows, read_npz
from garage2usd.sensors.rig.sensors import Camera, Sensor

with of_extra("a ROS 2 bag"):
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

_VERSION: Literal[8] = 8
"""Version of the metadata: the newest that ROS 2 Humble and Iron read; from 9 on QoS profiles are not text."""
_MAP, _VEHICLE = "map", "base_link"
_BEGINS_S = 946_684_800
"""First stamp, 1 January 2000; tf2 would take a stamp of 0 for the latest transform."""
_NANOSECONDS = 1_000_000_000
_KEPT = Qos(
    QosHistory.KEEP_LAST,
    1,
    QosReliability.RELIABLE,
    QosDurability.TRANSIENT_LOCAL,
    QosTime(0, 0),
    QosTime(0, 0),
    QosLiveliness.AUTOMATIC,
    QosTime(0, 0),
    avoid_ros_namespace_conventions=False,
)
"""Quality of service of /tf_static: late subscribers receive the last message too."""
_TYPE_OF = {"f": {4: 7}, "u": {1: 2, 2: 4, 4: 6}}
"""Data types of sensor_msgs/PointField, by NumPy kind and item size."""
_NO_MODEL: Mapping[str, Any] = {"distortion_model": "", "d": np.zeros(0), "k": np.zeros(9), "p": np.zeros(12)}


def write_ros_bag(recording: Recording, folder: Path, *, stage_to_map: NDArray[np.float64]) -> None:
    """Write a recording as a ROS 2 bag in MCAP.

    Parameters
    ----------
    recording
        Recording with pictures in PNG and points as ``npz``.
    folder
        Folder of the new bag.
    stage_to_map
        Transform from the stage's axes in metres to the frame ``map``, whose z is up; shape (4, 4).

    Raises
    ------
    ConfigError
        If the recording has no data for a bag, or two sensors have topics of the same name.

    Notes
    -----
    Each camera has ``/NAME/image_raw/compressed`` (PNG) and ``/NAME/camera_info``, each LiDAR ``/NAME/points``; ``/tf``
    holds the pose of ``base_link``, the middle of the rear axle on the ground, in the frame ``map``. ``/tf_static``
    holds the poses of the sensors on ``base_link``, or on the map if they are not mounted on the vehicle. Cameras have
    optical frames (REP 103). Stamps start at 1 January 2000. ROS has no model for WoodScape's polynomial: K is zero
    then, which marks an uncalibrated camera.
    """
    shots = [shot for shot in recording.shots if shot.files.keys() & {"colour", "npz"}]
    if not shots:
        raise ConfigError("rig", recording.rig, "a rig whose pictures or points were recorded, for a ROS 2 bag")
    with Writer(folder, version=_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
        bag = _Bag(writer, _names([shot.sensor for shot in shots]))
        bag.add_sensors(shots, stage_to_map)
        for _, at_once in groupby(shots, key=lambda shot: (shot.pose, shot.time_s)):
            group = list(at_once)
            bag.add_vehicle([shot for shot in group if shot.sensor.mount == "vehicle"], stage_to_map)
            for shot in group:
                bag.add_shot(shot)


def _names(sensors: Sequence[Sensor]) -> dict[str, str]:
    """Return the ROS name of each sensor, without hyphens."""
    found = {sensor.name: sensor.name.replace("-", "_") for sensor in sensors}
    for name, own in found.items():
        if list(found.values()).count(own) > 1:
            raise ConfigError("rig", name, f"sensors of other names, as {own} would be two topics")
    return found


class _Bag:
    """Messages of a ROS bag with their connections."""

    def __init__(self, writer: Writer, names: Mapping[str, str]) -> None:
        self._writer, self._names = writer, names
        self._store = get_typestore(Stores.ROS2_JAZZY)
        self._connections: dict[str, Any] = {}

    def add_sensors(self, shots: Sequence[Shot], stage_to_map: NDArray[np.float64]) -> None:
        """Add the static transforms of the sensors to the bag."""
        transforms = []
        for shot in {shot.sensor.name: shot for shot in shots}.values():
            place, parent = shot.sensor.sensor_to_vehicle, _VEHICLE
            if shot.sensor.mount != "vehicle":
                place, parent = stage_to_map @ shot.mount_to_world @ place, _MAP
            transforms.append(self._transform(shots[0], parent, self._names[shot.sensor.name], place))
        self._write("/tf_static", self._make("tf2_msgs/msg/TFMessage", transforms=transforms), shots[0], [_KEPT])

    def add_vehicle(self, shots: Sequence[Shot], stage_to_map: NDArray[np.float64]) -> None:
        """Add the vehicle's transforms to the bag."""
        if shots:
            place = self._transform(shots[0], _MAP, _VEHICLE, stage_to_map @ shots[0].mount_to_world)
            self._write("/tf", self._make("tf2_msgs/msg/TFMessage", transforms=[place]), shots[0])

    def add_shot(self, shot: Shot) -> None:
        """Add a sensor's shot to the bag."""
        name = self._names[shot.sensor.name]
        if isinstance(shot.sensor, Camera) and "colour" in shot.files:
            data = np.frombuffer(shot.files["colour"].read_bytes(), dtype=np.uint8)
            picture = self._make(
                "sensor_msgs/msg/CompressedImage", header=self._header(shot, name), format="png", data=data
            )
            self._write(f"/{name}/image_raw/compressed", picture, shot)
            self._write(f"/{name}/camera_info", self._calibration(shot, shot.sensor, name), shot)
        elif "npz" in shot.files:
            self._write(f"/{name}/points", self._points(shot, read_npz(shot.files["npz"]), name), shot)

    def _calibration(self, shot: Shot, camera: Camera, frame: str) -> object:
        width, height = camera.size_px
        region = self._make(
            "sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0, height=0, width=0, do_rectify=False
        )
        return self._make(
            "sensor_msgs/msg/CameraInfo",
            header=self._header(shot, frame),
            height=height,
            width=width,
            r=np.eye(3).ravel(),
            binning_x=0,
            binning_y=0,
            roi=region,
            **_model(camera),
        )

    def _points(self, shot: Shot, cloud: PointCloud, frame: str) -> object:
        rows = point_rows(cloud)
        fields = [
            self._make(
                "sensor_msgs/msg/PointField",
                name=name,
                offset=offset,
                datatype=_TYPE_OF[dtype.kind][dtype.itemsize],
                count=1,
            )
            for name, (dtype, offset, *_) in (POINT_ROW.fields or {}).items()
        ]
        return self._make(
            "sensor_msgs/msg/PointCloud2",
            header=self._header(shot, frame),
            height=1,
            width=len(rows),
            fields=fields,
            is_bigendian=False,
            point_step=rows.itemsize,
            row_step=rows.itemsize * len(rows),
            data=np.frombuffer(rows.tobytes(), dtype=np.uint8),
            is_dense=True,
        )

    def _transform(self, shot: Shot, parent: str, child: str, place: NDArray[np.float64]) -> object:
        move, turn = place[:3, 3].tolist(), Rotation.from_matrix(place[:3, :3]).as_quat(canonical=True).tolist()
        vector = self._make("geometry_msgs/msg/Vector3", **dict(zip("xyz", move, strict=True)))
        quaternion = self._make("geometry_msgs/msg/Quaternion", **dict(zip("xyzw", turn, strict=True)))
        transform = self._make("geometry_msgs/msg/Transform", translation=vector, rotation=quaternion)
        header = self._header(shot, parent)
        return self._make(
            "geometry_msgs/msg/TransformStamped", header=header, child_frame_id=child, transform=transform
        )

    def _header(self, shot: Shot, frame: str) -> object:
        seconds, nanoseconds = divmod(_stamp(shot), _NANOSECONDS)
        stamp = self._make("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanoseconds)
        return self._make("std_msgs/msg/Header", stamp=stamp, frame_id=frame)

    def _make(self, kind: str, **fields: Any) -> Any:  # noqa: ANN401 - a class that is made of its definition
        return self._store.types[kind](**fields)

    def _write(self, topic: str, message: Any, shot: Shot, qos: Sequence[Qos] = ()) -> None:  # noqa: ANN401 - as above
        kind = message.__msgtype__
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                topic, kind, typestore=self._store, offered_qos_profiles=qos
            )
        self._writer.write(self._connections[topic], _stamp(shot), self._store.serialize_cdr(message, kind))


def _stamp(shot: Shot) -> int:
    return _BEGINS_S * _NANOSECONDS + round(shot.time_s * _NANOSECONDS)


def _model(camera: Camera) -> Mapping[str, Any]:
    """Return the lens model of a camera as ROS parameters, with the origin in the first pixel's middle."""
    lens = camera.lens
    if isinstance(lens, Pinhole):
        name, coefficients = "plumb_bob", np.zeros(5)
    elif isinstance(lens, KannalaBrandt):
        name, coefficients = "equidistant", np.array(lens.coefficients)
    else:
        return _NO_MODEL
    (f_x, f_y), (c_x, c_y) = lens.focal_px, (centre - 0.5 for centre in lens.centre_px)
    matrix = np.array([[f_x, 0, c_x], [0, f_y, c_y], [0, 0, 1]], dtype=np.float64)
    projection = np.hstack([matrix, np.zeros((3, 1))])
    return {"distortion_model": name, "d": coefficients, "k": matrix.ravel(), "p": projection.ravel()}
