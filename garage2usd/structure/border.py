"""Grids padded with a border, so that every square has neighbours on all sides."""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["bordered"]

Number = TypeVar("Number", bound=np.generic)


def bordered(grid: NDArray[Number], value: Any = 0) -> NDArray[Number]:  # noqa: ANN401 - whatever the grid holds
    """Pad a grid with a border of one square on each side.

    Parameters
    ----------
    grid
        Shape (rows, cols).
    value
        Value of the border.

    Returns
    -------
    NDArray
        Shape (rows + 2, cols + 2), of the grid's type.

    Notes
    -----
    Equivalent to `numpy.pad`, which takes ten times as long on grids of the size of most garages.
    """
    rows, cols = grid.shape
    wide = np.full((rows + 2, cols + 2), value, dtype=grid.dtype)
    wide[1:-1, 1:-1] = grid
    return wide
