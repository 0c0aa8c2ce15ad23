"""Plans over 400 seeds and mixed sizes, and what turning or mirroring a plan leaves as it is."""

import networkx as nx
import numpy as np
import pytest
from support.planning_reference import BAY, feasible, random_site, score
from support.soak import soak_but

from garage2usd.config import PlanConfig
from garage2usd.planning import evaluate, is_feasible, plan_lanes, play, principles, rank_of, tape_at, tape_of
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import build_lane_graph

SEEDS, BLOCK = 400, 50
LARGE_EVERY = 25
"""Every so many seeds the site is a large one."""


def settings(seed):
    return PlanConfig(
        preset="paper" if seed % 3 == 0 else "tuned",
        circulation=("loops", "allow")[seed % 11 % 2],
        dead_ends=("standard", "allow", "forbid")[seed % 7 % 3],
        episodes=40,
        archive_size=5,
        starts=1,
        climb=seed % 5 == 0,
        climb_top=1,
        choice="draw" if seed % 2 else "best",
    )


@pytest.mark.parametrize("block", soak_but(2, range(SEEDS // BLOCK)))
def test_every_seed_is_feasible_and_has_its_tape(block):
    without_place = 0
    for seed in range(BLOCK * block, BLOCK * (block + 1)):
        large = seed % LARGE_EVERY == 0
        site = random_site(seed, large=large)
        if site is None:  # the drawn distances cannot be kept on so small a contour
            assert not large
            without_place += 1
            continue
        plan = plan_lanes(site, plan=settings(seed), bay=BAY, seed=seed)
        structure = plan.structure
        assert feasible(structure.cells)
        assert reaches_all_portals(structure.cells)
        figures = (plan.score.value, plan.score.stalls, plan.score.parking_time_squares, plan.score.unused_squares)
        assert score(structure) == pytest.approx(figures)
        tape = tape_of(structure)
        assert play(site, tape) == structure
        assert tape_at(rank_of(tape)) == tape
        assert play(site, tape_at(rank_of(tape))).digest() == structure.digest()
    assert without_place <= BLOCK // 10


def reaches_all_portals(cells):
    """Whether a car drives from each portal to each other one over lanes alone: by networkx."""
    lanes = nx.grid_2d_graph(*cells.shape)
    lanes.remove_nodes_from([square for square in list(lanes) if cells[square] != Cell.LANE])
    pieces = list(nx.connected_components(lanes))
    portals = [tuple(square) for square in np.argwhere(cells >= Cell.ENTRANCE).tolist()]
    return len(pieces) == 1 and all(any(abs(row - r) + abs(col - c) == 1 for r, c in pieces[0]) for row, col in portals)


SYMMETRIES = {
    f"{turns} quarter turns{', mirrored' if mirror else ''}": (turns, mirror) for turns in range(4) for mirror in (0, 1)
}


def transformed(structure, turns, mirror):
    """A structure mirrored left to right, then turned anticlockwise; its sizes go with it."""
    cells, widths, depths = structure.cells, structure.column_widths_mm, structure.row_depths_mm
    if mirror:
        cells, widths = cells[:, ::-1], widths[::-1]
    for _ in range(turns):
        cells, widths, depths = np.rot90(cells), depths, widths[::-1]
    return Structure(np.ascontiguousarray(cells), widths.copy(), depths.copy())


@pytest.mark.parametrize("name", SYMMETRIES)
def test_turned_and_mirrored_plans_have_the_same_figures(name):
    tried = 0
    for seed in range(40):
        rng = np.random.default_rng(seed)
        site = random_site(seed)
        if site is None:
            continue
        rows, cols = site.shape
        sized = Structure(site.cells, rng.integers(5300, 9001, cols), rng.integers(5300, 11001, rows))
        plan = plan_lanes(sized, plan=PlanConfig(episodes=30, climb=False, starts=1), bay=BAY, seed=seed).structure
        other = transformed(plan, *SYMMETRIES[name])
        mine, theirs = evaluate(plan, bay=BAY), evaluate(other, bay=BAY)
        assert is_feasible(other)
        assert (mine.stalls, mine.unused_squares) == (theirs.stalls, theirs.unused_squares)
        assert mine.parking_time_squares == pytest.approx(theirs.parking_time_squares)
        assert mine.value == pytest.approx(theirs.value)
        one, two = principles(plan, bay=BAY), principles(other, bay=BAY)
        assert (one.loops, len(one.dead_ends)) == (two.loops, len(two.dead_ends))
        assert sorted(end.length_m for end in one.dead_ends) == sorted(end.length_m for end in two.dead_ends)
        for share in ("rectangular_share", "parallel_share", "perimeter_share", "double_loaded_share"):
            assert getattr(one, share) == pytest.approx(getattr(two, share))
        assert build_lane_graph(plan, BAY).kind_counts() == build_lane_graph(other, BAY).kind_counts()
        tried += 1
    assert tried > 30
