"""Rules of safety: light, fire compartments, exits within reach, and fire-fighting equipment."""

import math
from collections import Counter, defaultdict
from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.core_reader import core_doors
from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out, where_structure_is_known
from garage2usd.garage import Point
from garage2usd.layout.egress.exits import compartment_name
from garage2usd.layout.grounds import Points, distances_m
from garage2usd.objects import MOUNTED, Mounted
from garage2usd.profiles import Area, Length, Profile, Severity

BOOK = RuleBook()
DEAD_LAMPS = "lamps give no light"
"""End of a message that names dead lamps as the cause."""
_ROUNDING = 0.99
_HYDRANT = "hydrant_cabinet"


def _dark(what: str, level: BuiltLevel) -> str:
    """Return the message that lanes or stalls are too dark, with the number of dead lamps as a possible cause."""
    because = f": {level.dead_lamps} of {level.lamps} {DEAD_LAMPS}" if level.dead_lamps else ""
    return f"the {what} are too dark{because}"


def _lights_are_told(level: BuiltLevel, _: Profile) -> str:
    """Explain why illuminance cannot be checked: the plan has no layout, or the stage has no lights."""
    return "" if level.lane_lux is not None else "no illuminance of the floor is known"


@BOOK.rule(
    "lane-illuminance",
    "lane_illuminance",
    asks="the lanes' floor is bright enough",
    hindrance=_lights_are_told,
    in_surveys=Severity.WARNING,
)
def _lanes(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.lane_illuminance, level.lane_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("lanes", level), measured, required.amount)


