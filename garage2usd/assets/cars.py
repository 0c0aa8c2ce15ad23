"""Car bodies: a lofted shell with glass, lamps, trim and plate holders, on four wheels."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.car_ends import (
    PLATE_M,
    bright_trim,
    end_trim,
    front_plate_m,
    head_lamps,
    rear_plate_m,
    tail_lamps,
)
from garage2usd.assets.car_interior import interior
from garage2usd.assets.car_patches import Faces, planar_faces, ribbon, slab
from garage2usd.assets.car_shapes import SHAPES
from garage2usd.assets.car_shell import Shell, both_sides, grid_quads, simplified
from garage2usd.assets.car_wheels import wheels
from garage2usd.assets.faces import box_faces, lathe_faces
from garage2usd.assets.materials import MATERIALS
from garage2usd.assets.mesh import Asset, Collider, Part, distinct_normals, make_part
from garage2usd.config.vehicles import PAINTS, CarBody

_ARCH_LIP_M = 0.03
_ARCH_LIP_OUT_M = 0.01
_SEAM_M = 0.007
_PLATE_LIFT_M = 0.0012
"""Distance of a plate from its holder."""
_HOLDER_RIM_M = 0.006
_HATCH_FROM = 0.93
"""Share of the length behind which the rear window ends at the tail."""
_DUST_POINTS = slice(4, 9)
"""Ring points with dust: from the sill to the door handles."""
_DUST_TOP = 0.97
_CLEAN_END_M = 0.34
"""Length of nose and tail without dust."""
_DUST_LIFT_M, _DUST_TOLERANCE_M = 0.0018, 0.0012
_LIT = {"lamp_front": "lamp_front_lit", "lamp_rear": "lamp_rear_lit"}
_BODYWORK = frozenset({"Body", "Cabin", "Glass", "Arches", "Mirrors", "Spoiler", "RearGlass"})
_BODYWORK_STEPS, _STEPS = 127, 32
"""Steps per unit of the normals of parts that reflect, as in glTF's bytes, and of all others: 0.3 and 1.2 degrees."""
_RAIL_M = 0.034
"""Height of a rail above the edge of the roof."""


@lru_cache(maxsize=64)
def car(body: CarBody) -> Asset:
    """Make a parked car for every paint; origin in the centre of its footprint on the floor, nose along -Z."""
    shell = Shell(body, SHAPES[body.name])
    regions, shape = shell.regions(), shell.shape
    head, tail = head_lamps(shell), tail_lamps(shell)
    roof = "soft_top" if shape.soft_top else "car_paint"
    lips = "trim_black" if shape.clad else "car_paint"
    parts = [
        make_part("Body", planar_faces(regions["body"]), "car_paint", collider=Collider.CONVEX_HULL, crease_deg=32),
        make_part("Cabin", planar_faces(regions["cabin"]), roof, collider=Collider.CONVEX_HULL, crease_deg=40),
        make_part("Glass", planar_faces(regions["glass"]), "glass", crease_deg=38),
        make_part("Pillars", planar_faces(regions["pillar"]), "trim_black", crease_deg=38),
        make_part("Underbody", planar_faces(regions["under"]), "trim_black"),
        make_part("HeadLamps", planar_faces(head.lights), "lamp_front", crease_deg=50),
        make_part("TailLamps", planar_faces(tail.lenses), "lamp_rear", crease_deg=50),
        make_part("ReverseLamps", planar_faces(tail.reverse), "lamp_front", crease_deg=50),
        make_part(
            "LampHousings", planar_faces(np.concatenate([head.housings, tail.housings])), "lamp_housing", crease_deg=50
        ),
        make_part("Trim", planar_faces(end_trim(shell)), "trim_black"),
        make_part("Bright", planar_faces(np.concatenate([head.bezels, bright_trim(shell)])), "chrome"),
        make_part("Arches", planar_faces(_arch_lips(shell)), lips, crease_deg=50),
        make_part("Seams", planar_faces(_seams(shell)), "trim_black"),
        make_part("Handles", planar_faces(_handles(shell)), "car_paint"),
        make_part("Mirrors", planar_faces(_mirrors(shell)), "car_paint", crease_deg=50),
        *interior(shell),
        *_plate_holders(shell),
        *wheels(body, shape.rim),
    ]
    if len(regions["rear_glass"]):
        parts.append(make_part("RearGlass", planar_faces(regions["rear_glass"]), "glass_dark", crease_deg=38))
    if shape.spoiler:
        parts.append(make_part("Spoiler", planar_faces(_spoiler(shell)), "car_paint", crease_deg=50))
    # wheels share their normals, in their own axes
    coarse = [
        _with_coarse_normals(part, _BODYWORK_STEPS if part.name in _BODYWORK else _STEPS) if part.pose is None else part
        for part in parts
    ]
    return Asset(tuple(coarse), paints={paint: f"car_paint_{paint}" for paint in PAINTS})


