"""A plan: lanes on a site, with what is known of them."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.grid import Structure
from garage2usd.planning.score import Score, evaluate

__all__ = ["ArchivedPlan", "Plan", "given_plan"]


@dataclass(frozen=True, eq=False)
class ArchivedPlan:
    """One of the best plans met while learning."""

    structure: Structure
    score: Score


@dataclass(frozen=True, eq=False)
class Plan:
    """A complete structure with what is known of it.

    Attributes
    ----------
    structure
        S with lanes; every portal touches them and they form one piece, unless the user gave it otherwise.
    score
        Its figures.
    archive
        The best distinct plans, best first; empty for a given structure.
    learning_curve
        float64, shape (episodes,): G, the sum of the rewards of each episode without R_T; read-only.
    learnt_value
        y' of the best plan that learning alone met; what `score` has above it came from polish.
    steps
        Actions taken while learning.
    """

    structure: Structure
    score: Score
    archive: tuple[ArchivedPlan, ...] = ()
    learning_curve: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    learnt_value: float = 0.0
    steps: int = 0

    def __post_init__(self) -> None:
        """Keep a read-only copy of the curve."""
        curve = np.array(self.learning_curve, dtype=np.float64)
        curve.setflags(write=False)
        object.__setattr__(self, "learning_curve", curve)


def given_plan(structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> Plan:
    """Take a complete structure as it is: nothing is learnt, `plan` gives the weights of its score."""
    score = evaluate(structure, bay=bay, plan=plan)
    return Plan(structure, score, learnt_value=score.value)
