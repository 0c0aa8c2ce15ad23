"""Car bodies: a lofted shell with glass, lamps, trim and the holders of plates, on four wheels."""
# Over 300 lines: a body's glass, lamps, trim and plate holders are cut from one shell.

from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.car_interior import interior
from garage2usd.assets.car_shell import SHAPES, Contour, Shell, both_sides, grid_quads, needed
from garage2usd.assets.faces import box_faces, lathe_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.config.vehicles import PAINTS, CarBody

__all__ = ["PLATE_M", "car", "plate_places"]

_TYRE_WIDTH_M = 0.21
PLATE_M = (0.52, 0.11)
"""Width and height of a number plate."""
_PLATE_LIFT_M = 0.0012
"""Of a plate over its holder."""
_HOLDER_RIM_M = 0.006
_SKIN_M = 0.006
_HOUSING_SKIN_M = 0.008
_LENS_SKIN_M = 0.012
_SLAB_M = 0.012
_ARCH_LIP_M = 0.03
_SEAM_M = 0.007
_COLUMN_M = 0.01
"""Least width of the columns at the ends of what is put on nose or tail."""
_ROW_M = 0.006
_TURN_TOLERANCE_M = 0.0012
_FLATNESS_M = 0.001

Faces = NDArray[np.float64]
"""float64, shape (faces, corners, 3)."""
Place = Callable[[Contour], float]
"""Where along a level cut through nose or tail, in metres from its middle."""
Row = tuple[float, Place, Place]
"""Height, and from where to where."""


@lru_cache(maxsize=32)
def car(body: CarBody) -> Asset:
    """A parked car that takes every paint; origin in the middle of its footprint on the floor, nose to -Z."""
    shell = Shell(body, SHAPES[body.name])
    regions = shell.regions()
    (housings, lights), tail = _head_lamps(shell), _TailLamps(shell)
    parts = [
        make_part("Body", _flat(regions["body"]), "car_paint", collider=Collider.CONVEX_HULL, crease_deg=32),
        make_part("Cabin", _flat(regions["cabin"]), "car_paint", collider=Collider.CONVEX_HULL, crease_deg=40),
        make_part("Glass", _flat(regions["glass"]), "glass", crease_deg=38),
        make_part("Pillars", _flat(regions["pillar"]), "trim_black", crease_deg=38),
        make_part("Underbody", _flat(regions["under"]), "trim_black"),
        make_part("HeadLamps", _flat(lights), "lamp_front", crease_deg=50),
        make_part("TailLamps", _flat(tail.lenses()), "lamp_rear", crease_deg=50),
        make_part("ReverseLamps", _flat(tail.reverse_lamps()), "lamp_front", crease_deg=50),
        make_part("LampHousings", _flat(np.concatenate([housings, tail.housings()])), "lamp_housing", crease_deg=50),
        make_part("Trim", _flat(_end_trim(shell)), "trim_black"),
        make_part("Bright", _flat(_bright_trim(shell)), "chrome"),
        make_part("Arches", _flat(_arch_lips(shell)), "trim_black", crease_deg=50),
        make_part("Seams", _flat(_seams(shell)), "trim_black"),
        make_part("Handles", _flat(_handles(shell)), "car_paint"),
        make_part("Mirrors", _flat(_mirrors(shell)), "car_paint", crease_deg=50),
        *interior(shell),
        *_plate_holders(shell),
        *_wheels(body),
    ]
    return Asset(tuple(parts), paints={paint: f"car_paint_{paint}" for paint in PAINTS})


def plate_places(body: CarBody) -> list[tuple[float, float, float]]:
    """Where the number plates of a car are, in its axes.

    Returns
    -------
    list
        Of the front plate and of the rear one: the way along Z that it looks, -1 or 1, and Y and Z of its middle in
        metres.
    """
    return _plate_places(Shell(body, SHAPES[body.name]))


