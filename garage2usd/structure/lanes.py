"""The lanes of a structure: the directions in which they are driven, and dead-end aisles."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.garage import DEAD_END_LIMIT_M
from garage2usd.structure.grid import Cell, Structure, squares_beside

_MM_PER_M = 1000
DEAD_END_LIMIT_MM = round(DEAD_END_LIMIT_M * _MM_PER_M)
Square = tuple[int, int]
Step = tuple[Square, Square]
"""Two lane squares that share a side, in the direction of driving."""


@dataclass(frozen=True)
class DeadEnd:
    """A dead-end aisle of lane squares.

    Attributes
    ----------
    squares
        (row, col) of its lanes from the tip back to the next junction or portal.
    length_m
        Length from its tip to the next junction or portal.
    needs_turning_stall
        True if the aisle is too long to back out of.
    """

    squares: tuple[Square, ...]
    length_m: float
    needs_turning_stall: bool

    @property
    def tip(self) -> Square:
        """(row, col) of the last lane of the dead end."""
        return self.squares[0]


def dead_ends(structure: Structure, limit_mm: int = DEAD_END_LIMIT_MM) -> tuple[DeadEnd, ...]:
    """Find all dead ends of a structure, in reading order, by walking from each tip to the next junction or portal.

    A dead end longer than `limit_mm` needs a turning stall.
    """
    drivable = {(int(row), int(col)) for row, col in np.argwhere(structure.cells >= Cell.LANE)}
    beside = {
        square: [other for other in squares_beside(square) if other in drivable]
        for square in structure.where(Cell.LANE)
    }
    found = []
    for tip, neighbours in beside.items():
        if len(neighbours) > 1:
            continue
        squares, end = _walk_back(tip, beside)
        length_mm = sum(
            int(structure.row_depths_mm[row] if ahead[0] != row else structure.column_widths_mm[col])
            for (row, col), ahead in pairwise((*squares, end or tip))
        )
        found.append(DeadEnd(tuple(squares), length_mm / _MM_PER_M, length_mm > limit_mm))
    return tuple(found)


def _walk_back(tip: Square, beside: Mapping[Square, Sequence[Square]]) -> tuple[list[Square], Square | None]:
    """Return the lanes of a dead end from its tip, and the junction or portal at its mouth, if any."""
    lanes, ahead = [tip], [*beside[tip]]
    while ahead and len(beside.get(ahead[0], ())) == 2:  # noqa: PLR2004 - neither a junction nor a portal
        lanes.append(ahead[0])
        ahead = [other for other in beside[lanes[-1]] if other != lanes[-2]]
    return lanes, ahead[0] if ahead else None


@dataclass(frozen=True)
class LaneDirections:
    """One-way steps between lane squares; all other steps are driven both ways.

    Attributes
    ----------
    one_way
        Steps in the direction of driving.
    """

    one_way: frozenset[Step] = frozenset()

    def allows(self, start: Square, end: Square) -> bool:
        """Return True if cars may drive from a lane square to an adjacent one."""
        return (end, start) not in self.one_way

    def is_one_way(self, start: Square, end: Square) -> bool:
        """Return True if cars may drive between two adjacent squares in one direction only."""
        return not (self.allows(start, end) and self.allows(end, start))

    def stretches(self, structure: Structure) -> tuple[tuple[Square, ...], ...]:
        """Return the one-way stretches of lane, each as its squares in the direction of driving, in reading order."""
        found = []
        for stretch in stretches_of(structure):
            found += [way for way in (stretch, stretch[::-1]) if (way[0], way[1]) in self.one_way]
        return tuple(found)

    @classmethod
    def of_stretches(cls, stretches: Iterable[tuple[Square, ...]]) -> "LaneDirections":
        """Create directions from one-way stretches, each as its squares in the direction of driving."""
        return cls(frozenset(step for stretch in stretches for step in pairwise(stretch)))


BOTH_WAYS = LaneDirections()
"""All lanes are driven both ways."""


def lane_squares_graph(structure: Structure) -> "nx.Graph[Square]":
    """Return the lane squares, without portals, joined where they share a side; nodes in reading order."""
    graph: nx.Graph[Square] = nx.Graph()
    lanes = structure.where(Cell.LANE)
    graph.add_nodes_from(lanes)
    inside = set(lanes)
    for lane in lanes:
        graph.add_edges_from((lane, other) for other in squares_beside(lane) if other in inside)
    return graph


def stretches_of(structure: Structure) -> tuple[tuple[Square, ...], ...]:
    """Split the lanes into stretches from one junction or dead end to the next, in reading order.

    A stretch is a path of squares whose inner squares have two neighbours. A ring without junctions is one stretch that
    ends where it begins.
    """
    return tuple(sorted(_stretches(lane_squares_graph(structure))))


def _stretches(graph: "nx.Graph[Square]") -> Iterator[tuple[Square, ...]]:
    ends = {square for square in graph if graph.degree(square) != 2}  # noqa: PLR2004 - neither a junction nor a tip
    done: set[frozenset[Square]] = set()
    for start in [*sorted(ends), *graph]:
        for onward in sorted(graph[start]):
            if frozenset((start, onward)) in done:
                continue
            path = [start, onward]
            while path[-1] not in ends and path[-1] != start:
                path.append(next(other for other in graph[path[-1]] if other != path[-2]))
            done.update(map(frozenset, pairwise(path)))
            yield tuple(path)


def aisles_of(structure: Structure) -> list[tuple[tuple[Square, ...], ...]]:
    """Join the stretches that go straight on at junctions to aisles, each as its stretches from one end to the other.

    Adjacent stretches of an aisle share the square of their junction; a lane square without neighbours is an aisle too.
    """
    stretches = stretches_of(structure)
    leaving = {way[:2]: way for stretch in stretches for way in (stretch[::-1], stretch)}

    def followed(way: tuple[Square, ...]) -> list[tuple[Square, ...]]:
        aisle = [way]
        while True:
            (row, col), (from_row, from_col) = aisle[-1][-1], aisle[-1][-2]
            onward = leaving.get(((row, col), (2 * row - from_row, 2 * col - from_col)))
            if onward is None or {onward, onward[::-1]} & {*aisle}:
                return aisle
            aisle.append(onward)

    aisles: list[tuple[tuple[Square, ...], ...]] = []
    done: set[tuple[Square, ...]] = set()
    for stretch in stretches:
        if stretch not in done:
            aisle = followed(followed(stretch)[-1][::-1])
            done.update(way for each in aisle for way in (each, each[::-1]))
            aisles.append(tuple(aisle))
    lonely = {*structure.where(Cell.LANE)}.difference(square for stretch in stretches for square in stretch)
    return aisles + [((square,),) for square in sorted(lonely)]


def given_directions(structure: Structure, one_way: Iterable[Step], *, field: str) -> LaneDirections:
    """Turn whole stretches of lane to given one-way steps.

    Parameters
    ----------
    structure
        With lanes.
    one_way
        Steps in the direction of driving, one or more for each one-way stretch.
    field
        Name of the setting with the steps, for the error.

    Raises
    ------
    ConfigError
        If a step does not lead from a lane to an adjacent lane, or two steps turn one stretch both ways.
    """
    of_step: dict[Step, tuple[Square, ...]] = {}
    for stretch in stretches_of(structure):
        for path in (stretch, stretch[::-1]):
            of_step.update(dict.fromkeys(pairwise(path), path))
    chosen: dict[tuple[Square, ...], None] = {}
    for number, (start, end) in enumerate(one_way):
        path = of_step.get((start, end), ())
        told = f"{list(start)} to {list(end)}"
        if not path:
            raise ConfigError(f"{field}[{number}]", told, "a step from a lane square to an adjacent one")
        if path[::-1] in chosen and path[::-1] != path:
            raise ConfigError(f"{field}[{number}]", told, "the direction of the step given before for that stretch")
        chosen[path] = None
    return LaneDirections.of_stretches(chosen)
