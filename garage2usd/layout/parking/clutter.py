"""People and things on the ground that nobody drives or parks on, beside what they lean on or belong to."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
import shapely

from garage2usd.assets import pascal_case
from garage2usd.assets.figures import POSES
from garage2usd.common.randomness import Step, named_generator
from garage2usd.config import GarageConfig
from garage2usd.layout.egress.cores import Core
from garage2usd.layout.grounds import grounds_of
from garage2usd.layout.placement import PlacedStall, Placement, placed
from garage2usd.layout.shell.building import ground_inside
from garage2usd.layout.shell.mounts import carriageway, core_and_landing
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects.bag import BagSort, BagSpec
from garage2usd.objects.bicycle import BICYCLE_COLOURS, BicycleSpec
from garage2usd.objects.cardboard_box import BOX_SIZES_M, BoxSpec
from garage2usd.objects.kind import Spec
from garage2usd.objects.motorbike import MOTORBIKE_COLOURS, MotorbikeSpec
from garage2usd.objects.pallet import PalletSpec
from garage2usd.objects.person import PEOPLE, PersonSpec
from garage2usd.objects.pram import PRAM_COLOURS, PramSpec
from garage2usd.objects.trolley import TrolleySpec
from garage2usd.objects.waste_bin import BIN_COLOURS, BinSpec
from garage2usd.structure.grid import Cell

__all__ = ["clutter"]

_QUARTER_TURN = np.pi / 2
_TRIES = 600
"""Points that are drawn for each object."""
_APART_M = 0.03
"""What is left around it."""
_LINE_M = 0.01
"""What is left beside stalls and carriageways."""
_LEAST_WIDTH_M = 0.16
"""Narrower ground holds nothing."""
_BEFORE_EQUIPMENT_M = 0.65
"""What is left before what hangs on walls and columns, so that people get there."""
_DOOR_M = 1.2
"""What is left around the middle of the door of a core, whose leaf of a metre reaches 1.12 m from there."""


_T = TypeVar("_T")
_PALLETS = ((1, False), (3, False), (6, False), (1, True), (2, True))


class _Sort(NamedTuple):
    """What a setting of `garage2usd.config.ClutterConfig` counts: a shape drawn, and whether any turn will do."""

    setting: str
    drawn: Callable[[np.random.Generator], Spec]
    is_turned_freely: bool = False


def _motorbike(rng: np.random.Generator) -> MotorbikeSpec:
    return MotorbikeSpec(_one_of(rng, MOTORBIKE_COLOURS), is_scooter=bool(rng.integers(2)))


def _person(rng: np.random.Generator) -> PersonSpec:
    return PersonSpec(int(rng.integers(len(PEOPLE))), _one_of(rng, tuple(POSES)))


def _one_of(rng: np.random.Generator, choices: Sequence[_T]) -> _T:
    return choices[int(rng.integers(len(choices)))]


_SORTS: tuple[_Sort, ...] = (
    _Sort("pallets", lambda rng: PalletSpec(*_PALLETS[int(rng.integers(len(_PALLETS)))])),
    _Sort("bins", lambda rng: BinSpec(_one_of(rng, BIN_COLOURS))),
    _Sort("motorbikes", _motorbike),
    _Sort("bicycles", lambda rng: BicycleSpec(_one_of(rng, BICYCLE_COLOURS))),
    _Sort("trolleys", lambda rng: TrolleySpec((1, 1, 1, 3)[int(rng.integers(4))])),
    _Sort("prams", lambda rng: PramSpec(_one_of(rng, PRAM_COLOURS))),
    _Sort(
        "people",
        _person,
        is_turned_freely=True,
    ),
    _Sort("bags", lambda rng: BagSpec(_one_of(rng, tuple(BagSort))), is_turned_freely=True),
    _Sort("boxes", lambda rng: BoxSpec(*BOX_SIZES_M[int(rng.integers(len(BOX_SIZES_M)))])),
)
"""Large ones first, which find less room."""


def clutter(
    grid: TileGrid,
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    hung: Iterable[Placement],
    config: GarageConfig,
    *,
    kept_clear: shapely.Geometry,
) -> list[Placement]:
    """People and things, as many as `config.clutter` asks for where there is room.

    Parameters
    ----------
    grid, stalls, cores
        The garage.
    standing
        All that a car could touch, the cars included.
    hung
        What hangs on walls and columns, which stays within reach.
    config
        How many there are of each sort, and the seed.
    kept_clear
        The ground (x, z) that cars need on their ways into stalls and out.

    Notes
    -----
    Each sort draws places from a generator of its own. A place is taken whose outline lies on the ground inside that
    is kept clear for nobody: no carriageway, portal, stall or landing of a core, on no proven way, and where nothing
    else stands.
    """
    counts = {sort.setting: config.clutter.per_hundred(sort.setting) * len(stalls) / 100 for sort in _SORTS}
    if not any(counts.values()):
        return []
    free = _free_grounds(grid, stalls, cores, standing, hung, kept_clear)
    found: list[Placement] = []
    for sort in _SORTS:
        rng = named_generator(config.seed, Step.CLUTTER, sort.setting)
        # the share of one more that is left is a chance
        wanted = int(counts[sort.setting] + rng.random())
        for number in range(1, wanted + 1):
            spec = sort.drawn(rng)
            place = _place(spec, free, rng, f"{pascal_case(spec.kind.name)}_{number}", is_free=sort.is_turned_freely)
            if place is not None:
                found.append(place)
    return found


def _free_grounds(
    grid: TileGrid,
    stalls: Sequence[PlacedStall],
    cores: Iterable[Core],
    standing: Iterable[Placement],
    hung: Iterable[Placement],
    kept_clear: shapely.Geometry,
) -> list[shapely.Polygon]:
    """The pieces of ground that nobody needs, in the order of their places."""
    cores = tuple(cores)
    driven = [carriageway(tile, grid.setback_m) for tile in grid if tile.cell is not Cell.FREE]
    parked = grounds_of([stall.corners_m() for stall in stalls])
    touched = grounds_of([outline for place in standing for outline in place.outlines()])
    reached = grounds_of([outline for place in hung for outline in place.outlines()])
    used = [
        kept_clear,
        *shapely.buffer([*driven, *parked], _LINE_M, join_style="mitre"),
        *grounds_of([core_and_landing(core) for core in cores]),
        *(shapely.Point(core.door_m).buffer(_DOOR_M) for core in cores),
        *shapely.buffer(touched, _APART_M),
        *shapely.buffer(reached, _BEFORE_EQUIPMENT_M),
    ]
    free = ground_inside(grid.structure).difference(shapely.union_all(used))
    return sorted(_wide_pieces(free), key=lambda piece: piece.bounds)


def _wide_pieces(ground: shapely.Geometry) -> list[shapely.Polygon]:
    """The pieces of ground that are wide enough for anything."""
    pieces = shapely.get_parts(shapely.normalize(ground))
    return [piece for piece in pieces if not piece.buffer(-_LEAST_WIDTH_M / 2).is_empty]


def _place(
    spec: Spec, free: list[shapely.Polygon], rng: np.random.Generator, name: str, *, is_free: bool
) -> Placement | None:
    """A place for a shape on one of the grounds, which is cut out of it there; None where none is found."""
    areas = np.array([ground.area for ground in free])
    if not areas.size:
        return None
    chosen = rng.choice(len(free), size=_TRIES, p=areas / areas.sum())
    draws = rng.random((_TRIES, 3))
    grounds = np.array(free, dtype=object)[chosen]
    bounds = shapely.bounds(grounds)
    points = bounds[:, :2] + draws[:, :2] * (bounds[:, 2:] - bounds[:, :2])
    for candidate in np.flatnonzero(shapely.contains_xy(grounds, points)).tolist():
        index, ground, turn = int(chosen[candidate]), grounds[candidate], float(draws[candidate, 2])
        yaw = turn * 4 * _QUARTER_TURN if is_free else int(turn * 4) * _QUARTER_TURN
        point = float(points[candidate, 0]), float(points[candidate, 1])
        place = placed(name, spec, point, yaw_rad=round(float(np.remainder(yaw + np.pi, 2 * np.pi) - np.pi), 6))
        taken = shapely.union_all(grounds_of(place.outlines()))
        if shapely.contains_properly(ground, taken):
            free[index : index + 1] = _wide_pieces(ground.difference(taken.buffer(_APART_M)))
            return place
    return None
