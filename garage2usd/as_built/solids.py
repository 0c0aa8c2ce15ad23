"""Solid pieces of objects that a car can touch, and the ground of stalls, found by place."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.placed_pieces import lows_m, placed_pieces
from garage2usd.as_built.shapes import Thing
from garage2usd.garage import Stall, StallKind
from garage2usd.layout.grounds import Grounds, grounds_of
from garage2usd.objects import KINDS, PIECE_LABELS

HANGS_FROM_M = 1.0
"""Least height in metres at which a hanging object begins; all others are standing."""
_FLAT_M = 0.03
_ROUNDING_M = 1e-4
"""Tolerance in metres of heights in a stage, which has single precision."""
_NOT_SOLID = {kind.label for kind in KINDS if not kind.is_solid} | PIECE_LABELS
_AT_HOME = 0.5


class Solid(NamedTuple):
    """A solid piece of an object.

    Attributes
    ----------
    name, label
        Prim path and semantic class of the object.
    footprint
        Convex outline (x, z) in metres, seen from above.
    bottom_m, top_m
        Least and greatest height.
    """

    name: str
    label: str
    footprint: shapely.Polygon
    bottom_m: float
    top_m: float

    @property
    def centre(self) -> tuple[float, float]:
        """(x, z) of the solid's centre, to the millimetre."""
        return round(self.footprint.centroid.x, 3), round(self.footprint.centroid.y, 3)

    @property
    def kind(self) -> str:
        """Semantic class of the solid in words."""
        return self.label.replace("_", " ") or "object without a label"


class Solids:
    """The solid pieces of all objects.

    A standing object is represented by its colliders, if it has any; a hanging one by all of its meshes.
    """

    def __init__(self, things: Iterable[Thing]) -> None:
        """Collect the pieces of all objects except those flat on the floor and those that clad a column."""
        things = [thing for thing in things if thing.label not in _NOT_SOLID]
        self._names = [thing.name for thing in things]
        self._labels = [thing.label for thing in things]
        bodies = [body for thing in things for body in thing.bodies]
        owner = np.repeat(np.arange(len(things)), [len(thing.bodies) for thing in things])
        least, touched = np.full(len(things), np.inf), np.zeros(len(things), dtype=bool)
        np.minimum.at(least, owner, lows_m(bodies))
        hanging = (least > HANGS_FROM_M) & np.isfinite(least)
        touches = np.array([body.touches for body in bodies], dtype=bool)
        touched[owner[touches]] = True
        counted = np.flatnonzero(hanging[owner] | ~touched[owner] | touches)
        found = placed_pieces([bodies[index] for index in counted.tolist()], hanging[owner[counted]])
        found = found.kept(found.have_area & (found.high_m >= _FLAT_M))
        self._owner = owner[counted][found.owner]
        self._low, self._high, self._footprints = found.low_m, found.high_m, found.footprints
        self._hangs = hanging[self._owner]

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(self._footprints)

    @cached_property
    def labels(self) -> frozenset[str]:
        """Semantic classes of the solids."""
        return frozenset(self._labels)

    def standing(self, *labels: str) -> Iterator[Solid]:
        """Return the pieces of standing objects of some classes."""
        wanted = self._with_labels(labels)
        return (self._solid(index) for index in np.flatnonzero(~self._hangs & wanted).tolist())

    def hanging(self) -> Iterator[Solid]:
        """Return the lowest piece of each hanging object."""
        rows = np.flatnonzero(self._hangs)
        rows = rows[np.lexsort((self._low[rows], self._owner[rows]))]
        _, first = np.unique(self._owner[rows], return_index=True)
        return (self._solid(index) for index in rows[first].tolist())

    def between(self, low_m: float, high_m: float) -> Iterator[Solid]:
        """Return the standing and hanging pieces that intersect an interval of heights, its ends included."""
        reaches = (self._low <= high_m + _ROUNDING_M) & (self._high >= low_m - _ROUNDING_M)
        return (self._solid(index) for index in np.flatnonzero(reaches).tolist())

    def grounds(self, below_m: float) -> Iterator[tuple[str, str, list[shapely.Polygon]]]:
        """Yield name, class and outlines of each standing object, from its pieces that begin below a height."""
        rows = np.flatnonzero(~self._hangs & (self._low < below_m))
        owners, starts = np.unique(self._owner[rows], return_index=True)
        for owner, pieces in zip(owners.tolist(), np.split(rows, starts)[1:], strict=True):
            yield self._names[owner], self._labels[owner], self._footprints[pieces].tolist()

    def at(self, area: shapely.Polygon, *, hanging: bool = False, within_m: float = 0.0) -> list[Solid]:
        """Return the standing or hanging pieces that intersect an area or are within a distance of it."""
        found = self._tree.query(area, predicate="dwithin", distance=within_m)
        return [self._solid(index) for index in sorted(found[self._hangs[found] == hanging].tolist())]

    def standing_at_each(self, areas: Grounds, *, within_m: float = 0.0) -> list[list[Solid]]:
        """Return for each of many areas the standing pieces that intersect the area or are within a distance of it."""
        area, found = self._tree.query(areas, predicate="dwithin", distance=within_m)
        stands = ~self._hangs[found]
        pieces: list[list[Solid]] = [[] for _ in areas]
        for number, index in sorted(zip(area[stands].tolist(), found[stands].tolist(), strict=True)):
            pieces[number].append(self._solid(index))
        return pieces

    def _with_labels(self, labels: Collection[str]) -> NDArray[np.bool_]:
        wanted = np.array([label in labels for label in self._labels], dtype=bool)
        return wanted[self._owner] if len(wanted) else np.zeros(0, dtype=bool)

    def _solid(self, index: int) -> Solid:
        owner = self._owner[index]
        return Solid(
            self._names[owner],
            self._labels[owner],
            self._footprints[index],
            float(self._low[index]),
            float(self._high[index]),
        )


class StallGrounds:
    """Spatial index of the ground of stalls.

    Parameters
    ----------
    stalls
        The stalls.
    """

    def __init__(self, stalls: Sequence[Stall]) -> None:
        self._stalls = stalls

    @cached_property
    def polygons(self) -> Grounds:
        """Polygon of each stall; shape (stalls,)."""
        return grounds_of([stall.corners for stall in self._stalls])

    @cached_property
    def rectangles(self) -> Grounds:
        """The ground for a car in each stall; shape (stalls,)."""
        grounds = self.polygons.copy()
        for number, stall in enumerate(self._stalls):
            if stall.kind is StallKind.ANGLED:
                grounds[number] = stall.rectangle
        return grounds

    @cached_property
    def tree(self) -> shapely.STRtree:
        """Spatial index of all stall polygons."""
        return shapely.STRtree(self.polygons)

    def home_of(self, ground: shapely.Polygon) -> Stall | None:
        """Return the stall that contains more than half of a footprint."""
        (home,) = self.homes_of(np.array([ground], dtype=object))
        return home

    def homes_of(self, grounds: Grounds) -> list[Stall | None]:
        """Return for each footprint the stall that contains more than half of it."""
        number, stall = self.tree.query(grounds, predicate="intersects")
        areas = shapely.area(shapely.intersection(self.polygons[stall], grounds[number]))
        most = (_AT_HOME * shapely.area(grounds)).tolist()
        homes: list[Stall | None] = [None] * len(grounds)
        for index, other, area in zip(number.tolist(), stall.tolist(), areas.tolist(), strict=True):
            if area > most[index]:
                homes[index], most[index] = self._stalls[other], area
        return homes
