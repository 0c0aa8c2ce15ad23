"""Dressed people in poses: lofts along the limbs of a skeleton.

Proportions are those of Drillis and Contini (1966): lengths and widths are shares of the stature.
"""
# Over 300 lines: one function for each part of a body, together with the measures of its rings.

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces, limb_faces, loft_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part

_Vector = NDArray[np.float64]
_SIDES = (1.0, -1.0)
"""Left and right, along X."""
_CREASE_DEG = 60.0
_UP = np.array([0.0, 1.0, 0.0])

_THIGH, _SHIN, _ANKLE = 0.245, 0.246, 0.039
_UPPER_ARM, _FOREARM, _HAND = 0.182, 0.143, 0.102
_HIP_X, _SHOULDER_Y, _NECK_Y, _CHIN_Y = 0.048, 0.285, 0.322, 0.345
"""Positions of joints: X from the centre, Y above the hips."""
_HEAD, _HEAD_X, _HEAD_Z = 0.128, 0.0445, 0.057
"""Height of the head, and half its width and depth."""


class Outfit(StrEnum):
    """Type of a person's clothes."""

    JACKET = "jacket"
    COAT = "coat"
    SHIRT = "shirt"
    DRESS = "dress"


class Figure(NamedTuple):
    """A person: proportions, clothes and materials.

    Attributes
    ----------
    height_m
        Stature.
    build
        Factor on widths and depths.
    is_woman
        True if shoulders, waist and hips have a woman's proportions.
    outfit, top, bottom, shoes
        Type of the clothes, and the materials of top, bottom and shoes.
    skin, hair
        Materials of skin and hair.
    has_long_hair
        True if the hair falls down the back.
    """

    height_m: float
    build: float
    is_woman: bool
    outfit: Outfit
    top: str
    bottom: str
    shoes: str
    skin: str
    hair: str
    has_long_hair: bool = False


@dataclass(frozen=True)
class Pose:
    """Pose of a person: angles of the left and right limbs in degrees, forwards positive.

    Attributes
    ----------
    hips, knees, feet
        Angles of the thighs to the vertical, of the shins backwards to the thighs, and of the toes downwards.
    shoulders, elbows, spread, inwards
        Angles of the upper arms to the trunk, of the forearms to the upper arms, of the upper arms outwards and of the
        forearms inwards.
    lean, nod, turn
        Angles of the trunk, and of the head forwards and to the left.
    """

    hips: tuple[float, float] = (0.0, 0.0)
    knees: tuple[float, float] = (2.0, 2.0)
    feet: tuple[float, float] = (0.0, 0.0)
    shoulders: tuple[float, float] = (3.0, 3.0)
    elbows: tuple[float, float] = (14.0, 14.0)
    spread: tuple[float, float] = (9.0, 9.0)
    inwards: tuple[float, float] = (3.0, 3.0)
    lean: float = 0.0
    nod: float = 0.0
    turn: float = 0.0
    has_phone: bool = False
    has_bag: bool = False


_STANDING = Pose(hips=(4.0, -2.0), knees=(8.0, 2.0), shoulders=(2.0, -2.0), elbows=(16.0, 10.0), turn=18.0)
POSES: dict[str, Pose] = {
    "standing": _STANDING,
    "walking": Pose(
        hips=(26.0, -16.0),
        knees=(10.0, 14.0),
        feet=(-12.0, 24.0),
        shoulders=(-20.0, 24.0),
        elbows=(18.0, 30.0),
        spread=(7.0, 7.0),
        lean=4.0,
    ),
    "phone": replace(
        _STANDING,
        shoulders=(-2.0, 28.0),
        elbows=(12.0, 92.0),
        spread=(9.0, 4.0),
        nod=28.0,
        turn=-6.0,
        has_phone=True,
        inwards=(3.0, 24.0),
    ),
    "carrying": replace(
        _STANDING, shoulders=(2.0, 4.0), elbows=(10.0, 6.0), spread=(8.0, 12.0), turn=-20.0, has_bag=True
    ),
    "pushing": Pose(
        hips=(20.0, -14.0),
        knees=(12.0, 10.0),
        feet=(-4.0, 18.0),
        shoulders=(34.0, 34.0),
        elbows=(46.0, 46.0),
        spread=(6.0, 6.0),
        lean=8.0,
        nod=4.0,
    ),
    "folded": replace(
        _STANDING, shoulders=(22.0, 16.0), elbows=(66.0, 76.0), spread=(5.0, 5.0), inwards=(64.0, 62.0), turn=30.0
    ),
}
"""Poses by name."""


