"""Dressed people: lofts along the limbs of a skeleton at rest, and the skin that follows its joints.

Proportions are those of Drillis and Contini (1966): lengths and widths are shares of the stature.
"""
# Over 300 lines: one function for each part of a body, together with the measures of its rings.

from collections.abc import Callable, Sequence
from enum import StrEnum
from functools import partial
from typing import NamedTuple

import numpy as np

from garage2usd.assets.faces import box_faces, limb_faces, loft_faces
from garage2usd.assets.mesh import WELD_DECIMALS, Asset, Collider, Face, Part, make_part
from garage2usd.assets.poses import Pose
from garage2usd.assets.skeletons import (
    BALL_Z,
    CHIN_Y,
    FOREARM,
    HAND,
    HIP_X,
    HIPS,
    INWARDS_DEG,
    JOINTS,
    NECK_Y,
    NECK_Z,
    SIDES,
    THIGH,
    TOES_OUT_DEG,
    Skeleton,
    Vectors,
    about,
    along,
    hanging,
    skeleton_of,
)

_CREASE_DEG = 60.0
_HEAD, _HEAD_X, _HEAD_Z = 0.128, 0.0445, 0.057
"""Height of the head, and half its width and depth."""
_Skin = Callable[[Vectors], Vectors]
"""Weights of the joints, shape (points, joints), by points in shares of the stature."""
_Piece = tuple[list[Face], _Skin]
_AT = {name: number for number, name in enumerate(JOINTS)}


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
    head
        Factor on the size of the head; the heads of children are larger than those of adults for their stature.
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
    head: float = 1.0

    @property
    def skeleton(self) -> Skeleton:
        """Joints of the person at rest."""
        return skeleton_of(self.height_m, 0.098 if self.is_woman else 0.109)

    @property
    def top_m(self) -> float:
        """Height of the top of the skull."""
        return self.height_m * (HIPS + CHIN_Y + _HEAD * self.head)


class SkinnedFigure(NamedTuple):
    """A person at rest whose skin follows joints.

    Attributes
    ----------
    skeleton
        Joints at rest, in the order of `garage2usd.assets.skeletons.JOINTS`.
    parts
        Meshes at rest: a person that faces +Z, with the feet on y = 0 below the hips.
    weights
        For each part the weights of the joints at its points; float64, shape (points, joints), rows add up to 1.
    """

    skeleton: Skeleton
    parts: tuple[Part, ...]
    weights: tuple[Vectors, ...]

    def posed_m(self, turns: Vectors, hips_m: Vectors) -> list[Vectors]:
        """Points of each part in a pose given as for `Skeleton.places_m`; shapes (points, 3)."""
        skin = zip(self.parts, self.weights, strict=True)
        return [self.skeleton.skinned_m(part.points.astype(float), own, turns, hips_m) for part, own in skin]


def skinned_figure(figure: Figure) -> SkinnedFigure:
    """Make a person at rest with a skeleton and the weights of its joints."""
    skeleton, pieces = figure.skeleton, _pieces(figure)
    parts, weights = [], []
    for name, (material, collider, covers) in pieces.items():
        part = _part(name, [face for faces, _ in covers for face in faces], material, collider)
        # welded points are found by their place
        at: dict[bytes, Vectors] = {}
        for faces, skin in covers:
            corners = np.concatenate(faces)
            places = (np.round(corners, WELD_DECIMALS) + 0.0).astype(np.float32)
            at.update(zip(map(bytes, places), skin(corners / figure.height_m), strict=True))
        parts.append(part)
        weights.append(np.array([at[bytes(point)] for point in part.points]))
    return SkinnedFigure(skeleton, tuple(parts), tuple(weights))


