"""Wheels of cars: tyres, and rims in several designs; front wheels may be steered."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from garage2usd.assets.car_patches import Faces
from garage2usd.assets.car_shapes import Rim
from garage2usd.assets.faces import lathe_faces
from garage2usd.assets.mesh import WELD_DECIMALS, Asset, Collider, Part, Pose, make_part
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import CarBody

_TYRE_WIDTH_M = 0.21
_INSIDE_M = 0.012
"""Distance of the wheels' outer sides from the side of the body."""
_HALF_M = _TYRE_WIDTH_M / 2
_FACE_M, _BACK_M = _HALF_M - 0.012, _HALF_M - 0.045
"""Offsets across the wheel from its centre: faces of the spokes, and their rear edges."""
_ORIGIN = Pose(0.0, 0.0, 0.0)
MOST_STEER_DEG = 20.0
"""Greatest steering angle at which the front wheels stay within the width of the mirrors."""


def wheels(body: CarBody, design: Rim) -> list[Part]:
    """Four wheels on the floor: tyre, and a dished rim of a design; those on the left are turned by half a turn."""
    radius, half = body.wheel_radius_m, _HALF_M
    rim = radius * 0.69
    tread = [(-half, radius), (half - 0.03, radius), (half, radius - 0.03), (half, rim)]
    tyre = lathe_faces([(-half, 0.0), *tread, (half - 0.10, rim - 0.02), (half - 0.10, 0.0)], segments=26)
    lip = lathe_faces(
        [(half - 0.05, rim - 0.03), (half - 0.002, rim - 0.008), (half + 0.001, rim + 0.004)], segments=24
    )
    metal = make_part("Rim", np.concatenate([lip, *_DESIGNS[design](rim)]), "rim", crease_deg=38)
    rubber = make_part("Tyre", tyre, "tyre", collider=Collider.CONVEX_HULL, crease_deg=38)
    x_m = round(body.width_m / 2 - half - _INSIDE_M, WELD_DECIMALS)
    places = [
        (f"{end}{side}", Pose(sign * x_m, radius, round(z_m, WELD_DECIMALS), 0.0 if sign > 0 else 180.0))
        for end, z_m in zip(("Front", "Rear"), _axles_m(body), strict=True)
        for side, sign in (("Right", 1.0), ("Left", -1.0))
    ]
    return [
        _turned(replace(part, name=f"{name}{part.name}"), pose) for part in (metal, rubber) for name, pose in places
    ]


def steered(asset: Asset, body: CarBody, steer_deg: float) -> Asset:
    """Steer the front wheels of a car to the left.

    Raises
    ------
    ConfigError
        If the absolute angle exceeds `MOST_STEER_DEG`.
    """
    if not steer_deg:
        return asset
    if not abs(steer_deg) <= MOST_STEER_DEG:
        raise ConfigError("steer_deg", steer_deg, f"-{MOST_STEER_DEG:g} to {MOST_STEER_DEG:g} degrees")
    middle_m = sum(_axles_m(body)) / 2
    return replace(
        asset,
        parts=tuple(
            _turned(part, Pose(*part.pose[:3], steer_deg), part.pose)
            if part.pose is not None and part.pose.z_m < middle_m
            else part
            for part in asset.parts
        ),
    )


def steered_box(body: CarBody, steer_deg: float) -> tuple[float, float, float]:
    """Footprint of steered front wheels in metres: greatest X on either side, first and last Z."""
    angle = np.radians(abs(steer_deg))
    radius, (front, _) = body.wheel_radius_m, _axles_m(body)
    x_m = body.width_m / 2 - _HALF_M - _INSIDE_M + radius * np.sin(angle) + _HALF_M * np.cos(angle)
    along = radius * np.cos(angle) + _HALF_M * np.sin(angle)
    return float(x_m), float(front - along), float(front + along)


def _turned(part: Part, pose: Pose, before: Pose = _ORIGIN) -> Part:
    """Move a part from the pose `before` to another pose, turned by the yaw of that pose."""
    return replace(
        part,
        points=pose.placed(part.points.astype(np.float64) - before[:3]).astype(np.float32),
        normals=(part.normals @ pose.turn + 0.0).astype(np.float32),
        pose=pose._replace(yaw_deg=before.yaw_deg + pose.yaw_deg),
    )


def _axles_m(body: CarBody) -> tuple[float, float]:
    front = -body.length_m / 2 + body.front_overhang_m
    return front, front + body.wheelbase_m


def _around(faces: Faces, angle: float) -> Faces:
    cos, sin = np.cos(angle), np.sin(angle)
    turned: Faces = faces @ np.array([(1, 0, 0), (0, cos, sin), (0, -sin, cos)])
    return turned


