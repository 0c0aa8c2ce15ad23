"""Stalls that a car may not get into: those beside a narrow aisle, and narrow ones."""

from collections.abc import Iterable

from garage2usd.garage import LaneGraph, Stall

__all__ = ["tight_stalls"]

_ROOMY_AISLE_M, _ROOMY_STALL_M = 5.5, 2.3
"""From these on the design car gets into stalls at right angles with no more than a few changes of gear."""
_ROUNDING_M = 1e-6


def tight_stalls(lanes: LaneGraph, stalls: Iterable[Stall]) -> tuple[Stall, ...]:
    """Stalls of which it is in doubt whether the design car gets into them, in their order."""
    return tuple(
        stall
        for stall in stalls
        if stall.takes_cars
        and (
            lanes.clear_aisle_m(stall.access, stall.outwards) < _ROOMY_AISLE_M - _ROUNDING_M
            or stall.width_m < _ROOMY_STALL_M - _ROUNDING_M
        )
    )
