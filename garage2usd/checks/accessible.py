"""Rules of accessible stalls: their number, their width, the access aisle beside each, and stalls for vans."""

import math
from collections.abc import Iterator

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Stall, StallUse
from garage2usd.profiles import Profile

__all__ = ["BOOK"]

BOOK = RuleBook()
_BESIDE_M = 0.1


@BOOK.rule("accessible-count", "accessible_stalls", asks="there are enough accessible stalls", hindrance=where_laid_out)
def _count(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.accessible_stalls is None or not level.things:
        return
    stalls = len(level.parking_stalls)
    required, measured = profile.accessible_stalls.required(stalls), len(_accessible(level))
    if measured < required:
        yield Miss("", None, f"too few accessible stalls among {stalls}", measured, required)


@BOOK.rule("accessible-width", "accessible_stall_width", "stall_width", asks="an accessible stall is wide enough")
def _width(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    clause, common = profile.accessible_stall_width, profile.stall_width
    # a width that no stall may have is found by the rule of all stalls
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
