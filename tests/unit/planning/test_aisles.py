"""Large sites: aisles, the annealing of large plans, and the counting bound."""

import numpy as np
import pytest
from support.planning_reference import BAY, G1, G2, G3, OPTIMUM, feasible, score, sown
from support.soak import soak_but

from garage2usd.config import PlanConfig, SiteConfig
from garage2usd.planning import counting_bound, evaluate, plan_lanes
from garage2usd.planning.aisles import runs_of
from garage2usd.planning.annealing import anneal_flips
from garage2usd.planning.board import cells_of, connect, ground_of, measure
from garage2usd.site import make_site

ALLOW = PlanConfig(circulation="allow", dead_ends="allow")


def large_site(height, width, seed):
    site = SiteConfig(
        height_cells=height,
        width_cells=width,
        rectangles=6,
        obstacles=12,
        entrances=2,
        exits=2,
        min_portal_distance_cells=5,
    )
    return make_site(site, bay=BAY, seed=seed)


def test_runs_are_all_of_the_site():
    site = large_site(20, 30, 1)
    ground = ground_of(site, bay=BAY, plan=ALLOW)
    runs = runs_of(ground)
    for direction, step in enumerate((1, ground.stride)):
        begin = 0 if direction == 0 else runs.turned[0]
        squares = [
            runs.first[run] + index * step
            for run in range(begin, runs.turned[direction])
            for index in range(runs.length[run])
        ]
        assert len(squares) == len(set(squares))
        missing = set(ground.squares.tolist()) - set(squares)
        assert all(ground.cells[q - step] != 0 and ground.cells[q + step] != 0 for q in missing)
        assert set(squares) <= set(ground.squares.tolist())


@pytest.mark.parametrize("seed", soak_but(3, range(12)))
def test_annealing_of_flips_stays_feasible_and_never_loses(seed):
    site, ground, board, _ = sown(seed, ALLOW)
    assert connect(ground, board)
    before = measure(ground, board, -np.inf)
    after = anneal_flips(ground, board, board.cells.copy(), np.array([seed], np.uint64), 20_000, 1.0, 0.1, 50)
    structure = site.with_cells(cells_of(ground, board.cells[ground.squares] == 1))
    assert after > before
    assert feasible(structure.cells)
    assert score(structure)[0] == pytest.approx(after)


@pytest.mark.parametrize(("shape", "share"), [((20, 30), 0.84), ((40, 60), 0.91), ((100, 100), 0.95)])
def test_large_sites(shape, share):
    site = large_site(*shape, 2)
    plan = plan_lanes(site, plan=PlanConfig(circulation="allow", dead_ends="allow", archive_size=20), bay=BAY, seed=3)
    bound = counting_bound(site, bay=BAY)
    assert feasible(plan.structure.cells)
    assert share * bound < plan.score.value < bound
    assert plan.learnt.score.value > (share - 0.06) * bound  # Sarsa leads, polish follows
    assert plan.score.value == pytest.approx(evaluate(plan.structure, bay=BAY).value)


def test_the_bound_is_above_the_proven_optimum():
    for site, name in ((G1, "G1"), (G2, "G2"), (G3, "G3")):
        assert counting_bound(site, bay=BAY) > OPTIMUM[name]


@pytest.mark.parametrize("agent", ["squares", "aisles"])
def test_agent_is_a_setting(agent):
    plan = plan_lanes(G1, plan=PlanConfig(agent=agent, episodes=200), bay=BAY, seed=0)
    assert feasible(plan.structure.cells)
    assert len(plan.learning_curve) == 200


def test_an_agent_over_aisles_may_explore_nothing_at_all():
    settings = PlanConfig(episodes=20, agent="aisles", epsilon_start=0, climb=False)
    plans = [plan_lanes(large_site(9, 12, 1), plan=settings, bay=BAY, seed=seed) for seed in (0, 0)]
    assert feasible(plans[0].structure.cells)
    assert np.array_equal(plans[0].structure.cells, plans[1].structure.cells)
