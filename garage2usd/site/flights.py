"""Straight ramps between levels: their places, and the sides of squares that they need."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.building import BuildingConfig
from garage2usd.structure.building import Flight
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.stalls import Edge

__all__ = ["LEVEL_END_M", "flight_of_tape", "flight_places", "flight_room", "least_run_m", "with_run"]

LEVEL_END_M = 0.3
"""Level part at each end of a ramp, as long as a wall is thick."""
_STALLS_BETWEEN_COLUMNS = 3


def least_run_m(building: BuildingConfig) -> float:
    """Least length of a ramp between two levels, for its slope and transitions."""
    slope = building.ramp_slope_percent / 100
    return building.storey_m / slope + building.ramp_transition_m + 2 * LEVEL_END_M


def flight_places(site: Structure, config: GarageConfig) -> Iterator[Flight]:
    """Yield the flights from all free squares in all directions, as short as the sides of their squares allow.

    A number of squares that `building.place` gives is kept where they are long enough.
    """
    for way in Edge:
        for row, col in np.argwhere(site.cells == Cell.FREE).tolist():
            yield from _flights(
                site, (row, col), way, config.building, config.bay, keeps_left=config.standard.drives_on_left
            )


def flight_of_tape(words: Sequence[str], *, keeps_left: bool) -> Flight:
    """Read a flight from its `Flight.tape`, which is split at its commas.

    Raises
    ------
    ValueError, KeyError
        If it is not one.
    """
    row, col, way, length = words
    return Flight((int(row), int(col)), Edge[way], int(length), keeps_left)


def flight_room(config: GarageConfig) -> str:
    """Tell what room flights need."""
    return f"ramps of {least_run_m(config.building):.1f} m, two squares wide"


def with_run(structure: Structure, flight: Flight, config: GarageConfig) -> Structure:
    """Lengthen the sides of the squares along the ramps until these are long enough; equally, in whole millimetres."""
    short_mm = math.ceil((least_run_m(config.building) - flight.run_m(structure)) * 1000)
    if short_mm <= 0:
        return structure
    axis = 0 if flight.way.along_x else 1
    sides = [structure.row_depths_mm.copy(), structure.column_widths_mm.copy()]
    lines = sorted({square[axis] for square in flight.squares})
    sides[axis][lines] += -(-short_mm // len(lines))
    return Structure(structure.cells, sides[1], sides[0])


def _flights(
    site: Structure,
    head: tuple[int, int],
    way: Edge,
    building: BuildingConfig,
    bay: BayConfig,
    *,
    keeps_left: bool,
) -> Iterator[Flight]:
    """Yield the flight from a landing, as short as the sides of its squares allow; none off the site."""
    axis = 0 if way.along_x else 1
    given = building.place.count if building.place else None
    if bay.chosen_sides[axis]:
        usual_m = (bay.stall_length_m + bay.row_m(_STALLS_BETWEEN_COLUMNS)) / 2
        least = math.ceil(least_run_m(building) / usual_m - 1e-9)
        if given is None or given >= least:
            yield Flight(head, way, given or least, keeps_left)
        return
    for length in (given,) if given else range(1, site.shape[axis]):
        flight = Flight(head, way, length, keeps_left)
        row, col = flight.links[0].foot
        if not (0 <= row < site.shape[0] and 0 <= col < site.shape[1]):
            return
        if flight.run_m(site) >= least_run_m(building) - 1e-9:
            yield flight
            return
