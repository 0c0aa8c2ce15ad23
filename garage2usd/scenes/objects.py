"""The objects of a composed stage: semantic class, transform, and the prims that draw them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.scenes.inheritance import NOTHING, Inherited

__all__ = ["DrawnPart", "Matrix", "PlacedObject", "once_for_each_look"]

_Read = TypeVar("_Read")

Matrix = NDArray[np.float64]
"""A transform for points as row vectors; float64, shape (4, 4)."""


class DrawnPart(NamedTuple):
    """A prim that draws a part of an object, or a light of it.

    Attributes
    ----------
    prim
        A `UsdGeom.Gprim` or a light. Instances of one prototype share it.
    path
        From the object's path to the prim; empty if the object is the prim.
    matrix
        From the prim's space to the object's.
    inherited
        Inherited materials and primvars, including those from outside its prototype.
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
        Path of its prim; ``instancer[index]`` for a point of an instancer, with a suffix for an object within one.
    twin
        Path of a prim on the stage that looks like the object: equal to `path` except for points of instancers.
    label
        Semantic class; empty if the stage has none.
    square
        Label of the object's square; empty without one.
    matrix
        From its space to the world.
    parts
        Drawn parts. Instances of one prototype that inherit the same values share one tuple.
    is_twin_whole
        True if `twin` starts at the stage's root although the walk began in a prototype.
    """

    path: str
    twin: str
    label: str
    square: str
    matrix: Matrix
    parts: Sequence[DrawnPart] = field(default_factory=list)
    is_twin_whole: bool = False

    def twin_of(self, part: DrawnPart) -> Usd.Prim:
        """Return the prim on the stage that looks like a part, with the part's inherited values."""
        return part.prim.GetStage().GetPrimAtPath(self.twin + part.path)


def once_for_each_look(read: Callable[[PlacedObject], _Read]) -> Callable[[PlacedObject], _Read]:
    """Cache a function of an object by the object's parts: all objects that share their parts get one result."""
    known: dict[int, tuple[Sequence[DrawnPart], _Read]] = {}  # the parts are held, so that none takes another's id

    def remembered(placed: PlacedObject) -> _Read:
        if id(placed.parts) not in known:
            known[id(placed.parts)] = placed.parts, read(placed)
        return known[id(placed.parts)][1]

    return remembered
