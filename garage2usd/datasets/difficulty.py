"""How difficult stalls and garages are, from 0 to 1 and in three levels, measured against a fixed set of garages."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.common.documents import MAX_SETTINGS_BYTES, read_json
from garage2usd.common.settings import Record
from garage2usd.datasets.stall_features import StallFeatures, measured_stalls
from garage2usd.driving import StallProof
from garage2usd.pipeline import Garage

__all__ = [
    "REFERENCE_FILE",
    "GarageDifficulty",
    "Level",
    "Reference",
    "ReferenceGarage",
    "StallDifficulty",
    "garage_difficulty",
    "midranks",
    "proven_values",
    "ranked",
    "reference",
    "scores_of",
    "stall_difficulties",
]

REFERENCE_FILE = Path(__file__).with_name("difficulty.json")
_DIGITS = 6

_HARDER = MappingProxyType(
    {
        "gear_changes": 1,
        "clearance_m": -1,
        "is_clear_when_full": -1,
        "aisle_width_m": -1,
        "occupied_neighbours": 1,
        "illuminance_lux": -1,
    }
)
"""The features that make the score: whether more of it is harder (1) or easier (-1)."""


class Level(StrEnum):
    """How difficult a stall or a garage is: a third of the reference is of each level."""

    NORMAL = "normal"
    COMPLEX = "complex"
    EXTREME = "extreme"


@dataclass(frozen=True, slots=True)
class StallDifficulty:
    """How difficult it is to park in a stall and to leave it.

    Attributes
    ----------
    stall
        Its name.
    features
        What was measured.
    score
        From 0, easier than all of the reference, to 1; None where no ways are proven.
    level
        None where no ways are proven.
    """

    stall: str
    features: StallFeatures
    score: float | None
    level: Level | None


@dataclass(frozen=True, slots=True)
class GarageDifficulty:
    """How difficult the stalls of a garage are together.

    Attributes
    ----------
    score
        Mean of its stalls' scores; None where no stall is proven.
    level
        By the scores of the garages of the reference; None where no stall is proven.
    normal, complex, extreme
        How many of its stalls are of each level.
    unproven
        How many of its stalls take cars and have no proven ways; they count for nothing else.
    """

    score: float | None
    level: Level | None
    normal: int
    complex: int
    extreme: int
    unproven: int


class ReferenceGarage(Record):
    """A garage of the reference set."""

    seed: int
    """By which `garage2usd.datasets.reference` makes it."""
    stalls: int
    """How many of its stalls take cars and are proven."""
    unproven: int
    """How many take cars and are not."""
    score: float
    """Mean of the scores of those that are proven."""


class Reference(Record):
    """The set of garages that difficulty is measured against."""

    stalls: int
    """How many proven stalls it has in all."""
    quantiles: dict[str, tuple[float, ...]]
    """Of each feature, of all proven stalls: evenly spaced quantiles from the least value to the greatest."""
    stall_scores: tuple[float, ...]
    """The same of the stalls' scores."""
    stall_terciles: tuple[float, float]
    """The greatest score of a stall of the level normal, and of the level complex."""
    garage_terciles: tuple[float, float]
    """The same of garages."""
    garages: tuple[ReferenceGarage, ...]
    """Its garages."""


@cache
def reference() -> Reference:
    """The reference set that the package ships, made by `garage2usd.datasets.reference`."""
    return Reference.model_validate(read_json(REFERENCE_FILE, field="reference", max_bytes=MAX_SETTINGS_BYTES))


def stall_difficulties(garage: Garage, *, proofs: Sequence[StallProof] | None = None) -> tuple[StallDifficulty, ...]:
    """How difficult each stall of a garage is that takes cars, in the order of the layout.

    Parameters
    ----------
    garage
        The garage.
    proofs
        What `garage2usd.driving.prove_stalls` found for it; left out, it is asked here.

    Raises
    ------
    ConfigError
        If the proofs are not those of the garage's stalls.

    Notes
    -----
    The score is the mean of a stall's ranks in the reference set, each from 0 for the easiest to 1 for the hardest:
    by changes of gear on both ways together, clearance, whether the ways are clear when the garage is full, clear
    width of the aisle, occupied neighbours and illuminance. Equal values share the middle of their ranks, so that a
    feature in which most stalls are alike hardly tells them apart. A stall without proven ways has no score, as
    nothing says that the task can be solved at all.
    """
    return ranked(measured_stalls(garage, proofs=proofs), reference())


