"""Circulation of traffic on lanes: the rules R1 to R4, faults against them, and lengths of dead ends and stretches.

The survey of lanes is in C, `survey.c`.
"""
# Over 300 lines: rules in squares and lengths in metres are read off one survey.

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.native import Int8s, Int32s, Int64s, in_c
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Mask, Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.squares import bordered, pieces_of
from garage2usd.structure.stalls import square_capacity

_MM_PER_M = 1000
_MM2_PER_M2 = 1_000_000

_STRETCH_SITE_SQUARES = 400
"""Number of free squares from which R4 applies, as one long ring would satisfy R2 there."""
_STRETCH_SQUARES = 12
"""65 to 97 m; Palm Shores allows rows of 61 m without a cross drive."""


class CirculationRules(NamedTuple):
    """Rules of circulation, and the cost of each fault beside the score.

    Attributes
    ----------
    is_asked
        True if there is any rule.
    dead_end_squares
        R1: rounds of pruning within which every dead end is gone.
    asks_loop
        R2: whether a loop is required.
    stretch_squares
        R4: the longest stretch without a junction; 0 where any is allowed.
    deep_cost
        Cost of each lane that is deeper in a dead end than allowed.
    block_cost
        R3: cost of each block of two by two lanes.
    loopless_cost
        Cost of lanes without a loop.
    stretch_cost
        Cost of each square that a stretch is too long.
    """

    is_asked: bool
    dead_end_squares: int
    asks_loop: bool
    stretch_squares: int
    deep_cost: float
    block_cost: float
    loopless_cost: float
    stretch_cost: float


_NOTHING = CirculationRules(
    is_asked=False,
    dead_end_squares=1 << 20,
    asks_loop=False,
    stretch_squares=0,
    deep_cost=0.0,
    block_cost=0.0,
    loopless_cost=0.0,
    stretch_cost=0.0,
)


def rules_of(plan: PlanConfig, *, squares: int) -> CirculationRules:
    """Derive the rules from the settings for a site with a number of free squares.

    Notes
    -----
    With these costs 96 % of the plans that learning keeps on the gates obey the rules: three stalls for a lane too
    deep or a block, five for the lack of a loop. R4 is required from about 20 x 20 squares on; on smaller sites hardly
    any stretch is too long.
    """
    asks_loops = plan.circulation_mode is CirculationMode.LOOPS
    forbids_dead_ends = plan.dead_ends is DeadEnds.FORBID
    if not asks_loops and not forbids_dead_ends:
        return _NOTHING
    stretch = _STRETCH_SQUARES if squares >= _STRETCH_SITE_SQUARES else 0
    if plan.longest_stretch_cells is not None:
        stretch = plan.longest_stretch_cells
    return CirculationRules(
        is_asked=True,
        dead_end_squares=0 if forbids_dead_ends else plan.dead_end_cells,
        asks_loop=asks_loops,
        stretch_squares=stretch if asks_loops else 0,
        deep_cost=3.0 * plan.stall_weight,
        block_cost=3.0 * plan.stall_weight,
        loopless_cost=5.0 * plan.stall_weight if asks_loops else 0.0,
        stretch_cost=plan.stall_weight if asks_loops and stretch else 0.0,
    )


STRETCH = 4
"""States above it are stretches: so much more than the squares that they have."""


class Survey(NamedTuple):
    """Faults and loops of the lanes of a site.

    Attributes
    ----------
    deep
        Lanes that pruning removes after the allowed rounds (R1).
    loops
        Independent circuits of lanes that form one piece, ``E - V + 1``, less the blocks (R2).
    blocks
        Blocks of two by two lanes (R3).
    excess
        Squares by which stretches without a junction exceed the allowed length, summed (R4).
    """

    deep: int
    loops: int
    blocks: int
    excess: int


def survey(
    squares: Int64s,
    stride: int,
    cells: Int8s,
    state: Int32s,
    dead_end_squares: int,
    stretch_squares: int,
) -> Survey:
    """Count the faults of lanes against the rules of circulation.

    Parameters
    ----------
    squares
        int64: the squares that may be lanes.
    stride
        Step from a square to the one below.
    cells
        int8: the padded structure matrix.
    state
        int32, shape of `cells`, set on all lanes: minus the round in which a dead end is pruned; the number of
        neighbours of a junction, 3 or 4; or `STRETCH` and the squares of the stretch that the lane belongs to.
    dead_end_squares
        R1: rounds of pruning that are free.
    stretch_squares
        R4: squares of a stretch that are free; below 1 stretches are not looked at.

    Notes
    -----
    A round of pruning removes the lanes with at most one neighbour; portals are never removed (k-core decomposition,
    Seidman 1983, for k = 2). Without stretches, those lanes keep the state 2.
    """
    queue, found = np.empty(len(cells), np.int64), np.zeros(4, np.int64)
    _survey(squares, len(squares), stride, cells, state, queue, dead_end_squares, stretch_squares, found)
    return Survey(*found.tolist())


