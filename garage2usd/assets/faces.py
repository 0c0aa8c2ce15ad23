"""Polygon faces of boxes, solids of revolution, frames, rings and lofts."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from garage2usd.assets.mesh import Face

_STRAIGHT = 1e-9
_SIDE_OF_RODS = (0.31, 0.17, 0.93)
"""A direction across rods that lie along none."""


def moved(faces: Sequence[Face], by: ArrayLike) -> list[Face]:
    """Translate faces by a vector (x, y, z)."""
    return [face + np.asarray(by) for face in faces]


def bent(faces: Sequence[Face], radius_m: float, *, segments: int) -> list[Face]:
    """Bend faces before the plane z = 0 around a prism that approximates a cylinder and touches the plane at x = 0.

    Parameters
    ----------
    faces
        Convex faces; X becomes the arc length, Y stays, Z is the distance outwards. They are cut at the prism's edges.
    radius_m
        Circumradius of the prism, whose axis is parallel to Y behind the plane.
    segments
        Number of sides of the prism.
    """
    angle = 2 * np.pi / segments
    side_m = 2 * radius_m * np.sin(angle / 2)
    found = []
    for face in faces:
        first, last = int(np.floor(face[:, 0].min() / side_m)), int(np.ceil(face[:, 0].max() / side_m))
        for index in range(first, last):
            piece = _beyond(_beyond(face, index * side_m, 1.0), (index + 1) * side_m, -1.0)
            if len(piece) <= len(("x", "z")):
                continue
            share = piece[:, :1] / side_m - index
            ends = np.array([(np.sin(at * angle), np.cos(at * angle)) for at in (index, index + 1)])
            place = (ends[0] * (1 - share) + ends[1] * share) * (radius_m + piece[:, 2:])
            found.append(np.stack([place[:, 0], piece[:, 1], place[:, 1] - radius_m], axis=1))
    return found


def _beyond(face: Face, at: float, sign: float) -> Face:
    """Clip a convex face to X of at least `at`, or at most `at` for a sign of -1."""
    kept = []
    for start, end in zip(face, np.roll(face, -1, axis=0), strict=True):
        near, far = sign * (start[0] - at), sign * (end[0] - at)
        if near >= 0:
            kept.append(start)
        if near * far < 0:
            crossing = start + (end - start) * (near / (near - far))
            crossing[0] = at
            kept.append(crossing)
    return np.array(kept).reshape(-1, 3)


def box_faces(low: ArrayLike, high: ArrayLike, *, without: str = "") -> list[Face]:
    """The faces of an axis-aligned box.

    Parameters
    ----------
    low, high
        Opposite corners (x, y, z).
    without
        Faces to leave out, of the letters ``l`` -X, ``r`` +X, ``b`` -Y, ``t`` +Y, ``n`` -Z, ``f`` +Z.
    """
    (x0, y0, z0), (x1, y1, z1) = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    faces = {
        "l": [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
        "r": [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
        "b": [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)],
        "t": [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
        "n": [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
        "f": [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
    }
    return [np.array(face) for side, face in faces.items() if side not in without]


def lathe_faces(profile: Sequence[tuple[float, float]], *, segments: int) -> list[Face]:
    """Revolve a profile of (x, radius) about the X axis; with ascending x, its outside is away from the axis."""
    angles = np.arange(segments + 1) * (2 * np.pi / segments)
    angles[-1] = 0.0
    rings = [np.stack([np.full(segments + 1, x), r * np.cos(angles), r * np.sin(angles)], axis=1) for x, r in profile]
    return [
        np.array([first[i], second[i], second[i + 1], first[i + 1]])[::-1]
        for first, second in pairwise(rings)
        for i in range(segments)
    ]


def level_lathe_faces(profile: Sequence[tuple[float, float]], *, segments: int) -> list[Face]:
    """Revolve a profile of (z, radius) about the Z axis, as `lathe_faces` does about X."""
    # a cyclic permutation of the axes keeps the winding
    return [face[:, [1, 2, 0]] for face in lathe_faces(profile, segments=segments)]


def upright_lathe_faces(profile: Sequence[tuple[float, float]], *, segments: int) -> list[Face]:
    """Revolve a profile of (height, radius) about the Y axis to a closed solid, lowest first."""
    capped = [(profile[0][0], 0.0), *profile, (profile[-1][0], 0.0)]
    # from X to Y: a rotation of the axes keeps the winding
    return [face[:, [1, 0, 2]] * (-1.0, 1.0, 1.0) for face in lathe_faces(capped, segments=segments)]


def disc_faces(radius_m: float, back_m: float, front_m: float, centre_y_m: float) -> list[Face]:
    """A closed disc that faces +Z."""
    profile = [(back_m, 0.0), (back_m, radius_m), (front_m, radius_m), (front_m, 0.0)]
    return moved(level_lathe_faces(profile, segments=28), (0.0, centre_y_m, 0.0))


def tube_faces(points: Sequence[tuple[float, float, float]], radius_m: float, *, segments: int) -> list[Face]:
    """A closed round tube along a planar polyline, mitred at bends."""
    line = np.array(points, dtype=float)
    ways = np.diff(line, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    normal = np.cross(ways[0], ways[-1])
    if np.linalg.norm(normal) < _STRAIGHT:
        normal = np.cross(ways[0], np.eye(3)[np.argmin(np.abs(ways[0]))])
    normal /= np.linalg.norm(normal)
    angles = np.arange(segments) * (2 * np.pi / segments)
    rings = []
    for index, point in enumerate(line):
        before, after = ways[max(index - 1, 0)], ways[min(index, len(ways) - 1)]
        side = np.cross(before + after, normal)
        side *= 2 / (side @ side) * np.linalg.norm(np.cross(before, normal))
        rings.append(point + radius_m * (np.cos(angles)[:, None] * normal + np.sin(angles)[:, None] * side))
    faces = [
        np.array([first[i], first[(i + 1) % segments], second[(i + 1) % segments], second[i]])
        for first, second in pairwise(rings)
        for i in range(segments)
    ]
    return [rings[0][::-1], *faces, rings[-1]]


def frame_faces(half_m: float, top_m: float, border_m: float, back_m: float, front_m: float) -> list[Face]:
    """A door frame on y = 0, open at the bottom, from `back_m` to `front_m` along Z.

    The opening is 2 `half_m` wide and `top_m` high; the border is `border_m` wide on three sides.
    """
    inner = [(-half_m, 0.0), (-half_m, top_m), (half_m, top_m), (half_m, 0.0)]
    wide, high = half_m + border_m, top_m + border_m
    outer = [(-wide, 0.0), (-wide, high), (wide, high), (wide, 0.0)]
    faces = []
    for i in range(3):
        (ax, ay), (bx, by) = outer[i], outer[i + 1]
        (cx, cy), (dx, dy) = inner[i + 1], inner[i]
        faces.append([(dx, dy, front_m), (cx, cy, front_m), (bx, by, front_m), (ax, ay, front_m)])
        faces.append([(ax, ay, back_m), (bx, by, back_m), (cx, cy, back_m), (dx, dy, back_m)])
        faces.append([(ax, ay, front_m), (bx, by, front_m), (bx, by, back_m), (ax, ay, back_m)])
        faces.append([(dx, dy, back_m), (cx, cy, back_m), (cx, cy, front_m), (dx, dy, front_m)])
    for i in (0, 3):
        (ax, ay), (dx, dy) = outer[i], inner[i]
        foot = [(ax, ay, front_m), (ax, ay, back_m), (dx, dy, back_m), (dx, dy, front_m)]
        faces.append(foot if i == 0 else foot[::-1])
    return [np.array(face) for face in faces]


def ring_faces(low: ArrayLike, high: ArrayLike, border_m: float) -> list[Face]:
    """A rectangular ring around a box's outline in X and Y, `border_m` wide, with the box's extent along Z."""
    (x0, y0, z0), (x1, y1, z1) = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    b = border_m
    inner = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    outer = [(x0 - b, y0 - b), (x1 + b, y0 - b), (x1 + b, y1 + b), (x0 - b, y1 + b)]
    faces = []
    for i in range(4):
        (ax, ay), (bx, by) = outer[i], outer[(i + 1) % 4]
        (cx, cy), (dx, dy) = inner[(i + 1) % 4], inner[i]
        faces.append([(ax, ay, z1), (bx, by, z1), (cx, cy, z1), (dx, dy, z1)])
        faces.append([(dx, dy, z0), (cx, cy, z0), (bx, by, z0), (ax, ay, z0)])
        faces.append([(ax, ay, z0), (bx, by, z0), (bx, by, z1), (ax, ay, z1)])
        faces.append([(dx, dy, z1), (cx, cy, z1), (cx, cy, z0), (dx, dy, z0)])
    return [np.array(face) for face in faces]


def rectangle_ring(half_x_m: float, half_z_m: float, *, y: float, z: float = 0.0) -> Face:
    """A level rectangle with bevelled corners, as a ring of an upward loft; 8 points."""
    x, depth, cut = half_x_m, half_z_m, 0.18 * min(half_x_m, half_z_m)
    points = [
        (x, depth - cut), (x, cut - depth), (x - cut, -depth), (cut - x, -depth),
        (-x, cut - depth), (-x, depth - cut), (cut - x, depth), (x - cut, depth),
    ]  # fmt: skip
    return np.array([(px, y, z + pz) for px, pz in points])


def loft_faces(rings: Sequence[Face]) -> list[Face]:
    """A closed solid between rings with equal numbers of points; counter-clockwise seen from the last ring's side.

    Sides are split into triangles, as four corners of rings need not be coplanar.
    """
    faces: list[Face] = []
    for low, high in pairwise(rings):
        low_next, high_next = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
        faces += list(np.stack([low, low_next, high_next], axis=1))
        faces += list(np.stack([low, high_next, high], axis=1))
    return [rings[0][::-1], *faces, rings[-1]]


def limb_faces(
    points: Sequence[ArrayLike],
    widths_m: Sequence[float],
    depths_m: Sequence[float] | None = None,
    *,
    side: tuple[float, float, float] = (1.0, 0.0, 0.0),
    segments: int = 12,
) -> list[Face]:
    """A closed solid along a polyline with elliptical cross-sections.

    Parameters
    ----------
    points
        Centres of the ellipses (x, y, z), without consecutive duplicates.
    widths_m, depths_m
        Half axes of each ellipse, along `side` and across it; circles if the depths are left out.
    side
        A direction that is never parallel to the polyline.
    """
    line = np.array(points, dtype=float)
    ways = np.diff(line, axis=0)
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    angles = np.arange(segments) * (2 * np.pi / segments)
    rings = []
    for index, (point, width, depth) in enumerate(zip(line, widths_m, depths_m or widths_m, strict=True)):
        along = ways[max(index - 1, 0)] + ways[min(index, len(ways) - 1)]
        along /= np.linalg.norm(along)
        across = np.array(side) - along * (along @ np.array(side))
        across /= np.linalg.norm(across)
        other = np.cross(along, across)
        rings.append(point + np.outer(np.cos(angles) * width, across) + np.outer(np.sin(angles) * depth, other))
    return loft_faces(rings)


def faces_of(pieces: Iterable[Mapping[str, Any]], *, side: float = 1.0) -> list[Face]:
    """Make the faces of the pieces that a table describes, in its order.

    Parameters
    ----------
    pieces
        Tables with a ``box`` of two corners; the rings (half X, half Z, Y, Z) of a ``loft`` of rectangles; the points
        of a ``tube`` with its ``radius_m`` and ``segments``; the ends and the radius (X, Y, Z, X, Y, Z, R) of some
        ``rods``; the rings (X, Y, Z, width and, where it differs, depth) of a ``limb`` with its ``segments`` and
        ``side``; or ``pieces`` that are made once for each of some ``sides``.
    side
        Factor on the X of rods and limbs.
    """
    faces: list[Face] = []
    for piece in pieces:
        match piece:
            case {"pieces": inner, "sides": sides}:
                faces += [face for each in sides for face in faces_of(inner, side=each)]
            case {"box": (low, high)}:
                faces += box_faces(low, high)
            case {"loft": rings}:
                faces += loft_faces([rectangle_ring(x, depth, y=y, z=z) for x, depth, y, z in rings])
            case {"tube": points, "radius_m": radius_m, "segments": segments}:
                faces += tube_faces(points, radius_m, segments=segments)
            case {"rods": rods}:
                for *ends, radius_m in rods:
                    places = [(side * x, y, z) for x, y, z in (ends[:3], ends[3:])]
                    faces += limb_faces(places, [radius_m] * 2, side=_SIDE_OF_RODS, segments=8)
            case {"limb": rings, **more}:
                points = [(side * x, y, z) for x, y, z, *_ in rings]
                widths, *depths = zip(*(radii for _, _, _, *radii in rings), strict=True)
                faces += limb_faces(points, widths, *depths, **more)
    return faces
