"""Walls with a vehicle door: the portals of a garage."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces, frame_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.config.site import DOOR_FRAME_M
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle
from garage2usd.objects.lit_sign import lit_sign
from garage2usd.objects.signage import Way

KIND = Kind("portal", number=5, label="vehicle_door", cityscapes="wall", group="Walls")

_FRAME_PROUD_M = 0.02
_LAMELLA_M = 0.12
_GROOVE_M = 0.012
_OVER_FRAME_M, _UNDER_CEILING_M = 0.08, 0.04
"""Margins of the lit signs over the door: above the frame and below the ceiling."""


@dataclass(frozen=True)
class PortalSpec(Spec, kind=KIND):
    """A wall with a vehicle door; origin and direction as `WallSpec`."""

    length_m: float
    height_m: float
    thickness_m: float
    door_width_m: float
    door_height_m: float
    is_entrance: bool | None
    """True if cars come in through the door, False if they leave, and None if they do both."""
    is_open: bool = False
    """True if the roller door is up because a ramp lies behind it."""
    country: Country = Country.NONE
    """Country of the words on the door's signs."""
    raised_arm_m: float | None = None
    """Height of the underside of the raised barrier arm before the door, which the sign inside must not exceed."""

    @property
    def sign_heights_m(self) -> tuple[float, float]:
        """Lower and upper limit of the sign inside, between the door's frame and the ceiling or the raised arm."""
        top_m = self.height_m - _UNDER_CEILING_M
        return self.door_height_m + _OVER_FRAME_M, top_m if self.raised_arm_m is None else min(top_m, self.raised_arm_m)

    def asset(self) -> Asset:
        """Make the meshes of a portal: wall, roller door, closed or up, steel frame, and lit signs on both faces."""
        half, jamb, back = self.length_m / 2, self.door_width_m / 2, -self.thickness_m
        concrete = box_faces((-half, 0, back), (-jamb, self.height_m, 0))
        concrete += box_faces((jamb, 0, back), (half, self.height_m, 0))
        lintel = box_faces((-jamb, self.door_height_m, back), (jamb, self.height_m, 0), without="lr")
        opening, head = jamb - DOOR_FRAME_M, self.door_height_m - DOOR_FRAME_M
        frame = frame_faces(opening, head, DOOR_FRAME_M, back, _FRAME_PROUD_M)
        door = (
            []
            if self.is_open
            else [
                make_part("Door", _lamellae(opening, head, -self.thickness_m / 2), "door_steel", collider=Collider.BOX)
            ]
        )
        inside = Way.NOT_OUT if self.is_entrance else Way.OUT
        outside = Way.NOT_IN if self.is_entrance is False else Way.IN
        outer_heights = replace(self, raised_arm_m=None).sign_heights_m
        return Asset(
            (
                make_part("LeftJamb", concrete[:6], "wall_concrete", collider=Collider.BOX),
                make_part("RightJamb", concrete[6:], "wall_concrete", collider=Collider.BOX),
                make_part("Lintel", lintel, "wall_concrete", collider=Collider.BOX),
                make_part("Frame", frame, "hazard", collider=Collider.MESH),
                *door,
                *lit_sign("Sign", inside, (-jamb, jamb), self.sign_heights_m, 0.0, country=self.country),
                *lit_sign(
                    "OuterSign", outside, (-jamb, jamb), outer_heights, back, country=self.country, looks_back=True
                ),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the wall on both sides of the vehicle door, with its projecting frame."""
        half, opening = self.length_m / 2, self.door_width_m / 2 - DOOR_FRAME_M if self.is_open else 0.0
        return (
            rectangle(-half, -self.thickness_m, -opening, _FRAME_PROUD_M),
            rectangle(opening, -self.thickness_m, half, _FRAME_PROUD_M),
        )


def _lamellae(half_m: float, height_m: float, front_m: float) -> list[Face]:
    """Return the front of a roller door: flat slats with grooves between them, one sheet from the floor to the head."""
    count = max(1, int(height_m / _LAMELLA_M))
    step = height_m / count
    profile = [(0.0, front_m - _GROOVE_M)]
    for index in range(count):
        low = index * step
        profile += [(low + _GROOVE_M, front_m - _GROOVE_M), (low + _GROOVE_M, front_m)]
        profile += [(low + step, front_m), (low + step, front_m - _GROOVE_M)]
    return [
        np.array([(-half_m, y0, z0), (half_m, y0, z0), (half_m, y1, z1), (-half_m, y1, z1)])
        for (y0, z0), (y1, z1) in pairwise(profile)
    ]