class _Body(NamedTuple):
    """A posed skeleton in metres: joints (x, y, z), and the rotations of trunk and head."""

    unit_m: float
    hips: _Vector
    spine: NDArray[np.float64]
    head: NDArray[np.float64]
    legs: list[list[_Vector]]
    arms: list[list[_Vector]]

    def trunk(self, points: Sequence[tuple[float, float, float]]) -> list[_Vector]:
        """Convert points of the trunk from shares of the stature, relative to the hips' centre."""
        return [self.hips + self.unit_m * (self.spine @ np.array(point)) for point in points]


def figure_asset(figure: Figure, pose: Pose) -> Asset:
    """Make a person that faces +Z, with the feet on y = 0 below the hips."""
    body = _body(figure, pose)
    head = _head(body)
    hands = _hands(body)
    legs: list[Face] = []
    bottom: list[Face] = []
    if figure.outfit is Outfit.DRESS:
        legs = _legs(body, figure, is_bare=True)
        bottom = _skirt(body, figure)
    else:
        bottom = [*_pelvis(body, figure), *_legs(body, figure, is_bare=False)]
    bare_arms: list[Face] = []
    top = _trunk(body, figure)
    if figure.outfit is Outfit.SHIRT:
        top += _arms(body, figure, 0, 3)
        bare_arms = _arms(body, figure, 2, 6, thinner=0.82)
    else:
        top += _arms(body, figure, 0, 6)
    parts = [
        _part("Top", top, figure.top, Collider.CONVEX_HULL),
        _part("Bottom", bottom, figure.bottom, Collider.CONVEX_HULL),
        _part("Shoes", _shoes(body, pose), figure.shoes, Collider.CONVEX_HULL),
        _part("Head", head, figure.skin, Collider.CONVEX_HULL),
        _part("Skin", [*hands, *bare_arms, *legs], figure.skin),
        _part("Hair", _hair(body, figure), figure.hair),
    ]
    if pose.has_phone:
        parts.append(_part("Phone", _phone(body), "glass"))
    if pose.has_bag:
        parts.append(_part("Bag", _bag(body), "leather_brown"))
    return Asset(tuple(parts))


def _part(name: str, faces: list[Face], material: str, collider: Collider | None = None) -> Part:
    return make_part(name, faces, material, collider=collider, crease_deg=_CREASE_DEG)


def _turned(pitch_deg: float, yaw_deg: float = 0.0) -> NDArray[np.float64]:
    """Rotation matrix: forwards about X, then to the left about Y."""
    pitch, yaw = np.radians(pitch_deg), np.radians(yaw_deg)
    forwards = np.array([[1, 0, 0], [0, np.cos(pitch), -np.sin(pitch)], [0, np.sin(pitch), np.cos(pitch)]])
    left = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    turned: NDArray[np.float64] = left @ forwards
    return turned


def _down(pitch_deg: float, outwards_deg: float = 0.0) -> _Vector:
    """Direction of a hanging limb that is swung forwards and towards +X."""
    pitch, out = np.radians(pitch_deg), np.radians(outwards_deg)
    return np.array([np.sin(out), -np.cos(pitch) * np.cos(out), np.sin(pitch) * np.cos(out)])


