"""Judge of helices by their triangles: where a large car's wheels, underside, roof and sides are on its way."""

from typing import NamedTuple

import numpy as np

from support.level_judge import CAR_LENGTH_M, CLEARANCE_M, REAR_OVERHANG_M, WHEELBASE_M, above

HALF_WIDTH_M, INWARDS_M = 0.95, 0.3
"""Of a large car, whose rear axle runs inside the middle of the lane."""
_STEP_M = 0.1
_NEAR_M = 1.5
_HEIGHTS_M = (0.08, 0.3, 1.5)
"""Over the floor: beside kerbs, and beside walls."""
_CLASSES = {
    *("ramp", "wall", "floor", "ceiling", "column", "lamp", "hatching", "crossing"),
    *("lane_arrow", "lane_line", "parking_stall", "stall_line", "stall_symbol"),
}
"""What lies on floors, stands or hangs; paint is cut out of floors."""


class CoilDrive(NamedTuple):
    """A large car's way over a helix; distances are the least along it."""

    line: np.ndarray
    floor_m: np.ndarray
    inner_slope_percent: float
    inner_radius_m: float
    belly_m: float
    headroom_m: float
    beside_m: float


class CoilJudge:
    """Triangles of ramps and walls of a garage of several levels."""

    def __init__(self, judge):
        parts = [
            triangle for (_, label), triangles in judge.triangles.items() if label in _CLASSES for triangle in triangles
        ]
        self.triangles = np.concatenate(parts).astype(float)

    @staticmethod
    def turned_deg(ramp):
        """How far a ramp's line turns from end to end."""
        ways = np.diff(ramp[:, [0, 2]], axis=0)
        headings = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
        return abs(np.degrees(headings[-1] - headings[0]))

    def floor_m(self, places):
        """Height of the first surface below each place."""
        return _under(self.triangles, places)

    def drive(self, ramp):
        line, ahead = _sampled(ramp)
        sign = 1.0 if np.cross(ahead[:-1], ahead[1:]).sum() > 0 else -1.0
        inwards = sign * np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
        low, high = line.min(axis=0) - 2, line.max(axis=0) + 8
        near = ((self.triangles.max(axis=1) > low) & (self.triangles.min(axis=1) < high)).all(axis=1)
        mesh = self.triangles[near]
        lows, highs = mesh.min(axis=1)[:, [0, 2]], mesh.max(axis=1)[:, [0, 2]]
        floor = _under(mesh, above(line, 0.5))
        # along the inner wall: the run shrinks with the radius, the rise stays
        turn = np.gradient(np.unwrap(np.arctan2(ahead[:, 1], ahead[:, 0])), _STEP_M)
        on_circle = np.abs(turn) > 0.8 * np.abs(turn).max()
        radius = _radius_m(line[on_circle][:, [0, 2]])
        to_wall = _first_beside(mesh, line[on_circle][::10], inwards[on_circle][::10], 1.0)
        slope = np.abs(np.gradient(line[:, 1], _STEP_M)).max()
        inner = radius - np.median(to_wall)
        places = range(int(REAR_OVERHANG_M / _STEP_M) + 5, len(line) - int(CAR_LENGTH_M / _STEP_M) - 5, 20)
        belly = headroom = beside = np.inf
        for at in places:
            rear = line[at] + np.array([inwards[at][0], 0, inwards[at][1]]) * INWARDS_M
            along, aside = (np.array([each[0], 0.0, each[1]]) for each in (ahead[at], inwards[at]))
            body = _body(rear, along, aside)
            box = body.reshape(-1, 3)[:, [0, 2]]
            reach = (highs > box.min(axis=0) - _NEAR_M) & (lows < box.max(axis=0) + _NEAR_M)
            own = mesh[reach.all(axis=1)]
            wheels = _under(own, above(_wheels(rear, along, aside), 0.5)).reshape(2, 2)
            rear_m, front_m = wheels.mean(axis=1)
            roll = (wheels[:, 1] - wheels[:, 0]).mean() / (2 * HALF_WIDTH_M)
            runs, sides = _RUNS[:, None], _SIDES[None, :]
            under = rear_m + (front_m - rear_m) * runs / WHEELBASE_M + roll * sides + CLEARANCE_M
            ground = _under(own, above(body.reshape(-1, 3), 0.5)).reshape(under.shape)
            belly = min(belly, float((under - ground).min()))
            middle = body[:, len(_SIDES) // 2].copy()
            middle[:, 1] = ground[:, len(_SIDES) // 2]
            over = _over(own, body.reshape(-1, 3) * [1, 0, 1] + np.array([0, 1, 0]) * (ground.reshape(-1, 1) + 0.3))
            headroom = min(headroom, float(over.min()) + 0.3)
            for height in _HEIGHTS_M:
                for way in (1.0, -1.0):
                    clear = _first_beside(own, middle, np.tile(way * inwards[at], (len(middle), 1)), height)
                    beside = min(beside, float(clear.min()) - HALF_WIDTH_M)
        return CoilDrive(line, floor, 100 * slope * radius / inner, inner, belly, headroom, beside)


_RUNS = np.linspace(-REAR_OVERHANG_M, CAR_LENGTH_M - REAR_OVERHANG_M, 11)
_SIDES = np.linspace(-HALF_WIDTH_M, HALF_WIDTH_M, 3)


def _radius_m(places):
    """Radius of the circle that fits places best."""
    solution = np.linalg.lstsq(np.column_stack([2 * places, np.ones(len(places))]), (places**2).sum(axis=1), rcond=None)
    x, z, rest = solution[0]
    return float(np.sqrt(rest + x * x + z * z))


def _sampled(ramp):
    """Places every 0.1 m along a line, and the smoothed direction there."""
    runs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1))])
    at = np.arange(0.0, runs[-1], _STEP_M)
    line = np.stack([np.interp(at, runs, ramp[:, axis]) for axis in range(3)], axis=1)
    wide = 15
    padded = np.pad(line[:, [0, 2]], ((wide, wide), (0, 0)), mode="reflect", reflect_type="odd")
    ahead = padded[2 * wide :] - padded[: -2 * wide]
    return line, ahead / np.linalg.norm(ahead, axis=1, keepdims=True)


