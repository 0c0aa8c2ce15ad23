"""Motorbikes: scooters and naked bikes."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, limb_faces, loft_faces, moved, rectangle_ring
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.bicycle import wheel_faces
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, rectangle

KIND = Kind("motorbike", number=41, label="motorbike", cityscapes="motorcycle", group="Clutter", part=TilePart.PARKING)

MOTORBIKE_COLOURS = ("black", "red", "blue", "white", "grey", "orange")
_SIDE = (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class MotorbikeSpec(Spec, kind=KIND):
    """A motorbike upright on its stand; origin on the floor in its middle, facing +Z.

    Attributes
    ----------
    colour
        Colour of the tank or shell, one of `MOTORBIKE_COLOURS`.
    is_scooter
        True if the motorbike is a scooter.
    """

    colour: str = "black"
    is_scooter: bool = False

    @property
    def mass_kg(self) -> float:
        """Mass of the motorbike with fuel in kilograms; assumption."""
        return 130.0 if self.is_scooter else 200.0

    def asset(self) -> Asset:
        """Make the meshes of a motorbike: wheels, fork, engine or shell, tank, seat, lamps, handlebars and mirrors."""
        parts = _scooter() if self.is_scooter else _naked()
        materials = {
            "Body": f"car_paint_{self.colour}",
            "Tyres": "tyre",
            "Rims": "rim",
            "Black": "trim_black",
            "Steel": "steel_dark",
            "Chrome": "chrome",
            "Lamp": "lamp_front",
            "RearLamp": "lamp_rear",
        }
        touched = {"Body", "Tyres", "Steel", "Black", "Chrome"}
        return Asset(
            tuple(
                make_part(
                    name,
                    faces,
                    materials[name],
                    collider=Collider.CONVEX_HULL if name in touched else None,
                    crease_deg=50.0,
                )
                for name, faces in parts.items()
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the motorbike's handlebars, mirrors and wheels."""
        return (rectangle(-0.39, -0.93, 0.39, 0.93) if self.is_scooter else rectangle(-0.42, -1.05, 0.42, 1.05),)


def _wheels(radius_m: float, half_m: float, rim_m: float, front_m: float, rear_m: float) -> dict[str, list[Face]]:
    tyres: list[Face] = []
    rims: list[Face] = []
    for z in (front_m, rear_m):
        tyre, rim = wheel_faces(radius_m, half_m, rim_m)
        disc = limb_faces([(-0.02, 0.0, 0.0), (0.02, 0.0, 0.0)], [rim_m - 0.02] * 2, side=(0.0, 1.0, 0.0), segments=20)
        tyres += moved(tyre, (0.0, radius_m, z))
        rims += moved([*rim, *disc], (0.0, radius_m, z))
    return {"Tyres": tyres, "Rims": rims}


def _handlebars(y: float, z: float, half_m: float) -> list[Face]:
    faces = limb_faces(
        [
            (-half_m, y, z - 0.14),
            (-half_m * 0.5, y + 0.01, z - 0.05),
            (0.0, y, z),
            (half_m * 0.5, y + 0.01, z - 0.05),
            (half_m, y, z - 0.14),
        ],
        [0.015] * 5,
        side=(0.0, 1.0, 0.0),
        segments=8,
    )
    for side in (-1.0, 1.0):
        x = side * half_m * 0.8
        faces += limb_faces([(x * 0.85, y, z - 0.09), (x, y + 0.16, z - 0.05)], [0.006] * 2, segments=6)
        faces += box_faces((x - 0.055, y + 0.14, z - 0.062), (x + 0.055, y + 0.21, z - 0.04))
    return faces


