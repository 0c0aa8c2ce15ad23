"""A layout as a garage for driving: its proofs of stalls, and the refusal of one with unreachable stalls."""
# Over 300 lines: assembly, proofs and refusal follow one another, and share what a layout leaves out.

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import DrivenGarage, StallProof, prove_garage
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.proof import Limits, Outcome
from garage2usd.garage import LaneGraph, Stall, StallUse
from garage2usd.layout import Layout, Placement
from garage2usd.layout.grounds import Grounds
from garage2usd.layout.parking.car_details import stalls_of_open_boots
from garage2usd.objects import CAR_LABELS

BELONGINGS = frozenset({*CAR_LABELS, "wheel_stop", "traffic_cone"})
"""Semantic classes of objects that do not obstruct a car parking in the stall around them."""
_CLEAR_M = 0.1
"""Distance in metres between clutter and proven manoeuvres: twice the margin of the proof."""
_STEP_M = 0.25
_MOST_TRIED, _NAMED = 24, 5


class StandingThing(NamedTuple):
    """An object on the floor that a car could touch.

    Attributes
    ----------
    name
        Unique name in the garage.
    label
        Semantic class.
    ground
        Footprint on the floor, (x, z) in metres.
    home
        Name of the stall that contains the object, if any; used for `BELONGINGS` only.
    """

    name: str
    label: str
    ground: shapely.Geometry
    home: str | None = None


def assembled(stalls: Iterable[Stall], lanes: LaneGraph, standing: Iterable[StandingThing]) -> DrivenGarage:
    """Assemble the garage for driving.

    Parameters
    ----------
    stalls
        All stalls. Those for motorcycles are obstacles, as no car is proven to enter them.
    lanes
        The lanes.
    standing
        Obstacles, including the parked cars.
    """
    stalls = tuple(stalls)
    # cars keep off stalls for motorcycles, taken or not
    kept_off = [StandingThing(at.name, at.use, at.polygon) for at in stalls if at.use is StallUse.MOTORCYCLE]
    # the proof names what is in the way in the order of the obstacles, and cars last
    things = sorted([*standing, *kept_off], key=lambda thing: thing.label in CAR_LABELS)
    own: dict[str, tuple[str, ...]] = {}
    for thing in things:
        if thing.label in BELONGINGS and thing.home is not None:
            own[thing.home] = (*own.get(thing.home, ()), thing.name)
    return DrivenGarage(
        tuple(stall for stall in stalls if stall.takes_cars),
        lanes,
        Obstacles.of((thing.name, thing.ground) for thing in things),
        frozenset(thing.home for thing in things if thing.label in CAR_LABELS and thing.home is not None),
        own,
    )


def prove_stalls(
    layout: Layout,
    *,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    most_explained: int | None = None,
    progress: Progress = silent,
) -> tuple[StallProof, ...]:
    """Prove for each stall of a layout that a car can drive in and out.

    Parameters
    ----------
    layout
        The garage.
    car, limits, most_explained, progress
        As for `garage2usd.driving.prove_garage`.

    Returns
    -------
    tuple of StallProof
        One for each stall that takes cars, in the order of the stalls.
    """
    garage = layout_garage(layout)
    return prove_garage(garage, car=car, limits=limits, most_explained=most_explained, progress=progress)


def without_unreachable(
    layout: Layout, config: GarageConfig, *, in_full: bool = False, progress: Progress = silent
) -> Layout:
    """Repeat the layout with unreachable stalls marked or removed.

    Parameters
    ----------
    layout, config
        The garage; ``plan.unreachable_stalls`` selects marking or removal.
    in_full
        True if a stall also counts as unreachable where a car gets into it only while others are free.
    progress
        As for `garage2usd.driving.prove_garage`.

    Raises
    ------
    ConfigError
        If no stall is left, or the configuration names a removed stall.
    """
    unreachable: set[str] = set()
    undecided: set[str] = set()
    given, asked, config = layout, config, _with_cars_between_lines(config)
    layout = layout if config is asked else layout.source.again(config)
    while True:
        proofs = prove_stalls(layout, progress=progress)
        found = {proof.stall for proof in proofs if not (proof.is_full if in_full else proof.is_proven)}
        if not found and not unreachable:
            return given
        if not found:
            if config is not asked:
                layout = layout.source.again(asked, unreachable=unreachable)
            return replace(layout, undecided=frozenset(undecided))
        undecided.update(proof.stall for proof in proofs if proof.outcome is Outcome.UNDECIDED)
        # chargers, access aisles and cars that moved elsewhere may now block other stalls
        unreachable |= found
        layout = layout.source.again(config, unreachable=unreachable)


