"""Surroundings of a recording in ROS 2: maps and agents, and the files that show a bag in RViz."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from string import Template
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import VERSION
from garage2usd.sensors.rig.sensors import Camera, Lidar, Sensor


class GridMap(NamedTuple):
    """An occupancy grid in the frame of the map.

    Attributes
    ----------
    topic
        Topic of the grid.
    cells
        0 free, 100 occupied, -1 unknown; int8, shape (rows, columns), the lowest row first.
    side_m
        Side of a cell.
    origin_m
        (x, y, z) of the lower left corner of the lower left cell.
    """

    topic: str
    cells: NDArray[np.int8]
    side_m: float
    origin_m: tuple[float, float, float]


class MarkedAgent(NamedTuple):
    """An agent at a time.

    Attributes
    ----------
    number, name, label
        Its lasting id and name, and its semantic class.
    size_m
        Length, width and height.
    agent_to_stage
        From x forward, y left, z up at the middle of its footprint to the stage's axes in metres; shape (4, 4).
    """

    number: int
    name: str
    label: str
    size_m: tuple[float, float, float]
    agent_to_stage: NDArray[np.float64]


_LAUNCH = Template('''\
"""Plays the bag beside it, and shows it in RViz; made by garage2usd $version.

    ros2 launch $name.launch.py rate:=0.5 rviz:=false
"""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

HERE = Path(__file__).resolve().parent


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("rate", default_value="1.0"),
            DeclareLaunchArgument("rviz", default_value="true"),
            ExecuteProcess(
                cmd=["ros2", "bag", "play", str(HERE / "$name"), "--clock", "--rate", LaunchConfiguration("rate")],
                output="screen",
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                arguments=["-d", str(HERE / "$name.rviz")],
                parameters=[{"use_sim_time": True}],
                condition=IfCondition(LaunchConfiguration("rviz")),
            ),
        ]
    )
''')
_VIEW = Template("""\
Panels:
  - Class: rviz_common/Displays
    Name: Displays
  - Class: rviz_common/Time
    Name: Time
Visualization Manager:
  Class: ""
  Displays:
$displays  Global Options:
    Background Color: 48; 48; 48
    Fixed Frame: map
    Frame Rate: 30
  Name: root
  Tools:
    - Class: rviz_default_plugins/MoveCamera
  Value: true
  Views:
    Current:
      Class: rviz_default_plugins/Orbit
      Name: Current View
      Distance: 25
      Pitch: 0.9
      Yaw: 3.9
      Target Frame: $target
  Window Geometry: {Height: 900, Width: 1400}
""")
_LATCHED = "Transient Local"


def write_views(folder: Path, sensors: Iterable[Sensor], maps: Sequence[GridMap], *, has_agents: bool) -> list[Path]:
    """Write a launch file that plays a bag, and RViz' configuration for its topics, beside the folder of the bag.

    Parameters
    ----------
    folder
        The bag.
    sensors
        Its sensors.
    maps
        Its maps.
    has_agents
        True if it has markers of agents.

    Returns
    -------
    list of Path
        The files.
    """
    sensors = list(sensors)
    displays = [_display("TF", "TF", None)]
    displays += [_display("Map", grid.topic.strip("/"), grid.topic, durability=_LATCHED) for grid in maps]
    displays += [_display("MarkerArray", "agents", "/agents")] if has_agents else []
    for sensor in sensors:
        name = sensor.name.replace("-", "_")
        if isinstance(sensor, Lidar):
            displays.append(_display("PointCloud2", name, f"/{name}/points", **{"Size (m)": "0.03"}))
        elif isinstance(sensor, Camera):
            displays.append(_display("Image", name, f"/{name}/image_raw/compressed"))
    target = "base_link" if any(sensor.mount == "vehicle" for sensor in sensors) else "map"
    texts = {
        "launch.py": _LAUNCH.substitute(version=VERSION, name=folder.name),
        "rviz": _VIEW.substitute(displays="".join(displays), target=target),
    }
    made = []
    for suffix, text in texts.items():
        made.append(folder.with_name(f"{folder.name}.{suffix}"))
        made[-1].write_text(text, encoding="utf-8", newline="\n")
    return made


def _display(kind: str, name: str, topic: str | None, *, durability: str = "Volatile", **more: str) -> str:
    lines = [f"- Class: rviz_default_plugins/{kind}", f"  Name: {name}", "  Enabled: true", "  Value: true"]
    lines += [f"  {key}: {value}" for key, value in more.items()]
    if topic is not None:
        key = "Namespaces" if kind == "MarkerArray" else None
        lines += [f"  {key}: {{}}"] if key else []
        lines += [
            "  Topic:",
            f"    Value: {topic}",
            "    Depth: 5",
            "    History Policy: Keep Last",
            "    Reliability Policy: Reliable",
            f"    Durability Policy: {durability}",
        ]
    return "".join(f"    {line}\n" for line in lines)