def figure_asset(figure: Figure, pose: Pose) -> Asset:
    """Make a person that faces +Z in a pose, with the lower foot on y = 0 below the hips."""
    skeleton, turns = figure.skeleton, pose.turns()
    pieces = _pieces(figure)

    def posed(piece: _Piece, hips_m: Vectors) -> list[Face]:
        faces, skin = piece
        corners = np.concatenate(faces)
        moved = skeleton.skinned_m(corners, skin(corners / figure.height_m), turns, hips_m)
        return np.split(moved, np.cumsum([len(face) for face in faces])[:-1])

    low = min(float(face[:, 1].min()) for piece in pieces["Shoes"][2] for face in posed(piece, np.zeros(3)))
    hips_m = np.array([0.0, -low, 0.0])
    parts = [
        _part(name, [face for piece in covers for face in posed(piece, hips_m)], material, collider)
        for name, (material, collider, covers) in pieces.items()
    ]
    places = skeleton.places_m(turns, hips_m)
    elbow, wrist = (
        places[_AT["right_forearm"]],
        skeleton.skinned_m(_wrists(skeleton)[1:], np.eye(len(JOINTS))[[_AT["right_forearm"]]], turns, hips_m)[0],
    )
    way = (wrist - elbow) / np.linalg.norm(wrist - elbow) * figure.height_m
    if pose.has_phone:
        parts.append(_part("Phone", _phone(wrist + way * 0.075), "glass"))
    if pose.has_bag:
        parts.append(_part("Bag", _bag(wrist + way * 0.085), "leather_brown"))
    return Asset(tuple(parts))


def _pieces(figure: Figure) -> dict[str, tuple[str, Collider | None, list[_Piece]]]:
    """Faces at rest and their skin by the name of the part, with its material and collider."""
    body = _Body(figure, figure.skeleton)
    is_dress, is_shirt = figure.outfit is Outfit.DRESS, figure.outfit is Outfit.SHIRT
    legs = _legs(body, is_bare=is_dress)
    bare_arms = _arms(body, 2, 6, thinner=0.82) if is_shirt else []
    hull = Collider.CONVEX_HULL
    pieces: dict[str, tuple[str, Collider | None, list[_Piece]]] = {
        "Top": (figure.top, hull, [_trunk(body), *_arms(body, 0, 3 if is_shirt else 6)]),
        "Bottom": (figure.bottom, hull, [_skirt(body)] if is_dress else [_pelvis(body), *legs]),
        "Shoes": (figure.shoes, hull, _shoes(body)),
        "Head": (figure.skin, hull, [(_head(body), _neck_skin)]),
        "Skin": (figure.skin, None, [*_hands(body), *bare_arms, *(legs if is_dress else [])]),
        "Hair": (figure.hair, None, [(_hair(body), _rigid("head"))]),
    }
    # a pose bends the ends of lofts, which are polygons
    return {
        name: (material, collider, [(_triangles(faces), skin) for faces, skin in covers])
        for name, (material, collider, covers) in pieces.items()
    }


def _triangles(faces: list[Face]) -> list[Face]:
    return [face[[0, corner, corner + 1]] for face in faces for corner in range(1, len(face) - 1)]


class _Body(NamedTuple):
    """A figure and its skeleton at rest."""

    figure: Figure
    skeleton: Skeleton

    @property
    def unit_m(self) -> float:
        """Stature, in which measures are given."""
        return self.figure.height_m

    def trunk(self, points: Sequence[tuple[float, float, float]]) -> list[Vectors]:
        """Convert points in shares of the stature, relative to the hips' centre."""
        return list(self.unit_m * (np.array(points) + np.array((0.0, HIPS, 0.0))))

    def arms(self) -> list[list[Vectors]]:
        """Shoulder, elbow and wrist on both sides."""
        wrists, rest = _wrists(self.skeleton), self.skeleton.rest_m
        return [[rest[first], rest[first + 1], wrist] for first, wrist in zip((3, 5), wrists, strict=True)]

    def legs(self) -> list[list[Vectors]]:
        """Hip, knee and ankle on both sides."""
        return [list(self.skeleton.rest_m[first : first + 3]) for first in (7, 11)]


def _wrists(skeleton: Skeleton) -> Vectors:
    way = np.array([hanging(0.0, -side * INWARDS_DEG) for side in SIDES])
    return skeleton.rest_m[[4, 6]] + skeleton.height_m * FOREARM * way


def _part(name: str, faces: list[Face], material: str, collider: Collider | None = None) -> Part:
    return make_part(name, faces, material, collider=collider, crease_deg=_CREASE_DEG)


def _ramp(values: Vectors, start: float, end: float) -> Vectors:
    """Smooth step from 0 at `start` to 1 at `end`."""
    share = np.clip((values - start) / (end - start), 0.0, 1.0)
    return share * share * (3 - 2 * share)


