"""Interior of a car as seen through its windows: dashboard, steering wheel, seats, floor, door cards, headliner."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.car_shell import Shell, grid_quads
from garage2usd.assets.faces import level_lathe_faces
from garage2usd.assets.mesh import Part, make_part

_DASH_FROM_COWL_M = 0.12
_SEAT_WIDTH_M = 0.50
_HEADREST_HALF_M = 0.13
_CUSHION_LENGTH_M, _CUSHION_THICK_M = 0.50, 0.15
_BACK_M, _BACK_LEAN_M, _BACK_THICK_M = 0.58, 0.20, 0.12
_HEADREST_M = 0.19
_ROW_PITCH_M = 0.86
_LEGS_M = 1.05
"""Least distance from the foot of the windscreen to the front backrests."""
_ROOM_OVER_HEAD_M = 0.07
_TRIM_M = 0.055
"""Distance between the shell and its lining."""
_BEVEL_M = 0.035
_APART_M = 0.002
"""Gap between sheets that would otherwise touch in a point."""
_HIGHEST_CUSHION_M, _LOWEST_CUSHION_M = 0.42, 0.16
"""Heights of a seat cushion above the floor."""
_SEAT_UNDER_ROOF_M = 0.88
"""Distance from a cushion's top to the roof, if there is room."""
_ROOF_POINT = 14.0
"""Ring point above the front passengers' heads."""
_SILL_POINT, _MIDDLE_POINT = 4, 16
"""Ring points from the sill to the centre of the roof."""

Faces = NDArray[np.float64]
"""float64, shape (faces, 4, 3)."""


@dataclass(frozen=True)
class _Row:
    """A row of seats: distance of its backrests' foot from the nose, and height of its cushions, in metres."""

    s_m: float
    cushion_m: float


def interior(shell: Shell) -> list[Part]:
    """Make the parts inside a body in its axes: lining and seats."""
    rows = _rows(shell)
    lining = np.concatenate([_dashboard(shell, rows[0]), _tub(shell, rows), _headliner(shell)])
    wheel = _steering_wheel(shell, rows[0])
    seats = [_front_seat(shell, rows[0], side) for side in (-1.0, 1.0)]
    seats += [_bench(shell, row) for row in rows[1:]]
    return [
        make_part("Interior", [*lining, *wheel], "interior_dark", crease_deg=50),
        make_part("Seats", np.concatenate(seats), f"seat_{shell.shape.seats}", crease_deg=60),
    ]


def behind_seats_m(shell: Shell) -> float:
    """Distance in metres from the nose to the back of the last row of seats."""
    return _rows(shell)[-1].s_m + _BACK_LEAN_M + _BACK_THICK_M


def _floor_m(shell: Shell) -> float:
    return shell.shape.clearance_m + 0.10


def _roof_m(shell: Shell, s: float) -> float:
    """Height of the inside of the roof or rear window at a distance from the nose, beside the centre."""
    return float(shell.surface(s, _ROOF_POINT)[1]) - 0.03


def _rows(shell: Shell) -> list[_Row]:
    """Place the rows of seats: the first before the first pillar, the others as far back as headroom allows."""
    shape, length = shell.shape, shell.body.length_m
    floor, s = _floor_m(shell), max(shape.pillars[0] * length - 0.28, shell.cowl + _LEGS_M)
    rows: list[_Row] = []
    for number in range(shape.rows):
        under_roof = _roof_m(shell, s + _BACK_LEAN_M) - _SEAT_UNDER_ROOF_M
        cushion = min(max(under_roof, floor + _LOWEST_CUSHION_M), floor + _HIGHEST_CUSHION_M)
        if number:
            cushion = max(cushion, rows[-1].cushion_m)
            tall = cushion + _BACK_M + _ROOM_OVER_HEAD_M
            while _roof_m(shell, s + _BACK_LEAN_M + 0.08) < tall and s > rows[-1].s_m + 0.5:
                s -= 0.02
        rows.append(_Row(s, cushion))
        s += _ROW_PITCH_M
    return rows


def _inner_m(shell: Shell, s: float, y: float) -> float:
    """Half of the inner width between door cards, windows or roof edges at a height."""
    ring = np.array([shell.surface(s, t) for t in range(_SILL_POINT, _MIDDLE_POINT + 1)])
    return float(np.interp(y, ring[:, 1], ring[:, 0])) - _TRIM_M


def _across(shell: Shell, line: Sequence[tuple[float, float]], half_m: float) -> Faces:
    """A sheet across the car along a line of (metres from the nose, height), visible from one side."""
    z = np.array([s - shell.body.length_m / 2 for s, _ in line])
    y = np.array([height for _, height in line])
    grid = np.stack([np.stack([np.full(len(line), x), y, z], axis=1) for x in (half_m, -half_m)], axis=1)
    return grid_quads(grid).reshape(-1, 4, 3)


