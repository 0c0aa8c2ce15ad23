"""Lanes and stalls as they lie on the ground: what a stage, a report and a plan say alike; metres, Y up."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import shapely

from garage2usd.layout import StallUse
from garage2usd.structure.lane_graph import LaneKind

__all__ = ["Fault", "LaneNode", "Point", "StallOutline"]

Point = tuple[float, float]
"""(x, z) in metres."""


class Fault(NamedTuple):
    """What a file says of its lanes and stalls that contradicts itself.

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
class StallOutline:
    """A stall.

    Attributes
    ----------
    name
        Its id.
    corners
        Mouth left, mouth right, rear right, rear left as a driver sees them.
    use
        What it is for.
    access
        Number of the lane node that its mouth opens onto.
    facts
        What else is said of it, by name: its number, its type, its square, the edge of the square that it opens onto
        whether a car stands in it (`occupied`), as far as they are known, and the id of the stall of the misparked
        car that blocks it (`blocked_by`), if one does.
    """

    name: str
    corners: tuple[Point, Point, Point, Point]
    use: StallUse
    access: int
    facts: tuple[tuple[str, str | int], ...] = ()

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

    @cached_property
    def polygon(self) -> shapely.Polygon:
        """Its ground."""
        return shapely.Polygon(self.corners)


@dataclass(frozen=True)
class LaneNode:
    """A lane square or a portal.

    Attributes
    ----------
    kind
        ``crossroads``, ``t_junction``, ``straight``, ``entrance`` or ``exit``.
    position
        Its middle.
    widths_m
        Metres between the columns across X and Z.
    name
        Its square, as ``[row, col]``.
    height_m
        At which its curve lies.
    """

    kind: str
    position: Point
    widths_m: tuple[float, float]
    name: str
    height_m: float = 0.0

    @property
    def is_portal(self) -> bool:
        """Whether cars enter or leave the garage here."""
        return self.kind in {LaneKind.ENTRANCE, LaneKind.EXIT}


def _middle(*points: Point) -> Point:
    return sum(x for x, _ in points) / len(points), sum(z for _, z in points) / len(points)