def _with_coarse_normals(part: Part, steps: int) -> Part:
    """Round the normals of a part to steps per unit, which leaves fewer different ones to store."""
    rounded = np.rint(part.normals.astype(np.float64) * steps)
    normals, indices = distinct_normals(rounded / np.linalg.norm(rounded, axis=1, keepdims=True))
    return replace(part, normals=normals, normal_indices=indices[part.normal_indices].astype(np.int32))


def dusty(asset: Asset, body: CarBody) -> Asset:
    """Cover the flanks of a car with road dust, thick above the sills and none at the door handles."""
    shell = Shell(body, SHAPES[body.name])
    stations = np.flatnonzero((shell.stations > _CLEAN_END_M) & (shell.stations < body.length_m - _CLEAN_END_M))
    side = shell.points[stations, _DUST_POINTS]
    kept = simplified(shell.stations[stations], side.reshape(len(side), -1), _DUST_TOLERANCE_M)
    faces = grid_quads(side[kept] + np.array((_DUST_LIFT_M, 0.0, 0.0))).reshape(-1, 4, 3)

    def project(corners: NDArray[np.float64], _normals: NDArray[np.float64]) -> NDArray[np.float64]:
        # stay below the upper edge of the texture, above which it would repeat
        most = _DUST_TOP * (MATERIALS["road_dust"].repeat_up_m or 1.0)
        high = np.clip(corners[:, 1] - shell.shape.clearance_m, 0.01, most)
        return np.stack([corners[:, 2], high], axis=1)

    part = make_part("Dust", planar_faces(both_sides(faces)), "road_dust", crease_deg=50, project=project)
    return replace(asset, parts=(*asset.parts, part))


def lit(asset: Asset) -> Asset:
    """Light the head and tail lamps of a car, of the catalogue or of the user."""
    glowing = {part.name: key for end, key in _LIT.items() for part in lamps_of(asset, end)}
    return replace(
        asset, parts=tuple(replace(part, material=glowing.get(part.name, part.material)) for part in asset.parts)
    )


def lamps_of(asset: Asset, end: str) -> list[Part]:
    """Head and tail lamps of a car: the parts with ``lamp_front`` or ``lamp_rear``, lit or not."""
    name = {"lamp_front": "HeadLamps", "lamp_rear": "TailLamps"}[end]
    own = {key for key, finish in asset.finishes.items() if finish.key == end} | {_LIT[end]}
    return [part for part in asset.parts if part.name == name or part.material in own]


def plate_places(body: CarBody) -> list[tuple[float, float, float]]:
    """Return the positions of a car's number plates in its axes.

    Returns
    -------
    list
        Front and rear plate: its direction along Z, -1 or 1, and Y and Z of its centre in metres.
    """
    return list(body.plates) or _plate_places(Shell(body, SHAPES[body.name]))