def _body(figure: Figure, pose: Pose) -> _Body:
    """Compute the joints, with the lower foot on the floor."""
    unit = figure.height_m
    legs = []
    for index, side in enumerate(_SIDES):
        hip = np.array([side * _HIP_X, 0.0, 0.0])
        knee = hip + _THIGH * _down(pose.hips[index], side * 1.0)
        ankle = knee + _SHIN * _down(pose.hips[index] - pose.knees[index])
        legs.append([hip, knee, ankle])
    low = min(
        ankle[1] + min(ring[:, 1].min() for ring in _shoe(foot, side))
        for (_, _, ankle), foot, side in zip(legs, pose.feet, _SIDES, strict=True)
    )
    hips = np.array([0.0, -low, 0.0])
    spine = _turned(pose.lean)
    shoulder_x = 0.098 if figure.is_woman else 0.109
    arms = []
    for index, side in enumerate(_SIDES):
        shoulder = spine @ np.array([side * shoulder_x, _SHOULDER_Y, -0.004])
        swing = pose.shoulders[index]
        elbow = shoulder + _UPPER_ARM * _down(swing, side * pose.spread[index])
        wrist = elbow + _FOREARM * _down(swing + pose.elbows[index], -side * pose.inwards[index])
        arms.append([shoulder, elbow, wrist])
    return _Body(
        unit,
        unit * hips,
        spine,
        _turned(pose.lean * 0.4 + pose.nod, pose.turn),
        [[unit * (hips + joint) for joint in leg] for leg in legs],
        [[unit * (hips + joint) for joint in arm] for arm in arms],
    )


def _along(joints: Sequence[_Vector], shares: Sequence[float]) -> list[_Vector]:
    """Points on a chain of two bones: 0 at its first joint, 1 at the second, 2 at the third."""
    first, second, third = joints
    return [
        first + (second - first) * share if share <= 1 else second + (third - second) * (share - 1) for share in shares
    ]


def _scaled(shares: Sequence[float], factor: float) -> list[float]:
    return [share * factor for share in shares]


def _trunk(body: _Body, figure: Figure) -> list[Face]:
    """The upper garment, from its hem to the neck."""
    hem = {Outfit.COAT: -0.17, Outfit.JACKET: -0.035, Outfit.SHIRT: -0.02, Outfit.DRESS: 0.0}[figure.outfit]
    loose = {Outfit.COAT: 1.10, Outfit.JACKET: 1.07, Outfit.SHIRT: 1.0, Outfit.DRESS: 0.98}[figure.outfit]
    if figure.is_woman:
        rows = [
            (hem, 0.104, 0.070, 0.0), (0.02, 0.100, 0.068, -0.003), (0.09, 0.076, 0.056, 0.0),
            (0.15, 0.079, 0.058, 0.003),
            (0.20, 0.088, 0.070, 0.008), (0.245, 0.092, 0.058, 0.002), (0.283, 0.092, 0.046, -0.006),
            (0.304, 0.070, 0.038, -0.008), (0.320, 0.036, 0.033, -0.007),
        ]  # fmt: skip
    else:
        rows = [
            (hem, 0.099, 0.068, 0.0), (0.02, 0.097, 0.066, 0.0), (0.09, 0.088, 0.060, 0.002),
            (0.15, 0.094, 0.063, 0.003),
            (0.20, 0.101, 0.068, 0.004), (0.245, 0.107, 0.062, 0.0), (0.283, 0.106, 0.047, -0.005),
            (0.306, 0.076, 0.040, -0.007), (0.322, 0.040, 0.036, -0.006),
        ]  # fmt: skip
    unit = body.unit_m
    points = body.trunk([(0.0, y, z) for y, _, _, z in rows])
    # the width of shoulders does not depend on the build
    widths = [unit * x * loose * (figure.build if y < 0.24 else 1 + (figure.build - 1) * 0.4) for y, x, _, _ in rows]  # noqa: PLR2004
    depths = [unit * z * loose * figure.build for _, _, z, _ in rows]
    # a stride widens the hem of a coat
    (_, left, _), (_, right, _) = body.legs
    depths[0] += abs(left[2] - right[2]) * 0.6 if figure.outfit is Outfit.COAT else 0.0
    return limb_faces(points, widths, depths, segments=18)


