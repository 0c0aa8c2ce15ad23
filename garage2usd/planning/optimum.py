"""Bounds of the score: the proven optimum of a small site, and a bound by counting for any site."""

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.progress import Progress, silent
from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.planning.board import NO_VALUE, PADDING, Ground, cells_of, ground_of, new_board
from garage2usd.planning.circulation import circulation
from garage2usd.planning.frontier import (
    FORBIDDEN,
    SquareTable,
    advance,
    are_complete,
    column_bits,
    enumerate_layouts,
    first_frontier,
    new_enumeration,
    suffix_values,
)
from garage2usd.planning.score import Score, evaluate, is_feasible
from garage2usd.structure.grid import Cell, CellArray, Structure

_MAX_FRONTIERS = 30_000_000
"""Frontiers kept at most: the 25 million of 9 x 9 squares with dead ends of two take 1.1 GB and 40 s."""
_STEPS, _MAX_BATCHES = 500_000, 600
"""Steps of the enumeration between two calls of `progress`, where signals are handled, and such batches at most: five
minutes in all."""
_FAR = 1 << 20
_FREE_OF_RULES = PlanConfig(circulation=CirculationMode.ALLOW, dead_ends=DeadEnds.ALLOW)

_Frontiers = list[tuple[NDArray[np.int64], NDArray[np.float64]]]


@dataclass(frozen=True, eq=False)
class Optimum:
    """Proven optimum: no structure on the site has a higher y'.

    Attributes
    ----------
    structure, score
        The structure and its figures.
    layouts_scored
        Layouts whose relaxed value was above the best known, all scored exactly.
    frontiers
        States of the dynamic programme.
    """

    structure: Structure
    score: Score
    layouts_scored: int
    frontiers: int


def find_optimum(
    site: Structure,
    *,
    bay: BayConfig,
    plan: PlanConfig = _FREE_OF_RULES,
    known: Structure | None = None,
    progress: Progress = silent,
) -> Optimum:
    """Find the best of all feasible structures on a small site that keep the rules of circulation.

    Parameters
    ----------
    site
        Static objects; lanes on it are free squares. R and C stay as they are. The smaller side has at most 12
        squares, under rules 10, less where dead ends may be deeper than two squares. Without rules, or without dead
        ends, 9 x 12 squares take seconds; 9 x 9 with dead ends of two squares take a minute.
    bay
        Size of the stalls.
    plan
        The rules among R1 to R3 to keep, as for the planner, and the weights of the score; if left out, there are no
        rules. The turning stall that ``dead_ends = "standard"`` keeps free never counts.
    known
        A structure to beat, which saves time; ignored if it is not feasible or breaks a rule.
    progress
        Called with the squares that the dynamic programme has passed, and with the steps of the enumeration.

    Raises
    ------
    ConfigError
        If the site is too large: for a frontier in 64 bits, for 30 million frontiers or for 300 million steps of the
        enumeration, which takes five minutes; or if R4 is to be kept.
    GenerationError
        If the site has no such structure with a stall.

    Notes
    -----
    ``y' = N_S - 5 t / N_S - U_S`` with t the sum of the parking times. For ``N_S <= n`` it is at most
    ``N_S - U_S - 5 t / n``, and t is at least its value for shortest ways over free squares. Both are sums over
    squares of terms that depend on the four neighbours alone. A frontier-based search, dynamic programming over the
    broken profile, maximises N_S for n, then that sum for all suffixes; every layout whose sum is above the best known
    value is then scored exactly, the greatest sums first.

    R1 is kept by labels: pruning leaves the core, and each pruned lane is a stub of some depth. Neighbours alone decide
    if labels are valid, and each layout that keeps R1 has exactly one valid labelling, so the profile carries labels in
    place of lanes. A lane that joins two lanes of the same piece closes the loop of R2, and one flag holds the square
    above and to the left for R3. So the programme visits exactly the layouts that keep the rules.
    """
    upright = _upright(site)
    if plan.dead_ends is DeadEnds.STANDARD:
        plan = plan.model_copy(update={"dead_ends": DeadEnds.ALLOW})
    ground = ground_of(upright, bay=bay, plan=plan)
    best, value = known, -np.inf
    if known is not None and is_feasible(known) and not circulation(known).faults(ground.rules):
        score = evaluate(known, bay=bay, plan=plan)
        value = score.value if score.stalls else -np.inf
    try:
        found = _beat(ground, _table_of(ground, upright.shape[1]), value, progress)
    except _TooLargeError as error:
        rows, cols = site.shape
        raise ConfigError("site", f"{rows} x {cols} squares", f"{error}, for a proven optimum") from None
    if found.lanes is not None:
        best = site.with_cells(_as_on(site, cells_of(ground, found.lanes)))
    elif best is None or value == -np.inf:
        raise GenerationError("optimum", "no structure with a stall keeps the rules", seed=0, attempts=1)
    return Optimum(best, evaluate(best, bay=bay, plan=plan), found.scored, found.frontiers)


