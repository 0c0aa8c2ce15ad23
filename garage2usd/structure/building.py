"""A building: one structure a level, and the ramps that link the levels.

Every level has the same R and C, so that columns stand above one another. S keeps its five values on each level: the
squares of a ramp are obstacles on all levels, a landing is an exit (3) of the level that cars leave over it, and an
entrance (2) of the level that they reach.
"""

import hashlib
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.config.site import LinkKind
from garage2usd.garage.levels import LevelPlace, level_places, places_at
from garage2usd.structure.grid import Cell, CellArray, Structure
from garage2usd.structure.stalls import Edge

Square = tuple[int, int]


class Link(NamedTuple):
    """A one-way ramp from one level to the next.

    Attributes
    ----------
    kind
        Its kind.
    squares
        (row, col) of its squares from its head to its foot.
    head, foot
        (row, col) of the landing at the top, on the upper level, and of the one at the bottom, on the lower level.
    is_down
        True if cars drive down.
    head_way, foot_way
        Directions from the landings to the ramp.
    """

    kind: LinkKind
    squares: tuple[Square, ...]
    head: Square
    foot: Square
    is_down: bool
    head_way: Edge
    foot_way: Edge


class Ramps(ABC):
    """A ramp down and a ramp up, in the same squares between each two levels."""

    @property
    @abstractmethod
    def links(self) -> tuple[Link, Link]:
        """The ramp down and the ramp up."""

    @property
    @abstractmethod
    def tape(self) -> str:
        """Tape of the ramps: words joined by commas, from which they are made again."""

    @property
    @abstractmethod
    def place(self) -> tuple[Square, Edge, Edge, int]:
        """Square, way, direction aside and count of `garage2usd.config.site.RampsPlace`."""

    @property
    @abstractmethod
    def in_words(self) -> str:
        """Tell where the ramps are."""

    @property
    def squares(self) -> tuple[Square, ...]:
        """(row, col) of the squares of both ramps."""
        return tuple(square for link in self.links for square in link.squares)

    @property
    def landings(self) -> tuple[Square, ...]:
        """(row, col) of the four landings."""
        return tuple(square for link in self.links for square in (link.head, link.foot))

    @property
    def approaches(self) -> tuple[Square, ...]:
        """(row, col) of the squares ahead of the landings, which link them with the lanes."""
        ahead = (
            (link.head_way.opposite.beyond(link.head), link.foot_way.opposite.beyond(link.foot)) for link in self.links
        )
        return tuple(square for pair in ahead for square in pair)


@dataclass(frozen=True)
class Flight(Ramps):
    """A pair of straight one-way ramps side by side, in the same squares between each two levels.

    Attributes
    ----------
    head
        (row, col) of the landing at the head of the ramp down.
    way
        Direction of the way down.
    length
        Number of squares of each ramp.
    keeps_left
        True if traffic keeps to the left: then the ramp up is on the right of the ramp down.
    """

    head: Square
    way: Edge
    length: int
    keeps_left: bool = False

    @property
    def right(self) -> Edge:
        """Direction across the ramps, to the right when looking up the ramps."""
        return {Edge.DOWN: Edge.RIGHT, Edge.UP: Edge.LEFT, Edge.RIGHT: Edge.UP, Edge.LEFT: Edge.DOWN}[self.way]

    @property
    def aside(self) -> Edge:
        """Direction from the ramp down to the ramp up, which is the side of traffic when driving up."""
        return self.right.opposite if self.keeps_left else self.right

    @cached_property
    def links(self) -> tuple[Link, Link]:
        """The ramp down and the ramp up."""
        return self._link(self.head, is_down=True), self._link(self.aside.beyond(self.head), is_down=False)

    @property
    def tape(self) -> str:
        """Row and column of the head, way down, and number of squares."""
        return f"{self.head[0]},{self.head[1]},{self.way.name},{self.length}"

    @property
    def place(self) -> tuple[Square, Edge, Edge, int]:
        """Square, way and direction aside by which settings give them, and number of squares."""
        return self.head, self.way, self.aside, self.length

    @property
    def in_words(self) -> str:
        """Tell where the ramps are."""
        return f"one down and one up from {list(self.head)} {self.way.name.lower()}, {self.length} squares each"

    def run_m(self, structure: Structure) -> float:
        """Length of the ramps' squares in metres."""
        sides = structure.row_depths_mm if self.way.along_x else structure.column_widths_mm
        axis = 0 if self.way.along_x else 1
        return float(sum(int(sides[square[axis]]) for square in self.links[0].squares)) / 1000

    def side_m(self, structure: Structure, square: Square) -> float:
        """Extent in metres of a square across the ramps."""
        row, col = square
        sides = structure.column_widths_mm[col] if self.way.along_x else structure.row_depths_mm[row]
        return float(sides) / 1000

    def _link(self, head: Square, *, is_down: bool) -> Link:
        squares, square = [], head
        for _ in range(self.length):
            square = self.way.beyond(square)
            squares.append(square)
        foot = self.way.beyond(square)
        return Link(LinkKind.STRAIGHT, tuple(squares), head, foot, is_down, self.way, self.way.opposite)


