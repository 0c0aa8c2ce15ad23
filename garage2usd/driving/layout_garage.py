"""A layout and its lane graph as a garage for driving: proofs of stalls, unreachable stalls, and clutter."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.driving.assembly import StandingThing, assembled
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.garage import DrivenGarage, StallProof, prove_garage
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.proof import Limits, Outcome
from garage2usd.layout import Layout, Placement
from garage2usd.layout.grounds import Grounds
from garage2usd.layout.parking.open_boots import stalls_of_open_boots

__all__ = [
    "layout_garage",
    "object_name",
    "prove_stalls",
    "with_clutter",
    "with_truth_of_misparked",
    "without_unreachable",
]

_CLEAR_M = 0.1
"""Distance in metres between clutter and proven manoeuvres: twice the margin of the proof."""
_STEP_M = 0.25


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


def without_unreachable(layout: Layout, config: GarageConfig, *, progress: Progress = silent) -> Layout:
    """Repeat the layout with unreachable stalls marked or removed.

    Parameters
    ----------
    layout, config
        The garage; ``plan.unreachable_stalls`` selects marking or removal.
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
        found = {proof.stall for proof in proofs if not proof.is_proven}
        if not found and not unreachable:
            return given
        if not found:
            if config is not asked:
                layout = layout.source.again(asked, unreachable=unreachable)
            return replace(layout, undecided=frozenset(undecided))
        undecided.update(proof.stall for proof in proofs if proof.outcome is Outcome.UNDECIDED)
        # a charger, an access aisle or a car that went elsewhere may stand in another's way
        unreachable |= found
        layout = layout.source.again(config, unreachable=unreachable)


def with_truth_of_misparked(layout: Layout, config: GarageConfig, *, progress: Progress = silent) -> Layout:
    """Return the layout with proven reachability of the stalls next to misparked cars.

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
