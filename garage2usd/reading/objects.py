"""The objects of a composed stage: what each is, where it stands, and which prims draw it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.reading.inheritance import NOTHING, Inherited

__all__ = ["DrawnPart", "Matrix", "PlacedObject", "once_for_each_look"]

_Read = TypeVar("_Read")

Matrix = NDArray[np.float64]
"""A transform for points as rows; float64, shape (4, 4)."""


class DrawnPart(NamedTuple):
    """A prim that draws a piece of an object, or lights from it.

    Attributes
    ----------
    prim
        A `UsdGeom.Gprim` or a light. Instances of one prototype share it.
    path
        From the object's path to the prim; empty where the object is the prim.
    matrix
        From the prim's space to the object's.
    inherited
        What it inherits of how it looks, from outside of its prototype too.
    """

    prim: Usd.Prim
    path: str
    matrix: Matrix
    inherited: Inherited = NOTHING


@dataclass(eq=False, slots=True)
class PlacedObject:
    """An object of a stage.

    Attributes
    ----------
    path
        Of its prim; ``instancer[index]`` for a point of an instancer, with what follows for an object within one.
    twin
        Path of a prim on the stage that looks like it: `path` itself but for points of instancers.
    label
        Its semantic class; empty where the stage gives none.
    square
        What the labels say of the square that it stands on; empty where they say nothing.
    matrix
        From its space to the world.
    parts
        What is drawn. Objects that are instances of one prototype, and inherit the same, share the same tuple.
    """

    path: str
    twin: str
    label: str
    square: str
    matrix: Matrix
    parts: Sequence[DrawnPart] = field(default_factory=list)

    def twin_of(self, part: DrawnPart) -> Usd.Prim:
        """The prim on the stage that looks like a part: it inherits what the part does, as a prototype's cannot."""
        return part.prim.GetStage().GetPrimAtPath(self.twin + part.path)


def once_for_each_look(read: Callable[[PlacedObject], _Read]) -> Callable[[PlacedObject], _Read]:
    """The same function, called for the first of all objects that share their parts; the others get its result."""
    known: dict[int, tuple[Sequence[DrawnPart], _Read]] = {}  # the parts are held, so that none takes another's id

    def remembered(placed: PlacedObject) -> _Read:
        if id(placed.parts) not in known:
            known[id(placed.parts)] = placed.parts, read(placed)
        return known[id(placed.parts)][1]

    return remembered
