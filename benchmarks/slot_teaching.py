"""What a network of slots learns from drawn strips, measured on drawn strips of other garages and on photographs."""

import statistics
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from average_precision import Score, matched, score
from corner_network import Training
from slot_maps import true_slots
from slot_measures import Measured, Understood, in_drawn
from slot_network import train_slots
from slot_pairs import matched_slots, pairs_of_corners
from slots_sheet import write_slots_sheet
from strip_labels import StripLabels
from strips import Strip
from teachers import TOGETHER, figures

from garage2usd.common.progress import Progress, silent

__all__ = ["SlotOutcome", "measured_slots", "slot_table", "teach_slots"]


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
    in_photographs, in_drawn
        What the network of the last run finds.
    """

    name: str
    pictures: int
    drawn: list[Measured] = field(default_factory=list)
    pairs: dict[str, list[Score]] = field(default_factory=dict)
    corners: list[Score] = field(default_factory=list)
    in_photographs: list[Understood] = field(default_factory=list)
    in_drawn: list[Understood] = field(default_factory=list)


def teach_slots(
    name: str,
    learnt: Sequence[tuple[Strip, StripLabels]],
    aside: Sequence[tuple[Strip, StripLabels]],
    photographs: Sequence[Strip],
    *,
    runs: int,
    steps: int,
    output: Path,
) -> None:
    """Train on drawn strips so many times, and write tables and sheets of hits and misses into a folder."""
    start = time.monotonic()

    def tell(outcome: SlotOutcome) -> None:
        print(f"run {len(outcome.drawn)}, {time.monotonic() - start:.0f} s\n{slot_table([outcome])}", flush=True)

    def progress(_: str, done: int, total: int) -> None:
        print(f"train: {done} of {total} steps, {time.monotonic() - start:.0f} s", file=sys.stderr)

    output.mkdir(parents=True, exist_ok=True)
    outcome = SlotOutcome(f"{name}, {len({strip.garage for strip, _ in learnt})} garages", len(learnt))
    training = Training(steps=steps)
    measured_slots(outcome, learnt, aside, photographs, runs=runs, training=training, progress=progress, tell=tell)
    (output / "slots.md").write_text(f"{slot_table([outcome])}\n", encoding="utf-8")
    strips, labels = [strip for strip, _ in aside], [each for _, each in aside]
    truths, threshold = [true_slots(each) for each in labels], outcome.drawn[-1].slots.threshold
    write_slots_sheet(strips, outcome.in_drawn, truths, threshold, output / "slots_in_drawn.png", labels=labels)
    pairs = [pairs_of_corners(strip.corners_px, strip.is_occluded) for strip in photographs]
    threshold = outcome.pairs[TOGETHER][-1].threshold
    write_slots_sheet(photographs, outcome.in_photographs, pairs, threshold, output / "slots_in_photographs.png")


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
