"""Bicycles."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import faces_of, lathe_faces, limb_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("bicycle", number=40, label="bicycle", cityscapes="bicycle", group="Clutter")

BICYCLE_COLOURS = ("black", "red", "blue", "green", "silver", "white")
_WHEEL_M, _BASE_M = 0.345, 1.06
_FRONT = (0.0, _WHEEL_M, _BASE_M / 2)
_REAR = (0.0, _WHEEL_M, -_BASE_M / 2)
_SPOKES = 12
_PARTS = shipped_toml("garage2usd.objects", "bicycle")


@dataclass(frozen=True)
class BicycleSpec(Spec, kind=KIND):
    """A city bicycle on its stand; origin on the floor in its middle, facing +Z.

    Attributes
    ----------
    colour
        Colour of the frame, one of `BICYCLE_COLOURS`.
    """

    colour: str = "black"

    @property
    def mass_kg(self) -> float:
        """Mass of the bicycle with its carrier in kilograms; assumption."""
        return 16.0

    def asset(self) -> Asset:
        """Make the meshes of a bicycle: wheels, frame, handlebars, saddle, pedals, mudguards, carrier and lamp."""
        tyres, rims = [], []
        for hub in (_FRONT, _REAR):
            tyre, rim = wheel_faces(_WHEEL_M, 0.02, 0.30)
            tyres += moved(tyre, hub)
            rims += moved([*rim, *_spokes()], hub)
        frame, bars, black = (faces_of(_PARTS[name]) for name in ("Frame", "Steel", "Saddle"))
        frame += _guard(_REAR, 20.0, 200.0) + _guard(_FRONT, 60.0, 190.0)
        return Asset(
            (
                make_part("Frame", frame, f"car_paint_{self.colour}", collider=Collider.CONVEX_HULL, crease_deg=60.0),
                make_part("Tyres", tyres, "tyre", collider=Collider.CONVEX_HULL),
                make_part("Wheels", rims, "rim"),
                make_part("Steel", bars, "chrome", collider=Collider.CONVEX_HULL, crease_deg=60.0),
                make_part("Saddle", black, "trim_black", crease_deg=60.0),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the bicycle's handlebars and wheels on the floor."""
        return (rectangle(-0.315, -_BASE_M / 2 - _WHEEL_M - 0.03, 0.315, _BASE_M / 2 + _WHEEL_M + 0.03),)


def wheel_faces(radius_m: float, half_width_m: float, rim_m: float) -> tuple[list[Face], list[Face]]:
    """Return the faces of a bicycle wheel's tyre and rim, two open rings around the X axis."""

    def ring(inner: float, outer: float, half: float) -> list[Face]:
        middle = (inner + outer) / 2
        profile = [
            (-half * 0.6, inner),
            (-half, middle),
            (-half * 0.6, outer),
            (half * 0.6, outer),
            (half, middle),
            (half * 0.6, inner),
        ]
        return lathe_faces([*profile, profile[0]], segments=28)

    return ring(rim_m, radius_m, half_width_m), ring(rim_m - 0.022, rim_m + 0.004, half_width_m * 0.8)


def _spokes() -> list[Face]:
    faces = lathe_faces([(-0.04, 0.0), (-0.04, 0.018), (0.04, 0.018), (0.04, 0.0)], segments=10)
    for index in range(_SPOKES):
        angle = index * 2 * np.pi / _SPOKES
        y, z = float(np.cos(angle)), float(np.sin(angle))
        faces += limb_faces([(0.0, 0.01 * y, 0.01 * z), (0.0, 0.29 * y, 0.29 * z)], [0.0018, 0.0018], segments=4)
    return faces


def _guard(hub: tuple[float, float, float], start_deg: float, end_deg: float) -> list[Face]:
    """Return the faces of a bicycle's mudguard between two angles around its wheel."""
    angles = np.radians(np.linspace(start_deg, end_deg, 9))
    points = [(0.0, hub[1] + 0.37 * np.sin(at), hub[2] + 0.37 * np.cos(at)) for at in angles]
    return limb_faces(points, [0.028] * 9, [0.004] * 9, segments=8)
