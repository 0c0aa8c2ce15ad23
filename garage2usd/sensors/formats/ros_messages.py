"""Messages of ROS 2: headers, poses, transforms, maps and markers of a recording."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from garage2usd.common.package import of_extra
from garage2usd.sensors.formats.ros_scene import GridMap, MarkedAgent

with of_extra("a ROS 2 bag"):
    from rosbags.typesys import Stores, get_typestore

MAP = "map"
"""Frame of the map."""
_NANOSECONDS = 1_000_000_000
_CUBE, _TEXT, _ADD, _DELETE = 1, 9, 0, 2
"""Numbers of visualization_msgs/Marker."""
_RGB = {"person": (0.95, 0.6, 0.1), "shopping_trolley": (0.6, 0.6, 0.6)}
_CAR_RGB, _OPACITY, _NAME_M = (0.15, 0.45, 0.9), 0.8, 0.4


class Messages:
    """Maker of messages by their definitions in ROS 2 Jazzy, which equal those of all versions from Humble on."""

    def __init__(self) -> None:
        self.store = get_typestore(Stores.ROS2_JAZZY)

    def make(self, kind: str, **fields: Any) -> Any:  # noqa: ANN401 - a class that is made of its definition
        """Return a message of a type."""
        return self.store.types[kind](**fields)

    def header(self, stamp_ns: int, frame: str) -> Any:  # noqa: ANN401 - as above
        """Return a header."""
        seconds, nanoseconds = divmod(stamp_ns, _NANOSECONDS)
        stamp = self.make("builtin_interfaces/msg/Time", sec=seconds, nanosec=nanoseconds)
        return self.make("std_msgs/msg/Header", stamp=stamp, frame_id=frame)

    def transform(self, stamp_ns: int, parent: str, child: str, place: NDArray[np.float64]) -> object:
        """Return the transform of a frame in its parent; `place` has shape (4, 4)."""
        move = self._vector("Vector3", place[:3, 3])
        transform = self.make("geometry_msgs/msg/Transform", translation=move, rotation=self._pose(place).orientation)
        header = self.header(stamp_ns, parent)
        return self.make("geometry_msgs/msg/TransformStamped", header=header, child_frame_id=child, transform=transform)

    def transforms(self, transforms: list[object]) -> object:
        """Return a message of transforms."""
        return self.make("tf2_msgs/msg/TFMessage", transforms=transforms)

    def occupancy_grid(self, stamp_ns: int, grid: GridMap) -> object:
        """Return an occupancy grid."""
        rows, columns = grid.cells.shape
        place = np.eye(4)
        place[:3, 3] = grid.origin_m
        header = self.header(stamp_ns, MAP)
        about = self.make(
            "nav_msgs/msg/MapMetaData",
            map_load_time=header.stamp,
            resolution=grid.side_m,
            width=columns,
            height=rows,
            origin=self._pose(place),
        )
        return self.make("nav_msgs/msg/OccupancyGrid", header=header, info=about, data=grid.cells.ravel())

    def markers(
        self, stamp_ns: int, agents: Iterable[tuple[MarkedAgent, NDArray[np.float64]]], gone: Iterable[tuple[int, str]]
    ) -> object:
        """Return a box and a name for each agent with its place in the map, and the removal of those that are gone.

        Parameters
        ----------
        stamp_ns
            Time of the message.
        agents
            The agents, with their transforms to the map.
        gone
            Numbers and classes of agents that were there before.
        """
        markers = []
        for agent, place in agents:
            height_m = agent.size_m[2]
            for kind, up_m, size_m in (
                (_CUBE, height_m / 2, agent.size_m),
                (_TEXT, height_m + _NAME_M, (0.0, 0.0, _NAME_M)),
            ):
                lifted = place.copy()
                lifted[:3, 3] += place[:3, 2] * up_m
                markers.append(self._marker(stamp_ns, agent, kind, lifted, size_m))
        for number, label in gone:
            left = MarkedAgent(number, "", label, (0.0, 0.0, 0.0), np.eye(4))
            markers += [
                self._marker(stamp_ns, left, kind, np.eye(4), left.size_m, action=_DELETE) for kind in (_CUBE, _TEXT)
            ]
        return self.make("visualization_msgs/msg/MarkerArray", markers=markers)

    def _marker(
        self,
        stamp_ns: int,
        agent: MarkedAgent,
        kind: int,
        place: NDArray[np.float64],
        size_m: tuple[float, float, float],
        *,
        action: int = _ADD,
    ) -> object:
        red, green, blue = _RGB.get(agent.label, _CAR_RGB) if kind == _CUBE else (1.0, 1.0, 1.0)
        return self.make(
            "visualization_msgs/msg/Marker",
            header=self.header(stamp_ns, MAP),
            ns=agent.label if kind == _CUBE else "names",
            id=agent.number,
            type=kind,
            action=action,
            pose=self._pose(place),
            scale=self._vector("Vector3", size_m),
            color=self.make("std_msgs/msg/ColorRGBA", r=red, g=green, b=blue, a=_OPACITY),
            lifetime=self.make("builtin_interfaces/msg/Duration", sec=0, nanosec=0),
            frame_locked=False,
            points=[],
            colors=[],
            texture_resource="",
            texture=self.make(
                "sensor_msgs/msg/CompressedImage",
                header=self.header(stamp_ns, ""),
                format="",
                data=np.zeros(0, np.uint8),
            ),
            uv_coordinates=[],
            text=agent.name if kind == _TEXT else "",
            mesh_resource="",
            mesh_file=self.make("visualization_msgs/msg/MeshFile", filename="", data=np.zeros(0, np.uint8)),
            mesh_use_embedded_materials=False,
        )

    def _vector(self, kind: str, values: Iterable[float]) -> object:
        return self.make(f"geometry_msgs/msg/{kind}", **dict(zip("xyzw", map(float, values), strict=False)))

    def _pose(self, place: NDArray[np.float64]) -> Any:  # noqa: ANN401 - as above
        turn = Rotation.from_matrix(place[:3, :3]).as_quat(canonical=True)
        return self.make(
            "geometry_msgs/msg/Pose",
            position=self._vector("Point", place[:3, 3]),
            orientation=self._vector("Quaternion", turn),
        )
