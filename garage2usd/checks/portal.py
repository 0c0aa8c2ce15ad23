"""Rules of vehicle entrances and exits: their number, spacing and width."""

import math
from collections.abc import Iterator
from itertools import combinations

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Point
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_DOOR_REACH_M = 12.0


@BOOK.rule("portal-count", "portals", asks="there are enough vehicle entrances and exits for the stalls")
def _count(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    portals = level.lanes.portals("entrance", "exit")
    # a level of several has those of the whole garage, and none of one kind is found by a rule of its own
    if level.landings:
        return
    if profile.portals is None or not level.lanes.portals("entrance") or not level.lanes.portals("exit"):
        return
    stalls = len(level.parking_stalls)
    required = profile.portals.required(stalls)
    if len(portals) < required:
        yield Miss("", None, f"too few entrances and exits for {stalls} stalls", len(portals), required)


@BOOK.rule("portal-distance", "portal_distance", asks="vehicle entrances and exits are far enough apart")
def _distance(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.portal_distance is None:
        return
    portals = [level.lanes.nodes[number] for number in level.street_portals]
    for first, second in combinations(portals, 2):
        doors = [_door_of(node.position, level) for node in (first, second)]
        measured = math.dist(*doors)
        if measured <= profile.portal_distance.amount + ROUNDING_M:
            message = f"{first.kind} and {second.kind} {second.name} are too close"
            yield Miss(first.name, first.position, message, measured, profile.portal_distance.amount)


@BOOK.rule("portal-width", "portal_width", asks="a vehicle entrance or exit is wide enough", hindrance=where_laid_out)
def _width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.portal_width is None:
        return
    required = profile.portal_width.amount
    for door in level.doors:
        if door.clear_width_m is not None and door.clear_width_m < required - ROUNDING_M:
            yield Miss(door.name, door.position, "the door is too narrow", door.clear_width_m, required)


@BOOK.rule("portal-shut", asks="no vehicle door is shut where others are open or ramps lead up")
def _shut(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    # a garage that ends at its doors, without any ramp, has all of them shut
    if all(door.is_shut for door in level.doors) and not level.ramps:
        return
    for door in level.doors:
        if door.is_shut:
            yield Miss(door.name, door.position, "the vehicle door is shut, no ramp leads to it")


@BOOK.rule("portal-inside", asks="every portal lies on the contour's edge, where its door opens")
def _inside(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    if level.kind == "stage":
        return
    for number in level.street_portals:
        node = level.lanes.nodes[number]
        if level.is_on_contour(node.position) is False:
            yield Miss(node.name, node.position, f"the {node.kind} lies inside the garage")


def _door_of(position: Point, level: BuiltLevel) -> Point:
    """Return the middle of a portal's door, or of its square where no door is known."""
    near = [door.position for door in level.doors if math.dist(door.position, position) < _DOOR_REACH_M]
    return min(near, key=lambda door: math.dist(door, position), default=position)
