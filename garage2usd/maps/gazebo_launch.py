"""Launch file of ROS 2 for a world of Gazebo: the simulator, its clock, the map of a level, and a robot."""

from collections.abc import Mapping
from string import Template

from garage2usd.common.package import VERSION

_TEXT = Template('''\
"""Starts Gazebo with $world, its clock in ROS 2, and nav2's map server; made by garage2usd $version.

    ros2 launch $launch
    ros2 launch $launch level:=NAME headless:=true robot:=robot.sdf spawn:=entrance_1

level: the level whose map is served: $names
spawn: the frame of the world at which the robot begins; it stands on the floor there
robot: a model (SDF or URDF); none without it
"""

import shlex
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import Node

HERE = Path(__file__).resolve().parent
WORLD = $file
MAPS = {  # by level
$maps}
SPAWNS = {  # x, y, z in metres and yaw in radians, by frame of the world
$spawns}


def started(context):
    given = context.launch_configurations
    if given["level"] not in MAPS:
        raise RuntimeError(f"level: got {given['level']!r}; allowed: {', '.join(MAPS)}")
    if given["spawn"] not in SPAWNS:
        raise RuntimeError(f"spawn: got {given['spawn']!r}; allowed: a frame of {WORLD}, such as {next(iter(SPAWNS))}")
    arguments = ["-r", *(["-s"] if given["headless"] == "true" else []), str(HERE / WORLD)]
    simulator = Path(get_package_share_directory("ros_gz_sim")) / "launch" / "gz_sim.launch.py"
    yield IncludeLaunchDescription(
        PythonLaunchDescriptionSource(str(simulator)), launch_arguments={"gz_args": shlex.join(arguments)}.items()
    )
    yield Node(
        package="ros_gz_bridge",
        executable="parameter_bridge",
        arguments=["/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"],
    )
    own = {"use_sim_time": True}
    yield Node(
        package="nav2_map_server",
        executable="map_server",
        parameters=[own | {"yaml_filename": str(HERE / MAPS[given["level"]]), "frame_id": "map"}],
    )
    yield Node(
        package="nav2_lifecycle_manager",
        executable="lifecycle_manager",
        name="lifecycle_manager_map",
        parameters=[own | {"autostart": True, "node_names": ["map_server"]}],
    )
    if given["robot"]:
        place = zip(("-x", "-y", "-z", "-Y"), map(str, SPAWNS[given["spawn"]]))
        where = [part for pair in place for part in pair]
        yield Node(
            package="ros_gz_sim",
            executable="create",
            arguments=["-world", "$world_name", "-file", given["robot"], "-name", "robot", *where],
        )


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("level", default_value=next(iter(MAPS))),
            DeclareLaunchArgument("spawn", default_value=next(iter(SPAWNS), "")),
            DeclareLaunchArgument("robot", default_value=""),
            DeclareLaunchArgument("headless", default_value="false"),
            OpaqueFunction(function=lambda context: list(started(context))),
        ]
    )
''')


def launch_text(file: str, world: str, maps: Mapping[str, str], spawns: Mapping[str, tuple[float, ...]]) -> str:
    """Return the text of a launch file.

    Parameters
    ----------
    file
        Name of the SDF file beside it.
    world
        Name of the world in it.
    maps
        Names of the occupancy grids beside it, by level.
    spawns
        x, y, z and yaw of the frames at which a robot may begin, by name.
    """
    said = file.replace("\\", "\\\\").replace('"', '\\"')
    return _TEXT.substitute(
        world=said,
        launch=f"{said.rpartition('.')[0]}.launch.py",
        version=VERSION,
        file=repr(file),
        world_name=world,
        names=", ".join(maps).replace("\\", "\\\\").replace('"', '\\"'),
        maps="".join(f"    {level!r}: {name!r},\n" for level, name in maps.items()),
        spawns="".join(f"    {name!r}: {place!r},\n" for name, place in spawns.items()),
    )