class _TooLargeError(Exception):
    """Site that exceeds a limit of the search; the message gives the limit."""


def _table_of(ground: Ground, cols: int) -> SquareTable:
    """Flatten a site for the search, with values of zero."""
    rules = ground.rules
    depth = min(rules.dead_end_squares, len(ground.squares)) if rules.is_asked else -1
    bits = column_bits(cols, depth)
    if bits == 0:
        most = max(side for side in range(cols) if column_bits(side, depth) or side == 0)
        under = f" with dead ends of up to {rules.dead_end_squares} squares" if rules.is_asked else ""
        raise _TooLargeError(f"a side of at most {most}{under}")
    if rules.stretch_squares:
        raise ConfigError("plan.longest_stretch_cells", rules.stretch_squares, "0: the optimum knows R1 to R3 only")
    squares = _squares_of(ground)
    beside = (squares + step for step in (-ground.stride, ground.stride, -1, 1))
    portals = np.sum([ground.cells[others] >= Cell.ENTRANCE for others in beside], axis=0)
    return SquareTable(cols, bits, depth, ground.cells[squares], portals, np.zeros((len(squares), 16)), rules.asks_loop)


@dataclass(frozen=True, eq=False)
class _Beaten:
    lanes: NDArray[np.bool_] | None
    scored: int
    frontiers: int


def _beat(ground: Ground, table: SquareTable, value: float, progress: Progress) -> _Beaten:
    """Look for a layout of more than `value`."""
    squares, floor = _squares_of(ground), max(value, NO_VALUE)
    stalls = table._replace(worth=ground.capacity[squares].astype(np.float64))
    keys, counts = _frontiers(stalls, progress)[-1]
    most = float(np.max(counts[are_complete(stalls, keys)], initial=0.0))
    if most == 0:
        return _Beaten(None, 0, 0)
    hops, price = _free_hops(ground), -float(ground.weights[1]) / most
    table = table._replace(worth=_worth(ground, hops, price))
    layers = _frontiers(table, progress)
    suffixes = [np.where(are_complete(table, layers[-1][0]), 0.0, FORBIDDEN)]
    for index in reversed(range(len(squares))):
        suffixes.append(suffix_values(table, index, layers[index][0], layers[index + 1][0], suffixes[-1]))
        progress("suffixes", len(squares) - index, len(squares))
    suffixes.reverse()
    offsets = np.concatenate(([0], np.cumsum([len(keys) for keys, _ in layers])))
    frontiers = int(offsets[-1])
    if suffixes[0][0] <= floor:
        return _Beaten(None, 0, frontiers)
    board, state = new_board(ground), new_enumeration(table, ground, floor)
    board.cells[:] = ground.cells
    keys, follow = np.concatenate([keys for keys, _ in layers]), np.concatenate(suffixes)
    batch = 0
    while not enumerate_layouts(state, _STEPS, table, ground, board, offsets, keys, follow, hops, price):
        batch += 1
        progress("layouts", batch, _MAX_BATCHES)
        if batch == _MAX_BATCHES:
            raise _TooLargeError(f"squares of which {_MAX_BATCHES * _STEPS} steps enumerate the layouts that may win")
    lanes = state.best_cells[ground.squares] == Cell.LANE if state.best[0] > floor else None
    return _Beaten(lanes, int(state.counts[1]), frontiers)


def _frontiers(table: SquareTable, progress: Progress) -> _Frontiers:
    """Enumerate the frontiers before each square and after the last, each with its best value so far."""
    layers = [(np.array([first_frontier(table)], dtype=np.int64), np.zeros(1))]
    kept = 1
    for index in range(len(table.kinds)):
        layers.append(advance(table, index, *layers[-1]))
        kept += len(layers[-1][0])
        if kept > _MAX_FRONTIERS:
            raise _TooLargeError(f"squares of at most {_MAX_FRONTIERS} frontiers, fewer squares that is")
        progress("frontiers", index + 1, len(table.kinds))
    return layers


def _squares_of(ground: Ground) -> NDArray[np.int64]:
    """All squares of the site in reading order, as indices into the ground."""
    squares = np.arange(len(ground.cells)).reshape(-1, ground.stride)[PADDING:-PADDING, PADDING:-PADDING]
    return np.ascontiguousarray(squares).ravel()


