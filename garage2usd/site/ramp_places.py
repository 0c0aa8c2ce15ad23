"""Places of the ramps between levels, straight ones and helices, and the sides of squares that they need."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.site import BuildingConfig
from garage2usd.structure.building import Flight, Ramps
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.helix import LANE_M, CoilBlock, Helix
from garage2usd.structure.stalls import Edge

LEVEL_END_M = 0.3
"""Level part at each end of a ramp, as long as a wall is thick."""
_STALLS_BETWEEN_COLUMNS = 3
LEAST_INNER_M = 6.0
"""Least radius of a helix's inner wall: of turns over 180 degrees in JGJ 100."""
_COUNTS = (3, 4, 5)
"""Squares along each side of a block; two would leave no circle beside the crossing."""
_MODULE = 3
"""Squares across a lane with stalls on both sides."""
_STEP_MM = 50
_MOST_WIDENED_MM = 10_000


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
    """Describe the room that straight ramps need."""
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


def helix_places(site: Structure, config: GarageConfig) -> Iterator[Helix]:
    """Yield the helices at all free squares in all directions, of as few squares as their sides allow.

    With `building.place`, also those of more squares, or only those of the given number of squares.
    """
    keeps_left = config.standard.drives_on_left
    are_chosen = config.bay.chosen_sides
    place = config.building.place
    counts: tuple[int, ...] = (_COUNTS[0],) if any(are_chosen) else _COUNTS
    if place and place.count:
        counts = tuple(count for count in _COUNTS if count == place.count)
    for count in counts:
        found = False
        for way in Edge:
            for aside in way.ends:
                for row, col in np.argwhere(site.cells == Cell.FREE).tolist():
                    helix = Helix((row, col), way, aside, count, keeps_left)
                    if not _is_on(site, helix):
                        continue
                    # where sides are chosen later, `with_circles` widens them
                    if any(are_chosen) or _is_round(site, helix, config):
                        found = True
                        yield helix
        if found and not place:
            return


def cost_of_place(site: Structure, ramps: Ramps) -> int:
    """Estimate the cost of a place: squares along the ramps whose strip outwards is not a whole number of modules.

    A module is a lane with stalls on both sides, three squares. Before the landings of helices in a row, and at the
    heads of straight ramps, one module is best.
    """
    cost = 0
    squares, (_, way, _, _) = set(ramps.squares), ramps.place
    for edge in Edge:
        best_m = _MODULE if edge is way.opposite else None
        for square in squares:
            beyond = edge.beyond(square)
            if beyond in squares:
                continue
            depth = 0
            while _is_free(site, beyond):
                depth, beyond = depth + 1, edge.beyond(beyond)
            cost += 2 * (depth % _MODULE != 0) + (best_m is not None and depth != best_m)
    return cost


def helix_of_tape(words: Sequence[str], *, keeps_left: bool) -> Helix:
    """Read a helix from its `Helix.tape`, which is split at its commas and without the kind.

    Raises
    ------
    ValueError, KeyError
        If it is not one.
    """
    row, col, way, aside, count = words
    helix = Helix((int(row), int(col)), Edge[way], Edge[aside], int(count), keeps_left)
    if helix.count not in _COUNTS or helix.aside not in helix.way.ends:
        raise ValueError(words)
    return helix


def helix_room(config: GarageConfig) -> str:
    """Describe the room that helices need."""
    limit = _steepest_percent(config)
    return (
        f"two helices side by side, each of 3 x 3 squares or more with an inner radius of {LEAST_INNER_M:g} m and at "
        f"most {limit:g} % along it"
    )


def with_circles(structure: Structure, helix: Helix, config: GarageConfig) -> Structure:
    """Lengthen the chosen sides of the helices' squares until their circles are large enough.

    The shorter sides of the blocks grow first, then both.

    Raises
    ------
    ConfigError
        If that takes more than ten metres a square, or a side is not to be chosen.
    """
    sides = [structure.row_depths_mm.copy(), structure.column_widths_mm.copy()]
    lines: list[list[list[int]]] = [[], []]
    """For each axis the lines of each block."""
    for block in helix.blocks:
        for way in (block.way, block.aside):
            lines[0 if way.along_x else 1].append(block.lines(way))
    for _ in range(0, 2 * _MOST_WIDENED_MM, _STEP_MM):
        made = Structure(structure.cells, sides[1], sides[0])
        if _is_round(made, helix, config):
            return made
        if not any(config.bay.chosen_sides):
            break
        lengths_mm = [min(int(sides[axis][own].sum()) for own in lines[axis]) for axis in range(2)]
        chosen = [axis for axis, is_chosen in enumerate(config.bay.chosen_sides) if is_chosen]
        for axis in chosen:
            if len(chosen) == 1 or lengths_mm[axis] <= lengths_mm[1 - axis]:
                sides[axis][sorted({line for own in lines[axis] for line in own})] += _STEP_MM
    limit = _steepest_percent(config)
    wanted = f"'straight', a lower building.storey_m, or squares that leave helices gentler than {limit:g} %"
    raise ConfigError("building.ramps", str(config.building.ramps), wanted)


def _is_on(site: Structure, helix: Helix) -> bool:
    rows, cols = site.shape
    return all(0 <= row < rows and 0 <= col < cols for row, col in (*helix.squares, *helix.approaches))


def _is_free(site: Structure, square: tuple[int, int]) -> bool:
    row, col = square
    return 0 <= row < site.shape[0] and 0 <= col < site.shape[1] and bool(site.cells[row, col] == Cell.FREE)


def _is_round(structure: Structure, helix: Helix, config: GarageConfig) -> bool:
    """True if both circles are large enough for cars and for the slope."""
    return all(_fits(structure, block, config) for block in helix.blocks)


def _fits(structure: Structure, block: CoilBlock, config: GarageConfig) -> bool:
    building = config.building
    line = block.line(structure, config.fittings.wall_thickness_m)
    along, across = block.sides_m(structure)
    if line.inner_radius_m < LEAST_INNER_M or min(along[0], across[0]) < LANE_M:
        return False
    slope = line.inner_slope(building.storey_m, building.ramp_transition_m)
    return math.isfinite(slope) and 100 * slope <= _steepest_percent(config) + 1e-9


def _steepest_percent(config: GarageConfig) -> float:
    clause = config.standard.curved_ramp_slope
    return min(config.building.ramp_slope_percent, clause.amount if clause else math.inf)
