"""The stalls of a garage as quads on the ground, and what a file says of lanes and stalls that contradicts itself."""

import math
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from typing import NamedTuple

import shapely

from garage2usd.garage.lanes import Point

__all__ = ["Fault", "Stall", "StallKind", "StallUse"]

_SQUARE_DEG = 1.0
"""How far from a right angle the sides of a stall still count as square to its mouth."""
_LEAST_SKEW = 1e-4
_YAW_DIGITS = 5


class StallUse(StrEnum):
    """What a stall is for."""

    STANDARD = "standard"
    TURNING = "turning"
    """Kept free, so that cars turn at the end of a long dead-end aisle."""
    EV = "ev"
    """With a charger."""
    ACCESSIBLE = "accessible"
    """For people with a disability, beside an access aisle."""
    ACCESS_AISLE = "access_aisle"
    """Hatched and kept free, so that wheelchairs get to the accessible stalls beside it."""
    UNREACHABLE = "unreachable"
    """Hatched and kept free, because cars do not get into it and out of it."""

    @property
    def takes_cars(self) -> bool:
        """Whether cars park there."""
        return self not in {StallUse.TURNING, StallUse.ACCESS_AISLE, StallUse.UNREACHABLE}


class StallKind(StrEnum):
    """How a stall lies to the lane that it opens onto."""

    PERPENDICULAR = "perpendicular"
    """Square to its mouth, and at least as long as wide."""
    PARALLEL = "parallel"
    """Square to its mouth, and wider than long: a car stands along the lane."""
    ANGLED = "angled"
    """With sides that are not square to its mouth."""


class Fault(NamedTuple):
    """A contradiction in what a file says of its lanes and stalls.

    Attributes
    ----------
    rule
        Id of the rule of `garage2usd.checks` that reports it.
    place, position
        Where; the position is None where it has none.
    message
        What is wrong.
    """

    rule: str
    place: str
    position: Point | None
    message: str


@dataclass(frozen=True)
class Stall:
    """A stall.

    Attributes
    ----------
    name
        Its id.
    corners
        (x, z) in metres: mouth left, mouth right, rear right, rear left as a driver sees them.
    use
        What it is for.
    access
        Number of the lane node that its mouth opens onto.
    facts
        What else is said of it, by name: its number, its type, its square, the edge of the square that it opens onto
        whether a car stands in it (`occupied`), as far as they are known, and the id of the stall of the misparked
        car that blocks it (`blocked_by`), if one does.
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
        """What is painted in it, where that is known."""
        return dict(self.facts).get("number")

    @property
    def blocked_by(self) -> str | None:
        """Id of the stall of the misparked car that blocks it, if one does."""
        found = dict(self.facts).get("blocked_by")
        return None if found is None else str(found)

    @property
    def is_occupied(self) -> bool | None:
        """Whether a car stands in it, its own or one that blocks it; None where that is not said."""
        found = dict(self.facts).get("occupied")
        return None if found is None else bool(found)

    def vacated(self) -> "Stall":
        """The same without a car in it."""
        kept = ((fact, value) for fact, value in self.facts if fact not in {"occupied", "blocked_by"})
        return replace(self, facts=(*kept, ("occupied", 0)))

    @property
    def takes_cars(self) -> bool:
        """Whether cars park there."""
        return self.use.takes_cars

    @property
    def width_m(self) -> float:
        """From line to line."""
        left, right, rear_right, rear_left = self.corners
        return min(math.dist(left, right), math.dist(rear_left, rear_right))

    @property
    def length_m(self) -> float:
        """From mouth to rear."""
        left, right, rear_right, rear_left = self.corners
        return min(math.dist(left, rear_left), math.dist(right, rear_right))

    @property
    def angle_deg(self) -> float:
        """From its mouth, left to right, to its left side; 90 where they are square."""
        (left_x, left_z), (right_x, right_z), _, (rear_x, rear_z) = self.corners
        right, forward = right_x - left_x, right_z - left_z
        along, back = rear_x - left_x, rear_z - left_z
        # seen from above, with X to the right and Z downwards, the left side is a turn to the left from the mouth
        return math.degrees(math.atan2(forward * along - right * back, right * along + forward * back))

    @property
    def kind(self) -> StallKind:
        """How it lies to its lane."""
        if abs(self.angle_deg - 90) > _SQUARE_DEG:
            return StallKind.ANGLED
        return StallKind.PARALLEL if self.width_m > self.length_m else StallKind.PERPENDICULAR

    @cached_property
    def centre(self) -> Point:
        """Its middle."""
        return _middle(*self.corners)

    @cached_property
    def mouth(self) -> Point:
        """Middle of its mouth."""
        return _middle(*self.corners[:2])

    @cached_property
    def outwards(self) -> Point:
        """Unit vector from its rear to its mouth."""
        rear, mouth = _middle(*self.corners[2:]), self.mouth
        length = math.dist(rear, mouth) or 1.0
        return (mouth[0] - rear[0]) / length, (mouth[1] - rear[1]) / length

    @property
    def yaw_rad(self) -> float:
        """Turn about +Y of a car that stands in it nose in, 0 where that looks to -Z; quarter turns are exact."""
        x, z = self.outwards
        if abs(x * z) > _LEAST_SKEW:
            return round(math.atan2(x, z), _YAW_DIGITS)
        return math.atan2(round(x) + 0.0, round(z) + 0.0)

    @cached_property
    def polygon(self) -> shapely.Polygon:
        """Its ground."""
        return shapely.Polygon(self.corners)


def _middle(*points: Point) -> Point:
    return sum(x for x, _ in points) / len(points), sum(z for _, z in points) / len(points)
