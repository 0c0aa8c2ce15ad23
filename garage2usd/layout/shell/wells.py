"""Wells of all kinds of ramps between levels."""

from collections.abc import Callable
from typing import Any

from garage2usd.config import GarageConfig
from garage2usd.config.building import BuildingConfig, LinkKind
from garage2usd.layout.shell.coil_well import CoilWell
from garage2usd.layout.shell.flight_well import FlightWell
from garage2usd.layout.shell.well import Well
from garage2usd.structure.building import Ramps

__all__ = ["make_well"]

_WELLS: dict[LinkKind, Callable[[Any, int, int, BuildingConfig, float], Well]] = {
    LinkKind.STRAIGHT: FlightWell,
    LinkKind.HELIX: CoilWell,
}


def make_well(pair: Ramps, level: int, config: GarageConfig) -> Well:
    """Return the well of a pair of ramps, as one level has its part of it.

    Parameters
    ----------
    pair
        The ramps.
    level
        Number of the level from 0 at the top.
    config
        Settings of the whole garage.
    """
    building = config.building
    return _WELLS[building.ramps](pair, level, building.levels, building, config.fittings.wall_thickness_m)
