"""The way in and out: ramps to the ground outside, the sky over them, and barrier gates."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, Part, box_faces, make_part

__all__ = ["barrier", "ramp", "sky"]

Profile = Sequence[tuple[float, float]]

_GROOVE_PITCH_M = 0.25
_GROOVE_WIDTH_M = 0.05
_GROOVE_DEPTH_M = 0.008
_KERB_WIDTH_M = 0.18
_KERB_HEIGHT_M = 0.15
_BAND_TOP_M = 1.1
_STRIPE_M = 0.12
_PROUD_M = 0.004
_HEADER_M = 0.3
_DRAIN_M = 0.2
_SLAT_M = 0.04
_ARM_M = 0.08
_ARM_PITCH_M = 0.45
_HOUSING_M = (0.3, 1.05, 0.3)
_PIVOT_M = 0.92


def ramp(
    *,
    width_m: float,
    wall_m: float,
    threshold_m: tuple[float, float],
    profile: Profile,
    cover_m: tuple[float, float, float],
    wall_top_m: float,
) -> Asset:
    """A straight ramp that rises towards -Z; origin in the middle of the door's foot, on the wall's inner face.

    Parameters
    ----------
    width_m
        Clear width between the side walls.
    wall_m
        Thickness of the side walls.
    threshold_m
        Width and depth of the floor in the door's opening.
    profile
        (run, height) along the floor from the back of the door's wall to the far end.
    cover_m
        Run at the end of the slab over the ramp's foot, height of its underside and of its top.
    wall_top_m
        Height of the side walls.
    """
    half, (start, _), (end, _) = width_m / 2, profile[0], profile[-1]
    cover_end, cover_low, cover_high = cover_m
    threshold = _strip(threshold_m[0] / 2, [(0.0, 0.0), (threshold_m[1], 0.0)])
    slab = box_faces((-half, cover_low, -cover_end + _HEADER_M), (half, cover_high, -start))
    header = box_faces((-half, cover_low, -cover_end), (half, wall_top_m, -cover_end + _HEADER_M))
    parts = [
        make_part("Threshold", threshold, "floor_concrete", collider=Collider.MESH),
        make_part("Floor", _strip(half, _grooved(profile)), "floor_concrete", collider=Collider.MESH),
        make_part("Cover", slab, "ceiling_concrete", collider=Collider.BOX),
        make_part("Header", header, "wall_concrete", collider=Collider.BOX),
        make_part("Drain", _drain(half - _KERB_WIDTH_M, start), "steel_dark"),
    ]
    for name, side in (("Left", -1.0), ("Right", 1.0)):
        inner, outer = sorted((side * half, side * (half + wall_m)))
        wall = box_faces((inner, 0.0, -end), (outer, wall_top_m, -start))
        face, kerb = side * (half - _PROUD_M), _kerb(half, side, profile)
        parts += [
            make_part(f"{name}Wall", wall, "wall_concrete", collider=Collider.BOX),
            make_part(f"{name}Band", _ribbon(face, profile, 0.0, _BAND_TOP_M), "wall_band"),
            make_part(f"{name}Stripe", _ribbon(face, profile, _BAND_TOP_M, _BAND_TOP_M + _STRIPE_M), "band_stripe"),
            make_part(f"{name}Kerb", kerb, "hazard", collider=Collider.MESH),
        ]
    return Asset("ramp", tuple(parts))


def sky(*, width_m: float, start_m: float, end_m: float, ground_m: float, low_m: float, high_m: float) -> Asset:
    """The daylight over a ramp's open end, seen from below; origin as `ramp`.

    It stands on the side walls from `low_m` to `high_m`, over the runs from `start_m` to `end_m`, and closes the far
    end from `ground_m` on.
    """
    x, near, far = width_m / 2, -start_m, -end_m
    shell = box_faces((-x, low_m, far), (x, high_m, near), without="bn")
    faces = [face[::-1] for face in shell]
    faces.append(np.array([(-x, ground_m, far), (x, ground_m, far), (x, high_m, far), (-x, high_m, far)]))
    return Asset("sky", (make_part("Daylight", faces, "daylight"),))


def barrier(*, arm_m: float, is_raised: bool, elbow_m: float) -> Asset:
    """A boom barrier with a folding arm towards -X and a ticket column; origin in the middle of its housing's foot.

    Parameters
    ----------
    arm_m
        Reach of the closed arm from the housing's middle.
    is_raised
        Whether the arm is open: upright as far as the elbow, then level.
    elbow_m
        Height of the raised elbow.
    """
    x, top, z = _HOUSING_M[0] / 2, _HOUSING_M[1], _HOUSING_M[2] / 2
    housing = box_faces((-x, 0.1, -z), (x, top, z))
    plinth = box_faces((-x - 0.05, 0.0, -z - 0.05), (x + 0.05, 0.1, z + 0.05))
    cap = box_faces((-x - 0.02, top, -z - 0.02), (x + 0.02, top + 0.04, z + 0.02))
    red, white = _arm(arm_m, elbow_m) if is_raised else _level(0.0, -arm_m, _PIVOT_M)
    arm_z = z + 0.07
    hub = box_faces((-0.09, _PIVOT_M - 0.09, z), (0.09, _PIVOT_M + 0.09, arm_z - _ARM_M / 4))
    return Asset(
        "barrier",
        (
            make_part("Plinth", plinth, "kerb_concrete", collider=Collider.BOX),
            make_part("Housing", housing, "machine_yellow", collider=Collider.BOX),
            make_part("Cap", cap, "steel_dark", collider=Collider.BOX),
            make_part("Hub", hub, "steel_dark"),
            *(
                make_part(
                    f"{name}{index}",
                    [face + np.array((0.0, 0.0, arm_z)) for face in box],
                    material,
                    collider=Collider.BOX,
                )
                for name, boxes, material in (("Red", red, "sign_ring"), ("White", white, "sign_white"))
                for index, box in enumerate(boxes, start=1)
            ),
            *_ticket_column(),
        ),
    )


def _ticket_column() -> list[Part]:
    """The column with a screen and a slot at a driver's window, 1.7 m before the barrier; it looks to -X."""
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
    """A level piece of arm from `start_m` to the left, in red and white boxes by turns."""
    count = max(1, round((start_m - end_m) / _ARM_PITCH_M))
    ends = np.linspace(start_m, end_m, count + 1).tolist()
    half = _ARM_M / 2
    boxes = [
        box_faces((left, height_m - half, -half / 2), (right, height_m + half, half / 2))
        for right, left in pairwise(ends)
    ]
    return boxes[1::2], boxes[0::2]


