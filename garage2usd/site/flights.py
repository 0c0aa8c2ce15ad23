"""Place of the ramps between levels: a draw of its own among all places that leave each level in one piece."""

import math
from collections.abc import Iterator

import numpy as np

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig
from garage2usd.config.building import BuildingConfig
from garage2usd.site.portals import free_squares_connected
from garage2usd.structure.building import Flight, level_cells
from garage2usd.structure.grid import Cell, CellArray, Structure, outside_squares
from garage2usd.structure.stalls import Edge

__all__ = ["LEVEL_END_M", "draw_flight", "flight_is_free", "least_run_m", "with_run"]

LEVEL_END_M = 0.3
"""Level part at each end of a ramp, as long as a wall is thick."""
_STALLS_BETWEEN_COLUMNS = 3


def least_run_m(building: BuildingConfig) -> float:
    """Least length of a ramp between two levels, for its slope and transitions."""
    slope = building.ramp_slope_percent / 100
    return building.storey_m / slope + building.ramp_transition_m + 2 * LEVEL_END_M


def draw_flight(
    site: Structure, *, building: BuildingConfig, bay: BayConfig, seed: int, keeps_left: bool = False
) -> Flight:
    """Draw the place of the ramps between levels.

    Parameters
    ----------
    site
        Static squares of the top level with its portals.
    building
        Levels, storey and slope.
    bay
        Tells whether R and C are chosen later: then the number of squares is that for usual sides, and `with_run`
        lengthens sides if need be.
    seed
        Seed of the step.
    keeps_left
        True if traffic keeps to the left.

    Raises
    ------
    GenerationError
        If the ramps find no place.
    """
    places = [
        flight
        for way in Edge
        for head in np.argwhere(site.cells == Cell.FREE).tolist()
        for flight in _flights(site, (head[0], head[1]), way, building, bay, keeps_left=keeps_left)
        if flight_is_free(site.cells, flight, building.levels)
    ]
    if not places:
        reason = (
            f"ramps of {least_run_m(building):.1f} m, two squares wide, with free landings and squares ahead of these, "
            f"find no place on {site.shape[0]} x {site.shape[1]} squares; a larger site, fewer obstacles or a steeper "
            "building.ramp_slope_percent gives them room"
        )
        raise GenerationError("links", reason, seed=seed, attempts=1)
    return places[int(generator(seed, Step.LINKS).integers(len(places)))]


def flight_is_free(cells: CellArray, flight: Flight, levels: int) -> bool:
    """True if ramps, landings and the squares ahead are free, inside the contour, and each level stays in one piece."""
    rows, cols = cells.shape
    needed = {*flight.squares, *flight.landings, *flight.approaches}
    if not all(0 <= row < rows and 0 <= col < cols and cells[row, col] == Cell.FREE for row, col in needed):
        return False
    outside = np.pad(outside_squares(cells), 1, constant_values=True)
    around = {edge.beyond(square) for square in flight.squares for edge in Edge}
    if any(outside[row + 1, col + 1] for row, col in around):
        return False
    return all(free_squares_connected(level_cells(cells, flight, level, levels)) for level in range(levels))


def with_run(structure: Structure, flight: Flight, building: BuildingConfig) -> Structure:
    """Lengthen the sides of the squares along the ramps until these are long enough; equally, in whole millimetres."""
    short_mm = math.ceil((least_run_m(building) - flight.run_m(structure)) * 1000)
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
    if bay.chosen_sides[axis]:
        usual_m = (bay.stall_length_m + bay.row_m(_STALLS_BETWEEN_COLUMNS)) / 2
        yield Flight(head, way, math.ceil(least_run_m(building) / usual_m - 1e-9), keeps_left)
        return
    for length in range(1, site.shape[axis]):
        flight = Flight(head, way, length, keeps_left)
        row, col = flight.links[0].foot
        if not (0 <= row < site.shape[0] and 0 <= col < site.shape[1]):
            return
        if flight.run_m(site) >= least_run_m(building) - 1e-9:
            yield flight
            return
