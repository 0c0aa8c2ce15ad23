import json
import pickle
from itertools import pairwise

import numpy as np
import pytest

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step
from garage2usd.config import BayConfig, GarageConfig, PlanConfig
from garage2usd.pipeline import build, generate
from garage2usd.planning import evaluate, given_plan, plan_lanes
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure, cells_from_text

BAY = BayConfig(dimensioned=False)
GATES = {"G1": ((6, 2), (6, 6)), "G2": ((6, 4), (0, 4)), "G3": ((3, 0), (3, 8))}
COMB = """
.=..=..=.
.=..=..=.
.=..=..=.
.=..=..=.
.=..=..=.
.=======.
..E...X..
"""
RING = """
.........
.=======.
.=.....=.
.=.....=.
.=.....=.
.=======.
..E...X..
"""
RING_AND_CENTRE_AISLE = """
.........
.=======.
.=..=..=.
.=..=..=.
.=..=..=.
.=======.
..E...X..
"""
RING_AND_CROSS = """
.........
.=======.
.=..=..=.
.=======.
.=..=..=.
.=======.
..E...X..
"""


def structure(text, R=8.1, C=8.1):
    return Structure.from_arrays(cells_from_text(text, field="S"), R, C)


def site(gate, seed=0):
    entrance, exit_ = GATES[gate]
    config = GarageConfig(site={"entrance_cells": [entrance], "exit_cells": [exit_]})
    return make_site(config.site, bay=BAY, seed=seed)


@pytest.mark.parametrize(
    ("drawing", "value"),
    [(COMB, 74.41), (RING, 59.71), (RING_AND_CENTRE_AISLE, 64.76), (RING_AND_CROSS, 53.00)],
)
def test_the_score_of_known_plans(drawing, value):
    assert evaluate(structure(drawing), bay=BAY).value == pytest.approx(value, abs=0.005)


def test_the_score_by_hand():
    score = evaluate(structure("E==X\n....\n...."), bay=BAY)
    # two squares of three stalls below the lanes, one and two squares from the entrance, six squares unused
    assert (score.stalls, score.unused_squares) == (6, 6)
    assert score.parking_time_squares == pytest.approx((3 * 2 + 3 * 3) / 6)
    assert score.value == pytest.approx(6 - 5 * 2.5 - 6)


def test_weights_are_settings():
    plain = structure("E==X\n....\n....")
    score = evaluate(plain, bay=BAY, plan=PlanConfig(stall_weight=2, parking_time_weight=0, unused_weight=-3))
    assert score.value == 2 * 6 - 3 * 6


def brute_score(structure):
    """Straight from the definition, sharing nothing with the package but the cells."""
    S = structure.cells
    rows, cols = S.shape

    def near(r, c):
        around = ((r - 1, c), (r + 1, c), (r, c - 1), (r, c + 1))
        return [(a, b) for a, b in around if 0 <= a < rows and 0 <= b < cols]

    distance = {}
    front = [q for r, c in zip(*np.where(S == 2), strict=True) for q in near(r, c) if S[q] == 1]
    hops = 1
    while front:
        for q in front:
            distance.setdefault(q, hops)
        hops += 1
        front = [p for q in set(front) for p in near(*q) if S[p] == 1 and p not in distance]
    stalls, time, unused = 0, 0, 0
    for r, c in zip(*np.where(S == 0), strict=True):
        lanes = [q for q in near(r, c) if S[q] == 1]
        if lanes:
            stalls += 3
            time += 3 * (1 + min(distance[q] for q in lanes))
        else:
            unused += 1
    return stalls - 5 * time / stalls - unused


@pytest.mark.parametrize("gate", GATES)
@pytest.mark.parametrize("preset", ["paper", "tuned"])
def test_every_archived_plan_is_feasible_distinct_and_scored_right(gate, preset):
    empty = site(gate)
    plan = plan_lanes(
        empty, plan=PlanConfig(preset=preset, episodes=1500, circulation="allow", dead_ends="allow"), bay=BAY, seed=5
    )
    assert plan.structure == plan.archive[0].structure
    assert plan.score == plan.archive[0].score
    assert len({entry.structure.digest() for entry in plan.archive}) == len(plan.archive) <= 200
    values = [entry.score.value for entry in plan.archive]
    assert values == sorted(values, reverse=True)
    assert plan.learning_curve.shape == (1500,)
    assert np.isfinite(plan.learning_curve).all()
    for entry in plan.archive:
        S = entry.structure.cells
        changed = empty.cells != S
        assert (empty.cells[changed] == Cell.FREE).all()
        assert (S[changed] == Cell.LANE).all()
        assert entry.score.value == pytest.approx(brute_score(entry.structure), abs=1e-9)
        again = evaluate(entry.structure, bay=BAY)
        assert (again.stalls, again.unused_squares) == (entry.score.stalls, entry.score.unused_squares)
        assert again.value == pytest.approx(entry.score.value, abs=1e-9)


