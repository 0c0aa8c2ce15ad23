"""Lane squares as pieces of road: where they open to their neighbours and outside, and how cars pass there."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.driven_road import Mouth, portal_mouths
from garage2usd.driving import RampFloor
from garage2usd.garage import LaneKind
from garage2usd.maps.frame import map_point
from garage2usd.maps.reference_line import Point

__all__ = ["OUTSIDE", "Opening", "Square", "lane_squares"]

OUTSIDE = -1
"""Stands for the number of the square beyond a portal's door."""
_MOST_INSET_M, _LEAST_INSET_M = 0.3, 0.05
"""How far roads reach into the square of a junction, so that two junctions side by side have a road between them."""
_OPPOSITE = -0.999
"""Cosine between the directions of two openings that face each other."""
_JUNCTION = 3


@dataclass(frozen=True)
class Opening:
    """A side of a square across which cars drive.

    Attributes
    ----------
    towards
        Number of the square beyond it, or `OUTSIDE`.
    place
        Its middle.
    outwards
        Unit vector out of the square.
    width_m
        Of the carriageway across it.
    lets_in, lets_out
        In which directions it is driven.
    inset_m
        How far a road across it reaches into the square if that is a junction.
    """

    towards: int
    place: Point
    outwards: Point
    width_m: float
    lets_in: bool
    lets_out: bool
    inset_m: float

    @property
    def is_one_way(self) -> bool:
        """Whether it is driven in one direction only."""
        return self.lets_in != self.lets_out

    def inside(self, distance_m: float) -> Point:
        """The point on its middle line at a distance from it in the square."""
        return self.place[0] - distance_m * self.outwards[0], self.place[1] - distance_m * self.outwards[1]


@dataclass(frozen=True, eq=False)
class Square:
    """A lane square or a portal.

    Attributes
    ----------
    number
        Of its node.
    name
        Its row and column.
    middle
        Its middle.
    openings
        To its neighbours in the order of their numbers, that to the outside last.
    ramp
        The floor of the ramp that begins where a portal's square ends; None where there is none.
    outside_m
        From there to the top of that ramp.
    """

    number: int
    name: str
    middle: Point
    openings: tuple[Opening, ...]
    ramp: RampFloor | None = None
    outside_m: float = 0.0

    @property
    def is_junction(self) -> bool:
        """Whether three or more ways meet in it."""
        return len(self.openings) >= _JUNCTION

    @property
    def is_portal(self) -> bool:
        """Whether it opens to the outside."""
        return any(opening.towards == OUTSIDE for opening in self.openings)

    def opening(self, towards: int) -> Opening:
        """Its opening to a neighbour."""
        return next(opening for opening in self.openings if opening.towards == towards)

    def far_from(self, opening: Opening) -> Opening | None:
        """The opening opposite to another; None where it has none there."""
        facing = (other for other in self.openings if _cosine(other.outwards, opening.outwards) < _OPPOSITE)
        return next(facing, None)

    def end_opposite(self, opening: Opening) -> Point:
        """Where a dead end ends that is entered through an opening: as far from the middle as the opening is."""
        return opening.inside(2 * math.dist(opening.place, self.middle))


def lane_squares(garage: BuiltGarage) -> tuple[Square, ...]:
    """The lane squares and portals of a garage, in the order of its nodes."""
    mouths = {mouth.number: mouth for mouth in portal_mouths(garage)}
    # several edges may join the same two squares in a stage that was edited
    widths_m = {frozenset((edge.start, edge.end)): edge.width_m for edge in garage.lanes.edges}
    squares = []
    for number, node in enumerate(garage.lanes.nodes):
        openings, mouth = tuple(_to_neighbours(garage, number, widths_m)), mouths.get(number)
        # a door that opens onto a lane leads nowhere
        if mouth is None or any(_cosine(way.outwards, map_point(mouth.outwards)) > -_OPPOSITE for way in openings):
            squares.append(Square(number, node.name, map_point(node.position), openings))
        else:
            openings = (*openings, _to_outside(garage, mouth))
            outside_m = mouth.top_m(node.position) - mouth.edge_m
            squares.append(Square(number, node.name, map_point(node.position), openings, mouth.ramp, outside_m))
    return tuple(squares)


def _to_neighbours(garage: BuiltGarage, number: int, widths_m: Mapping[frozenset[int], float]) -> Iterator[Opening]:
    """Sides of squares lie where the columns stand back equally far on both."""
    node, middle = garage.lanes.nodes[number], map_point(garage.lanes.nodes[number].position)
    for other in sorted(set(garage.lanes.beside[number]) - {number}):
        beyond = map_point(garage.lanes.nodes[other].position)
        apart_m = math.dist(middle, beyond)
        if apart_m == 0:
            continue
        outwards = (beyond[0] - middle[0]) / apart_m, (beyond[1] - middle[1]) / apart_m
        axis = 0 if abs(outwards[0]) > abs(outwards[1]) else 1
        clear_m, clear_beyond_m = node.widths_m[axis] / 2, garage.lanes.nodes[other].widths_m[axis] / 2
        setback_m = (apart_m - clear_m - clear_beyond_m) / 2
        half_m = clear_m + setback_m
        place = middle[0] + half_m * outwards[0], middle[1] + half_m * outwards[1]
        width_m = widths_m[frozenset((number, other))]
        lets_in = other in garage.lanes.backward[number] and _may_drive(garage, other, number)
        lets_out = other in garage.lanes.onward[number] and _may_drive(garage, number, other)
        if lets_in or lets_out:
            yield Opening(other, place, outwards, width_m, lets_in, lets_out, _inset_m(setback_m))


def _may_drive(garage: BuiltGarage, start: int, end: int) -> bool:
    """Whether cars drive from a square to another inside: they leave by an exit, and come from an entrance."""
    return garage.lanes.nodes[start].kind != LaneKind.EXIT and garage.lanes.nodes[end].kind != LaneKind.ENTRANCE


def _to_outside(garage: BuiltGarage, mouth: Mouth) -> Opening:
    node = garage.lanes.nodes[mouth.number]
    middle, outwards = map_point(node.position), map_point(mouth.outwards)
    place = middle[0] + mouth.edge_m * outwards[0], middle[1] + mouth.edge_m * outwards[1]
    is_entrance = node.kind == LaneKind.ENTRANCE
    return Opening(OUTSIDE, place, outwards, mouth.width_m, is_entrance, not is_entrance, _MOST_INSET_M)


def _inset_m(setback_m: float) -> float:
    return min(_MOST_INSET_M, max(_LEAST_INSET_M, setback_m / 2))


def _cosine(one: Point, other: Point) -> float:
    return one[0] * other[0] + one[1] * other[1]