def _worth(ground: Ground, hops: NDArray[np.int64], price: float) -> NDArray[np.float64]:
    """Relaxed contribution of each square by its open edges; shape (rows * cols, 16)."""
    squares = _squares_of(ground)
    near = np.full((len(squares), 16), _FAR)
    for edges in range(1, 16):
        beside = [step for bit, step in enumerate((-ground.stride, ground.stride, -1, 1)) if edges >> bit & 1]
        near[:, edges] = np.min([hops[squares + step] for step in beside], axis=0)
    stalls = ground.capacity[squares].astype(np.float64)
    weights = ground.weights
    each = weights[0] - price * (1 + near)
    worth = np.where(stalls > 0, stalls * each, weights[2])
    return np.ascontiguousarray(worth)


def _free_hops(ground: Ground) -> NDArray[np.int64]:
    """Hops from the nearest entrance if every free square were a lane; shape (padded,)."""
    hops = np.full(len(ground.cells), _FAR)
    queue: deque[int] = deque()
    for entrance in ground.entrances.tolist():
        for step in (-ground.stride, ground.stride, -1, 1):
            if ground.cells[entrance + step] == Cell.FREE and hops[entrance + step] == _FAR:
                hops[entrance + step] = 1
                queue.append(entrance + step)
    while queue:
        square = queue.popleft()
        for step in (-ground.stride, ground.stride, -1, 1):
            if ground.cells[square + step] == Cell.FREE and hops[square + step] == _FAR:
                hops[square + step] = hops[square] + 1
                queue.append(square + step)
    return hops


def _is_turned(site: Structure) -> bool:
    return site.shape[1] > site.shape[0]


def _is_flipped(site: Structure) -> bool:
    """Test whether the entrances are on the first half of the longer side."""
    along = int(_is_turned(site))
    places = [entrance[along] for entrance in site.where(Cell.ENTRANCE)]
    return 2 * sum(places) < len(places) * (site.shape[along] - 1)


def _upright(site: Structure) -> Structure:
    """Turn a site: its smaller side along the rows, for a short profile, and its entrances towards the last row.

    Squares are decided from the first row on. How far off an entrance they are is then seen early, by the ways among
    them that are decided, and the enumeration ends up to a thousand times sooner than from the other side.
    """
    cells, depths, widths = site.cells, site.row_depths_mm, site.column_widths_mm
    if _is_turned(site):
        cells, depths, widths = cells.T, widths, depths
    if _is_flipped(site):
        cells, depths = cells[::-1], depths[::-1]
    return Structure(np.ascontiguousarray(cells), np.ascontiguousarray(widths), np.ascontiguousarray(depths))


def _as_on(site: Structure, cells: CellArray) -> CellArray:
    """Turn the matrix of an upright site back."""
    flipped = cells[::-1] if _is_flipped(site) else cells
    return np.ascontiguousarray(flipped.T if _is_turned(site) else flipped)


def counting_bound(site: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> float:
    """Bound y' of all feasible structures on a site from above by counting.

    Notes
    -----
    L lanes have ``4 L`` edges; joined to one piece they spend ``2 (L - 1)`` on each other and at least one on each of
    P portals, so they serve ``F <= 2 L + 2 - P`` squares. With ``F + L <= A`` free squares ``F <= (2 A + 2 - P) / 3``.

    The same holds for the lanes within h hops of an entrance: their pieces, at most the K free squares beside an
    entrance, serve ``F_h <= 2 L_h + K`` squares, and all of these are among the B squares that a way of h + 1 hops over
    free squares reaches. So at most ``(2 B + K) / 3`` squares have a parking time of h + 1, which bounds T_S from
    below; where squares hold different numbers of stalls, the least time does. U_S is at least 0.
    """
    ground = ground_of(site, bay=bay, plan=plan or PlanConfig())
    squares = ground.squares
    served = min(len(squares), max(0, (2 * len(squares) + 2 - len(ground.portals)) // 3))
    most = np.sort(ground.capacity[squares].max(axis=1))[::-1][:served]
    if not served or not most[0]:
        return 0.0
    stalls = np.cumsum(most)
    if most[-1] == most[0]:
        hops = _free_hops(ground)[squares]
        reached = np.cumsum(np.bincount(hops[hops < len(ground.cells)]))
        nearest = np.searchsorted((2 * reached + (hops == 1).sum()) // 3, np.arange(1, served + 1))
        times = np.cumsum(np.maximum(nearest, 2)) / np.arange(1, served + 1)
    else:
        times = np.full(served, 2.0)
    return float((ground.weights[0] * stalls + ground.weights[1] * times).max())
