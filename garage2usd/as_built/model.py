"""Meshes of an object in its own coordinates, placed many times."""

from dataclasses import dataclass
from functools import cached_property
from itertools import repeat

import numpy as np

from garage2usd.as_built.shapes import Array, Body

_DIGITS = 12
"""Digits of a mesh's place in its object: what sines and cosines of half a turn have beyond is noise."""


@dataclass(frozen=True, eq=False)
class Model:
    """Meshes of an object in its own coordinates, of which there may be many in a garage.

    Attributes
    ----------
    bodies
        The meshes, placed in the object.
    """

    bodies: tuple[Body, ...]

    @cached_property
    def _matrices(self) -> Array | None:
        """Place of each mesh; None if all are in the axes of the object, as most are."""
        matrices = np.round([body.matrix for body in self.bodies], _DIGITS).reshape(-1, 4, 4)
        return None if (matrices == np.eye(4)).all() else matrices

    def placed(self, matrix: Array) -> tuple[Body, ...]:
        """Return the meshes of an object that a matrix places, for row vectors; float64, shape (4, 4)."""
        places = repeat(matrix) if self._matrices is None else self._matrices @ matrix
        return tuple(
            Body(shape, place, touches) for (shape, _, touches), place in zip(self.bodies, places, strict=False)
        )
