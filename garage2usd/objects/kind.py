"""The base classes of the modules of objects: a kind of object, and the shapes of its objects."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, Self

from garage2usd.assets.mesh import Asset
from garage2usd.objects.outline import Polygon

__all__ = ["Kind", "Look", "Spec", "TilePart", "VariantSet"]

Look = tuple[tuple[str, str], ...]
"""(variant set, variant) pairs selected by an instance."""


class VariantSet(StrEnum):
    """The variant sets of a garage, in their order."""

    OCCUPANCY = "occupancy"
    LIGHTS = "lights"
    CEILING = "ceiling"


class TilePart(StrEnum):
    """The parts of tiles that become shared prototypes, since parts repeat more often than whole tiles."""

    BUILDING = "Building"
    PARKING = "Parking"


@dataclass(frozen=True)
class Kind:
    """A kind of object.

    Attributes
    ----------
    name
        Name in reports and in the names of assets.
    number
        Id of the semantic class, from 1 and never reused; kinds are listed by number.
    label
        Semantic class.
    cityscapes
        Name of the nearest Cityscapes class.
    is_solid
        True if objects of the kind can be touched; False for floor markings, cladding and the sky.
    follows
        Variant set of the garage that switches the kind.
    group
        Group of the building that holds the objects outside squares.
    part
        Part of a tile that holds the objects on a square.
    scattered
        Point instancer that draws the kind where tiles share prototypes, since its objects make all tiles differ.
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
    """The shape of an object by its measures, for placements. Equal specs share one prototype.

    Attributes
    ----------
    kind
        Kind of the objects of this shape.
    """

    kind: ClassVar[Kind]

    def __init_subclass__(cls, *, kind: Kind | None = None) -> None:
        """Set the kind of object from the class statement: ``class MirrorSpec(Spec, kind=KIND)``."""
        if kind is not None:
            cls.kind = kind

    @property
    def shape(self) -> Self:
        """The spec that owns the asset: the spec itself, unless it is a variant of another spec's asset."""
        return self

    @property
    def look(self) -> Look:
        """Variants of the asset that this object selects."""
        return ()

    @property
    def mass_kg(self) -> float | None:
        """Mass of a movable object in kilograms; None for a part of the building."""
        return None

    @abstractmethod
    def asset(self) -> Asset:
        """Make the meshes and colliders of the object."""

    def outlines(self) -> tuple[Polygon, ...]:
        """Return convex outlines on the floor around all that a car could touch; none if a car touches nothing."""
        return ()
