"""Rules of headroom: clear height for cars, and for vans on routes to accessible stalls."""

from collections.abc import Iterator

import shapely

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.feasibility import way_in, way_out
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Point, StallUse
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_DOOR_REACH_M = 8.0
"""Greatest distance in metres from a portal's door to the middle of its square."""


@BOOK.rule(
    "headroom",
    "clear_height",
    asks="nothing hangs below the clear height, doors included",
    hindrance=where_laid_out,
)
def _clear_height(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.clear_height is None:
        return
    required = profile.clear_height.amount
    for solid in level.solids.hanging():
        if solid.bottom_m < required - ROUNDING_M:
            yield Miss(solid.name, solid.centre, f"the {solid.kind} hangs too low", solid.bottom_m, required)
    for door in level.doors:
        if door.clear_height_m is not None and door.clear_height_m < required - ROUNDING_M:
            yield Miss(door.name, door.position, "the door is too low", door.clear_height_m, required)


@BOOK.rule(
    "van-headroom",
    "van_clear_height",
    "clear_height",
    asks="nothing hangs low on the ways to and from the accessible stalls that take vans",
    hindrance=where_laid_out,
)
def _van_height(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.van_clear_height is None:
        return
    required, reported = profile.van_clear_height.amount, profile.clear_height
    for place, position, lowest in _over_van_routes(level):
        # what hangs lower than any car may pass has its own rule
        if lowest < required - ROUNDING_M and (reported is None or lowest >= reported.amount - ROUNDING_M):
            yield Miss(place, position, "hangs too low over the way of vans to an accessible stall", lowest, required)


def _over_van_routes(level: BuiltLevel) -> Iterator[tuple[str, Point, float]]:
    """Yield name, place and least height of objects and doors over the routes of vans to and from accessible stalls."""
    stalls = [stall for stall in level.stalls if stall.use is StallUse.ACCESSIBLE]
    driven = {node for stall in stalls for node in (*way_in(level, stall), *way_out(level, stall))}
    if not driven:
        return
    places = [level.lanes.nodes[node] for node in sorted(driven)]
    squares = [
        shapely.box(x - across_x / 2, z - across_z / 2, x + across_x / 2, z + across_z / 2)
        for (x, z), (across_x, across_z) in ((node.position, node.widths_m) for node in places)
    ]
    ground = shapely.union_all([*squares, *(stall.polygon for stall in stalls)])
    shapely.prepare(ground)
    for solid in level.solids.hanging():
        if ground.intersects(solid.footprint):
            yield solid.name, solid.centre, solid.bottom_m
    portals = [node.position for node in places if node.is_portal]
    for door in level.doors:
        near = any(shapely.Point(door.position).distance(shapely.Point(portal)) < _DOOR_REACH_M for portal in portals)
        if near and door.clear_height_m is not None:
            yield door.name, door.position, door.clear_height_m
