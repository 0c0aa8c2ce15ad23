"""Motorbikes: scooters and naked bikes."""

from dataclasses import dataclass

from garage2usd.assets.faces import box_faces, faces_of, limb_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.bicycle import wheel_faces
from garage2usd.objects.kind import Kind, Polygon, Spec, TilePart, rectangle

KIND = Kind("motorbike", number=41, label="motorbike", cityscapes="motorcycle", group="Clutter", part=TilePart.PARKING)

MOTORBIKE_COLOURS = ("black", "red", "blue", "white", "grey", "orange")
_SORTS = shipped_toml("garage2usd.objects", "motorbike")


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
        parts = _made("scooter" if self.is_scooter else "naked")
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


def _made(sort: str) -> dict[str, list[Face]]:
    """Return the parts of a sort of motorbikes by name."""
    given = _SORTS[sort]
    body, *others = ("Body", "Black", "Steel", "Chrome", "Lamp", "RearLamp")
    parts = {body: faces_of(given[body]), **_wheels(*given["wheels"])}
    parts |= {name: faces_of(given[name]) for name in others}
    parts["Steel"] += _handlebars(*given["handlebars"])
    return parts
