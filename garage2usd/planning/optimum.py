"""The proven optimum of a small site: a tool to measure planners with."""

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.errors import ConfigError, GenerationError
from garage2usd.grid import Cell, Structure
from garage2usd.planning.ground import Ground, cells_of, ground_of
from garage2usd.planning.planner import plan_lanes
from garage2usd.planning.score import Score, evaluate

__all__ = ["Optimum", "find_optimum", "free_hops"]

_MAX_COLS = 12
_MAX_LAYOUTS = 20_000_000
_STALLS_STEP = 3
_FAR = 1 << 20


@dataclass(frozen=True, eq=False)
class Optimum:
    """A structure that no other on its site beats in y'.

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


def find_optimum(site: Structure, *, bay: BayConfig, known: Structure | None = None) -> Optimum:
    """Find the best of all feasible structures on a small site, dead ends allowed.

    Parameters
    ----------
    site
        Static objects; the smaller side has at most 12 squares, and about 9 x 12 is what time allows.
    bay
        Size of the stalls.
    known
        A good feasible structure to start from; the planner's if left out.

    Raises
    ------
    ConfigError
        If the site is too large.
    GenerationError
        If the site has no feasible structure, or more candidates than can be scored.

    Notes
    -----
    ``y' = N_S - 5 t / N_S - U_S`` with t the sum of the parking times. For ``N_S <= n`` it is at most
    ``N_S - U_S - 5 t / n``, and t is at least what it would be if every way to a lane were the shortest over free
    squares: both are sums over squares of what the four neighbours decide. A dynamic programme over frontiers
    maximises that sum for all suffixes; every layout whose sum is above the best known is then scored exactly. So it
    is done for n in steps of three stalls down to where no layout can win.
    """
    if min(site.shape) > _MAX_COLS:
        raise ConfigError("site", f"{site.shape[0]} x {site.shape[1]} squares", f"a side of at most {_MAX_COLS}")
    plan = PlanConfig(circulation=CirculationMode.ALLOW, dead_ends=DeadEnds.ALLOW)
    best = known or plan_lanes(site, plan=plan, bay=bay, seed=0).structure
    turned = site.shape[1] > site.shape[0]
    upright = _turned(best) if turned else best
    ground = ground_of(upright, bay=bay, plan=plan)
    value = evaluate(upright, bay=bay).value
    most = int(ground.capacity.max()) * ((2 * len(ground.squares) + 2) // 3)
    scored = frontiers = 0
    while most > value + 2 * -plan.parking_time_weight:
        result = _beat(ground, upright.shape, value, most)
        scored, frontiers = scored + result.scored, frontiers + result.frontiers
        if result.lanes is not None:
            upright = upright.with_cells(cells_of(ground, result.lanes))
            value = evaluate(upright, bay=bay).value
        most -= _STALLS_STEP
    structure = _turned(upright) if turned else upright
    return Optimum(structure, evaluate(structure, bay=bay), scored, frontiers)


@dataclass(frozen=True, eq=False)
class _Beaten:
    lanes: NDArray[np.bool_] | None
    scored: int
    frontiers: int


def _beat(ground: Ground, shape: tuple[int, int], value: float, most: int) -> _Beaten:
    """Look for a layout of more than `value` among those of up to `most` stalls."""
    from garage2usd.planning.board import NO_VALUE, new_board  # noqa: PLC0415 - only planning pays for the compiler
    from garage2usd.planning.frontier import (  # noqa: PLC0415
        FORBIDDEN,
        Sheet,
        advance,
        complete,
        enumerate_layouts,
        suffix_values,
    )

    hops = free_hops(ground)
    price = -float(ground.weights[1]) / most
    kinds = cells_of(ground, np.zeros(len(ground.squares), dtype=np.bool_)).ravel()
    sheet = Sheet(shape[1], kinds, _worth(ground, hops, price))
    layers = [(np.zeros(1, np.int64), np.zeros(1))]
    after = np.concatenate((np.cumsum((kinds == Cell.FREE)[::-1])[::-1][1:], [0]))
    for index in range(len(kinds)):
        layers.append(advance(sheet, index, *layers[-1], value, int(after[index])))
    suffixes = [np.array([0.0 if complete(sheet, key) else FORBIDDEN for key in layers[-1][0]])]
    for index in reversed(range(len(kinds))):
        suffixes.append(suffix_values(sheet, index, layers[index][0], layers[index + 1][0], suffixes[-1]))
    suffixes.reverse()
    offsets = np.concatenate(([0], np.cumsum([len(keys) for keys, _ in layers])))
    frontiers = int(offsets[-1])
    if not len(layers[-1][0]) or suffixes[0][0] <= value:
        return _Beaten(None, 0, frontiers)
    board = new_board(ground)
    keys = np.concatenate([keys for keys, _ in layers])
    found, scored = enumerate_layouts(
        sheet, ground, board, offsets, keys, np.concatenate(suffixes), hops, price, value, _MAX_LAYOUTS
    )
    if scored >= _MAX_LAYOUTS:
        raise GenerationError("optimum", "more candidates than can be scored", seed=0, attempts=scored)
    lanes = board.cells[ground.squares] == Cell.LANE if found > NO_VALUE else None
    return _Beaten(lanes, scored, frontiers)


def _worth(ground: Ground, hops: NDArray[np.int64], price: float) -> NDArray[np.float64]:
    """Relaxed contribution of each square by its open edges; shape (rows * cols, 16)."""
    inside = cells_of(ground._replace(cells=np.arange(len(ground.cells))), np.zeros(len(ground.squares), np.bool_))
    squares = inside.ravel()
    near = np.full((len(squares), 16), _FAR)
    for edges in range(1, 16):
        beside = [step for bit, step in enumerate((-ground.stride, ground.stride, -1, 1)) if edges >> bit & 1]
        near[:, edges] = np.min([hops[squares + step] for step in beside], axis=0)
    stalls = ground.capacity[squares].astype(np.float64)
    weights = ground.weights
    each = weights[0] - price * (1 + near)
    worth = np.where(stalls > 0, stalls * each, weights[2])
    return np.ascontiguousarray(worth)


def free_hops(ground: Ground) -> NDArray[np.int64]:
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


def _turned(structure: Structure) -> Structure:
    """The same with rows and columns exchanged."""
    return Structure(structure.cells.T, structure.row_depths_mm, structure.column_widths_mm)
