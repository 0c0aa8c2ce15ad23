"""Recordings in sequence formats: nuScenes tables and ROS 2 bags."""

import shutil
from collections.abc import Collection
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from garage2usd.common.errors import ConfigError, StageError
from garage2usd.common.progress import Announce
from garage2usd.config.outputs import GridConfig
from garage2usd.maps.occupancy import occupancy
from garage2usd.render.pictures import Picture
from garage2usd.sensors.formats.recording import Recording
from garage2usd.sensors.formats.ros_scene import GridMap, write_views
from garage2usd.sensors.rays.point_cloud import CloudFormat
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera
from garage2usd.sensors.rig.poses import MAP_TO_Y_UP, y_up_to_stage
from garage2usd.sensors.rig.rig import Rig
from garage2usd.sensors.rig.sensors import PinholeCamera

if TYPE_CHECKING:
    from garage2usd.recordings.sweeps import Sweeps


class Sequence(StrEnum):
    """Sequence formats of a recording."""

    NUSCENES = "nuscenes"
    """Tables of nuScenes."""
    ROS2 = "ros2"
    """A ROS 2 bag."""


def check_sequences(
    asked: Collection[Sequence], rig: Rig, pictures: Collection[Picture], points: Collection[CloudFormat]
) -> None:
    """Check before the work that a recording can be written in sequence formats.

    Raises
    ------
    ConfigError
        If the rig or its recorded data do not fit the formats.
    """
    if not asked:
        return
    if rig.lidars and CloudFormat.NPZ not in points:
        raise ConfigError("points", ", ".join(points), "npz among them, of which nuScenes and ROS 2 are made")
    has_colour = Picture.COLOUR in pictures
    if rig.cameras and not rig.lidars and not has_colour:
        raise ConfigError("only", ", ".join(pictures), "colour among them, of which nuScenes and ROS 2 are made")
    if Sequence.NUSCENES in asked:
        if not rig.lidars and not any(isinstance(camera, PinholeCamera) for camera in rig.cameras):
            raise ConfigError("rig", rig.name, "a rig with a LiDAR or a pinhole camera, for nuScenes")
        away = [sensor.name for sensor in rig.recorded if sensor.mount != "vehicle"]
        around = [camera.name for camera in rig.cameras if isinstance(camera, AroundViewCamera)]
        if around:
            raise ConfigError("rig", around[0], "a rig that records no around view, which nuScenes has no sensor for")
        if away:
            raise ConfigError("rig", away[0], "sensors on the vehicle, for nuScenes")


def write_sequence(
    kind: Sequence, recording: Recording, folder: Path, sweeps: "Sweeps", work: Path, announce: Announce
) -> list[Path]:
    """Write a recording in a sequence format: nuScenes tables or a ROS 2 bag.

    Parameters
    ----------
    kind
        The format, which also names the folder.
    recording
        The recording.
    folder
        Parent of that folder, which is replaced if it exists.
    sweeps
        Sweeps of the LiDARs, and the surfaces that they hit.
    work
        Folder for temporary files.
    announce
        Receives a line on what is left out.

    Returns
    -------
    list of Path
        The folder, and files beside it.
    """
    place = folder / kind
    shutil.rmtree(place, ignore_errors=True)
    if kind is Sequence.NUSCENES:
        from garage2usd.sensors.formats.nuscenes import write_nuscenes  # noqa: PLC0415 - pictures do not need its extra

        place.mkdir(parents=True)
        write_nuscenes(
            recording,
            place,
            stage=sweeps.stage,
            labels=sweeps.labels,
            scene=sweeps.solids,
            traffic=sweeps.traffic_at(work),
        )
        return [place]
    from garage2usd.sensors.formats.ros_bag import write_ros_bag  # noqa: PLC0415 - as above

    maps, agents = _maps(sweeps, announce), sweeps.marked_agents()
    stage_to_map = np.linalg.inv(y_up_to_stage(sweeps.stage) @ MAP_TO_Y_UP)
    write_ros_bag(recording, place, stage_to_map=stage_to_map, maps=maps, agents=agents)
    sensors = {shot.sensor.name: shot.sensor for shot in recording.shots}
    return [place, *write_views(place, sensors.values(), maps, has_agents=bool(agents))]


def _maps(sweeps: "Sweeps", announce: Announce) -> list[GridMap]:
    """Return the occupancy grid of each level, without the cars that are gone or move."""
    found, grid, without = [], GridConfig(), {*sweeps.left_out}
    for level in sweeps.garage.levels:
        things = tuple(thing for thing in level.things if level.place.path_in_whole(thing.name) not in without)
        try:
            cells, (x, y) = occupancy(replace(level, things=things), grid)
        except (ConfigError, StageError) as error:
            announce(f"ros2: {level.place.after('map', joint='_')} is left out: {error}")
            continue
        topic = f"/{level.place.after('map', joint='_')}"
        found.append(GridMap(topic, cells, grid.resolution_m, (x, y, level.place.floor_m)))
    return found
