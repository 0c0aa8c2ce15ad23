"""Slots as pairs of directional marking points, found by the geometry of the points, and counted against the true ones.

The formulation is that of Huang et al., *DMPR-PS: A novel approach for parking-slot detection using directional
marking-point regression* (2019): a marking point is an end of a slot's entry, has the direction in which its dividing
line runs, and a shape; two of them are a slot if their distance, directions and shapes fit and none is between them.
"""

from dataclasses import dataclass

import numpy as np
from average_precision import WITHIN_PX, Detections, Matched
from numpy.typing import NDArray

__all__ = ["FoundSlots", "MarkingPoints", "MatchedSlots", "TrueSlots", "matched_slots", "paired", "pairs_of_corners"]

_LEAST_COS = np.cos(np.radians(30.0))
"""Of the angle between the directions of the two ends."""
_LEAST_SIN = np.sin(np.radians(30.0))
"""Of the angle between entry and direction: stalls stand at 30 degrees to the aisle at the least."""
_BETWEEN_PX = 8.0
"""How near to an entry a point is between its ends."""
_SURE_SHARE = 0.5
"""A point that is less sure than this share of the less sure end is not between them."""
_LEAST_CONFIDENCE = 0.03
_STALL_PX = 50.0, 80.0
"""From corner to corner of one stall in photographs."""
_COLUMN_PX = 42.0
"""Corners that are nearer have a column between them, or a gap."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MarkingPoints:
    """Ends of entries of slots in a picture.

    Attributes
    ----------
    places_px
        (column, row); float64, shape (n, 2).
    direction
        In which the dividing line runs into the slots, in pixels; of unit length; float64, shape (n, 2).
    opens
        How surely a slot is to the right of that direction, so that the point is its left end, and to the left of it;
        float64, shape (n, 2). Both are 1 between neighbours: DMPR-PS calls that a T, and one alone an L.
    confidence
        Float64, shape (n,).
    """

    places_px: Floats
    direction: Floats
    opens: Floats
    confidence: Floats

    @property
    def detections(self) -> Detections:
        """The places alone, as a detector of corners has them."""
        return Detections(self.places_px, self.confidence)


@dataclass(frozen=True, eq=False)
class FoundSlots:
    """Slots found in a picture.

    Attributes
    ----------
    entries_px
        Left and right end of the entry as seen by a driver who enters forwards; float64, shape (n, 2, 2).
    direction
        Into the slot, of unit length; float64, shape (n, 2).
    confidence
        Float64, shape (n,).
    """

    entries_px: Floats
    direction: Floats
    confidence: Floats

    def of(self, chosen: NDArray[np.bool_]) -> "FoundSlots":
        """Some of the slots."""
        return FoundSlots(self.entries_px[chosen], self.direction[chosen], self.confidence[chosen])


@dataclass(frozen=True, eq=False)
class MatchedSlots(Matched):
    """What became of the slots of one picture; places are the middles of entries.

    Attributes
    ----------
    number
        Which found slot each is; int64, shape (n,).
    """

    number: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class TrueSlots:
    """Slots that are in a picture.

    Attributes
    ----------
    entries_px, direction
        As in `FoundSlots`; directions are NaN where they are not known.
    is_occupied
        Whether a car stands in each; False where it is not known; bool, shape (n,).
    counts
        Which of them are to be found; the others count neither for nor against; bool, shape (n,).
    """

    entries_px: Floats
    direction: Floats
    is_occupied: NDArray[np.bool_]
    counts: NDArray[np.bool_]


def paired(points: MarkingPoints, lengths_px: tuple[float, float]) -> FoundSlots:
    """The slots between points, the most confident first; each point is the left end of one slot and the right of one.

    Parameters
    ----------
    points
        All that are found, sure or not.
    lengths_px
        The shortest and the longest entry that there is.
    """
    places, direction = points.places_px, points.direction
    along = places[None] - places[:, None]
    length = np.hypot(*np.moveaxis(along, -1, 0))
    mean = direction[:, None] + direction[None]
    mean /= np.maximum(np.hypot(*np.moveaxis(mean, -1, 0)), 1e-9)[..., None]
    # downwards is positive: who drives to the left has the right end above the left one
    sine = (mean[..., 0] * along[..., 1] - mean[..., 1] * along[..., 0]) / np.maximum(length, 1e-9)
    sure = points.confidence[:, None] * points.confidence * points.opens[:, None, 0] * points.opens[None, :, 1]
    confidence = np.sqrt(sure)
    fits = (length >= lengths_px[0]) & (length <= lengths_px[1]) & (sine >= _LEAST_SIN)
    fits &= (direction @ direction.T >= _LEAST_COS) & (confidence >= _LEAST_CONFIDENCE)
    lefts, rights = np.nonzero(fits)
    is_whole = ~_are_divided(points, lefts, rights)
    lefts, rights = lefts[is_whole], rights[is_whole]
    chosen: list[tuple[int, int]] = []
    used_left, used_right = set[int](), set[int]()
    for number in np.argsort(-confidence[lefts, rights], kind="stable"):
        left, right = int(lefts[number]), int(rights[number])
        if left not in used_left and right not in used_right:
            chosen.append((left, right))
            used_left.add(left)
            used_right.add(right)
    ends = np.array(chosen, dtype=np.int64).reshape(-1, 2)
    return FoundSlots(places[ends], mean[ends[:, 0], ends[:, 1]], confidence[ends[:, 0], ends[:, 1]])


def _are_divided(points: MarkingPoints, lefts: NDArray[np.int64], rights: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Whether a third point is on the line between two, for each pair of them."""
    start, along = points.places_px[lefts, None], (points.places_px[rights] - points.places_px[lefts])[:, None]
    length = np.hypot(*along[:, 0].T)[:, None]
    from_start = points.places_px - start
    on = (from_start * along).sum(axis=2) / length
    off = np.abs(from_start[..., 1] * along[..., 0] - from_start[..., 0] * along[..., 1]) / length
    weaker = np.minimum(points.confidence[lefts], points.confidence[rights])
    is_sure = points.confidence >= _SURE_SHARE * weaker[:, None]
    between: NDArray[np.bool_] = is_sure & (off <= _BETWEEN_PX) & (on > _BETWEEN_PX) & (on < length - _BETWEEN_PX)
    return between.any(axis=1)


