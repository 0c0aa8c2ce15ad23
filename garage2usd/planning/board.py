"""A site as flat arrays for the compiled loops, a board of lanes on it, and the archive of the best plans.

In C, `board.c`, `repair.c` and `archive.c`.
"""

from typing import NamedTuple

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.native import (
    Bools,
    BoolTable,
    Float64s,
    Int8s,
    Int8Table,
    Int32s,
    Int32Table,
    Int64s,
    Int64Table,
    UInt64s,
    in_c,
)
from garage2usd.planning.circulation import CirculationRules, rules_of
from garage2usd.structure.grid import Cell, CellArray, Structure
from garage2usd.structure.lanes import DEAD_END_LIMIT_MM
from garage2usd.structure.stalls import capacity_table

PADDING = 4
"""Squares outside on each side of a site, as many as the widest window sees beyond one of its squares."""
Lanes = Bools
"""bool, shape (squares,): which of `Ground.squares` are lanes."""
FAR = 1 << 28
NO_VALUE = -1.0e9
FAULTS = 5
"""Index in `Board.tally` of the number of violations of the rules of circulation."""


class Ground(NamedTuple):
    """A site as flat arrays on a matrix padded with squares outside; a square is an index into them.

    Attributes
    ----------
    stride
        Squares in a padded row: the step from a square to the one below.
    cells
        int8, shape (padded,): values of `Cell`, no lanes.
    capacity
        int32, shape (padded, 16): stalls on the square if it is free, by its edges that are open to lanes, as the sum
        of 1 up, 2 down, 4 left, 8 right.
    sides_mm
        int64, shape (padded, 2): depth along Z and width along X.
    squares
        int64: the free squares in reading order.
    entrances, portals
        int64: squares with entrances, and with entrances then exits.
    weights
        float64, shape (3,): k_1, k_2, k_3 of the score.
    dead_end_cost
        What a dead-end aisle over `dead_end_limit_mm` costs beside the score.
    dead_end_limit_mm
        Length up to which a dead-end aisle is free.
    rules
        Rules of circulation.
    """

    stride: int
    cells: Int8s
    capacity: Int32Table
    sides_mm: Int64Table
    squares: Int64s
    entrances: Int64s
    portals: Int64s
    weights: Float64s
    dead_end_cost: float
    dead_end_limit_mm: int
    rules: CirculationRules


def ground_of(site: Structure, *, bay: BayConfig, plan: PlanConfig) -> Ground:
    """Flatten a site; its lanes, if any, become free squares."""
    static = np.where(site.cells == Cell.LANE, Cell.FREE, site.cells).astype(np.int8)
    cells = np.pad(static, PADDING, constant_values=Cell.OBSTACLE)
    flat = cells.ravel()
    depths = np.broadcast_to(site.row_depths_mm[:, None], site.shape)
    widths = np.broadcast_to(site.column_widths_mm, site.shape)
    squares = np.flatnonzero(flat == Cell.FREE)
    capacity = np.pad(capacity_by_edges(site, bay), [(PADDING, PADDING), (PADDING, PADDING), (0, 0)])
    # dead ends lose a turning stall only if the rules allow such long ones
    keeps_turning_stalls = plan.dead_ends is DeadEnds.STANDARD and plan.circulation_mode is CirculationMode.ALLOW
    entrances, exits = np.flatnonzero(flat == Cell.ENTRANCE), np.flatnonzero(flat == Cell.EXIT)
    return Ground(
        stride=cells.shape[1],
        cells=flat,
        capacity=capacity.reshape(-1, capacity.shape[-1]),
        sides_mm=np.stack([np.pad(side, PADDING).ravel() for side in (depths, widths)], axis=1).astype(np.int64),
        squares=squares,
        entrances=entrances,
        portals=np.concatenate((entrances, exits)),
        weights=np.array([plan.stall_weight, plan.parking_time_weight, plan.unused_weight]),
        dead_end_cost=plan.stall_weight if keeps_turning_stalls else 0.0,
        dead_end_limit_mm=DEAD_END_LIMIT_MM,
        rules=rules_of(plan, squares=len(squares)),
    )


def lanes_of(structure: Structure, ground: Ground) -> Lanes:
    """Read the lanes of a structure of as many squares as the ground, as far as they are on its free squares."""
    flat = np.pad(structure.cells, PADDING, constant_values=Cell.OBSTACLE).ravel()
    lanes: Lanes = flat[ground.squares] == Cell.LANE
    return lanes


def cells_of(ground: Ground, lanes: Lanes) -> CellArray:
    """Build the structure matrix with lanes on some squares of the ground; int8, shape (rows, cols)."""
    padded = ground.cells.copy()
    padded[ground.squares[lanes]] = Cell.LANE
    return padded.reshape(-1, ground.stride)[PADDING:-PADDING, PADDING:-PADDING].copy()


