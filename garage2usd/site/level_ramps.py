"""Place of the ramps between levels: given, or drawn among all places that leave each level in one piece."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import GarageConfig
from garage2usd.config.building import LinkKind, RampsPlace
from garage2usd.site.flights import flight_of_tape, flight_places, flight_room, with_run
from garage2usd.site.helices import helix_cost, helix_of_tape, helix_places, helix_room, with_circles
from garage2usd.site.portals import free_squares_connected
from garage2usd.structure.building import Ramps, level_cells
from garage2usd.structure.grid import Cell, CellArray, Structure, outside_squares
from garage2usd.structure.stalls import Edge

__all__ = ["draw_ramps", "ramps_are_free", "ramps_of_tape", "with_ramps_room"]


class _Kind(NamedTuple):
    """What a kind of ramps has.

    Attributes
    ----------
    places
        Yields all places on a site.
    room
        Tells what room they need.
    of_tape
        Reads them from their tape, split at its commas.
    with_room
        Returns a structure with sides long enough for them.
    cost
        Estimates what a place costs, in any unit; the places of the least cost are drawn from. None for all places.
    """

    places: Callable[[Structure, GarageConfig], Iterator[Ramps]]
    room: Callable[[GarageConfig], str]
    of_tape: Callable[..., Ramps]
    with_room: Callable[[Structure, Any, GarageConfig], Structure]
    cost: Callable[[Structure, Any], int] | None = None


_KINDS = {
    LinkKind.STRAIGHT: _Kind(flight_places, flight_room, flight_of_tape, with_run),
    LinkKind.HELIX: _Kind(helix_places, helix_room, helix_of_tape, with_circles, helix_cost),
}


def draw_ramps(site: Structure, config: GarageConfig, attempt: int = 0) -> Ramps:
    """Draw the place of the ramps between levels, or take the given one.

    Parameters
    ----------
    site
        Static squares of the top level with its portals.
    config
        Levels, kind of ramps, storey, slope and seed. Where R and C are chosen later the number of squares is that for
        usual sides, and `with_ramps_room` lengthens sides if need be.
    attempt
        Number of earlier draws, whose places are left out.

    Raises
    ------
    GenerationError
        If the ramps find no place.
    ConfigError
        If they do not fit the given one.
    """
    kind, building = _KINDS[config.building.ramps], config.building
    if building.place is not None:
        return _given(site, config, building.place)
    places = [ramps for ramps in kind.places(site, config) if ramps_are_free(site.cells, ramps, building.levels)]
    if len(places) <= attempt:
        reason = (
            f"{kind.room(config)}, with free landings and squares ahead of these, find no place on "
            f"{site.shape[0]} x {site.shape[1]} squares; a larger site, fewer obstacles or a steeper "
            "building.ramp_slope_percent gives them room"
        )
        raise GenerationError("links", reason, seed=config.seed, attempts=attempt + 1)
    costs = {ramps: 0 if kind.cost is None else kind.cost(site, ramps) for ramps in places}
    for number in range(attempt + 1):
        least = min(costs.values())
        cheapest = [ramps for ramps, cost in costs.items() if cost == least]
        drawn = cheapest[int(generator(config.seed, Step.LINKS, number).integers(len(cheapest)))]
        del costs[drawn]
    return drawn


def _given(site: Structure, config: GarageConfig, place: RampsPlace) -> Ramps:
    """Return the ramps on given squares."""
    kind, building = _KINDS[config.building.ramps], config.building
    asked = place.square, Edge[place.way.upper()], place.aside and Edge[place.aside.upper()], place.count
    for ramps in kind.places(site, config):
        is_asked = all(want is None or want == got for want, got in zip(asked, ramps.place, strict=True))
        if is_asked and ramps_are_free(site.cells, ramps, building.levels):
            return ramps
    wanted = (
        f"squares on which {kind.room(config)}, with landings and the squares ahead of these, are free on the site "
        f"of seed {config.seed} and leave each level in one piece"
    )
    raise ConfigError("building.place", place.model_dump(exclude_none=True), wanted)


def ramps_are_free(cells: CellArray, ramps: Ramps, levels: int) -> bool:
    """True if ramps, landings and the squares ahead are free, and each level stays in one piece.

    Neither ramps nor landings are beside the outside, where a landing would have a door to the street.
    """
    rows, cols = cells.shape
    needed = {*ramps.squares, *ramps.landings, *ramps.approaches}
    if not all(0 <= row < rows and 0 <= col < cols and cells[row, col] == Cell.FREE for row, col in needed):
        return False
    outside = np.pad(outside_squares(cells), 1, constant_values=True)
    around = {edge.beyond(square) for square in (*ramps.squares, *ramps.landings) for edge in Edge}
    if any(outside[row + 1, col + 1] for row, col in around):
        return False
    return all(free_squares_connected(level_cells(cells, ramps, level, levels)) for level in range(levels))


def ramps_of_tape(tape: str, config: GarageConfig) -> Ramps:
    """Read ramps from their tape.

    Raises
    ------
    ValueError, KeyError
        If it holds none of the kind that the settings ask for.
    """
    kind, words = config.building.ramps, tape.split(",")
    own: Sequence[str] = words[1:] if words[0] == kind else words
    return _KINDS[kind].of_tape(own, keeps_left=config.standard.drives_on_left)


def with_ramps_room(structure: Structure, ramps: Ramps, config: GarageConfig) -> Structure:
    """Lengthen sides of the ramps' squares, where they are chosen, until the ramps are long enough.

    Raises
    ------
    ConfigError
        If that is not possible.
    """
    return _KINDS[config.building.ramps].with_room(structure, ramps, config)
