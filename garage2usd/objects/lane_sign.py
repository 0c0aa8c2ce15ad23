"""Signs of one-way lanes that hang from the ceiling: no entry, and one way."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from garage2usd.assets.faces import box_faces, disc_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet

KIND = Kind("lane_sign", number=48, label="lane_sign", cityscapes="traffic sign", follows=VariantSet.CEILING)

_DEPTH_M = 0.03
_ROD_M = 0.008
_ON_FACE_M = 0.002
_BAR_WIDTH, _BAR_HEIGHT = 0.7, 0.2
"""Size of the bar of a no-entry sign, as shares of the sign's height (Vienna Convention on Road Signs, C, 1a)."""
_SHAFT = ((-0.05, -0.34), (0.05, -0.34), (0.05, 0.06), (-0.05, 0.06))
_HEAD = ((-0.18, 0.06), (0.18, 0.06), (0.0, 0.34))
"""Outline of the upright arrow's head on a one-way sign (E, 3b), in shares of the sign's height."""


class LaneSignText(StrEnum):
    """Text of a lane sign."""

    NO_ENTRY = "no_entry"
    ONE_WAY = "one_way"


@dataclass(frozen=True)
class LaneSignSpec(Spec, kind=KIND):
    """A sign facing +Z on two rods; origin on the ceiling over its middle, its top `top_m` below the ceiling."""

    says: LaneSignText
    top_m: float
    height_m: float

    @property
    def width_m(self) -> float:
        """Width of the sign."""
        return self.height_m

    def asset(self) -> Asset:
        """Make the meshes of a sign: a red disc with a bar, or a blue board with an arrow, on two rods."""
        half, middle = self.height_m / 2, -self.top_m - self.height_m / 2
        rods: list[Face] = []
        for x in (-half * 0.6, half * 0.6):
            # the rods reach into the board, whose upper border may be round
            rods += box_faces((x - _ROD_M, -self.top_m - half * 0.3, -_ROD_M), (x + _ROD_M, 0.0, _ROD_M))
        return Asset((*self._board(half, middle), make_part("Rods", rods, "steel_dark")))

    def _board(self, half: float, middle: float) -> list[Part]:
        front = _DEPTH_M / 2
        if self.says is LaneSignText.NO_ENTRY:
            disc = disc_faces(half, -front, front, middle)
            x, y = _BAR_WIDTH * half, _BAR_HEIGHT * half
            bar = ((-x, -y), (x, -y), (x, y), (-x, y))
            return [
                make_part("Disc", disc, "sign_ring", collider=Collider.CONVEX_HULL),
                make_part("Bar", [_face(bar, 1.0, middle, front + _ON_FACE_M)], "sign_white"),
            ]
        board = box_faces((-half, middle - half, -front), (half, middle + half, front))
        shapes = [_face(shape, self.height_m, middle, front + _ON_FACE_M) for shape in (_SHAFT, _HEAD)]
        return [
            make_part("Board", board, "sign_blue", collider=Collider.BOX),
            make_part("Arrow", shapes, "sign_white"),
        ]


def _face(shape: tuple[tuple[float, float], ...], size: float, middle: float, front: float) -> Face:
    """Return an upright face that looks to +Z, of a shape in shares of a size around a height."""
    return np.array([(x * size, middle + y * size, front) for x, y in shape])
