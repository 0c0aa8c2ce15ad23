"""The building's shell: walls, vehicle doors, cores, columns, ceiling slabs."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.assets.mesh import Asset, Collider, Face, Part, box_faces, frame_faces, make_part

__all__ = ["beam", "beam_node", "ceiling_panel", "column", "obstacle_block", "portal_wall", "wall_panel", "wall_post"]

_BAND_TOP_M = 1.1
_STRIPE_M = 0.12
_HAZARD_TOP_M = 1.2
_BEVEL_M = 0.03
_LAMELLA_M = 0.12
_GROOVE_M = 0.012
_FRAME_M = 0.08
_LEAST_SIGN_M = 0.06
_SIGN_OVER_DOOR_M = (2.3, 2.6)
"""Lower and upper edge of the sign over a core's door."""


def wall_panel(length_m: float, height_m: float, thickness_m: float) -> Asset:
    """A wall with a painted band; origin at the middle of its inner face's foot, inner face to +Z."""
    half = length_m / 2
    levels = (("Band", "wall_band", 0.0, _BAND_TOP_M), ("Stripe", "band_stripe", _BAND_TOP_M, _BAND_TOP_M + _STRIPE_M))
    faces: list[Face] = []
    parts = []
    for name, material, low, high in levels:
        face = box_faces((-half, low, -thickness_m), (half, high, 0), without="lrbtn")
        parts.append(make_part(name, face, material))
    top = _BAND_TOP_M + _STRIPE_M
    faces += box_faces((-half, top, -thickness_m), (half, height_m, 0), without="lrbtn")
    faces += box_faces((-half, 0, -thickness_m), (half, height_m, 0), without="f")

    def from_top(face: NDArray[np.float64], _normal: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([face[:, 0] + face[:, 2], face[:, 1] - height_m - face[:, 2]], axis=1)

    parts.append(make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX, project=from_top))
    return Asset("wall", tuple(parts))


def wall_post(side_m: float, height_m: float) -> Asset:
    """The square end of two walls that meet in a convex corner; origin in the middle of its foot."""
    half = side_m / 2
    faces = box_faces((-half, 0, -half), (half, height_m, half))
    return Asset("wall", (make_part("Concrete", faces, "wall_concrete", collider=Collider.BOX),))


def portal_wall(
    length_m: float,
    height_m: float,
    thickness_m: float,
    *,
    door_width_m: float,
    door_height_m: float,
    is_entrance: bool,
    is_open: bool = False,
) -> Asset:
    """A wall with a roller door set back in it, closed or up, a steel frame and a lit sign; origin as `wall_panel`."""
    half, jamb, back = length_m / 2, door_width_m / 2, -thickness_m
    concrete = box_faces((-half, 0, back), (-jamb, height_m, 0))
    concrete += box_faces((jamb, 0, back), (half, height_m, 0))
    lintel = box_faces((-jamb, door_height_m, back), (jamb, height_m, 0), without="lr")
    opening, head = jamb - _FRAME_M, door_height_m - _FRAME_M
    frame = frame_faces(opening, head, _FRAME_M, back, 0.02)
    door = (
        []
        if is_open
        else [make_part("Door", _lamellae(opening, head, -thickness_m / 2), "door_steel", collider=Collider.BOX)]
    )
    return Asset(
        "vehicle_door",
        (
            make_part("LeftJamb", concrete[:6], "wall_concrete", collider=Collider.BOX),
            make_part("RightJamb", concrete[6:], "wall_concrete", collider=Collider.BOX),
            make_part("Lintel", lintel, "wall_concrete", collider=Collider.BOX),
            make_part("Frame", frame, "hazard", collider=Collider.MESH),
            *door,
            *_door_sign(door_height_m + 0.08, height_m - 0.04, is_entrance=is_entrance),
        ),
    )