def _weights(points: Vectors, **shares: Vectors | float) -> Vectors:
    """Weights of named joints as an array of all joints."""
    weights = np.zeros((len(points), len(JOINTS)))
    for name, share in shares.items():
        weights[:, _AT[name]] = share
    return weights


def _rigid(joint: str) -> _Skin:
    """Skin that follows one joint."""
    return lambda points: _weights(points, **{joint: 1.0})


def _lower_skin(points: Vectors, *, side: float = 0.0, knee: float = 1.0) -> Vectors:
    """Skin from the waist down, one field for all clothes and legs, so that none passes through another.

    Parameters
    ----------
    points
        Points in shares of the stature.
    side
        Leg that alone moves its own points below the crotch; 0 for what both legs move.
    knee
        Share of the shins in the motion below the knees.
    """
    x, y, _ = points.T
    spine, thighs = _ramp(y, HIPS + 0.02, HIPS + 0.12), 1 - _ramp(y, HIPS - 0.09, HIPS + 0.03)
    left = _ramp(x, -0.03, 0.03)
    if side:
        left += ((side > 0) - left) * (1 - _ramp(y, HIPS - 0.10, HIPS - 0.05))
    shins = knee * (1 - _ramp(y, HIPS - THIGH - 0.04, HIPS - THIGH + 0.04))
    weights = _weights(points, hips=(1 - spine) * (1 - thighs), spine=spine * (1 - thighs))
    for name, own in (("left", left), ("right", 1 - left)):
        weights[:, _AT[f"{name}_thigh"]] = thighs * own * (1 - shins)
        weights[:, _AT[f"{name}_shin"]] = thighs * own * shins
    return weights


def _neck_skin(points: Vectors) -> Vectors:
    share = _ramp(points[:, 1], HIPS + NECK_Y - 0.03, HIPS + NECK_Y + 0.01)
    return _weights(points, head=share, spine=1 - share)


def _arm_skin(index: int, shoulder: Vectors, elbow: Vectors, wrist: Vectors) -> _Skin:
    """Skin of an arm between joints in shares of the stature."""
    upper, forearm = (f"{('left', 'right')[index]}_{bone}" for bone in ("upper_arm", "forearm"))
    middle = (elbow - shoulder) / np.linalg.norm(elbow - shoulder) + (wrist - elbow) / np.linalg.norm(wrist - elbow)

    def skin(points: Vectors) -> Vectors:
        bent = _ramp((points - elbow) @ middle / 2, -0.022, 0.022)
        arm = _ramp((points - shoulder) @ (elbow - shoulder), -0.0005, 0.008)
        return _weights(points, spine=(1 - arm) * (1 - bent), **{upper: arm * (1 - bent), forearm: bent})

    return skin


_ShapeRow = tuple[float, float, float, float]
"""Ring of a trunk: height above the hips, half width, half depth and forward offset."""


def _trunk_rows(figure: Figure) -> list[_ShapeRow]:
    """Rings of the upper garment, from its hem to the neck."""
    hem = {Outfit.COAT: -0.17, Outfit.JACKET: -0.045, Outfit.SHIRT: -0.03, Outfit.DRESS: 0.02}[figure.outfit]
    loose = {Outfit.COAT: 1.10, Outfit.JACKET: 1.08, Outfit.SHIRT: 1.04, Outfit.DRESS: 0.98}[figure.outfit]
    if figure.is_woman:
        rows = [
            (hem, 0.105, 0.074, 0.0), (0.02, 0.100, 0.070, -0.003), (0.09, 0.079, 0.058, 0.0),
            (0.15, 0.080, 0.059, 0.003),
            (0.20, 0.088, 0.070, 0.008), (0.245, 0.092, 0.058, 0.002), (0.283, 0.092, 0.046, -0.006),
            (0.304, 0.070, 0.038, -0.008), (0.320, 0.036, 0.033, -0.007),
        ]  # fmt: skip
    else:
        rows = [
            (hem, 0.101, 0.073, 0.0), (0.02, 0.098, 0.068, 0.0), (0.09, 0.090, 0.061, 0.002),
            (0.15, 0.094, 0.063, 0.003),
            (0.20, 0.101, 0.068, 0.004), (0.245, 0.107, 0.062, 0.0), (0.283, 0.106, 0.047, -0.005),
            (0.306, 0.076, 0.040, -0.007), (0.322, 0.040, 0.036, -0.006),
        ]  # fmt: skip
    if figure.outfit is Outfit.COAT:
        rows[1:1] = [(-0.11, 0.103, 0.076, 0.0), (-0.05, 0.103, 0.074, 0.0)]
    # the width of shoulders does not depend on the build
    wide = [loose * (figure.build if y < 0.24 else 1 + (figure.build - 1) * 0.4) for y, _, _, _ in rows]  # noqa: PLR2004
    return [(y, x * share, z * loose * figure.build, ahead) for (y, x, z, ahead), share in zip(rows, wide, strict=True)]


