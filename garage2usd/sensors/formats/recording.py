"""What the sensors of a rig recorded on a drive, as the formats of sequences need it."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.sensors.rig.mount import Sensor

__all__ = ["Recording", "Shot"]


@dataclass(frozen=True, eq=False)
class Shot:
    """What one sensor recorded at one time.

    Attributes
    ----------
    name
        Of its files.
    sensor
        The sensor of the rig.
    pose
        Number of the place on the drive; all shots of a place have the same time and the same vehicle.
    time_s
        Since the drive began.
    mount_to_world
        From the axes of what the sensor is mounted on (x forward, y left, z up) to the stage's, in metres, for column
        vectors; float64, shape (4, 4).
    files
        The files by their kind: ``colour`` for a picture, ``pcd``, ``bin`` and ``npz`` for points.
    """

    name: str
    sensor: Sensor
    pose: int
    time_s: float
    mount_to_world: NDArray[np.float64]
    files: Mapping[str, Path]


@dataclass(frozen=True, eq=False)
class Recording:
    """A drive.

    Attributes
    ----------
    rig
        Name of the rig.
    stage
        File of the stage.
    shots
        In the order of their times.
    """

    rig: str
    stage: Path
    shots: tuple[Shot, ...]
