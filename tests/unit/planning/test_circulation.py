"""The survey of circulation against networkx, and the rules on plans."""

import networkx as nx
import numpy as np
import pytest
from support.soak import soak_but

from garage2usd.common.errors import GenerationError
from garage2usd.config import GarageConfig, PlanConfig
from garage2usd.planning import plan_lanes
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell, Structure, cells_from_text


def structure(text):
    return Structure.from_arrays(cells_from_text(text, field="test"), 8.1, 8.1)


def lane_graph(cells):
    """Lanes and portals, with the pairs that share a side unless both are portals."""
    graph = nx.grid_2d_graph(*cells.shape)
    graph.remove_nodes_from([square for square in list(graph) if cells[square] < Cell.LANE])
    graph.remove_edges_from([(a, b) for a, b in graph.edges if cells[a] > Cell.LANE and cells[b] > Cell.LANE])
    return graph


def pruned_rounds(cells):
    """The round in which each lane is pruned, by taking all leaves off a graph at once until none is left."""
    graph, rounds, number = lane_graph(cells), np.zeros(cells.shape, int), 0
    while leaves := [s for s in graph if cells[s] == Cell.LANE and graph.degree(s) <= 1]:
        number += 1
        for square in leaves:
            rounds[square] = number
        graph.remove_nodes_from(leaves)
    return rounds, graph


def stretch_lengths(cells, core):
    """Squares of the stretch of each lane, as pieces of the pruned graph without portals and junctions."""
    between = core.subgraph(s for s in core if cells[s] == Cell.LANE and core.degree(s) == 2)
    lengths = np.zeros(cells.shape, int)
    for piece in nx.connected_components(between):
        for square in piece:
            lengths[square] = len(piece)
    return lengths


@pytest.mark.parametrize("seed", soak_but(15, range(60)))
def test_the_survey_agrees_with_a_graph(seed):
    rng = np.random.default_rng(seed)
    shape = tuple(rng.integers(3, 9, size=2))
    cells = rng.choice([-1, 0, 1, 2, 3], p=[0.1, 0.25, 0.55, 0.05, 0.05], size=shape).astype(np.int8)
    found = circulation(Structure.from_arrays(cells, 8.1, 8.1))
    rounds, core = pruned_rounds(cells)
    assert (found.rounds == rounds).all()
    assert (found.stretches == stretch_lengths(cells, core)).all()
    lanes = lane_graph(np.where(cells == Cell.LANE, 1, 0))
    circuits = lanes.number_of_edges() - lanes.number_of_nodes() + nx.number_connected_components(lanes)
    assert found.loops == circuits - len(found.blocks)
    blocks = [
        (row, col)
        for row in range(shape[0] - 1)
        for col in range(shape[1] - 1)
        if (cells[row : row + 2, col : col + 2] == Cell.LANE).all()
    ]
    assert list(found.blocks) == blocks


def test_faults_say_which_rule_gives_way_and_where():
    rules = rules_of(PlanConfig(longest_stretch_cells=5), squares=60)
    tree = circulation(structure("..........\nE========X\n....=.....\n....=.....\n....==....\n....==....\n.........."))
    assert tree.faults(rules) == {
        "R2": "the lanes have no loop",
        "R3": "the lanes are two squares wide at [4, 4]",
    }
    deep = circulation(structure(".......\nE=====X\n.=...=.\n.=====.\n...=...\n...=...\n...=..."))
    assert deep.faults(rules)["R1"] == "a dead end at [4, 3] is 3 squares deep, 2 at most are asked for"
    assert not deep.faults(rules_of(PlanConfig(circulation="allow"), squares=60))
    ring = circulation(structure("E=======X\n.=.....=.\n.=======."))
    assert ring.faults(rules) == {
        "R4": "the stretch at [1, 1] has 9 squares without a junction, 5 at most are asked for"
    }


def planned(seed=0, *, site=None, bay=None, **plan):
    config = GarageConfig(seed=seed, site=site or {}, bay=bay or {}, plan=plan)
    drawn = make_site(config.site, bay=config.bay, seed=seed)
    return plan_lanes(drawn, plan=config.plan, bay=config.bay, seed=seed), config


@pytest.mark.parametrize("seed", soak_but(1, range(4)))
def test_default_plans_keep_the_rules_by_graph(seed):
    plan, _ = planned(seed)
    assert not plan.gave_way
    cells = plan.structure.cells
    rounds, _ = pruned_rounds(cells)
    assert rounds.max() <= 2
    lanes = lane_graph(np.where(cells == Cell.LANE, 1, 0))
    assert lanes.number_of_edges() - lanes.number_of_nodes() + 1 >= 1


def test_large_plans_have_cross_aisles():
    plan, _ = planned(3, site={"width_cells": 30, "height_cells": 20, "entrances": 2, "exits": 2})
    assert not plan.gave_way
    cells = plan.structure.cells
    rounds, core = pruned_rounds(cells)
    assert rounds.max() <= 2
    assert stretch_lengths(cells, core).max() <= 12


def test_forbidden_dead_ends_leave_lanes_one_square_wide():
    plan, _ = planned(1, dead_ends="forbid")
    found = circulation(plan.structure)
    assert (found.dead_end_squares, found.blocks) == (0, ())


def test_a_site_without_room_for_a_loop_says_so():
    corridor = {"structure": "E......X\n########"}
    plan, _ = planned(site=corridor)
    assert plan.gave_way == {"R2": "the lanes have no loop"}
    with pytest.raises(GenerationError, match="no loop"):
        planned(site=corridor, strict=True)


def test_the_papers_agent_is_asked_for_nothing():
    plan, config = planned(preset="paper", episodes=300)
    assert not rules_of(config.plan, squares=63).is_asked
    assert not plan.gave_way
    assert not any(entry.is_polished for entry in plan.archive)
    polished, _ = planned(preset="paper", episodes=300, climb=True)
    assert polished.score.value >= plan.score.value


def test_learning_alone_keeps_the_rules_and_polish_is_told_apart():
    learnt, _ = planned(2, climb=False, bay={"dimensioned": False})
    assert not learnt.gave_way
    assert learnt.learnt.structure == learnt.structure
    plan, _ = planned(2, bay={"dimensioned": False})
    assert plan.score.value >= learnt.score.value
    assert plan.archive[0].is_polished == (plan.archive[0].structure != plan.learnt.structure)
