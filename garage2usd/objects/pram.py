"""Prams left as clutter."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import faces_of, limb_faces, loft_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.bicycle import wheel_faces
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("pram", number=43, label="pram", cityscapes="dynamic", group="Clutter")

PRAM_COLOURS = ("navy", "grey", "black", "red")
_PARTS = shipped_toml("garage2usd.objects", "pram")


@dataclass(frozen=True)
class PramSpec(Spec, kind=KIND):
    """A pram with its hood up; origin on the floor in its middle, pushed to +Z.

    Attributes
    ----------
    colour
        Colour of the cloth, one of `PRAM_COLOURS`.
    """

    colour: str = "navy"

    @property
    def mass_kg(self) -> float:
        """Mass of the empty pram in kilograms; assumption."""
        return 13.0

    def asset(self) -> Asset:
        """Make the meshes of a pram: carrycot with hood on a folding frame with four wheels and a handle."""
        angles = np.radians(np.linspace(0.0, 112.0, 7))
        # the hood consists of half rings that turn about the edge of the cot, and opens away from the handle
        hood = [
            np.stack(
                [
                    0.205 * np.cos(around),
                    0.762 + 0.30 * np.sin(around) * np.sin(at) + 0.004,
                    -0.06 - 0.29 * np.sin(around) * np.cos(at),
                ],
                axis=1,
            )
            for at in angles
            for around in [np.linspace(0.02, np.pi - 0.02, 15)]
        ]
        cot, cover, frame, handle = (faces_of(_PARTS[name]) for name in ("Cot", "Cover", "Frame", "Handle"))
        tyres: list[Face] = []
        rims: list[Face] = []
        for x in (-0.29, 0.29):
            for z in (0.38, -0.36):
                tyre, rim = wheel_faces(0.15, 0.02, 0.115)
                disc = limb_faces(
                    [(-0.008, 0.0, 0.0), (0.008, 0.0, 0.0)], [0.105] * 2, side=(0.0, 1.0, 0.0), segments=16
                )
                tyres += moved(tyre, (x, 0.15, z))
                rims += moved([*rim, *disc], (x, 0.15, z))
        return Asset(
            (
                make_part("Cot", cot, f"cloth_{self.colour}", collider=Collider.CONVEX_HULL, crease_deg=50.0),
                make_part("Hood", _shell(hood), f"cloth_{self.colour}", collider=Collider.CONVEX_HULL, crease_deg=50.0),
                make_part("Cover", cover, "cloth_grey", crease_deg=50.0),
                make_part("Frame", frame, "steel_dark", collider=Collider.CONVEX_HULL, crease_deg=60.0),
                make_part("Handle", handle, "rubber_black", collider=Collider.CONVEX_HULL, crease_deg=60.0),
                make_part("Tyres", tyres, "tyre", collider=Collider.CONVEX_HULL),
                make_part("Rims", rims, "rim"),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the pram's wheels and handle."""
        return (rectangle(-0.315, -0.545, 0.315, 0.54),)


def _shell(lines: list[Face]) -> list[Face]:
    """Return a thin closed shell through lines with equal numbers of points, for a pram's hood: 1 cm thick."""
    rings = [np.concatenate([line, (line * (0.95, 1.0, 1.0) - (0.0, 0.012, -0.012))[::-1]]) for line in lines]
    return loft_faces([ring[::-1] for ring in rings])