def _dashboard(shell: Shell, front: _Row) -> Faces:
    """Dashboard of a car from below the windscreen down to the floor, with a centre console."""
    first = shell.cowl + _DASH_FROM_COWL_M
    last = max(first + 0.20, front.s_m - 0.92)
    top, floor = shell.shoulder(first) + 0.012, _floor_m(shell)
    foot = max(first + 0.05, shell.axles[0] + shell.arch_radius_m + 0.04)
    edge = [(first, top - 0.05), (first, top), (last - 0.12, top + 0.012), (last, top - 0.05), (last - 0.02, top - 0.2)]
    line = [*edge, (min(last - 0.15, foot + 0.05) if foot < last - 0.15 else foot, top - 0.34), (foot, floor)]
    half = min(_inner_m(shell, first, top + 0.012), _inner_m(shell, last, top + 0.012))
    dash = [_across(shell, line, half)]
    # a hood over the instruments, a central screen
    z = last - shell.body.length_m / 2
    side = _driver_x(shell)
    dash.append(_pillow((side - 0.17, top - 0.03, z - 0.22), (side + 0.17, top + 0.045, z - 0.02), 0.02))
    dash.append(_pillow((-0.13, top - 0.06, z - 0.05), (0.13, top + 0.075, z - 0.02), 0.008))
    console = (-0.11, floor, z - 0.05), (0.11, front.cushion_m + 0.04, front.s_m - shell.body.length_m / 2 + 0.05)
    return np.concatenate([*dash, _pillow(*console, 0.02)])


def _driver_x(shell: Shell) -> float:
    """X of the centre of a car's driver's seat, on the left."""
    return -min(shell.body.width_m * 0.205, shell.body.width_m / 2 - 0.47)


def _steering_wheel(shell: Shell, front: _Row) -> list[NDArray[np.float64]]:
    """Steering wheel: a ring with two spokes and a hub, facing the driver."""
    radius, tube = 0.18, 0.016
    turn = np.arange(5) * (2 * np.pi / 4) + np.pi / 4
    ring = level_lathe_faces([(tube * np.sin(a), radius + tube * np.cos(a)) for a in turn], segments=16)
    spokes = _pillow((-radius, -0.02, -0.012), (radius, 0.02, 0.012), 0.006)
    hub = _pillow((-0.06, -0.06, -0.02), (0.06, 0.045, 0.02), 0.015)
    lean = np.radians(24)
    tilt = np.array([(1, 0, 0), (0, np.cos(lean), -np.sin(lean)), (0, np.sin(lean), np.cos(lean))])
    at = (_driver_x(shell), front.cushion_m + 0.36, front.s_m - 0.60 - shell.body.length_m / 2)
    return [face @ tilt + at for face in (*ring, *spokes, *hub)]


def _tub(shell: Shell, rows: Sequence[_Row]) -> Faces:
    """Floor and door cards of a car up to the last row, and behind it a shelf to the rear window, or a bulkhead."""
    half_length = shell.body.length_m / 2
    first, floor = shell.cowl + _DASH_FROM_COWL_M, _floor_m(shell)
    last = min(rows[-1].s_m + _BACK_LEAN_M + 0.06, shell.deck - 0.08)
    over_wheels = 2 * shell.body.wheel_radius_m + 0.07
    arch = shell.axles[1] - shell.arch_radius_m - 0.03
    front_arch = shell.axles[0] + shell.arch_radius_m + 0.03
    cuts = sorted({first, *(s for s in (front_arch, arch) if first < s < last), last})
    faces = []
    for low, high in pairwise(cuts):
        is_over_wheel = low >= arch or high <= front_arch
        bottom = over_wheels if is_over_wheel else floor
        span = np.linspace(low + _APART_M, high, max(2, int((high - low) / 0.45) + 1))
        heights = [shell.shoulder(float(s)) - 0.03 for s in span]
        wall = np.array(
            [
                [(_inner_m(shell, float(s), y), y, s - half_length) for y in (bottom, (bottom + top) / 2, top)]
                for s, top in zip(span, heights, strict=True)
            ]
        )
        right = grid_quads(wall).reshape(-1, 4, 3)[:, ::-1]
        faces += [right, (right * (-1.0, 1.0, 1.0))[:, ::-1]]
        if not is_over_wheel:
            half = min(_inner_m(shell, low, floor), _inner_m(shell, high, floor)) + _APART_M
            faces.append(_across(shell, [(low, floor), (high, floor)], half))
    belt = shell.shoulder(last) - 0.02
    if shell.shape.glass_until is not None:
        levels = floor, belt, float(shell.surface(last, 12.0)[1]), _roof_m(shell, last)
        bulkhead = np.array(
            [[(x * _inner_m(shell, last, y), y, last - half_length + _APART_M) for x in (1, -1)] for y in levels]
        )
        return np.concatenate([*faces, grid_quads(bulkhead).reshape(-1, 4, 3)[:, ::-1]])
    span = np.linspace(last - 0.1, shell.deck - 0.08, 5)
    shelf = np.array(
        [[(x * _inner_m(shell, float(s), belt), belt, s - half_length) for x in (1.0, -1.0)] for s in span]
    )
    return np.concatenate([*faces, grid_quads(shelf).reshape(-1, 4, 3)])


