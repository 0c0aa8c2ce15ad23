"""Rules of single stalls: their size, and no objects in them but one car."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import shapely

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Stall, StallKind, StallUse
from garage2usd.objects import CAR_LABELS
from garage2usd.profiles import Length, Profile, Severity

if TYPE_CHECKING:
    from garage2usd.as_built.solids import Solid

BOOK = RuleBook()
_TOUCH_M = 0.02
_OVER_LINE_M = 0.1
"""Distance in metres that a parked car may overhang its line; swept-path proofs usually leave so much clearance."""
_BELONGS = {*CAR_LABELS, "traffic_cone", "wheel_stop", "charger", "speed_bump", "column"}
"""Semantic classes allowed in a stall, or covered by another rule."""


def _add_size_rules(prefix: str, subject: str, stalls_of: Callable[[BuiltLevel], list[Stall]]) -> None:
    """Add the rules that stalls are as wide and as long as two clauses of the profile want."""
    for side, enough, word in (("width", "wide", "narrow"), ("length", "long", "short")):
        name = f"{prefix}stall_{side}"
        find = partial(_short, stalls_of, name, f"{side}_m", word)
        BOOK.rule(name.replace("_", "-"), name, asks=f"{subject} is {enough} enough")(find)


def _short(
    stalls_of: Callable[[BuiltLevel], list[Stall]], name: str, side: str, word: str, level: BuiltLevel, profile: Profile
) -> Iterator[Miss]:
    clause: Length | None = getattr(profile, name)
    if clause is None:
        return
    for stall in stalls_of(level):
        measured = getattr(stall, side)
        if measured < clause.amount - ROUNDING_M:
            yield Miss(stall.name, stall.centre, f"the stall is too {word}", measured, clause.amount)


def _sized(level: BuiltLevel, *, parallel: bool = False, compact: bool = False) -> list[Stall]:
    """Return the stalls that one pair of clauses for width and length is for; no pair is for compact parallel ones."""
    return [
        stall
        for stall in level.parking_stalls
        if (stall.kind is StallKind.PARALLEL, stall.is_compact) == (parallel, compact)
    ]


def _for_motorcycles(level: BuiltLevel) -> list[Stall]:
    return [stall for stall in level.stalls if stall.use is StallUse.MOTORCYCLE]


_add_size_rules("", "a stall that cars park in", _sized)
_add_size_rules("parallel_", "a parallel stall", partial(_sized, parallel=True))
_add_size_rules("compact_", "a stall for compact cars", partial(_sized, compact=True))


@BOOK.rule("compact-share", "compact_share", asks="no more stalls than a share are for compact cars")
def _compact_share(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause, stalls = profile.compact_share, level.parking_stalls
    compact = [stall for stall in stalls if stall.is_compact]
    if clause and compact and (share := 100 * len(compact) / len(stalls)) > clause.amount + ROUNDING_M:
        message = "too many of the stalls are for compact cars"
        yield Miss(compact[0].name, compact[0].centre, message, share, clause.amount)


_add_size_rules("motorcycle_", "a stall for motorcycles", _for_motorcycles)


@BOOK.rule("stall-overlap", asks="stalls do not overlap", in_surveys=Severity.INFO)
def _overlap(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    stalls = level.stalls
    shrunk = shapely.buffer(level.stall_grounds.polygons, -_TOUCH_M)
    first, second = shapely.STRtree(shrunk).query(shrunk, predicate="intersects")
    for one, other in zip(first.tolist(), second.tolist(), strict=True):
        if one < other:
            yield Miss(stalls[one].name, stalls[one].centre, f"the stall overlaps {stalls[other].name}")


@BOOK.rule("column-in-stall", asks="no column stands in a stall", in_surveys=Severity.INFO)
def _column(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for stall in level.stalls:
        for solid in level.standing_in_stalls[stall]:
            if solid.label == "column":
                yield Miss(stall.name, stall.centre, f"{solid.name} stands in the stall", things=(solid.name,))
                break


@BOOK.rule(
    "stall-blocked",
    asks="nothing but a car, a wheel stop, a charger or a cone stands in a stall for cars",
    in_surveys=Severity.WARNING,
)
def _blocked(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for stall in level.parking_stalls:
        for solid in level.standing_in_stalls[stall]:
            if solid.label not in _BELONGS:
                message = f"a {solid.kind} stands in the stall: {solid.name}"
                yield Miss(stall.name, stall.centre, message, things=(solid.name,))
                break


@BOOK.rule("car-outside-stall", asks="a parked car stands between the lines of its stall, or 10 cm over one at most")
def _outside(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for name, (ground, stall) in level.cars.items():
        if stall is not None and not _with_lines(stall).covers(ground):
            yield Miss(name, _centre(ground), f"the car stands out of {stall.name}", things=(name,))


def _with_lines(stall: Stall) -> shapely.Geometry:
    """Return the ground of a stall, widened by the permitted overhang of a parked car."""
    x, z = stall.backwards
    across = np.array([z, -x]) * (_OVER_LINE_M - _TOUCH_M)
    corners = np.array(stall.corners)
    return shapely.MultiPoint(np.concatenate([corners - across, corners + across])).convex_hull.buffer(_TOUCH_M)


@BOOK.rule("stall-kept-free", asks="no car stands where cars turn or wheelchairs pass")
def _kept_free(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for name, (_, stall) in level.cars.items():
        if stall is not None and not stall.takes_cars:
            message = f"{name} stands in a stall of the use {stall.use.value}"
            yield Miss(stall.name, stall.centre, message, things=(name,))


@BOOK.rule("stall-two-cars", asks="a stall holds one car at most")
def _two_cars(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    first: dict[str, str] = {}
    for name, (_, stall) in level.cars.items():
        if stall is not None and first.setdefault(stall.name, name) != name:
            both = first[stall.name], name
            yield Miss(stall.name, stall.centre, f"{both[0]} and {both[1]} stand in one stall", things=both)


@BOOK.rule(
    "wheel-stop-height",
    "wheel_stop_height",
    asks="a wheel stop is low enough for a car's front",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _wheel_stops(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    return _too_high(level, profile.wheel_stop_height, "wheel_stop")


@BOOK.rule(
    "speed-bump-height",
    "speed_bump_height",
    asks="a speed bump is low enough for a car's floor",
    hindrance=where_laid_out,
    in_surveys=Severity.WARNING,
)
def _speed_bumps(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    return _too_high(level, profile.speed_bump_height, "speed_bump")


def _too_high(level: BuiltLevel, clause: Length | None, label: str) -> Iterator[Miss]:
    if clause is None:
        return
    highest: dict[str, Solid] = {}
    for solid in level.solids.standing(label):
        if solid.name not in highest or solid.top_m > highest[solid.name].top_m:
            highest[solid.name] = solid
    for name, solid in highest.items():
        if solid.top_m > clause.amount + ROUNDING_M:
            yield Miss(name, solid.centre, f"the {solid.kind} is too high", solid.top_m, clause.amount)


def _centre(shape: shapely.Polygon) -> tuple[float, float]:
    x, z = np.round((shape.centroid.x, shape.centroid.y), 3).tolist()
    return x, z