def _body(rear, along, aside):
    return rear + _RUNS[:, None, None] * along + _SIDES[None, :, None] * aside


def _wheels(rear, along, aside):
    return np.array([rear + run * along + side * aside for run in (0.0, WHEELBASE_M) for side in (-0.8, 0.8)])


def _heights(mesh, places):
    """Heights at which each triangle crosses the vertical through each place, NaN if it misses it."""
    (a, b, c), x, z = mesh.transpose(1, 0, 2), places[:, None, 0], places[:, None, 2]
    double = (b[:, 0] - a[:, 0]) * (c[:, 2] - a[:, 2]) - (c[:, 0] - a[:, 0]) * (b[:, 2] - a[:, 2])
    is_flat = np.abs(double) < 1e-9  # upright ones cross no vertical
    double = np.where(is_flat, 1.0, double)
    one = ((x - a[:, 0]) * (c[:, 2] - a[:, 2]) - (c[:, 0] - a[:, 0]) * (z - a[:, 2])) / double
    two = ((b[:, 0] - a[:, 0]) * (z - a[:, 2]) - (x - a[:, 0]) * (b[:, 2] - a[:, 2])) / double
    heights = a[:, 1] + one * (b[:, 1] - a[:, 1]) + two * (c[:, 1] - a[:, 1])
    return np.where(~is_flat & (one > -1e-7) & (two > -1e-7) & (one + two < 1 + 1e-7), heights, np.nan)


def _under(mesh, places):
    """Height of the first surface below each place."""
    heights = _heights(mesh, places)
    return np.where(np.nan_to_num(heights, nan=np.inf) <= places[:, None, 1], heights, -np.inf).max(
        axis=1, initial=-np.inf
    )


def _over(mesh, places):
    """Distance from each place to the first surface above it."""
    heights = _heights(mesh, places)
    found = np.where(np.nan_to_num(heights, nan=-np.inf) >= places[:, None, 1], heights, np.inf)
    return found.min(axis=1, initial=np.inf) - places[:, 1]


def _first_beside(mesh, places, ways, height_m):
    """Distance along level rays over places to the first triangle."""
    far = np.full(len(places), np.inf)
    (a, b, c) = mesh.transpose(1, 0, 2)
    one, two = b - a, c - a
    for number, (place, way) in enumerate(zip(places, ways, strict=True)):
        start, ray = above(place, height_m), np.array([way[0], 0.0, way[1]])
        cross = np.cross(ray, two)
        det = (one * cross).sum(axis=1)
        is_along = np.abs(det) < 1e-12
        det = np.where(is_along, 1.0, det)
        from_a = start - a
        u = (from_a * cross).sum(axis=1) / det
        q = np.cross(from_a, one)
        v = (q @ ray) / det
        t = (q * two).sum(axis=1) / det
        hits = ~is_along & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
        far[number] = t[hits].min(initial=np.inf)
    return far
