"""Loose objects on the floor: no-parking signs, people, bags, bins, bicycles, pallets, clear of the ways of cars."""

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
import shapely

from garage2usd.assets import pascal_case
from garage2usd.assets.poses import POSES
from garage2usd.common.randomness import Step, generator, named_generator
from garage2usd.config import FittingsConfig, GarageConfig
from garage2usd.config.site import DOOR_FRAME_M
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.grounds import grounds_of
from garage2usd.layout.parking.surroundings import ROOM_M, Surroundings
from garage2usd.layout.placement import PlacedStall, Placement, edge_yaw_rad, of_spec, placed, sum_of_yaws, to_world
from garage2usd.layout.shell.mounts import carriageway, core_and_landing
from garage2usd.layout.tiles import Tile, Tiles
from garage2usd.objects.bag import BagSort, BagSpec
from garage2usd.objects.bicycle import BICYCLE_COLOURS, BicycleSpec
from garage2usd.objects.cardboard_box import BOX_SIZES_M, BoxSpec
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.motorbike import MOTORBIKE_COLOURS, MotorbikeSpec
from garage2usd.objects.no_parking_sign import SIGN_FOOT_M, NoParkingSignSpec
from garage2usd.objects.pallet import PalletSpec
from garage2usd.objects.person import PEOPLE, PersonSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.objects.pram import PRAM_COLOURS, PramSpec
from garage2usd.objects.trolley import TrolleySpec
from garage2usd.objects.waste_bin import BIN_COLOURS, BinSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.stalls import Edge

_QUARTER_TURN = np.pi / 2
_TRIES = 600
"""Number of candidate points for each object."""
_CLEARANCE_M = 0.03
"""Clearance around an object."""
_LINE_M = 0.01
"""Clearance to stalls and carriageways."""
_LEAST_WIDTH_M = 0.16
"""Least width of usable ground."""
_BEFORE_EQUIPMENT_M = 0.65
"""Clearance in front of equipment on walls and columns, for access by people."""
_DOOR_M = 1.2
"""Clearance around the middle of a core's door; its leaf of one metre reaches 1.12 m from there."""
_T = TypeVar("_T")
_PALLETS = ((1, False), (3, False), (6, False), (1, True), (2, True))
_FROM_END_M = 0.35
_FROM_MOUTHS_M = 0.3
_FROM_JAMB_M, _FROM_WALL_M = 0.3, 0.4
_FROM_CORE_M = SIGN_FOOT_M + 0.1
"""Least distance of a sign's middle from a core: its foot keeps clear of the door's handle."""


class _ClutterKind(NamedTuple):
    """Kind of clutter: its setting in `garage2usd.config.ClutterConfig`, a random shape, any yaw, a way to look."""

    setting: str
    drawn: Callable[[np.random.Generator], Spec]
    has_any_yaw: bool = False
    looks: bool = False


def _random_motorbike(rng: np.random.Generator) -> MotorbikeSpec:
    """Return a random motorbike or scooter."""
    return MotorbikeSpec(_one_of(rng, MOTORBIKE_COLOURS), is_scooter=bool(rng.integers(2)))


def _random_person(rng: np.random.Generator) -> PersonSpec:
    """Return a random person in a random pose."""
    return PersonSpec(int(rng.integers(len(PEOPLE))), _one_of(rng, tuple(POSES)))


def _one_of(rng: np.random.Generator, choices: Sequence[_T]) -> _T:
    """Return one of several choices, uniformly."""
    return choices[int(rng.integers(len(choices)))]


_CLUTTER_KINDS: tuple[_ClutterKind, ...] = (
    _ClutterKind("pallets", lambda rng: PalletSpec(*_PALLETS[int(rng.integers(len(_PALLETS)))])),
    _ClutterKind("bins", lambda rng: BinSpec(_one_of(rng, BIN_COLOURS))),
    _ClutterKind("motorbikes", _random_motorbike),
    _ClutterKind("bicycles", lambda rng: BicycleSpec(_one_of(rng, BICYCLE_COLOURS))),
    _ClutterKind("trolleys", lambda rng: TrolleySpec((1, 1, 1, 3)[int(rng.integers(4))])),
    _ClutterKind("prams", lambda rng: PramSpec(_one_of(rng, PRAM_COLOURS))),
    _ClutterKind("people", _random_person, looks=True),
    _ClutterKind("bags", lambda rng: BagSpec(_one_of(rng, tuple(BagSort))), has_any_yaw=True),
    _ClutterKind("boxes", lambda rng: BoxSpec(*BOX_SIZES_M[int(rng.integers(len(BOX_SIZES_M)))])),
)
"""All kinds in descending size, since large objects fit in fewer places."""


