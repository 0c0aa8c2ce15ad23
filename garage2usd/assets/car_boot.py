"""Open boots of cars: tailgate or boot lid, cut out of the body and swung up, and the load space behind it."""
# Over 300 lines: the body is cut, the cut mesh repaired, and the load space fitted behind it, step after step.

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import compress
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.car_interior import behind_seats_m
from garage2usd.assets.car_patches import Faces, planar_faces
from garage2usd.assets.car_shapes import SHAPES
from garage2usd.assets.car_shell import Shell, both_sides, grid_quads
from garage2usd.assets.cars import car
from garage2usd.assets.mesh import Asset, Collider, Face, Part, area_vectors, make_part, next_corners, previous_corners
from garage2usd.config.vehicles import CarBody

_APART_M = 1e-5
"""Distance by which points of different fans are moved apart."""
_LEAST_AREA_M2 = 1e-8
"""Twice the area of a face below which it is a sliver."""
_Plane = tuple[tuple[float, float, float], float]
"""Normal and distance of a plane; a point inside has `normal @ point >= distance`."""
_CUT_SKIN = ("Body", "Cabin", "Glass", "RearGlass", "Pillars")
_CUT = frozenset((*_CUT_SKIN, "Seams", "Trim", "Bright", "TailLamps", "ReverseLamps", "LampHousings", "PlateHolders"))
"""Parts of a car that the shut line of a boot cuts."""
_PANELS = ("Body", "Cabin")
"""Cut parts with an inner surface."""
_CREASES_DEG = {"Body": 32.0, "Cabin": 40.0}
_GATE_FROM = 0.93
"""Share of the length behind which the rear window ends in a tailgate; before it, there is a boot lid."""
_OVER_SEAM_M = 0.012
_BEFORE_ROOF_END_M, _BEHIND_DECK_M = 0.06, 0.035
_WIDE = 0.715
"""Half the width of a boot's lower part, up to the tailgate's seam, as a share of the body's."""
_THICK = np.array((0.0, -0.03, -0.05))
"""Offset from the outer to the inner skin of a panel."""
_RIM = np.array((0.0, -0.05, -0.10))
"""Offset from the outer to the inner skin around the opening."""
_FLOOR_M = 0.10
"""Depth of a boot's floor below its sill."""
_UNDER_SHELF_M = 0.03
_GATE_RISES, _LID_TURNS = np.radians(8.0), np.radians(76.0)
"""Elevation of an open tailgate; rotation of an open boot lid."""
_HIGHEST_M = 1.85
"""Greatest height of the raised end of a tailgate above its hinge."""


def with_manifold_points(part: Part) -> Part:
    """Split the points of a mesh so that each belongs to one fan of faces.

    Two faces belong to a fan if they share an edge that no third face has. Slivers are dropped. Points of different
    fans are moved apart by 0.01 mm, so that no two points coincide.

    Parameters
    ----------
    part
        A mesh without texture coordinates.
    """
    part = _without_slivers(part)
    counts, points = part.face_counts.astype(np.int64), part.face_indices.astype(np.int64)
    after = next_corners(counts)
    start, end = points, points[after]
    forward, backward = start * len(part.points) + end, end * len(part.points) + start
    keys, first, times = np.unique(forward, return_index=True, return_counts=True)
    place = np.minimum(np.searchsorted(keys, backward), len(keys) - 1)
    own = times[np.searchsorted(keys, forward)]
    is_joined = (keys[place] == backward) & (times[place] == 1) & (own == 1)
    corner = np.flatnonzero(is_joined)
    facing = first[place[corner]]
    fans = _components(len(points), [(corner, after[facing]), (after[corner], facing)])
    _, firsts, number = np.unique(points * len(points) + fans, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    split = points[firsts]
    moved = part.points[split].astype(float)
    inwards = np.zeros((len(split), 3))
    corners, before = part.points[points].astype(float), previous_corners(counts)
    np.add.at(inwards, number, corners[after] + corners[before] - 2 * corners)
    is_shared = np.bincount(split, minlength=len(part.points))[split] > 1
    length = np.linalg.norm(inwards, axis=1, keepdims=True)
    moved += np.where(is_shared[:, None], _APART_M * inwards / np.maximum(length, _APART_M), 0.0)
    return replace(part, points=moved.astype(np.float32), face_indices=number.astype(np.int32))


def _without_slivers(part: Part) -> Part:
    counts = part.face_counts.astype(np.int64)
    area = np.linalg.norm(area_vectors(part.points[part.face_indices].astype(float), counts), axis=1)
    is_kept = area > _LEAST_AREA_M2
    of_corner = np.repeat(is_kept, counts)
    normals, normal_indices = np.unique(part.normal_indices[of_corner], return_inverse=True)
    points, indices = np.unique(part.face_indices[of_corner], return_inverse=True)
    return replace(
        part,
        points=part.points[points],
        face_counts=part.face_counts[is_kept],
        face_indices=indices.reshape(-1).astype(np.int32),
        normals=part.normals[normals],
        normal_indices=normal_indices.reshape(-1).astype(np.int32),
    )


def _components(size: int, pairs: list[tuple[NDArray[np.intp], NDArray[np.intp]]]) -> NDArray[np.int64]:
    """Number of the connected component of each node of an undirected graph."""
    from scipy.sparse import coo_array  # noqa: PLC0415 - few garages have meshes that are cut
    from scipy.sparse.csgraph import connected_components  # noqa: PLC0415

    one, other = (np.concatenate(side) for side in zip(*pairs, strict=True))
    joined = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(size, size))
    _, labels = connected_components(joined, directed=False)
    return np.asarray(labels, dtype=np.int64)


