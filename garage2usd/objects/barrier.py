"""Barrier gates."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from garage2usd.assets.faces import box_faces, moved
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("barrier", number=19, label="barrier", cityscapes="guard rail", group="Ramps")

ARM_HALF_M = 0.04
"""Half the height of the arm."""
ARM_BEFORE_M = 0.22
"""Distance of the middle of the arm from that of the housing, in the direction of the traffic."""
_ARM_PITCH_M = 0.45
_HOUSING_M = (0.3, 1.05, 0.3)
PIVOT_M = 0.92
"""Height of the arm's pivot."""
_GATE = (rectangle(-0.2, -0.2, 0.2, 0.2), rectangle(-0.17, -1.9, 0.17, -1.5))
_ARM_Z_M = (0.18, 0.26)


@dataclass(frozen=True)
class BarrierSpec(Spec, kind=KIND):
    """A boom barrier whose arm reaches to -X, for traffic to +Z; origin in the middle of its housing's foot."""

    arm_m: float
    is_raised: bool
    elbow_m: float

    def asset(self) -> Asset:
        """Make the meshes of a boom barrier: housing, folding arm towards -X and ticket column."""
        x, top, z = _HOUSING_M[0] / 2, _HOUSING_M[1], _HOUSING_M[2] / 2
        housing = box_faces((-x, 0.1, -z), (x, top, z))
        plinth = box_faces((-x - 0.05, 0.0, -z - 0.05), (x + 0.05, 0.1, z + 0.05))
        cap = box_faces((-x - 0.02, top, -z - 0.02), (x + 0.02, top + 0.04, z + 0.02))
        red, white = _arm(self.arm_m, self.elbow_m) if self.is_raised else _level(0.0, -self.arm_m, PIVOT_M)
        arm_z = ARM_BEFORE_M
        hub = box_faces((-0.09, PIVOT_M - 0.09, z), (0.09, PIVOT_M + 0.09, arm_z - ARM_HALF_M / 2))
        return Asset(
            (
                make_part("Plinth", plinth, "kerb_concrete", collider=Collider.BOX),
                make_part("Housing", housing, "machine_yellow", collider=Collider.BOX),
                make_part("Cap", cap, "steel_dark", collider=Collider.BOX),
                make_part("Hub", hub, "steel_dark"),
                *(
                    make_part(f"{name}{index}", moved(box, (0.0, 0.0, arm_z)), material, collider=Collider.BOX)
                    for name, boxes, material in (("Red", red, "sign_ring"), ("White", white, "sign_white"))
                    for index, box in enumerate(boxes, start=1)
                ),
                *_ticket_column(),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the boom barrier's housing, its ticket column and its lowered arm."""
        return *_GATE, rectangle(-self.arm_m, _ARM_Z_M[0], _ARM_Z_M[1] - _ARM_Z_M[0], _ARM_Z_M[1])


def _ticket_column() -> list[Part]:
    """Make the barrier's ticket column with its screen and slot, 1.7 m before the arm, facing -X."""
    z = -1.7
    plinth = box_faces((-0.17, 0.0, z - 0.2), (0.17, 0.1, z + 0.2))
    body = box_faces((-0.12, 0.1, z - 0.15), (0.12, 1.3, z + 0.15))
    screen = box_faces((-0.126, 1.0, z - 0.1), (-0.12, 1.2, z + 0.1), without="r")
    slot = box_faces((-0.126, 0.84, z - 0.06), (-0.12, 0.88, z + 0.06), without="r")
    return [
        make_part("TicketPlinth", plinth, "kerb_concrete", collider=Collider.BOX),
        make_part("TicketColumn", body, "machine_yellow", collider=Collider.BOX),
        make_part("Screen", screen, "screen_glow"),
        make_part("Slot", slot, "steel_dark"),
    ]


def _level(start_m: float, end_m: float, height_m: float) -> tuple[list[list[Face]], list[list[Face]]]:
    """Return the red and white boxes of a level piece of a barrier's arm, from `start_m` to the left."""
    count = max(1, round((start_m - end_m) / _ARM_PITCH_M))
    ends = np.linspace(start_m, end_m, count + 1).tolist()
    half = ARM_HALF_M
    boxes = [
        box_faces((left, height_m - half, -half / 2), (right, height_m + half, half / 2))
        for right, left in pairwise(ends)
    ]
    return boxes[1::2], boxes[0::2]


def _arm(arm_m: float, elbow_m: float) -> tuple[list[list[Face]], list[list[Face]]]:
    """Return the red and white boxes of a raised barrier arm that folds at its elbow."""
    half, upright = ARM_HALF_M, elbow_m - PIVOT_M
    red, white = _level(half, half - (arm_m - upright), elbow_m)
    count = max(1, round(upright / _ARM_PITCH_M))
    ends = np.linspace(PIVOT_M, elbow_m - half, count + 1).tolist()
    stack = [box_faces((-half, low, -half / 2), (half, high, half / 2)) for low, high in pairwise(ends)][::-1]
    return red + stack[0::2], white + stack[1::2]
