"""The sites of all levels of a garage before any lanes: obstacles, portals, and ramps that are given or drawn."""
# Over 300 lines: what a site has no room for is told by the rules that draw its ramps.

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.site import LinkKind, RampsPlace
from garage2usd.garage.levels import level_name
from garage2usd.site import make_site
from garage2usd.site.portals import free_squares_connected
from garage2usd.site.ramp_places import (
    cost_of_place,
    flight_of_tape,
    flight_places,
    flight_room,
    helix_of_tape,
    helix_places,
    helix_room,
    with_circles,
    with_run,
)
from garage2usd.structure.building import Ramps, level_cells
from garage2usd.structure.grid import Cell, CellArray, Structure, outside_squares
from garage2usd.structure.stalls import Edge, capacity_table

_CEILING_TO_FLOOR_M = 0.25
"""Least height between a ceiling's underside and the floor above: the ceiling's slab."""


def make_roomy_site(config: GarageConfig) -> Structure:
    """Make the site of a garage, or of the top level without ramps, and check its squares.

    Raises
    ------
    ConfigError
        If given parts contradict each other, or no square holds a stall.
    GenerationError
        If a step finds no valid result within its attempts.
    """
    site = make_site(config.site, bay=config.bay, seed=config.seed, fittings=config.fittings)
    _check_room(site, config.bay)
    return site


def _check_room(site: Structure, bay: BayConfig) -> None:
    """Check that some squares can hold a stall, unless their size is chosen later.

    Raises
    ------
    ConfigError
        If none can; names the setting of the squares' size, and the size that a stall needs.
    """
    chosen_later = bay.dimensioned and (bay.column_widths_m is None or bay.row_depths_m is None)
    table = capacity_table(site, bay)
    open_to_stalls = site.cells == Cell.FREE
    if chosen_later or not open_to_stalls.any() or (table.along_x + table.along_z)[open_to_stalls].any():
        return
    across_m, along_m = bay.stall_width_m + bay.column_size_m, bay.stall_length_m
    stall = f"a stall of {bay.stall_width_m:g} x {bay.stall_length_m:g} m beside a column of {bay.column_size_m:g} m"
    smaller = "or a smaller bay.stall_width_m, bay.stall_length_m or bay.column_size_m"
    if bay.column_widths_m is None and bay.row_depths_m is None:
        least_m = max(across_m, along_m)
        raise ConfigError("bay.square_side_m", bay.square_side_m, f"at least {least_m:g} m for {stall}; {smaller}")
    sizes = (site.column_widths_mm / 1000).tolist(), (site.row_depths_mm / 1000).tolist()
    least = f"a column and a row of at least {across_m:g} and {along_m:g} m, either way round"
    raise ConfigError("bay.column_widths_m, bay.row_depths_m", sizes, f"{least}, for {stall}; {smaller}")


_MORE_SQUARES = 9
"""Sites of up to eight rows and columns more are tried for an error that says how large a site has room for ramps."""


class _Kind(NamedTuple):
    """Functions of a kind of ramps.

    Attributes
    ----------
    places
        Yields all places of the ramps on a site.
    room
        Describes the room that the ramps need.
    of_tape
        Reads ramps from their tape, which is split at its commas.
    with_room
        Returns a structure with sides long enough for the ramps.
    """

    places: Callable[[Structure, GarageConfig], Iterator[Ramps]]
    room: Callable[[GarageConfig], str]
    of_tape: Callable[..., Ramps]
    with_room: Callable[[Structure, Any, GarageConfig], Structure]


_KINDS = {
    LinkKind.STRAIGHT: _Kind(flight_places, flight_room, flight_of_tape, with_run),
    LinkKind.HELIX: _Kind(helix_places, helix_room, helix_of_tape, with_circles),
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
            f"{site.shape[0]} x {site.shape[1]} squares; {_what_has_room(site, config)}"
        )
        raise GenerationError("links", reason, seed=config.seed, attempts=attempt + 1)
    costs = {ramps: cost_of_place(site, ramps) for ramps in places}
    for number in range(attempt + 1):
        least = min(costs.values())
        cheapest = [ramps for ramps, cost in costs.items() if cost == least]
        drawn = cheapest[int(generator(config.seed, Step.LINKS, number).integers(len(cheapest)))]
        del costs[drawn]
    return drawn


