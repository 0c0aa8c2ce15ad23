"""Ceiling lamps: battens with bare tubes, square panels, round lamps."""

import math
from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, lathe_faces, moved, upright_lathe_faces
from garage2usd.assets.light import USUAL_TEMPERATURE_K, lamp_colour
from garage2usd.assets.mesh import AreaLight, Asset, Collider, Face, Part, make_part
from garage2usd.config.look import LampKind
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("light", number=8, label="light", cityscapes="static", group="Ramps", follows=VariantSet.LIGHTS)

_BATTEN_HEIGHT_M, _TUBE_RADIUS_M = 0.06, 0.016
_PANEL_HEIGHT_M, _PANEL_BORDER_M, _PANEL_LIP_M = 0.05, 0.012, 0.004
_RIM_HEIGHT_M, _RIM_M = 0.035, 0.012
_BOWL = ((0.095, 0.1), (0.092, 0.34), (0.080, 0.62), (0.060, 0.86), (_RIM_HEIGHT_M, 1.0))
"""(depth below the top, share of the radius) pairs along the cover of a round lamp."""


@dataclass(frozen=True)
class LampSpec(Spec, kind=KIND):
    """A ceiling lamp; origin in the middle of its top.

    Attributes
    ----------
    length_m, width_m
        Extent of the lit face along X and Z; both are the diameter of a round lamp.
    drop_m
        Distance from the lamp's top down to its lit face.
    luminance_nit
        Luminance in cd/m2 of the lit face, which faces down, while the lamp burns.
    form
        Form of the lamp; tubes lie along X.
    temperature_k
        Colour temperature in kelvins.
    is_dead
        True if the lamp gives no light.
    """

    length_m: float
    width_m: float
    drop_m: float = 0.115
    luminance_nit: float = 0.0
    form: LampKind = LampKind.TUBES
    temperature_k: float = USUAL_TEMPERATURE_K
    is_dead: bool = False

    @property
    def area_m2(self) -> float:
        """Area of the lamp's lit face in square metres."""
        return self.length_m * self.width_m * (math.pi / 4 if self.form is LampKind.ROUND else 1.0)

    def asset(self) -> Asset:
        """Make the meshes of a lamp: housing, glowing face, and an area light `drop_m` below the top."""
        light = AreaLight(
            self.length_m,
            self.width_m,
            -self.drop_m,
            0.0 if self.is_dead else self.luminance_nit,
            colour_rgb=lamp_colour(self.temperature_k),
            is_round=self.form is LampKind.ROUND,
        )
        glow = "lamp_dead" if self.is_dead else "tube_glow"
        return Asset(
            {LampKind.PANELS: self._panel, LampKind.ROUND: self._bowl}.get(self.form, self._tubes)(glow), light
        )

    def _tubes(self, glow: str) -> tuple[Part, ...]:
        """Make a batten lamp with two bare tubes."""
        x, z = self.length_m / 2, self.width_m / 2
        housing = box_faces((-x, -_BATTEN_HEIGHT_M, -z), (x, 0, z))
        ends: list[Face] = []
        for end in (-x, x - 0.03):
            ends += box_faces((end, -_BATTEN_HEIGHT_M - 0.045, -z), (end + 0.03, -_BATTEN_HEIGHT_M, z))
        tubes: list[Face] = []
        for side in (-z / 2, z / 2):
            ring = lathe_faces([(-x + 0.03, _TUBE_RADIUS_M), (x - 0.03, _TUBE_RADIUS_M)], segments=10)
            tubes += moved(ring, (0.0, -_BATTEN_HEIGHT_M - 0.024, side))
        return (
            make_part("Housing", housing, "housing_white", collider=Collider.BOX),
            make_part("Ends", ends, "housing_white"),
            make_part("Tubes", tubes, glow),
        )

    def _panel(self, glow: str) -> tuple[Part, ...]:
        """Make a panel lamp: a flat box with a glowing, framed underside."""
        x, z, border = self.length_m / 2, self.width_m / 2, _PANEL_BORDER_M
        box = box_faces((-x, -_PANEL_HEIGHT_M, -z), (x, 0, z))
        low, lit = -_PANEL_HEIGHT_M - _PANEL_LIP_M, -_PANEL_HEIGHT_M - _PANEL_LIP_M / 2
        frame: list[Face] = []
        for near in (-z, z - border):
            frame += box_faces((-x, low, near), (x, -_PANEL_HEIGHT_M, near + border))
        for left in (-x, x - border):
            frame += box_faces((left, low, -z + border), (left + border, -_PANEL_HEIGHT_M, z - border))
        cover = box_faces((-x + border, lit, -z + border), (x - border, -_PANEL_HEIGHT_M, z - border))
        return (
            make_part("Housing", box, "housing_white", collider=Collider.BOX),
            make_part("Frame", frame, "housing_white"),
            make_part("Cover", cover, glow),
        )

    def _bowl(self, glow: str) -> tuple[Part, ...]:
        """Make a round lamp: a flat drum over a shallow, glowing bowl."""
        radius = self.length_m / 2
        rim = upright_lathe_faces([(-_RIM_HEIGHT_M, radius), (0.0, radius)], segments=24)
        bowl = upright_lathe_faces([(-depth, share * (radius - _RIM_M)) for depth, share in _BOWL], segments=24)
        return (
            make_part("Housing", rim, "housing_white", collider=Collider.CONVEX_HULL),
            make_part("Cover", bowl, glow),
        )
