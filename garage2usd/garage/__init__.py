"""The garage as a neutral model: a directed lane graph in metres and stalls as quads, Y up, seen from above as (x, z).

Layouts and file readers produce this model; driving, checks, maps, sensors and data sets read it. It has no grid.
"""

from garage2usd.garage.kinds import StallKind, StallUse
from garage2usd.garage.lanes import DEAD_END_LIMIT_M, Arc, DeadEnd, LaneEdge, LaneGraph, LaneKind, LaneNode, Point
from garage2usd.garage.stalls import Fault, Stall

__all__ = [
    "DEAD_END_LIMIT_M",
    "Arc",
    "DeadEnd",
    "Fault",
    "LaneEdge",
    "LaneGraph",
    "LaneKind",
    "LaneNode",
    "Point",
    "Stall",
    "StallKind",
    "StallUse",
]
