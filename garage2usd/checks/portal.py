"""Rules of vehicle entrances and exits: their number, spacing and width."""

import math
from collections.abc import Iterator
from itertools import combinations

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Point
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_DOOR_REACH_M = 12.0


@BOOK.rule("portal-count", "portals", asks="there are enough vehicle entrances and exits for the stalls")
def _count(garage: BuiltGarage, profile: Profile) -> Iterator[Miss]:
    portals = garage.lanes.portals("entrance", "exit")
    # a level of several has those of the whole garage, and none of one kind is found by a rule of its own
    if garage.landings:
        return
    if profile.portals is None or not garage.lanes.portals("entrance") or not garage.lanes.portals("exit"):
        return
    stalls = len(garage.parking_stalls)
    required = profile.portals.required(stalls)
    if len(portals) < required:
        yield Miss("", None, f"too few entrances and exits for {stalls} stalls", len(portals), required)


@BOOK.rule("portal-distance", "portal_distance", asks="vehicle entrances and exits are far enough apart")
def _distance(garage: BuiltGarage, profile: Profile) -> Iterator[Miss]:
    if profile.portal_distance is None:
        return
    portals = [garage.lanes.nodes[number] for number in garage.street_portals]
    for first, second in combinations(portals, 2):
        doors = [_door_of(node.position, garage) for node in (first, second)]
        measured = math.dist(*doors)
        if measured <= profile.portal_distance.amount + ROUNDING_M:
            message = f"{first.kind} and {second.kind} {second.name} are too close"
            yield Miss(first.name, first.position, message, measured, profile.portal_distance.amount)


@BOOK.rule("portal-width", "portal_width", asks="a vehicle entrance or exit is wide enough", hindrance=where_laid_out)
def _width(garage: BuiltGarage, profile: Profile) -> Iterator[Miss]:
    if profile.portal_width is None:
        return
    required = profile.portal_width.amount
    for door in garage.doors:
        if door.clear_width_m is not None and door.clear_width_m < required - ROUNDING_M:
            yield Miss(door.name, door.position, "the door is too narrow", door.clear_width_m, required)


@BOOK.rule("portal-shut", asks="no vehicle door is shut where others are open or ramps lead up")
def _shut(garage: BuiltGarage, _: Profile) -> Iterator[Miss]:
    # a garage that ends at its doors, without any ramp, has all of them shut
    if all(door.is_shut for door in garage.doors) and not garage.ramps:
        return
    for door in garage.doors:
        if door.is_shut:
            yield Miss(door.name, door.position, "the vehicle door is shut, no ramp leads to it")


@BOOK.rule("portal-inside", asks="every portal lies on the contour's edge, where its door opens")
def _inside(garage: BuiltGarage, _: Profile) -> Iterator[Miss]:
    if garage.kind == "stage":
        return
    for number in garage.street_portals:
        node = garage.lanes.nodes[number]
        if garage.is_on_contour(node.position) is False:
            yield Miss(node.name, node.position, f"the {node.kind} lies inside the garage")


def _door_of(position: Point, garage: BuiltGarage) -> Point:
    """Return the middle of a portal's door, or of its square where no door is known."""
    near = [door.position for door in garage.doors if math.dist(door.position, position) < _DOOR_REACH_M]
    return min(near, key=lambda door: math.dist(door, position), default=position)
