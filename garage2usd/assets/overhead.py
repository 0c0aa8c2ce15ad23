"""Sprinkler pipes, cable trays, exit signs and traffic mirrors."""

from collections.abc import Sequence

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, Part, box_faces, lathe_faces, make_part

__all__ = ["cable_tray", "exit_sign", "mirror", "sprinkler"]

_CLAMP_M = 0.008
_HEAD_M = 0.07
_RAIL_M = 0.015
_RUNG_PITCH_M = 0.3
_CABLES_M = ((-0.115, 0.035), (-0.07, 0.025), (-0.035, 0.025), (0.03, 0.03), (0.07, 0.02))
"""Left side and thickness of each cable on a tray."""
_SIGN_WIDTH_M = 0.8
_SIGN_DEPTH_M = 0.05


def sprinkler(
    length_m: float, radius_m: float, drop_m: float, *, rods_at_m: Sequence[float], heads_at_m: Sequence[float]
) -> Asset:
    """A red pipe on rods with pendent heads, long along Z; origin over its middle, on the ceiling.

    Parameters
    ----------
    length_m, radius_m
        Of the pipe.
    drop_m
        From the ceiling down to the pipe's middle.
    rods_at_m, heads_at_m
        Places of the rods and of the heads along Z.
    """
    half = length_m / 2
    profile = [(-half, 0.0), (-half, radius_m), (half, radius_m), (half, 0.0)]
    # from X to Z, by a cyclic change of the axes that keeps the winding
    pipe = [face[:, [1, 2, 0]] + np.array((0.0, -drop_m, 0.0)) for face in lathe_faces(profile, segments=12)]
    rods: list[Face] = []
    for z in rods_at_m:
        rods += box_faces((-_CLAMP_M, -drop_m + radius_m * 0.9, z - _CLAMP_M), (_CLAMP_M, 0.0, z + _CLAMP_M))
    parts = [make_part("Pipe", pipe, "pipe_red", collider=Collider.BOX)]
    if rods:
        parts.append(make_part("Rods", rods, "steel_dark"))
    if heads_at_m:
        foot, brass = -drop_m - radius_m, []
        for z in heads_at_m:
            brass += box_faces((-0.012, foot - _HEAD_M + 0.006, z - 0.012), (0.012, foot + 0.004, z + 0.012))
            brass += box_faces((-0.03, foot - _HEAD_M, z - 0.03), (0.03, foot - _HEAD_M + 0.005, z + 0.03))
        parts.append(make_part("Heads", brass, "brass"))
    return Asset("sprinkler", tuple(parts))


def cable_tray(length_m: float, width_m: float, height_m: float, drop_m: float, *, rods_at_m: Sequence[float]) -> Asset:
    """A ladder of steel with cables on it, hung on bars between rods, long along Z; origin on the ceiling over it.

    Parameters
    ----------
    length_m, width_m, height_m
        Of the ladder.
    drop_m
        From the ceiling down to the ladder's bottom.
    rods_at_m
        Places of the pairs of rods along Z.
    """
    x, z, low = width_m / 2, length_m / 2, -drop_m
    rails: list[Face] = []
    for left, right in ((-x, -x + _RAIL_M), (x - _RAIL_M, x)):
        rails += box_faces((left, low, -z), (right, low + height_m, z))
    count = max(1, round(length_m / _RUNG_PITCH_M))
    rungs: list[Face] = []
    for index in range(count):
        middle = -z + (index + 0.5) * length_m / count
        rungs += box_faces((-x + _RAIL_M, low + 0.005, middle - 0.02), (x - _RAIL_M, low + 0.015, middle + 0.02))
    cables: list[Face] = []
    for left, width in _CABLES_M:
        cables += box_faces((left, low + 0.015, -z), (left + width, low + 0.015 + width, z))
    parts = [
        make_part("Rails", rails, "steel_galvanised", collider=Collider.BOX),
        make_part("Rungs", rungs, "steel_galvanised"),
        make_part("Cables", cables, "rubber_black"),
    ]
    hangers: list[Face] = []
    for at in rods_at_m:
        hangers += box_faces((-x - 0.04, low - 0.02, at - 0.02), (x + 0.04, low, at + 0.02))
        for side in (-x - 0.03, x + 0.02):
            hangers += box_faces((side, low, at - 0.005), (side + 0.01, 0.0, at + 0.005))
    if hangers:
        parts.append(make_part("Hangers", hangers, "steel_dark"))
    return Asset("cable_tray", tuple(parts))


