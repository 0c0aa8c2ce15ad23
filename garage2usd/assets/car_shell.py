"""The shell of a car body: rings of points lofted along the car, and places on its surface."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from garage2usd.assets.mesh import Face
from garage2usd.config.vehicles import CarBody

__all__ = ["SHAPES", "Shape", "Shell"]

_GROUND_CLEARANCE_M = 0.18
_ARCH_GAP_M = 0.045
_HALF_PILLAR_M = 0.045
_MIN_STATION_STEP_M = 0.008
_END_INSET_M = 0.012
"""Room for plates and lamps between the shell's ends and the footprint."""
_BONNET_CROWN_M = 0.045
_END_DEPTH_M = 0.32
_BED_FLOOR_M = 0.82
# points of a ring, see `Shell._ring`: faces below the sill are floor pan, one band is side window
_SILL, _BELT, _ROOF_EDGE = 4, 10, 12
_SIDE_HEIGHT = (0.0, 0.12, 0.35, 0.58, 0.80, 0.94, 1.0)
_SIDE_WIDTH = (0.955, 0.978, 0.993, 1.0, 0.988, 0.962, 0.925)
_CABIN = np.array([(0.985, 0.80), (0.945, 0.91), (0.84, 0.968), (0.62, 0.99), (0.32, 0.998), (0.0, 1.0)])
_BONNET = np.array([(0.94, 0.15), (0.82, 0.40), (0.64, 0.66), (0.43, 0.86), (0.21, 0.97), (0.0, 1.0)])


@dataclass(frozen=True)
class Shape:
    """Side view of a body as shares of its length (from the nose) and height.

    Attributes
    ----------
    shoulder
        (share of length, share of height) of bonnet, belt line and boot lid.
    roof
        Shares of length and height of windscreen foot, roof front, roof rear, rear window foot.
    pillars
        Shares of length of the pillars between side windows.
    tumblehome
        How much narrower the roof is than the belt, as a share of the half width.
    nose, tail
        Half width at the ends as a share of the largest.
    bow_m
        How far the middles of nose and tail stand out before their corners.
    bed
        Shares of length between which a pickup's bed is open.
    closed_nose
        Whether there is no grille.
    """

    shoulder: tuple[tuple[float, float], ...]
    roof: tuple[tuple[float, float], ...]
    pillars: tuple[float, ...]
    tumblehome: float
    nose: float
    tail: float
    bow_m: tuple[float, float] = (0.11, 0.07)
    bed: tuple[float, float] | None = None
    closed_nose: bool = False


SHAPES = {
    "hatchback": Shape(
        shoulder=((0, 0.46), (0.02, 0.52), (0.12, 0.59), (0.27, 0.645), (0.6, 0.66), (0.9, 0.675), (1, 0.65)),
        roof=((0.26, 0.0), (0.44, 1.0), (0.83, 0.965), (0.965, 0.0)),
        pillars=(0.57,),
        tumblehome=0.22,
        nose=0.80,
        tail=0.86,
    ),
    "saloon": Shape(
        shoulder=(
            (0, 0.46),
            (0.02, 0.52),
            (0.12, 0.59),
            (0.28, 0.645),
            (0.6, 0.665),
            (0.85, 0.705),
            (0.97, 0.715),
            (1, 0.67),
        ),
        roof=((0.275, 0.0), (0.43, 1.0), (0.66, 0.985), (0.85, 0.0)),
        pillars=(0.555,),
        tumblehome=0.25,
        nose=0.80,
        tail=0.84,
    ),
    "suv": Shape(
        shoulder=((0, 0.47), (0.015, 0.54), (0.1, 0.61), (0.25, 0.64), (0.6, 0.655), (0.9, 0.67), (1, 0.64)),
        roof=((0.245, 0.0), (0.40, 1.0), (0.87, 0.975), (0.985, 0.0)),
        pillars=(0.53, 0.76),
        tumblehome=0.19,
        nose=0.83,
        tail=0.90,
        bow_m=(0.10, 0.06),
    ),
    "van": Shape(
        shoulder=((0, 0.42), (0.015, 0.48), (0.08, 0.54), (0.19, 0.585), (0.6, 0.60), (0.9, 0.60), (1, 0.58)),
        roof=((0.17, 0.0), (0.35, 1.0), (0.935, 0.985), (0.99, 0.0)),
        pillars=(0.45, 0.70),
        tumblehome=0.14,
        nose=0.84,
        tail=0.94,
        bow_m=(0.12, 0.04),
    ),
    "pickup": Shape(
        shoulder=((0, 0.50), (0.012, 0.56), (0.09, 0.605), (0.25, 0.63), (0.6, 0.64), (0.9, 0.64), (1, 0.63)),
        roof=((0.25, 0.0), (0.375, 1.0), (0.585, 0.985), (0.635, 0.0)),
        pillars=(0.465,),
        tumblehome=0.18,
        nose=0.86,
        tail=0.96,
        bow_m=(0.09, 0.02),
        bed=(0.65, 0.975),
    ),
    "compact_ev": Shape(
        shoulder=((0, 0.46), (0.02, 0.52), (0.1, 0.575), (0.22, 0.61), (0.6, 0.63), (0.9, 0.65), (1, 0.62)),
        roof=((0.19, 0.0), (0.40, 1.0), (0.80, 0.965), (0.965, 0.0)),
        pillars=(0.55,),
        tumblehome=0.22,
        nose=0.80,
        tail=0.84,
        bow_m=(0.13, 0.09),
        closed_nose=True,
    ),
}


