"""Lights, ducts, speed bumps, wheel stops and signs."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, RectLight, box_faces, lathe_faces, make_part, ring_faces

__all__ = ["charger", "cone", "duct", "no_parking_sign", "speed_bump", "tube_light", "wheel_stop"]

SPEED_BUMP_WIDTH_M, SPEED_BUMP_HEIGHT_M = 0.35, 0.05
WHEEL_STOP_WIDTH_M, WHEEL_STOP_HEIGHT_M = 0.15, 0.10
_HOUSING_HEIGHT_M = 0.06
_TUBE_RADIUS_M = 0.016
_FLANGE_PITCH_M = 1.35
_FLANGE_M = 0.025
_SEGMENT_M = 0.5
_CONE_BANDS_M = (0.03, 0.28, 0.4, 0.5, 0.6, 0.75)
"""Heights where a cone's colours change, orange first."""


def tube_light(length_m: float, width_m: float, *, drop_m: float, luminance_nit: float) -> Asset:
    """A batten with two bare tubes, long along X, that shine from `drop_m` below; origin in the middle of its top."""
    x, z = length_m / 2, width_m / 2
    housing = box_faces((-x, -_HOUSING_HEIGHT_M, -z), (x, 0, z))
    ends: list[Face] = []
    for end in (-x, x - 0.03):
        ends += box_faces((end, -_HOUSING_HEIGHT_M - 0.045, -z), (end + 0.03, -_HOUSING_HEIGHT_M, z))
    tubes: list[Face] = []
    for side in (-z / 2, z / 2):
        ring = lathe_faces([(-x + 0.03, _TUBE_RADIUS_M), (x - 0.03, _TUBE_RADIUS_M)], segments=10)
        tubes += [face + np.array((0.0, -_HOUSING_HEIGHT_M - 0.024, side)) for face in ring]
    light = RectLight(length_m, width_m, -drop_m, luminance_nit)
    return Asset(
        "light",
        (
            make_part("Housing", housing, "housing_white", collider=Collider.BOX),
            make_part("Ends", ends, "housing_white"),
            make_part("Tubes", tubes, "tube_glow"),
        ),
        light,
    )


def duct(length_m: float, width_m: float, height_m: float, *, hanger_m: float, hangers_at_m: Sequence[float]) -> Asset:
    """A rectangular duct with flanges, hangers and an outlet, long along Z; origin in the middle of its top.

    Parameters
    ----------
    length_m, width_m, height_m
        Its measures.
    hanger_m
        Length of the hangers from its top to the ceiling.
    hangers_at_m
        Places of the hangers along Z.
    """
    x, z = width_m / 2, length_m / 2
    body = box_faces((-x, -height_m, -z), (x, 0, z))
    count = max(1, round(length_m / _FLANGE_PITCH_M))
    flanges: list[Face] = []
    hangers: list[Face] = []
    for index in range(count):
        middle = -z + (index + 0.5) * length_m / count
        f = _FLANGE_M
        flanges += ring_faces((-x, -height_m, middle - 0.02), (x, 0, middle + 0.02), f)
    for at in hangers_at_m:
        bar_low, bar_high = -height_m - _FLANGE_M - 0.05, -height_m - _FLANGE_M - 0.02
        hangers += box_faces((-x - 0.09, bar_low, at - 0.02), (x + 0.09, bar_high, at + 0.02))
        for side in (-x - 0.05, x + 0.03):
            hangers += box_faces((side, bar_high, at - 0.01), (side + 0.02, hanger_m, at + 0.01))
    parts = [
        make_part("Body", body, "steel_galvanised", collider=Collider.BOX),
        make_part("Flanges", flanges, "steel_galvanised"),
        make_part("Hangers", hangers, "steel_dark"),
    ]
    if length_m > 3:  # noqa: PLR2004 - a short branch has no outlet
        grille: list[Face] = []
        for slat in range(5):
            low = -height_m + 0.07 + slat * 0.042
            grille += box_faces((x, low, -0.3), (x + 0.012, low + 0.024, 0.3))
            grille += box_faces((-x - 0.012, low, -0.3), (-x, low + 0.024, 0.3))
        parts.append(make_part("Outlets", grille, "steel_dark"))
    return Asset("duct", tuple(parts))


def speed_bump(length_m: float) -> Asset:
    """A rubber bump 0.35 m wide and 0.05 m high of black and yellow segments, long along X."""
    count = max(2, round(length_m / _SEGMENT_M))
    step = length_m / count
    angles = np.linspace(0.0, np.pi, 9)
    profile = [
        (float(-SPEED_BUMP_WIDTH_M / 2 * np.cos(angle)), float(SPEED_BUMP_HEIGHT_M * np.sin(angle))) for angle in angles
    ]
    profile[0], profile[-1] = (-SPEED_BUMP_WIDTH_M / 2, 0.0), (SPEED_BUMP_WIDTH_M / 2, 0.0)
    return _striped("speed_bump", profile, -length_m / 2, step, count)


def wheel_stop(length_m: float) -> Asset:
    """A rubber wheel stop 0.15 m wide and 0.10 m high of black and yellow segments, long along X."""
    z, y = WHEEL_STOP_WIDTH_M / 2, WHEEL_STOP_HEIGHT_M
    profile = [(-z, 0.0), (-z, 0.03), (-z * 0.62, y - 0.01), (-z * 0.45, y), (z * 0.45, y), (z * 0.62, y - 0.01)]
    profile += [(z, 0.03), (z, 0.0)]
    count = max(3, round(length_m / 0.33))
    return _striped("wheel_stop", profile, -length_m / 2, length_m / count, count)


