"""Rules of access: headroom, vehicle entrances and exits, ramps, and accessible stalls."""

import math
from collections.abc import Iterator
from itertools import combinations

import shapely

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.feasibility import way_in, way_out
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Point, Stall, StallUse
from garage2usd.profiles import Profile, Severity

BOOK = RuleBook()
_DOOR_DEPTH_M = 8.0
"""Greatest distance in metres from a portal's door to the middle of its square."""
_DOOR_REACH_M = 12.0
_SLOPE_ROUNDING = 0.15
_RUN_ROUNDING_M = 0.06
_BESIDE_M = 0.1


@BOOK.rule(
    "headroom",
    "clear_height",
    asks="nothing hangs below the clear height, doors included",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
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
    in_surveys=Severity.WARNING,
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
        near = any(shapely.Point(door.position).distance(shapely.Point(portal)) < _DOOR_DEPTH_M for portal in portals)
        if near and door.clear_height_m is not None:
            yield door.name, door.position, door.clear_height_m


@BOOK.rule("portal-count", "portals", asks="there are enough vehicle entrances and exits for the stalls")
def _count(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    portals = level.lanes.portals("entrance", "exit")
    # with several levels the portals of the whole garage count; another rule reports a missing entrance or exit
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
        if not measured:
            continue  # both ways lead through one door
        if measured <= profile.portal_distance.amount + ROUNDING_M:
            message = f"{first.kind} and {second.kind} {second.name} are too close"
            yield Miss(first.name, first.position, message, measured, profile.portal_distance.amount)


@BOOK.rule(
    "portal-width",
    "portal_width",
    asks="a vehicle entrance or exit is wide enough",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.portal_width is None:
        return
    required = profile.portal_width.amount
    for door in level.doors:
        if door.clear_width_m is not None and door.clear_width_m < required - ROUNDING_M:
            yield Miss(door.name, door.position, "the door is too narrow", door.clear_width_m, required)


@BOOK.rule(
    "portal-shut", asks="no vehicle door is shut where others are open or ramps lead up", in_surveys=Severity.WARNING
)
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


@BOOK.rule("ramp-slope", "ramp_slope", asks="a straight ramp is not too steep", hindrance=where_laid_out)
def _slope(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.ramp_slope is None:
        return
    for ramp in level.ramps:
        steepest = max((stretch.slope_percent for stretch in ramp.stretches), default=0.0)
        if steepest > profile.ramp_slope.amount + _SLOPE_ROUNDING:
            yield Miss(ramp.name, ramp.position, "the ramp is too steep", steepest, profile.ramp_slope.amount)


@BOOK.rule(
    "ramp-transition",
    "ramp_transition_length",
    "ramp_transition_slope",
    asks="a steep ramp has pieces of half its slope at its foot and its top",
    asking=2,
    hindrance=where_laid_out,
)
def _transition(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    required = profile.transition_length_m
    for ramp in level.ramps:
        steepest = max((stretch.slope_percent for stretch in ramp.stretches), default=0.0)
        if steepest <= profile.transition_slope_percent + _SLOPE_ROUNDING:
            continue
        for end, where in ((ramp.stretches[0], "foot"), (ramp.stretches[-1], "top")):
            gentle = end.slope_percent <= steepest / 2 + _SLOPE_ROUNDING
            measured = end.length_m if gentle else 0.0
            if measured < required - _RUN_ROUNDING_M:
                message = f"the ramp's {where} has too short a piece of half its slope"
                yield Miss(ramp.name, ramp.position, message, measured, required)
                break


@BOOK.rule("accessible-count", "accessible_stalls", asks="there are enough accessible stalls", hindrance=where_laid_out)
def _accessible_count(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.accessible_stalls is None or not level.things:
        return
    stalls = len(level.parking_stalls)
    required, measured = profile.accessible_stalls.required(stalls), len(_accessible(level))
    if measured < required:
        yield Miss("", None, f"too few accessible stalls among {stalls}", measured, required)


@BOOK.rule("accessible-width", "accessible_stall_width", "stall_width", asks="an accessible stall is wide enough")
def _accessible_width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause, common = profile.accessible_stall_width, profile.stall_width
    # if no stall may be that narrow, `stall-width` reports it
    if clause is None or (common is not None and common.amount >= clause.amount):
        return
    for stall in _accessible(level):
        if stall.width_m < clause.amount - ROUNDING_M:
            yield Miss(stall.name, stall.centre, "the accessible stall is too narrow", stall.width_m, clause.amount)


@BOOK.rule("access-aisle", "access_aisle_width", asks="an accessible stall has an access aisle beside it")
def _aisle(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.access_aisle_width is None:
        return
    for stall in _accessible(level):
        measured = _aisle_beside(stall, level)
        if measured < profile.access_aisle_width.amount - ROUNDING_M:
            message = "the access aisle is too narrow" if measured else "there is no access aisle beside the stall"
            yield Miss(stall.name, stall.centre, message, measured, profile.access_aisle_width.amount)


def _vans_are_told(_: BuiltLevel, profile: Profile) -> str:
    """Explain why van-accessible stalls cannot be checked: the profile must state both their number and a width."""
    if profile.stalls_per_van_stall is None:
        return "the profile has no stalls_per_van_stall"
    if profile.van_stall_width is None and profile.van_access_aisle_width is None:
        return "the profile has neither van_stall_width nor van_access_aisle_width"
    return ""


@BOOK.rule(
    "van-count",
    "stalls_per_van_stall",
    "van_stall_width",
    "van_access_aisle_width",
    asks="enough accessible stalls take vans",
    asking=3,
    hindrance=_vans_are_told,
)
def _vans(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    stalls = _accessible(level)
    if profile.stalls_per_van_stall is None or _vans_are_told(level, profile) or not stalls:
        return
    wide, aisle = profile.van_stall_width, profile.van_access_aisle_width
    taking = [
        stall
        for stall in stalls
        if (wide is not None and stall.width_m >= wide.amount - ROUNDING_M)
        or (aisle is not None and _aisle_beside(stall, level) >= aisle.amount - ROUNDING_M)
    ]
    required = math.ceil(len(stalls) / profile.stalls_per_van_stall.amount)
    if len(taking) < required:
        yield Miss("", None, f"too few of {len(stalls)} accessible stalls take vans", len(taking), required)


def _accessible(level: BuiltLevel) -> list[Stall]:
    return [stall for stall in level.stalls if stall.use is StallUse.ACCESSIBLE]


def _aisle_beside(stall: Stall, level: BuiltLevel) -> float:
    """Return the width of the widest access aisle along a long side of a stall; 0 without one."""
    beside = stall.polygon.buffer(_BESIDE_M, cap_style="flat", join_style="mitre")
    widths = [0.0]
    for index in level.stall_grounds.tree.query(beside, predicate="intersects").tolist():
        other = level.stalls[index]
        shared = other.polygon.intersection(beside).area / _BESIDE_M
        if other.use is StallUse.ACCESS_AISLE and shared > stall.length_m / 2:
            widths.append(other.width_m)
    return max(widths)
