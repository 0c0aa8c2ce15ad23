"""The base classes of the modules of objects: kinds, their shapes, outlines and pieces, and rules of mounted ones."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, Self

from garage2usd.assets.mesh import Asset, Part, pascal_case

Point = tuple[float, float]
Polygon = tuple[Point, ...]
"""Corners (x, z) in metres, without holes."""
Box = tuple[float, float, float, float]
"""An axis-aligned rectangle: left, top, right, bottom, in x and z."""
Look = tuple[tuple[str, str], ...]
"""(variant set, variant) pairs selected by an instance."""


def rectangle(left: float, top: float, right: float, bottom: float) -> Polygon:
    """Return the corners of an axis-aligned rectangle outline, x from left to right and z from top to bottom."""
    return (left, top), (left, bottom), (right, bottom), (right, top)


def square(side_m: float) -> Polygon:
    """Return the corners of an axis-aligned square outline around the origin."""
    return rectangle(-side_m / 2, -side_m / 2, side_m / 2, side_m / 2)


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


@dataclass(frozen=True)
class Mounted:
    """The rules of a kind that hangs on walls and columns; a module declares them as ``MOUNTED``.

    Attributes
    ----------
    spec
        Shape of the object; origin on the floor, in the middle of its back on the wall, facing +Z.
    setting
        Name of its switch in the fittings.
    clause
        Name of the profile's clause on its reach.
    reach_m
        Reach in metres if the profile has no such clause.
    count
        Number of objects within reach of each place.
    spacing
        Name of the profile's clause on the largest distance to the next object of the kind; None without a limit.
    is_walked
        True if the reach is a walking distance between rows of cars, along X and then Z; else a straight distance.
    """

    spec: Spec
    setting: str
    clause: str
    reach_m: float
    count: int = 1
    spacing: str | None = None
    is_walked: bool = True

    @property
    def kind(self) -> Kind:
        """Kind of the mounted object."""
        return self.spec.kind

    @property
    def norm(self) -> int:
        """Minkowski norm of the reach: 1 for a walking distance along both axes, 2 for a straight one."""
        return 1 if self.is_walked else 2


@dataclass(frozen=True)
class PieceClass:
    """A semantic class of pieces of objects.

    Attributes
    ----------
    label
        Name of the class, as in `garage2usd.assets.Part.piece`.
    number
        Id of the class, never reused.
    cityscapes
        Name of the nearest Cityscapes class.
    what
        Description in words.
    """

    label: str
    number: int
    cityscapes: str
    what: str


PAINT_CLASSES = (
    PieceClass("stall_line", 29, "parking", "lines between stalls, beside and behind them"),
    PieceClass("lane_line", 30, "road", "lines along the edges and the middle of lanes, and around columns"),
    PieceClass("lane_arrow", 31, "road", "arrows on lanes and portals"),
    PieceClass("crossing", 32, "road", "bars of crossings"),
    PieceClass("hatching", 33, "road", "frames and stripes where nobody parks or stands"),
    PieceClass("stall_symbol", 34, "parking", "symbols of what a stall is for"),
)
"""Classes of paint on floors; painted numbers are objects, of the class ``stall_number``."""

PIECES = PAINT_CLASSES
"""All classes of pieces, by number."""


def pieces_of(asset: Asset) -> dict[str, list[Part]]:
    """Return the parts of each labelled piece of an asset, by label."""
    found: dict[str, list[Part]] = {}
    for part in asset.parts:
        if part.piece:
            found.setdefault(part.piece, []).append(part)
    return found


def piece_name(label: str) -> str:
    """Return the name of a piece's prim, below the prim of its object."""
    return pascal_case(label)
