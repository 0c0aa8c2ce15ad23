"""Corners found against the true ones: average precision, and the best F1."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["WITHIN_PX", "Detections", "Matched", "Score", "at_threshold", "matched", "score"]

WITHIN_PX = 6.0
"""How far from a true corner a found one may be: 0.2 m in pictures of 1/30 m a pixel."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Detections:
    """Corners found in a picture.

    Attributes
    ----------
    places_px
        (column, row); float64, shape (n, 2).
    confidence
        Of each; float64, shape (n,).
    """

    places_px: Floats
    confidence: Floats


@dataclass(frozen=True, eq=False)
class Matched:
    """What became of the corners of one picture.

    Attributes
    ----------
    confidence, is_hit
        Of each found corner that counts, and whether it is at a true one; shapes (n,).
    places_px
        Where they are; float64, shape (n, 2).
    owner
        Index of the true corner that each is at, -1 for none; int64, shape (n,).
    true
        How many corners there are to find.
    """

    confidence: Floats
    is_hit: NDArray[np.bool_]
    places_px: Floats
    owner: NDArray[np.int64]
    true: int


@dataclass(frozen=True)
class Score:
    """How well corners are found.

    Attributes
    ----------
    average_precision
        Area under the curve of precision over recall, each precision being the best at that recall or above.
    best_f1
        Over all thresholds of confidence.
    threshold
        The confidence of the last corner that counts as found at the best F1.
    """

    average_precision: float
    best_f1: float
    threshold: float


def matched(found: Detections, corners_px: Floats, is_occluded: NDArray[np.bool_]) -> Matched:
    """Give the found corners of a picture to true ones, the most confident first, each to the nearest that is left.

    One that is at no corner that is left, but at an occluded one, does not count, neither for nor against.
    """
    seen, hidden = corners_px[~is_occluded], corners_px[is_occluded]
    order = np.argsort(-found.confidence, kind="stable")
    is_free = np.ones(len(seen), dtype=bool)
    kept: list[int] = []
    owner: list[int] = []
    for number in order.tolist():
        place = found.places_px[number]
        distance_px = np.where(is_free, np.hypot(*(seen - place).T), np.inf)
        nearest = int(distance_px.argmin()) if len(seen) else -1
        if nearest >= 0 and distance_px[nearest] <= WITHIN_PX:
            is_free[nearest] = False
        elif (np.hypot(*(hidden - place).T) <= WITHIN_PX).any():
            continue
        else:
            nearest = -1
        kept.append(number)
        owner.append(nearest)
    owners = np.array(owner, dtype=np.int64)
    return Matched(found.confidence[kept], owners >= 0, found.places_px[kept], owners, len(seen))


def score(pictures: Sequence[Matched]) -> Score:
    """The score of all pictures together.

    Raises
    ------
    ValueError
        If there is no corner to find.
    """
    true = _true(pictures)
    confidence = np.concatenate([picture.confidence for picture in pictures])
    is_hit = np.concatenate([picture.is_hit for picture in pictures])
    order = np.argsort(-confidence, kind="stable")
    confidence, is_hit = confidence[order], is_hit[order]
    # what is equally sure counts together
    last = np.flatnonzero(np.append(np.diff(confidence) != 0, True)) if len(confidence) else np.zeros(0, dtype=np.int64)
    hits = np.cumsum(is_hit)[last]
    precision, recall = hits / (last + 1), hits / true
    envelope = np.maximum.accumulate(precision[::-1])[::-1]
    average = float((np.diff(recall, prepend=0.0) * envelope).sum())
    f1 = 2 * hits / (last + 1 + true)
    best = int(f1.argmax()) if len(f1) else -1
    return Score(average, float(f1[best]) if best >= 0 else 0.0, float(confidence[last[best]]) if best >= 0 else 1.0)


def at_threshold(pictures: Sequence[Matched], threshold: float) -> tuple[float, float]:
    """Recall and precision of what is at least so sure, all pictures together; without any found, precision is 1.

    Raises
    ------
    ValueError
        If there is no corner to find.
    """
    true = _true(pictures)
    found = sum(int((picture.confidence >= threshold).sum()) for picture in pictures)
    hits = sum(int(picture.is_hit[picture.confidence >= threshold].sum()) for picture in pictures)
    return hits / true, hits / found if found else 1.0


def _true(pictures: Sequence[Matched]) -> int:
    """How many corners there are to find in all pictures, at least one."""
    true = sum(picture.true for picture in pictures)
    if not true:
        raise ValueError("no corner to find")
    return true
