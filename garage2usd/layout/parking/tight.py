"""Stalls that a car may not get into: those beside a narrow aisle, and narrow ones."""

from collections.abc import Iterable

from garage2usd.garage import LaneGraph, Stall
from garage2usd.layout.garage_stalls import clear_aisle_m
from garage2usd.layout.placement import PlacedStall
from garage2usd.structure.lane_graph import LaneSquares

__all__ = ["is_tight", "tight_stalls"]

_ROOMY_AISLE_M, _ROOMY_STALL_M = 5.5, 2.3
"""From these on the design car gets into stalls at right angles with no more than a few changes of gear."""
_ROUNDING_M = 1e-6


def tight_stalls(graph: LaneSquares, stalls: Iterable[PlacedStall]) -> tuple[PlacedStall, ...]:
    """Stalls of which it is in doubt whether the design car gets into them, in their order."""
    return tuple(
        stall for stall in stalls if stall.use.takes_cars and _is_narrow(clear_aisle_m(stall, graph), stall.width_m)
    )


def is_tight(stall: Stall, lanes: LaneGraph) -> bool:
    """Return True if it is in doubt whether the design car gets into a stall."""
    return stall.takes_cars and _is_narrow(lanes.clear_aisle_m(stall.access, stall.outwards), stall.width_m)


def _is_narrow(aisle_m: float, stall_m: float) -> bool:
    return aisle_m < _ROOMY_AISLE_M - _ROUNDING_M or stall_m < _ROOMY_STALL_M - _ROUNDING_M
