"""Roads of random lane graphs: they meet where they say, without gaps, and lead where the lanes lead."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.as_built import BuiltLevel
from garage2usd.garage import LaneEdge, LaneGraph, LaneNode
from garage2usd.maps.network import LEFT, RIGHT
from garage2usd.maps.road_builder import network_of

SETBACK_M = 0.3


@st.composite
def garages(draw):
    """Lane squares of a grid with uneven sides, and portals at squares of its border."""
    rows, cols = draw(st.integers(1, 5)), draw(st.integers(2, 6))
    lanes = np.array(draw(st.lists(st.booleans(), min_size=rows * cols, max_size=rows * cols))).reshape(rows, cols)
    depths = np.array(draw(st.lists(st.sampled_from([5.2, 6.0, 8.1]), min_size=rows, max_size=rows)))
    widths = np.array(draw(st.lists(st.sampled_from([5.2, 6.7, 8.1]), min_size=cols, max_size=cols)))
    z, x = np.cumsum(depths) - depths / 2, np.cumsum(widths) - widths / 2
    squares = [tuple(square) for square in np.argwhere(lanes).tolist()]
    outer = [number for number, (row, col) in enumerate(squares) if row in {0, rows - 1} or col in {0, cols - 1}]
    kinds = ["straight"] * len(squares)
    for number in draw(st.lists(st.sampled_from(outer), max_size=3, unique=True)) if outer else []:
        kinds[number] = draw(st.sampled_from(["entrance", "exit"]))
    nodes = [
        LaneNode(kind, (x[col], z[row]), (widths[col] - 2 * SETBACK_M, depths[row] - 2 * SETBACK_M), f"[{row}, {col}]")
        for (row, col), kind in zip(squares, kinds, strict=True)
    ]
    number_of, edges = {square: number for number, square in enumerate(squares)}, []
    for (row, col), start in number_of.items():
        for other, side in (((row, col + 1), 1), ((row + 1, col), 0)):
            end = number_of.get(other)
            if end is None or {kinds[start], kinds[end]} in ({"entrance"}, {"exit"}):
                continue
            one_way = kinds[start] != "straight" or kinds[end] != "straight"
            turned = kinds[start] == "exit" or kinds[end] == "entrance"
            pair = (end, start) if turned else (start, end)
            edges.append(LaneEdge(*pair, nodes[start].widths_m[side], one_way))
    return BuiltLevel("random", "plan", LaneGraph(tuple(nodes), tuple(edges)), ())


def lane_end(road, lane, *, at_start):
    """Middle (x, y) and width of a lane at one end of its road."""
    s = 0.0 if at_start else road.line.length_m
    lanes = road.lanes_at(s)
    return np.array(road.line.beside(s, lanes.centre_m(lane))), lanes.width_m(lane)


def lane_ways(network):
    """From (road, lane) to (road, lane) as they are driven, by the links that roads and junctions say."""
    roads, ways = {road.number: road for road in network.roads}, []
    links = {(junction.number, link.connecting): link for junction in network.junctions for link in junction.links}
    for road in network.roads:
        for joined, neighbour, at_start in (
            (road.lane_before, road.predecessor, True),
            (road.lane_after, road.successor, False),
        ):
            for own, other in joined.items():
                beyond = roads[neighbour.number]
                place, width = lane_end(road, own, at_start=at_start)
                there, width_there = lane_end(beyond, other, at_start=neighbour.at_start)
                assert there == pytest.approx(place, abs=1e-6)
                assert width_there == pytest.approx(width)
                comes_in = (own == RIGHT) == at_start
                ways.append(((beyond.number, other), (road.number, own))[:: 1 if comes_in else -1])
        if road.junction is not None:
            link = links[road.junction, road.number]
            assert (link.incoming, link.from_lane) == (road.predecessor.number, road.lane_before[RIGHT])
            assert (link.from_lane == RIGHT) != road.predecessor.at_start
    return ways


@given(garages())
@settings(max_examples=200, deadline=None)
def test_roads_lead_where_lanes_lead(subject):
    if not subject.lanes.edges:
        return
    network = network_of(subject)
    numbers = [road.number for road in network.roads] + [junction.number for junction in network.junctions]
    assert sorted(numbers) == list(range(1, len(numbers) + 1))
    graph = nx.DiGraph(lane_ways(network))
    on = {number: set() for number in range(len(subject.lanes.nodes))}
    for road in network.roads:
        assert road.line.length_m > 0.04
        assert road.lanes in {(LEFT, RIGHT), (RIGHT,)}
        for number in road.nodes:
            on[number] |= {(road.number, lane) for lane in road.lanes}
    # a lane that leads to entrances alone ends where their junction begins, as one from exits alone begins there
    square_of = {junction.number: junction.node for junction in network.junctions}
    ends, begins = {number: set() for number in on}, {number: set() for number in on}
    for road in network.roads:
        for neighbour, at_start in ((road.predecessor, True), (road.successor, False)):
            if neighbour is not None and neighbour.is_junction:
                for lane in road.lanes:
                    found = begins if (lane == RIGHT) == at_start else ends
                    found[square_of[neighbour.number]].add((road.number, lane))
    graph.add_nodes_from(lane for lanes in (*on.values(), *ends.values(), *begins.values()) for lane in lanes)
    driven = nx.DiGraph([*subject.lanes.arcs])
    for number in driven:
        starts = on[number] | begins[number]
        reached = starts.union(*(nx.descendants(graph, lane) for lane in starts))
        found = {number} | {other for other in driven if (on[other] | ends[other]) & reached}
        assert found == {number, *nx.descendants(driven, number)}
