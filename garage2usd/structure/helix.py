"""A pair of one-way helices: two mirrored blocks of squares, in each of which cars turn once from level to level."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from garage2usd.config.site import LinkKind
from garage2usd.garage.ramp_lines import CoilLine
from garage2usd.structure.building import Link, Ramps, Square
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

LANE_M = 4.2
"""Width of a helix between its walls; 3.84 m between kerbs."""
WALL_M = 0.2
"""Thickness of the walls along it."""
_LEFT_OF = {Edge.DOWN: Edge.RIGHT, Edge.UP: Edge.LEFT, Edge.RIGHT: Edge.UP, Edge.LEFT: Edge.DOWN}


@dataclass(frozen=True)
class CoilBlock:
    """The squares of one of the two helices.

    Attributes
    ----------
    corner
        (row, col) of the corner square, where the lanes in and out cross, one storey apart.
    way, aside
        Directions from the corner square into the block: from the landings of both helices in a row, and from the
        other landing.
    count
        Number of squares along each side.
    head_is_first
        True if the landing of the upper level is the one in a row with the other helix.
    """

    corner: Square
    way: Edge
    aside: Edge
    count: int
    head_is_first: bool

    @property
    def squares(self) -> tuple[Square, ...]:
        """(row, col) of the squares of the block, around the turn from head to foot, then the inner ones."""
        rim = [self._square(i, j) for i, j in self._rim()]
        inner = [self._square(i, j) for i in range(1, self.count - 1) for j in range(1, self.count - 1)]
        return (*(rim if self.head_is_first else [rim[0], *rim[:0:-1]]), *inner)

    def link(self, *, is_down: bool) -> Link:
        """Return the helix as a link between two levels."""
        ends = [(way.opposite.beyond(self.corner), way) for way in (self.way, self.aside)]
        (head, head_way), (foot, foot_way) = ends if self.head_is_first else ends[::-1]
        return Link(LinkKind.HELIX, self.squares, head, foot, is_down, head_way, foot_way)

    def sides_m(self, structure: Structure) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Extents in metres of its squares along `way` and along `aside`, from the corner square on."""
        return self._lines_m(structure, self.way), self._lines_m(structure, self.aside)

    def line(self, structure: Structure, wall_m: float) -> CoilLine:
        """Return the middle line, along u = `way` and v = `aside`; `wall_m` is the thickness of the block's walls."""
        along, across = self.sides_m(structure)
        beside_m = WALL_M + wall_m + 0.05
        return CoilLine.within((along[0], across[0]), (sum(along), sum(across)), width_m=LANE_M, beside_m=beside_m)

    def lines(self, way: Edge) -> list[int]:
        """Numbers of the rows or columns of the block along a direction, from the corner square on."""
        axis = 0 if way.along_x else 1
        step = way.beyond((0, 0))[axis]
        return [self.corner[axis] + step * number for number in range(self.count)]

    def _lines_m(self, structure: Structure, way: Edge) -> tuple[float, ...]:
        sides = structure.row_depths_mm if way.along_x else structure.column_widths_mm
        return tuple(float(sides[line]) / 1000 for line in self.lines(way))

    def _square(self, i: int, j: int) -> Square:
        (down, right), (aside_down, aside_right) = self.way.beyond((0, 0)), self.aside.beyond((0, 0))
        row, col = self.corner
        return row + i * down + j * aside_down, col + i * right + j * aside_right

    def _rim(self) -> Iterator[tuple[int, int]]:
        last = self.count - 1
        yield from ((i, 0) for i in range(last))
        yield from ((last, j) for j in range(last))
        yield from ((i, last) for i in range(last, 0, -1))
        yield from ((0, j) for j in range(last, 0, -1))


@dataclass(frozen=True)
class Helix(Ramps):
    """Two one-way helices side by side, one down and one up, in the same squares between each two levels.

    Cars enter the corner square of a block from a landing, drive round three quarters of a circle, and leave through
    the corner square at right angles, a storey higher or lower.

    Attributes
    ----------
    corner
        (row, col) of the corner square of the helix down.
    way
        Direction into the blocks from the landings of both helices in a row.
    aside
        Direction from the helix down to the one up.
    count
        Number of squares along each side of a block.
    keeps_left
        True if traffic keeps to the left: cars then turn to the right, else to the left, with the driver inside.
    """

    corner: Square
    way: Edge
    aside: Edge
    count: int
    keeps_left: bool = False

    @cached_property
    def blocks(self) -> tuple[CoilBlock, CoilBlock]:
        """Blocks of the helix down and of the helix up."""
        far = self.corner
        for _ in range(2 * self.count - 1):
            far = self.aside.beyond(far)
        return self._block(self.corner, self.aside, is_down=True), self._block(far, self.aside.opposite, is_down=False)

    @cached_property
    def links(self) -> tuple[Link, Link]:
        """The helix down and the helix up."""
        down, up = self.blocks
        return down.link(is_down=True), up.link(is_down=False)

    @property
    def tape(self) -> str:
        """Kind, row and column of the corner square, both directions, and the number of squares."""
        row, col = self.corner
        return f"{LinkKind.HELIX},{row},{col},{self.way.name},{self.aside.name},{self.count}"

    @property
    def place(self) -> tuple[Square, Edge, Edge, int]:
        """Square, way and direction aside by which settings give them, and number of squares."""
        return self.corner, self.way, self.aside, self.count

    @property
    def in_words(self) -> str:
        """Tell where the ramps are."""
        squares = f"{self.count} x {self.count} squares each"
        return f"helices from {list(self.corner)}, one down and one up to its {self.aside.name.lower()}, {squares}"

    def _block(self, corner: Square, aside: Edge, *, is_down: bool) -> CoilBlock:
        # if both landings are in one row, incoming cars turn from `way` towards `aside`
        turns_left_by_first = _LEFT_OF[self.way] is aside
        enters_by_first = turns_left_by_first is not self.keeps_left
        return CoilBlock(corner, self.way, aside, self.count, head_is_first=enters_by_first is is_down)