class _Boot(NamedTuple):
    """Geometry of a boot's opening in the car's axes: its cuts and its hinge."""

    shell: Shell
    is_gate: bool
    start_m: float
    sill_m: float
    half_m: float
    belt_m: float

    @property
    def start_z(self) -> float:
        """Z of its front edge."""
        return self.start_m - self.shell.body.length_m / 2

    @property
    def hinge(self) -> tuple[float, float]:
        """Y and Z of the hinge axis."""
        return float(self.shell.surface(self.start_m, 16.0)[1]) - 0.03, self.start_z

    @property
    def turn_rad(self) -> float:
        """Opening angle."""
        if not self.is_gate:
            return float(_LID_TURNS)
        y, z = self.hinge
        down, back = y - self.sill_m, self.shell.contour(self.sill_m, rear=True).line[0, 1] - z
        most = np.arcsin(min(max((_HIGHEST_M - y) / np.hypot(down, back), 0.0), 1.0))
        return float(np.arctan2(down, back) + min(_GATE_RISES, most))

    def regions(self) -> list[list[_Plane]]:
        """Convex regions whose faces swing up: beside the windows and below them."""
        over: list[_Plane] = [((0.0, 0.0, 1.0), self.start_z), ((0.0, 1.0, 0.0), self.belt_m)]
        below: list[_Plane] = [
            ((0.0, 0.0, 1.0), self.start_z),
            ((0.0, -1.0, 0.0), -self.belt_m),
            ((0.0, 1.0, 0.0), self.sill_m),
            *_both(((-1.0, 0.0, 0.0), -self.half_m)),
        ]
        if not self.is_gate:
            return [below, [*over, *_both(((-1.0, 0.0, 0.0), -self.half_m))]]
        # along the outer edges of the rear window
        top, foot = (self.shell.surface(s, 11.9) for s in (self.start_m, self.shell.deck - 0.02))
        lean = (top[0] - foot[0]) / (top[1] - foot[1])
        return [below, [*over, *_both(((-1.0, float(lean), 0.0), float(lean * foot[1] - foot[0])))]]


def _both(plane: _Plane) -> tuple[_Plane, _Plane]:
    """A plane on the right and its mirror image on the left."""
    (x, y, z), distance = plane
    return plane, ((-x, y, z), distance)


def has_boot(body: CarBody) -> bool:
    """True if a body of the catalogue has a tailgate or a boot lid; pickups and panel vans have neither."""
    shape = SHAPES[body.name]
    return shape.bed is None and shape.glass_until is None


