"""Car bodies: a lofted shell with glass, lamps, trim and plates, on four wheels."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from garage2usd.assets.car_shell import SHAPES, Shell
from garage2usd.assets.mesh import Asset, Collider, Face, Part, box_faces, lathe_faces, make_part, moved
from garage2usd.config.vehicles import PAINTS, CarBody

__all__ = ["car"]

_TYRE_WIDTH_M = 0.21
_PLATE_M = (0.50, 0.11)
_SKIN_M = 0.004
_ARCH_LIP_M = 0.03
_SEAM_M = 0.007


def car(body: CarBody) -> Asset:
    """A parked car that takes every paint; origin in the middle of its footprint on the floor, nose to -Z."""
    shell = Shell(body, SHAPES[body.name])
    regions = shell.regions()
    parts = [
        make_part("Body", regions["body"], "car_paint", collider=Collider.CONVEX_HULL, crease_deg=40),
        make_part("Cabin", regions["cabin"], "car_paint", collider=Collider.CONVEX_HULL, crease_deg=40),
        make_part("Glass", regions["glass"], "glass", crease_deg=38),
        make_part("Underbody", regions["under"], "trim_black"),
        make_part("HeadLamps", _head_lamps(shell), "lamp_front", crease_deg=50),
        make_part("TailLamps", _tail_lamps(shell), "lamp_rear", crease_deg=50),
        make_part("Trim", _end_trim(shell), "trim_black"),
        make_part("Arches", _arch_lips(shell), "trim_black", crease_deg=50),
        make_part("Seams", _seams(shell), "trim_black"),
        make_part("Handles", _handles(shell), "car_paint"),
        make_part("Mirrors", _mirrors(shell), "car_paint", crease_deg=50),
        make_part("Plates", _plates(shell), "number_plate"),
        *_wheels(body),
    ]
    return Asset("car", tuple(parts), paints={paint: f"car_paint_{paint}" for paint in PAINTS})


def _both_sides(faces: list[Face]) -> list[Face]:
    return faces + moved(faces, (0.0, 0.0, 0.0), mirror_x=True)


def _slab(outer: Face, inner: Face) -> list[Face]:
    """A closed slab between two grids of points, shapes (rows, columns, 3); the outer one is seen counter-clockwise."""
    faces: list[Face] = []
    rows, columns = outer.shape[:2]
    for r in range(rows - 1):
        for c in range(columns - 1):
            for grid, order in ((outer, 1), (inner, -1)):
                quad = np.array([grid[r, c], grid[r, c + 1], grid[r + 1, c + 1], grid[r + 1, c]])
                faces += [quad[[0, 1, 2]][::order], quad[[0, 2, 3]][::order]]
    rim = [(0, c) for c in range(columns)] + [(r, columns - 1) for r in range(1, rows)]
    rim += [(rows - 1, c) for c in range(columns - 2, -1, -1)] + [(r, 0) for r in range(rows - 2, -1, -1)]
    for first, second in pairwise(rim):
        quad = np.array([outer[second], outer[first], inner[first], inner[second]])
        faces += [quad[[0, 1, 2]], quad[[0, 2, 3]]]
    return faces


def _end_patch(
    shell: Shell, edge: Sequence[tuple[float, float, float]], *, rear: bool, columns: int = 7, skin_m: float = _SKIN_M
) -> list[Face]:
    """A slab that follows nose or tail: for each row, upwards, its height and its range in X."""
    sign = 1.0 if rear else -1.0
    outer = np.empty((len(edge), columns, 3))
    inner = np.empty_like(outer)
    for row, (y, x0, x1) in enumerate(edge):
        reach = 0.965 * shell.end_reach(y, rear=rear)
        for column, x in enumerate(np.linspace(max(x0, -reach), min(x1, reach), columns).tolist()):
            z = shell.end_z(x, y, rear=rear)
            outer[row, column] = (x + np.sign(x) * skin_m * 0.5, y, z + sign * skin_m)
            inner[row, column] = (x, y, z - sign * 0.02)
    if not rear:
        outer, inner = outer[:, ::-1], inner[:, ::-1]
    return _slab(outer, inner)


def _side_ribbon(shell: Shell, line: Sequence[tuple[float, float]], width_m: float, *, along: bool) -> list[Face]:
    """A thin strip on both sides through (metres from the nose, height); wide in Y if it runs `along` the car."""
    grids = []
    for skin in (0.0025, -0.012):
        rows = []
        for s, y in line:
            ds, dy = (0.0, width_m / 2) if along else (width_m / 2, 0.0)
            ends = []
            for sign in (1, -1):
                x = shell.side_x(s + sign * ds, y + sign * dy)
                ends.append((x + skin, y + sign * dy, shell.z_at(s + sign * ds, x)))
            rows.append(ends)
        grids.append(np.array(rows))
    if along:
        grids = [grid[:, ::-1] for grid in grids]
    return _both_sides(_slab(grids[0], grids[1]))


def _nose_m(shell: Shell) -> tuple[float, float]:
    """Half width of the fascia and the height of the bonnet edge over it."""
    return shell.body.width_m / 2, shell.shoulder(shell.stations[0])


def _head_lamps(shell: Shell) -> list[Face]:
    """Head lamps around the corners of the nose."""
    half, top = _nose_m(shell)
    rows = [
        (top - 0.16, 0.58 * half, 0.88 * half),
        (top - 0.125, 0.52 * half, 0.93 * half),
        (top - 0.07, 0.50 * half, 0.945 * half),
        (top - 0.035, 0.56 * half, 0.92 * half),
    ]
    return _both_sides(_end_patch(shell, rows, rear=False, columns=10, skin_m=0.008))


def _tail_lamps(shell: Shell) -> list[Face]:
    """Tail lamps: tall ones on upright tails, wide ones under a boot lid."""
    half, top = shell.body.width_m / 2, shell.shoulder(shell.stations[-1])
    tall = shell.body.name in {"van", "pickup", "suv"}
    height, inner = (0.34, 0.74) if tall else (0.15, 0.50)
    rows = [(top - 0.03 - height * (1 - u), inner * half, 0.945 * half) for u in (0.0, 0.3, 0.7, 1.0)]
    rows[0] = (rows[0][0], (inner + 0.05) * half, 0.92 * half)
    return _both_sides(_end_patch(shell, rows, rear=True, columns=10, skin_m=0.008))


def _end_trim(shell: Shell) -> list[Face]:
    """Grille, lower intake, lines of bonnet and boot lid, plate recess and rear bumper insert."""
    half, top = _nose_m(shell)
    faces: list[Face] = []
    if not shell.shape.closed_nose:
        rows = [(top - 0.20, -0.38 * half, 0.38 * half), (top - 0.06, -0.46 * half, 0.46 * half)]
        faces += _end_patch(shell, rows, rear=False, columns=11)
    intake = [(0.275, -0.66 * half, 0.66 * half), (0.37, -0.58 * half, 0.58 * half)]
    faces += _end_patch(shell, intake, rear=False, columns=13)
    rear_top = shell.shoulder(shell.stations[-1])
    recess = [(rear_top - 0.33, -0.33 * half, 0.33 * half), (rear_top - 0.17, -0.36 * half, 0.36 * half)]
    faces += _end_patch(shell, recess, rear=True, columns=9, skin_m=0.003)
    faces += _end_patch(shell, [(0.31, -0.70 * half, 0.70 * half), (0.40, -0.74 * half, 0.74 * half)], rear=True)
    bumper = max(rear_top - 0.42, 0.46)
    seam = [(bumper, -0.80 * half, 0.80 * half), (bumper + 0.012, -0.80 * half, 0.80 * half)]
    return faces + _end_patch(shell, seam, rear=True, columns=13, skin_m=0.003)


def _arch_lips(shell: Shell) -> list[Face]:
    """Lips around the four wheel arches, which follow the side."""
    faces: list[Face] = []
    for axle in shell.axles:
        grids = []
        for skin in (0.006, -0.03):
            rows = []
            for angle in np.linspace(0.02, np.pi - 0.02, 25):
                ends = []
                for radius in (shell.arch_radius_m - 0.004, shell.arch_radius_m + _ARCH_LIP_M):
                    s = axle - radius * np.cos(angle)
                    y = shell.body.wheel_radius_m + radius * np.sin(angle)
                    x = shell.side_x(s, y)
                    ends.append((x + skin, y, shell.z_at(s, x)))
                rows.append(ends)
            grids.append(np.array(rows))
        faces += _slab(grids[0], grids[1])
    return _both_sides(faces)


def _door_lines(shell: Shell) -> list[float]:
    """Where doors end, in metres from the nose."""
    length = shell.body.length_m
    front = max(shell.cowl + 0.30, shell.axles[0] + shell.arch_radius_m + 0.10)
    rear = shell.axles[1] - shell.arch_radius_m - 0.04
    return [front, shell.shape.pillars[0] * length, rear]


def _seams(shell: Shell) -> list[Face]:
    """Shut lines of the doors, and the line of the sills between the arches."""
    faces: list[Face] = []
    for s in _door_lines(shell):
        heights = np.linspace(0.30, shell.shoulder(s) - 0.03, 8)
        faces += _side_ribbon(shell, [(s, float(y)) for y in heights], _SEAM_M, along=False)
    first, second = (
        axle + sign * (shell.arch_radius_m + 0.05) for axle, sign in zip(shell.axles, (1, -1), strict=True)
    )
    sill = [(float(s), 0.25) for s in np.linspace(first, second, 10)]
    return faces + _side_ribbon(shell, sill, 0.05, along=True)


def _handles(shell: Shell) -> list[Face]:
    """A handle at the rear end of each door."""
    faces: list[Face] = []
    for s in _door_lines(shell)[1:]:
        middle, y = s - 0.17, shell.shoulder(s) - 0.12
        x, z = shell.side_x(middle, y), shell.z_at(middle, shell.side_x(middle, y))
        faces += box_faces((x - 0.02, y - 0.016, z - 0.09), (x + 0.018, y + 0.016, z + 0.09))
    return _both_sides(faces)


def _plates(shell: Shell) -> list[Face]:
    """Number plates in front and behind."""
    half, high = _PLATE_M[0] / 2, _PLATE_M[1]
    front, rear = 0.39, shell.shoulder(shell.stations[-1]) - 0.305
    nose = min(shell.end_z(x, front + y, rear=False) for x in (0.0, half) for y in (0.0, high))
    tail = max(shell.end_z(x, rear + y, rear=True) for x in (0.0, half) for y in (0.0, high))
    faces = box_faces((-half, front, nose - 0.009), (half, front + high, nose + 0.03))
    return faces + box_faces((-half, rear, tail - 0.03), (half, rear + high, tail + 0.009))


def _mirrors(shell: Shell) -> list[Face]:
    """Two rounded mirrors on short arms."""
    s = shell.cowl + 0.40
    y = shell.shoulder(s) + 0.075
    inner, outer = shell.side_x(s, shell.shoulder(s)) - 0.04, shell.body.overall_width_m / 2
    span = outer - inner
    profile = [(0.0, 0.0), (0.02, 0.03), (0.06, 0.05), (0.09, 0.08), (span - 0.03, 0.078), (span - 0.008, 0.05)]
    faces = lathe_faces([*profile, (span, 0.0)], segments=14)
    faces = [face * (1.0, 0.9, 0.75) for face in faces]
    return _both_sides(moved(faces, (inner, y, s - shell.body.length_m / 2)))


def _wheels(body: CarBody) -> list[Part]:
    """Four wheels that stand on the floor: tyre, dished rim with spokes, cap."""
    radius, half = body.wheel_radius_m, _TYRE_WIDTH_M / 2
    rim = radius * 0.68
    tyre_profile = [
        (-half, rim),
        (-half, radius - 0.03),
        (-half + 0.03, radius),
        (half - 0.03, radius),
        (half, radius - 0.03),
        (half, rim),
        (half - 0.02, rim - 0.012),
    ]
    tyre = lathe_faces([(-half, 0.0), *tyre_profile, (half - 0.10, rim - 0.02), (half - 0.10, 0.0)], segments=36)
    lip = lathe_faces(
        [(half - 0.06, rim - 0.03), (half - 0.004, rim - 0.008), (half, rim), (half - 0.02, rim + 0.003)], segments=36
    )
    hub = lathe_faces(
        [(half - 0.1, 0.07), (half - 0.018, 0.062), (half - 0.006, 0.04), (half - 0.006, 0.0)], segments=20
    )
    spokes: list[Face] = []
    for angle in np.arange(10) * (2 * np.pi / 10):
        spoke = box_faces((half - 0.045, 0.04, -0.022), (half - 0.014, rim - 0.012, 0.022))
        cos, sin = np.cos(angle), np.sin(angle)
        turn = np.array([(1, 0, 0), (0, cos, sin), (0, -sin, cos)])
        spokes += [face @ turn for face in spoke]
    front = -body.length_m / 2 + body.front_overhang_m
    x = body.width_m / 2 - half - 0.012
    rubber: list[Face] = []
    metal: list[Face] = []
    for z in (front, front + body.wheelbase_m):
        for sign in (1, -1):
            at = (sign * x, radius, z)
            rubber += moved(tyre, at, mirror_x=sign < 0)
            metal += moved([*lip, *hub, *spokes], at, mirror_x=sign < 0)
    return [
        make_part("Tyres", rubber, "tyre", crease_deg=40),
        make_part("Rims", metal, "rim", crease_deg=35),
    ]