class Shell:
    """Half rings along the car, each from the middle of the floor pan over the side to the middle of the roof."""

    def __init__(self, body: CarBody, shape: Shape) -> None:
        self.body, self.shape = body, shape
        length, height = body.length_m, body.height_m
        self._shoulder = PchipInterpolator(
            [s * length for s, _ in shape.shoulder], [h * height for _, h in shape.shoulder]
        )
        self.cowl, self.roof_front, self.roof_rear, self.deck = (share * length for share, _ in shape.roof)
        middle = (self.roof_front + self.roof_rear) / 2
        self._roof = PchipInterpolator(
            [self.cowl, self.roof_front - 0.12, self.roof_front + 0.12, middle, self.roof_rear, self.deck],
            [
                self.shoulder(self.cowl) + _BONNET_CROWN_M,
                height - 0.085,
                height - 0.025,
                height,
                shape.roof[2][1] * height - 0.01,
                self.shoulder(self.deck) + _BONNET_CROWN_M,
            ],
        )
        self._width = PchipInterpolator(
            np.array([0.0, 0.02, 0.045, 0.09, 0.17, 0.3, 0.7, 0.9, 0.96, 0.98, 1.0]) * length,
            np.array(
                [
                    shape.nose * 0.96,
                    shape.nose + 0.45 * (1 - shape.nose),
                    shape.nose + 0.70 * (1 - shape.nose),
                    shape.nose + 0.87 * (1 - shape.nose),
                    shape.nose + 0.97 * (1 - shape.nose),
                    1.0,
                    1.0,
                    shape.tail + 0.85 * (1 - shape.tail),
                    shape.tail + 0.55 * (1 - shape.tail),
                    shape.tail + 0.25 * (1 - shape.tail),
                    shape.tail * 0.96,
                ]
            )
            * body.width_m
            / 2,
        )
        self.stations = self._make_stations()
        self.rings = np.array([self._ring(s) for s in self.stations])

    @property
    def axles(self) -> tuple[float, float]:
        """Distances of the axles from the nose in metres."""
        return self.body.front_overhang_m, self.body.front_overhang_m + self.body.wheelbase_m

    @property
    def arch_radius_m(self) -> float:
        """Radius of the wheel arches."""
        return self.body.wheel_radius_m + _ARCH_GAP_M

    def shoulder(self, s: float) -> float:
        """Height of bonnet edge, belt line or boot lid edge, `s` metres from the nose."""
        return float(self._shoulder(s))

    def z_at(self, s: float, x: float) -> float:
        """Z of the point `s` metres from the nose and `x` off the middle: the ends bow outwards."""
        length, (front, rear) = self.body.length_m, self.shape.bow_m
        first, last = front + _END_INSET_M, length - rear - _END_INSET_M
        back = [min(self.roof_rear, 0.86 * length), min(self.deck, 0.88 * length), 0.9 * length, last]
        knots = [first, 0.12 * length, self.cowl, self.roof_front, *back]
        bow = np.interp(s, knots, [front, 0.06, 0.07, 0.05, -0.03, -0.03, -0.02, -rear])
        return float(s - length / 2 - bow * (1 - (2 * x / self.body.width_m) ** 2))

    def side_x(self, s: float, y: float) -> float:
        """Half width of the shell at a height, `s` metres from the nose."""
        ring = self._ring(s)[_SILL : _ROOF_EDGE + 1]
        return float(np.interp(y, ring[:, 1], ring[:, 0]))

    def end_z(self, x: float, y: float, *, rear: bool) -> float:
        """Z of the shell where a ray along the car through (x, y) enters it at the nose or the tail."""
        order = slice(None, None, -1) if rear else slice(None)
        before, reach = float(self.stations[order][0]), -1.0
        for s, ring in zip(self.stations[order], self.rings[order], strict=True):
            side = ring[_SILL:]
            half = float(np.interp(y, side[:, 1], side[:, 0], left=-1.0, right=-1.0))
            if half >= abs(x):
                share = (abs(x) - reach) / (half - reach) if reach >= 0 else 0.5
                return self.z_at(before + (float(s) - before) * min(max(share, 0.0), 1.0), x)
            before, reach = float(s), half
        return self.z_at(before, x)

    def end_reach(self, y: float, *, rear: bool) -> float:
        """Half width at a height within `_END_DEPTH_M` of the nose or the tail."""
        from_end = self.stations[-1] - self.stations if rear else self.stations - self.stations[0]
        rings = self.rings[from_end < _END_DEPTH_M, _SILL:]
        return max(float(np.interp(y, ring[:, 1], ring[:, 0], left=0.0, right=0.0)) for ring in rings)

    def _make_stations(self) -> NDArray[np.float64]:
        """Distances from the nose, close together at the ends, around wheel arches and windows."""
        length, (front, rear) = self.body.length_m, self.shape.bow_m
        first, last = front + _END_INSET_M, length - rear - _END_INSET_M
        fixed = [first, last]
        fixed += [first + step for step in (0.012, 0.03, 0.06, 0.11)] + [last - s for s in (0.012, 0.03, 0.06, 0.11)]
        fixed += [self.cowl, self.roof_front - 0.12, self.roof_front, self.roof_front + 0.12]
        fixed += [self.roof_rear - 0.1, self.roof_rear, self.roof_rear + 0.04, self.deck]
        for pillar in self.shape.pillars:
            fixed += [pillar * length - _HALF_PILLAR_M, pillar * length + _HALF_PILLAR_M]
        for edge in self.shape.bed or ():
            fixed += [edge * length, edge * length + 0.012]
        reach = self.arch_radius_m
        for axle in self.axles:
            fixed += (axle - (reach + 0.001) * np.cos(np.linspace(0, np.pi, 17))).tolist()
            fixed += [axle - reach - 0.012, axle + reach + 0.012]
        stations = np.unique(np.round(np.concatenate([fixed, np.linspace(first, last, 36)]), 4))
        stations = stations[(stations >= round(first, 4)) & (stations <= round(last, 4))]
        apart: NDArray[np.float64] = stations[np.concatenate(([True], np.diff(stations) > _MIN_STATION_STEP_M))]
        return apart

    def _sill(self, s: float) -> float:
        """Height of the sill and of the bumpers' lower edges."""
        length = self.body.length_m
        lift = 0.07 * max(0.0, 1 - s / (0.08 * length)) + 0.11 * max(0.0, 1 - (length - s) / (0.07 * length))
        return _GROUND_CLEARANCE_M + lift

    def _bottom(self, s: float) -> float:
        """Height of the side's lower edge: the sill, raised over the wheels."""
        level = self._sill(s)
        for axle in self.axles:
            inside = self.arch_radius_m**2 - (s - axle) ** 2
            if inside > 0:
                level = max(level, self.body.wheel_radius_m + float(np.sqrt(inside)))
        return level

    def _ring(self, s: float) -> NDArray[np.float64]:
        """Half of a cross-section as (x, y), x >= 0: 0-4 pan and sill, 4-10 side, 10-11 window, 11-16 roof."""
        width, shoulder, sill, bottom = float(self._width(s)), self.shoulder(s), self._sill(s), self._bottom(s)
        heights = bottom + np.array(_SIDE_HEIGHT) * (shoulder - bottom)
        widths = np.interp((heights - sill) / (shoulder - sill), _SIDE_HEIGHT, _SIDE_WIDTH) * width
        pan = [(0.0, sill + 0.02), (width * 0.58, sill + 0.02), (width * 0.60, bottom + 0.02)]
        pan.append((width * 0.90, bottom + 0.02))
        return np.concatenate([pan, np.stack([widths, heights], axis=1), self._top(s, width, shoulder)])

    def _top(self, s: float, width: float, shoulder: float) -> NDArray[np.float64]:
        """The ring above the belt line: cabin, bonnet, boot lid or open bed."""
        length, bed = self.body.length_m, self.shape.bed
        if bed and bed[0] * length + 0.006 < s < bed[1] * length + 0.006:
            floor, rim = _BED_FLOOR_M, shoulder + 0.008
            inside = [(0.915, rim), (0.87, rim), (0.86, floor), (0.55, floor), (0.28, floor), (0.0, floor)]
            return np.array([(share * width, y) for share, y in inside])
        crown = _BONNET_CROWN_M if not bed or s < self.cowl + 0.5 else 0.012
        roof = float(self._roof(s)) if self.cowl < s < self.deck else 0.0
        rise = max(roof - shoulder, crown)
        share = float(np.clip((rise - crown) / (self.body.height_m * 0.2), 0.0, 1.0))
        narrow = float(np.clip(rise / (self.body.height_m * 0.34), 0.0, 1.0))
        points = _BONNET + (_CABIN - _BONNET) * share
        half = width * (0.925 - (self.shape.tumblehome - 0.03) * narrow)
        return np.stack([points[:, 0] * half, shoulder + points[:, 1] * rise], axis=1)

    def regions(self) -> dict[str, list[Face]]:
        """The faces of the shell by what they are: body, cabin, glass or under; both sides."""
        found: dict[str, list[Face]] = {name: [] for name in ("body", "cabin", "glass", "under")}
        points = np.array(
            [
                [(x, y, self.z_at(s, x)) for x, y in ring]
                for s, ring in zip(self.stations.tolist(), self.rings, strict=True)
            ]
        )
        for i in range(len(points) - 1):
            for j in range(points.shape[1] - 1):
                quad = np.array([points[i, j], points[i, j + 1], points[i + 1, j + 1], points[i + 1, j]])
                _add_both_sides(found[self._region(i, j)], quad)
        self._add_ends(found["body"], points)
        return found

    @staticmethod
    def _add_ends(faces: list[Face], points: NDArray[np.float64]) -> None:
        """Close nose and tail with columns between the lower and the upper half of their rings."""
        count = points.shape[1]
        for ring, forward in ((points[0], True), (points[-1], False)):
            for j in range(count // 2):
                low, high = (j, j + 1), (count - 2 - j, count - 1 - j)
                quad = ring[[low[0], low[1], high[0], high[1]]]
                _add_both_sides(faces, quad[::-1] if forward else quad)

    def _region(self, i: int, j: int) -> str:
        """What the face between stations i and i + 1 and ring points j and j + 1 is made of."""
        s = float(self.stations[i] + self.stations[i + 1]) / 2
        if j < _SILL:
            return "under"
        if j < _BELT or not self.cowl < s < self.deck:
            return "body"
        windscreen = self.cowl + 0.03 < s < self.roof_front
        rear_window = self.roof_rear + 0.03 < s < self.deck - 0.02
        if j >= _ROOF_EDGE and (windscreen or rear_window):
            return "glass"
        return "glass" if j == _BELT and self._is_side_window(s) else "cabin"

    def _is_side_window(self, s: float) -> bool:
        run_out = 0.22 if self.shape.bed or self.deck - self.roof_rear < 0.4 else 0.34  # noqa: PLR2004
        between = self.cowl + 0.36 < s < self.deck - run_out
        return between and all(abs(s - share * self.body.length_m) > _HALF_PILLAR_M for share in self.shape.pillars)


def _add_both_sides(faces: list[Face], quad: Face) -> None:
    """A quad of the right side and its mirror image, as triangles, which stay flat."""
    for triangle in (quad[[0, 1, 2]], quad[[0, 2, 3]]):
        faces.append(triangle)
        faces.append((triangle * (-1.0, 1.0, 1.0))[::-1])