def with_open_boot(asset: Asset, body: CarBody) -> Asset:
    """Open the boot of a car.

    Parameters
    ----------
    asset
        A car of the catalogue with a boot.
    body
        Measures of the car.
    """
    boot = _boot(body)
    kept: list[Part] = []
    moved: list[Part] = []
    rim: list[Faces] = []
    for part, inside, outside in _cut(asset, boot):
        if not inside:
            kept.append(part)
        elif not outside:
            moved.append(_swung(part, boot))
        else:
            crease = _CREASES_DEG.get(part.name, 38.0)
            kept.append(make_part(part.name, outside, part.material, collider=part.collider, crease_deg=crease))
            gate = make_part(f"Boot{part.name}", inside, part.material, crease_deg=crease)
            moved.append(_swung(gate, boot))
            if part.name in _PANELS:
                edges = _border(gate)
                inner = [face[::-1] + _THICK for face in inside]
                lining = make_part(f"Boot{part.name}Lining", [*inner, *_band(edges, _THICK)], "interior_dark")
                moved.append(_swung(lining, boot))
                rim.append(_band(edges[:, ::-1], _RIM))
    moved = [replace(part, collider=Collider.CONVEX_HULL) if part.name == "BootBody" else part for part in moved]
    well = make_part("BootWell", [*np.concatenate(rim), *planar_faces(_well(boot))], "interior_dark", crease_deg=30.0)
    uncut = {id(part) for part in asset.parts}
    parts = [part if id(part) in uncut else with_manifold_points(part) for part in (*kept, *moved, well)]
    return replace(asset, parts=tuple(parts))


@lru_cache(maxsize=64)
def open_boot_box(body: CarBody) -> tuple[float, float, float]:
    """Footprint of an open boot in metres: greatest X on either side, first and last Z."""
    boot = _boot(body)
    cut = [np.concatenate(inside) for _, inside, _ in _cut(car(body), boot) if inside]
    points = _turned(np.concatenate([each + off for each in cut for off in (0.0, _THICK)]), boot)
    return float(np.abs(points[:, 0]).max()), float(points[:, 2].min()), float(points[:, 2].max())


def with_rear_swung_up(part: Part, body: CarBody) -> Part:
    """Swing the rear number plate up with the open boot; each plate faces along Z."""
    moved = _swung(part, _boot(body))
    is_rear, looks_back = part.points[:, 2:] > 0, part.normals[:, 2:] > 0
    return replace(
        part,
        points=np.where(is_rear, moved.points, part.points),
        normals=np.where(looks_back, moved.normals, part.normals),
    )


@lru_cache(maxsize=64)
def _boot(body: CarBody) -> _Boot:
    shell = Shell(body, SHAPES[body.name])
    is_gate = shell.deck > _GATE_FROM * body.length_m
    start = shell.roof_rear - _BEFORE_ROOF_END_M if is_gate else shell.deck + _BEHIND_DECK_M
    sill = shell.bumper_top(rear=True) + 0.03 + _OVER_SEAM_M
    belt = float(shell.surface(shell.deck - 0.02, 10.0)[1]) if is_gate else (sill + shell.end_top(rear=True)) / 2
    return _Boot(shell, is_gate, start, sill, _WIDE * body.width_m / 2, belt)


def _turned(points: NDArray[np.float64], boot: _Boot) -> NDArray[np.float64]:
    """Rotate points about the hinge, with the tail upwards."""
    y, z = boot.hinge
    cos, sin = np.cos(boot.turn_rad), np.sin(boot.turn_rad)
    up, back = points[:, 1] - y, points[:, 2] - z
    return np.stack([points[:, 0], y + up * cos + back * sin, z + back * cos - up * sin], axis=1)


def _cut(asset: Asset, boot: _Boot) -> Iterator[tuple[Part, list[Face], list[Face]]]:
    """Split each cut part of a car into the faces that swing up and the remaining faces."""
    for part in asset.parts:
        if part.name == "Spoiler" and boot.is_gate:
            yield part, _faces(part), []
        elif part.name in _CUT:
            faces = _faces(part)
            behind = [face[:, 2].max() > boot.start_z for face in faces]
            inside, outside = _divided(list(compress(faces, behind)), boot.regions())
            yield (
                part,
                inside,
                [*(face for face, is_behind in zip(faces, behind, strict=True) if not is_behind), *outside],
            )
        else:
            yield part, [], []


