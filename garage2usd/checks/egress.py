"""Rules of fire safety as far as a garage tells them: its floor, the doors of its stair cores, and the way to them."""

import math
from collections.abc import Iterator

import numpy as np

from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook
from garage2usd.checks.subject import Point, Subject
from garage2usd.grid import Cell, Structure
from garage2usd.layout.building import core_doors
from garage2usd.profiles import Area, Length, Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_MM2_PER_M2 = 1_000_000


@BOOK.rule("fire-compartment", "fire_compartment_area", asks="the floor fits one fire compartment")
def _compartment(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if subject.things and not _has_sprinklers(subject):
        yield from _too_large(subject, profile.fire_compartment_area)


@BOOK.rule(
    "fire-compartment-sprinklered",
    "fire_compartment_area_sprinklered",
    asks="the floor fits one fire compartment with sprinklers",
)
def _sprinklered_compartment(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(subject):
        yield from _too_large(subject, profile.fire_compartment_area_sprinklered)


@BOOK.rule("personnel-exits", "personnel_exits", asks="people have enough exits")
def _count(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if profile.personnel_exits is None or subject.structure is None:
        return
    doors = _exits_on_foot(subject.structure)
    if len(doors) < profile.personnel_exits.amount:
        message = "too few doors of stair cores onto lanes"
        yield Miss("", None, message, len(doors), profile.personnel_exits.amount)


@BOOK.rule("exit-distance", "exit_distance", asks="no stall is too far from an exit for people")
def _distance(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if subject.things and not _has_sprinklers(subject):
        yield from _too_far(subject, profile.exit_distance)


@BOOK.rule(
    "exit-distance-sprinklered",
    "exit_distance_sprinklered",
    asks="no stall is too far from an exit for people where there are sprinklers",
)
def _sprinklered_distance(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if _has_sprinklers(subject):
        yield from _too_far(subject, profile.exit_distance_sprinklered)


def _too_large(subject: Subject, clause: Area | None) -> Iterator[Miss]:
    if clause is None or subject.structure is None:
        return
    structure = subject.structure
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm)[structure.cells != Cell.OBSTACLE]
    measured = float(areas.sum()) / _MM2_PER_M2
    if measured > clause.amount:
        parts = math.ceil(measured / clause.amount)
        yield Miss("", None, f"the floor needs {parts} fire compartments", measured, clause.amount)


def _too_far(subject: Subject, clause: Length | None) -> Iterator[Miss]:
    """The stall that is farthest from any exit, as the crow flies, if it is too far."""
    if clause is None or subject.structure is None or not subject.stalls:
        return
    exits = _exits_on_foot(subject.structure)
    if not exits:
        return  # that itself is found by the rule of their number
    farthest = max(subject.stalls, key=lambda stall: _nearest(stall.centre, exits))
    measured = _nearest(farthest.centre, exits)
    if measured > clause.amount + ROUNDING_M:
        message = "the farthest stall is too far from the doors of stair cores"
        yield Miss(farthest.name, farthest.centre, message, measured, clause.amount)


def _nearest(place: Point, exits: list[Point]) -> float:
    return min(math.dist(place, door) for door in exits)


def _exits_on_foot(structure: Structure) -> list[Point]:
    """(x, z) of the doors of stair cores."""
    x, z = structure.column_edges_m, structure.row_edges_m
    return [(float(x[col] + x[col + 1]) / 2, float(z[row])) for row, col in core_doors(structure)]


def _has_sprinklers(subject: Subject) -> bool:
    return "sprinkler" in subject.solids.labels
