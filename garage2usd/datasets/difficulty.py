"""Difficulty of stalls and garages: a score from 0 to 1 and three levels, relative to a reference set of garages."""

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
from garage2usd.garage_model import Garage, GarageLevel

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
"""Features of the difficulty score, with 1 if larger values are harder and -1 if they are easier."""


class Level(StrEnum):
    """Level of difficulty of a stall or a garage; each level has a third of the reference set."""

    NORMAL = "normal"
    COMPLEX = "complex"
    EXTREME = "extreme"


@dataclass(frozen=True, slots=True)
class StallDifficulty:
    """Difficulty of parking in a stall and leaving it.

    Attributes
    ----------
    stall
        Name of the stall.
    features
        Measured features.
    score
        Score from 0 (easier than the whole reference set) to 1; None without proven drives.
    level
        None without proven drives.
    """

    stall: str
    features: StallFeatures
    score: float | None
    level: Level | None


@dataclass(frozen=True, slots=True)
class GarageDifficulty:
    """Difficulty of a garage, aggregated over its stalls.

    Attributes
    ----------
    score
        Mean of the stalls' scores; None without proven stalls.
    level
        Level relative to the reference garages' scores; None without proven stalls.
    normal, complex, extreme
        Number of stalls of each level.
    unproven
        Number of stalls for cars without proven drives; they do not affect the other fields.
    """

    score: float | None
    level: Level | None
    normal: int
    complex: int
    extreme: int
    unproven: int


class ReferenceGarage(Record):
    """A garage of the difficulty reference set."""

    seed: int
    """Seed of the garage in `garage2usd.datasets.reference`."""
    stalls: int
    """Number of proven stalls for cars."""
    unproven: int
    """Number of unproven stalls for cars."""
    score: float
    """Mean score of the proven stalls."""


class Reference(Record):
    """The reference set of garages for difficulty."""

    stalls: int
    """Total number of proven stalls."""
    quantiles: dict[str, tuple[float, ...]]
    """Evenly spaced quantiles of each feature over all proven stalls, from the least to the greatest value."""
    stall_scores: tuple[float, ...]
    """Evenly spaced quantiles of the stalls' scores."""
    stall_terciles: tuple[float, float]
    """Greatest stall score of the level normal, and of the level complex."""
    garage_terciles: tuple[float, float]
    """Greatest garage score of the level normal, and of the level complex."""
    garages: tuple[ReferenceGarage, ...]
    """Garages of the reference set."""


@cache
def reference() -> Reference:
    """Load the shipped difficulty reference set, made by `garage2usd.datasets.reference`."""
    return Reference.model_validate(read_json(REFERENCE_FILE, field="reference", max_bytes=MAX_SETTINGS_BYTES))


def stall_difficulties(
    garage: Garage | GarageLevel, *, proofs: Sequence[StallProof] | None = None
) -> tuple[StallDifficulty, ...]:
    """Rate the difficulty of each stall for cars in a garage, in the order of the layout.

    Parameters
    ----------
    garage
        The garage of one level, or a level of one.
    proofs
        Result of `garage2usd.driving.prove_stalls` for the garage; computed if left out.

    Raises
    ------
    ConfigError
        If the proofs are not those of the garage's stalls.

    Notes
    -----
    The score is the mean of a stall's ranks in the reference set, each from 0 for the easiest to 1 for the hardest:
    gear changes on both drives, clearance, clearance in the full garage, clear width of the aisle, occupied neighbours
    and illuminance. Equal values share their mid-rank, so a feature that is equal for most stalls has little effect. A
    stall without proven drives has no score, since the task may be infeasible.
    """
    return ranked(measured_stalls(garage, proofs=proofs), reference())


def garage_difficulty(stalls: Sequence[StallDifficulty]) -> GarageDifficulty:
    """Rate the difficulty of a garage by its stalls.

    Parameters
    ----------
    stalls
        Result of `stall_difficulties` for the garage.
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
    """Rate measured stalls against a reference set."""
    scores = iter(scores_of(features, against.quantiles).tolist())
    found = []
    for stall in features:
        score = next(scores) if stall.is_proven else None
        found.append(StallDifficulty(stall.stall, stall, score, _level(score, against.stall_terciles)))
    return tuple(found)


def scores_of(features: Sequence[StallFeatures], quantiles: Mapping[str, ArrayLike]) -> NDArray[np.float64]:
    """Compute the difficulty scores of proven stalls; unproven ones are skipped.

    Parameters
    ----------
    features
        Measured features of the stalls.
    quantiles
        Quantiles of each feature, as in `Reference`.

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
    """Return the scored features of proven stalls by name; each of shape (proven,)."""
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
    """Compute mid-ranks: the share of a distribution below each value, plus half of the share equal to it.

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
    return places / (len(known) - 1)


def _level(score: float | None, terciles: tuple[float, float]) -> Level | None:
    if score is None:
        return None
    return tuple(Level)[sum(score > tercile for tercile in terciles)]
