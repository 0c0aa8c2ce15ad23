"""Tight stalls, which need a proof of access: stalls at a narrow aisle, and narrow stalls."""

from collections.abc import Iterable

from garage2usd.garage import LaneGraph, Stall

__all__ = ["tight_stalls"]

_ROOMY_AISLE_M, _ROOMY_STALL_M = 5.5, 2.3
"""Aisle and stall widths at which the design car enters perpendicular stalls with few gear changes."""
_ROUNDING_M = 1e-6


def tight_stalls(lanes: LaneGraph, stalls: Iterable[Stall]) -> tuple[Stall, ...]:
    """Select the stalls that the design car may be unable to enter, in their order."""
    return tuple(
        stall
        for stall in stalls
        if stall.takes_cars
        and (
            lanes.clear_aisle_m(stall.access, stall.outwards) < _ROOMY_AISLE_M - _ROUNDING_M
            or stall.width_m < _ROOMY_STALL_M - _ROUNDING_M
        )
    )