@in_c
def _survey(
    squares: Int64s,
    count: int,
    stride: int,
    cells: Int8s,
    state: Int32s,
    queue: Int64s,
    dead_end_squares: int,
    stretch_squares: int,
    found: Int64s,
) -> None:
    """`survey` of the first `count` squares, with room for as many in `queue`; `found` takes the figures."""
    raise NotImplementedError


@dataclass(frozen=True, eq=False)
class Circulation:
    """Circulation on the lanes of a structure, in squares.

    Attributes
    ----------
    loops
        Independent circuits of the lanes, blocks of two by two lanes apart.
    rounds
        int32, shape (rows, cols): the round of pruning that takes a lane off, 1 at the tip of a dead end; 0 on lanes
        that one drives on through, and elsewhere.
    stretches
        int32, shape (rows, cols): on lanes that one drives on through between two junctions or portals, how many
        squares that stretch has; 0 elsewhere.
    blocks
        (row, col) of the upper left squares of blocks of two by two lanes.
    """

    loops: int
    rounds: NDArray[np.int32]
    stretches: NDArray[np.int32]
    blocks: tuple[Square, ...]

    @cached_property
    def dead_end_squares(self) -> int:
        """Depth of the deepest dead end; 0 without any."""
        return int(self.rounds.max(initial=0))

    @cached_property
    def longest_stretch_squares(self) -> int:
        """Squares of the longest stretch without a junction."""
        return int(self.stretches.max(initial=0))

    def deeper_than(self, squares: int) -> Mask:
        """Lanes that pruning removes after a number of rounds; bool, shape (rows, cols)."""
        return self.rounds > squares

    def faults(self, rules: CirculationRules) -> dict[str, str]:
        """List the broken rules of ``R1`` to ``R4``, each with place and amount; empty without rules."""
        if not rules.is_asked:
            return {}
        found = {}
        if self.dead_end_squares > rules.dead_end_squares:
            deep = self.deeper_than(rules.dead_end_squares)
            found["R1"] = (
                f"a dead end at {_first(deep)} is {self.dead_end_squares} squares deep, "
                f"{rules.dead_end_squares} at most are asked for"
            )
        if rules.asks_loop and self.loops < 1:
            found["R2"] = "the lanes have no loop"
        if self.blocks:
            found["R3"] = f"the lanes are two squares wide at {list(self.blocks[0])}"
        if 0 < rules.stretch_squares < self.longest_stretch_squares:
            where = _first(self.stretches == self.longest_stretch_squares)
            found["R4"] = (
                f"the stretch at {where} has {self.longest_stretch_squares} squares without a junction, "
                f"{rules.stretch_squares} at most are asked for"
            )
        return found


def _first(mask: Mask) -> list[int]:
    """[row, col] of the first square that is set."""
    row, col = np.argwhere(mask)[0].tolist()
    return [row, col]


def circulation(structure: Structure) -> Circulation:
    """Measure how traffic circulates on a complete structure.

    Notes
    -----
    R1: each round of pruning removes the lanes with at most one neighbour; portals are never removed. Branched trees
    are found as well as straight dead ends, and the number of rounds is their depth. R2:
    ``E - V + k`` for V lanes in k pieces with E pairs of neighbours, less the blocks. R3: blocks of two by two lanes.
    R4: lanes that stay with two neighbours form stretches; a dead end beside one makes no junction, as no car drives
    on through it.
    """
    lane = structure.cells == Cell.LANE
    padded = bordered(structure.cells, Cell.OBSTACLE)
    cells = padded.ravel()
    state = np.zeros(len(cells), np.int32)
    figures = survey(np.flatnonzero(cells == Cell.LANE), padded.shape[1], cells, state, 0, 1)
    states = np.where(lane, state.reshape(padded.shape)[1:-1, 1:-1], 0)
    _, pieces = pieces_of(lane)
    blocks = lane[:-1, :-1] & lane[1:, :-1] & lane[:-1, 1:] & lane[1:, 1:]
    return Circulation(
        loops=figures.loops - 1 + pieces,
        rounds=np.maximum(-states, 0).astype(np.int32),
        stretches=np.maximum(states - STRETCH, 0).astype(np.int32),
        blocks=tuple((row, col) for row, col in np.argwhere(blocks).tolist()),
    )


@dataclass(frozen=True)
class Run:
    """Lanes that belong together: a dead end with all its branches, or a stretch between two junctions.

    Attributes
    ----------
    squares
        (row, col) of its lanes: of a dead end from the deepest one on, of a stretch in reading order.
    length_m
        Of a dead end from its deepest tip to the lane or portal where it begins, of a stretch from end to end.
    length_squares
        The same in squares.
    """

    squares: tuple[Square, ...]
    length_m: float
    length_squares: int


