"""Stalls on squares: their shapes, the capacity of squares for score and layout, and the edges of doors.

A free square is served through an edge that it shares with a lane. Stalls are side by side along that edge, between
the columns on its two ends, with their length across the square. `garage2usd.structure.stall_runs` has the stalls of
other shapes, which are laid out along several squares.
"""

import math
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.site import BayConfig
from garage2usd.garage.kinds import StallKind
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, CellArray, Mask, Structure, outside_squares
from garage2usd.structure.squares import bordered

PERPENDICULAR_DEG, PARALLEL_DEG = 90.0, 0.0
_MM_PER_M = 1000


@dataclass(frozen=True)
class StallShape:
    """The size of a stall and its angle to the aisle.

    Attributes
    ----------
    width_m, length_m
        Sides of the rectangle for the car.
    angle_deg
        Angle between the stall's long sides and the aisle: 90 for perpendicular stalls, 0 for parallel ones.
    size
        Name of the size class.

    Notes
    -----
    With width w, length l and angle a, angled stalls are parallelograms of pitch w / sin a and depth
    l sin a + w cos a. Both are rounded up to the millimetre.
    """

    width_m: float
    length_m: float
    angle_deg: float = PERPENDICULAR_DEG
    size: str = "standard"

    @cached_property
    def kind(self) -> StallKind:
        """Orientation of the stall relative to its lane."""
        return kind_of_angle(self.angle_deg)

    @cached_property
    def pitch_m(self) -> float:
        """Length of the mouth, along the aisle."""
        if self.kind is StallKind.PARALLEL:
            return self.length_m
        return self.width_m if self.kind is StallKind.PERPENDICULAR else _rounded_up(self.width_m / self._sin)

    @cached_property
    def depth_m(self) -> float:
        """Extent across the aisle, from the mouth to the rear."""
        if self.kind is StallKind.PARALLEL:
            return self.width_m
        if self.kind is StallKind.PERPENDICULAR:
            return self.length_m
        return _rounded_up(self.length_m * self._sin + self.width_m * self._cos)

    @cached_property
    def slope(self) -> float:
        """Offset of the sides along the aisle per metre of depth: cot a for angled stalls, else 0."""
        return slope_of_angle(self.angle_deg)

    @property
    def _sin(self) -> float:
        return math.sin(math.radians(self.angle_deg))

    @property
    def _cos(self) -> float:
        return math.cos(math.radians(self.angle_deg))


def kind_of_angle(angle_deg: float) -> StallKind:
    """Return the kind of stall with an angle to the lane."""
    if angle_deg == PARALLEL_DEG:
        return StallKind.PARALLEL
    return StallKind.PERPENDICULAR if angle_deg == PERPENDICULAR_DEG else StallKind.ANGLED


@lru_cache(maxsize=64)
def slope_of_angle(angle_deg: float) -> float:
    """Return the cotangent of the angle of angled stalls, and 0 for others."""
    if kind_of_angle(angle_deg) is not StallKind.ANGLED:
        return 0.0
    return round(1 / math.tan(math.radians(angle_deg)), 9)


def _rounded_up(length_m: float) -> float:
    return math.ceil(round(length_m * _MM_PER_M, 6)) / _MM_PER_M


class Edge(IntEnum):
    """The edges of a square in the order of `garage2usd.structure.grid.NEIGHBOUR_STEPS`."""

    UP = 0
    DOWN = 1
    LEFT = 2
    RIGHT = 3

    @property
    def opposite(self) -> "Edge":
        """The opposite edge of the square."""
        return Edge(self ^ 1)

    @property
    def along_x(self) -> bool:
        """True if the edge is parallel to X."""
        return self in {Edge.UP, Edge.DOWN}

    @property
    def ends(self) -> tuple["Edge", "Edge"]:
        """The two adjacent edges of the square: left and right, or up and down."""
        return (Edge.LEFT, Edge.RIGHT) if self.along_x else (Edge.UP, Edge.DOWN)

    def beyond(self, square: tuple[int, int]) -> tuple[int, int]:
        """Return the (row, col) of the square beyond this edge."""
        down, right = NEIGHBOUR_STEPS[self]
        return square[0] + down, square[1] + right


@dataclass(frozen=True, eq=False)
class CapacityTable:
    """Stall capacity of each square if it were free and served; four int64 arrays, shape (rows, cols).

    Attributes
    ----------
    along_x, along_x_double
        Capacity with a lane at the upper or lower edge, and with lanes at both.
    along_z, along_z_double
        Capacity with a lane at the left or right edge, and with lanes at both.
    """

    along_x: NDArray[np.int64]
    along_x_double: NDArray[np.int64]
    along_z: NDArray[np.int64]
    along_z_double: NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class StallRow:
    """Stalls side by side on one square, all of one shape and with their mouth on one edge.

    Attributes
    ----------
    row, col
        The square.
    edge
        The edge of the square with the mouths.
    shape
        Shape of the stalls.
    starts_m
        Where the mouth of each stall begins along the edge, from the edge's middle and towards +X or +Z.
    lean
        Direction along the edge in which angled stalls lean from mouth to rear: 1 towards +X or +Z, else -1.
    """

    row: int
    col: int
    edge: Edge
    shape: StallShape
    starts_m: tuple[float, ...]
    lean: int = 1

    @property
    def count(self) -> int:
        """Number of stalls."""
        return len(self.starts_m)

    @property
    def square(self) -> tuple[int, int]:
        """(row, col) of the stall row's square."""
        return self.row, self.col


