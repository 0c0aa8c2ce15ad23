"""The neutral garage: a directed metric lane graph and stalls as quads, in metres, Y up, seen from above as (x, z).

Layouts and the readers of files make it; driving, checks, maps, sensors and data sets take it. It knows no grid.
"""

from garage2usd.garage.lanes import DEAD_END_LIMIT_M, Arc, DeadEnd, LaneEdge, LaneGraph, LaneKind, LaneNode, Point
from garage2usd.garage.stalls import Fault, Stall, StallKind, StallUse

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