def with_truth_of_misparked(layout: Layout, config: GarageConfig, *, progress: Progress = silent) -> Layout:
    """Return the layout with a proof for each stall beside a misparked car: reachable or blocked.

    Parameters
    ----------
    layout, config
        The garage.
    progress
        As for `garage2usd.driving.prove_garage`.

    Returns
    -------
    Layout
        If the design car cannot drive into a stall while all others are taken, cars that slightly overhang its lines
        are moved between their own lines. A stall that stays unreachable beside a misparked car is `blocked`.
    """
    held_back: set[str] = set()
    while layout.reaching:
        garage, reached = layout_garage(layout), set(layout.reaching.values())
        proofs = prove_garage(
            garage, [at for at in garage.stalls if at.name in reached], most_explained=0, progress=progress
        )
        needed = {proof.stall for proof in proofs if not proof.is_full}
        found = {car for car, stall in layout.reaching.items() if stall in needed and car not in layout.misparked}
        if not found:
            blocking = {stall: car for car, stall in layout.reaching.items()}
            blocked = {proof.stall: blocking[proof.stall] for proof in proofs if not proof.is_proven}
            return replace(layout, blocked=blocked)
        held_back |= found
        layout = layout.source.again(config, unreachable=layout.unreachable, held_back=held_back)
    return layout


def _with_cars_between_lines(config: GarageConfig) -> GarageConfig:
    """Return the configuration without parked cars that overhang a line."""
    parking = config.parking
    if not (parking.over_line or parking.misparked):
        return config
    return config.model_copy(update={"parking": parking.model_copy(update={"over_line": 0.0, "misparked": 0.0})})


def with_clutter(
    layout: Layout,
    config: GarageConfig,
    *,
    cars: Iterable[DesignCar] = (DesignCar(),),
    progress: Progress = silent,
) -> Layout:
    """Repeat the layout with people and clutter, none of them on a proven manoeuvre.

    Parameters
    ----------
    layout, config
        The garage without clutter, and the amount of clutter.
    cars
        The cars whose manoeuvres are kept clear.
    progress
        As for `garage2usd.driving.prove_garage`.

    Notes
    -----
    The swept paths of all proven stalls are kept clear with a margin, so that the proofs remain valid.
    """
    swept: dict[str, list[shapely.Geometry]] = {}
    for car in dict.fromkeys(cars):
        for proof in prove_stalls(layout, car=car, progress=progress):
            ways = (way for way in (proof.way_in, proof.way_out) if way is not None and way.moves)
            swept.setdefault(proof.stall, []).extend(hull for way in ways for hull in _swept(way, car))
    of_stall = {stall: shapely.buffer(shapely.union_all(hulls), _CLEAR_M) for stall, hulls in swept.items()}
    open_boots = stalls_of_open_boots(
        layout.placements,
        layout.stalls,
        swept=of_stall,
        per_hundred=config.clutter.per_hundred("open_boots"),
        seed=config.seed,
    )
    cluttered = layout.source.again(
        config,
        unreachable=layout.unreachable,
        held_back=layout.held_back,
        kept_clear=shapely.union_all(list(of_stall.values())),
        open_boots=open_boots,
    )
    return replace(cluttered, blocked=layout.blocked)


