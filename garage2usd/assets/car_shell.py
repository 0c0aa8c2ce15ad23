"""Shell of a car body: rings of points lofted along the car, and points on its surface."""
# Over 300 lines: the body is one surface, whose parts share their rings of points.

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.assets.car_shapes import SideView
from garage2usd.config.vehicles import CarBody

Array = NDArray[np.float64]
_ARCH_GAP_M = 0.045
_ARCH_STEPS = 9
_HALF_PILLAR_M = 0.045
_MIN_STATION_STEP_M = 0.008
_MAX_STATION_STEP_M = 0.30
_END_INSET_M = 0.010
"""Space for plates and lamps between the shell's ends and the footprint."""
_END_STEPS_M = (0.012, 0.03, 0.06, 0.11, 0.17)
_END_RUN_M = 0.42
_BED_FLOOR_M = 0.82
_PAN_TOLERANCE_M = 0.025
_SIDE_TOLERANCE_M = 0.002
# points of a ring, see `Shell._make_rings`: faces below the sill are floor pan, one band is side window
_SILL, _BELT, _ROOF_EDGE = 4, 10, 12
_BEHIND = {"glass": "glass", "glass_dark": "rear_glass"}
"""Kind of the windows behind the first pillar by their material."""
_SIDE_HEIGHT = (0.0, 0.12, 0.35, 0.58, 0.80, 0.94, 1.0)
_SIDE_WIDTH = (0.955, 0.978, 0.993, 1.0, 0.990, 0.962, 0.925)
_CABIN = np.array([(0.985, 0.80), (0.945, 0.91), (0.84, 0.968), (0.62, 0.99), (0.32, 0.998), (0.0, 1.0)])
_BONNET = np.array([(0.94, 0.15), (0.82, 0.40), (0.64, 0.66), (0.43, 0.86), (0.21, 0.97), (0.0, 1.0)])
_BED = np.array([(0.915, 0.0), (0.87, 0.0), (0.86, 1.0), (0.55, 1.0), (0.28, 1.0), (0.0, 1.0)])
# (metres from the shell's end, share of the way from the end's width to the largest)
_NOSE_WIDTH = (
    (0.0, 0.0),
    (0.012, 0.25),
    (0.03, 0.40),
    (0.06, 0.56),
    (0.11, 0.73),
    (0.17, 0.86),
    (0.35, 0.97),
    (1.1, 1),
)
_TAIL_WIDTH = (
    (0.0, 0.0),
    (0.012, 0.28),
    (0.03, 0.46),
    (0.06, 0.63),
    (0.11, 0.80),
    (0.17, 0.90),
    (0.30, 0.97),
    (0.9, 1),
)
# heights of the second to fifth point of the side at the ends: the bumpers, and the step above them
_NOSE_BUMPER_M = (0.30, 0.40, 0.51, 0.55)
_TAIL_BUMPER_M = (0.34, 0.44, 0.55, 0.59)
# how far each point of a ring lies behind the bumper: the floor pan, the seven points of the side, all above
_NOSE_SETBACK_M = (*[0.035] * 4, 0.035, 0.006, 0.0, 0.004, 0.026, 0.040, 0.055, *[0.06] * 6)
_TAIL_SETBACK_M = (*[0.035] * 4, 0.035, 0.006, 0.0, 0.003, 0.038, 0.042, 0.048, *[0.05] * 6)


class MonotoneCurve:
    """Monotone piecewise cubic interpolation, extrapolated beyond both ends.

    Notes
    -----
    Fritsch and Butland, SIAM Journal on Scientific and Statistical Computing 5 (1984): the slope at a point is the
    weighted harmonic mean of those beside it, and zero where these differ in sign. At the ends it is the three-point
    estimate of Moler, Numerical Computing with MATLAB (2004), 3.6. Equal to SciPy's `PchipInterpolator`, which takes
    longer to load than all cars take to make.
    """

    def __init__(self, x: ArrayLike, y: ArrayLike) -> None:
        """Interpolate points; `x` is ascending, both of shape (n,) with n >= 3."""
        self._x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        step = np.diff(self._x)
        slope = np.diff(y) / step
        keeps = slope[:-1] * slope[1:] > 0
        weights = np.stack([2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]])[:, keeps]
        beside = np.stack([slope[:-1], slope[1:]])[:, keeps]
        rise = np.zeros(len(y))
        rise[1:-1][keeps] = 1 / ((weights / beside).sum(axis=0) / weights.sum(axis=0))
        rise[0], rise[-1] = _end_slope(step[:2], slope[:2]), _end_slope(step[:-3:-1], slope[:-3:-1])
        turn = (rise[:-1] + rise[1:] - 2 * slope) / step
        self._cubics = np.stack([y[:-1], rise[:-1], (slope - rise[:-1]) / step - turn, turn / step])

    def __call__(self, x: ArrayLike) -> Array:
        """Evaluate the curve; shape of `x`."""
        piece = np.clip(np.searchsorted(self._x, x, side="right") - 1, 0, len(self._x) - 2)
        along = np.asarray(x) - self._x[piece]
        constant, linear, square, cube = self._cubics[:, piece]
        height: Array = constant + linear * along + square * (along * along) + cube * (along * along * along)
        return height


