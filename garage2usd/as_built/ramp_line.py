"""The lane of a ramp between levels, straight or bent."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.openings import is_bent
from garage2usd.garage import Point
from garage2usd.garage.path_line import PathLine

_STRAIGHT_SIN, _LEAST_M2 = 0.02, 1e-9
_ROUND = 0.02
_LEAST_PLACES = 6


def _unit(x: float, z: float) -> Point:
    far = math.hypot(x, z) or 1.0
    return float(x) / far, float(z) / far


class Bend(NamedTuple):
    """The line of a ramp that bends: straight in, three quarters of a circle, straight out across itself.

    Attributes
    ----------
    crossing
        (x, z) where the straights cross.
    way_in, way_out
        Unit vectors (x, z) in the direction of driving.
    radius_m
        Radius of the circle.
    is_left
        True if cars turn to the left.
    """

    crossing: Point
    way_in: Point
    way_out: Point
    radius_m: float
    is_left: bool


class RampLine(NamedTuple):
    """The lane of a ramp between levels.

    Attributes
    ----------
    nodes
        Numbers of its lane nodes in the direction of driving, from landing to landing.
    places
        (x, height, z) of these; float64, shape (n, 3).
    sloped
        Numbers of those between which it rises or falls.
    width_m
        Width of its carriageway.
    """

    nodes: tuple[int, ...]
    places: NDArray[np.float64]
    sloped: tuple[int, ...]
    width_m: float

    @property
    def slope(self) -> NDArray[np.float64]:
        """(x, height, z) of the nodes between which it rises or falls; float64, shape (n, 3)."""
        first = self.nodes.index(self.sloped[0])
        return self.places[first : first + len(self.sloped)]

    @property
    def is_down(self) -> bool:
        """True if it leads down."""
        return bool(self.places[-1, 1] < self.places[0, 1])

    @property
    def is_straight(self) -> bool:
        """True if its ends lie in one line, and its slopes point in one direction."""
        (in_x, in_z), (out_x, out_z) = self._ways
        steps = np.diff(self.slope, axis=0)
        flat, rises = steps[:, [0, 2]], np.abs(steps[:, 1])
        slopes = flat * (rises / np.maximum((flat**2).sum(axis=1), _LEAST_M2))[:, None]
        is_in_line = abs(out_x * in_z - out_z * in_x) < _STRAIGHT_SIN and in_x * out_x + in_z * out_z > 0
        return is_in_line and not is_bent(slopes, rises)

    @property
    def line(self) -> PathLine:
        """Its middle line through (x, z) in the direction of driving."""
        return PathLine.through([(x, z) for x, _, z in self.places.tolist()], self.width_m)

    @property
    def bend(self) -> Bend | None:
        """The bend of a helix; None for a straight ramp, and for one that is not three quarters of a circle."""
        x, z = self.places[:, 0], self.places[:, 2]
        (in_x, in_z), (out_x, out_z) = self._ways
        turned = out_x * in_z - out_z * in_x
        if abs(turned) < 1 - _STRAIGHT_SIN:
            return None
        # the crossing lies ahead of the first place, in line with the last straight
        ahead = ((x[-1] - x[0]) * out_z - (z[-1] - z[0]) * out_x) / (in_x * out_z - in_z * out_x)
        crossing = float(x[0] + ahead * in_x), float(z[0] + ahead * in_z)
        radius = float(((x - crossing[0]) * in_x + (z - crossing[1]) * in_z).max()) / 2
        middle = crossing[0] + radius * (in_x - out_x), crossing[1] + radius * (in_z - out_z)
        away = np.hypot(x - middle[0], z - middle[1])
        if radius <= 0 or (np.abs(away - radius) < _ROUND * radius).sum() < _LEAST_PLACES:
            return None
        return Bend(crossing, (in_x, in_z), (out_x, out_z), radius, is_left=bool(turned < 0))

    @property
    def _ways(self) -> tuple[Point, Point]:
        """Unit vectors (x, z) along its first and its last piece."""
        x, z = self.places[:, 0], self.places[:, 2]
        return _unit(x[1] - x[0], z[1] - z[0]), _unit(x[-1] - x[-2], z[-1] - z[-2])
