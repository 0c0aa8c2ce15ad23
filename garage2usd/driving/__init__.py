"""Driving: the proof that the design car gets into each stall and out of it, and the ways that do it.

Plain geometry, for any program: `find_way` takes a `DesignCar`, a parked `Pose`, `Obstacles` and `LanePose`s. For a
whole garage `prove_stalls` takes its layout and lane graph.
"""

from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import Nose, StallProof, prove_stalls
from garage2usd.driving.manoeuvre import Gear, Manoeuvre, Move, Waypoint
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.proof import LanePose, Limits, Search, find_way, least_clearance_m

__all__ = [
    "DesignCar",
    "Gear",
    "LanePose",
    "Limits",
    "Manoeuvre",
    "Move",
    "Nose",
    "Obstacles",
    "Pose",
    "Search",
    "StallProof",
    "Waypoint",
    "find_way",
    "least_clearance_m",
    "prove_stalls",
]
