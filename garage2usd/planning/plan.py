"""A plan: lanes on a site, with what is known of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning.dimensions import dimensioned
from garage2usd.planning.score import Score, evaluate
from garage2usd.structure.grid import Structure

__all__ = ["ArchivedPlan", "Plan", "given_plan"]


@dataclass(frozen=True, eq=False)
class ArchivedPlan:
    """One of the best plans met.

    Attributes
    ----------
    structure, score
        The plan and its figures, on the squares' sides that it was learnt with.
    is_polished
        Whether polish made it; else learning met it.
    """

    structure: Structure
    score: Score
    is_polished: bool = False


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
    learnt
        The best plan that learning alone met; None for a given structure.
    steps
        Actions taken while learning.
    gave_way
        The rules of circulation that the structure breaks though they are asked for, by name, each with where and by
        how much.
    """

    structure: Structure
    score: Score
    archive: tuple[ArchivedPlan, ...] = ()
    learning_curve: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    learnt: ArchivedPlan | None = None
    steps: int = 0
    gave_way: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Keep read-only copies of the curve and of the rules that gave way."""
        curve = np.array(self.learning_curve, dtype=np.float64)
        curve.setflags(write=False)
        object.__setattr__(self, "learning_curve", curve)
        object.__setattr__(self, "gave_way", MappingProxyType(dict(self.gave_way)))

    def __reduce__(self) -> tuple[object, ...]:
        """What it is made of, as read-only mappings cannot be pickled and arrays forget that they are read-only."""
        fields = self.structure, self.score, self.archive, self.learning_curve, self.learnt, self.steps
        return type(self), (*fields, dict(self.gave_way))


def given_plan(structure: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> Plan:
    """Take the lanes of a complete structure as they are; `plan` gives the weights of its score.

    R and C are chosen for them where the settings say so and give none.
    """
    sized = dimensioned(structure, bay)
    return Plan(sized, evaluate(sized, bay=bay, plan=plan))
