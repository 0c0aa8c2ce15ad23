"""Rules of fire safety: floor area of fire compartments, doors of stair cores, and distance to exits."""

import math
from collections import Counter, defaultdict
from collections.abc import Iterator

from garage2usd.as_built.core_reader import core_doors
from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out, where_structure_is_known
from garage2usd.garage import Point
from garage2usd.layout.egress.compartments import compartment_name
from garage2usd.profiles import Area, Length, Profile

__all__ = ["BOOK"]

BOOK = RuleBook()


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
)
def _distance(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if level.things and not (_has_sprinklers(level) and profile.exit_distance_sprinklered):
        yield from _too_far(level, profile.exit_distance, profile)


@BOOK.rule(
    "exit-distance-sprinklered",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people where there are sprinklers",
    hindrance=_distance_applies,
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
            if profile.personnel_exits is None:  # else that is found by the rule of their number
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