def _pelvis(body: _Body, figure: Figure) -> list[Face]:
    """Trousers from the crotch to the waist."""
    wide = 1.03 if figure.is_woman else 1.0
    rows = [
        (-0.055, 0.05, 0.045),
        (-0.03, 0.086, 0.060),
        (0.01, 0.094, 0.063),
        (0.06, 0.086, 0.058),
        (0.10, 0.078, 0.05),
    ]
    unit = body.unit_m * figure.build
    points = body.trunk([(0.0, y, 0.0) for y, _, _ in rows])
    return limb_faces(points, [unit * wide * x for _, x, _ in rows], [unit * z for _, _, z in rows], segments=18)


def _skirt(body: _Body, figure: Figure) -> list[Face]:
    """Skirt of a person from the waist to below the knees, around the legs."""
    unit = body.unit_m * figure.build
    (_, left, _), (_, right, _) = body.legs
    stride = abs(left[2] - right[2]) / 2
    rows = [(0.10, 0.078, 0.058), (0.05, 0.092, 0.066), (0.0, 0.105, 0.074), (-0.10, 0.112, 0.080)]
    points = body.trunk([(0.0, y, 0.0) for y, _, _ in rows])
    widths, depths = [unit * x for _, x, _ in rows], [unit * z for _, _, z in rows]
    knees = (left + right) / 2
    points += [knees - _UP * 0.02 * unit, knees - _UP * 0.07 * unit]
    widths += [unit * 0.118, unit * 0.120]
    depths += [unit * 0.086 + stride * 0.95, unit * 0.090 + stride * 1.1]
    return limb_faces(points[::-1], widths[::-1], depths[::-1], segments=18)


def _legs(body: _Body, figure: Figure, *, is_bare: bool) -> list[Face]:
    shares = [0.0, 0.12, 0.35, 0.65, 0.92, 1.02, 1.15, 1.4, 1.7, 1.97]
    widths = [0.040, 0.048, 0.046, 0.039, 0.034, 0.0335, 0.034, 0.034, 0.031, 0.030]
    depths = [0.044, 0.054, 0.052, 0.044, 0.037, 0.036, 0.037, 0.038, 0.034, 0.034]
    if is_bare:
        widths = [*widths[:4], 0.029, 0.029, 0.029, 0.030, 0.021, 0.0185]
        depths = [*depths[:4], 0.032, 0.032, 0.034, 0.036, 0.025, 0.023]
    unit = body.unit_m * (1 + (figure.build - 1) * 0.7)
    return [
        face
        for leg in body.legs
        for face in limb_faces(_along(leg, shares)[::-1], _scaled(widths, unit)[::-1], _scaled(depths, unit)[::-1])
    ]


def _arms(body: _Body, figure: Figure, start: int, end: int, thinner: float = 1.0) -> list[Face]:
    """Sleeves or bare arms between two of the ring positions: shoulder, upper arm's end, elbow, forearm, wrist, end."""
    shares = [0.0, 0.08, 0.32, 0.62, 0.95, 1.06, 1.32, 1.68, 1.96]
    radii = [0.024, 0.0290, 0.0305, 0.0275, 0.0245, 0.0245, 0.0245, 0.0215, 0.0195]
    places = [0, 2, 3, 5, 6, 8, 9]
    chosen = slice(places[start], places[end] if end < len(places) else None)
    unit = body.unit_m * thinner * (1 + (figure.build - 1) * 0.8) * (0.9 if figure.is_woman else 1.0)
    if figure.outfit in {Outfit.COAT, Outfit.JACKET}:
        unit *= 1.12
    inside = [body.spine @ np.array([-side * 0.036, 0.004, 0.0]) * body.unit_m for side in _SIDES]
    return [
        face
        for arm, off in zip(body.arms, inside, strict=True)
        for face in limb_faces(
            [arm[0] + off, *_along(arm, shares)[1:]][chosen][::-1],
            _scaled(radii[chosen], unit)[::-1],
            side=(1.0, 0.0, 0.35),
            segments=12,
        )
    ]


