"""What the tests of the planner compare with: sites, and the score written once more in another way."""

import numpy as np
import pytest

from garage2usd.common.errors import GenerationError
from garage2usd.config import BayConfig, SiteConfig
from garage2usd.config.site import DEFAULT_SIDE_M
from garage2usd.planning.board import ground_of, new_board
from garage2usd.site import make_site
from garage2usd.structure.grid import Structure, cells_from_text

BAY = BayConfig(dimensioned=False)


def drawn(text, side_m=8.1):
    return Structure.from_arrays(cells_from_text(text, field="test"), side_m, side_m)


def gates(entrance, exit_, shape=(7, 9), bay=BAY):
    cells = np.zeros(shape, dtype=np.int8)
    cells[entrance], cells[exit_] = 2, 3
    return Structure.from_arrays(cells, bay.column_widths_m or DEFAULT_SIDE_M, bay.row_depths_m or DEFAULT_SIDE_M)


G1, G2, G3 = gates((6, 2), (6, 6)), gates((6, 4), (0, 4)), gates((3, 0), (3, 8))
OPTIMUM = {"G1": 76.4054, "G2": 76.6111, "G3": 74.1111}
OPTIMUM_WITH_LOOPS = {"G1": 69.8571, "G2": 71.7059, "G3": 71.0}
"""Without rules of circulation, and under R1 to R3."""


SMALL = {
    "height_cells": (6, 17),
    "width_cells": (6, 19),
    "rectangles": (0, 5),
    "entrances": (1, 3),
    "exits": (1, 3),
    "obstacles": (0, 3),
}
LARGE = {"height_cells": (20, 41), "width_cells": (20, 41), "rectangles": (1, 6), "obstacles": (0, 9)}


def random_site(seed, bay=BAY, *, large=False):
    """A site with contour, obstacles and several portals; None if the rules find no place.

    Of 6x6 to 16x18 squares, if large of 20x20 to 40x40.
    """
    rng = np.random.default_rng(seed)
    spans, fixed = SMALL, {"min_fill": 0.3, "min_portal_distance_cells": 2}
    if large:
        spans, fixed = LARGE, {"entrances": 2, "exits": 2}
    site = SiteConfig(**fixed, **{name: int(rng.integers(*span)) for name, span in spans.items()})
    try:
        return make_site(site, bay=bay, seed=seed)
    except GenerationError:
        return None


def sown(seed, plan, share=0.3):
    """A random site, its ground, a board with lanes on a share of the squares (None: any), and these squares."""
    site = random_site(seed)
    if site is None:
        pytest.skip("no such site")
    ground = ground_of(site, bay=BAY, plan=plan)
    board = new_board(ground)
    rng = np.random.default_rng(seed)
    lots = rng.random(len(ground.squares))
    laid = ground.squares[lots < (rng.uniform(0, 0.6) if share is None else share)]
    board.cells[laid] = 1
    return site, ground, board, laid


def hops(cells):
    """Squares driven from the nearest entrance to each lane, by relaxing the whole matrix; infinite where unreached."""
    lane = cells == 1
    distance = np.full((cells.shape[0] + 2, cells.shape[1] + 2), np.inf)
    distance[1:-1, 1:-1][cells == 2] = 0
    while True:
        beside = np.minimum.reduce([distance[:-2, 1:-1], distance[2:, 1:-1], distance[1:-1, :-2], distance[1:-1, 2:]])
        better = np.where(lane, np.minimum(distance[1:-1, 1:-1], beside + 1), distance[1:-1, 1:-1])
        if (better == distance[1:-1, 1:-1]).all():
            return np.where(lane, better, np.inf)
        distance[1:-1, 1:-1] = better


def feasible(cells):
    """Lanes in one piece without the portals, and every portal beside a lane: by growing from one lane."""
    lane = np.pad(cells == 1, 1)
    grown = np.zeros_like(lane)
    if not lane.any():
        return False
    grown[tuple(np.argwhere(lane)[0])] = True
    for _ in range(lane.size):
        wider = grown.copy()
        for axis in (0, 1):
            for shift in (-1, 1):
                wider |= np.roll(grown, shift, axis)
        wider &= lane
        if (wider == grown).all():
            break
        grown = wider
    beside = np.zeros_like(lane)
    for axis in (0, 1):
        for shift in (-1, 1):
            beside |= np.roll(lane, shift, axis)
    return bool((grown == lane).all() and beside[1:-1, 1:-1][cells >= 2].all())


def score(structure, bay=BAY):
    """(y', N_S, T_S, U_S), square by square."""
    cells, distance = structure.cells, np.pad(hops(structure.cells), 1, constant_values=np.inf)
    stalls = time = unused = 0
    for (row, col), cell in np.ndenumerate(cells):
        if cell != 0:
            continue
        around = [
            distance[row, col + 1],
            distance[row + 2, col + 1],
            distance[row + 1, col],
            distance[row + 1, col + 2],
        ]
        up, down, left, right = (bool(np.isfinite(value)) for value in around)
        width, depth = float(structure.R[row, col]), float(structure.C[row, col])
        count = 0
        for edge, across, one, both in (
            (width, depth, up or down, up and down),
            (depth, width, left or right, left and right),
        ):
            fits = int((edge - bay.column_size_m) / bay.stall_width_m + 1e-9)
            rows = 2 if both and across >= 2 * bay.stall_length_m - 1e-9 else 1
            if one and across >= bay.stall_length_m - 1e-9:
                count = max(count, fits * rows)
        stalls += count
        unused += count == 0
        if count:
            time += count * (1 + min(around))
    if stalls == 0:
        return -unused, 0, 0.0, unused
    return stalls - 5 * time / stalls - unused, stalls, time / stalls, unused
