"""ROS 2 bags of recordings: pictures, calibrations, points, transforms, maps, and markers of agents."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import of_extra
from garage2usd.sensors.formats.recording import Recording, Shot
from garage2usd.sensors.formats.ros_messages import MAP, Messages
from garage2usd.sensors.formats.ros_scene import GridMap, MarkedAgent
from garage2usd.sensors.rays.lenses import KannalaBrandt, Pinhole
from garage2usd.sensors.rays.point_cloud import POINT_ROW, PointCloud, point_rows, read_npz
from garage2usd.sensors.rig.sensors import Camera, Sensor

with of_extra("a ROS 2 bag"):
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
    from rosbags.rosbag2 import StoragePlugin, Writer

_VERSION: Literal[8] = 8
"""Version of the metadata: the newest that ROS 2 Humble and Iron read; from 9 on QoS profiles are not text."""
_VEHICLE = "base_link"
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
"""Quality of service of /tf_static and maps: late subscribers receive the last message too."""
_TYPE_OF = {"f": {4: 7}, "u": {1: 2, 2: 4, 4: 6}}
"""Data types of sensor_msgs/PointField, by NumPy kind and item size."""
_NO_MODEL: Mapping[str, Any] = {"distortion_model": "", "d": np.zeros(0), "k": np.zeros(9), "p": np.zeros(12)}


_TIMED_ROW = np.dtype([*((name, POINT_ROW[name]) for name in POINT_ROW.names or ()), ("time", "<f4")])
"""Record of a point in a bag: that of all files, and its time after that of the message in seconds."""


def write_ros_bag(
    recording: Recording,
    folder: Path,
    *,
    stage_to_map: NDArray[np.float64],
    maps: Sequence[GridMap] = (),
    agents: Sequence[Sequence[MarkedAgent]] = (),
) -> None:
    """Write a recording as a ROS 2 bag in MCAP.

    Parameters
    ----------
    recording
        Recording with pictures in PNG and points as ``npz``.
    folder
        Folder of the new bag.
    stage_to_map
        Transform from the stage's axes in metres to the frame ``map``, whose z is up; shape (4, 4).
    maps
        Occupancy grids, each for a topic of its own.
    agents
        Agents around the vehicle at each pose.

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
    then, which marks an uncalibrated camera. Fields of points are those of `POINT_ROW` and ``time``, in seconds after
    the message's stamp. Maps are latched. ``/agents`` has a box and a name for each agent, whose id it keeps as
    long as it is there, and ``/tf`` its pose, by the middle of its footprint.
    """
    shots = [shot for shot in recording.shots if shot.files.keys() & {"colour", "npz"}]
    if not shots:
        raise ConfigError("rig", recording.rig, "a rig whose pictures or points were recorded, for a ROS 2 bag")
    with Writer(folder, version=_VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
        bag = _Bag(writer, _names([shot.sensor for shot in shots]))
        bag.add_sensors(shots, stage_to_map)
        for grid in maps:
            bag.add_map(grid, shots[0])
        for (pose, _), at_once in groupby(shots, key=lambda shot: (shot.pose, shot.time_s)):
            group = list(at_once)
            if agents:
                bag.add_agents(agents[pose], group[0], stage_to_map)
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
        self._messages = Messages()
        self._connections: dict[str, Any] = {}
        self._shown: dict[int, str] = {}

    def add_sensors(self, shots: Sequence[Shot], stage_to_map: NDArray[np.float64]) -> None:
        """Add the static transforms of the sensors to the bag."""
        transforms = []
        for shot in {shot.sensor.name: shot for shot in shots}.values():
            place, parent = shot.sensor.sensor_to_vehicle, _VEHICLE
            if shot.sensor.mount != "vehicle":
                place, parent = stage_to_map @ shot.mount_to_world @ place, MAP
            transforms.append(self._messages.transform(_stamp(shots[0]), parent, self._names[shot.sensor.name], place))
        self._write("/tf_static", self._messages.transforms(transforms), shots[0], [_KEPT])

    def add_vehicle(self, shots: Sequence[Shot], stage_to_map: NDArray[np.float64]) -> None:
        """Add the vehicle's transforms to the bag."""
        if shots:
            place = self._messages.transform(_stamp(shots[0]), MAP, _VEHICLE, stage_to_map @ shots[0].mount_to_world)
            self._write("/tf", self._messages.transforms([place]), shots[0])

    def add_map(self, grid: GridMap, first: Shot) -> None:
        """Add an occupancy grid to the bag, with the stamp of a shot."""
        self._write(grid.topic, self._messages.occupancy_grid(_stamp(first), grid), first, [_KEPT])

    def add_agents(self, agents: Sequence[MarkedAgent], shot: Shot, stage_to_map: NDArray[np.float64]) -> None:
        """Add the poses of agents to the bag, and their markers; those of agents that have left are removed."""
        placed = [(agent, stage_to_map @ agent.agent_to_stage) for agent in agents]
        there = {agent.number: agent.label for agent in agents}
        gone = [pair for pair in self._shown.items() if pair[0] not in there]
        self._shown = there
        self._write("/agents", self._messages.markers(_stamp(shot), placed, gone), shot)
        if placed:
            places = [self._messages.transform(_stamp(shot), MAP, agent.name, place) for agent, place in placed]
            self._write("/tf", self._messages.transforms(places), shot)

    def add_shot(self, shot: Shot) -> None:
        """Add a sensor's shot to the bag."""
        name = self._names[shot.sensor.name]
        if isinstance(shot.sensor, Camera) and "colour" in shot.files:
            data = np.frombuffer(shot.files["colour"].read_bytes(), dtype=np.uint8)
            picture = self._messages.make(
                "sensor_msgs/msg/CompressedImage",
                header=self._messages.header(_stamp(shot), name),
                format="png",
                data=data,
            )
            self._write(f"/{name}/image_raw/compressed", picture, shot)
            self._write(f"/{name}/camera_info", self._calibration(shot, shot.sensor, name), shot)
        elif "npz" in shot.files:
            self._write(f"/{name}/points", self._points(shot, read_npz(shot.files["npz"]), name), shot)

    def _calibration(self, shot: Shot, camera: Camera, frame: str) -> object:
        width, height = camera.size_px
        region = self._messages.make(
            "sensor_msgs/msg/RegionOfInterest", x_offset=0, y_offset=0, height=0, width=0, do_rectify=False
        )
        return self._messages.make(
            "sensor_msgs/msg/CameraInfo",
            header=self._messages.header(_stamp(shot), frame),
            height=height,
            width=width,
            r=np.eye(3).ravel(),
            binning_x=0,
            binning_y=0,
            roi=region,
            **_model(camera),
        )

    def _points(self, shot: Shot, cloud: PointCloud, frame: str) -> object:
        rows = np.zeros(len(cloud), dtype=_TIMED_ROW)
        plain = point_rows(cloud)
        for name in plain.dtype.names or ():
            rows[name] = plain[name]
        if cloud.time_s is not None:
            rows["time"] = cloud.time_s
        fields = [
            self._messages.make(
                "sensor_msgs/msg/PointField",
                name=name,
                offset=offset,
                datatype=_TYPE_OF[dtype.kind][dtype.itemsize],
                count=1,
            )
            for name, (dtype, offset, *_) in (_TIMED_ROW.fields or {}).items()
        ]
        return self._messages.make(
            "sensor_msgs/msg/PointCloud2",
            header=self._messages.header(_stamp(shot), frame),
            height=1,
            width=len(rows),
            fields=fields,
            is_bigendian=False,
            point_step=rows.itemsize,
            row_step=rows.itemsize * len(rows),
            data=np.frombuffer(rows.tobytes(), dtype=np.uint8),
            is_dense=True,
        )

    def _write(self, topic: str, message: Any, shot: Shot, qos: Sequence[Qos] = ()) -> None:  # noqa: ANN401 - as above
        kind = message.__msgtype__
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                topic, kind, typestore=self._messages.store, offered_qos_profiles=qos
            )
        self._writer.write(self._connections[topic], _stamp(shot), self._messages.store.serialize_cdr(message, kind))


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