def _flat(quads: Faces) -> list[Face]:
    """Quads whose corners lie in one plane as they are, others as two triangles."""
    a, b, c, d = quads.transpose(1, 0, 2)
    across = np.cross(c - a, d - b)
    size = np.linalg.norm(across, axis=1)
    off = np.abs(((b - a) * across).sum(axis=1)) / np.where(size > 0, size, 1.0)
    is_flat = (off < _FLATNESS_M) & (size > 0)
    bent = quads[~is_flat]
    return [*quads[is_flat], *bent[:, [0, 1, 2]], *bent[:, [0, 2, 3]]]


def _x(x_m: float) -> Place:
    return lambda contour: contour.arc_at_x(x_m)


def _depth(depth_m: float) -> Place:
    return lambda contour: contour.arc_at_depth(depth_m)


def _slab(outer: NDArray[np.float64], inner: NDArray[np.float64]) -> Faces:
    """A closed slab between two grids of points, shapes (rows, columns, 3); the outer one is seen counter-clockwise."""
    quads = [grid_quads(outer).reshape(-1, 4, 3), grid_quads(inner).reshape(-1, 4, 3)[:, ::-1]]
    far, near = (np.concatenate([g[0], g[1:, -1], g[-1, -2::-1], g[-2::-1, 0]]) for g in (outer, inner))
    quads.append(np.stack([far[1:], far[:-1], near[:-1], near[1:]], axis=1))
    return np.concatenate(quads)