def _hands(body: _Body) -> list[Face]:
    """Hands of a person as mittens with thumbs, palms to the body."""
    unit = body.unit_m
    faces: list[Face] = []
    for _, elbow, wrist in body.arms:
        way = (wrist - elbow) / np.linalg.norm(wrist - elbow)
        points = [wrist + way * unit * at for at in (-0.02, 0.01, 0.03, 0.055, 0.08, _HAND)]
        widths = _scaled([0.013, 0.012, 0.010, 0.009, 0.008, 0.004], unit)
        depths = _scaled([0.016, 0.018, 0.025, 0.025, 0.021, 0.010], unit)
        faces += limb_faces(points[::-1], widths[::-1], depths[::-1])
        ahead = np.cross(np.array([1.0, 0.0, 0.0]), way)
        ahead *= np.sign(ahead[2] or 1.0) * unit
        thumb = [wrist + way * unit * at + ahead * off for at, off in ((0.018, 0.012), (0.04, 0.027), (0.058, 0.033))]
        faces += limb_faces(thumb[::-1], _scaled([0.008, 0.0075, 0.004], unit)[::-1], segments=8)
    return faces


def _shoes(body: _Body, pose: Pose) -> list[Face]:
    """Shoes of a person with flat soles, rotated about the ankles."""
    return [
        face
        for (_, _, ankle), foot, side in zip(body.legs, pose.feet, _SIDES, strict=True)
        for face in loft_faces([ankle + body.unit_m * ring for ring in _shoe(foot, side)])
    ]


def _shoe(foot_deg: float, side: float) -> list[_Vector]:
    """Rings of a shoe around its ankle, in shares of the stature, with the toes lowered by an angle."""
    rows = [
        (-0.040, 0.012, 0.030), (-0.034, 0.021, 0.046), (-0.010, 0.023, 0.052), (0.015, 0.023, 0.044),
        (0.05, 0.027, 0.030),
        (0.08, 0.029, 0.025), (0.105, 0.023, 0.020), (0.116, 0.010, 0.012),
    ]  # fmt: skip
    angles = np.arange(14) * (2 * np.pi / 14) + np.pi / 14
    turn = _turned(foot_deg, side * 9.0)
    rings = []
    for z, width, height in rows:
        x = np.sign(np.cos(angles)) * np.abs(np.cos(angles)) ** 0.7 * width
        y = np.maximum(np.sin(angles) * height, 0.0) + np.minimum(np.sin(angles), 0.0) * 0.004
        rings.append((np.stack([x, y + 0.004, np.full_like(x, z)], axis=1) - (0.0, _ANKLE, 0.0)) @ turn.T)
    return rings


_HEAD_RINGS = [
    (0.0, 0.30, 0.22, 0.42), (0.05, 0.52, 0.48, 0.28), (0.14, 0.70, 0.68, 0.16), (0.27, 0.83, 0.84, 0.06),
    (0.42, 0.92, 0.93, 0.02), (0.58, 0.98, 0.97, 0.0), (0.72, 1.0, 1.0, -0.03), (0.84, 0.92, 0.92, -0.05),
    (0.93, 0.70, 0.70, -0.06), (0.985, 0.38, 0.40, -0.06), (1.0, 0.14, 0.15, -0.06),
]  # fmt: skip
"""Rings of a head: height above the chin, half width, half depth and forward offset, as shares of its size."""


def _headed(body: _Body, points: Sequence[tuple[float, float, float]]) -> list[_Vector]:
    """Convert points of the head from shares of its half width, its height above the chin, and its half depth."""
    neck = body.trunk([(0.0, _NECK_Y, -0.006)])[0]
    of_head = np.array([_HEAD_X, _HEAD, _HEAD_Z])
    chin = np.array([0.0, _CHIN_Y - _NECK_Y, 0.012])
    return [neck + body.unit_m * (body.head @ (np.array(point) * of_head + chin)) for point in points]


