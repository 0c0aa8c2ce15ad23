"""Car bodies: a lofted shell with glass, lamps and plates, on four wheels."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from garage2usd.assets.mesh import Asset, Collider, Face, Part, box_faces, lathe_faces, make_part, moved
from garage2usd.config.vehicles import PAINTS, CarBody

__all__ = ["car"]

_GROUND_CLEARANCE_M = 0.17
_ARCH_GAP_M = 0.045
_TYRE_WIDTH_M = 0.21
_PLATE_M = (0.46, 0.12)
_HALF_PILLAR_M = 0.05
_MIN_STATION_STEP_M = 0.008
# shares of the length, and bands of faces between ring points, see `_Shell._ring`
_HEAD_LAMPS, _HEAD_LAMP_BAND = (0.004, 0.075), (6, 7)
_TAIL_LAMPS, _TAIL_LAMP_BAND = (0.955, 0.999), (5, 6, 7)
_SILL, _WINDOW, _ROOF_EDGE = 1, 8, 10


@dataclass(frozen=True)
class _Shape:
    """Side view of a body as shares of its length (from the nose) and height.

    Attributes
    ----------
    shoulder
        (share of length, share of height) of bonnet, belt line and boot lid.
    roof
        The same of windscreen foot, roof front, roof rear, rear window foot.
    tumblehome
        How much narrower the roof is than the belt, as a share of the half width.
    nose, tail
        Half width at the ends as a share of the largest.
    """

    shoulder: tuple[tuple[float, float], ...]
    roof: tuple[tuple[float, float], ...]
    tumblehome: float
    nose: float
    tail: float


_SHAPES = {
    "hatchback": _Shape(
        shoulder=(
            (0.0, 0.44),
            (0.02, 0.505),
            (0.12, 0.575),
            (0.27, 0.635),
            (0.6, 0.65),
            (0.9, 0.66),
            (0.985, 0.64),
            (1.0, 0.56),
        ),
        roof=((0.26, 0.0), (0.44, 1.0), (0.82, 0.965), (0.965, 0.0)),
        tumblehome=0.24,
        nose=0.80,
        tail=0.87,
    ),
    "saloon": _Shape(
        shoulder=(
            (0.0, 0.43),
            (0.02, 0.50),
            (0.12, 0.575),
            (0.28, 0.635),
            (0.6, 0.655),
            (0.85, 0.69),
            (0.985, 0.675),
            (1.0, 0.57),
        ),
        roof=((0.275, 0.0), (0.44, 1.0), (0.66, 0.985), (0.845, 0.0)),
        tumblehome=0.26,
        nose=0.80,
        tail=0.84,
    ),
    "suv": _Shape(
        shoulder=(
            (0.0, 0.44),
            (0.015, 0.52),
            (0.10, 0.60),
            (0.25, 0.635),
            (0.6, 0.65),
            (0.9, 0.66),
            (0.985, 0.64),
            (1.0, 0.54),
        ),
        roof=((0.245, 0.0), (0.40, 1.0), (0.86, 0.975), (0.985, 0.0)),
        tumblehome=0.20,
        nose=0.84,
        tail=0.90,
    ),
}


def car(body: CarBody) -> Asset:
    """A parked car that takes every paint; origin in the middle of its footprint on the floor, nose to -Z."""
    shell = _Shell(body, _SHAPES[body.name])
    regions = shell.regions()
    parts = [
        make_part("Body", regions["body"], "car_paint", collider=Collider.CONVEX_HULL, crease_deg=38),
        make_part("Glass", regions["glass"], "glass", crease_deg=38),
        make_part("Underbody", regions["under"], "trim_black"),
        make_part("HeadLamps", regions["lamp_front"], "lamp_front", crease_deg=50),
        make_part("TailLamps", regions["lamp_rear"], "lamp_rear", crease_deg=50),
        make_part("Trim", shell.trim(), "trim_black"),
        make_part("Mirrors", shell.mirrors(), "car_paint", crease_deg=50),
        make_part("Plates", shell.plates(), "number_plate"),
        *_wheels(body),
    ]
    return Asset("car", tuple(parts), paints={paint: f"car_paint_{paint}" for paint in PAINTS})


class _Shell:
    """The body as rings of points along the car, each from the middle of the floor pan over the side to the roof."""

    def __init__(self, body: CarBody, shape: _Shape) -> None:
        self.body = body
        length, height = body.length_m, body.height_m
        self._shoulder = PchipInterpolator(
            [s * length for s, _ in shape.shoulder], [h * height for _, h in shape.shoulder]
        )
        self.cowl, self.roof_front, self.roof_rear, self.deck = (share * length for share, _ in shape.roof)
        low, high = (self._shoulder(self.cowl), self._shoulder(self.deck))
        middle = (self.roof_front + self.roof_rear) / 2
        self._roof = PchipInterpolator(
            [self.cowl, self.roof_front - 0.12, self.roof_front + 0.12, middle, self.roof_rear, self.deck],
            [low, shape.roof[1][1] * height - 0.075, height - 0.025, height, shape.roof[2][1] * height - 0.01, high],
        )
        half = body.width_m / 2
        self._width = PchipInterpolator(
            np.array([0.0, 0.02, 0.12, 0.3, 0.7, 0.93, 0.985, 1.0]) * length,
            np.array([shape.nose * 0.93, shape.nose, 0.955, 1.0, 1.0, 0.965, shape.tail, shape.tail * 0.95]) * half,
        )
        self.tumblehome = shape.tumblehome
        self.axles = (body.front_overhang_m, body.front_overhang_m + body.wheelbase_m)
        self.stations = self._make_stations()
        self.rings = np.array([self._ring(s) for s in self.stations])

    def _make_stations(self) -> NDArray[np.float64]:
        """Distances from the nose, close together around wheel arches and windows."""
        length = self.body.length_m
        fixed = [0.0, 0.02 * length, 0.06 * length, length * 0.94, length * 0.98, length]
        fixed += [self.cowl, self.roof_front - 0.12, self.roof_front + 0.12, self.roof_rear, self.deck]
        reach = self.body.wheel_radius_m + _ARCH_GAP_M
        for axle in self.axles:
            angles = np.linspace(0, np.pi, 15)
            fixed += (axle - (reach + 0.001) * np.cos(angles)).tolist()
            fixed += [axle - reach - 0.012, axle + reach + 0.012]
        regular = np.linspace(0, length, 34)
        stations = np.unique(np.round(np.concatenate([fixed, regular]), 4))
        apart: NDArray[np.float64] = stations[np.concatenate(([True], np.diff(stations) > _MIN_STATION_STEP_M))]
        return apart

    def _bottom(self, s: float) -> float:
        """Height of the sill: the floor pan, raised over the wheels."""
        length = self.body.length_m
        lift = 0.05 * max(0.0, 1 - s / (0.08 * length)) + 0.09 * max(0.0, 1 - (length - s) / (0.07 * length))
        level = _GROUND_CLEARANCE_M + lift
        reach = self.body.wheel_radius_m + _ARCH_GAP_M
        for axle in self.axles:
            inside = reach**2 - (s - axle) ** 2
            if inside > 0:
                level = max(level, self.body.wheel_radius_m + float(np.sqrt(inside)))
        return level

    def _ring(self, s: float) -> NDArray[np.float64]:
        """Half of a cross-section as (x, y), x >= 0: 0-2 pan and sill, 3-7 side, 8-9 window, 10-13 roof."""
        width, shoulder, bottom = float(self._width(s)), float(self._shoulder(s)), self._bottom(s)
        inside_cabin = self.cowl < s < self.deck
        roof = max(float(self._roof(s)), shoulder + 0.012) if inside_cabin else shoulder + 0.012
        share = np.clip((roof - shoulder) / (self.body.height_m * 0.34), 0.0, 1.0)
        top = width * (0.93 - (self.tumblehome - 0.03) * share)
        side = shoulder - bottom
        return np.array(
            [
                (0.0, bottom + 0.02),
                (width * 0.80, bottom + 0.02),
                (width * 0.955, bottom),
                (width * 0.975, bottom + side * 0.12),
                (width * 0.992, bottom + side * 0.35),
                (width, bottom + side * 0.58),
                (width * 0.985, bottom + side * 0.82),
                (width * 0.955, bottom + side * 0.95),
                (width * 0.925, shoulder),
                (top * 0.985, shoulder + (roof - shoulder) * 0.80),
                (top * 0.945, shoulder + (roof - shoulder) * 0.91),
                (top * 0.84, shoulder + (roof - shoulder) * 0.972),
                (top * 0.50, shoulder + (roof - shoulder) * 0.996),
                (0.0, roof),
            ]
        )

    def regions(self) -> dict[str, list[Face]]:
        """The faces of the shell by what they are made of, both sides."""
        found: dict[str, list[Face]] = {name: [] for name in ("body", "glass", "under", "lamp_front", "lamp_rear")}
        z = self.stations - self.body.length_m / 2
        for i in range(len(z) - 1):
            for j in range(self.rings.shape[1] - 1):
                (x0, y0), (x1, y1) = self.rings[i, j], self.rings[i, j + 1]
                (x2, y2), (x3, y3) = self.rings[i + 1, j + 1], self.rings[i + 1, j]
                quad = np.array([(x0, y0, z[i]), (x1, y1, z[i]), (x2, y2, z[i + 1]), (x3, y3, z[i + 1])])
                self._add(found[self._region(i, j)], quad)
        for index, forward in ((0, True), (-1, False)):
            ring, at = self.rings[index], z[index]
            upper = np.array([(x, y, at) for x, y in ring])
            mirrored = upper[-2:0:-1] * (-1.0, 1.0, 1.0)
            cap = np.concatenate([upper, mirrored])
            found["body"].append(cap[::-1] if forward else cap)
        return found

    @staticmethod
    def _add(faces: list[Face], quad: Face) -> None:
        """A quad of the right side and its mirror image, as triangles, which stay flat."""
        for triangle in (quad[[0, 1, 2]], quad[[0, 2, 3]]):
            faces.append(triangle)
            faces.append((triangle * (-1.0, 1.0, 1.0))[::-1])

    def _region(self, i: int, j: int) -> str:
        """What the face between stations i and i + 1 and ring points j and j + 1 is made of."""
        s = (self.stations[i] + self.stations[i + 1]) / 2
        share = s / self.body.length_m
        if j <= _SILL:
            return "under"
        if _HEAD_LAMPS[0] < share < _HEAD_LAMPS[1] and j in _HEAD_LAMP_BAND:
            return "lamp_front"
        if _TAIL_LAMPS[0] < share < _TAIL_LAMPS[1] and j in _TAIL_LAMP_BAND:
            return "lamp_rear"
        windscreen = self.cowl + 0.03 < s < self.roof_front + 0.02
        rear_window = self.roof_rear + 0.04 < s < self.deck - 0.05
        pillar_b = self.roof_front + 0.42 * (self.roof_rear - self.roof_front)
        side_window = self.cowl + 0.42 < s < self.deck - 0.30 and abs(s - pillar_b) > _HALF_PILLAR_M
        glass = (j >= _ROOF_EDGE and (windscreen or rear_window)) or (j == _WINDOW and side_window)
        return "glass" if glass else "body"

    def trim(self) -> list[Face]:
        """Grille, lower intake, and strips under both bumpers."""
        nose, tail = -self.body.length_m / 2, self.body.length_m / 2
        width = float(self._width(0.0))
        faces = box_faces((-width * 0.55, 0.42, nose - 0.006), (width * 0.55, 0.52, nose + 0.05))
        faces += box_faces((-width * 0.75, 0.24, nose - 0.006), (width * 0.75, 0.34, nose + 0.05))
        faces += box_faces((-width * 0.75, 0.28, tail - 0.05), (width * 0.75, 0.37, tail + 0.006))
        return faces

    def plates(self) -> list[Face]:
        """Number plates in front and behind."""
        half, high = _PLATE_M[0] / 2, _PLATE_M[1]
        nose, tail = -self.body.length_m / 2, self.body.length_m / 2
        faces = box_faces((-half, 0.35, nose - 0.012), (half, 0.35 + high, nose + 0.02))
        faces += box_faces((-half, 0.50, tail - 0.02), (half, 0.50 + high, tail + 0.012))
        return faces

    def mirrors(self) -> list[Face]:
        """Two rounded mirrors on short arms."""
        s = self.cowl + 0.36
        z, y = s - self.body.length_m / 2, float(self._shoulder(s)) + 0.07
        inner, outer = float(self._width(s)) * 0.90, self.body.overall_width_m / 2
        profile = [(0.0, 0.0), (0.02, 0.055), (0.06, 0.075), (outer - inner - 0.03, 0.07), (outer - inner, 0.03)]
        faces = lathe_faces([*profile, (outer - inner, 0.0)], segments=12)
        right = moved(faces, (inner, y, z))
        return right + [(face * (-1.0, 1.0, 1.0))[::-1] for face in right]


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