def _end_patch(shell: Shell, rows: Sequence[Row], *, rear: bool, skin_m: float = _SKIN_M) -> Faces:
    """A slab that follows nose or tail around its corners; its rows go upwards."""
    low, high = rows[0][0], rows[-1][0]
    wide = shell.contour(high, rear=rear)
    around_corner = rows[-1][2](wide) > wide.corner_m
    between = shell.end_heights(rear=rear, around_corner=around_corner)
    outline = np.array([y for y, _, _ in rows])
    apart = np.abs(between[:, None] - outline).min(axis=1) > _ROW_M
    heights = np.sort(np.concatenate([outline, between[apart & (between > low) & (between < high)]]))
    contours = [shell.contour(y, rear=rear) for y in heights.tolist()]
    ends = [_ends_at(rows, y, contour) for y, contour in zip(heights.tolist(), contours, strict=True)]
    turns = _turns(contours[len(heights) // 2], min(f for f, _ in ends), max(e for _, e in ends), skin_m)
    grids = []
    for skin in (skin_m, -_SLAB_M):
        grid = np.empty((len(heights), len(turns) + 2, 3))
        for row, (contour, (first, last)) in enumerate(zip(contours, ends, strict=True)):
            arcs = np.array([first, *np.clip(contour.arc_at_points(turns), first, last), last])
            grid[row, :, [0, 2]] = contour.place(arcs, skin).T
            grid[row, :, 1] = heights[row]
        grids.append(grid if rear else grid[:, ::-1])
    return _slab(grids[0], grids[1])


def _ends_at(rows: Sequence[Row], y: float, contour: Contour) -> tuple[float, float]:
    """From where to where a patch goes along a contour at a height, between the rows below and above."""
    above = min(next(i for i, row in enumerate(rows) if row[0] >= y), len(rows) - 1)
    low, high = rows[max(above - 1, 0)], rows[above]
    share = (y - low[0]) / (high[0] - low[0]) if high[0] > low[0] else 1.0
    first = low[1](contour) * (1 - share) + high[1](contour) * share
    return first, low[2](contour) * (1 - share) + high[2](contour) * share


def _turns(contour: Contour, first: float, last: float, skin_m: float) -> NDArray[np.int64]:
    """Numbers of a contour's points between two places at which a patch needs columns so as not to cut corners."""
    numbers = np.arange(1 - len(contour.line), len(contour.line))
    arcs = contour.arc_at_points(numbers)
    numbers = numbers[(arcs > first + _COLUMN_M) & (arcs < last - _COLUMN_M)]
    arcs = np.array([first, *contour.arc_at_points(numbers), last])
    kept = needed(arcs, contour.place(arcs, 0.0), skin_m / 4)
    chosen: NDArray[np.int64] = numbers[np.array(kept[1:-1], dtype=int) - 1]
    return chosen


def _ribbon(shell: Shell, line: Sequence[tuple[float, float]], width_m: float) -> Faces:
    """A thin strip on both sides along places of the shell's surface: (metres from the nose, point of the ring)."""
    places = np.array([shell.surface(s, t) for s, t in line])
    kept = needed(np.sum(line, axis=1), places, _TURN_TOLERANCE_M)
    places, normals = places[kept], np.array([shell.normal(*line[i]) for i in kept])
    across = np.cross(np.gradient(places, axis=0), normals)
    across *= width_m / 2 / np.linalg.norm(across, axis=1, keepdims=True)
    grids = [
        np.stack([places + normals * lift + side for side in (-across, across)], axis=1) for lift in (0.003, -0.01)
    ]
    return both_sides(_slab(grids[0], grids[1]))


def _polygon_patch(shell: Shell, middle: tuple[float, float], radius_m: float, *, rear: bool, skin_m: float) -> Faces:
    """A flat disc of eight corners on nose or tail, around (x, y)."""
    x, y = middle
    wide, narrow = radius_m, radius_m * 0.45
    rows = [
        (y + dy, _x(x - dx), _x(x + dx))
        for dy, dx in ((-wide, narrow), (-narrow, wide), (narrow, wide), (wide, narrow))
    ]
    return _end_patch(shell, rows, rear=rear, skin_m=skin_m)


def _head_lamps(shell: Shell) -> tuple[Faces, Faces]:
    """Head lamps around the corners of the nose: dark housings, and two reflectors with a strip of daytime light."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=False) - 0.022
    housing = [
        (top - 0.135, _x(0.60 * half), _depth(0.17)),
        (top - 0.115, _x(0.53 * half), _depth(0.24)),
        (top - 0.055, _x(0.50 * half), _depth(0.33)),
        (top, _x(0.52 * half), _depth(0.37)),
    ]
    strip = [(top - 0.022, _x(0.535 * half), _depth(0.33)), (top - 0.008, _x(0.545 * half), _depth(0.34))]
    lights = [_end_patch(shell, strip, rear=False, skin_m=_LENS_SKIN_M)]
    for share in (0.61, 0.735):
        lens = (share * half, top - 0.077)
        lights.append(_polygon_patch(shell, lens, 0.040, rear=False, skin_m=_LENS_SKIN_M))
    housings = both_sides(_end_patch(shell, housing, rear=False, skin_m=_HOUSING_SKIN_M))
    return housings, both_sides(np.concatenate(lights))


class _TailLamps:
    """Tail lamps in dark housings, tall on upright tails, else wide: red lenses with a reversing lamp between."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        half, top = shell.body.width_m / 2, shell.end_top(rear=True) - 0.03
        tall = shell.shape.upright_tail
        self._height, self._inner = (0.36, 0.77 * half) if tall else (0.155, 0.48 * half)
        self._wrap, self._top = shell.shape.bow_m[1] + (0.12 if tall else 0.20), top

    def _patch(self, low: float, high: float, edge_m: float, *, skin_m: float, inner_m: float = 0.0) -> Faces:
        """Part of the lamps between two shares of their height, an edge's width within their outline."""
        first, last = self._top - self._height + edge_m, self._top - edge_m
        inner, wrap = self._inner + edge_m + inner_m, self._wrap - edge_m
        rows = [
            (first + (last - first) * u, _x(inner + 0.05 * (1 - u)), _depth(wrap - 0.05 * (1 - u))) for u in (low, high)
        ]
        return both_sides(_end_patch(self._shell, rows, rear=True, skin_m=skin_m))

    def housings(self) -> Faces:
        return self._patch(0.0, 1.0, 0.0, skin_m=_HOUSING_SKIN_M)

    def lenses(self) -> Faces:
        low, high = (0.34, 0.48) if self._shell.shape.upright_tail else (0.20, 0.44)
        bands = [self._patch(*band, 0.012, skin_m=_LENS_SKIN_M) for band in ((0.0, low), (high, 1.0))]
        half, y = self._shell.body.width_m / 2, self._shell.bumper_top(rear=True) - 0.045
        reflector = [(y, _x(0.66 * half), _x(0.82 * half)), (y + 0.028, _x(0.66 * half), _x(0.82 * half))]
        return np.concatenate([*bands, both_sides(_end_patch(self._shell, reflector, rear=True))])

    def reverse_lamps(self) -> Faces:
        low, high = (0.375, 0.445) if self._shell.shape.upright_tail else (0.245, 0.395)
        return self._patch(low, high, 0.012, skin_m=_LENS_SKIN_M)


def _across(low: float, high: float, below_m: float, above_m: float) -> list[Row]:
    """Two rows that reach as far to the left as to the right."""
    return [(low, _x(-below_m), _x(below_m)), (high, _x(-above_m), _x(above_m))]


def _end_trim(shell: Shell) -> Faces:
    """Grille, air intakes, plate recess, lower edges of the bumpers, lines of bonnet and tailgate."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=False)
    bumper = shell.bumper_top(rear=False)
    faces: list[Faces] = []
    if shell.shape.closed_nose:
        faces.append(_end_patch(shell, _across(top - 0.075, top - 0.045, 0.485 * half, 0.50 * half), rear=False))
    else:
        low = max(top - 0.30, bumper + 0.055)
        faces.append(_end_patch(shell, _across(low, top - 0.045, 0.36 * half, 0.455 * half), rear=False))
    faces.append(_end_patch(shell, _across(0.275, 0.375, 0.60 * half, 0.52 * half), rear=False))
    pocket = [(0.29, _x(0.66 * half), _depth(0.17)), (0.40, _x(0.70 * half), _depth(0.20))]
    faces.append(both_sides(_end_patch(shell, pocket, rear=False)))
    faces.append(
        _end_patch(shell, _across(top - 0.014, top - 0.007, 0.66 * half, 0.66 * half), rear=False, skin_m=0.003)
    )

    rear_top, bumper = shell.end_top(rear=True), shell.bumper_top(rear=True)
    plate = _rear_plate_m(shell)
    faces.append(
        _end_patch(shell, _across(plate - 0.03, plate + PLATE_M[1] + 0.03, 0.33 * half, 0.36 * half), rear=True)
    )
    valance = [(0.30, _depth_left(0.30), _depth(0.30)), (0.385, _depth_left(0.34), _depth(0.34))]
    faces.append(_end_patch(shell, valance, rear=True))
    gate = bumper + 0.03
    faces.append(_end_patch(shell, _across(gate, gate + 0.012, 0.70 * half, 0.70 * half), rear=True, skin_m=0.003))
    heights = np.linspace(gate + 0.02, rear_top - 0.012, 4)
    seam = [(float(y), _x(0.715 * half), _x(0.715 * half + _SEAM_M)) for y in heights]
    faces.append(both_sides(_end_patch(shell, seam, rear=True, skin_m=0.003)))
    return np.concatenate(faces)


def _depth_left(depth_m: float) -> Place:
    return lambda contour: -contour.arc_at_depth(depth_m)


def _rear_plate_m(shell: Shell) -> float:
    """Height of the lower edge of the rear plate."""
    return max(shell.end_top(rear=True) - 0.31, shell.bumper_top(rear=True) + 0.075)


def _bright_trim(shell: Shell) -> Faces:
    """Slats of the grille, the strip over the rear plate, badges."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=False)
    faces: list[Faces] = []
    if not shell.shape.closed_nose:
        low, high = max(top - 0.30, shell.bumper_top(rear=False) + 0.055), top - 0.045
        for share in (0.2, 0.5, 0.8):
            y, reach = low + (high - low) * share, (0.34 + 0.095 * share) * half
            faces.append(_end_patch(shell, _across(y - 0.006, y + 0.006, reach, reach), rear=False, skin_m=0.009))
    strip = _rear_plate_m(shell) + PLATE_M[1] + 0.04
    faces.append(_end_patch(shell, _across(strip, strip + 0.02, 0.30 * half, 0.30 * half), rear=True, skin_m=0.009))
    faces.append(
        _polygon_patch(
            shell, (0.0, top - 0.1 if shell.shape.closed_nose else top - 0.14), 0.045, rear=False, skin_m=0.014
        )
    )
    faces.append(_polygon_patch(shell, (0.0, strip + 0.065), 0.035, rear=True, skin_m=0.008))
    return np.concatenate(faces)


def _arch_lips(shell: Shell) -> Faces:
    """Lips around the four wheel arches, which follow the side."""
    angles = np.linspace(0.02, np.pi - 0.02, 17).tolist()
    faces: list[Faces] = []
    for axle in shell.axles:
        outer, inner = np.empty((len(angles), 2, 3)), np.empty((len(angles), 2, 3))
        for row, angle in enumerate(angles):
            for column, radius in enumerate((shell.arch_radius_m - 0.008, shell.arch_radius_m + _ARCH_LIP_M)):
                y = shell.body.wheel_radius_m + radius * np.sin(angle)
                x, z = shell.side_place(axle - radius * np.cos(angle), y)
                outer[row, column], inner[row, column] = (x + 0.006, y, z), (x - 0.03, y, z)
        faces.append(_slab(outer, inner))
    return both_sides(np.concatenate(faces))


def _door_lines(shell: Shell) -> list[float]:
    """Where doors end, in metres from the nose."""
    front = max(shell.cowl + 0.30, shell.axles[0] + shell.arch_radius_m + 0.10)
    return [front, shell.shape.pillars[0] * shell.body.length_m, shell.axles[1] - shell.arch_radius_m - 0.04]


def _seams(shell: Shell) -> Faces:
    """Shut lines of doors and bonnet, the strip under the side windows, and the sills between the arches."""
    up = (4.8, 5.0, 6.0, 7.0, 8.0, 9.0, 9.85)
    faces = [_ribbon(shell, [(s, t) for t in up], _SEAM_M) for s in _door_lines(shell)]
    stations = shell.stations
    bonnet = stations[(stations > stations[0] + 0.05) & (stations < shell.cowl - 0.02)]
    faces.append(_ribbon(shell, [(s, 11.15) for s in bonnet.tolist()], _SEAM_M))
    first, last = shell.side_window
    window = stations[(stations >= first - 1e-3) & (stations <= last + 1e-3)]
    faces.append(_ribbon(shell, [(s, 10.0) for s in window.tolist()], 0.022))
    reach = shell.arch_radius_m + 0.05
    sill = np.linspace(shell.axles[0] + reach, shell.axles[1] - reach, 5)
    faces.append(_ribbon(shell, [(s, 4.75) for s in sill.tolist()], 0.06))
    return np.concatenate(faces)


def _handles(shell: Shell) -> Faces:
    """A handle at the rear end of each door."""
    faces: list[Faces] = []
    for s in _door_lines(shell)[1:]:
        y = shell.shoulder(s) - 0.12
        x, z = shell.side_place(s - 0.17, y)
        faces.append(np.array(box_faces((x - 0.02, y - 0.016, z - 0.09), (x + 0.018, y + 0.016, z + 0.09))))
    return both_sides(np.concatenate(faces))


def _plate_holders(shell: Shell) -> list[Part]:
    """What the number plates in front and behind are on, a little larger than they are."""
    half, high = PLATE_M[0] / 2 + _HOLDER_RIM_M, PLATE_M[1] / 2 + _HOLDER_RIM_M
    holder = np.array(box_faces((-half, -high, -0.03), (half, high, 0.0)))
    faces = [
        holder * (toward, 1.0, toward) + (0.0, y, z - toward * _PLATE_LIFT_M) for toward, y, z in _plate_places(shell)
    ]
    return [make_part("PlateHolders", np.concatenate(faces), "trim_black")]


def _plate_places(shell: Shell) -> list[tuple[float, float, float]]:
    """Of the plates in front and behind: -1 or 1 by the end where it is, and Y and Z of its middle."""
    half, high = PLATE_M[0] / 2, PLATE_M[1]
    places = []
    for rear, low in ((False, 0.385), (True, _rear_plate_m(shell))):
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
    """Two rounded mirrors on short arms."""
    s = shell.cowl + 0.40
    y = shell.shoulder(s) + 0.075
    inner, outer = shell.side_place(s, shell.shoulder(s))[0] - 0.04, shell.body.overall_width_m / 2
    span = outer - inner
    profile = [(0.0, 0.0), (0.02, 0.03), (0.06, 0.05), (0.09, 0.08), (span - 0.025, 0.076)]
    faces = np.array(lathe_faces([*profile, (span, 0.0)], segments=10)) * (1.0, 0.9, 0.75)
    return both_sides(faces + np.array((inner, y, s - shell.body.length_m / 2)))


def _wheels(body: CarBody) -> list[Part]:
    """Four wheels that stand on the floor: tyre, dished rim with spokes, cap."""
    radius, half = body.wheel_radius_m, _TYRE_WIDTH_M / 2
    rim = radius * 0.69
    tread = [(-half, radius), (half - 0.03, radius), (half, radius - 0.03), (half, rim)]
    tyre = lathe_faces([(-half, 0.0), *tread, (half - 0.10, rim - 0.02), (half - 0.10, 0.0)], segments=26)
    lip = lathe_faces(
        [(half - 0.05, rim - 0.03), (half - 0.002, rim - 0.008), (half + 0.001, rim + 0.004)], segments=24
    )
    hub = lathe_faces(
        [(half - 0.08, 0.075), (half - 0.016, 0.066), (half - 0.004, 0.04), (half - 0.004, 0.0)], segments=12
    )
    # a spoke is a wedge: its face, and two sides to an edge behind
    (near, far), (back, face) = (0.04, rim - 0.012), (half - 0.045, half - 0.012)
    left, right = ([(face, far, z), (face, near, z)] for z in (-0.02, 0.02))
    edge = [(back, far, 0.0), (back, near, 0.0)]
    spoke = np.array([[*a, *b[::-1]] for a, b in ((right, left), (left, edge), (edge, right))])
    spokes = []
    for angle in np.arange(10) * (2 * np.pi / 10) + np.tile((0.09, -0.09), 5):
        cos, sin = np.cos(angle), np.sin(angle)
        spokes.append(spoke @ np.array([(1, 0, 0), (0, cos, sin), (0, -sin, cos)]))
    metal = np.concatenate([lip, hub, *spokes])
    front = -body.length_m / 2 + body.front_overhang_m
    hubs = [(body.width_m / 2 - half - 0.012, radius, z) for z in (front, front + body.wheelbase_m)]
    rims = make_part("Rims", both_sides(np.concatenate([metal + at for at in hubs])), "rim", crease_deg=38)
    tyres = [
        make_part(f"{end}{side}Tyre", faces, "tyre", collider=Collider.CONVEX_HULL, crease_deg=38)
        for end, at in zip(("Front", "Rear"), hubs, strict=True)
        for side, faces in zip(("Right", "Left"), np.split(both_sides(np.array(tyre) + at), 2), strict=True)
    ]
    return [rims, *tyres]
