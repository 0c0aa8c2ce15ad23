"""What a network of slots learns from drawn strips, measured on drawn strips of other garages and on photographs."""

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from average_precision import Score, matched, score
from corner_network import Training
from slot_measures import Measured, Understood, in_drawn
from slot_network import SlotNetwork, train_slots
from slot_pairs import matched_slots, pairs_of_corners
from strip_labels import StripLabels
from strips import Strip
from teachers import TOGETHER, figures

from garage2usd.common.progress import Progress, silent

__all__ = ["SlotOutcome", "measured_slots", "slot_table"]


@dataclass
class SlotOutcome:
    """What was measured after each training.

    Attributes
    ----------
    name, pictures
        Of what was learnt from, and how many.
    drawn
        On drawn strips that nothing was learnt from, of each run.
    pairs, corners
        On photographs, by garage and `TOGETHER`, of each run.
    network, in_photographs, in_drawn
        Of the last run: the network, and what it finds.
    """

    name: str
    pictures: int
    drawn: list[Measured] = field(default_factory=list)
    pairs: dict[str, list[Score]] = field(default_factory=dict)
    corners: list[Score] = field(default_factory=list)
    network: SlotNetwork | None = None
    in_photographs: list[Understood] = field(default_factory=list)
    in_drawn: list[Understood] = field(default_factory=list)


def measured_slots(
    outcome: SlotOutcome,
    learnt: Sequence[tuple[Strip, StripLabels]],
    aside: Sequence[tuple[Strip, StripLabels]],
    photographs: Sequence[Strip],
    *,
    runs: int,
    training: Training,
    progress: Progress = silent,
    tell: Callable[[SlotOutcome], None] = lambda _: None,
) -> SlotOutcome:
    """Train on drawn strips, measure on those that are aside and on photographs, and `tell` of it after each run."""
    garages = sorted({strip.garage for strip in photographs})
    pairs = [pairs_of_corners(strip.corners_px, strip.is_occluded) for strip in photographs]
    for run in range(runs):
        network = train_slots(learnt, training, run, progress)
        outcome.network = network
        outcome.in_drawn = network.understand([strip for strip, _ in aside])
        outcome.drawn.append(in_drawn(outcome.in_drawn, [labels for _, labels in aside]))
        outcome.in_photographs = network.understand(photographs)
        results = [matched_slots(each.slots, true) for each, true in zip(outcome.in_photographs, pairs, strict=True)]
        for garage in (*garages, TOGETHER):
            chosen = [
                result for result, strip in zip(results, photographs, strict=True) if garage in {strip.garage, TOGETHER}
            ]
            outcome.pairs.setdefault(garage, []).append(score(chosen))
        corners = [
            matched(each.points.detections, strip.corners_px, strip.is_occluded)
            for each, strip in zip(outcome.in_photographs, photographs, strict=True)
        ]
        outcome.corners.append(score(corners))
        tell(outcome)
    return outcome


def slot_table(outcomes: Sequence[SlotOutcome]) -> str:
    """Two tables: what is measured on drawn garages, and on photographs; mean and range over the runs."""
    garages = list(outcomes[0].pairs)
    drawn = [
        "| learnt from | pictures | AP, pairs | best F1 | occupied or free | direction | IoU, free | IoU, not free |"
    ]
    pairs = " | ".join(f"AP of pairs, {garage}" for garage in garages)
    real = [f"| learnt from | {pairs} | best F1, {TOGETHER} | AP of corners |"]
    drawn.append("|---|" + "---|" * (drawn[0].count("|") - 2))
    real.append("|---|" + "---|" * (real[0].count("|") - 2))
    for outcome in outcomes:
        each = outcome.drawn
        columns = [
            figures([one.slots.average_precision for one in each]),
            figures([one.slots.best_f1 for one in each]),
            figures([one.occupied for one in each]),
            f"{statistics.mean(one.direction_deg for one in each):.1f} degrees",
            figures([one.free for one in each]),
            figures([one.taken for one in each]),
        ]
        drawn.append(f"| {outcome.name} | {outcome.pictures:,} | {' | '.join(columns)} |")
        columns = [figures([one.average_precision for one in outcome.pairs[garage]]) for garage in garages]
        columns += [figures([one.best_f1 for one in outcome.pairs[TOGETHER]])]
        columns += [figures([one.average_precision for one in outcome.corners])]
        real.append(f"| {outcome.name} | {' | '.join(columns)} |")
    return "\n".join([*drawn, "", *real])
