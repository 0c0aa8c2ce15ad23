"""Random numbers for what stands on squares, which in a large garage share them."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.randomness import Step, generator, named_generator
from garage2usd.structure.lane_graph import Square

__all__ = ["SquareDraws"]


class SquareDraws:
    """Random numbers for each square of a garage.

    Parameters
    ----------
    squares
        All squares, in reading order.
    seed
        The garage's seed.
    arrangements
        How many different draws the squares share, the same for every step, so that equal squares with the same one
        hold equal things; None where each square has draws of its own.
    """

    def __init__(self, squares: Iterable[Square], *, seed: int, arrangements: int | None = None) -> None:
        self._seed = seed
        self._rows = {square: row for row, square in enumerate(squares)}
        self._count = len(self._rows)
        if arrangements is not None:
            chosen = generator(seed, Step.ARRANGEMENTS).integers(arrangements, size=self._count).tolist()
            self._rows = dict(zip(self._rows, chosen, strict=True))
            self._count = arrangements

    def of_step(self, step: Step, *shape: int) -> dict[Square, NDArray[np.float64]]:
        """Uniform numbers from 0 to 1 of a shape for each square; the same for each call with the same step."""
        return self._shared(generator(self._seed, step).random((self._count, *shape)))

    def of_part(self, step: Step, name: str, *shape: int) -> dict[Square, NDArray[np.float64]]:
        """The same for a part of a step that has a name."""
        return self._shared(named_generator(self._seed, step, name).random((self._count, *shape)))

    def _shared(self, numbers: NDArray[np.float64]) -> dict[Square, NDArray[np.float64]]:
        return {square: numbers[row] for square, row in self._rows.items()}
