"""Cardboard boxes left as clutter."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("cardboard_box", number=38, label="cardboard_box", cityscapes="dynamic", group="Clutter")

BOX_SIZES_M = ((0.4, 0.3, 0.3), (0.6, 0.33, 0.4), (0.5, 0.6, 0.45), (0.75, 0.42, 0.55))
"""Width, height and depth of common removal and parcel boxes."""
_TAPE_M = 0.025


@dataclass(frozen=True)
class BoxSpec(Spec, kind=KIND):
    """A closed cardboard box; origin on the floor in its middle.

    Attributes
    ----------
    width_m, height_m, depth_m
        Size of the box along X, Y and Z.
    """

    width_m: float
    height_m: float
    depth_m: float

    @property
    def mass_kg(self) -> float:
        """Mass of the cardboard box at 80 kg/m3; assumption."""
        return round(80.0 * self.width_m * self.height_m * self.depth_m, 1)

    def asset(self) -> Asset:
        """Make the meshes of a cardboard box: its body and a strip of tape along the lid's seam and down both ends."""
        x, y, z = self.width_m / 2, self.height_m, self.depth_m / 2
        tape = box_faces((-x - 0.001, y - 0.08, -_TAPE_M), (x + 0.001, y + 0.001, _TAPE_M), without="b")
        body = box_faces((-x, 0.0, -z), (x, y, z))
        return Asset(
            (
                make_part("Body", body, "cardboard", collider=Collider.BOX),
                make_part("Tape", tape, "cardboard_tape"),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the cardboard box on the floor."""
        return (rectangle(-self.width_m / 2, -self.depth_m / 2, self.width_m / 2, self.depth_m / 2),)
