"""A trajectory of a car: its states over time, as CSV and JSON."""

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
    """Trajectory of a car; all arrays are float64 of shape (n,).

    Attributes
    ----------
    time_s
        Ascending, from 0.
    x_m, y_m, z_m
        The middle of the rear axle on the floor, in the stage's frame: Y is up.
    yaw_rad
        Right-handed about +Y, 0 points to -Z; continuous in time.
    pitch_rad
        Pitch of the floor under the axles, positive with the nose up.
    speed_m_s
        Speed along the floor, negative in reverse.
    acceleration_m_s2
        Rate of the speed from that time on.
    curvature_per_m
        Curvature set by the front wheels, positive to the driver's left.
    steering_rad
        Mean angle of the front wheels, positive to the left: atan(wheelbase * curvature).
    gear
        1 forward, -1 in reverse.
    arc_m
        Distance driven along the floor, in both gears.
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
        """Columns of the trajectory by name, rounded to a micrometre or similar."""
        rounded = {
            field.name: (np.round(getattr(self, field.name), _DIGITS) + 0.0).tolist() for field in fields(Trajectory)
        }
        rounded["gear"] = [int(gear) for gear in rounded["gear"]]
        return rounded


def write_trajectory_csv(path: Path, trajectory: Trajectory) -> None:
    """Write a trajectory as CSV: a header, then one row per state."""
    columns = trajectory.columns()
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def write_trajectory_json(path: Path, trajectory: Trajectory, car: DesignCar, facts: Mapping[str, object]) -> None:
    """Write a trajectory as JSON, with the car and further properties of the drive."""
    document = {"version": VERSION, **facts, "car": asdict(car), "columns": trajectory.columns()}
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8", newline="\n")