def _headliner(shell: Shell) -> Faces:
    """The inside of the roof, seen from below."""
    span = np.linspace(shell.roof_front - 0.02, shell.roof_rear, 6)
    right = np.array([[shell.surface(float(s), t) for t in (12.0, 13.0, 14.0, 16.0)] for s in span]) - (0, 0.028, 0)
    right[:, 0, 0] -= 0.02
    quads = grid_quads(right).reshape(-1, 4, 3)[:, ::-1]
    return np.concatenate([quads, (quads * (-1.0, 1.0, 1.0))[:, ::-1]])


def _pillow(low: Sequence[float], high: Sequence[float], bevel_m: float) -> Faces:
    """A closed box with bevelled edges, narrower ones on a thin box."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    bevel_m = min(bevel_m, 0.24 * (x1 - x0), 0.24 * (y1 - y0))
    rings = []
    for z, inset in ((z0, bevel_m), (z0 + bevel_m, 0.0), (z1 - bevel_m, 0.0), (z1, bevel_m)):
        a, b, c, d = x0 + inset, y0 + inset, x1 - inset, y1 - inset
        corner = bevel_m
        ring = [(a + corner, b), (c - corner, b), (c, b + corner), (c, d - corner)]
        ring += [(c - corner, d), (a + corner, d), (a, d - corner), (a, b + corner)]
        rings.append([(x, y, z) for x, y in [*ring, ring[0]]])
    sides = grid_quads(np.array(rings)).reshape(-1, 4, 3)
    caps = [np.array(rings[0][:8])[::-1], np.array(rings[3][:8])]
    quads = [cap[list(quad)] for cap in caps for quad in ((0, 1, 2, 7), (7, 2, 3, 6), (6, 3, 4, 5))]
    return np.concatenate([sides, np.array(quads)])


def _seat(row: _Row, x: tuple[float, float], half_length_m: float) -> list[Faces]:
    """Cushion and inclined backrest of a car seat between two positions across the car."""
    top, z = row.cushion_m, row.s_m - half_length_m
    low = (x[0], top - _CUSHION_THICK_M, z - _CUSHION_LENGTH_M + 0.06)
    cushion = _pillow(low, (x[1], top, z + 0.06), _BEVEL_M)
    back = _pillow((x[0], 0.0, -_BACK_THICK_M / 2), (x[1], _BACK_M + 0.03, _BACK_THICK_M / 2), _BEVEL_M)
    return [cushion, _leant(back, row, z)]


def _leant(faces: Faces, row: _Row, z: float) -> Faces:
    """Incline faces above the foot of a backrest."""
    leant: Faces = faces + np.array((0.0, row.cushion_m - 0.03, z))
    leant[:, :, 2] += faces[:, :, 1] * (_BACK_LEAN_M / _BACK_M)
    return leant


def _headrest(shell: Shell, row: _Row, x: float) -> Faces:
    """Headrest of a car seat above its backrest, limited by the roof."""
    z = row.s_m - shell.body.length_m / 2
    roof = _roof_m(shell, row.s_m + _BACK_LEAN_M + 0.08) - 0.02
    high = min(_BACK_M + 0.05 + _HEADREST_M, roof - row.cushion_m + 0.03)
    low = _BACK_M + 0.045
    half = _HEADREST_HALF_M
    return _leant(_pillow((x - half, low, -0.045), (x + half, max(high, low + 0.075), 0.045), 0.025), row, z)


def _front_seat(shell: Shell, row: _Row, side: float) -> Faces:
    x = side * abs(_driver_x(shell))
    half = min(_SEAT_WIDTH_M, shell.body.width_m * 0.28) / 2
    seat = _seat(row, (x - half, x + half), shell.body.length_m / 2)
    return np.concatenate([*seat, _headrest(shell, row, x)])


def _bench(shell: Shell, row: _Row) -> Faces:
    """Rear bench of a car for three, with a headrest for each."""
    top = row.s_m + _BACK_LEAN_M + _BACK_THICK_M / 2, row.cushion_m + _BACK_M
    half = min(_inner_m(shell, row.s_m, row.cushion_m + 0.2) - 0.05, _inner_m(shell, *top))
    seat = _seat(row, (-half, half), shell.body.length_m / 2)
    heads = [_headrest(shell, row, x) for x in (-0.62 * half, 0.0, 0.62 * half)]
    return np.concatenate([*seat, *heads])
