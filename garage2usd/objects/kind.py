"""What each module of this package declares: a kind of object, and the shapes that objects of it have."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, Self

from garage2usd.assets.mesh import Asset
from garage2usd.objects.outline import Polygon

__all__ = ["Kind", "Look", "Spec", "TilePart", "VariantSet"]

Look = tuple[tuple[str, str], ...]
"""(variant set, variant) pairs that an instance selects."""


class VariantSet(StrEnum):
    """The variant sets of a garage, in their order."""

    OCCUPANCY = "occupancy"
    LIGHTS = "lights"
    CEILING = "ceiling"


class TilePart(StrEnum):
    """The parts that tiles consist of where they share prototypes: each repeats more often than whole tiles."""

    BUILDING = "Building"
    PARKING = "Parking"


@dataclass(frozen=True)
class Kind:
    """A kind of object.

    Attributes
    ----------
    name
        As reports count it; assets are named after it.
    number
        Id of its semantic class, from 1, which is never given to another kind; kinds are listed in this order.
    label
        Its semantic class.
    cityscapes
        Name of the nearest Cityscapes class.
    is_solid
        Whether something can touch it; False for what lies on the floor, clads another object or is the sky.
    follows
        The variant set of the garage that switches it.
    group
        Group of the building that holds those that stand on no square.
    part
        The part of a tile that holds those that stand on one.
    scattered
        Where tiles share prototypes, the point instancer that draws it, because it makes all tiles different.
    """

    name: str
    number: int
    label: str
    cityscapes: str
    is_solid: bool = True
    follows: VariantSet | None = None
    group: str = ""
    part: TilePart = TilePart.BUILDING
    scattered: str = ""


class Spec(ABC):
    """A shape by its measures: what a placement places. Equal specs are one prototype.

    Attributes
    ----------
    kind
        What every object of this shape is.
    """

    kind: ClassVar[Kind]

    def __init_subclass__(cls, *, kind: Kind | None = None) -> None:
        """Take the kind from the class statement: ``class MirrorSpec(Spec, kind=KIND)``."""
        if kind is not None:
            cls.kind = kind

    @property
    def shape(self) -> Self:
        """The spec whose asset this one uses: itself, unless variants of one asset make the difference."""
        return self

    @property
    def look(self) -> Look:
        """The variants of that asset."""
        return ()

    @property
    def mass_kg(self) -> float | None:
        """Mass of a thing that can be moved; None for what belongs to the building."""
        return None

    @abstractmethod
    def asset(self) -> Asset:
        """Make its meshes, with their colliders."""

    def outlines(self) -> tuple[Polygon, ...]:
        """Convex outlines on the floor that hold all of it that a car could touch; none where a car touches nothing."""
        return ()
