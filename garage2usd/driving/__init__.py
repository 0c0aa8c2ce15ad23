"""Driving: swept-path proofs that the design car can enter and leave each stall, with the manoeuvres found.

The modules are plain geometry, for use in any program: `find_way` takes a `DesignCar`, a parked `Pose`, `Obstacles`
and `LanePose`s. For a whole garage, `prove_garage` takes a `DrivenGarage`, and `prove_stalls` a layout and its lane
graph.
"""

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import DrivenGarage, Nose, StallProof, prove_garage
from garage2usd.driving.layout_garage import (
    prove_stalls,
    with_clutter,
    with_truth_of_misparked,
    without_unreachable,
)
from garage2usd.driving.manoeuvre import Gear, Manoeuvre, Move, Waypoint
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.proof import LanePose, Limits, Outcome, Search, least_clearance_m
from garage2usd.driving.road import BentFloor, DrivenRoad, Portal, RampFloor, SlopedFloor, heights_m
from garage2usd.driving.way_search import find_way

__all__ = [
    "BentFloor",
    "DesignCar",
    "DrivenGarage",
    "DrivenRoad",
    "Gear",
    "LanePose",
    "Limits",
    "Manoeuvre",
    "Move",
    "Nose",
    "Obstacles",
    "Outcome",
    "Portal",
    "Pose",
    "RampFloor",
    "Search",
    "SlopedFloor",
    "StallProof",
    "Waypoint",
    "find_way",
    "heights_m",
    "least_clearance_m",
    "prove_garage",
    "prove_stalls",
    "with_clutter",
    "with_truth_of_misparked",
    "without_unreachable",
]
