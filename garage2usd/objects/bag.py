"""Bags left on the floor as clutter."""

from dataclasses import dataclass
from enum import StrEnum

from garage2usd.assets.faces import box_faces, limb_faces, loft_faces, rectangle_ring
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("bag", number=44, label="bag", cityscapes="dynamic", group="Clutter")


class BagSort(StrEnum):
    """The sorts of bags."""

    CARRIER = "carrier"
    SUITCASE = "suitcase"
    RUBBISH = "rubbish"


_MASS_KG = {BagSort.CARRIER: 4.0, BagSort.SUITCASE: 15.0, BagSort.RUBBISH: 6.0}
_HALF_M = {BagSort.CARRIER: (0.18, 0.10), BagSort.SUITCASE: (0.215, 0.125), BagSort.RUBBISH: (0.27, 0.25)}


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
        return _MASS_KG[self.sort]

    def asset(self) -> Asset:
        """Make the meshes of a bag: its body and its handles or knot."""
        made = {BagSort.CARRIER: _carrier, BagSort.SUITCASE: _suitcase, BagSort.RUBBISH: _rubbish}[self.sort]
        body, material, rest, rest_material = made()
        return Asset(
            (
                make_part("Body", body, material, collider=Collider.CONVEX_HULL, crease_deg=40.0),
                make_part("Handles", rest, rest_material, crease_deg=50.0),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the bag on the floor."""
        x, z = _HALF_M[self.sort]
        return (rectangle(-x - 0.005, -z - 0.005, x + 0.005, z + 0.005),)


_Made = tuple[list[Face], str, list[Face], str]


def _carrier() -> _Made:
    body = loft_faces(
        [rectangle_ring(0.17, 0.085, y=0.0), rectangle_ring(0.18, 0.095, y=0.10), rectangle_ring(0.175, 0.06, y=0.42)]
    )
    handles: list[Face] = []
    for z in (-0.05, 0.05):
        handles += limb_faces(
            [(-0.08, 0.41, z), (-0.07, 0.52, z), (0.07, 0.52, z), (0.08, 0.41, z)],
            [0.006] * 4,
            side=(0.0, 0.0, 1.0),
            segments=6,
        )
    return body, "cardboard", handles, "cloth_brown"


def _suitcase() -> _Made:
    body = loft_faces(
        [
            rectangle_ring(0.20, 0.11, y=0.05),
            rectangle_ring(0.215, 0.125, y=0.09),
            rectangle_ring(0.215, 0.125, y=0.60),
            rectangle_ring(0.20, 0.11, y=0.65),
        ]
    )
    rest: list[Face] = []
    for x in (-0.16, 0.16):
        for z in (-0.08, 0.08):
            rest += box_faces((x - 0.018, 0.0, z - 0.025), (x + 0.018, 0.048, z + 0.025))
    rest += limb_faces(
        [(-0.10, 0.64, -0.08), (-0.10, 0.98, -0.08), (0.10, 0.98, -0.08), (0.10, 0.64, -0.08)],
        [0.01] * 4,
        side=(0.0, 0.0, 1.0),
        segments=6,
    )
    return body, "bin_blue", rest, "steel_dark"


def _rubbish() -> _Made:
    body = loft_faces(
        [
            rectangle_ring(0.20, 0.18, y=0.0),
            rectangle_ring(0.27, 0.25, y=0.10),
            rectangle_ring(0.265, 0.24, y=0.28, z=0.01),
            rectangle_ring(0.19, 0.17, y=0.44),
            rectangle_ring(0.06, 0.055, y=0.53),
            rectangle_ring(0.035, 0.03, y=0.56),
        ]
    )
    knot = loft_faces(
        [rectangle_ring(0.03, 0.03, y=0.562), rectangle_ring(0.08, 0.06, y=0.62), rectangle_ring(0.06, 0.03, y=0.66)]
    )
    return body, "trim_black", knot, "rubber_black"
