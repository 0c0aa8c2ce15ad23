"""How well slots and free ground are found in drawn strips, whose labels say what there is."""

import statistics
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from average_precision import Score, score
from numpy.typing import NDArray
from slot_maps import true_slots
from slot_pairs import FoundSlots, MarkingPoints, matched_slots
from strip_labels import StripLabels

__all__ = ["SURE", "Ground", "Measured", "Understood", "in_drawn"]

SURE = 0.5
"""From this on a slot is occupied, and ground is free."""


@dataclass(frozen=True, eq=False)
class Understood:
    """What a network makes of a strip.

    Attributes
    ----------
    points, slots
        The marking points, and the slots between them.
    occupied
        How surely each slot is occupied; float64, shape (n,).
    free
        How surely each pixel shows free ground; float64, shape (300, 96).
    """

    points: MarkingPoints
    slots: FoundSlots
    occupied: NDArray[np.float64]
    free: NDArray[np.float64]


@dataclass(frozen=True)
class Measured:
    """How well slots and free ground are found in drawn strips.

    Attributes
    ----------
    slots
        Of pairs.
    occupied
        Share of the slots found at the best F1 of which it is rightly said whether they are occupied.
    direction_deg
        Median angle between their directions and the true ones.
    free, taken
        Intersection over union of the pixels that show free ground, and of those that show anything else.
    """

    slots: Score
    occupied: float
    direction_deg: float
    free: float
    taken: float


@dataclass(frozen=True, eq=False)
class Ground:
    """Pixels of drawn strips, shape (2, 2): which show free ground and which not, and which are said to."""

    pixels: NDArray[np.int64]

    @classmethod
    def of(cls, said: NDArray[np.floating], labels: StripLabels) -> "Ground":
        """The pixels of a strip of which it is known."""
        true, is_said = labels.is_free[labels.is_known], (said >= SURE)[labels.is_known]
        return cls(np.array([[(kind & each).sum() for each in (is_said, ~is_said)] for kind in (true, ~true)]))

    def overlap(self, kind: int) -> float:
        """Intersection over union of free ground, 0, or of all else, 1."""
        union = self.pixels[kind].sum() + self.pixels[:, kind].sum() - self.pixels[kind, kind]
        return float(self.pixels[kind, kind] / union) if union else 1.0


def in_drawn(found: Sequence[Understood], labels: Sequence[StripLabels]) -> Measured:
    """How well slots and free ground are found in drawn strips.

    Raises
    ------
    ValueError
        If there is no slot to find.
    """
    truths = [true_slots(each) for each in labels]
    results = [matched_slots(each.slots, true) for each, true in zip(found, truths, strict=True)]
    slots = score(results)
    is_right: list[bool] = []
    angles_deg: list[float] = []
    for each, true, result in zip(found, truths, results, strict=True):
        hits = result.is_hit & (result.confidence >= slots.threshold)
        for number, owner in zip(result.number[hits], result.owner[hits], strict=True):
            is_right.append(bool((each.occupied[number] >= SURE) == true.is_occupied[owner]))
            cosine = float(each.slots.direction[number] @ true.direction[owner])
            angles_deg.append(float(np.degrees(np.arccos(np.clip(cosine, -1, 1)))))
    ground = Ground(sum(Ground.of(each.free, known).pixels for each, known in zip(found, labels, strict=True)))
    occupied = statistics.mean(is_right) if is_right else 0.0
    direction = statistics.median(angles_deg) if angles_deg else 180.0
    return Measured(slots, float(occupied), direction, ground.overlap(0), ground.overlap(1))