def _arch_lips(shell: Shell) -> Faces:
    """Lips around a car's four wheel arches, which follow the side."""
    angles = np.linspace(0.02, np.pi - 0.02, 17).tolist()
    faces: list[Faces] = []
    for axle in shell.axles:
        outer, inner = np.empty((len(angles), 2, 3)), np.empty((len(angles), 2, 3))
        for row, angle in enumerate(angles):
            for column, radius in enumerate((shell.arch_radius_m - 0.008, shell.arch_radius_m + _ARCH_LIP_M)):
                y = shell.body.wheel_radius_m + radius * np.sin(angle)
                x, z = shell.side_place(axle - radius * np.cos(angle), y)
                outer[row, column], inner[row, column] = (x + 0.006, y, z), (x - 0.03, y, z)
        faces.append(slab(outer, inner))
    return both_sides(np.concatenate(faces))


def _door_lines(shell: Shell) -> list[float]:
    """Distances from the nose, in metres, at which doors begin and end."""
    front = max(shell.cowl + 0.30, shell.axles[0] + shell.arch_radius_m + 0.10)
    ends = [front, shell.shape.pillars[0] * shell.body.length_m, shell.axles[1] - shell.arch_radius_m - 0.04]
    return ends[: shell.shape.doors + 1]


def _seams(shell: Shell) -> Faces:
    """Seams of a car: shut lines of doors and bonnet, strips below side windows, sills, door and roof rails, wipers."""
    up = (4.8, 5.0, 6.0, 7.0, 8.0, 9.0, 9.85)
    faces = [ribbon(shell, [(s, t) for t in up], _SEAM_M) for s in _door_lines(shell)]
    stations = shell.stations
    bonnet = stations[(stations > stations[0] + 0.05) & (stations < shell.cowl - 0.02)]
    faces.append(ribbon(shell, [(s, 11.15) for s in bonnet.tolist()], _SEAM_M))
    first, last = shell.side_window
    window = stations[(stations >= first - 1e-3) & (stations <= last + 1e-3)]
    faces.append(ribbon(shell, [(s, 10.0) for s in window.tolist()], 0.022))
    reach = shell.arch_radius_m + 0.05
    sill = np.linspace(shell.axles[0] + reach, shell.axles[1] - reach, 5)
    faces.append(ribbon(shell, [(s, 4.75) for s in sill.tolist()], 0.12 if shell.shape.clad else 0.05))
    if shell.shape.slides:
        faces.append(_door_rail(shell))
    if shell.shape.rails:
        faces.append(_rails(shell))
    faces += _wipers(shell)
    return np.concatenate(faces)


def _handles(shell: Shell) -> Faces:
    """Door handles: one at the rear end of each car door, which protrudes no farther than the wheel arches."""
    faces: list[Faces] = []
    outermost = shell.body.width_m / 2 + _ARCH_LIP_OUT_M
    for s in _door_lines(shell)[1:]:
        y = shell.shoulder(s) - 0.12
        x, z = shell.side_place(s - 0.17, y)
        faces.append(
            np.array(box_faces((x - 0.02, y - 0.016, z - 0.09), (min(x + 0.018, outermost), y + 0.016, z + 0.09)))
        )
    return both_sides(np.concatenate(faces))


def _plate_holders(shell: Shell) -> list[Part]:
    """Holders of front and rear plate, slightly larger than the plates."""
    half, high = PLATE_M[0] / 2 + _HOLDER_RIM_M, PLATE_M[1] / 2 + _HOLDER_RIM_M
    holder = np.array(box_faces((-half, -high, -0.03), (half, high, 0.0)))
    faces = [
        holder * (toward, 1.0, toward) + (0.0, y, z - toward * _PLATE_LIFT_M) for toward, y, z in _plate_places(shell)
    ]
    return [make_part("PlateHolders", np.concatenate(faces), "trim_black")]


def _plate_places(shell: Shell) -> list[tuple[float, float, float]]:
    """Positions of front and rear plate: -1 or 1 by the end, and Y and Z of the centre."""
    half, high = PLATE_M[0] / 2, PLATE_M[1]
    places = []
    for rear, low in ((False, front_plate_m(shell)), (True, rear_plate_m(shell))):
        outermost = max(
            abs(_end_z(shell, x, low + y, rear=rear)) for x in np.linspace(0.0, half, 5) for y in (0.0, high / 2, high)
        )
        toward = 1.0 if rear else -1.0
        places.append((toward, low + high / 2, toward * (outermost + 0.008)))
    return places


