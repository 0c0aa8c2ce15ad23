"""A trajectory: the states of a car at times, as CSV and JSON."""

import csv
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.version import VERSION
from garage2usd.driving.car import DesignCar

__all__ = ["Trajectory", "write_trajectory_csv", "write_trajectory_json"]

Floats = NDArray[np.float64]
_DIGITS = 6


@dataclass(frozen=True, eq=False)
class Trajectory:
    """A car's states; all arrays are float64 of shape (n,).

    Attributes
    ----------
    time_s
        Ascending, from 0 on.
    x_m, y_m, z_m
        The middle of the rear axle on the floor, in the stage's frame: Y is up.
    yaw_rad
        Right-handed about +Y, 0 looks to -Z; continuous in time.
    pitch_rad
        Of the floor under the axles, positive with the nose up.
    speed_m_s
        Along the floor, negative in reverse.
    acceleration_m_s2
        Its change from there on.
    curvature_per_m
        That the front wheels stand at, positive to the driver's left.
    steering_rad
        Angle of a front wheel between both, positive to the left: atan(wheelbase * curvature).
    gear
        1 forward, -1 in reverse.
    arc_m
        Way driven along the floor, in both gears.
    """

    time_s: Floats
    x_m: Floats
    y_m: Floats
    z_m: Floats
    yaw_rad: Floats
    pitch_rad: Floats
    speed_m_s: Floats
    acceleration_m_s2: Floats
    curvature_per_m: Floats
    steering_rad: Floats
    gear: Floats
    arc_m: Floats

    def columns(self) -> dict[str, list[float] | list[int]]:
        """Its columns by name, rounded to a micrometre or the like."""
        rounded = {
            field.name: (np.round(getattr(self, field.name), _DIGITS) + 0.0).tolist() for field in fields(Trajectory)
        }
        rounded["gear"] = [int(gear) for gear in rounded["gear"]]
        return rounded


def write_trajectory_csv(path: Path, trajectory: Trajectory) -> None:
    """Write the columns as text, one row a state, under their names."""
    columns = trajectory.columns()
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def write_trajectory_json(path: Path, trajectory: Trajectory, car: DesignCar, facts: Mapping[str, object]) -> None:
    """Write the columns with the car and what else is to be said of the drive."""
    document = {"version": VERSION, **facts, "car": asdict(car), "columns": trajectory.columns()}
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8", newline="\n")
