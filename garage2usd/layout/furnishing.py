"""What is put into a floor: every object of a level as a placement, from its lanes, stalls, columns and walls alone."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import shapely

from garage2usd.assets.countries import Country
from garage2usd.config import GarageConfig, LookConfig
from garage2usd.config.look import AISLE, FloorFinish, SignsLook, SignsOf
from garage2usd.garage import LaneGraph, Stall
from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.ceiling.lighting import LightLevels, installed_lamps, lane_points_of, light_up, ramp_lamps
from garage2usd.layout.ceiling.services import cable_trays, ducts, sprinklers
from garage2usd.layout.ceiling.signs import exit_signs, lane_signs, level_plates, level_signs, mirrors
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.egress.cores import Core, crossings_to
from garage2usd.layout.fittings import cones, speed_bumps, tube_lights
from garage2usd.layout.floor.drainage import drains, puddles
from garage2usd.layout.floor.panels import drawn_markings_of, floor_panels
from garage2usd.layout.floor.stains import floor_repairs, floor_stains
from garage2usd.layout.floor.stall_numbers import stall_numbers
from garage2usd.layout.parking.car_details import number_plates, opened
from garage2usd.layout.parking.designation import chargers
from garage2usd.layout.parking.loose_objects import clutter, no_parking_signs
from garage2usd.layout.parking.other_vehicles import park_motorbikes, with_own_cars
from garage2usd.layout.parking.parked_cars import park_cars
from garage2usd.layout.parking.stalls import stall_panels, tight_stalls, wheel_stops
from garage2usd.layout.parking.zone_plates import zone_plates
from garage2usd.layout.placement import PlacedStall, Placement
from garage2usd.layout.shell.building import with_boards
from garage2usd.layout.shell.mounts import mounted_objects
from garage2usd.layout.shell.ramps import ramp_lights, with_barriers, with_ramps
from garage2usd.layout.shell.well import Well, fire_shutters
from garage2usd.layout.tiles import TileGrid, Tiles
from garage2usd.objects.exit_sign import ExitSignSpec
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.objects.level_plate import LevelPlateSpec
from garage2usd.objects.level_sign import LevelSignSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.profiles import Profile
from garage2usd.structure.grid import Cell

_IN_WORDS = ExitSignSpec | HydrantCabinetSpec | LevelPlateSpec | LevelSignSpec | PortalSpec


def country_of(signs: SignsLook, profile: Profile) -> Country:
    """Return the country of a garage's signs, by its look and profile."""
    is_known = signs.of is SignsOf.PROFILE and profile.country in set(Country)
    return Country(profile.country) if is_known else Country.NONE


def with_signs_of(country: Country, parts: Iterable[Iterable[Placement]]) -> Iterator[Iterable[Placement]]:
    """Set the country of all signs among the objects, for its texts, colours and numbers."""
    for part in parts:
        yield (
            replace(each, spec=replace(each.spec, country=country))
            if country and isinstance(each.spec, _IN_WORDS)
            else each
            for each in part
        )


@dataclass(frozen=True, eq=False)
class Floor:
    """A floor of a building in metres, of a plan or of a survey.

    Attributes
    ----------
    tiles
        Pieces of the floor: lanes, portals, stalls and free ground.
    lanes
        Its lane graph.
    stalls
        Its stalls.
    quads
        The stalls in the form of `garage2usd.garage`.
    shell, pillars, blocks
        Its outer walls with closed doors, its columns, and its obstacles and stair cores.
    ceilings, beams
        The slabs over it, and the beams below them.
    cores, shafts
        Its stair cores, and the shafts of lower levels' cores that have no door here.
    area_m2
        The area that is lit.
    draws
        Random numbers of each tile.
    laid
        Function from the panels of the pieces to those of the floor: for a survey, cut at its tiles.
    well
        The ramps to other levels; None in a building of one level, and of a survey.
    ramps, ramp_tubes
        The ramps of a survey up from it, and the lights over them.
    """

    tiles: Tiles
    lanes: LaneGraph
    stalls: tuple[PlacedStall, ...]
    quads: tuple[Stall, ...]
    shell: list[Placement]
    pillars: list[Placement]
    blocks: list[Placement]
    ceilings: list[Placement]
    beams: list[Placement]
    cores: tuple[Core, ...]
    shafts: tuple[Core, ...]
    area_m2: float
    draws: SquareDraws
    laid: Callable[[list[Placement]], Iterable[Placement]]
    well: Well | None = None
    ramps: Sequence[Placement] = ()
    ramp_tubes: Sequence[Placement] = ()

    @property
    def squares(self) -> TileGrid | None:
        """The tiles if they are the squares of a plan; else None."""
        return self.tiles if isinstance(self.tiles, TileGrid) else None


class Furnishing(NamedTuple):
    """The objects placed on a floor.

    Attributes
    ----------
    objects
        All objects in groups, made on iteration: those of tiles in reading order, then those of the building.
    illuminance
        Illuminance of lanes and stalls.
    reaching, misparked
        As in `garage2usd.layout.Layout`.
    """

    objects: Iterator[Iterable[Placement]]
    illuminance: LightLevels
    reaching: Mapping[str, str]
    misparked: frozenset[str]


