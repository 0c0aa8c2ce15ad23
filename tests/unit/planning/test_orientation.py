import math

import networkx as nx
import numpy as np
import pytest
from support.soak import soak_but

from garage2usd import ConfigError, GarageConfig, GenerationError, generate
from garage2usd.planning import driven_lengths
from garage2usd.structure.lanes import BOTH_WAYS, stretches_of

SITE = {"width_cells": 12, "height_cells": 9}
PLAN = {"episodes": 200, "starts": 1}


def one_way(seed=0, site=SITE, **settings):
    plan = {**PLAN, "aisles": "one-way", **settings.pop("plan", {})}
    return generate(GarageConfig(seed=seed, site=site, plan=plan, **settings))


def reach(garage):
    """A graph of lanes and portals with their metres, from the lane graph of the garage alone."""
    lanes = garage.graph.lanes
    graph = nx.DiGraph()
    graph.add_nodes_from(range(len(lanes.nodes)))
    for start, end in lanes.arcs:
        graph.add_edge(start, end, m=math.dist(lanes.nodes[start].position, lanes.nodes[end].position))
    return graph


@pytest.mark.parametrize("seed", soak_but(2, range(6)))
def test_every_lane_is_reached_from_each_without_driving_out(seed):
    garage = one_way(seed, {**SITE, "rectangles": seed % 3, "obstacles": seed % 2})
    graph, lanes = reach(garage), garage.graph.lanes
    inner = graph.subgraph(number for number, node in enumerate(lanes.nodes) if not node.is_portal)
    assert nx.is_strongly_connected(inner)
    bridges = {frozenset(bridge) for bridge in nx.bridges(inner.to_undirected())}
    two_way = {frozenset(edge) for edge in inner.edges if inner.has_edge(*edge[::-1])}
    assert two_way == bridges
    assert garage.plan.directions.one_way


@pytest.mark.parametrize("seed", soak_but(1, range(3)))
def test_the_lengths_of_drives_are_those_of_the_lane_graph(seed):
    garage = one_way(seed)
    graph, lanes = reach(garage), garage.graph.lanes
    entrances, exits = (lanes.portals(kind) for kind in ("entrance", "exit"))
    there = nx.multi_source_dijkstra_path_length(graph, set(entrances), weight="m")
    onward = nx.multi_source_dijkstra_path_length(graph.reverse(), set(exits), weight="m")
    # a square with stalls beside several lanes counts for each of them in equal parts
    total, stalls = 0.0, 0
    rows = {}
    for row in garage.graph.stall_rows:
        rows[row.square] = rows.get(row.square, 0) + row.count
    for (row, col), count in rows.items():
        beside = [(row + 1, col), (row - 1, col), (row, col + 1), (row, col - 1)]
        numbers = [garage.graph.number_of[lane] for lane in beside if garage.graph.number_of.get(lane) is not None]
        numbers = [n for n in numbers if not lanes.nodes[n].is_portal]
        total += count * np.mean([there[n] + onward[n] for n in numbers])
        stalls += count
    found = driven_lengths(garage.plan, garage.config, garage.plan.directions)
    assert found.directed_m == pytest.approx(total / stalls, abs=1e-3)
    assert 1.0 <= found.detour < 3.0


def turned(garage):
    """Area that the one-way lanes lead around to the left, seen from above, less that to the right."""
    structure = garage.plan.structure
    x = (structure.column_edges_m[1:] + structure.column_edges_m[:-1]) / 2
    z = (structure.row_edges_m[1:] + structure.row_edges_m[:-1]) / 2
    middle = x.mean(), z.mean()
    area = 0.0
    for (row, col), (to_row, to_col) in garage.plan.directions.one_way:
        # upwards on the plan is -z
        ax, ay, bx, by = x[col] - middle[0], middle[1] - z[row], x[to_col] - middle[0], middle[1] - z[to_row]
        area += (ax * by - bx * ay) / 2
    return area


RING = {"structure": "E=====.\n.=...=.\n.=...=.\n.=====X"}


@pytest.mark.parametrize(("profile", "sign"), [("cn-jgj100", 1), ("uk-istructe", -1)])
def test_loops_turn_to_the_side_of_traffic(profile, sign):
    garage = generate(GarageConfig(profile=profile, site=RING, plan={"aisles": "one-way"}))
    assert np.sign(turned(garage)) == sign


def test_nothing_is_turned_unless_asked_for():
    garage = generate(GarageConfig(site=SITE, plan=PLAN))
    assert garage.plan.directions is BOTH_WAYS


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_a_share_of_the_aisles_is_one_way(share):
    garage = one_way(plan={"aisles": "mixed", "one_way_share": share})
    every, all_turned = stretches_of(garage.plan.structure), one_way().plan.directions
    steps = sum(len(stretch) - 1 for stretch in every)
    longest = max(len(stretch) - 1 for stretch in every) / steps
    whole = len(all_turned.one_way) / steps
    assert len(garage.plan.directions.one_way) / steps == pytest.approx(share * whole, abs=longest / 2 + 1e-9)


def test_the_same_seed_turns_the_same_lanes():
    assert one_way(4).plan.directions == one_way(4).plan.directions


def test_given_steps_are_kept():
    step = ((0, 2), (0, 1))
    garage = generate(GarageConfig(site=RING, plan={"one_way": [step]}))
    assert step in garage.plan.directions.one_way


def test_directions_that_lead_to_no_stall_are_refused():
    # the only aisle leads from the exit to the entrance
    with pytest.raises(GenerationError, match="along the directions given"):
        generate(GarageConfig(site={"structure": "E=.\n.=.\n.=.\nX=="}, plan={"one_way": [((1, 1), (0, 1))]}))


def test_a_step_that_is_none_names_its_field():
    with pytest.raises(ConfigError) as error:
        generate(GarageConfig(site=RING, plan={"one_way": [((0, 1), (3, 1))]}))
    assert error.value.field == "plan.one_way[0]"


@pytest.mark.parametrize("seed", soak_but(1, range(3)))
def test_angled_stalls_lean_with_the_traffic_of_their_lane(seed):
    garage = one_way(seed, stalls={"kinds": {"angled": 1}})
    checked = 0
    for stall in garage.layout.stalls:
        lane = stall.access_square
        steps = [step for step in garage.plan.directions.one_way if lane in step]
        corners = np.array(stall.corners_m())
        inwards = corners[2:].mean(axis=0) - corners[:2].mean(axis=0)
        mouth = corners[1] - corners[0]
        driven = [np.array([to_col - col, to_row - row], dtype=float) for (row, col), (to_row, to_col) in steps]
        along = [step for step in driven if abs(step @ mouth) > 1e-6]
        # cars come to a junction from both sides, or leave it to both
        if along and all((step == along[0]).all() for step in along):
            assert along[0] @ inwards > 0
            checked += 1
    assert checked
