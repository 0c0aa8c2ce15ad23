"""Rows of shopping trolleys."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import box_faces, lathe_faces, limb_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("trolley", number=42, label="shopping_trolley", cityscapes="dynamic", group="Clutter")

_NESTED_M = 0.27
"""Distance between consecutive trolleys of a nested row."""
_LOW_M, _HIGH_M = 0.42, 0.90
_WIRE_M = 0.0035


@dataclass(frozen=True)
class TrolleySpec(Spec, kind=KIND):
    """A row of nested shopping trolleys, fronts to +Z; origin on the floor in the middle of the row.

    Attributes
    ----------
    count
        Number of trolleys.
    """

    count: int = 1

    @property
    def mass_kg(self) -> float:
        """Mass of the shopping trolleys at 20 kg each; assumption."""
        return 20.0 * self.count

    def asset(self) -> Asset:
        """Make the meshes of shopping trolleys: wire baskets on frames with four castors and a coloured handle each."""
        wire: list[Face] = []
        wheels: list[Face] = []
        handles: list[Face] = []
        for number in range(self.count):
            by = (0.0, 0.0, (number - (self.count - 1) / 2) * _NESTED_M)
            wire += moved([*_basket(), *_frame()], by)
            wheels += moved(_castors(), by)
            handle = limb_faces(
                [(-0.27, 1.0, -0.46), (0.27, 1.0, -0.46)], [0.016] * 2, side=(0.0, 1.0, 0.0), segments=8
            )
            handles += moved(handle, by)
        return Asset(
            (
                make_part("Wire", wire, "chrome", collider=Collider.CONVEX_HULL, crease_deg=60.0),
                make_part("Wheels", wheels, "rubber_black", collider=Collider.CONVEX_HULL),
                make_part("Handles", handles, "sign_red", collider=Collider.CONVEX_HULL, crease_deg=60.0),
            )
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the trolleys' baskets and handles."""
        depth = 0.49 + (self.count - 1) / 2 * _NESTED_M
        return (rectangle(-0.29, -depth, 0.29, depth),)


def _line(*points: tuple[float, float, float], radius_m: float = _WIRE_M) -> list[Face]:
    segments = 4 if radius_m == _WIRE_M else 6
    return limb_faces(points, [radius_m] * len(points), side=(0.31, 0.17, 0.93), segments=segments)


def _corner(share: float, side: float) -> tuple[float, float, float]:
    """Return a corner of a trolley's basket at a share of its height, at the back if `side` is negative."""
    x = 0.19 + 0.06 * share
    z = 0.34 + 0.13 * share if side > 0 else -0.36 - 0.05 * share
    return x, _LOW_M + (_HIGH_M - _LOW_M) * share + (0.0 if side < 0 else -0.08 * share), z


def _basket() -> list[Face]:
    faces: list[Face] = []
    for share in np.linspace(0.0, 1.0, 6).tolist():
        (bx, by, bz), (fx, fy, fz) = _corner(share, -1), _corner(share, 1)
        thick = 0.006 if share in {0.0, 1.0} else _WIRE_M
        for sign in (-1.0, 1.0):
            faces += _line((sign * bx, by, bz), (sign * fx * 0.82, fy, fz), radius_m=thick)
        faces += _line((-fx * 0.82, fy, fz), (fx * 0.82, fy, fz), radius_m=thick)
        faces += _line((-bx, by, bz), (bx, by, bz), radius_m=thick)
    for at in np.linspace(0.0, 1.0, 11).tolist():
        low = tuple(np.array(_corner(0.0, -1)) * (1 - at) + np.array(_corner(0.0, 1)) * (0.82, 1, 1) * at)
        high = tuple(np.array(_corner(1.0, -1)) * (1 - at) + np.array(_corner(1.0, 1)) * (0.82, 1, 1) * at)
        for sign in (-1.0, 1.0):
            faces += _line((sign * low[0], low[1], low[2]), (sign * high[0], high[1], high[2]))
        faces += _line((-low[0], low[1], low[2]), (low[0], low[1], low[2]))
    for at in np.linspace(-0.8, 0.8, 7).tolist():
        (fx, fy, fz), (tx, ty, tz) = _corner(0.0, 1), _corner(1.0, 1)
        faces += _line((at * fx * 0.82, fy, fz), (at * tx * 0.82, ty, tz))
        (bx, by, bz), (ux, uy, uz) = _corner(0.0, -1), _corner(1.0, -1)
        faces += _line((at * bx, by, bz), (at * ux, uy, uz))
    return faces


def _frame() -> list[Face]:
    faces: list[Face] = []
    for sign in (-1.0, 1.0):
        x = sign * 0.24
        faces += _line((x, 0.14, -0.40), (sign * 0.15, 0.14, 0.42), radius_m=0.011)
        faces += _line((x, 0.14, -0.40), (sign * 0.25, 0.60, -0.36), (sign * 0.26, 1.0, -0.46), radius_m=0.011)
        faces += _line((sign * 0.2, 0.14, 0.05), (sign * 0.2, _LOW_M, -0.25), radius_m=0.009)
        for at, wide in ((-0.38, 0.24), (0.40, 0.155)):
            faces += box_faces((sign * wide - 0.016, 0.09, at - 0.02), (sign * wide + 0.016, 0.13, at + 0.02))
    return faces


def _castors() -> list[Face]:
    wheel = lathe_faces(
        [(-0.014, 0.0), (-0.014, 0.058), (-0.01, 0.0625), (0.01, 0.0625), (0.014, 0.058), (0.014, 0.0)], segments=14
    )
    return [
        face
        for x, z in ((-0.24, -0.38), (0.24, -0.38), (-0.155, 0.40), (0.155, 0.40))
        for face in moved(wheel, (x, 0.0625, z))
    ]