@pytest.mark.parametrize("gate", GATES)
def test_tuned_learns_more_than_the_paper_s_best_plan(gate):
    plan = plan_lanes(site(gate), plan=PlanConfig(), bay=BAY, seed=2)
    assert plan.score.value > 62.18
    # learning shows: the last episodes earn more than the first
    assert plan.learning_curve[-500:].mean() > plan.learning_curve[:500].mean() + 10


def test_plans_depend_on_the_seed_alone():
    one, same, other = (plan_lanes(site("G1"), plan=PlanConfig(episodes=300), bay=BAY, seed=s) for s in (1, 1, 2))
    assert one.structure == same.structure
    assert (one.learning_curve == same.learning_curve).all()
    assert (one.learning_curve != other.learning_curve).any()


def test_batches_do_not_change_the_result(monkeypatch):
    from garage2usd.planning import learner as module

    whole = plan_lanes(site("G1"), plan=PlanConfig(episodes=300), bay=BAY, seed=1)
    monkeypatch.setattr(module, "_BATCH_SQUARES", 640)
    parts = []
    batched = plan_lanes(
        site("G1"), plan=PlanConfig(episodes=300), bay=BAY, seed=1, progress=lambda *told: parts.append(told)
    )
    assert len(parts) > 10
    assert (whole.learning_curve == batched.learning_curve).all()
    assert whole.structure == batched.structure


def test_presets_and_overrides():
    paper = PlanConfig(preset="paper").resolved()
    assert (paper.alpha, paper.gamma, paper.window_radius_squares) == (0.1, 0.95, 2)
    changed = PlanConfig(preset="paper", alpha=0.5).resolved()
    assert changed == paper._replace(alpha=0.5)


def test_climbing_never_loses():
    for gate in GATES:
        plain = plan_lanes(
            site(gate),
            plan=PlanConfig(episodes=500, climb=False, circulation="allow", dead_ends="allow"),
            bay=BAY,
            seed=3,
        )
        climbed = plan_lanes(
            site(gate), plan=PlanConfig(episodes=500, circulation="allow", dead_ends="allow"), bay=BAY, seed=3
        )
        assert climbed.score.value >= plain.score.value


def test_a_site_that_no_lane_can_join_is_an_error():
    for split in ("E.#.X\n..#..", "E.#.X\n####."):
        with pytest.raises(GenerationError) as caught:
            plan_lanes(structure(split), plan=PlanConfig(episodes=20), bay=BAY, seed=9)
    assert (caught.value.step, caught.value.seed) == ("plan", 9)


def test_a_portal_without_a_free_square_beside_it_is_an_error():
    with pytest.raises(GenerationError):
        plan_lanes(structure("E#.X\n#...\n...."), plan=PlanConfig(episodes=20), bay=BAY, seed=9)


def test_narrow_sites_with_many_portals_are_joined():
    narrow = structure("E......X\n........\nX......E")
    plan = plan_lanes(narrow, plan=PlanConfig(preset="paper", episodes=3), bay=BAY, seed=1)
    assert brute_score(plan.structure) == pytest.approx(plan.score.value)


def test_a_given_structure_is_taken_as_it_is():
    plan = given_plan(structure(COMB), bay=BAY, plan=PlanConfig())
    assert plan.structure == structure(COMB)
    assert plan.archive == ()
    assert plan.score.stalls == 111


def test_steps_have_ids_of_their_own():
    assert len({int(step) for step in Step}) == len(Step)


@pytest.mark.parametrize("episodes", [1, 7, 500, 501, 1234])
def test_a_report_has_the_means_of_the_learning_curve(tmp_path, episodes):
    config = GarageConfig(plan={"episodes": episodes, "climb": False})
    built = build(config, tmp_path / "g.usdc")
    curve, points = (
        built.garage.plan.learning_curve,
        json.loads(built.report.read_text())["levels"][0]["learning_curve"],
    )
    assert len(points) == min(episodes, 500)
    borders = np.cumsum([0] + [episodes // len(points) + (n < episodes % len(points)) for n in range(len(points))])
    means = [curve[start:end].mean() for start, end in pairwise(borders)]
    assert points == pytest.approx(means, abs=0.05 + 1e-9)  # they have one decimal


def test_a_garage_can_be_sent_to_another_process():
    garage = generate(GarageConfig(seed=4, plan={"episodes": 200}))
    sent = pickle.loads(pickle.dumps(garage))  # noqa: S301 - our own
    assert sent.config == garage.config
    assert sent.site == garage.site
    assert sent.plan.structure == garage.plan.structure
    assert sent.plan.gave_way == garage.plan.gave_way
    assert [entry.score for entry in sent.plan.archive] == [entry.score for entry in garage.plan.archive]
    assert list(sent.graph.graph.edges(data=True)) == list(garage.graph.graph.edges(data=True))
    assert list(sent.layout.placements) == list(garage.layout.placements)
    for array in (sent.plan.structure.cells, sent.plan.structure.row_depths_mm, sent.plan.learning_curve):
        assert not array.flags.writeable
    with pytest.raises(TypeError):
        sent.plan.gave_way["R2"] = "not any more"
