"""Rules of fire safety as far as a garage tells them: its floor, the doors of its stair cores, and the way to them."""

import math
from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from garage2usd.checks.core_reader import core_doors
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out, where_structure_is_known
from garage2usd.checks.subject import Subject
from garage2usd.layout.compartments import compartment_name
from garage2usd.profiles import Area, Length, Profile
from garage2usd.reading.ground import Point
from garage2usd.structure.grid import Cell

__all__ = ["BOOK"]

BOOK = RuleBook()
_MM2_PER_M2 = 1_000_000


def _floor_is_told(subject: Subject, profile: Profile) -> str:
    return where_laid_out(subject, profile) or where_structure_is_known(subject, profile)


def _area_applies(subject: Subject, profile: Profile) -> str:
    """A profile without a clause for no sprinklers asks for nothing there."""
    told = _floor_is_told(subject, profile)
    return told or _applies(subject, plain=profile.fire_compartment_area is not None)


def _distance_applies(subject: Subject, profile: Profile) -> str:
    return where_laid_out(subject, profile) or _applies(subject, plain=profile.exit_distance is not None)


def _applies(subject: Subject, *, plain: bool) -> str:
    return "" if plain or _has_sprinklers(subject) else "the garage has no sprinklers"


@BOOK.rule(
    "fire-compartment",
    "fire_compartment_area",
    "fire_compartment_area_sprinklered",
    asks="each fire compartment, or the floor where none are declared, is small enough",
    hindrance=_floor_is_told,
)
def _compartment(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if subject.things and not (_has_sprinklers(subject) and profile.fire_compartment_area_sprinklered):
        yield from _too_large(subject, profile.fire_compartment_area)


@BOOK.rule(
    "fire-compartment-sprinklered",
    "fire_compartment_area_sprinklered",
    asks="each fire compartment, or the floor where none are declared, is small enough with sprinklers",
    hindrance=_area_applies,
)
def _sprinklered_compartment(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(subject):
        yield from _too_large(subject, profile.fire_compartment_area_sprinklered)


@BOOK.rule(
    "personnel-exits",
    "personnel_exits",
    asks="people have enough exits in each fire compartment",
    hindrance=where_laid_out,
)
def _count(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if profile.personnel_exits is None or not subject.things:
        return
    doors = core_doors(subject)
    for number, name in _compartments(subject):
        count = sum(_compartment_at(subject.nodes[door.node].position, subject) == number for door in doors)
        if count < profile.personnel_exits.amount:
            yield Miss(name, None, "too few doors of stair cores onto lanes", count, profile.personnel_exits.amount)


@BOOK.rule(
    "exit-distance",
    "exit_distance",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people",
    hindrance=where_laid_out,
)
def _distance(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if subject.things and not (_has_sprinklers(subject) and profile.exit_distance_sprinklered):
        yield from _too_far(subject, profile.exit_distance, profile)


@BOOK.rule(
    "exit-distance-sprinklered",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people where there are sprinklers",
    hindrance=_distance_applies,
)
def _sprinklered_distance(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(subject):
        yield from _too_far(subject, profile.exit_distance_sprinklered, profile)


def _too_large(subject: Subject, clause: Area | None) -> Iterator[Miss]:
    if clause is None or subject.structure is None:
        return
    structure = subject.structure
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    inside = structure.cells != Cell.OBSTACLE
    for number, name in _compartments(subject):
        own = inside if subject.compartments is None else inside & (subject.compartments == number)
        measured = float(areas[own].sum())
        if measured > clause.amount:
            parts = math.ceil(measured / clause.amount)
            what = f"the fire compartment {name}" if name else "the floor"
            yield Miss(name, None, f"{what} needs {parts} fire compartments", measured, clause.amount)


def _too_far(subject: Subject, clause: Length | None, profile: Profile) -> Iterator[Miss]:
    """The stall of each compartment that is farthest from its exits, as the crow flies, if it is too far."""
    if clause is None or not subject.stalls:
        return
    exits = defaultdict(list)
    for door in core_doors(subject):
        exits[_compartment_at(subject.nodes[door.node].position, subject)].append(door.position)
    stalls = defaultdict(list)
    for stall in subject.stalls:
        stalls[_compartment_at(stall.centre, subject)].append(stall)
    for number, own in stalls.items():
        doors = exits[number]
        if not doors:
            if profile.personnel_exits is None:  # else that is found by the rule of their number
                name = compartment_name(number) if number > 0 else ""
                yield Miss(name, None, "no door of a stair core is there to be reached")
            continue
        farthest = max(own, key=lambda stall: _nearest(stall.centre, doors))
        measured = _nearest(farthest.centre, doors)
        if measured > clause.amount + ROUNDING_M:
            message = "the farthest stall is too far from the doors of stair cores"
            yield Miss(farthest.name, farthest.centre, message, measured, clause.amount)


def _nearest(place: Point, exits: list[Point]) -> float:
    return min(math.dist(place, door) for door in exits)


def _compartments(subject: Subject) -> list[tuple[int, str]]:
    """Number and name of each fire compartment; floor that belongs to none is one without a name."""
    if subject.compartments is None or subject.structure is None:
        return [(0, "")]
    numbers = np.unique(subject.compartments[subject.structure.cells != Cell.OBSTACLE]).tolist()
    return [(number, compartment_name(number) if number > 0 else "") for number in numbers]


def _compartment_at(place: Point, subject: Subject) -> int:
    """Number of the fire compartment that a place lies in; 0 where none are declared."""
    if subject.compartments is None or subject.structure is None:
        return 0
    structure = subject.structure
    edges = (structure.row_edges_m, place[1]), (structure.column_edges_m, place[0])
    row, col = (int(np.clip(np.searchsorted(lines, at) - 1, 0, len(lines) - 2)) for lines, at in edges)
    return int(subject.compartments[row, col])


def _has_sprinklers(subject: Subject) -> bool:
    return "sprinkler" in subject.solids.labels