@dataclass(frozen=True, eq=False)
class MeasuredCirculation:
    """Circulation on the lanes of a structure, in squares and in metres.

    Attributes
    ----------
    circulation
        The survey in squares.
    dead_ends
        Every dead end with its branches, by the square where it begins.
    stretches
        Every stretch of lanes without a junction.
    """

    circulation: Circulation
    dead_ends: tuple[Run, ...]
    stretches: tuple[Run, ...]

    @cached_property
    def dead_end_m(self) -> float:
        """Depth of the deepest dead end; 0 without any."""
        return max((run.length_m for run in self.dead_ends), default=0.0)

    @cached_property
    def stretch_m(self) -> float:
        """Length of the longest stretch without a junction; 0 without any."""
        return max((run.length_m for run in self.stretches), default=0.0)


def measured_circulation(structure: Structure) -> MeasuredCirculation:
    """Measure how traffic circulates on a complete structure.

    Notes
    -----
    The lanes that pruning takes off form trees: each hangs on the one neighbour that outlasts it. The depth of a tree
    is the length of its longest branch, measured from border to border. A stretch is measured along the middle of its
    lanes, from the border of one junction to that of the next.
    """
    found = circulation(structure)
    return MeasuredCirculation(found, tuple(_dead_ends(structure, found)), tuple(_stretches(structure, found)))


def neither_share(structure: Structure, bay: BayConfig) -> float:
    """Share of the floor inside the contour, obstacles apart, that is neither a lane or portal nor a stall."""
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / _MM2_PER_M2
    floor = float(areas[structure.cells != Cell.OBSTACLE].sum())
    stalls = int(square_capacity(structure, bay).sum()) * bay.stall_width_m * bay.stall_length_m
    used = float(areas[structure.cells >= Cell.LANE].sum()) + stalls
    return max(0.0, 1.0 - used / floor) if floor else 0.0


def _dead_ends(structure: Structure, found: Circulation) -> Iterator[Run]:
    """Yield each tree of pruned lanes."""
    rounds = np.pad(found.rounds, 1)
    drivable = bordered(structure.cells >= Cell.LANE)
    root_of: dict[Square, Square] = {}
    depth: dict[Square, tuple[int, int]] = {}
    trees: dict[Square, list[Square]] = {}
    pruned: list[Square] = [(row, col) for row, col in np.argwhere(found.rounds > 0).tolist()]
    # from the last pruned lane to the first, so that each lane is measured after the one it branches off
    for square in sorted(pruned, key=lambda square: -int(found.rounds[square])):
        onward, side_mm = _onward(structure, rounds, drivable, square)
        root_of[square] = square if onward is None else root_of[onward]
        before_mm, before = (0, 0) if onward is None else depth[onward]
        depth[square] = before_mm + side_mm, before + 1
        trees.setdefault(root_of[square], []).append(square)
    for root in sorted(trees):
        squares = sorted(trees[root], key=lambda square: (-depth[square][0], square))
        yield Run(tuple(squares), depth[squares[0]][0] / _MM_PER_M, max(depth[square][1] for square in squares))


def _onward(
    structure: Structure, rounds: NDArray[np.int32], drivable: NDArray[np.bool_], square: Square
) -> tuple[Square | None, int]:
    """Return the pruned lane that a pruned lane branches off, None at the root of a tree, and its length that way."""
    row, col = square
    sides = int(structure.row_depths_mm[row]), int(structure.column_widths_mm[col])
    for dr, dc in NEIGHBOUR_STEPS:
        at = row + 1 + dr, col + 1 + dc
        if drivable[at] and rounds[at] == 0:
            return None, sides[0] if dr else sides[1]
    for dr, dc in NEIGHBOUR_STEPS:
        at = row + 1 + dr, col + 1 + dc
        if rounds[at] > rounds[row + 1, col + 1]:
            return (row + dr, col + dc), sides[0] if dr else sides[1]
    return None, max(sides)


def _stretches(structure: Structure, found: Circulation) -> Iterator[Run]:
    """Yield each connected piece of lanes that have two unpruned neighbours."""
    stays = np.pad((structure.cells >= Cell.LANE) & (found.rounds == 0), 1)
    up, down, left, right = stays[:-2, 1:-1], stays[2:, 1:-1], stays[1:-1, :-2], stays[1:-1, 2:]
    along_mm = (
        (up.astype(np.int64) + down) * structure.row_depths_mm[:, None]
        + (left.astype(np.int64) + right) * structure.column_widths_mm
    ) // 2
    numbers, count = pieces_of(found.stretches > 0)
    squares: list[list[Square]] = [[] for _ in range(count)]
    for row, col in np.argwhere(numbers).tolist():
        squares[numbers[row, col] - 1].append((row, col))
    for run in squares:
        length_mm = sum(int(along_mm[square]) for square in run)
        yield Run(tuple(run), length_mm / _MM_PER_M, len(run))