def matched_slots(found: FoundSlots, true: TrueSlots) -> MatchedSlots:
    """Give found slots to true ones, the most confident first, each to the nearest that is left.

    Both ends have to be within `average_precision.WITHIN_PX` of the same ends. One that is at no slot that is left, but
    at one that does not count, counts neither for nor against.
    """
    kept: list[int] = []
    owner: list[int] = []
    is_free = true.counts.copy()
    for number in np.argsort(-found.confidence, kind="stable").tolist():
        apart = np.linalg.norm(true.entries_px - found.entries_px[number], axis=2).max(axis=1, initial=0.0)
        left = np.where(is_free, apart, np.inf)
        nearest = int(left.argmin()) if len(left) else -1
        if nearest >= 0 and left[nearest] <= WITHIN_PX:
            is_free[nearest] = False
        elif (~true.counts & (apart <= WITHIN_PX)).any():
            continue
        else:
            nearest = -1
        kept.append(number)
        owner.append(nearest)
    numbers, owners = np.array(kept, dtype=np.int64), np.array(owner, dtype=np.int64)
    middles, total = found.entries_px[numbers].mean(axis=1), int(true.counts.sum())
    return MatchedSlots(found.confidence[numbers], owners >= 0, middles, owners, total, numbers)


def pairs_of_corners(corners_px: Floats, is_occluded: NDArray[np.bool_]) -> TrueSlots:
    """The slots that follow from the entry corners in a photograph, which has the car at its right edge.

    Two corners that follow each other from front to back are a slot if both are seen, if they are 50 to 80 px apart,
    which is one stall at the scales of the photographs, and if their line is within 45 degrees of the car's. Other
    corners that follow each other and are at least 42 px apart, as at stalls along the aisle, at hidden corners and
    where one is missing, and those whose line is more than 45 degrees from the car's, may be slots or not: they do not
    count.

    Parameters
    ----------
    corners_px
        (column, row); float64, shape (n, 2).
    is_occluded
        Shape (n,).
    """
    order = np.argsort(corners_px[:, 1], kind="stable")
    places, is_seen = corners_px[order], ~is_occluded[order]
    entries, counts = [], []
    for upper in range(len(places)):
        for lower in range(upper + 1, len(places)):
            across, ahead = np.abs(places[lower] - places[upper])
            length, follows = float(np.hypot(across, ahead)), lower == upper + 1
            is_along = ahead >= across
            if (follows or not is_along) and length >= _COLUMN_PX:
                is_stall = follows and is_along and _STALL_PX[0] <= length <= _STALL_PX[1]
                entries.append((places[lower], places[upper]))
                counts.append(bool(is_stall and is_seen[upper] and is_seen[lower]))
    count = len(entries)
    directions = np.full((count, 2), np.nan)
    return TrueSlots(
        np.array(entries, dtype=np.float64).reshape(-1, 2, 2),
        directions,
        np.zeros(count, dtype=bool),
        np.array(counts, dtype=bool),
    )