def _arm(arm_m: float, elbow_m: float) -> tuple[list[list[Face]], list[list[Face]]]:
    """A raised arm that folds at its elbow."""
    half, upright = _ARM_M / 2, elbow_m - _PIVOT_M
    red, white = _level(half, half - (arm_m - upright), elbow_m)
    count = max(1, round(upright / _ARM_PITCH_M))
    ends = np.linspace(_PIVOT_M, elbow_m - half, count + 1).tolist()
    stack = [box_faces((-half, low, -half / 2), (half, high, half / 2)) for low, high in pairwise(ends)][::-1]
    return red + stack[0::2], white + stack[1::2]


def _strip(half_m: float, profile: Profile) -> list[Face]:
    """The floor along a profile, seen from above."""
    return [
        np.array([(-half_m, y0, -r0), (half_m, y0, -r0), (half_m, y1, -r1), (-half_m, y1, -r1)])
        for (r0, y0), (r1, y1) in pairwise(profile)
    ]


def _ribbon(x: float, profile: Profile, low_m: float, high_m: float) -> list[Face]:
    """An upright ribbon at `x` that follows a profile and looks to the ramp's middle."""
    faces = [
        np.array([(x, y0 + low_m, -r0), (x, y0 + high_m, -r0), (x, y1 + high_m, -r1), (x, y1 + low_m, -r1)])
        for (r0, y0), (r1, y1) in pairwise(profile)
    ]
    return faces if x > 0 else [face[::-1] for face in faces]


def _kerb(half_m: float, side: float, profile: Profile) -> list[Face]:
    """The kerb at the foot of a side wall."""
    outer, inner, up = side * half_m, side * (half_m - _KERB_WIDTH_M), np.array((0.0, _KERB_HEIGHT_M, 0.0))
    faces = _ribbon(inner, profile, 0.0, _KERB_HEIGHT_M)
    low, high = sorted((inner, outer))
    middle = np.array(((low + high) / 2, 0.0, 0.0))
    faces += [face + middle + up for face in _strip((high - low) / 2, profile)]
    (start, y), _ = profile[0], profile[1]
    faces += box_faces((low, y, -start - 1), (high, y + _KERB_HEIGHT_M, -start), without="lrbtn")
    return faces


def _grooved(profile: Profile) -> list[tuple[float, float]]:
    """A profile with grooves across its slopes, for grip."""
    runs, heights = zip(*profile, strict=True)
    grooved = [profile[0]]
    half, edge = _GROOVE_WIDTH_M / 2, 0.004
    for (r0, y0), (r1, y1) in pairwise(profile):
        count = int((r1 - r0) / _GROOVE_PITCH_M) if y1 > y0 else 0
        for middle in (r0 + (np.arange(count) + 0.5) * (r1 - r0) / max(count, 1)).tolist():
            for offset, depth in ((-half, 0.0), (-half + edge, _GROOVE_DEPTH_M)):
                grooved.append((middle + offset, float(np.interp(middle + offset, runs, heights)) - depth))
            for offset, depth in ((half - edge, _GROOVE_DEPTH_M), (half, 0.0)):
                grooved.append((middle + offset, float(np.interp(middle + offset, runs, heights)) - depth))
        grooved.append((r1, y1))
    return grooved


def _drain(half_m: float, start_m: float) -> list[Face]:
    """The slats of the channel drain across the ramp's foot."""
    faces: list[Face] = []
    for index in range(int(_DRAIN_M / _SLAT_M)):
        far = start_m + 0.1 + index * _SLAT_M
        faces += box_faces((-half_m, 0.0, -far - _SLAT_M * 0.6), (half_m, 0.004, -far), without="b")
    return faces