def _trunk(body: _Body) -> _Piece:
    return _tube(body, _trunk_rows(body.figure)), _lower_skin


def _tube(body: _Body, rows: Sequence[_ShapeRow]) -> list[Face]:
    """A closed solid through level rings, lowest first."""
    points = body.trunk([(0.0, y, ahead) for y, _, _, ahead in rows])
    widths, depths = ([body.unit_m * row[column] for row in rows] for column in (1, 2))
    return limb_faces(points, widths, depths, segments=18)


def _pelvis(body: _Body) -> _Piece:
    """Trousers from the crotch to the waist, inside of the upper garment."""
    figure = body.figure
    wide = figure.build * (1.03 if figure.is_woman else 1.0)
    hem, top = np.array(_trunk_rows(figure))[:, :3], list[_ShapeRow]()
    rows = [
        (-0.060, 0.030, 0.026), (-0.035, 0.080, 0.054), (-0.01, 0.093, 0.063), (0.02, 0.094, 0.063),
        (0.06, 0.080, 0.055),
    ]  # fmt: skip
    for y, x, z in rows:
        most = [float(np.interp(y, hem[:, 0], hem[:, column])) * 0.94 for column in (1, 2)]
        top.append((y, min(x * wide, most[0]) if y > hem[0, 0] else x * wide, min(z * figure.build, most[1]), 0.0))
    return _tube(body, top), _lower_skin


def _skirt(body: _Body) -> _Piece:
    """Skirt from the waist to below the knees."""
    rows = [
        (-0.315, 0.122, 0.098), (-0.27, 0.119, 0.095), (-0.22, 0.117, 0.091), (-0.16, 0.114, 0.086),
        (-0.10, 0.112, 0.082), (-0.05, 0.109, 0.078), (0.0, 0.105, 0.074), (0.05, 0.092, 0.066), (0.10, 0.080, 0.060),
    ]  # fmt: skip
    build = body.figure.build
    return _tube(body, [(y, x * build, z * build, 0.0) for y, x, z in rows]), partial(_lower_skin, knee=0.3)


def _legs(body: _Body, *, is_bare: bool) -> list[_Piece]:
    shares = [0.0, 0.12, 0.35, 0.65, 0.85, 0.93, 1.0, 1.07, 1.15, 1.4, 1.7, 1.97]
    widths = [0.040, 0.0477, 0.046, 0.039, 0.035, 0.034, 0.0335, 0.0335, 0.034, 0.034, 0.031, 0.030]
    depths = [0.044, 0.050, 0.050, 0.044, 0.039, 0.037, 0.036, 0.036, 0.037, 0.038, 0.034, 0.034]
    if is_bare:
        widths = [*widths[:4], 0.030, 0.029, 0.029, 0.029, 0.029, 0.030, 0.021, 0.0185]
        depths = [*depths[:4], 0.034, 0.032, 0.032, 0.032, 0.034, 0.036, 0.025, 0.023]
    thick = body.unit_m * (1 + (body.figure.build - 1) * 0.7)
    return [
        (
            limb_faces(along(leg, shares)[::-1], _scaled(widths, thick)[::-1], _scaled(depths, thick)[::-1]),
            partial(_lower_skin, side=side),
        )
        for leg, side in zip(body.legs(), SIDES, strict=True)
    ]


def _scaled(shares: Sequence[float], factor: float) -> list[float]:
    return [share * factor for share in shares]