def level_cells(cells: CellArray, ramps: Ramps, level: int, levels: int) -> CellArray:
    """Write the ramps on the static squares of a level.

    Parameters
    ----------
    cells
        int8, shape (rows, cols): static squares of the top level with the portals to the street.
    ramps
        The ramps.
    level, levels
        Number of the level from 0, and the number of levels.

    Returns
    -------
    CellArray
        A new matrix: below the top level the portals to the street are free squares.
    """
    result = cells.copy()
    if level:
        result[result >= Cell.ENTRANCE] = Cell.FREE
    for square in ramps.squares:
        result[square] = Cell.OBSTACLE
    for link in ramps.links:
        if level < levels - 1:
            result[link.head] = Cell.EXIT if link.is_down else Cell.ENTRANCE
        if level:
            result[link.foot] = Cell.ENTRANCE if link.is_down else Cell.EXIT
    return result


@dataclass(frozen=True, eq=False)
class Building:
    """The complete structures of all levels and the ramps between them.

    Attributes
    ----------
    levels
        Structure of each level, the top one first.
    ramps
        The ramps between each two levels; None of a single level.
    storey_m
        Height from floor to floor in metres.
    floors_m
        Height of the floor of each level that was surveyed, where each has tiles of its own; None if it was planned.

    Raises
    ------
    ConfigError
        If planned levels differ in R or C, or a square of a ramp is not an obstacle on a level.
    """

    levels: tuple[Structure, ...]
    ramps: Ramps | None
    storey_m: float
    floors_m: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        """Refuse planned levels that do not stand above one another."""
        first, *others = self.levels if self.floors_m is None else self.levels[:1]
        for level, structure in enumerate(others, start=1):
            for name, one, other in (
                ("R", first.column_widths_mm, structure.column_widths_mm),
                ("C", first.row_depths_mm, structure.row_depths_mm),
            ):
                if not np.array_equal(one, other):
                    raise ConfigError(f"levels[{level}].{name}", (other / 1000).tolist(), "the sides of the top level")
        for level, structure in enumerate(self.levels):
            for square in self.ramp_squares:
                if structure.cells[square] != Cell.OBSTACLE:
                    raise ConfigError(f"levels[{level}].S", list(square), "-1 on each square of a ramp")

    @property
    def links(self) -> tuple[Link, ...]:
        """The ramp down and the ramp up between each two levels; none of a single level."""
        return () if self.ramps is None else self.ramps.links

    @property
    def ramp_squares(self) -> tuple[Square, ...]:
        """(row, col) of the squares of the ramps, the same on all levels."""
        return () if self.ramps is None else self.ramps.squares

    @property
    def places(self) -> list[LevelPlace]:
        """Places of the levels, the top one first."""
        return level_places(len(self.levels), self.storey_m) if self.floors_m is None else places_at(self.floors_m)

    def digest(self) -> str:
        """Return the SHA-256 of the digests of all levels; of a single level its own digest."""
        digests = [structure.digest() for structure in self.levels]
        return digests[0] if len(digests) == 1 else hashlib.sha256("".join(digests).encode()).hexdigest()
