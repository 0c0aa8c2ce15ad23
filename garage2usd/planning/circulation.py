"""How traffic circulates on lanes: the rules R1 to R4, and what a structure has of each."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.planning.survey import STRETCH, survey
from garage2usd.structure.border import bordered
from garage2usd.structure.grid import Cell, Mask, Structure
from garage2usd.structure.lane_graph import Square
from garage2usd.structure.pieces import pieces_of

__all__ = ["Circulation", "CirculationRules", "circulation", "rules_of"]

_STRETCH_SITE_SQUARES = 400
"""Free squares from which on R4 is asked for: there one long ring would satisfy R2."""
_STRETCH_SQUARES = 12
"""65 to 97 m; Palm Shores allows rows of 61 m without a cross drive."""


class CirculationRules(NamedTuple):
    """What is asked of the circulation, and what each fault costs beside the score.

    Attributes
    ----------
    is_asked
        Whether anything is.
    dead_end_squares
        R1: rounds of pruning within which every dead end is gone.
    asks_loop
        R2: whether there is to be a loop.
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
    """The rules that the settings ask for on a site of so many free squares.

    Notes
    -----
    The costs are those with which 96 % of the plans that learning keeps on the gates obey the rules: three stalls for
    a lane too deep or a block, five for the lack of a loop. R4 is asked for from about 20 x 20 squares on: on smaller
    sites hardly a stretch is too long.
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


@dataclass(frozen=True, eq=False)
class Circulation:
    """How traffic circulates on a structure's lanes.

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
        """Lanes that pruning takes off after so many rounds; bool, shape (rows, cols)."""
        deep: Mask = self.rounds > squares
        return deep

    def faults(self, rules: CirculationRules) -> dict[str, str]:
        """The rules that are not kept, of ``R1`` to ``R4``, each with where and by how much; empty without rules."""
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
    R1: lanes with at most one neighbour are pruned in rounds, portals being neighbours that stay, so that branched
    trees are found as well as straight dead ends; the rounds that it takes are the depth of the dead ends. R2:
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