def _arms(body: _Body, start: int, end: int, thinner: float = 1.0) -> list[_Piece]:
    """Sleeves or bare arms between two of the ring positions: shoulder, upper arm's end, elbow, forearm, wrist, end."""
    shares = [0.0, 0.08, 0.32, 0.62, 0.86, 0.95, 1.03, 1.14, 1.32, 1.68, 1.96]
    radii = [0.024, 0.0290, 0.0305, 0.0275, 0.0252, 0.0245, 0.0245, 0.0245, 0.0245, 0.0215, 0.0195]
    places = [0, 2, 3, 5, 8, 10, 11]
    chosen = slice(places[start], places[end] if end < len(places) else None)
    figure = body.figure
    thick = body.unit_m * thinner * (1 + (figure.build - 1) * 0.8) * (0.9 if figure.is_woman else 1.0)
    if figure.outfit in {Outfit.COAT, Outfit.JACKET}:
        thick *= 1.12
    return [
        (
            limb_faces(
                [arm[0] + body.unit_m * np.array((-side * 0.036, 0.004, 0.0)), *along(arm, shares)[1:]][chosen][::-1],
                _scaled(radii[chosen], thick)[::-1],
                side=(1.0, 0.0, 0.35),
                segments=12,
            ),
            _arm_skin(index, *(np.array(arm) / body.unit_m)),
        )
        for index, (arm, side) in enumerate(zip(body.arms(), SIDES, strict=True))
    ]


def _shoe_skin(points: Vectors, *, name: str, ankle: Vectors, ahead: Vectors) -> Vectors:
    toes = _ramp((points - ankle) @ ahead, BALL_Z - 0.012, BALL_Z + 0.012)
    return _weights(points, **{f"{name}_toes": toes, f"{name}_foot": 1 - toes})


def _hands(body: _Body) -> list[_Piece]:
    """Hands of a person as mittens with thumbs, palms to the body."""
    unit, pieces = body.unit_m, list[_Piece]()
    for name, (_, elbow, wrist) in zip(("left", "right"), body.arms(), strict=True):
        way = (wrist - elbow) / np.linalg.norm(wrist - elbow)
        points = [wrist + way * unit * at for at in (-0.02, 0.01, 0.03, 0.055, 0.08, HAND)]
        widths = _scaled([0.013, 0.012, 0.010, 0.009, 0.008, 0.004], unit)
        depths = _scaled([0.016, 0.018, 0.025, 0.025, 0.021, 0.010], unit)
        ahead = np.array((0.0, 0.0, unit))
        thumb = [wrist + way * unit * at + ahead * off for at, off in ((0.018, 0.012), (0.04, 0.027), (0.058, 0.033))]
        faces = limb_faces(points[::-1], widths[::-1], depths[::-1])
        faces += limb_faces(thumb[::-1], _scaled([0.008, 0.0075, 0.004], unit)[::-1], segments=8)
        pieces.append((faces, _rigid(f"{name}_forearm")))
    return pieces


def _shoes(body: _Body) -> list[_Piece]:
    """Shoes with flat soles, which bend at the balls of the feet."""
    rows = [
        (-0.040, 0.012, 0.030), (-0.034, 0.021, 0.046), (-0.010, 0.023, 0.052), (0.015, 0.023, 0.044),
        (0.05, 0.027, 0.030), (0.065, 0.0285, 0.0275), (0.08, 0.029, 0.025),
        (0.105, 0.023, 0.020), (0.116, 0.010, 0.012),
    ]  # fmt: skip
    angles = np.arange(14) * (2 * np.pi / 14) + np.pi / 14
    pieces = list[_Piece]()
    for name, side in zip(("left", "right"), SIDES, strict=True):
        out, rings = about(1, side * TOES_OUT_DEG), []
        for z, width, height in rows:
            x = np.sign(np.cos(angles)) * np.abs(np.cos(angles)) ** 0.7 * width
            y = np.maximum(np.sin(angles) * height, 0.0) + np.minimum(np.sin(angles), 0.0) * 0.004
            ring = np.stack([x, y - y.min(), np.full_like(x, z)], axis=1) @ out.T
            rings.append(body.unit_m * (ring + np.array((side * HIP_X, 0.0, 0.0))))

        ankle = np.array((side * HIP_X, 0.0, 0.0))
        pieces.append((loft_faces(rings), partial(_shoe_skin, name=name, ankle=ankle, ahead=out[:, 2])))
    return pieces


