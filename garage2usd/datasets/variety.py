"""Variety of a data set's plans: figures of plans and splits, and distances between nearest plans."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.drawn_plan import ContourShape
from garage2usd.structure.grid import Cell, CellArray
from garage2usd.structure.symmetry import canonical_cells, eight_symmetries, plan_digest

_ROWS_AT_ONCE = 1024
"""Number of plans compared at once, which limits memory."""


@dataclass(frozen=True, eq=False)
class PlanFigures:
    """A plan of a data set with its figures.

    Attributes
    ----------
    key
        Key of the plan in the data set.
    split
        Name of its split, for example ``train``.
    cells
        S, int8, shape (rows, cols).
    stalls
        Number of stalls.
    loops
        Number of independent loops of the lane graph.
    longest_dead_end_m
        Depth of the deepest dead end; 0 if there is none.
    area_per_stall_m2, gross_area_per_stall_m2
        Floor inside the contour per stall, without ramps and obstacles, and with them (0 where that is not known).
    contour
        Shape of the contour.
    level
        Difficulty of the garage; None if it is not rated.
    levels
        Number of levels; all figures but `cells` and `contour`, which are those of the top one, are of all levels.
    of_levels
        Digest of the plans of all levels; that of `cells` if left out.
    landings
        (row, col) of the portals in `cells` that lead to ramps between levels.
    """

    key: str
    split: str
    cells: CellArray
    stalls: int
    loops: int
    longest_dead_end_m: float
    area_per_stall_m2: float
    contour: ContourShape
    level: Level | None = None
    levels: int = 1
    of_levels: str | None = None
    gross_area_per_stall_m2: float = 0.0
    landings: tuple[tuple[int, int], ...] = ()

    @cached_property
    def canonical(self) -> CellArray:
        """Canonical form of S, as in `garage2usd.structure.symmetry.canonical_cells`."""
        return canonical_cells(self.cells)

    @cached_property
    def digest(self) -> str:
        """Digest of the plans of all levels, equal for their rotations and reflections."""
        return self.of_levels or plan_digest(self.canonical)

    @property
    def squares(self) -> int:
        """Number of squares inside the contour, without obstacles."""
        return int((self.cells != Cell.OBSTACLE).sum())


FIGURES = MappingProxyType(
    {
        "squares": "Squares",
        "stalls": "Stalls",
        "area_per_stall_m2": "Floor per stall, m\N{SUPERSCRIPT TWO}",
        "loops": "Loops",
        "longest_dead_end_m": "Longest dead end, m",
        "nearest_share": "Distance to the nearest plan, %",
    }
)
"""Figures of a set of plans, with title and unit; `Variety.values` returns their values."""


@dataclass(frozen=True, slots=True)
class Spread:
    """Range and mean of a figure over plans.

    Attributes
    ----------
    count
        Number of plans that have the figure.
    least, mean, greatest
        None if no plan has the figure.
    """

    count: int
    least: float | None
    mean: float | None
    greatest: float | None


class Variety:
    """The variety of a set of plans.

    Attributes
    ----------
    plans
        The plans in their order.
    splits
        Names of the splits, in the order of their first plans.
    nearest_share
        Distance of each plan to the nearest other plan, see `nearest_shares`; float64, shape (plans,).
    """

    def __init__(self, plans: Sequence[PlanFigures]) -> None:
        self.plans = tuple(plans)
        self.splits = tuple(dict.fromkeys(plan.split for plan in self.plans))
        self.nearest_share = nearest_shares([plan.canonical for plan in self.plans])

    def values(self, figure: str, *, split: str | None = None) -> NDArray[np.float64]:
        """Return a figure of all plans that have it, in order; nearest shares are in per cent.

        Parameters
        ----------
        figure
            Name of the figure, a key of `FIGURES`.
        split
            Split of the plans; all plans if left out.
        """
        if figure == "nearest_share":
            found = 100 * self.nearest_share
        else:
            found = np.array([getattr(plan, figure) for plan in self.plans], dtype=np.float64)
        is_asked = np.array([split is None or plan.split == split for plan in self.plans], dtype=np.bool_)
        values: NDArray[np.float64] = found[is_asked & ~np.isnan(found)]
        return values

    def spread(self, figure: str, *, split: str | None = None) -> Spread:
        """Compute least, mean and greatest value of a figure; parameters as for `values`."""
        values = self.values(figure, split=split).tolist()
        if not values:
            return Spread(0, None, None, None)
        return Spread(len(values), min(values), math.fsum(values) / len(values), max(values))

    def contours(self, *, split: str | None = None) -> dict[ContourShape, int]:
        """Count plans by contour shape, of a split or in total."""
        count = Counter(plan.contour for plan in self._of(split))
        return {shape: count[shape] for shape in ContourShape}

    def levels(self, *, split: str | None = None) -> dict[Level, int]:
        """Count plans by difficulty level, of a split or in total, without unrated ones."""
        count = Counter(plan.level for plan in self._of(split))
        return {level: count[level] for level in Level}

    def level_counts(self, *, split: str | None = None) -> dict[int, int]:
        """Count plans by their number of levels, of a split or in total."""
        count = Counter(plan.levels for plan in self._of(split))
        return {levels: count[levels] for levels in range(1, max((plan.levels for plan in self.plans), default=1) + 1)}

    @cached_property
    def distinct(self) -> int:
        """Number of plans that are distinct up to rotation and reflection."""
        return len({plan.digest for plan in self.plans})

    @cached_property
    def shared(self) -> int:
        """Number of plans that occur in several splits, up to rotation and reflection."""
        splits_of: dict[str, set[str]] = {}
        for plan in self.plans:
            splits_of.setdefault(plan.digest, set()).add(plan.split)
        return sum(len(splits) > 1 for splits in splits_of.values())

    def _of(self, split: str | None) -> Iterator[PlanFigures]:
        return (plan for plan in self.plans if split is None or plan.split == split)


def nearest_shares(plans: Sequence[CellArray]) -> NDArray[np.float64]:
    """Compute the distance of each plan to the nearest other plan of equal shape.

    Parameters
    ----------
    plans
        Canonical forms of S (see `garage2usd.structure.symmetry.canonical_cells`), int8, shape (rows, cols) each.

    Returns
    -------
    ndarray
        float64, shape (plans,): the least share of differing squares over all other plans of the same shape and their
        rotations and reflections, squares outside the contour included. 0 for duplicates, NaN if no other plan has the
        same shape.

    Notes
    -----
    Equal squares are counted for all pairs at once by matrix products of one-hot encodings; ten thousand plans of 7 x 9
    squares take a few seconds.
    """
    shares = np.full(len(plans), np.nan)
    members: dict[tuple[int, ...], list[int]] = {}
    for number, cells in enumerate(plans):
        members.setdefault(cells.shape, []).append(number)
    for numbers in members.values():
        if len(numbers) > 1:
            shares[numbers] = _nearest_of_shape(np.array([plans[number] for number in numbers]))
    return shares


def _nearest_of_shape(plans: NDArray[np.int8]) -> NDArray[np.float64]:
    """Compute nearest distances of at least two plans of one shape; int8, shape (plans, rows, cols)."""
    count, squares = len(plans), plans[0].size
    own = _indicators(plans)
    # a symmetry of the plans as a permutation of the numbers of the squares
    order = np.arange(squares).reshape(plans[0].shape)
    turns = [image.ravel() for image in eight_symmetries(order) if image.shape == order.shape]
    most = np.zeros(count, dtype=np.float32)
    for start in range(0, count, _ROWS_AT_ONCE):
        some = slice(start, start + _ROWS_AT_ONCE)
        for turn in turns:
            agreeing = own[some].reshape(-1, own.shape[1] * squares) @ own[:, :, turn].reshape(count, -1).T
            rows = np.arange(len(agreeing))
            agreeing[rows, start + rows] = -1  # a plan is not its own neighbour
            most[some] = np.maximum(most[some], agreeing.max(axis=1))
    shares: NDArray[np.float64] = 1 - most.astype(np.float64) / squares
    return shares


def _indicators(plans: NDArray[np.int8]) -> NDArray[np.float32]:
    """One-hot encode the squares of plans; float32, shape (plans, values, squares)."""
    flat = plans.reshape(len(plans), 1, -1)
    indicators: NDArray[np.float32] = (flat == np.array(list(Cell), dtype=np.int8)[:, None]).astype(np.float32)
    return indicators
