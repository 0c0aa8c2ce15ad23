"""Lines of ramps between levels: heights along a ramp, and the middle line of one turn of a helix."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.native import elementary

_TURN_RAD = 1.5 * math.pi
_BESIDE_M = 0.3
"""Level part beside the crossing of the two straights: a wall and a little more."""
_STEP_RAD = math.pi / 36
Floats = NDArray[np.float64]


def ramp_profile(
    length_m: float, rise_m: float, gentle_m: float, ends_m: tuple[float, float]
) -> list[tuple[float, float]]:
    """Return (distance, height) pairs from the foot on: level end, half slope, slope, half slope, level end.

    Parameters
    ----------
    length_m, rise_m
        Length of the ramp as seen from above, and height from foot to head.
    gentle_m
        Length of each of the parts of half the slope.
    ends_m
        Lengths of the level ends at the foot and at the head.
    """
    sloped_m = length_m - sum(ends_m)
    slope = rise_m / (sloped_m - gentle_m)
    run, height = 0.0, 0.0
    profile = [(run, height)]
    for part_m, grade in (
        (ends_m[0], 0.0),
        (gentle_m, slope / 2),
        (sloped_m - 2 * gentle_m, slope),
        (gentle_m, slope / 2),
        (ends_m[1], 0.0),
    ):
        run, height = run + part_m, height + part_m * grade
        profile.append((run, height))
    return profile


class CoilPlaces(NamedTuple):
    """Places along a coil's line; all arrays have shape (n,).

    Attributes
    ----------
    u_m, v_m
        The places.
    along_u, along_v
        Unit vectors along the line.
    """

    u_m: Floats
    v_m: Floats
    along_u: Floats
    along_v: Floats

    def beside(self, inwards_m: float) -> Floats:
        """Return the points (u, v) at a distance towards the inside of the turn; float64, shape (n, 2)."""
        return np.stack([self.u_m - inwards_m * self.along_v, self.v_m + inwards_m * self.along_u], axis=1)


@dataclass(frozen=True)
class CoilLine:
    """A straight in, three quarters of a circle, and a straight out, which crosses the first one at right angles.

    Coordinates (u, v) have their origin at the outer corner of the coil's block: the line begins on the border u = 0,
    runs along +u, turns towards +v, and ends on the border v = 0.

    Attributes
    ----------
    first_v_m, last_u_m
        v of the first straight, and u of the last one.
    radius_m
        Radius of the circle.
    width_m
        Width between the walls.
    """

    first_v_m: float
    last_u_m: float
    radius_m: float
    width_m: float

    @classmethod
    def within(
        cls, corner: tuple[float, float], block: tuple[float, float], *, width_m: float, beside_m: float
    ) -> "CoilLine":
        """Return the line with the largest circle that a block holds.

        Parameters
        ----------
        corner, block
            Extents along u and v of the corner square, in whose middle the straights cross, and of the whole block.
        width_m, beside_m
            Width between the walls, and thickness of the walls.
        """
        last_u, first_v = corner[0] / 2, corner[1] / 2
        room = min(block[0] - last_u, block[1] - first_v) - width_m / 2 - beside_m
        return cls(round(first_v, 6), round(last_u, 6), round(room / 2, 6), width_m)

    @property
    def inner_radius_m(self) -> float:
        """Radius of the inner wall."""
        return round(self.radius_m - self.width_m / 2, 6)

    @property
    def middle(self) -> tuple[float, float]:
        """(u, v) of the middle of the circle."""
        return self.last_u_m + self.radius_m, self.first_v_m + self.radius_m

    @property
    def corner(self) -> tuple[float, float]:
        """Extents along u and v of the level part around the crossing, from the outer corner of the block."""
        half = self.width_m / 2 + _BESIDE_M
        return round(self.last_u_m + half, 6), round(self.first_v_m + half, 6)

    @property
    def bends_m(self) -> tuple[float, float]:
        """Distances along the line at which the circle begins and ends."""
        start = self.last_u_m + self.radius_m
        return start, start + _TURN_RAD * self.radius_m

    @property
    def length_m(self) -> float:
        """Length of the line, as seen from above."""
        return self.bends_m[1] + self.first_v_m + self.radius_m

    def at(self, run_m: ArrayLike) -> CoilPlaces:
        """Return the places at distances along the line, shape (n,)."""
        run = np.asarray(run_m, dtype=np.float64)
        start, end = self.bends_m
        angle = np.clip(run - start, 0.0, end - start) / self.radius_m
        sin, cos = elementary.sin(angle), elementary.cos(angle)
        before, after = np.minimum(run - start, 0.0), np.maximum(run - end, 0.0)
        mid_u, mid_v = self.middle
        return CoilPlaces(mid_u + self.radius_m * sin + before, mid_v - self.radius_m * cos - after, cos, sin)

    def foot(self, u_m: ArrayLike, v_m: ArrayLike) -> tuple[Floats, Floats]:
        """Project points onto the line: distances along it, and offsets towards the inside of the turn."""
        away_u, away_v = np.asarray(u_m) - self.middle[0], np.asarray(v_m) - self.middle[1]
        start, end = self.bends_m
        angle = np.mod(elementary.arctan2(away_u, -away_v), math.tau)
        on_circle = start + np.minimum(angle, _TURN_RAD) * self.radius_m
        is_before = (away_u < 0) & (away_v < 0) & (away_v <= away_u)
        is_after = (away_u < 0) & (away_v < 0) & ~is_before
        runs = np.where(is_before, start + away_u, np.where(is_after, end - away_v, on_circle))
        far = elementary.hypot(away_u, away_v)
        inwards = np.where(is_before, away_v, np.where(is_after, away_u, -far)) + self.radius_m
        return runs, inwards

    def profile(self, rise_m: float, gentle_m: float, *, foot_first: bool) -> tuple[tuple[float, float], ...]:
        """Return (distance, height) pairs along the line: level up to the crossing, transitions of half slope, slope.

        Parameters
        ----------
        rise_m, gentle_m
            Height from foot to head, and length of each transition.
        foot_first
            True if the line begins at the foot.
        """
        ends = self.corner if foot_first else self.corner[::-1]
        found = ramp_profile(self.length_m, rise_m, gentle_m, ends)
        pairs = found if foot_first else [(self.length_m - run, height) for run, height in found[::-1]]
        return tuple((round(run, 6), round(height, 6)) for run, height in pairs)

    def slope(self, rise_m: float, gentle_m: float) -> float:
        """Steepest slope along the line, between transitions of half of it; infinite if these leave no room."""
        room = self.length_m - sum(self.corner) - gentle_m
        return rise_m / room if room > gentle_m else math.inf

    def inner_slope(self, rise_m: float, gentle_m: float) -> float:
        """Steepest slope along the inner wall; infinite if the circle is too small for one."""
        if self.inner_radius_m <= 0:
            return math.inf
        return self.slope(rise_m, gentle_m) * self.radius_m / self.inner_radius_m

    def stations_m(self, profile: tuple[tuple[float, float], ...], *, step_rad: float = _STEP_RAD) -> Floats:
        """Return distances along the line at which it is cut into flat pieces; ascending.

        Parameters
        ----------
        profile
            Its `profile`: cuts lie at each change of slope, but not on the level ends.
        step_rad
            Turn of a piece of the circle.
        """
        start, end = self.bends_m
        runs = np.array([run for run, _ in profile[1:-1]])
        circle = np.linspace(start, end, round(_TURN_RAD / step_rad) + 1)
        cuts = np.unique(np.round(np.concatenate([runs, circle]), 6))
        kept: Floats = cuts[(cuts >= runs[0]) & (cuts <= runs[-1])]
        return kept


def heights_along(profile: tuple[tuple[float, float], ...], run_m: ArrayLike) -> Floats:
    """Return the heights of a profile of (distance, height) pairs at distances along a line; their shape."""
    runs, heights = zip(*profile, strict=True)
    return np.interp(np.asarray(run_m, dtype=np.float64), runs, heights)
