"""Charging posts for electric cars."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Spec, TilePart
from garage2usd.objects.outline import Polygon, rectangle

__all__ = ["KIND", "ChargerSpec"]

KIND = Kind("charger", number=22, label="charger", cityscapes="static", part=TilePart.PARKING)


@dataclass(frozen=True)
class ChargerSpec(Spec, kind=KIND):
    """A slim charging post facing +Z; origin in the middle of its foot."""

    def asset(self) -> Asset:
        """Make the meshes of a charging post: body, lit screen, socket and cable."""
        front = 0.045
        body = box_faces((-0.16, 0.0, -0.045), (0.16, 1.45, front))
        band = box_faces((-0.16, 1.25, front), (0.16, 1.38, front + 0.003), without="n")
        screen = box_faces((-0.09, 1.02, front), (0.09, 1.18, front + 0.003), without="n")
        socket = box_faces((-0.06, 0.82, front), (0.06, 0.94, front + 0.02), without="n")
        cable: list[Face] = []
        for left, low, right, high in (
            (-0.11, 0.35, -0.09, 0.88),
            (0.09, 0.35, 0.11, 0.88),
            (-0.085, 0.35, 0.085, 0.37),
        ):
            cable += box_faces((left, low, front), (right, high, front + 0.018))
        return Asset(
            (
                make_part("Body", body, "housing_white", collider=Collider.BOX),
                make_part("Band", band, "sign_green"),
                make_part("Screen", screen, "screen_glow"),
                make_part("Socket", socket, "rubber_black"),
                make_part("Cable", cable, "rubber_black"),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the charging post with its cable."""
        return (rectangle(-0.16, -0.045, 0.16, 0.065),)