def garage_difficulty(stalls: Sequence[StallDifficulty]) -> GarageDifficulty:
    """How difficult a garage is, by its stalls.

    Parameters
    ----------
    stalls
        What `stall_difficulties` has for it.
    """
    scores = [stall.score for stall in stalls if stall.score is not None]
    count = Counter(stall.level for stall in stalls)
    score = round(math.fsum(scores) / len(scores), _DIGITS) if scores else None
    return GarageDifficulty(
        score,
        _level(score, reference().garage_terciles),
        normal=count[Level.NORMAL],
        complex=count[Level.COMPLEX],
        extreme=count[Level.EXTREME],
        unproven=count[None],
    )


def ranked(features: Sequence[StallFeatures], against: Reference) -> tuple[StallDifficulty, ...]:
    """Score and level of stalls that were measured, against a reference set."""
    scores = iter(scores_of(features, against.quantiles).tolist())
    found = []
    for stall in features:
        score = next(scores) if stall.is_proven else None
        found.append(StallDifficulty(stall.stall, stall, score, _level(score, against.stall_terciles)))
    return tuple(found)


def scores_of(features: Sequence[StallFeatures], quantiles: Mapping[str, ArrayLike]) -> NDArray[np.float64]:
    """Scores of the proven ones of some stalls.

    Parameters
    ----------
    features
        What was measured of the stalls.
    quantiles
        Of each feature, as `Reference` has them.

    Returns
    -------
    ndarray
        float64, shape (proven stalls,), rounded to a millionth.
    """
    ranks = []
    for name, values in proven_values(features).items():
        rank = midranks(values, quantiles[name])
        ranks.append(rank if _HARDER[name] > 0 else 1 - rank)
    scores: NDArray[np.float64] = np.round(np.mean(ranks, axis=0), _DIGITS)
    return scores


def proven_values(features: Sequence[StallFeatures]) -> dict[str, NDArray[np.float64]]:
    """The features that make the score, by their names, of the proven ones of some stalls; each of shape (proven,)."""
    rows = [
        (
            (stall.gear_changes_in or 0) + (stall.gear_changes_out or 0),
            stall.clearance_m,
            stall.is_clear_when_full,
            stall.aisle_width_m,
            stall.occupied_neighbours,
            stall.illuminance_lux,
        )
        for stall in features
        if stall.is_proven
    ]
    columns = np.array(rows, dtype=np.float64).reshape(-1, len(_HARDER)).T
    return dict(zip(_HARDER, columns, strict=True))


def midranks(values: ArrayLike, quantiles: ArrayLike) -> NDArray[np.float64]:
    """Shares of a distribution that lie below some values, and half of what is equal to them.

    Parameters
    ----------
    values
        The values, shape (n,).
    quantiles
        The distribution: at least two evenly spaced quantiles, ascending, the least and the greatest value among them.

    Returns
    -------
    ndarray
        float64, shape (n,), from 0 to 1; ascending with the values, and 0.5 for the only value of a constant.
    """
    asked, known = np.asarray(values, dtype=np.float64), np.asarray(quantiles, dtype=np.float64)
    first, after = np.searchsorted(known, asked, "left"), np.searchsorted(known, asked, "right")
    # between two quantiles the share rises from the last place of the lower one to the first of the higher one
    below = np.clip(first - 1, 0, None)
    above = np.clip(first, None, len(known) - 1)
    gap = known[above] - known[below]
    part = np.divide(asked - known[below], gap, out=np.zeros_like(asked), where=gap > 0)
    places = np.where(after > first, (first + after - 1) / 2, below + np.clip(part, 0, 1) * (above - below))
    places = np.where(asked > known[-1], len(known) - 1, places)
    shares: NDArray[np.float64] = places / (len(known) - 1)
    return shares


def _level(score: float | None, terciles: tuple[float, float]) -> Level | None:
    if score is None:
        return None
    return tuple(Level)[sum(score > tercile for tercile in terciles)]