def clutter(
    grid: Tiles,
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    hung: Iterable[Placement],
    config: GarageConfig,
    *,
    kept_clear: shapely.Geometry,
) -> list[Placement]:
    """Place people and things on free ground, up to the numbers of `config.clutter`.

    Parameters
    ----------
    grid, stalls, cores
        Squares in metres, stalls and cores of the garage.
    standing
        All objects on the floor, including cars.
    hung
        Equipment on walls and columns; access to it is kept clear.
    config
        Number of objects of each kind, and the seed.
    kept_clear
        Swept area (x, z) of cars on their ways into stalls and out.

    Notes
    -----
    Each kind draws places by rejection sampling from its own random generator. The outline of an object lies on free
    ground: inside the building, and outside of carriageways, portals, stalls, landings of cores, swept areas and other
    objects.
    """
    counts = {kind.setting: config.clutter.per_hundred(kind.setting) * len(stalls) / 100 for kind in _CLUTTER_KINDS}
    if not any(counts.values()):
        return []
    cores, standing, hung = tuple(cores), tuple(standing), tuple(hung)
    free = _free_grounds(grid, stalls, cores, standing, hung, kept_clear)
    found: list[Placement] = []
    for kind in _CLUTTER_KINDS:
        rng = named_generator(config.seed, Step.CLUTTER, kind.setting)
        # the fraction of an object is a probability
        wanted = int(counts[kind.setting] + rng.random())
        around = _surroundings(grid, cores, [*standing, *hung, *found]) if kind.looks and wanted else None
        for number in range(1, wanted + 1):
            spec = kind.drawn(rng)
            name = f"{pascal_case(spec.kind.name)}_{number}"
            place = _place(spec, free, rng, name, has_any_yaw=kind.has_any_yaw, around=around)
            if place is not None:
                found.append(place)
    return found


def _surroundings(grid: Tiles, cores: Iterable[Core], standing: Sequence[Placement]) -> Surroundings:
    """Return what people have around them before the first of them is placed."""
    cars, things = (
        grounds_of([outline for place in standing if (place.kind == "car") == is_car for outline in place.outlines()])
        for is_car in (True, False)
    )
    driven = [carriageway(tile, grid.setback_m) for tile in grid if tile.cell is not Cell.FREE]
    doors = [core.door_m for core in cores if core.has_door]
    return Surroundings(grid.ground, np.array(driven, dtype=object), doors, cars, things)


def _free_grounds(
    grid: Tiles,
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    hung: Iterable[Placement],
    kept_clear: shapely.Geometry,
) -> list[shapely.Polygon]:
    """Return the polygons of free ground, sorted by place."""
    driven = [carriageway(tile, grid.setback_m) for tile in grid if tile.cell is not Cell.FREE]
    parked = grounds_of([stall.corners_m() for stall in stalls])
    touched = grounds_of([outline for place in standing for outline in place.outlines()])
    reached = grounds_of([outline for place in hung for outline in place.outlines()])
    used = [
        kept_clear,
        *shapely.buffer([*driven, *parked], _LINE_M, join_style="mitre"),
        *grounds_of([core_and_landing(core) for core in cores]),
        *(shapely.Point(core.door_m).buffer(_DOOR_M) for core in cores),
        *shapely.buffer(touched, _CLEARANCE_M),
        *shapely.buffer(reached, _BEFORE_EQUIPMENT_M),
    ]
    free = grid.ground.difference(shapely.union_all(used))
    return sorted(_wide_pieces(free), key=lambda piece: piece.bounds)


def _wide_pieces(ground: shapely.Geometry) -> list[shapely.Polygon]:
    """Return the polygons of a ground that are at least `_LEAST_WIDTH_M` wide."""
    pieces = shapely.get_parts(shapely.normalize(ground))
    return [piece for piece in pieces if not piece.buffer(-_LEAST_WIDTH_M / 2).is_empty]