def _swept(way: Manoeuvre, car: DesignCar) -> Grounds:
    """Return a car's swept path along a manoeuvre as one convex hull per step."""
    poses, _ = way.poses(_STEP_M)
    corners = np.array([car.corners(Pose(*pose)) for pose in poses.tolist()])
    pairs = np.concatenate([corners[:-1], corners[1:]], axis=1)
    hulls: Grounds = shapely.convex_hull(shapely.multipoints(pairs))
    return hulls


def layout_garage(layout: Layout) -> DrivenGarage:
    """Convert a layout to a garage for driving: stalls that take cars, lanes, and obstacles by `object_name`."""
    return assembled(layout.quads, layout.lane_graph, _standing(layout))


def object_name(place: Placement) -> str:
    """Return the unique name of an object in a layout: ``r03_c07/Car_2`` on a square, else its own."""
    if place.square is None:
        return place.name
    row, col = place.square
    return f"r{row:02d}_c{col:02d}/{place.name}"


def _standing(layout: Layout) -> Iterator[StandingThing]:
    """Return all obstacles of a layout.

    Notes
    -----
    Wheel stops are included, since no tyre crosses them; the arms of gates are down. Speed bumps, overhead objects and
    paint are not included.
    """
    objects = layout.placements
    is_touched = np.array([bool(spec.outlines()) for spec in objects.specs])
    for place in objects.at(np.flatnonzero(is_touched[objects.spec])):
        ground = shapely.MultiPolygon([shapely.Polygon(outline) for outline in place.outlines()])
        yield StandingThing(object_name(place), place.spec.kind.label, ground, place.stall)


def refuse_undrivable(
    layout: Layout,
    config: GarageConfig,
    tight: Sequence[Stall],
    *,
    progress: Progress = silent,
) -> None:
    """Raise an error if a car cannot drive into one of the stalls in doubt and out of it.

    Parameters
    ----------
    layout, config
        The garage.
    tight
        The stalls in doubt; at most 24 of them, spread evenly, are tried.
    progress
        Function called for each stall.

    Raises
    ------
    ConfigError
        If manoeuvres are missing; names the setting of the aisle's width and the stalls.
    """
    every = max(1, -(-len(tight) // _MOST_TRIED))
    garage = layout_garage(layout)
    names = {stall.name for stall in tight[::every]}
    tried = [at for at in garage.stalls if at.name in names]
    proofs = prove_garage(garage, tried, most_explained=0, progress=progress)
    without = {proof.stall for proof in proofs if not proof.is_proven}
    if not without:
        return
    found = [stall for stall in tight if stall.name in without]
    narrowest_m = min(layout.lane_graph.clear_aisle_m(stall.access, stall.outwards) for stall in found)
    named = _named([stall.name for stall in found])
    undecided = [proof.stall for proof in proofs if proof.outcome is Outcome.UNDECIDED]
    open_ = f" (undecided, as the search ended at its bound: {_named(undecided)})" if undecided else ""
    field, value = _setting(config, found[0])
    raise ConfigError(
        field,
        value,
        f"aisles and stalls that the design car of 4.8 x 1.8 m gets into: it gets into {len(tried) - len(found)} of "
        f"{len(tried)} that were tried, not into {named}{open_}; their aisles are {narrowest_m:.2f} m clear, 5.5 m are "
        f"enough for stalls of 2.4 m; plan.unreachable_stalls = 'mark', 'drop' or 'keep' builds it nevertheless",
    )


def _named(stalls: Sequence[str]) -> str:
    return ", ".join(stalls[:_NAMED]) + (", ..." if len(stalls) > _NAMED else "")


def _setting(config: GarageConfig, stall: Stall) -> tuple[str, object]:
    """Return the setting that determines the aisle of a stall, and its value."""
    bay = config.bay
    x, z = stall.outwards
    key = "row_depths_m" if abs(z) > abs(x) else "column_widths_m"
    if getattr(bay, key) is not None:
        return f"bay.{key}", getattr(bay, key)
    if bay.dimensioned:
        return "bay.stall_width_m", bay.stall_width_m
    return "bay.square_side_m", bay.square_side_m