def _spoke(
    near: float, far: float, near_half: float, far_half: float, *, skew: float = 0.0, back_m: float = _BACK_M
) -> Faces:
    """A wedge between two radii: its face, and two sides to a rear edge; the outer end is shifted by a skew."""
    left, right = ([(_FACE_M, far, skew + sign * far_half), (_FACE_M, near, sign * near_half)] for sign in (-1.0, 1.0))
    edge = [(back_m, far, skew), (back_m, near, 0.0)]
    return np.array([[*a, *b[::-1]] for a, b in ((right, left), (left, edge), (edge, right))])


def _sector(near: float, far: float, half_angle: float, *, steps: int, face_m: float = _FACE_M) -> Faces:
    """An annular sector between two radii around +Y, seen from outside."""
    angles = np.linspace(-half_angle, half_angle, steps + 1)
    grid = np.array([[(face_m, r * np.cos(a), r * np.sin(a)) for r in (far, near)] for a in angles])
    return np.stack([grid[:-1, 0], grid[1:, 0], grid[1:, 1], grid[:-1, 1]], axis=1)


def _hub(radius_m: float = 0.066, *, out_m: float = 0.0) -> Faces:
    """Hub cap of a wheel."""
    half = _HALF_M + out_m
    profile = [(half - 0.08, radius_m * 1.14), (half - 0.016, radius_m), (half - 0.004, radius_m * 0.6)]
    return np.array(lathe_faces([*profile, (half - 0.004, 0.0)], segments=12))


def _ring(faces: Faces, count: int, first: float = 0.0) -> list[Faces]:
    return [_around(faces, first + 2 * np.pi * number / count) for number in range(count)]


def _twin_spoke(rim: float) -> list[Faces]:
    spoke = _spoke(0.04, rim - 0.012, 0.02, 0.02)
    return [_hub(), *_ring(spoke, 5, 0.09), *_ring(spoke, 5, -0.09)]


def _five_spoke(rim: float) -> list[Faces]:
    return [_hub(0.075), *_ring(_spoke(0.05, rim - 0.01, 0.052, 0.034), 5)]


def _multi_spoke(rim: float) -> list[Faces]:
    return [_hub(0.06), *_ring(_spoke(0.045, rim - 0.012, 0.010, 0.012), 16)]


def _y_spoke(rim: float) -> list[Faces]:
    fork = rim * 0.58
    stem = _spoke(0.05, fork, 0.034, 0.030)
    arms = [
        _around(_spoke(fork - 0.01, rim - 0.01, 0.020, 0.015, skew=sign * 0.035), sign * 0.08) for sign in (-1.0, 1.0)
    ]
    return [_hub(), *_ring(np.concatenate([stem, *arms]), 5)]


def _turbine(rim: float) -> list[Faces]:
    return [_hub(0.07), *_ring(_spoke(0.05, rim - 0.01, 0.016, 0.028, skew=0.055), 9)]


def _cover(rim: float) -> list[Faces]:
    """Plastic cover of a steel wheel: a disc with a ring of slots."""
    inner = np.array(
        lathe_faces([(_FACE_M - 0.001, rim * 0.67), (_FACE_M + 0.008, rim * 0.3), (_FACE_M + 0.008, 0.0)], segments=20)
    )
    return [inner, *_ring(_sector(rim * 0.66, rim - 0.006, 0.26, steps=2), 9)]


def _aero(rim: float) -> list[Faces]:
    """Aerodynamic rim: a closed disc with five narrow slots."""
    inner = np.array(lathe_faces([(_FACE_M - 0.001, rim * 0.43), (_FACE_M + 0.006, 0.0)], segments=20))
    return [inner, *_ring(_sector(rim * 0.42, rim - 0.006, 0.52, steps=4), 5)]


def _steel(rim: float) -> list[Faces]:
    """Steel rim: a ring of holes around a deep bowl and a small cap."""
    deep = _FACE_M - 0.03
    bowl = np.array(
        lathe_faces([(deep - 0.001, rim * 0.63), (deep - 0.012, rim * 0.4), (deep + 0.012, 0.075)], segments=20)
    )
    plates = _ring(_sector(rim * 0.62, rim - 0.006, 0.24, steps=2, face_m=deep), 10)
    return [bowl, _hub(0.062, out_m=-0.012), *plates]


_DESIGNS: dict[Rim, Callable[[float], list[Faces]]] = {
    Rim.TWIN_SPOKE: _twin_spoke,
    Rim.FIVE_SPOKE: _five_spoke,
    Rim.MULTI_SPOKE: _multi_spoke,
    Rim.Y_SPOKE: _y_spoke,
    Rim.TURBINE: _turbine,
    Rim.COVER: _cover,
    Rim.AERO: _aero,
    Rim.STEEL: _steel,
}