def _door_sign(low_m: float, top_m: float, *, is_entrance: bool) -> list[Part]:
    """The lit sign over a door, with an arrow up or down; none where the lintel has no room for it."""
    high_m = min(low_m + 0.28, top_m)
    if high_m - low_m < _LEAST_SIGN_M:
        return []
    sign = box_faces((-0.6, low_m, 0), (0.6, high_m, 0.06))
    middle, reach = (low_m + high_m) / 2, (high_m - low_m) * 0.36
    tip = -reach if is_entrance else reach
    arrow = [
        _upright([(-0.05, -tip), (0.05, -tip), (0.05, 0.0), (-0.05, 0.0)], middle),
        _upright([(-0.16, 0.0), (0.16, 0.0), (0.0, tip)], middle),
    ]
    return [
        make_part("Sign", sign, "sign_green" if is_entrance else "sign_red"),
        make_part("Arrow", arrow, "sign_white"),
    ]


def _lamellae(half_m: float, height_m: float, front_m: float) -> list[Face]:
    """The front of a roller door: flat slats with a groove under each, one sheet from the floor to the head."""
    count = max(1, int(height_m / _LAMELLA_M))
    step = height_m / count
    profile = [(0.0, front_m - _GROOVE_M)]
    for index in range(count):
        low = index * step
        profile += [(low + _GROOVE_M, front_m - _GROOVE_M), (low + _GROOVE_M, front_m)]
        profile += [(low + step, front_m), (low + step, front_m - _GROOVE_M)]
    return [
        np.array([(-half_m, y0, z0), (half_m, y0, z0), (half_m, y1, z1), (-half_m, y1, z1)])
        for (y0, z0), (y1, z1) in pairwise(profile)
    ]


def _upright(outline: list[tuple[float, float]], middle_m: float) -> Face:
    """An outline (x, y) on the front of a door's sign, turned counter-clockwise."""
    face = np.array([(x, y + middle_m, 0.064) for x, y in outline])
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    return face if normal[2] > 0 else face[::-1]


def obstacle_block(width_m: float, depth_m: float, height_m: float, *, has_door: bool = True) -> Asset:
    """A concrete core with a hazard band around its foot; origin in the middle of its foot.

    A core with a door has it in the middle of its side to +Z, with a lit exit sign over it where there is room.
    """
    x, z = width_m / 2, depth_m / 2
    band = box_faces((-x, 0, -z), (x, _STRIPE_M * 3, z), without="tb")
    body = box_faces((-x, _STRIPE_M * 3, -z), (x, height_m, z), without="b")
    block = (
        make_part("Band", band, "hazard", collider=Collider.BOX),
        make_part("Core", body, "wall_concrete", collider=Collider.BOX),
    )
    if not has_door:
        return Asset("obstacle", block)
    door = box_faces((-0.5, 0.0, z), (0.5, 2.1, z + 0.03), without="n")
    frame = frame_faces(0.5, 2.1, 0.08, z + 0.001, z + 0.045)
    handle = box_faces((0.34, 1.0, z + 0.03), (0.44, 1.03, z + 0.08))
    return Asset(
        "obstacle",
        (
            *block,
            make_part("Door", door, "door_steel", collider=Collider.BOX),
            make_part("Frame", frame, "steel_dark", collider=Collider.MESH),
            make_part("Handle", handle, "steel_galvanised", collider=Collider.BOX),
            *_exit_sign(z, height_m),
        ),
    )


