"""Random numbers for each square, shared between squares of a large garage."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.randomness import Step, generator, named_generator
from garage2usd.structure.lane_graph import Square


class SquareDraws:
    """Random numbers for each square of a garage, by random step.

    Parameters
    ----------
    squares
        All squares, in reading order.
    seed
        Seed of the garage.
    arrangements
        Number of different arrangements that the squares share, for all steps: equal squares with the same arrangement
        have equal objects. None for independent numbers of each square.
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
        """Return an array of uniform numbers from 0 to 1 for each square, deterministic by step."""
        return self._by_square(generator(self._seed, step).random((self._count, *shape)))

    def of_part(self, step: Step, name: str, *shape: int) -> dict[Square, NDArray[np.float64]]:
        """Return an array of uniform numbers from 0 to 1 for each square, deterministic by step and name."""
        return self._by_square(named_generator(self._seed, step, name).random((self._count, *shape)))

    def of_all(self, step: Step, name: str, count: int) -> NDArray[np.float64]:
        """Return uniform numbers from 0 to 1 for the garage as a whole, deterministic by step and name."""
        return named_generator(self._seed, step, name).random(count)

    def _by_square(self, numbers: NDArray[np.float64]) -> dict[Square, NDArray[np.float64]]:
        """Distribute the rows of an array to the squares."""
        return {square: numbers[row] for square, row in self._rows.items()}