def _place(
    spec: Spec,
    free: list[shapely.Polygon],
    rng: np.random.Generator,
    name: str,
    *,
    has_any_yaw: bool,
    around: Surroundings | None,
) -> Placement | None:
    """Place a shape on one of the free polygons and cut its outline out of them; None if no candidate point fits."""
    areas = np.array([ground.area for ground in free])
    if not areas.size:
        return None
    chosen = rng.choice(len(free), size=_TRIES, p=areas / areas.sum())
    draws = rng.random((_TRIES, 3))
    grounds = np.array(free, dtype=object)[chosen]
    bounds = shapely.bounds(grounds)
    points = bounds[:, :2] + draws[:, :2] * (bounds[:, 2:] - bounds[:, :2])
    fitting = shapely.contains_xy(grounds, points)
    if around is not None:
        fitting &= around.has_room(points)
    for candidate in np.flatnonzero(fitting).tolist():
        index, ground, turn = int(chosen[candidate]), grounds[candidate], float(draws[candidate, 2])
        yaw: float | None = turn * 4 * _QUARTER_TURN if has_any_yaw else int(turn * 4) * _QUARTER_TURN
        point = float(points[candidate, 0]), float(points[candidate, 1])
        if around is not None:
            yaw = around.yaw_rad(point, turn)
        if yaw is None:
            continue
        place = placed(name, spec, point, yaw_rad=round(float(np.remainder(yaw + np.pi, 2 * np.pi) - np.pi), 6))
        taken = shapely.union_all(grounds_of(place.outlines()))
        if shapely.contains_properly(ground, taken):
            kept = taken if around is None else taken.union(shapely.Point(point).buffer(ROOM_M))
            free[index : index + 1] = _wide_pieces(ground.difference(kept.buffer(_CLEARANCE_M)))
            return place
    return None


def no_parking_signs(
    grid: Tiles, walls: Iterable[Placement], cores: Collection[Core], fittings: FittingsConfig, *, seed: int
) -> list[Placement]:
    """Place signs in the centre of some of the empty free squares, before each core, and beside each door.

    There are none if the share of such squares is 0.
    """
    rng = generator(seed, Step.SIGNS)
    built_on = {core.square for core in cores}
    signs = []
    for tile in grid:
        if tile.square in built_on or not grid.is_bare(tile):
            continue
        if rng.random() < fittings.no_parking_sign_rate and not _is_before_stall(grid, tile.middle_m):
            yaw = sum_of_yaws(float(rng.integers(4)) * _QUARTER_TURN, tile.yaw_rad)
            signs.append(_sign(tile.middle_m, yaw, tile.square))
    if fittings.no_parking_sign_rate > 0:
        signs += [_before_core(core) for core in cores if core.recess_m]
        signs += _beside_doors(grid, walls)
    return signs


def _before_core(core: Core) -> Placement:
    """Sign at the end of the landing that is not beside a stall, facing the lane."""
    away = -1 if core.along_m <= 0 else 1
    # a core's local +X is opposite to its edge's direction if it faces up or right
    turned = -1 if core.edge.name in {"UP", "RIGHT"} else 1
    across = turned * away * (core.width_m / 2 - _FROM_END_M)
    yaw = edge_yaw_rad(core.edge)
    ahead = core.depth_m / 2 + max(core.recess_m / 2, _FROM_CORE_M)
    return _sign(to_world((across, ahead), core.centre_m, yaw), yaw, core.square)


def _beside_doors(grid: Tiles, walls: Iterable[Placement]) -> list[Placement]:
    """Signs inside each vehicle door, on the side without a gate, unless cars turn to that side or into a stall."""
    portals = [grid.tiles[square] for square in grid.doors]
    signs = []
    for wall, door in of_spec(walls, PortalSpec):
        side = -1 if door.is_entrance else 1
        place = wall.to_world((side * (door.door_width_m / 2 - DOOR_FRAME_M + _FROM_JAMB_M), _FROM_WALL_M))
        at = wall.position_m[0], wall.position_m[2]
        portal = min(portals, key=lambda tile: round(math.dist(tile.middle_m, at), 6))
        if door.is_entrance is None or _is_before_stall(grid, place):
            continue
        if not portal.drivable[_beside(portal, at, place)]:
            signs.append(_sign(place, wall.yaw_rad, portal.square))
    return signs


def _is_before_stall(grid: Tiles, place: Point) -> bool:
    return grid.mouths is not None and bool(grid.mouths.dwithin(shapely.Point(place), _FROM_MOUTHS_M))


def _beside(portal: Tile, door: Point, place: Point) -> Edge:
    """Edge of a door's piece of floor on the side of a point, as seen from the door's centre."""
    (door_x, door_z), (x, z) = portal.local(door), portal.local(place)
    is_along_x = abs(door_z) / portal.half_z_m > abs(door_x) / portal.half_x_m
    low, high = (Edge.LEFT, Edge.RIGHT) if is_along_x else (Edge.UP, Edge.DOWN)
    return low if (x - door_x if is_along_x else z - door_z) < 0 else high


def _sign(place: Point, yaw_rad: float, square: Square) -> Placement:
    return placed("NoParkingSign", NoParkingSignSpec(), place, yaw_rad=yaw_rad, square=square)
