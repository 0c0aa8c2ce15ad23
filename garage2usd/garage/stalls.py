"""The stalls of a garage as quads on the ground, and contradictions in a file's lanes and stalls."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import shapely

from garage2usd.garage.kinds import StallKind, StallUse
from garage2usd.garage.lanes import Point
from garage2usd.native import elementary

_SQUARE_DEG = 1.0
"""Tolerance in degrees for a stall whose sides are perpendicular to its mouth."""
_LEAST_SKEW = 1e-4
_YAW_DIGITS = 5


class Fault(NamedTuple):
    """A contradiction in a file's description of its lanes and stalls.

    Attributes
    ----------
    rule
        Id of the rule of `garage2usd.checks` that reports the fault.
    place, position
        Place of the fault; the position is None if unknown.
    message
        Fault in words.
    """

    rule: str
    place: str
    position: Point | None
    message: str


@dataclass(frozen=True)
class Stall:
    """A parking stall.

    Attributes
    ----------
    name
        Id of the stall.
    corners
        (x, z) in metres: mouth left, mouth right, rear right, rear left as seen by a driver entering the stall.
    use
        Use of the stall.
    access
        Number of the lane node in front of the stall's mouth.
    facts
        Further properties by name, as far as known: number, type, size class, square, edge of the square at the mouth,
        whether a car is parked there (`occupied`), and the id of the stall of the misparked car that blocks the stall
        (`blocked_by`).
    level
        Number of its level, from 0.
    """

    name: str
    corners: tuple[Point, Point, Point, Point]
    use: StallUse
    access: int
    facts: tuple[tuple[str, str | int], ...] = ()
    level: int = 0

    @property
    def number(self) -> str | int | None:
        """Number painted in the stall, if known."""
        return dict(self.facts).get("number")

    @property
    def blocked_by(self) -> str | None:
        """Id of the stall of the misparked car that blocks this stall; None without one."""
        found = dict(self.facts).get("blocked_by")
        return None if found is None else str(found)

    @property
    def is_occupied(self) -> bool | None:
        """True if a car parks in the stall or blocks it; None if unknown."""
        found = dict(self.facts).get("occupied")
        return None if found is None else bool(found)

    @property
    def size(self) -> str:
        """Size class of the stall; the standard one unless a fact says otherwise."""
        return str(dict(self.facts).get("size", "standard"))

    @property
    def is_usual(self) -> bool:
        """True if the stall is perpendicular and of the standard size class."""
        return self.kind is StallKind.PERPENDICULAR and self.size == "standard"

    @property
    def is_compact(self) -> bool:
        """True if the stall is of the size class for compact cars, which the design car is not."""
        return self.size == "compact"

    def vacated(self, *, is_taken: bool = False) -> "Stall":
        """Return the stall without a parked car, or with another one."""
        kept = ((fact, value) for fact, value in self.facts if fact not in {"occupied", "blocked_by"})
        return replace(self, facts=(*kept, ("occupied", int(is_taken))))

    @property
    def takes_cars(self) -> bool:
        """True if cars park in the stall."""
        return self.use.takes_cars

    @property
    def is_parked_in(self) -> bool:
        """True if cars or motorcycles park in the stall."""
        return self.use.is_parked_in

    @property
    def width_m(self) -> float:
        """Width in metres of the rectangle for a car between the stall's lines."""
        return self._rectangle_m[0]

    @property
    def length_m(self) -> float:
        """Length in metres of the rectangle for a car between the stall's lines."""
        return self._rectangle_m[1]

    @cached_property
    def _rectangle_m(self) -> tuple[float, float]:
        """Width and length of the largest rectangle along the stall's long sides."""
        mouth_m, side_m = self._sides_m
        if self.kind is StallKind.PARALLEL:
            return side_m, mouth_m
        if self.kind is StallKind.PERPENDICULAR:
            return mouth_m, side_m
        angle = math.radians(self.angle_deg)
        width_m = mouth_m * math.sin(angle)
        return width_m, side_m - abs(width_m / math.tan(angle))

    @cached_property
    def _sides_m(self) -> tuple[float, float]:
        """Length of the mouth and of the sides, the shorter of each pair."""
        left, right, rear_right, rear_left = self.corners
        return (
            min(math.dist(left, right), math.dist(rear_left, rear_right)),
            min(math.dist(left, rear_left), math.dist(right, rear_right)),
        )

    @cached_property
    def angle_deg(self) -> float:
        """Angle in degrees from the stall's mouth to its left side; 90 for a perpendicular stall."""
        (left_x, left_z), (right_x, right_z), _, (rear_x, rear_z) = self.corners
        right, forward = right_x - left_x, right_z - left_z
        along, back = rear_x - left_x, rear_z - left_z
        # seen from above, with X to the right and Z downwards, the left side is a turn to the left from the mouth
        return math.degrees(elementary.arctan2(forward * along - right * back, right * along + forward * back))

    @cached_property
    def kind(self) -> StallKind:
        """Orientation of the stall relative to its lane."""
        if abs(self.angle_deg - 90) > _SQUARE_DEG:
            return StallKind.ANGLED
        mouth_m, side_m = self._sides_m
        return StallKind.PARALLEL if mouth_m > side_m else StallKind.PERPENDICULAR

    @property
    def slant_deg(self) -> float:
        """Angle in degrees of the stall's long sides to the lane: 90 for perpendicular stalls, 0 for parallel ones."""
        if self.kind is StallKind.ANGLED:
            return min(self.angle_deg, 180 - self.angle_deg)
        return 0.0 if self.kind is StallKind.PARALLEL else 90.0

    @cached_property
    def centre(self) -> Point:
        """Centre of the stall."""
        return _middle(*self.corners)

    @cached_property
    def mouth(self) -> Point:
        """Midpoint of the stall's mouth."""
        return _middle(*self.corners[:2])

    @cached_property
    def outwards(self) -> Point:
        """Unit vector from the stall's rear to its mouth."""
        rear, mouth = _middle(*self.corners[2:]), self.mouth
        length = math.dist(rear, mouth) or 1.0
        return (mouth[0] - rear[0]) / length, (mouth[1] - rear[1]) / length

    @cached_property
    def backwards(self) -> Point:
        """Unit vector from the nose to the tail of a car parked nose in; in a parallel stall its left is the lane."""
        x, z = self.outwards
        return (z, -x) if self.kind is StallKind.PARALLEL else (x, z)

    @cached_property
    def tail(self) -> Point:
        """Midpoint of the short side of the rectangle for a car where the tail of a car parked nose in is."""
        if self.kind is StallKind.PERPENDICULAR:
            return self.mouth
        (x, z), (back_x, back_z), half_m = self.centre, self.backwards, self.length_m / 2
        return x + back_x * half_m, z + back_z * half_m

    @property
    def yaw_rad(self) -> float:
        """Yaw about +Y of a car parked nose in, 0 where its nose points to -Z; quarter turns are exact."""
        x, z = self.backwards
        if abs(x * z) > _LEAST_SKEW:
            return round(elementary.arctan2(x, z), _YAW_DIGITS)
        return elementary.arctan2(round(x) + 0.0, round(z) + 0.0)

    @cached_property
    def polygon(self) -> shapely.Polygon:
        """The stall's ground between its lines as a polygon."""
        return shapely.Polygon(self.corners)

    @cached_property
    def rectangle(self) -> shapely.Polygon:
        """The ground for a car between the stall's lines, without the triangles at mouth and rear of angled stalls."""
        if self.kind is not StallKind.ANGLED:
            return self.polygon
        (x, z), (back_x, back_z) = self.centre, self.backwards
        half_length_m, half_width_m = self.length_m / 2, self.width_m / 2
        return shapely.Polygon(
            [
                (
                    x + along * half_length_m * back_x - across * half_width_m * back_z,
                    z + along * half_length_m * back_z + across * half_width_m * back_x,
                )
                for along, across in ((1, 1), (1, -1), (-1, -1), (-1, 1))
            ]
        )


def _middle(*points: Point) -> Point:
    return sum(x for x, _ in points) / len(points), sum(z for _, z in points) / len(points)