@BOOK.rule(
    "stall-illuminance",
    "stall_illuminance",
    asks="the stalls' floor is bright enough",
    hindrance=_lights_are_told,
    in_surveys=Severity.WARNING,
)
def _stalls(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required, measured = profile.stall_illuminance, level.stall_lux
    if required and measured is not None and measured < required.amount * _ROUNDING:
        yield Miss("", None, _dark("stalls", level), measured, required.amount)


def _floor_is_told(level: BuiltLevel, profile: Profile) -> str:
    return where_laid_out(level, profile) or where_structure_is_known(level, profile)


def _area_applies(level: BuiltLevel, profile: Profile) -> str:
    """Explain why the area of fire compartments cannot be checked, as without sprinklers and a clause for that case."""
    told = _floor_is_told(level, profile)
    return told or _applies(level, plain=profile.fire_compartment_area is not None)


def _distance_applies(level: BuiltLevel, profile: Profile) -> str:
    return where_laid_out(level, profile) or _applies(level, plain=profile.exit_distance is not None)


def _applies(level: BuiltLevel, *, plain: bool) -> str:
    return "" if plain or _has_sprinklers(level) else "the garage has no sprinklers"


@BOOK.rule(
    "fire-compartment",
    "fire_compartment_area",
    "fire_compartment_area_sprinklered",
    asks="each fire compartment, or the floor where none are declared, is small enough",
    hindrance=_floor_is_told,
)
def _compartment(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if level.things and not (_has_sprinklers(level) and profile.fire_compartment_area_sprinklered):
        yield from _too_large(level, profile.fire_compartment_area)


@BOOK.rule(
    "fire-compartment-sprinklered",
    "fire_compartment_area_sprinklered",
    asks="each fire compartment, or the floor where none are declared, is small enough with sprinklers",
    hindrance=_area_applies,
)
def _sprinklered_compartment(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(level):
        yield from _too_large(level, profile.fire_compartment_area_sprinklered)


@BOOK.rule(
    "personnel-exits",
    "personnel_exits",
    asks="people have enough exits in each fire compartment",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _count(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.personnel_exits is None or not level.things:
        return
    doors = core_doors(level)
    on = Counter(level.compartment_at(level.lanes.nodes[door.node].position) for door in doors)
    for number in level.compartment_areas_m2():
        count = on[number]
        if count < profile.personnel_exits.amount:
            yield Miss(
                _name(number), None, "too few doors of stair cores onto lanes", count, profile.personnel_exits.amount
            )


@BOOK.rule(
    "exit-distance",
    "exit_distance",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _distance(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if level.things and not (_has_sprinklers(level) and profile.exit_distance_sprinklered):
        yield from _too_far(level, profile.exit_distance, profile)


@BOOK.rule(
    "exit-distance-sprinklered",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people where there are sprinklers",
    hindrance=_distance_applies,
    in_surveys=Severity.WARNING,
)
def _sprinklered_distance(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(level):
        yield from _too_far(level, profile.exit_distance_sprinklered, profile)


def _too_large(level: BuiltLevel, clause: Area | None) -> Iterator[Miss]:
    if clause is None or level.structure is None:
        return
    for number, measured in level.compartment_areas_m2().items():
        if measured > clause.amount:
            name = _name(number)
            parts = math.ceil(measured / clause.amount)
            what = f"the fire compartment {name}" if name else "the floor"
            yield Miss(name, None, f"{what} needs {parts} fire compartments", measured, clause.amount)


def _too_far(level: BuiltLevel, clause: Length | None, profile: Profile) -> Iterator[Miss]:
    """Yield the stall of each fire compartment farthest from an exit as the crow flies, if it is too far."""
    if clause is None or not level.stalls:
        return
    exits = defaultdict(list)
    for door in core_doors(level):
        exits[level.compartment_at(level.lanes.nodes[door.node].position)].append(door.position)
    stalls = defaultdict(list)
    for stall in level.stalls:
        stalls[level.compartment_at(stall.centre)].append(stall)
    for number, own in stalls.items():
        doors = exits[number]
        if not doors:
            if profile.personnel_exits is None:  # else `personnel-exits` reports it
                yield Miss(_name(number), None, "no door of a stair core is there to be reached")
            continue
        farthest = max(own, key=lambda stall: _nearest(stall.centre, doors))
        measured = _nearest(farthest.centre, doors)
        if measured > clause.amount + ROUNDING_M:
            message = "the farthest stall is too far from the doors of stair cores"
            yield Miss(farthest.name, farthest.centre, message, measured, clause.amount)


def _nearest(place: Point, exits: list[Point]) -> float:
    return min(math.dist(place, door) for door in exits)


def _name(number: int) -> str:
    """Name a fire compartment; floor outside of all compartments has no name."""
    return compartment_name(number) if number > 0 else ""


def _has_sprinklers(level: BuiltLevel) -> bool:
    return "sprinkler" in level.solids.labels


def _out_of_reach(mounted: Mounted, level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    """Yield the stall or lane farthest from fire-fighting equipment, if it is out of reach."""
    clause: Length | None = getattr(profile, mounted.clause)
    places = [(stall.name, stall.centre) for stall in level.stalls]
    places += [(node.name, node.position) for node in level.lanes.nodes if not node.is_portal]
    if clause is None or not level.things or not places:
        return
    hung = _places_of(level, mounted.kind.label)
    what = mounted.kind.label.replace("_", " ")
    if len(hung) < mounted.count:
        yield Miss("", None, f"{len(hung)} objects of the class {what} are too few")
        return
    at = np.array([position for _, position in places])
    served, _, _ = Points(hung).within(clause.amount + ROUNDING_M, at, norm=mounted.norm)
    short = np.flatnonzero(np.bincount(served, minlength=len(at)) < mounted.count)
    if len(short):
        needed = (np.sort(distances_m(at[index], hung, norm=mounted.norm))[mounted.count - 1] for index in short)
        distances = np.fromiter(needed, dtype=np.float64, count=len(short))
        farthest = int(np.argmax(distances.round(6)))
        name, position = places[short[farthest]]
        which = "the second nearest" if mounted.count > 1 else "the nearest"
        yield Miss(name, position, f"{which} {what} is too far", float(distances[farthest]), clause.amount)


for _mounted in MOUNTED:
    BOOK.rule(
        f"{_mounted.kind.name.replace('_', '-')}-distance",
        _mounted.clause,
        asks=f"every stall and lane has {_mounted.count} {_mounted.kind.label.replace('_', ' ')}"
        f"{'s' if _mounted.count > 1 else ''} near enough",
        hindrance=where_laid_out,
        in_surveys=Severity.WARNING,
    )(partial(_out_of_reach, _mounted))


@BOOK.rule(
    "hydrant-spacing",
    "hydrant_spacing",
    asks="a fire hydrant is near enough to the next one",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _spacing(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    hydrants = _places_of(level, _HYDRANT)
    if profile.hydrant_spacing is None or len(hydrants) < 2:  # noqa: PLR2004 - a single hydrant has no neighbour
        return
    apart = np.array([np.sort(distances_m(hydrant, hydrants))[1] for hydrant in hydrants])
    farthest = int(np.argmax(apart.round(6)))
    measured, required = float(apart[farthest]), profile.hydrant_spacing.amount
    if measured > required + ROUNDING_M:
        place: Point = (float(hydrants[farthest, 0]), float(hydrants[farthest, 1]))
        yield Miss("", place, "the next fire hydrant is too far", measured, required)


def _places_of(level: BuiltLevel, label: str) -> NDArray[np.float64]:
    """Return the centre of the lowest piece of each object of a semantic class; float64, shape (n, 2)."""
    middles: dict[str, Point] = {}
    for solid in level.solids.standing(label):
        middles.setdefault(solid.name, solid.centre)
    return np.array(list(middles.values())).reshape(-1, 2)