def _what_has_room(site: Structure, config: GarageConfig) -> str:
    """Say what a site without room for its ramps could hold, and the size of a site with room for them."""

    def has_room(site: Structure, name: LinkKind, levels: int) -> bool:
        return any(ramps_are_free(site.cells, ramps, levels) for ramps in _KINDS[name].places(site, config))

    kind, levels, (rows, cols) = config.building.ramps, config.building.levels, site.shape
    others = [f'building.ramps = "{other}"' for other in LinkKind if other != kind and has_room(site, other, levels)]
    fewer = [f"{count} levels" for count in range(levels - 1, 1, -1) if has_room(site, kind, count)]
    here = " or ".join([*others, *fewer[:1]] or ["1 level"])
    more = sorted(
        np.ndindex(_MORE_SQUARES, _MORE_SQUARES), key=lambda more: ((rows + more[0]) * (cols + more[1]), more)
    )
    depth_m, width_m = (float(np.median(sides)) / 1000 for sides in (site.row_depths_mm, site.column_widths_mm))
    for size in ((rows + down, cols + right) for down, right in more):
        if has_room(Structure.from_arrays(np.zeros(size, np.int8), width_m, depth_m), kind, levels):
            is_same = " with its doors and obstacles elsewhere" if size == site.shape else ""
            needed = f"one of {size[0]} x {size[1]} squares{is_same}"
            break
    else:
        needed = "a much larger one"
    return f"this site has room for {here}, and {needed} or a steeper building.ramp_slope_percent for these ramps"


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


@dataclass(frozen=True, eq=False)
class LevelSites:
    """The sites of all levels of a garage.

    Attributes
    ----------
    street
        Site of the top level without the ramps, with the portals to the street.
    ramps
        The ramps, in the same squares on all levels; None of a single level.
    count
        Number of levels.
    """

    street: Structure
    ramps: Ramps | None
    count: int

    def cells(self, level: int) -> CellArray:
        """Return S of a level by its number from 0, with ramps and landings; int8, (rows, cols)."""
        street = self.street.cells
        return street if self.ramps is None else level_cells(street, self.ramps, level, self.count)

    def site(self, level: int) -> Structure:
        """Return the site of a level by its number from 0, with R and C as before lanes are planned."""
        return self.street.with_cells(self.cells(level))


def level_number(level: str | None, count: int) -> int:
    """Return the number of a level from 0 by its name, among the `count` levels of a garage; the top one for None.

    Raises
    ------
    ConfigError
        If there is no such level.
    """
    names = [level_name(number) for number in range(count)]
    if level is None:
        return 0
    if level not in names:
        raise ConfigError("level", level, f"{', '.join(names)}, as building.levels is {count}")
    return names.index(level)


def make_level_sites(config: GarageConfig, attempt: int = 0) -> LevelSites:
    """Make the sites of all levels and draw the ramps, as each attempt of `garage2usd.generate` does.

    Parameters
    ----------
    config
        The settings.
    attempt
        Number of earlier draws, whose places of the ramps are left out.

    Raises
    ------
    ConfigError
        If a setting cannot be used, or not together with several levels.
    GenerationError
        If a random step found no valid result, such as a place for the ramps; names the step and the seed.
    """
    street, count = make_street_site(config), config.building.levels
    return LevelSites(street, draw_ramps(street, config, attempt) if count > 1 else None, count)


def make_street_site(config: GarageConfig) -> Structure:
    """Make the site of the top level without the ramps; errors as for `make_level_sites`."""
    check_levels(config)
    site = make_roomy_site(config)
    if config.building.levels > 1 and (site.cells == Cell.LANE).any():
        raise ConfigError("site.structure", str(site), "no lanes with building.levels of 2 or more: they are planned")
    return site


def check_levels(config: GarageConfig) -> None:
    """Refuse settings that cannot be combined with several levels.

    Raises
    ------
    ConfigError
        If there is such a setting.
    """
    building, ceiling_m = config.building, config.fittings.ceiling_height_m
    if building.levels == 1:
        return
    if building.storey_m < ceiling_m + _CEILING_TO_FLOOR_M:
        least = f"at least {_CEILING_TO_FLOOR_M} m over fittings.ceiling_height_m, which is {ceiling_m}"
        raise ConfigError("building.storey_m", building.storey_m, least)
    for field, given in (("plan.one_way", config.plan.one_way), ("stalls.runs", config.stalls.runs)):
        if given:
            raise ConfigError(field, list(given), "nothing with building.levels of 2 or more: it names no level")
