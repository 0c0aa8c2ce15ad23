"""Wheeled waste bins."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, faces_of, lathe_faces, moved, tube_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("waste_bin", number=37, label="waste_bin", cityscapes="dynamic", group="Clutter")

BIN_COLOURS = ("grey", "green", "blue", "yellow")
_WHEEL_M = 0.1
_PARTS = shipped_toml("garage2usd.objects", "waste_bin")


@dataclass(frozen=True)
class BinSpec(Spec, kind=KIND):
    """A two-wheeled waste bin of 240 litres after EN 840-1; origin on the floor in its middle, front to +Z.

    Attributes
    ----------
    colour
        Colour of the lid, one of `BIN_COLOURS`.
    """

    colour: str = "grey"

    @property
    def mass_kg(self) -> float:
        """Mass of the half-full waste bin; assumption, as EN 840-1 leaves the empty mass to the maker."""
        return 25.0

    def asset(self) -> Asset:
        """Make the meshes of a waste bin: a tapered body with a lid, a handle at its back, and two wheels."""
        handle = tube_faces([(-0.2, 1.0, -0.36), (0.2, 1.0, -0.36)], 0.015, segments=8)
        for x in (-0.2, 0.2):
            handle += box_faces((x - 0.02, 0.975, -0.37), (x + 0.02, 1.015, -0.32))
        wheels = [
            face
            for x in (-0.265, 0.215)
            for face in moved(
                lathe_faces(
                    [(0, 0), (0, 0.07), (0.008, _WHEEL_M), (0.042, _WHEEL_M), (0.05, 0.07), (0.05, 0)], segments=16
                ),
                (x, _WHEEL_M, -0.23),
            )
        ]
        return Asset(
            (
                make_part("Body", faces_of(_PARTS["Body"]), "bin_grey", collider=Collider.CONVEX_HULL),
                make_part("Lid", faces_of(_PARTS["Lid"]), f"bin_{self.colour}", collider=Collider.CONVEX_HULL),
                make_part("Handle", handle, "bin_grey"),
                make_part("Wheels", wheels, "rubber_black", collider=Collider.CONVEX_HULL),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the waste bin's lid and handle."""
        return (rectangle(-0.3, -0.38, 0.3, 0.345),)
