"""Stacks of wooden pallets."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.faces import box_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("pallet", number=39, label="pallet", cityscapes="dynamic", group="Clutter")

PALLET_HEIGHT_M = 0.144
_LENGTH_M, _WIDTH_M = 1.2, 0.8
_BOARD_M, _JOINT_M = 0.022, 0.0005
_ROWS_M = ((-0.4, -0.3), (-0.0725, 0.0725), (0.3, 0.4))
"""Extent across a pallet of its three rows of blocks."""


@dataclass(frozen=True)
class PalletSpec(Spec, kind=KIND):
    """A stack of flat pallets of EN 13698-1, 1.2 m along X and 0.8 m along Z; origin on the floor in the middle.

    Attributes
    ----------
    count
        Number of pallets.
    is_upright
        True if the pallets are stood on a long side, deep along Z.
    """

    count: int = 1
    is_upright: bool = False

    @property
    def mass_kg(self) -> float:
        """Mass of the pallets, 25 kg each as EPAL gives for the Euro pallet."""
        return 25.0 * self.count

    def asset(self) -> Asset:
        """Make the mesh of pallets: boards on nine blocks on three runners, each pallet 0.144 m high."""
        wood: list[Face] = []
        for number in range(self.count):
            wood += moved(_pallet(), (0.0, number * PALLET_HEIGHT_M, 0.0))
        if self.is_upright:
            # a right-handed turn of the axes keeps the winding
            wood = [
                np.stack([face[:, 0], face[:, 2] + _WIDTH_M / 2, self._depth_m / 2 - face[:, 1]], axis=1)
                for face in wood
            ]
        return Asset((make_part("Wood", wood, "wood_pallet", collider=Collider.BOX),))

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outline of the pallets on the floor."""
        return (rectangle(-_LENGTH_M / 2, -self._depth_m / 2, _LENGTH_M / 2, self._depth_m / 2),)

    @property
    def _depth_m(self) -> float:
        return self.count * PALLET_HEIGHT_M if self.is_upright else _WIDTH_M


def _pallet() -> list[Face]:
    x = _LENGTH_M / 2
    faces: list[Face] = []

    def board(left: float, right: float, low: float, high: float, near: float, far: float) -> None:
        # joints stay open by a hair, so that no two boards share an edge
        faces.extend(box_faces((left, low, near), (right, high - _JOINT_M, far)))

    for near, far in _ROWS_M:
        board(-x, x, 0.0, _BOARD_M, near, far)
        for middle in (-0.5275, 0.0, 0.5275):
            board(middle - 0.0725, middle + 0.0725, _BOARD_M, 0.1, near, far)
    for middle in (-0.5275, 0.0, 0.5275):
        board(middle - 0.0725, middle + 0.0725, 0.1, 0.122, -0.4, 0.4)
    for middle, width in ((-0.3275, 0.145), (-0.18, 0.1), (0.0, 0.145), (0.18, 0.1), (0.3275, 0.145)):
        board(-x, x, 0.122, PALLET_HEIGHT_M, middle - width / 2, middle + width / 2)
    return faces
