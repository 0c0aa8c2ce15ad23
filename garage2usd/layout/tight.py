"""Stalls that a car may not get into: those beside a narrow aisle, and narrow ones."""

from collections.abc import Iterable

from garage2usd.config import BayConfig
from garage2usd.layout.placement import Stall
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

__all__ = ["clear_aisle_m", "tight_stalls"]

_ROOMY_AISLE_M, _ROOMY_STALL_M = 5.5, 2.3
"""From these on the design car gets into stalls at right angles with no more than a few changes of gear."""
_ROUNDING_M = 1e-6


def clear_aisle_m(structure: Structure, stall: Stall, bay: BayConfig) -> float:
    """Metres between the columns on both sides of the lane that a stall opens onto."""
    row, col = stall.access_square
    is_along_x = stall.edge in {Edge.UP, Edge.DOWN}
    side_mm = structure.row_depths_mm[row] if is_along_x else structure.column_widths_mm[col]
    return float(side_mm) / 1000 - 2 * bay.carriageway_setback_m


def tight_stalls(structure: Structure, stalls: Iterable[Stall], bay: BayConfig) -> tuple[Stall, ...]:
    """Stalls of which it is in doubt whether the design car gets into them, in their order."""
    return tuple(
        stall
        for stall in stalls
        if stall.use.takes_cars
        and (
            clear_aisle_m(structure, stall, bay) < _ROOMY_AISLE_M - _ROUNDING_M
            or stall.width_m < _ROOMY_STALL_M - _ROUNDING_M
        )
    )