def exit_sign(turn_deg: float, top_m: float, height_m: float) -> Asset:
    """A lit green sign on two rods that looks to +Z; origin over its middle, on the ceiling.

    Parameters
    ----------
    turn_deg
        Turn of its arrow from straight up, clockwise as a driver sees it.
    top_m, height_m
        Depth of its top below the ceiling, and its height.
    """
    half, low = _SIGN_WIDTH_M / 2, -top_m - height_m
    box = box_faces((-half, low, -_SIGN_DEPTH_M / 2), (half, -top_m, _SIGN_DEPTH_M / 2))
    rods: list[Face] = []
    for x in (-half * 0.8, half * 0.8):
        rods += box_faces((x - 0.008, -top_m, -0.008), (x + 0.008, 0.0, 0.008))
    front, middle = _SIGN_DEPTH_M / 2 + 0.002, low + height_m / 2
    return Asset(
        "exit_sign",
        (
            make_part("Box", box, "exit_green", collider=Collider.BOX),
            make_part("Rods", rods, "steel_dark"),
            *_arrow(turn_deg, 0.24, middle, front, height_m * 0.4),
            *_letters(middle, front, height_m * 0.5),
        ),
    )


def _arrow(turn_deg: float, x: float, y: float, z: float, reach: float) -> list[Part]:
    """The sign's arrow: a shaft and a head."""
    angle = -np.radians(turn_deg)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    shaft = [(-0.018, -reach), (0.018, -reach), (0.018, 0.1 * reach), (-0.018, 0.1 * reach)]
    head = [(-0.06, 0.1 * reach), (0.06, 0.1 * reach), (0.0, reach)]
    faces = [np.column_stack([np.array(shape) @ turn + (x, y), np.full(len(shape), z)]) for shape in (shaft, head)]
    return [
        make_part(name, [face], "exit_white") for name, face in zip(("ArrowShaft", "ArrowHead"), faces, strict=True)
    ]


# strokes of E, X, I and T as quadrilaterals in a cell of 1 x 1, counter-clockwise
_BAR = 0.2
_LETTERS: dict[str, list[tuple[tuple[float, float], ...]]] = {
    "E": [((0, 0), (_BAR, 0), (_BAR, 1), (0, 1))]
    + [((_BAR + 0.01, y), (0.75, y), (0.75, y + _BAR), (_BAR + 0.01, y + _BAR)) for y in (0.0, 0.4, 0.8)],
    "X": [
        ((0, 0), (0.24, 0), (0.8, 1), (0.56, 1)),
        ((0.56, 0), (0.8, 0), (0.5, 0.44), (0.38, 0.32)),
        ((0.3, 0.56), (0.42, 0.68), (0.24, 1), (0, 1)),
    ],
    "I": [((0.3, 0), (0.5, 0), (0.5, 1), (0.3, 1))],
    "T": [((0.3, 0), (0.5, 0), (0.5, 0.79), (0.3, 0.79)), ((0, 0.8), (0.8, 0.8), (0.8, 1), (0, 1))],
}


def _letters(y: float, z: float, size: float) -> list[Part]:
    """The word EXIT on the left part of a sign, a part for each stroke."""
    parts = []
    for index, letter in enumerate("EXIT"):
        left = -0.34 + index * size * 0.95
        for number, stroke in enumerate(_LETTERS[letter], start=1):
            face = np.array([(left + px * size, y + (py - 0.5) * size, z) for px, py in stroke])
            parts.append(make_part(f"Letter{letter}{number}", [face], "exit_white"))
    return parts


def mirror(radius_m: float, *, arm_m: float) -> Asset:
    """A convex mirror in an orange rim that looks to +Z, on an arm to -Z; origin in the middle of its rim."""
    rim = [(-0.03, 0.0), (-0.03, radius_m), (0.02, radius_m), (0.02, radius_m * 0.94), (0.0, radius_m * 0.94)]
    rim.append((0.0, 0.0))
    angles = np.linspace(np.pi / 2, 0.0, 7)
    glass = [(float(0.004 + 0.09 * np.cos(a)), float(radius_m * 0.93 * np.sin(a))) for a in angles]
    arm = box_faces((-0.02, -0.02, -arm_m), (0.02, 0.02, -0.032))
    return Asset(
        "mirror",
        (
            make_part("Rim", _facing(rim), "sign_orange", collider=Collider.CONVEX_HULL),
            make_part("Glass", _facing(glass), "mirror"),
            make_part("Arm", arm, "steel_dark"),
        ),
    )


def _facing(profile: list[tuple[float, float]]) -> list[Face]:
    """A solid of revolution about the Z axis from (z, radius) pairs."""
    return [face[:, [1, 2, 0]] for face in lathe_faces(profile, segments=32)]