def capacity_table(structure: Structure, bay: BayConfig) -> CapacityTable:
    """Count the stalls that fit each square for each way of serving it.

    Notes
    -----
    ``floor((edge - ends) / stall_width)`` stalls if the depth holds the stall length; two rows if opposite edges are
    both open and the depth holds two. The ends leave half a column each free, or the gap to a wall. 8.1 m squares hold
    three 2.4 x 5.3 m stalls. Computed in whole millimetres.
    """
    stall_width, stall_length, ends = (
        round(side * _MM_PER_M) for side in (bay.stall_width_m, bay.stall_length_m, bay.row_ends_m)
    )
    widths = np.broadcast_to(structure.column_widths_mm, structure.shape)
    depths = np.broadcast_to(structure.row_depths_mm[:, None], structure.shape)

    def single_and_double(edge: NDArray[np.int64], depth: NDArray[np.int64]) -> tuple[NDArray[np.int64], ...]:
        fits = np.maximum(edge - ends, 0) // stall_width
        single = np.where(depth >= stall_length, fits, 0)
        return single, np.where(depth >= 2 * stall_length, 2 * fits, single)

    return CapacityTable(*single_and_double(widths, depths), *single_and_double(depths, widths))


def square_capacity(structure: Structure, bay: BayConfig) -> NDArray[np.int64]:
    """Count the stalls on each square as currently served; int64, shape (rows, cols), 0 where not free."""
    return served_capacity(structure.cells, capacity_table(structure, bay))


def served_capacity(cells: CellArray, table: CapacityTable) -> NDArray[np.int64]:
    """Count the stalls on each square of a matrix S, from a capacity table; as `square_capacity`."""
    return np.maximum(*_served(cells, table))


def stall_rows(structure: Structure, bay: BayConfig) -> tuple[StallRow, ...]:
    """Return the perpendicular rows of a structure in reading order; up and down win a tie over left and right."""
    table, shape = capacity_table(structure, bay), StallShape(bay.stall_width_m, bay.stall_length_m)
    along_x, along_z = _served(structure.cells, table)
    lane = _open_edges(structure.cells == Cell.LANE)
    rows: list[StallRow] = []
    for row, col in np.argwhere(np.maximum(along_x, along_z) > 0).tolist():
        upright = along_x[row, col] >= along_z[row, col]
        edges = (Edge.UP, Edge.DOWN) if upright else (Edge.LEFT, Edge.RIGHT)
        single = int((table.along_x if upright else table.along_z)[row, col])
        total = int((along_x if upright else along_z)[row, col])
        opened = [edge for edge in edges if lane[edge][row, col]]
        starts_m = _centred(single, shape.pitch_m)
        rows.extend(StallRow(row, col, edge, shape, starts_m) for edge in opened[: total // single])
    return tuple(rows)


@lru_cache(maxsize=256)
def _centred(count: int, pitch_m: float) -> tuple[float, ...]:
    """Return where the stalls of a row begin from its middle."""
    first_m = -count * pitch_m / 2
    return tuple(first_m + slot * pitch_m for slot in range(count))


def _open_edges(mask: Mask) -> tuple[Mask, Mask, Mask, Mask]:
    """Return for each `Edge` the squares with `mask` set beyond it."""
    padded = bordered(mask)
    return padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]


def _served(cells: CellArray, table: CapacityTable) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Count stalls along X and along Z on each free square, for the current lanes."""
    up, down, left, right = _open_edges(cells == Cell.LANE)
    free = cells == Cell.FREE
    return (
        _held(free, up, down, table.along_x, table.along_x_double),
        _held(free, left, right, table.along_z, table.along_z_double),
    )


def _held(
    free: Mask, one: Mask, other: Mask, single: NDArray[np.int64], double: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Count stalls on free squares with one or both of two opposite edges open."""
    return np.where(free, np.where(one & other, double, np.where(one | other, single, 0)), 0)


def door_edges(cells: CellArray) -> dict[tuple[int, int], Edge]:
    """Return the edge with the door of each portal (row, col) that has an edge on the outside.

    Of several such edges, the one opposite a lane is used, so that cars drive straight in; else the first.
    """
    outside = bordered(outside_squares(cells), value=True)
    lane = bordered(cells == Cell.LANE)

    def beyond(row: int, col: int, edge: Edge) -> tuple[int, int]:
        dr, dc = NEIGHBOUR_STEPS[edge]
        return row + 1 + dr, col + 1 + dc

    doors = {}
    for row, col in np.argwhere(cells >= Cell.ENTRANCE).tolist():
        outer = [edge for edge in Edge if outside[beyond(row, col, edge)]]
        opposite = [edge for edge in outer if lane[beyond(row, col, edge.opposite)]]
        if outer:
            doors[row, col] = (opposite or outer)[0]
    return doors