def _end_z(shell: Shell, x: float, y: float, *, rear: bool) -> float:
    contour = shell.contour(y, rear=rear)
    return float(contour.place(np.array([contour.arc_at_x(x)]), 0.0)[0, 1])


def _mirrors(shell: Shell) -> Faces:
    """Outside mirrors of a car: two rounded ones on short arms."""
    s = shell.body.mirrors_m
    y = shell.shoulder(s) + 0.075
    inner, outer = shell.side_place(s, shell.shoulder(s))[0] - 0.04, shell.body.overall_width_m / 2
    span = outer - inner
    profile = [(0.0, 0.0), (0.02, 0.03), (0.06, 0.05), (0.09, 0.08), (span - 0.025, 0.076)]
    faces = np.array(lathe_faces([*profile, (span, 0.0)], segments=10)) * (1.0, 0.9, 0.75)
    return both_sides(faces + np.array((inner, y, s - shell.body.length_m / 2)))


def _wipers(shell: Shell) -> list[Faces]:
    """Wipers of a car: two on the windscreen, and one on the rear window if there is no boot lid."""
    foot = shell.cowl + 0.045
    arm = [(foot, 15.7), (foot + 0.01, 15.0), (foot + 0.03, 14.2), (foot + 0.06, 13.4)]
    found = [ribbon(shell, arm, 0.018, lift_m=0.010)]
    if shell.deck > _HATCH_FROM * shell.body.length_m and shell.shape.glass_until is None:
        foot = shell.deck - 0.05
        arm = [(foot, 15.9), (foot - 0.02, 15.0), (foot - 0.04, 14.2)]
        found.append(ribbon(shell, arm, 0.016, lift_m=0.010))
    return found


def _door_rail(shell: Shell) -> Faces:
    """Rail of a sliding door, along the side behind it."""
    first = shell.shape.pillars[1 if len(shell.shape.pillars) > 1 else 0] * shell.body.length_m
    y = shell.shoulder(first) - 0.10
    places = [shell.side_place(float(s), y) for s in np.linspace(first, shell.body.length_m - 0.32, 6)]
    outer = np.array([[(x + 0.004, y + up, z) for up in (-0.010, 0.010)] for x, z in places])
    return both_sides(slab(outer, outer - np.array((0.02, 0.0, 0.0))))


def _rails(shell: Shell) -> Faces:
    """Roof rails of a car, one along each edge."""
    span = np.linspace(shell.roof_front + 0.12, shell.roof_rear - 0.06, 6)
    edge = np.array([shell.surface(float(s), 12.2) for s in span])
    rises = np.array([0.0, *[_RAIL_M] * (len(span) - 2), 0.0])[:, None]
    outer = np.stack([edge + np.array((side, 0.0, 0.0)) for side in (-0.014, 0.014)], axis=1)
    outer[:, :, 1] += rises + 0.004
    return both_sides(slab(outer, outer - (0.0, 0.022, 0.0)))


def _spoiler(shell: Shell) -> Faces:
    """Spoiler: an extension of the roof over the rear window."""
    span = shell.roof_rear - 0.05, shell.roof_rear + 0.004
    reach = min(0.13, shell.body.length_m - shell.roof_rear - 0.03)
    rows = [[shell.surface(s, t) for t in (12.4, 13.0, 14.0, 15.0, 16.0)] for s in span]
    rows.append([point + np.array((0.0, -0.012, reach)) for point in rows[-1]])
    outer = np.array(rows) + np.array((0.0, 0.004, 0.0))
    whole = np.concatenate([outer, (outer * (-1.0, 1.0, 1.0))[:, -2::-1]], axis=1)
    return slab(whole, whole - (0.0, 0.028, 0.0))