def _naked() -> dict[str, list[Face]]:
    parts = _wheels(0.315, 0.07, 0.22, 0.70, -0.70)
    body = limb_faces(
        [(0.0, 0.80, -0.12), (0.0, 0.84, 0.0), (0.0, 0.90, 0.16), (0.0, 0.90, 0.30), (0.0, 0.86, 0.38)],
        [0.10, 0.13, 0.165, 0.15, 0.08],
        [0.08, 0.11, 0.12, 0.10, 0.06],
        side=_SIDE,
    )
    body += limb_faces(
        [(0.0, 0.80, -0.40), (0.0, 0.86, -0.62), (0.0, 0.93, -0.92)], [0.11, 0.10, 0.05], [0.06, 0.05, 0.03], side=_SIDE
    )
    body += limb_faces(
        [(0.0, 0.66, 0.46), (0.0, 0.70, 0.66), (0.0, 0.64, 0.90)], [0.07, 0.075, 0.05], [0.02, 0.018, 0.01], side=_SIDE
    )
    black = limb_faces(
        [(0.0, 0.85, -0.02), (0.0, 0.83, -0.20), (0.0, 0.88, -0.46), (0.0, 0.96, -0.86)],
        [0.10, 0.15, 0.14, 0.09],
        [0.03, 0.04, 0.045, 0.03],
        side=_SIDE,
    )
    steel: list[Face] = []
    engine = [
        rectangle_ring(0.12, 0.16, y=0.24, z=-0.02),
        rectangle_ring(0.19, 0.24, y=0.30, z=-0.02),
        rectangle_ring(0.20, 0.25, y=0.45, z=0.0),
        rectangle_ring(0.14, 0.20, y=0.62, z=0.06),
        rectangle_ring(0.13, 0.18, y=0.76, z=0.06),
    ]
    steel += loft_faces(engine)
    for side in (-0.10, 0.10):
        steel += limb_faces([(side, 0.315, 0.70), (side, 1.0, 0.42)], [0.028, 0.024], segments=10)
        steel += limb_faces([(side, 0.315, -0.70), (side, 0.36, -0.25)], [0.02, 0.025], [0.035, 0.04], segments=8)
        steel += limb_faces([(side, 0.84, -0.30), (side, 0.42, -0.42)], [0.02, 0.02], segments=8)
        steel += limb_faces([(side, 0.90, 0.40), (side * 1.2, 0.55, 0.0)], [0.02, 0.02], segments=8)
    steel += limb_faces([(0.10, 0.30, -0.10), (0.26, 0.012, -0.02)], [0.012, 0.012], segments=6)
    chrome = limb_faces(
        [(-0.15, 0.50, 0.28), (-0.17, 0.30, 0.20), (-0.19, 0.27, -0.20), (-0.20, 0.36, -0.52), (-0.21, 0.44, -0.80)],
        [0.024, 0.026, 0.03, 0.05, 0.055],
        side=_SIDE,
        segments=10,
    )
    lamp = limb_faces([(0.0, 0.86, 0.50), (0.0, 0.86, 0.58), (0.0, 0.86, 0.60)], [0.07, 0.095, 0.09], segments=14)
    return {
        "Body": body,
        **parts,
        "Black": black,
        "Steel": [*steel, *_handlebars(1.03, 0.40, 0.38)],
        "Chrome": chrome,
        "Lamp": lamp,
        "RearLamp": box_faces((-0.05, 0.885, -0.96), (0.05, 0.93, -0.925)),
    }


def _scooter() -> dict[str, list[Face]]:
    parts = _wheels(0.23, 0.055, 0.15, 0.64, -0.60)
    body = limb_faces(
        [(0.0, 0.36, 0.56), (0.0, 0.62, 0.50), (0.0, 0.86, 0.42), (0.0, 0.98, 0.37)],
        [0.16, 0.20, 0.19, 0.11],
        [0.06, 0.05, 0.05, 0.06],
        side=_SIDE,
    )
    body += limb_faces(
        [(0.0, 0.40, 0.42), (0.0, 0.47, 0.62), (0.0, 0.40, 0.84)], [0.08, 0.09, 0.05], [0.05, 0.05, 0.03], side=_SIDE
    )
    body += loft_faces(
        [
            rectangle_ring(0.13, 0.40, y=0.30, z=-0.38),
            rectangle_ring(0.19, 0.46, y=0.45, z=-0.40),
            rectangle_ring(0.18, 0.46, y=0.62, z=-0.42),
            rectangle_ring(0.13, 0.38, y=0.70, z=-0.40),
        ]
    )
    black = loft_faces(
        [
            rectangle_ring(0.12, 0.36, y=0.69, z=-0.38),
            rectangle_ring(0.15, 0.39, y=0.74, z=-0.38),
            rectangle_ring(0.13, 0.36, y=0.79, z=-0.38),
        ]
    )
    black += box_faces((-0.18, 0.22, -0.10), (0.18, 0.30, 0.44))
    steel: list[Face] = []
    for side in (-0.075, 0.075):
        steel += limb_faces([(side, 0.23, 0.64), (side, 0.50, 0.54)], [0.02, 0.02], segments=8)
        steel += limb_faces([(side * 1.6, 0.23, -0.60), (side * 1.4, 0.30, -0.20)], [0.03, 0.04], segments=8)
    steel += limb_faces([(0.14, 0.26, -0.05), (0.24, 0.012, 0.0)], [0.01, 0.01], segments=6)
    chrome = limb_faces(
        [(-0.16, 0.27, -0.25), (-0.19, 0.28, -0.50), (-0.19, 0.32, -0.74)], [0.03, 0.055, 0.05], side=_SIDE, segments=10
    )
    return {
        "Body": body,
        **parts,
        "Black": black,
        "Steel": [*steel, *_handlebars(1.03, 0.36, 0.34)],
        "Chrome": chrome,
        "Lamp": limb_faces([(0.0, 0.90, 0.44), (0.0, 0.90, 0.50), (0.0, 0.90, 0.515)], [0.06, 0.07, 0.06], segments=14),
        "RearLamp": box_faces((-0.08, 0.56, -0.885), (0.08, 0.62, -0.86)),
    }