def _end_slope(step: Array, slope: Array) -> float:
    """Slope at an end, from the two adjacent segments, the outer one first."""
    estimate = float(((2 * step[0] + step[1]) * slope[0] - step[0] * slope[1]) / (step[0] + step[1]))
    if np.sign(estimate) != np.sign(slope[0]):
        return 0.0
    steepest = 3 * float(slope[0])
    return steepest if slope[0] * slope[1] < 0 and abs(estimate) > abs(steepest) else estimate


class Contour:
    """Level cut through nose or tail: a line from the centre around the corner along the right side.

    Parameters
    ----------
    line
        X and Z of its points; shape (points, 2).
    rear
        True if the contour cuts the tail, False for the nose.
    """

    def __init__(self, line: NDArray[np.float64], *, rear: bool) -> None:
        steps = np.diff(line, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        self.line = line
        self.arc_m = np.concatenate(([0.0], np.cumsum(lengths)))
        """Arc length in metres of each point of the line."""
        outwards = steps[:, ::-1] * ((-1.0, 1.0) if rear else (1.0, -1.0)) / lengths[:, None]
        self._normals = np.concatenate([outwards[:1], outwards[:-1] + outwards[1:], outwards[-1:]])
        self._normals[0, 0] = 0.0
        self._normals /= np.linalg.norm(self._normals, axis=1, keepdims=True)

    @property
    def corner_m(self) -> float:
        """Arc length in metres at which the flat end becomes the side."""
        return float(self.arc_m[len(_BONNET)])

    def arc_at_x(self, x: float) -> float:
        """Metres along the line to where its X is `x`; negative on the left."""
        return float(np.sign(x) * np.interp(abs(x), self.line[:, 0], self.arc_m))

    def arc_at_depth(self, depth_m: float) -> float:
        """Arc length in metres at which the line is `depth_m` behind its centre."""
        depths = np.abs(self.line[:, 1] - self.line[0, 1])
        return float(np.interp(depth_m, depths, self.arc_m))

    def arc_at_points(self, numbers: NDArray[np.int64]) -> NDArray[np.float64]:
        """Arc length in metres of points by index; negative on the left for negative indices."""
        arcs: NDArray[np.float64] = np.sign(numbers) * self.arc_m[np.abs(numbers)]
        return arcs

    def place(self, arc_m: NDArray[np.float64], skin_m: float) -> NDArray[np.float64]:
        """X and Z, shape (n, 2), at arc lengths of the line, offset outwards by `skin_m`."""
        along = np.abs(arc_m)
        place: NDArray[np.float64] = np.stack(
            [np.interp(along, self.arc_m, self.line[:, axis]) for axis in (0, 1)], axis=1
        )
        normal = np.stack([np.interp(along, self.arc_m, self._normals[:, axis]) for axis in (0, 1)], axis=1)
        place += skin_m * normal / np.linalg.norm(normal, axis=1, keepdims=True)
        place[:, 0] *= np.where(arc_m < 0, -1.0, 1.0)
        return place


class Shell:
    """Shell of a body as half rings along the car, from the centre of the floor pan over the side to the roof."""

    def __init__(self, body: CarBody, shape: SideView) -> None:
        self.body, self.shape = body, shape
        length, height = body.length_m, body.height_m
        self._shoulder = MonotoneCurve([s * length for s, _ in shape.shoulder], [h * height for _, h in shape.shoulder])
        self.cowl, self.roof_front, self.roof_rear, self.deck = (share * length for share, _ in shape.roof)
        middle = (self.roof_front + self.roof_rear) / 2
        self._roof = MonotoneCurve(
            [self.cowl, self.roof_front - 0.12, self.roof_front + 0.12, middle, self.roof_rear, self.deck],
            [
                self.shoulder(self.cowl) + shape.crown_m,
                height - 0.085,
                height - 0.025,
                height,
                shape.roof[2][1] * height - 0.01,
                self.shoulder(self.deck) + shape.crown_m,
            ],
        )
        self._side_width = np.array(_SIDE_WIDTH) + (1 - np.array(_SIDE_WIDTH)) * 0.7 * shape.slab
        self._first = shape.bow_m[0] + _END_INSET_M
        self._last = length - shape.bow_m[1] - _END_INSET_M
        nose = [(self._first + away, shape.nose + way * (1 - shape.nose)) for away, way in _NOSE_WIDTH]
        tail = [(self._last - away, shape.tail + way * (1 - shape.tail)) for away, way in _TAIL_WIDTH]
        stations, shares = zip(*nose, *tail[::-1], strict=True)
        self._half_width = MonotoneCurve(stations, np.array(shares) * body.width_m / 2)
        self.stations = self._make_stations()
        self.points = self._make_rings()
        """Points of the half rings; shape (stations, points of a half ring, 3)."""
        self._caps = {rear: self._make_cap(rear=rear) for rear in (False, True)}

    @property
    def axles(self) -> tuple[float, float]:
        """Distances of the axles from the nose in metres."""
        return self.body.front_overhang_m, self.body.front_overhang_m + self.body.wheelbase_m

    @property
    def arch_radius_m(self) -> float:
        """Radius of the wheel arches."""
        return self.body.wheel_radius_m + _ARCH_GAP_M

    @property
    def side_window(self) -> tuple[float, float]:
        """Interval in metres from the nose in which the side consists of windows and pillars."""
        return min(self.cowl + 0.36, self.roof_front + 0.04), self.deck - self.shape.window_run_out_m

    def shoulder(self, s: float) -> float:
        """Height of bonnet edge, belt line or boot lid edge, `s` metres from the nose."""
        return float(self._shoulder(s))

    def end_top(self, *, rear: bool) -> float:
        """Height of the upper edge of nose or tail."""
        return float(self.points[-1 if rear else 0, _BELT, 1])

    def end_heights(self, *, rear: bool, around_corner: bool) -> NDArray[np.float64]:
        """Ascending heights at which the profile of nose or tail bends, which differ around the corners."""
        end, corner = (-1, -len(_END_STEPS_M)) if rear else (0, len(_END_STEPS_M))
        heights = [self.points[i, _SILL : _BELT + 1, 1] for i in ((end, corner) if around_corner else (end,))]
        return np.sort(np.concatenate(heights))

    def bumper_top(self, *, rear: bool) -> float:
        """Height at which nose or tail recedes above the bumper."""
        return float(self.points[-1 if rear else 0, _SILL + 3, 1])

    def side_place(self, s: float, y: float) -> tuple[float, float]:
        """X and Z of the right side at a height, `s` metres from the nose."""
        ring = self._ring_at(s)[_SILL : _ROOF_EDGE + 1]
        return float(np.interp(y, ring[:, 1], ring[:, 0])), float(np.interp(y, ring[:, 1], ring[:, 2]))

    def surface(self, s: float, t: float) -> NDArray[np.float64]:
        """Point of the surface `s` metres from the nose at the fractional ring index `t`."""
        ring = self._ring_at(s)
        low = min(int(t), len(ring) - 2)
        point: NDArray[np.float64] = ring[low] + (ring[low + 1] - ring[low]) * (t - low)
        return point

    def normal(self, s: float, t: float) -> NDArray[np.float64]:
        """Outward unit normal of the surface at (s, t)."""
        along = self.surface(s + 0.01, t) - self.surface(s - 0.01, t)
        around = self.surface(s, min(t + 0.05, 16.0)) - self.surface(s, t - 0.05)
        normal = np.cross(around, along)
        unit: NDArray[np.float64] = normal / np.linalg.norm(normal)
        return unit

    def contour(self, y: float, *, rear: bool) -> Contour:
        """Level cut through nose or tail at a height up to its upper edge."""
        cap = self._caps[rear]
        rows = cap[:-1, 0, 1]
        row = int(np.clip(np.searchsorted(rows, y) - 1, 0, len(rows) - 2))
        share = np.clip((y - rows[row]) / (rows[row + 1] - rows[row]), 0.0, 1.0)
        front = (cap[row] + (cap[row + 1] - cap[row]) * share)[::-1, [0, 2]]
        order = slice(None, None, -1) if rear else slice(None)
        near = np.abs(self.stations[order] - self.stations[order][0]) < self.body.length_m / 4
        rings = self.points[order][near][1:, _SILL : _BELT + 1]
        k = np.clip((rings[:, :, 1] <= y).sum(axis=1) - 1, 0, len(rows) - 2)[:, None, None]
        low, high = (np.take_along_axis(rings, k + step, axis=1)[:, 0] for step in (0, 1))
        shares = np.clip((y - low[:, 1:2]) / (high[:, 1:2] - low[:, 1:2]), 0.0, 1.0)
        side = (low + (high - low) * shares)[:, [0, 2]]
        return Contour(np.concatenate([front, side]), rear=rear)

    def regions(self) -> dict[str, NDArray[np.float64]]:
        """Faces of the shell by region, each (n, 4, 3): body, cabin, glass, rear_glass, pillar or under."""
        kinds, quads = self._kinds(), grid_quads(self.points)
        # doors need fewer stations than the windows above them
        middle = np.flatnonzero((self.stations >= self.cowl) & (self.stations <= self.deck))
        side = self.points[middle, _SILL : _BELT + 1]
        doors = side[simplified(self.stations[middle], side.reshape(len(side), -1), _SIDE_TOLERANCE_M)]
        kinds[middle[0] : middle[-1], _SILL:_BELT] = ""
        found = {kind: quads[kinds == kind] for kind in ("body", "cabin", "glass", "rear_glass", "pillar")}
        caps = [grid_quads(cap).reshape(-1, 4, 3) for cap in self._caps.values()]
        found["body"] = np.concatenate([found["body"], grid_quads(doors).reshape(-1, 4, 3), caps[0], caps[1][:, ::-1]])
        pan = self.points[:, : _SILL + 1]
        kept = simplified(self.stations, pan.reshape(len(pan), -1), _PAN_TOLERANCE_M)
        found["under"] = grid_quads(pan[kept]).reshape(-1, 4, 3)
        return {kind: both_sides(faces) for kind, faces in found.items()}

    def _ring_at(self, s: float) -> NDArray[np.float64]:
        """Interpolated half ring between two stations: shape (points, 3)."""
        i = int(np.clip(np.searchsorted(self.stations, s) - 1, 0, len(self.stations) - 2))
        share = (s - self.stations[i]) / (self.stations[i + 1] - self.stations[i])
        ring: NDArray[np.float64] = self.points[i] + (self.points[i + 1] - self.points[i]) * share
        return ring

    def _make_stations(self) -> NDArray[np.float64]:
        """Distances of the stations from the nose, dense at the ends and around wheel arches and windows."""
        length, first, last = self.body.length_m, self._first, self._last
        fixed = [first, last, *(first + step for step in _END_STEPS_M), *(last - step for step in _END_STEPS_M)]
        fixed += [self.cowl, self.cowl + 0.03, self.roof_front - 0.12, self.roof_front, self.roof_front + 0.12]
        fixed += [
            (self.roof_front + self.roof_rear) / 2,
            self.roof_rear - 0.1,
            self.roof_rear,
            self.roof_rear + 0.03,
            self.deck - 0.02,
            self.deck,
        ]
        fixed += self.side_window
        for pillar in self.shape.pillars:
            fixed += [pillar * length - _HALF_PILLAR_M, pillar * length + _HALF_PILLAR_M]
        for edge in self.shape.bed or ():
            fixed += [edge * length, edge * length + 0.012]
        reach = self.arch_radius_m
        for axle in self.axles:
            fixed += (axle - (reach + 0.001) * np.cos(np.linspace(0, np.pi, _ARCH_STEPS))).tolist()
            fixed += [axle - reach - 0.012, axle + reach + 0.012]
        stations = np.unique(np.round(fixed, 4))
        stations = stations[(stations >= round(first, 4)) & (stations <= round(last, 4))]
        stations = stations[(stations == stations[-1]) | (stations < stations[-1] - _MIN_STATION_STEP_M)]
        stations = stations[np.concatenate(([True], np.diff(stations) > _MIN_STATION_STEP_M))]
        filled = [
            np.linspace(low, high, int(np.ceil((high - low) / _MAX_STATION_STEP_M)), endpoint=False)
            for low, high in pairwise(stations.tolist())
        ]
        return np.concatenate([*filled, stations[-1:]])

    def _make_rings(self) -> NDArray[np.float64]:
        """Half rings at the stations: points 0-4 pan and sill, 4-10 side, 10-11 window, 11-16 roof."""
        s = self.stations
        width, shoulder, sill, bottom = self._half_width(s), self._shoulder(s), self._sill(s), self._bottom(s)
        heights = bottom[:, None] + np.array(_SIDE_HEIGHT) * (shoulder - bottom)[:, None]
        bumpers = np.array((_NOSE_BUMPER_M, _TAIL_BUMPER_M)) * self.shape.bumper
        for weight, bumper in zip(self._end_weights(s), bumpers, strict=True):
            over = (bumper[-1] + shoulder) / 2
            end = np.column_stack([bottom, np.tile(bumper, (len(s), 1)), over, shoulder])
            heights += weight[:, None] * (end - heights)
        shares = (heights - sill[:, None]) / (shoulder - sill)[:, None]
        side = np.stack([np.interp(shares, _SIDE_HEIGHT, self._side_width) * width[:, None], heights], axis=2)
        pan = np.stack(
            [np.outer(width, (0.0, 0.58, 0.60, 0.90)), np.stack([sill, sill, bottom, bottom], axis=1) + 0.02], axis=2
        )
        flat = np.concatenate([pan, side, self._top(s, width, shoulder)], axis=1)
        z = self._bowed_z(s, flat[:, :, 0]) + self._set_back(s)
        return np.concatenate([flat, z[:, :, None]], axis=2)

    def _bowed_z(self, s: NDArray[np.float64], x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Z of points at `s` from the nose, shape (n,), and `x` from the centre, (n, m), with ends bowed outwards."""
        length, (front, rear) = self.body.length_m, self.shape.bow_m
        back = [min(self.roof_rear, 0.86 * length), min(self.deck, 0.88 * length), 0.9 * length, self._last]
        knots = [self._first, 0.12 * length, self.cowl, self.roof_front, *back]
        bow = np.interp(s, knots, [front, 0.06, 0.07, 0.05, -0.03, -0.03, -0.02, -rear])
        return (s - length / 2)[:, None] - bow[:, None] * (1 - (2 * x / self.body.width_m) ** 2)

    def _set_back(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Setback in Z of the ends above and below their bumpers; shape (n, points of a half ring)."""
        nose, tail = self._end_weights(s)
        return np.outer(nose, _NOSE_SETBACK_M) - np.outer(tail, _TAIL_SETBACK_M)

    def _end_weights(self, s: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Weights of nose and tail at points: 1 at the end, falling to 0."""
        nose, tail = (np.maximum(1.0 - away / _END_RUN_M, 0.0) for away in (s - self._first, self._last - s))
        return nose * nose, tail * tail

    def _sill(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Height of the sill and of the bumpers' lower edges."""
        length = self.body.length_m
        lift = 0.07 * np.clip(1 - s / (0.08 * length), 0, 1) + 0.11 * np.clip(1 - (length - s) / (0.07 * length), 0, 1)
        return self.shape.clearance_m + lift

    def _bottom(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Height of the side's lower edge: the sill, raised above the wheels."""
        level: NDArray[np.float64] = self._sill(s)
        for axle in self.axles:
            inside = self.arch_radius_m**2 - (s - axle) ** 2
            over = self.body.wheel_radius_m + np.sqrt(np.maximum(inside, 0.0))
            level = np.where(inside > 0, np.maximum(level, over), level)
        return level

    def _top(
        self, s: NDArray[np.float64], width: NDArray[np.float64], shoulder: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """X and Y of the rings above the belt line: cabin, bonnet, boot lid or open bed."""
        length, bed = self.body.length_m, self.shape.bed
        low = s >= self.cowl + 0.5 if bed else np.zeros(len(s), bool)
        crown = np.where(low, 0.012, self.shape.crown_m)
        roof = np.where((self.cowl < s) & (s < self.deck), self._roof(np.clip(s, self.cowl, self.deck)), 0.0)
        rise = np.maximum(roof - shoulder, crown)
        share = np.clip((rise - crown) / (self.body.height_m * 0.2), 0.0, 1.0)
        narrow = np.clip(rise / (self.body.height_m * 0.34), 0.0, 1.0)
        points = _BONNET + (_CABIN - _BONNET) * share[:, None, None]
        half = width * (self._side_width[-1] - (self.shape.tumblehome - 0.03) * narrow)
        top: NDArray[np.float64] = np.stack(
            [points[:, :, 0] * half[:, None], shoulder[:, None] + points[:, :, 1] * rise[:, None]], axis=2
        )
        if bed:
            inside = (bed[0] * length + 0.006 < s) & (s < bed[1] * length + 0.006)
            rim = shoulder[inside] + 0.008
            floor = max(_BED_FLOOR_M, self.body.wheel_radius_m + self.arch_radius_m + 0.03)
            heights = rim[:, None] + np.outer(floor - rim, _BED[:, 1])
            top[inside] = np.stack([np.outer(width[inside], _BED[:, 0]), heights], axis=2)
        return top

    def _make_cap(self, *, rear: bool) -> NDArray[np.float64]:
        """Cap that closes nose or tail: rows along the side's heights and the crown, columns from side to centre."""
        end = -1 if rear else 0
        crown, side = self.points[end, _BELT:], self.points[end, _SILL : _BELT + 1]
        x = np.outer(side[:, 0], crown[:, 0] / crown[0, 0])
        s = np.full(len(x), self.stations[end])
        z = self._bowed_z(s, x) + self._set_back(s)[0, _SILL : _BELT + 1, None]
        return np.concatenate([np.stack([x, np.broadcast_to(side[:, 1:2], x.shape), z], axis=2), crown[None]])

    def _kinds(self) -> NDArray[np.str_]:
        """Region of the faces for each pair of stations and of ring points."""
        s = (self.stations[:-1] + self.stations[1:]) / 2
        kinds = np.full((len(s), self.points.shape[1] - 1), "body", dtype="<U10")
        kinds[:, :_SILL] = "under"
        kinds[(self.cowl < s) & (s < self.deck), _BELT:] = "cabin"
        windscreen = (self.cowl + 0.03 < s) & (s < self.roof_front)
        rear_window = (self.roof_rear + 0.03 < s) & (s < self.deck - 0.02)
        first, last = self.side_window
        windows = (first < s) & (s < last)
        behind = np.where(s > self.shape.pillars[0] * self.body.length_m, _BEHIND[self.shape.glass], "glass")
        if self.shape.glass_until is not None:
            behind = np.where(s > self.shape.glass_until * self.body.length_m, "cabin", behind)
        kinds[windscreen, _ROOF_EDGE:] = "glass"
        kinds[rear_window, _ROOF_EDGE:] = behind[rear_window, None]
        kinds[windows, _BELT] = behind[windows]
        for pillar in self.shape.pillars:
            kinds[np.abs(s - pillar * self.body.length_m) < _HALF_PILLAR_M, _BELT] = "pillar"
        return kinds


def grid_quads(grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quads of a grid of points, shape (rows, columns, 3), as (rows - 1, columns - 1, 4, 3)."""
    return np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=2)


def both_sides(quads: NDArray[np.float64]) -> NDArray[np.float64]:
    """Faces of the right side, shape (n, corners, 3), followed by their mirror images."""
    back = np.roll(np.arange(quads.shape[1])[::-1], 1)
    return np.concatenate([quads, (quads * (-1.0, 1.0, 1.0))[:, back]])


def simplified(at: NDArray[np.float64], rows: NDArray[np.float64], tolerance: float) -> list[int]:
    """Simplify a polyline of rows: indices of the rows that approximate all others within a tolerance.

    Uses the Ramer-Douglas-Peucker algorithm (1972).
    """
    kept = [0, len(rows) - 1]
    spans = [(0, len(rows) - 1)]
    while spans:
        low, high = spans.pop()
        share = ((at[low : high + 1] - at[low]) / (at[high] - at[low]))[:, None]
        off = np.abs(rows[low : high + 1] - rows[low] - share * (rows[high] - rows[low])).max(axis=1)
        worst = low + int(np.argmax(off))
        if off.max() > tolerance:
            kept.append(worst)
            spans += [(low, worst), (worst, high)]
    return sorted(kept)