def _striped(label: str, profile: list[tuple[float, float]], start: float, step: float, count: int) -> Asset:
    """An extrusion along X of a profile (z, y) from its -Z foot over the top, in segments of two colours."""
    black: list[Face] = []
    yellow: list[Face] = []
    for index in range(count):
        low, high = start + index * step, start + (index + 1) * step
        faces = yellow if index % 2 else black
        for (z0, y0), (z1, y1) in zip(profile, [*profile[1:], profile[0]], strict=True):
            faces.append(np.array([(low, y0, z0), (low, y1, z1), (high, y1, z1), (high, y0, z0)]))
        faces.append(np.array([(low, y, z) for z, y in reversed(profile)]))
        faces.append(np.array([(high, y, z) for z, y in profile]))
    parts = [
        make_part("Black", black, "rubber_black", collider=Collider.CONVEX_HULL),
        make_part("Yellow", yellow, "rubber_yellow", collider=Collider.CONVEX_HULL),
    ]
    return Asset(label, tuple(parts))


def charger() -> Asset:
    """A slim charging post with a lit screen, a socket and a cable, looking to +Z; origin in the middle of its foot."""
    front = 0.045
    body = box_faces((-0.16, 0.0, -0.045), (0.16, 1.45, front))
    band = box_faces((-0.16, 1.25, front), (0.16, 1.38, front + 0.003), without="n")
    screen = box_faces((-0.09, 1.02, front), (0.09, 1.18, front + 0.003), without="n")
    socket = box_faces((-0.06, 0.82, front), (0.06, 0.94, front + 0.02), without="n")
    cable: list[Face] = []
    for left, low, right, high in ((-0.11, 0.35, -0.09, 0.88), (0.09, 0.35, 0.11, 0.88), (-0.085, 0.35, 0.085, 0.37)):
        cable += box_faces((left, low, front), (right, high, front + 0.018))
    return Asset(
        "charger",
        (
            make_part("Body", body, "housing_white", collider=Collider.BOX),
            make_part("Band", band, "sign_green"),
            make_part("Screen", screen, "screen_glow"),
            make_part("Socket", socket, "rubber_black"),
            make_part("Cable", cable, "rubber_black"),
        ),
    )


def cone() -> Asset:
    """An orange traffic cone 0.75 m high with two reflective bands on a rubber foot; origin in the foot's middle."""
    foot = box_faces((-0.19, 0.0, -0.19), (0.19, 0.03, 0.19))
    orange: list[Face] = []
    white: list[Face] = []
    for index, (low, high) in enumerate(pairwise(_CONE_BANDS_M)):
        piece = _upright_lathe([(low, _cone_radius_m(low)), (high, _cone_radius_m(high))], segments=20)
        (white if index % 2 else orange).extend(piece)
    return Asset(
        "traffic_cone",
        (
            make_part("Foot", foot, "rubber_black", collider=Collider.CONVEX_HULL),
            make_part("Body", orange, "sign_orange", collider=Collider.CONVEX_HULL),
            make_part("Bands", white, "sign_white"),
        ),
    )


def _cone_radius_m(height_m: float) -> float:
    return 0.14 - 0.11 * (height_m - _CONE_BANDS_M[0]) / (_CONE_BANDS_M[-1] - _CONE_BANDS_M[0])


def no_parking_sign() -> Asset:
    """A no-parking sign on a post with a heavy foot, looking to +Z; origin in the middle of its foot."""
    foot = _upright_lathe([(0.0, 0.22), (0.05, 0.22), (0.09, 0.06)], segments=20)
    post = _upright_lathe([(0.09, 0.025), (1.45, 0.025)], segments=10)
    centre = 1.7
    back = _disc(0.30, 0.0, 0.012, centre)
    blue = _disc(0.245, 0.012, 0.016, centre)
    slash = np.array([(-0.2, -0.14, 0), (-0.14, -0.2, 0), (0.2, 0.14, 0), (0.14, 0.2, 0)]) + np.array(
        (0, centre, 0.0185)
    )
    return Asset(
        "traffic_sign",
        (
            make_part("Foot", foot, "rubber_black", collider=Collider.CONVEX_HULL),
            make_part("Post", post, "steel_galvanised", collider=Collider.CONVEX_HULL),
            make_part("Ring", back, "sign_ring", collider=Collider.CONVEX_HULL),
            make_part("Face", blue, "sign_blue"),
            make_part("Slash", [slash], "sign_ring"),
        ),
    )


def _upright_lathe(profile: list[tuple[float, float]], *, segments: int) -> list[Face]:
    """A closed solid of revolution about the Y axis from (height, radius) pairs, lowest first."""
    capped = [(profile[0][0], 0.0), *profile, (profile[-1][0], 0.0)]
    # from X to Y: a right-handed turn of the axes keeps the winding
    return [face[:, [1, 0, 2]] * (-1.0, 1.0, 1.0) for face in lathe_faces(capped, segments=segments)]


def _disc(radius: float, low: float, high: float, centre_y: float) -> list[Face]:
    """A closed disc that looks to +Z."""
    faces = lathe_faces([(low, 0.0), (low, radius), (high, radius), (high, 0.0)], segments=28)
    return [face[:, [1, 2, 0]] + np.array((0.0, centre_y, 0.0)) for face in faces]