def capacity_by_edges(site: Structure, bay: BayConfig) -> Int32s:
    """Tabulate the stalls on each square by its edges open to lanes as in `Ground.capacity`.

    int32, shape (rows, cols, 16).
    """
    table = capacity_table(site, bay)
    layers = []
    for edges in range(16):
        along_x = (0, table.along_x, table.along_x, table.along_x_double)[edges & 3]
        along_z = (0, table.along_z, table.along_z, table.along_z_double)[edges >> 2]
        layers.append(np.maximum(along_x, along_z) + np.zeros(site.shape, dtype=np.int64))
    return np.ascontiguousarray(np.stack(layers, axis=-1).astype(np.int32))


class Board(NamedTuple):
    """Lanes laid so far; arrays by square of the padded matrix.

    Attributes
    ----------
    cells
        int8: the structure matrix.
    edges
        int8: edges of the square open to lanes, as in `Ground.capacity`.
    hops
        int32: squares driven from the nearest entrance to a lane.
    near
        int32: least `hops` of the lanes beside a free square, 0 at a portal that touches a lane; `mark_network` stores
        marks in it.
    state
        int32: state of each lane by the last `survey`.
    queue
        int64: room for breadth-first searches.
    tally
        int64, shape (6,): stalls N_S, sum over stalls of (1 + hops), free squares without stalls U_S, portals that
        touch no lane, lanes, and how often `faults_cost` last found a rule of circulation broken, `FAR` for
        infeasible lanes.
    """

    cells: Int8s
    edges: Int8s
    hops: Int32s
    near: Int32s
    state: Int32s
    queue: Int64s
    tally: Int64s


def new_board(ground: Ground) -> Board:
    """Allocate a board; `clear` it before use."""
    size = len(ground.cells)
    return Board(
        ground.cells.copy(),
        np.zeros(size, np.int8),
        np.zeros(size, np.int32),
        np.zeros(size, np.int32),
        np.zeros(size, np.int32),
        np.zeros(size, np.int64),
        np.zeros(6, np.int64),
    )


@in_c
def value_now(ground: Ground, board: Board) -> float:
    """Score y' by the tally of the board, whether or not all portals are touched."""
    raise NotImplementedError


@in_c
def measure(ground: Ground, board: Board, enough: float) -> float:
    """Measure y' less the cost of faults of the lanes in `board.cells`, NO_VALUE if infeasible; sets hops and tally.

    A score below `enough` is returned without the cost of faults.

    Feasible: every portal touches a lane and the lanes form one network that does not pass through portals.
    """
    raise NotImplementedError


def faults_of(ground: Ground, board: Board, lanes: Lanes) -> int:
    """Count the faults of lanes against the rules of circulation."""
    put_lanes(ground, board, lanes)
    measure(ground, board, -np.inf)
    return int(board.tally[FAULTS])


def lanes_on(ground: Ground, board: Board) -> Lanes:
    """Read the lanes off the board."""
    lanes: Lanes = board.cells[ground.squares] == Cell.LANE
    return lanes


def put_lanes(ground: Ground, board: Board, lanes: Lanes) -> None:
    """Replace the lanes on the board; the tally is not updated."""
    board.cells[:] = ground.cells
    board.cells[ground.squares[lanes]] = Cell.LANE


def connect(ground: Ground, board: Board) -> bool:
    """Connect all lanes and portals by shortest paths over free squares; False if there are none.

    The network grows from the first portal by the shortest path to the nearest piece (Takahashi and Matsuyama 1980).
    Unreachable lanes are removed.
    """
    return _connect_lanes(ground, board)


@in_c
def _connect_lanes(ground: Ground, board: Board) -> bool:
    """`connect`, a name that the C library has taken."""
    raise NotImplementedError


class Archive(NamedTuple):
    """Archived plans in no order; the first `in_use[0]` entries are in use.

    Attributes
    ----------
    values
        float64, shape (size,).
    keys
        uint64, shape (size,): the lanes' hash.
    lanes
        bool, shape (size, padded): by square of the padded matrix.
    tapes
        int8, shape (size, steps): the `lengths` actions from the square `starts`; for an agent over aisles, the use of
        each run, with the choice of direction and spine as `starts`.
    starts, lengths
        int64, shape (size,).
    in_use
        int64, shape (2,): entries in use, and the one of least value once all are.
    """

    values: Float64s
    keys: UInt64s
    lanes: BoolTable
    tapes: Int8Table
    starts: Int64s
    lengths: Int64s
    in_use: Int64s


def new_archive(size: int, *, padded: int, steps: int) -> Archive:
    """Allocate an archive of plans on a padded matrix, for tapes of at most so many steps."""
    return Archive(
        np.full(size, -np.inf),
        np.zeros(size, np.uint64),
        np.zeros((size, padded), np.bool_),
        np.zeros((size, steps), np.int8),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.zeros(2, np.int64),
    )


def ranked_lanes(archive: Archive, ground: Ground) -> tuple[tuple[float, Lanes], ...]:
    """List (value, lanes) of all entries, best first."""
    order = np.argsort(-archive.values[: archive.in_use[0]], kind="stable")
    return tuple((float(archive.values[entry]), archive.lanes[entry, ground.squares]) for entry in order)


@in_c
def next_random(random: UInt64s) -> np.uint64:
    """Draw by splitmix64 (Steele, Lea and Flood 2014): the same numbers on every machine."""
    raise NotImplementedError
