"""Nodes that cars reach in forward gear without turning back into the next aisle at once."""

import pytest

from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.garage.levels import LEAST_TURN_BACK_M, driven_nodes


def graph_of(places, ways):
    """Two-way lanes between places; the first is an entrance and the last an exit."""
    kinds = [LaneKind.ENTRANCE, *[LaneKind.STRAIGHT] * (len(places) - 2), LaneKind.EXIT]
    nodes = tuple(
        LaneNode(kind.value, place, (6.0, 6.0), f"[{number}]")
        for number, (kind, place) in enumerate(zip(kinds, places, strict=True))
    )
    return LaneGraph(nodes, tuple(LaneEdge(start, end, 6.0, one_way=False) for start, end in ways))


def about_turn(apart_m):
    """A lane, the aisle at its end, and a lane back that far apart."""
    places = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (20.0, apart_m), (10.0, apart_m), (0.0, apart_m)]
    return graph_of(places, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)])


@pytest.mark.parametrize("apart_m", [LEAST_TURN_BACK_M - 0.1, -LEAST_TURN_BACK_M + 0.1])
def test_cars_do_not_turn_back_into_the_next_aisle(apart_m):
    graph = about_turn(apart_m)
    assert driven_nodes(graph, LaneKind.ENTRANCE) == {0, 1, 2, 3}
    assert driven_nodes(graph, LaneKind.EXIT) == {5, 4, 3, 2}


@pytest.mark.parametrize("apart_m", [LEAST_TURN_BACK_M, -LEAST_TURN_BACK_M])
def test_they_turn_back_over_more_room(apart_m):
    graph = about_turn(apart_m)
    assert driven_nodes(graph, LaneKind.ENTRANCE) == driven_nodes(graph, LaneKind.EXIT) == set(range(6))


def test_a_straight_between_two_turns_gives_room_whatever_its_nodes():
    places = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (20.0, 4.0), (20.0, 8.0), (10.0, 8.0), (0.0, 8.0)]
    graph = graph_of(places, [(number, number + 1) for number in range(6)])
    assert driven_nodes(graph, LaneKind.ENTRANCE) == set(range(7))


def test_turns_to_both_sides_are_driven_however_close():
    places = [(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 5.0)]
    graph = graph_of(places, [(0, 1), (1, 2), (2, 3)])
    assert driven_nodes(graph, LaneKind.ENTRANCE) == set(range(4))
