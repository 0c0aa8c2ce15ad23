"""Rules of fire-fighting equipment: every stall and lane has an item within reach."""

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.layout.nearness import Points, distances_m
from garage2usd.objects import MOUNTED, Mounted
from garage2usd.profiles import Length, Profile

if TYPE_CHECKING:
    from garage2usd.garage import Point

__all__ = ["BOOK"]

BOOK = RuleBook()
_HYDRANT = "hydrant_cabinet"


def _out_of_reach(mounted: Mounted, level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    """Yield the stall or lane farthest from fire-fighting equipment, if it is out of reach."""
    clause: Length | None = getattr(profile, mounted.clause)
    places = [(stall.name, stall.centre) for stall in level.stalls]
    places += [(node.name, node.position) for node in level.lanes.nodes if not node.is_portal]
    if clause is None or not level.things or not places:
        return
    hung = _places_of(level, mounted.kind.label)
    what = mounted.kind.label.replace("_", " ")
    if len(hung) < mounted.count:
        yield Miss("", None, f"{len(hung)} objects of the class {what} are too few")
        return
    at = np.array([position for _, position in places])
    served, _, _ = Points(hung).within(clause.amount + ROUNDING_M, at, norm=mounted.norm)
    short = np.flatnonzero(np.bincount(served, minlength=len(at)) < mounted.count)
    if len(short):
        needed = (np.sort(distances_m(at[index], hung, norm=mounted.norm))[mounted.count - 1] for index in short)
        distances = np.fromiter(needed, dtype=np.float64, count=len(short))
        farthest = int(np.argmax(distances.round(6)))
        name, position = places[short[farthest]]
        which = "the second nearest" if mounted.count > 1 else "the nearest"
        yield Miss(name, position, f"{which} {what} is too far", float(distances[farthest]), clause.amount)


for _mounted in MOUNTED:
    BOOK.rule(
        f"{_mounted.kind.name.replace('_', '-')}-distance",
        _mounted.clause,
        asks=f"every stall and lane has {_mounted.count} {_mounted.kind.label.replace('_', ' ')}"
        f"{'s' if _mounted.count > 1 else ''} near enough",
        hindrance=where_laid_out,
    )(partial(_out_of_reach, _mounted))


@BOOK.rule(
    "hydrant-spacing",
    "hydrant_spacing",
    asks="a fire hydrant is near enough to the next one",
    hindrance=where_laid_out,
)
def _spacing(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    hydrants = _places_of(level, _HYDRANT)
    if profile.hydrant_spacing is None or len(hydrants) < 2:  # noqa: PLR2004 - one has no next one
        return
    apart = np.array([np.sort(distances_m(hydrant, hydrants))[1] for hydrant in hydrants])
    farthest = int(np.argmax(apart.round(6)))
    measured, required = float(apart[farthest]), profile.hydrant_spacing.amount
    if measured > required + ROUNDING_M:
        place: Point = (float(hydrants[farthest, 0]), float(hydrants[farthest, 1]))
        yield Miss("", place, "the next fire hydrant is too far", measured, required)


def _places_of(level: BuiltLevel, label: str) -> NDArray[np.float64]:
    """Return the centre of the lowest piece of each object of a semantic class; float64, shape (n, 2)."""
    middles: dict[str, Point] = {}
    for solid in level.solids.standing(label):
        middles.setdefault(solid.name, solid.centre)
    return np.array(list(middles.values())).reshape(-1, 2)