def _swung(part: Part, boot: _Boot) -> Part:
    """Rotate a part with the boot."""
    hinge = np.array((0.0, *boot.hinge))
    points = _turned(part.points.astype(float), boot)
    normals = _turned(part.normals.astype(float) + hinge, boot) - hinge
    return replace(part, points=points.astype(np.float32), normals=normals.astype(np.float32))


def _faces(part: Part) -> list[Face]:
    return np.split(part.points[part.face_indices].astype(float), np.cumsum(part.face_counts)[:-1])


def _divided(faces: Sequence[Face], regions: Sequence[Sequence[_Plane]]) -> tuple[list[Face], list[Face]]:
    """Split planar convex faces into the pieces inside any of several convex regions and the pieces outside."""
    inside: list[Face] = []
    outside = list(faces)
    for region in regions:
        within, outside = outside, []
        for normal, distance in region:
            halves = [_halves(face, np.array(normal), distance) for face in within]
            within = [near for near, _ in halves if near is not None]
            outside += [far for _, far in halves if far is not None]
        inside += within
    return inside, outside


def _halves(face: Face, normal: NDArray[np.float64], distance: float) -> tuple[Face | None, Face | None]:
    """Split a face at a plane (Sutherland and Hodgman, 1974)."""
    height = face @ normal - distance
    height[np.abs(height) < 1e-6] = 0.0  # noqa: PLR2004 - a micrometre
    if (height >= 0).all():
        return face, None
    if (height <= 0).all():
        return None, face
    sides: tuple[list[NDArray[np.float64]], list[NDArray[np.float64]]] = ([], [])
    for corner, after, low, high in zip(face, np.roll(face, -1, 0), height, np.roll(height, -1), strict=True):
        for side, sign in zip(sides, (1, -1), strict=True):
            if low * sign >= 0:
                side.append(corner)
            if low * high < 0:
                side.append(corner + (after - corner) * (low / (low - high)))
    return np.array(sides[0]), np.array(sides[1])


def _border(part: Part) -> NDArray[np.float64]:
    """Border edges of a part, in the direction of their faces; float64, shape (edges, 2, 3)."""
    after = next_corners(part.face_counts.astype(np.int64))
    edges = np.stack([part.face_indices, part.face_indices[after]], axis=1)
    known = set(map(tuple, edges.tolist()))
    border = [edge for edge in edges.tolist() if (edge[1], edge[0]) not in known]
    points: NDArray[np.float64] = part.points[np.array(border)].astype(float)
    return points


def _band(edges: NDArray[np.float64], inwards: NDArray[np.float64]) -> Faces:
    """Quads from edges inwards, with the winding of the adjacent faces."""
    start, end = edges[:, 0], edges[:, 1]
    return np.stack([end, start, start + inwards, end + inwards], axis=1)


def _well(boot: _Boot) -> Faces:
    """Floor, sides, front and sill of the load space seen from within, and its cover if a shelf lies above."""
    shell = boot.shell
    half_length, x = shell.body.length_m / 2, boot.half_m - 0.005
    first = min(behind_seats_m(shell), boot.start_m - 0.1)
    front, floor = first - half_length, boot.sill_m - _FLOOR_M
    across = np.linspace(0.0, x, 5)
    contour = shell.contour(boot.sill_m, rear=True)
    tail = contour.place(np.array([contour.arc_at_x(float(at)) for at in across]), 0.0)[:, 1] + _RIM[2]

    def line(y: float, z: float | NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([across, np.full(5, y), np.broadcast_to(z, 5)], axis=1)

    def top(s: float) -> float:
        return max(shell.shoulder(s) - _UNDER_SHELF_M, floor + 0.05)

    spans = np.linspace(first, float(tail[-1]) + half_length, 6).tolist()
    side = np.array([[(x, y, s - half_length) for y in (floor, top(s))] for s in spans])
    sheets = [
        np.stack([line(boot.sill_m + _RIM[1], tail), line(floor, tail), line(floor, front), line(top(first), front)]),
        side[::-1],
    ]
    if not boot.is_gate:
        sheets.append(np.stack([line(top(first), front), line(top(boot.start_m), boot.start_z)]))
    return both_sides(np.concatenate([grid_quads(sheet).reshape(-1, 4, 3) for sheet in sheets]))
