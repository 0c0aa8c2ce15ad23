"""Bags left on the floor as clutter."""

from dataclasses import dataclass
from enum import StrEnum

from garage2usd.assets.faces import faces_of
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("bag", number=44, label="bag", cityscapes="dynamic", group="Clutter")


class BagSort(StrEnum):
    """The sorts of bags."""

    CARRIER = "carrier"
    SUITCASE = "suitcase"
    RUBBISH = "rubbish"


_SORTS = shipped_toml("garage2usd.objects", "bag")


@dataclass(frozen=True)
class BagSpec(Spec, kind=KIND):
    """A bag; origin on the floor in its middle.

    Attributes
    ----------
    sort
        A paper carrier bag, a suitcase on wheels, or a tied rubbish sack.
    """

    sort: BagSort = BagSort.CARRIER

    @property
    def mass_kg(self) -> float:
        """Mass of the filled bag in kilograms; assumption."""
        return float(_SORTS[self.sort]["mass_kg"])

    def asset(self) -> Asset:
        """Make the meshes of a bag: its body and its handles or knot."""
        given, (material, rest_material) = _SORTS[self.sort], _SORTS[self.sort]["materials"]
        return Asset(
            (
                make_part("Body", faces_of(given["Body"]), material, collider=Collider.CONVEX_HULL, crease_deg=40.0),
                make_part("Handles", faces_of(given["Handles"]), rest_material, crease_deg=50.0),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the bag on the floor."""
        x, z = _SORTS[self.sort]["half_m"]
        return (rectangle(-x - 0.005, -z - 0.005, x + 0.005, z + 0.005),)
