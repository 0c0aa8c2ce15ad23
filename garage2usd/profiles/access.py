"""Widths of accessible stalls and access aisles, within the width of the standard stalls that they replace."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from garage2usd.profiles.profile import Profile

_ROUNDING_M = 1e-6


class AccessWidths(NamedTuple):
    """Widths in metres of one or two accessible stalls and of the access aisle beside or between them."""

    stalls_m: tuple[float, ...]
    aisle_m: float


def van_stalls(profile: Profile, accessible: int) -> int:
    """Number of van-accessible stalls among `accessible` stalls, by the profile's ratio."""
    share = profile.stalls_per_van_stall
    return math.ceil(accessible / share.amount) if share else 0


def access_widths(profile: Profile, stall_width_m: float, *, stalls: int, vans: int) -> AccessWidths | None:
    """Divide the place of `stalls` + 1 standard stalls between accessible stalls and an access aisle.

    Parameters
    ----------
    profile
        Source of the required widths; no stall is narrower than `stall_width_m`.
    stall_width_m
        Width of the standard stalls in metres.
    stalls
        Number of accessible stalls at the access aisle: one beside it, or two with the aisle between them.
    vans
        Number of van-accessible stalls among them, the first ones.

    Returns
    -------
    AccessWidths or None
        None if there is too little room.
    """
    place_m = (stalls + 1) * stall_width_m
    for car_m, van_m, least_m in _width_alternatives(profile, takes_vans=vans > 0):
        widths = tuple(max(stall_width_m, van_m if index < vans else car_m) for index in range(stalls))
        aisle_m = round(place_m - sum(widths), 6)
        if aisle_m >= least_m - _ROUNDING_M:
            return AccessWidths(widths, aisle_m)
    return None


def least_stall_width_m(profile: Profile) -> float:
    """Least width in metres of standard stalls of which two can hold an accessible stall and its access aisle."""
    asks_for_vans = profile.stalls_per_van_stall is not None
    kinds = [_width_alternatives(profile, takes_vans=takes_vans) for takes_vans in {False, asks_for_vans}]
    # half of the sum, or the aisle's width if that is greater than a stall's
    return max(
        min((max((van_m + aisle_m) / 2, aisle_m) for _, van_m, aisle_m in ways), default=0.0)
        for ways in map(list, kinds)
    )


def _width_alternatives(profile: Profile, *, takes_vans: bool) -> Iterator[tuple[float, float, float]]:
    """Alternatives of least widths in metres: a car-accessible stall, a van-accessible one, and the access aisle."""
    car_m, aisle_m, van_m, van_aisle_m = (
        clause.amount if clause else 0.0
        for clause in (
            profile.accessible_stall_width,
            profile.access_aisle_width,
            profile.van_stall_width,
            profile.van_access_aisle_width,
        )
    )
    if not takes_vans:
        yield car_m, car_m, aisle_m
        return
    if van_aisle_m:
        yield car_m, car_m, max(aisle_m, van_aisle_m)
    if van_m:
        yield car_m, max(car_m, van_m), aisle_m