def furnished(  # noqa: PLR0915 - a statement or two for each kind of object
    floor: Floor,
    config: GarageConfig,
    look: LookConfig,
    *,
    held_back: Collection[str] = (),
    kept_clear: shapely.Geometry | None = None,
    open_boots: Collection[str] = (),
) -> Furnishing:
    """Place every object of a floor.

    Parameters
    ----------
    floor
        The floor.
    config
        Fittings, parking and seed.
    look
        Look of the level, with the values that the seed drew.
    held_back, kept_clear, open_boots
        As for `garage2usd.layout.lay_out`.
    """
    fittings, seed = config.fittings, config.seed
    tiles, stalls, draws, well = floor.tiles, floor.stalls, floor.draws, floor.well
    levels, ceiling = ceiling_levels(fittings), fittings.ceiling_height_m
    built: Sequence[Core] = [*floor.cores, *floor.shafts]
    core_on = {core.square: core for core in built if core.recess_m or not core.has_door}
    lamps, illuminance = light_up(
        installed_lamps(tube_lights(tiles, fittings, levels, core_on), look.lights, draws, seed=seed),
        lane_points_of((tile.x_m, tile.z_m, tile.width_m, tile.depth_m) for tile in tiles if tile.cell is Cell.LANE),
        floor.area_m2,
        stalls,
        fittings,
    )
    country = country_of(look.signs, config.standard)
    tight = tight_stalls(floor.lanes, floor.quads)
    parked = with_own_cars(
        park_cars(stalls, config, draws, tight=tight, held_back=held_back), stalls, config.vehicles, draws
    )
    cars = [opened(car) if car.stall in open_boots else car for car in parked.cars]
    motorbikes = park_motorbikes(stalls, config.parking, draws)

    def on_the_floor() -> Iterator[Iterable[Placement]]:
        # what lies on the lanes decides what is painted there
        crossings = crossings_to(floor.cores, tiles)
        bumps = speed_bumps(tiles, fittings, config.standard, seed=seed, crossings=crossings)
        drawn = drawn_markings_of(tiles, look.markings, draws)
        panels = floor_panels(tiles, look.markings, drawn, bumps=bumps, crossings=crossings, cores=core_on)
        yield floor.laid(panels)
        yield (drained := list(drains(tiles, panels, look.floor.drains)))
        yield floor_stains(tiles, panels, stalls, fittings, draws, look.floor.dirt, drained)
        if look.floor.finish is FloorFinish.PATCHED:
            yield floor_repairs(panels, draws, drained)
        yield puddles(tiles, look.floor.wet, drained, bumps, draws)
        # a coat on the stalls covers what was painted before it
        yield stall_panels(stalls, look.markings, tiles, drawn.ghosts if look.floor.bays == AISLE else {})
        yield wheel_stops(stalls, fittings, config.standard)
        yield [*cars, *motorbikes, *number_plates(stalls, cars, draws, country)]
        yield closing
        yield stall_numbers(stalls, floor.squares, look, fittings)
        yield charging
        yield bumps
        yield signs

    def under_the_ceiling() -> Iterator[Iterable[Placement]]:
        yield floor.ceilings
        yield lamps
        yield floor.beams
        yield ducts(tiles, ceiling, levels, look.ceiling)
        yield cable_trays(tiles, ceiling, levels)
        yield sprinklers(tiles, ceiling, levels)
        yield exit_signs(tiles, fittings, levels, well)
        yield lane_signs(tiles, fittings, levels)
        yield level_signs(tiles, fittings, levels, well) if well else ()
        yield mirrors(tiles, floor.pillars, fittings, levels)

    def of_the_building() -> Iterator[Iterable[Placement]]:
        inner = with_ramps(floor.shell, tiles.ground, fittings, look.walls)
        walls, gates = with_barriers(inner, fittings, floor.beams, tiles.mouths)
        yield from (walls, gates)
        tubes = ramp_lights(walls, fittings)
        if well and floor.squares:
            structure = floor.squares.structure
            yield (guards := well.walls(structure, fittings, look.walls))
            yield [*well.ramps(structure, fittings), *well.ceilings(structure, fittings)]
            yield fire_shutters(well, structure, fittings)
            walls, tubes = [*walls, *well.beside_floors(guards)], [*tubes, *well.tubes(structure, fittings)]
        yield floor.ramps
        tubes = [*tubes, *floor.ramp_tubes]
        yield ramp_lamps(tubes, look.lights, illuminance.luminance_nit, seed=seed)
        yield floor.blocks
        hung = mounted_objects(
            tiles, floor.pillars, walls, floor.blocks, stalls, floor.cores, [*closing, *signs], config
        )
        yield with_boards(floor.pillars, hung)
        yield zone_plates(floor.pillars, walls, floor.blocks, stalls) if fittings.zones else ()
        yield level_plates(floor.cores, well) if well else ()
        yield hung
        if kept_clear is not None:
            standing = [*floor.pillars, *walls, *floor.blocks, *cars, *motorbikes, *closing, *charging, *signs, *gates]
            yield clutter(tiles, stalls, floor.cores, standing, hung, config, kept_clear=kept_clear)

    closing = cones(tiles, stalls, parked.touched, fittings, draws, built_on=core_on)
    charging = chargers(stalls)
    signs = no_parking_signs(tiles, floor.shell, built, fittings, seed=seed)
    parts = (part for room in (on_the_floor(), under_the_ceiling(), of_the_building()) for part in room)
    return Furnishing(with_signs_of(country, parts), illuminance, parked.reaching, parked.misparked)
