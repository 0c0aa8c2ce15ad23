"""How wide accessible stalls and the access aisles beside them are, within the width of the stalls that they take."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from garage2usd.profiles.profile import Profile

__all__ = ["AccessWidths", "access_widths", "least_stall_width_m", "van_stalls"]

_ROUNDING_M = 1e-6


class AccessWidths(NamedTuple):
    """Widths of one or two accessible stalls and of the access aisle beside or between them, in metres."""

    stalls_m: tuple[float, ...]
    aisle_m: float


def van_stalls(profile: Profile, accessible: int) -> int:
    """How many of some accessible stalls take vans."""
    share = profile.stalls_per_van_stall
    return math.ceil(accessible / share.amount) if share else 0


def access_widths(profile: Profile, stall_width_m: float, *, stalls: int, vans: int) -> AccessWidths | None:
    """How accessible stalls and an access aisle share the place of the stalls that they take, one more than they are.

    Parameters
    ----------
    profile
        What is asked of them; no stall is narrower than `stall_width_m`.
    stall_width_m
        Of the other stalls.
    stalls
        How many accessible stalls lie at the aisle: one, or two with it between them.
    vans
        How many of them, the first ones, take vans.

    Returns
    -------
    AccessWidths or None
        None where there is too little room.
    """
    place_m = (stalls + 1) * stall_width_m
    for car_m, van_m, least_m in _wanted(profile, takes_vans=vans > 0):
        widths = tuple(max(stall_width_m, van_m if index < vans else car_m) for index in range(stalls))
        aisle_m = round(place_m - sum(widths), 6)
        if aisle_m >= least_m - _ROUNDING_M:
            return AccessWidths(widths, aisle_m)
    return None


def least_stall_width_m(profile: Profile) -> float:
    """Least width of stalls of which two hold what a profile asks of an accessible stall and its aisle."""
    asks_for_vans = profile.stalls_per_van_stall is not None
    kinds = [_wanted(profile, takes_vans=takes_vans) for takes_vans in {False, asks_for_vans}]
    # each is the wider half of the two, or the aisle alone where that is wider than a stall
    return max(
        min((max((van_m + aisle_m) / 2, aisle_m) for _, van_m, aisle_m in ways), default=0.0)
        for ways in map(list, kinds)
    )


def _wanted(profile: Profile, *, takes_vans: bool) -> Iterator[tuple[float, float, float]]:
    """Ways to satisfy a profile: least widths of an accessible stall for cars, of one for vans, and of the aisle."""
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
