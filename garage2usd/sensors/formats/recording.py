"""Recordings: the files of a rig's sensors along a drive, as input of the sequence formats."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.rig.mount import Sensor

__all__ = ["Recording", "Shot"]


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