def _head(body: _Body) -> list[Face]:
    """Neck of a person, and skull with chin, nose and ears."""
    unit = body.unit_m
    neck = [*body.trunk([(0.0, _NECK_Y - 0.03, -0.008), (0.0, _NECK_Y, -0.006)]), *_headed(body, [(0.0, 0.25, -0.2)])]
    faces = limb_faces(neck, _scaled([0.040, 0.0335, 0.032], unit), _scaled([0.036, 0.034, 0.034], unit))
    skull = _headed(body, [(0.0, y, z) for y, _, _, z in _HEAD_RINGS])
    side = tuple((body.head @ np.array([1.0, 0.0, 0.0])).tolist())
    widths, depths = (
        [unit * size * row[column] for row in _HEAD_RINGS] for column, size in ((1, _HEAD_X), (2, _HEAD_Z))
    )
    faces += limb_faces(skull, widths, depths, side=side, segments=16)
    nose = _headed(body, [(0.0, 0.36, 0.93), (0.0, 0.40, 1.02), (0.0, 0.56, 0.92)])
    faces += limb_faces(
        nose, _scaled([0.009, 0.0085, 0.004], unit), _scaled([0.006, 0.011, 0.005], unit), side=side, segments=8
    )
    for ear in _SIDES:
        line = _headed(body, [(ear * 0.98, 0.34, -0.08), (ear * 1.03, 0.44, -0.10), (ear * 1.02, 0.58, -0.12)])
        faces += limb_faces(
            line, _scaled([0.003, 0.005, 0.003], unit), _scaled([0.005, 0.010, 0.007], unit), side=side, segments=8
        )
    return faces


def _hair(body: _Body, figure: Figure) -> list[Face]:
    """Hair of a person over the skull from the nape to the hairline, and down the back if it is long."""
    rows = [
        (0.20, 0.62, 0.45, -0.52), (0.34, 0.88, 0.66, -0.42), (0.50, 1.04, 0.78, -0.34), (0.66, 1.09, 0.92, -0.22),
        (0.80, 1.06, 1.03, -0.07), (0.90, 0.90, 0.95, -0.05), (0.99, 0.56, 0.60, -0.07), (1.035, 0.20, 0.22, -0.07),
    ]  # fmt: skip
    if figure.has_long_hair:
        rows = [
            (-0.62, 0.55, 0.16, -1.06),
            (-0.45, 0.85, 0.26, -1.02),
            (-0.1, 0.98, 0.38, -0.84),
            (0.15, 1.04, 0.52, -0.66),
            *rows[1:],
        ]
        rows[4:7] = [(0.34, 1.08, 0.72, -0.48), (0.50, 1.10, 0.82, -0.36), (0.66, 1.12, 0.94, -0.24)]
    unit = body.unit_m
    side = tuple((body.head @ np.array([1.0, 0.0, 0.0])).tolist())
    points = _headed(body, [(0.0, y, z) for y, _, _, z in rows])
    return limb_faces(
        points,
        [unit * _HEAD_X * row[1] for row in rows],
        [unit * _HEAD_Z * row[2] for row in rows],
        side=side,
        segments=16,
    )


def _phone(body: _Body) -> list[Face]:
    """Phone of 15 cm in a person's right hand, with the screen towards the face."""
    _, elbow, wrist = body.arms[1]
    way = (wrist - elbow) / np.linalg.norm(wrist - elbow)
    place = wrist + way * body.unit_m * 0.075
    turn = _turned(-35.0)
    return [place + face @ turn.T for face in box_faces((-0.036, -0.03, 0.016), (0.036, 0.12, 0.024))]


def _bag(body: _Body) -> list[Face]:
    """Carrier bag in a person's right hand."""
    _, elbow, wrist = body.arms[1]
    way = (wrist - elbow) / np.linalg.norm(wrist - elbow)
    x, top, z = wrist + way * body.unit_m * 0.085
    sack = box_faces((x - 0.06, top - 0.48, z - 0.17), (x + 0.06, top - 0.12, z + 0.17))
    for near in (-0.025, 0.025):
        sack += limb_faces(
            [(x + near, top - 0.13, z - 0.10), (x + near * 0.3, top, z - 0.02)],
            [0.006, 0.006],
            side=(1.0, 0.0, 0.0),
            segments=6,
        )
        sack += limb_faces(
            [(x + near, top - 0.125, z + 0.10), (x + near * 0.3, top + 0.005, z + 0.02)],
            [0.006, 0.006],
            side=(1.0, 0.0, 0.0),
            segments=6,
        )
    return sack
