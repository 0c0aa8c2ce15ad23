"""Plans: lanes on a site with their score, archive and learning curve."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning.dimensions import dimensioned
from garage2usd.planning.score import Score, evaluate
from garage2usd.structure.directions import BOTH_WAYS, LaneDirections, stretches_of
from garage2usd.structure.grid import Structure
from garage2usd.structure.stall_runs import StallRun

__all__ = ["ArchivedPlan", "Plan", "given_plan"]


@dataclass(frozen=True, eq=False)
class ArchivedPlan:
    """One of the best plans found.

    Attributes
    ----------
    structure, score
        The plan and its figures, on the squares' sides that it was learnt with.
    is_polished
        Whether local search found it, rather than learning.
    """

    structure: Structure
    score: Score
    is_polished: bool = False


@dataclass(frozen=True, eq=False)
class Plan:
    """A complete structure with its score and the record of its planning.

    Attributes
    ----------
    structure
        S with lanes; every portal touches them and they form one piece, unless the user gave it otherwise.
    score
        Its figures.
    archive
        Best distinct plans, best first; empty for a given structure.
    learning_curve
        float64, shape (episodes,): G, the sum of the rewards of each episode without R_T; read-only.
    learnt
        Best plan of learning alone; None for a given structure.
    steps
        Actions taken while learning.
    gave_way
        Broken rules of circulation by name, each with place and amount.
    runs
        Kinds and sizes of the stalls, run by run; empty if all are perpendicular and of the standard size.
    directions
        One-way lanes.
    """

    structure: Structure
    score: Score
    archive: tuple[ArchivedPlan, ...] = ()
    learning_curve: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    learnt: ArchivedPlan | None = None
    steps: int = 0
    gave_way: Mapping[str, str] = field(default_factory=dict)
    runs: tuple[StallRun, ...] = ()
    directions: LaneDirections = BOTH_WAYS

    @property
    def stretches(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """Squares of each stretch of lane from one junction or dead end to the next, in reading order."""
        return stretches_of(self.structure)

    @property
    def one_way_stretches(self) -> tuple[tuple[tuple[int, int], ...], ...]:
        """Squares of each one-way stretch in the direction of driving, in reading order."""
        return self.directions.stretches(self.structure)

    def __post_init__(self) -> None:
        """Keep read-only copies of the curve and of the rules that gave way."""
        curve = np.array(self.learning_curve, dtype=np.float64)
        curve.setflags(write=False)
        object.__setattr__(self, "learning_curve", curve)
        object.__setattr__(self, "gave_way", MappingProxyType(dict(self.gave_way)))

    def __reduce__(self) -> tuple[object, ...]:
        """Pickle the fields: read-only mappings cannot be pickled, and arrays forget that they are read-only."""
        fields = self.structure, self.score, self.archive, self.learning_curve, self.learnt, self.steps
        return type(self), (*fields, dict(self.gave_way), self.runs, self.directions)


def given_plan(structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> Plan:
    """Wrap a complete structure as a plan; `plan` gives the weights of its score.

    R and C are chosen for them where the settings say so and give none.
    """
    sized = dimensioned(structure, bay)
    return Plan(sized, evaluate(sized, bay=bay, plan=plan))
