"""What a network learns from, and how well it then finds corners in photographs of garages that it never saw."""

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from average_precision import Detections, Score, matched, score
from corner_network import CornerNetwork, Training, train
from strips import Strip

from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent

__all__ = ["TOGETHER", "Outcome", "Teacher", "Training", "figures", "measured", "photographs_of_others", "table"]

TOGETHER = "together"
"""All garages of photographs."""


@dataclass(frozen=True, eq=False)
class Teacher:
    """Strips that networks learn from.

    Attributes
    ----------
    name
        What tables call it.
    lessons
        What one network learns from, and the garages that it is tested on.
    """

    name: str
    lessons: Sequence[tuple[Sequence[Strip], frozenset[str]]]

    @property
    def pictures(self) -> str:
        """How many each of its networks learns from."""
        return " / ".join(f"{len(strips):,}" for strips, _ in self.lessons)


@dataclass
class Outcome:
    """How well what learnt from a teacher finds corners.

    Attributes
    ----------
    teacher
        The teacher.
    scores
        By garage and `TOGETHER`, of each run.
    networks, found
        Of the last run: the networks, one a lesson, and for each photograph by its name what is found in it.
    """

    teacher: Teacher
    scores: dict[str, list[Score]] = field(default_factory=dict)
    networks: list[CornerNetwork] = field(default_factory=list)
    found: dict[str, Detections] = field(default_factory=dict)


def photographs_of_others(photographs: Sequence[Strip]) -> Teacher:
    """The teacher of each garage is the photographs of all others.

    Raises
    ------
    ConfigError
        If there are photographs of one garage alone.
    """
    garages = sorted({strip.garage for strip in photographs})
    if len(garages) == 1:
        raise ConfigError("FOLDER", garages[0], "photographs of two garages at least, as one is the other's teacher")
    lessons = [([strip for strip in photographs if strip.garage != each], frozenset([each])) for each in garages]
    return Teacher("photographs of the others", lessons)


def measured(
    teacher: Teacher,
    photographs: Sequence[Strip],
    *,
    runs: int,
    training: Training,
    progress: Progress = silent,
    tell: Callable[[Outcome], None] = lambda _: None,
) -> Outcome:
    """Train on a teacher and test on photographs of garages that it does not show.

    Parameters
    ----------
    teacher
        What is learnt from.
    photographs
        What is tested on.
    runs
        How many starts; the first ones are the same for all teachers.
    training
        How.
    progress
        Called with the steps of a training that are done.
    tell
        Called after each run.
    """
    outcome = Outcome(teacher)
    for run in range(runs):
        outcome.networks, outcome.found = [], {}
        for strips, garages in teacher.lessons:
            network = train(strips, training, run, progress)
            asked = [strip for strip in photographs if strip.garage in garages]
            outcome.networks.append(network)
            outcome.found |= zip((strip.name for strip in asked), network.detect(asked), strict=True)
        for garage in (*sorted({strip.garage for strip in photographs}), TOGETHER):
            results = [
                matched(outcome.found[strip.name], strip.corners_px, strip.is_occluded)
                for strip in photographs
                if garage in {strip.garage, TOGETHER}
            ]
            outcome.scores.setdefault(garage, []).append(score(results))
        tell(outcome)
    return outcome


def table(outcomes: Sequence[Outcome]) -> str:
    """Average precision by teacher and garage, mean and range over the runs, and the best F1 of all together."""
    garages = list(outcomes[0].scores)
    rows = [
        f"| learnt from | pictures | {' | '.join(f'AP, {garage}' for garage in garages)} | best F1, {TOGETHER} |",
        "|---|---|" + "---|" * (len(garages) + 1),
    ]
    for outcome in outcomes:
        columns = [figures([each.average_precision for each in outcome.scores[garage]]) for garage in garages]
        columns.append(figures([each.best_f1 for each in outcome.scores[TOGETHER]]))
        rows.append(f"| {outcome.teacher.name} | {outcome.teacher.pictures} | {' | '.join(columns)} |")
    return "\n".join(rows)


def figures(values: Sequence[float]) -> str:
    """The mean of some runs, and the range that they have."""
    mean = f"{statistics.mean(values):.3f}"
    return mean if len(values) == 1 else f"{mean} ({min(values):.3f} to {max(values):.3f})"