_HEAD_RINGS = [
    (0.0, 0.30, 0.22, 0.42), (0.05, 0.52, 0.48, 0.28), (0.14, 0.70, 0.68, 0.16), (0.27, 0.83, 0.84, 0.06),
    (0.42, 0.92, 0.93, 0.02), (0.58, 0.98, 0.97, 0.0), (0.72, 1.0, 1.0, -0.03), (0.84, 0.92, 0.92, -0.05),
    (0.93, 0.70, 0.70, -0.06), (0.985, 0.38, 0.40, -0.06), (1.0, 0.14, 0.15, -0.06),
]  # fmt: skip
"""Rings of a head: height above the chin, half width, half depth and forward offset, as shares of its size."""


def _headed(body: _Body, points: Sequence[tuple[float, float, float]]) -> list[Vectors]:
    """Convert points of the head from shares of its half width, its height above the chin, and its half depth."""
    neck = body.trunk([(0.0, NECK_Y, NECK_Z)])[0]
    of_head = body.figure.head * np.array([_HEAD_X, _HEAD, _HEAD_Z])
    chin = np.array([0.0, CHIN_Y - NECK_Y, 0.012])
    return [neck + body.unit_m * (np.array(point) * of_head + chin) for point in points]


def _head(body: _Body) -> list[Face]:
    """Neck of a person, and skull with chin, nose and ears."""
    unit, large = body.unit_m, body.unit_m * body.figure.head
    neck = [
        *body.trunk([(0.0, NECK_Y - 0.03, NECK_Z - 0.002), (0.0, NECK_Y, NECK_Z)]),
        *_headed(body, [(0.0, 0.25, -0.2)]),
    ]
    faces = limb_faces(neck, _scaled([0.040, 0.0335, 0.032], unit), _scaled([0.036, 0.034, 0.034], unit))
    skull = _headed(body, [(0.0, y, z) for y, _, _, z in _HEAD_RINGS])
    widths, depths = (
        [large * size * row[column] for row in _HEAD_RINGS] for column, size in ((1, _HEAD_X), (2, _HEAD_Z))
    )
    faces += limb_faces(skull, widths, depths, segments=16)
    nose = _headed(body, [(0.0, 0.36, 0.93), (0.0, 0.40, 1.02), (0.0, 0.56, 0.92)])
    faces += limb_faces(nose, _scaled([0.009, 0.0085, 0.004], large), _scaled([0.006, 0.011, 0.005], large), segments=8)
    for ear in SIDES:
        line = _headed(body, [(ear * 0.98, 0.34, -0.08), (ear * 1.03, 0.44, -0.10), (ear * 1.02, 0.58, -0.12)])
        faces += limb_faces(
            line, _scaled([0.003, 0.005, 0.003], large), _scaled([0.005, 0.010, 0.007], large), segments=8
        )
    return faces


def _hair(body: _Body) -> list[Face]:
    """Hair of a person over the skull from the nape to the hairline, and down the back if it is long."""
    rows = [
        (0.20, 0.62, 0.45, -0.52), (0.34, 0.88, 0.66, -0.42), (0.50, 1.04, 0.78, -0.34), (0.66, 1.09, 0.92, -0.22),
        (0.80, 1.06, 1.03, -0.07), (0.90, 0.90, 0.95, -0.05), (0.99, 0.56, 0.60, -0.07), (1.035, 0.20, 0.22, -0.07),
    ]  # fmt: skip
    if body.figure.has_long_hair:
        rows = [
            (-0.62, 0.55, 0.16, -1.06),
            (-0.45, 0.85, 0.26, -1.02),
            (-0.1, 0.98, 0.38, -0.84),
            (0.15, 1.04, 0.52, -0.66),
            *rows[1:],
        ]
        rows[4:7] = [(0.34, 1.08, 0.72, -0.48), (0.50, 1.10, 0.82, -0.36), (0.66, 1.12, 0.94, -0.24)]
    large = body.unit_m * body.figure.head
    points = _headed(body, [(0.0, y, z) for y, _, _, z in rows])
    return limb_faces(
        points,
        [large * _HEAD_X * row[1] for row in rows],
        [large * _HEAD_Z * row[2] for row in rows],
        segments=16,
    )


def _phone(place: Vectors) -> list[Face]:
    """Phone of 15 cm in a person's right hand, with the screen towards the face."""
    turn = about(0, -35.0)
    return [place + face @ turn.T for face in box_faces((-0.036, -0.03, 0.016), (0.036, 0.12, 0.024))]


def _bag(place: Vectors) -> list[Face]:
    """Carrier bag in a person's right hand."""
    x, top, z = place
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