def _exit_sign(face_m: float, height_m: float) -> list[Part]:
    """A green plate over a core's door with who runs through a doorway; none where the ceiling leaves no room."""
    low, high = _SIGN_OVER_DOOR_M
    if high > height_m - _STRIPE_M:
        return []
    half, front, side = (high - low), face_m + 0.03, high - low
    plate = box_faces((-half, low, face_m), (half, high, front), without="n")
    strokes = [
        shapely.Point(-0.18, 0.80).buffer(0.09, quad_segs=3),  # head, body, arms and legs, then the doorway
        shapely.LineString([(-0.22, 0.66), (-0.30, 0.40)]).buffer(0.07, cap_style="flat"),
        shapely.LineString([(-0.50, 0.46), (-0.42, 0.62), (-0.22, 0.62), (-0.06, 0.50)]).buffer(
            0.035, cap_style="flat"
        ),
        shapely.LineString([(-0.30, 0.42), (-0.12, 0.34), (-0.14, 0.12)]).buffer(0.045, cap_style="flat"),
        shapely.LineString([(-0.30, 0.42), (-0.36, 0.22), (-0.58, 0.20)]).buffer(0.045, cap_style="flat"),
        shapely.box(0.22, 0.10, 0.62, 0.90),
    ]
    drawn = shapely.get_parts(shapely.union_all(strokes, grid_size=1e-3))
    faces = [
        np.array([(x * side, low + y * side, front + 0.004) for x, y in list(triangle.exterior.coords)[-2::-1]])
        for shape in drawn
        for triangle in shapely.get_parts(shapely.constrained_delaunay_triangles(shape))
    ]
    faces = [face if np.cross(face[1] - face[0], face[2] - face[0])[2] > 0 else face[::-1] for face in faces]
    return [make_part("Sign", plate, "sign_green"), make_part("Pictogram", faces, "sign_white")]


def column(size_m: float, height_m: float) -> Asset:
    """A column with bevelled edges and a hazard band; origin in the middle of its foot."""
    foot = _bevelled_prism(size_m / 2, 0.0, _HAZARD_TOP_M, _BEVEL_M)
    shaft = _bevelled_prism(size_m / 2, _HAZARD_TOP_M, height_m, _BEVEL_M)
    return Asset(
        "column",
        (
            make_part("Hazard", foot, "hazard", collider=Collider.CONVEX_HULL),
            make_part("Shaft", shaft, "wall_concrete", collider=Collider.CONVEX_HULL),
        ),
    )


def _bevelled_prism(half: float, low: float, high: float, bevel: float) -> list[Face]:
    inner = half - bevel
    ring = [(inner, half), (half, inner), (half, -inner), (inner, -half)]
    ring += [(-inner, -half), (-half, -inner), (-half, inner), (-inner, half)]
    faces = []
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1], strict=True):
        faces.append(np.array([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)]))
    faces.append(np.array([(x, high, z) for x, z in ring]))
    faces.append(np.array([(x, low, z) for x, z in reversed(ring)]))
    return faces


def ceiling_panel(width_m: float, depth_m: float, thickness_m: float) -> Asset:
    """A ceiling slab; origin in the middle of its underside."""
    x, z = width_m / 2, depth_m / 2
    faces = box_faces((-x, 0, -z), (x, thickness_m, z))
    return Asset("ceiling", (make_part("Slab", faces, "ceiling_concrete", collider=Collider.BOX),))


def beam(length_m: float, width_m: float, depth_m: float) -> Asset:
    """A concrete beam, long along Z; origin in the middle of its top, which the slab covers."""
    x, z = width_m / 2, length_m / 2
    faces = box_faces((-x, -depth_m, -z), (x, 0, z), without="t")
    return Asset("beam", (make_part("Concrete", faces, "ceiling_concrete", collider=Collider.BOX),))


def beam_node(boxes: Sequence[tuple[float, float, float, float]], depth_m: float) -> Asset:
    """Where beams meet: boxes (left, top, right, bottom in x and z) that touch; origin on the ceiling."""
    parts = [
        make_part(
            f"Concrete{index}",
            box_faces((left, -depth_m, top), (right, 0, bottom), without="t"),
            "ceiling_concrete",
            collider=Collider.BOX,
        )
        for index, (left, top, right, bottom) in enumerate(boxes, start=1)
    ]
    return Asset("beam", tuple(parts))
