"""The states of a driven car over time as CSV and JSON, and the manoeuvres of a swept-path proof as JSON."""

import csv
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import VERSION
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import StallProof
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.proof import Limits, Outcome

Floats = NDArray[np.float64]
_DIGITS = 6
_STEP_M = 0.25


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


def write_witness(
    path: Path,
    proofs: Sequence[StallProof],
    *,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    floors_m: Mapping[str, float] | None = None,
) -> None:
    """Write the swept-path proof of each stall as JSON.

    Notes
    -----
    ``moves`` are gear, curvature (1/m, positive to the driver's left) and length (m) in order from ``start``; they
    define the manoeuvre. ``poses`` sample it at most 0.25 m apart: distance driven (m), x, z (m), yaw (right-handed
    about +Y, 0 points to -Z), gear (1 or -1) and curvature. All refer to the middle of the rear axle. Stalls without
    manoeuvres list the touched objects; those for which the search reached its bound are ``undecided``. With
    `floors_m`, the height of the floor under each stall by name, ``floor_m`` says it: all poses of a stall are on it.
    """
    car = car or DesignCar()
    document = {
        "version": VERSION,
        "car": {**asdict(car), "rear_axle_radius_m": round(car.rear_axle_radius_m, _DIGITS)},
        "limits": asdict(limits or Limits()),
        "stalls": [_stall(proof, floors_m) for proof in proofs],
    }
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8", newline="\n")


def _stall(proof: StallProof, floors_m: Mapping[str, float] | None) -> dict[str, Any]:
    return {
        "name": proof.stall,
        **({} if floors_m is None else {"floor_m": floors_m[proof.stall]}),
        "proven": proof.is_proven,
        "nose": proof.nose and proof.nose.value,
        "clear_with_all_stalls_taken": proof.is_full,
        "backs_out_of_dead_end": proof.backs_out,
        **({"undecided": True} if proof.outcome is Outcome.UNDECIDED else {}),
        "touched": proof.touched,
        "touched_alone_in_the_way": proof.is_single_cause,
        "in": proof.way_in and _way(proof.way_in),
        "out": proof.way_out and _way(proof.way_out),
    }


def _way(way: Manoeuvre) -> dict[str, Any]:
    return {
        "clearance_m": round(way.clearance_m, _DIGITS),
        "length_m": round(way.length_m, _DIGITS),
        "gear_changes": way.gear_changes,
        "start": _pose(way.start),
        "moves": [[move.gear.value, round(move.curvature_per_m, 9), round(move.length_m, 9)] for move in way.moves],
        "poses": [
            [round(at.arc_m, _DIGITS), *_pose(at.pose), at.gear.sign, round(at.curvature_per_m, _DIGITS)]
            for at in way.waypoints(_STEP_M)
        ],
    }


def _pose(pose: Pose) -> list[float]:
    return [
        round(pose.x_m, _DIGITS),
        round(pose.z_m, _DIGITS),
        round(math.remainder(pose.yaw_rad, math.tau), _DIGITS),
    ]
