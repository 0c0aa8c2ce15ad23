"""Bicycles."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import box_faces, lathe_faces, limb_faces, loft_faces, moved, rectangle_ring, tube_faces
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("bicycle", number=40, label="bicycle", cityscapes="bicycle", group="Clutter")

BICYCLE_COLOURS = ("black", "red", "blue", "green", "silver", "white")
_WHEEL_M, _BASE_M = 0.345, 1.06
_FRONT = (0.0, _WHEEL_M, _BASE_M / 2)
_REAR = (0.0, _WHEEL_M, -_BASE_M / 2)
_CRANK = (0.0, 0.29, -0.10)
_SEAT = (0.0, 0.80, -0.27)
_HEAD = (0.0, 0.88, 0.30)
_SPOKES = 12


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
        low_head = (0.0, 0.76, 0.335)
        frame = _tubes(
            (_HEAD, low_head, 0.022),
            (_CRANK, (0.0, 0.86, -0.288), 0.016),
            (_CRANK, low_head, 0.019),
            ((0.0, 0.72, -0.245), (0.0, 0.83, 0.31), 0.015),
        )
        for side in (-0.055, 0.055):
            frame += _tubes(
                ((side, *_REAR[1:]), (side * 0.6, 0.72, -0.245), 0.009),
                ((side, *_REAR[1:]), (side * 0.6, *_CRANK[1:]), 0.010),
                ((side, *_FRONT[1:]), (side * 0.8, 0.72, 0.352), 0.012),
            )
        frame += _guard(_REAR, 20.0, 200.0) + _guard(_FRONT, 60.0, 190.0)
        bars = tube_faces([(0.0, 0.85, 0.31), (0.0, 1.03, 0.265)], 0.014, segments=8)
        bars += limb_faces(
            [
                (-0.29, 1.0, 0.10),
                (-0.26, 1.02, 0.19),
                (-0.1, 1.04, 0.27),
                (0.1, 1.04, 0.27),
                (0.26, 1.02, 0.19),
                (0.29, 1.0, 0.10),
            ],
            [0.012] * 6,
            side=(0.0, 1.0, 0.0),
            segments=8,
        )
        bars += tube_faces([(0.0, 0.84, -0.283), (0.0, 0.95, -0.315)], 0.012, segments=8)
        bars += _tubes(((-0.09, *_CRANK[1:]), (0.09, *_CRANK[1:]), 0.016))
        bars += _tubes(
            ((0.085, *_CRANK[1:]), (0.085, 0.19, 0.03), 0.01), ((-0.085, *_CRANK[1:]), (-0.085, 0.39, -0.23), 0.01)
        )
        bars += _carrier()
        # the stand
        bars += _tubes(((-0.06, 0.30, -0.36), (-0.17, 0.0085, -0.30), 0.009))
        saddle = loft_faces(
            [
                rectangle_ring(0.05, 0.10, y=0.945, z=-0.32),
                rectangle_ring(0.085, 0.13, y=0.97, z=-0.33),
                rectangle_ring(0.07, 0.12, y=1.0, z=-0.33),
            ]
        )
        black = saddle + [
            face
            for side in (-0.29, 0.29)
            for face in tube_faces([(side, 1.0, 0.105), (side * 1.01, 0.99, 0.0)], 0.017, segments=8)
        ]
        for x, y, z in ((0.13, 0.185, 0.035), (-0.13, 0.395, -0.235)):
            black += box_faces((x - 0.045, y - 0.012, z - 0.04), (x + 0.045, y + 0.012, z + 0.04))
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


def _tubes(*tubes: tuple[Sequence[float], Sequence[float], float]) -> list[Face]:
    return [
        face
        for start, end, radius in tubes
        for face in limb_faces([start, end], [radius, radius], side=(0.31, 0.17, 0.93), segments=8)
    ]


def _guard(hub: tuple[float, float, float], start_deg: float, end_deg: float) -> list[Face]:
    """Return the faces of a bicycle's mudguard between two angles around its wheel."""
    angles = np.radians(np.linspace(start_deg, end_deg, 9))
    points = [(0.0, hub[1] + 0.37 * np.sin(at), hub[2] + 0.37 * np.cos(at)) for at in angles]
    return limb_faces(points, [0.028] * 9, [0.004] * 9, segments=8)


def _carrier() -> list[Face]:
    faces: list[Face] = []
    for x in (-0.06, 0.06):
        faces += _tubes(((x, 0.745, -0.28), (x, 0.745, -0.72), 0.006), ((x * 1.1, *_REAR[1:]), (x, 0.74, -0.62), 0.005))
    for z in (-0.45, -0.58, -0.70):
        faces += _tubes(((-0.065, 0.747, z), (0.065, 0.747, z), 0.005))
    return faces
