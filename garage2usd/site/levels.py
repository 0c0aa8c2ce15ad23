"""The sites of all levels of a garage before any lanes: obstacles, ramps, and the portals of each level."""

from dataclasses import dataclass

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.garage.level_place import level_name
from garage2usd.site.level_ramps import draw_ramps
from garage2usd.site.room import make_roomy_site
from garage2usd.structure.building import Ramps, level_cells
from garage2usd.structure.grid import Cell, CellArray, Structure

__all__ = ["LevelSites", "check_levels", "level_number", "make_level_sites", "make_street_site"]

_CEILING_TO_FLOOR_M = 0.25
"""Least height between a ceiling's underside and the floor above: the ceiling's slab."""


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
    """Refuse settings that several levels do not go with.

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
