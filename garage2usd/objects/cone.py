"""Traffic cones."""

from dataclasses import dataclass
from itertools import pairwise

from garage2usd.assets.faces import box_faces, upright_lathe_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, square

KIND = Kind("cone", number=15, label="traffic_cone", cityscapes="static", part=TilePart.PARKING)

_FOOT_M = 0.38
_BANDS_M = (0.03, 0.28, 0.4, 0.5, 0.6, 0.75)
"""Heights in metres where a traffic cone changes colour, orange first."""


@dataclass(frozen=True)
class ConeSpec(Spec, kind=KIND):
    """A traffic cone; origin in the middle of its foot."""

    @property
    def mass_kg(self) -> float:
        """Mass of a traffic cone of 0.75 m with a rubber foot; assumption."""
        return 3.2

    def asset(self) -> Asset:
        """Make the meshes of a traffic cone: orange, 0.75 m high, two reflective bands, a rubber foot."""
        side = _FOOT_M / 2
        foot = box_faces((-side, 0.0, -side), (side, 0.03, side))
        orange: list[Face] = []
        white: list[Face] = []
        for index, (low, high) in enumerate(pairwise(_BANDS_M)):
            piece = upright_lathe_faces([(low, _radius_m(low)), (high, _radius_m(high))], segments=20)
            (white if index % 2 else orange).extend(piece)
        return Asset(
            (
                make_part("Foot", foot, "rubber_black", collider=Collider.CONVEX_HULL),
                make_part("Body", orange, "sign_orange", collider=Collider.CONVEX_HULL),
                make_part("Bands", white, "sign_white"),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the traffic cone's foot."""
        return (square(_FOOT_M),)


def _radius_m(height_m: float) -> float:
    return 0.14 - 0.11 * (height_m - _BANDS_M[0]) / (_BANDS_M[-1] - _BANDS_M[0])
