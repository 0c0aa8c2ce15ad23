import networkx as nx
import pytest

import garage2usd
from garage2usd.garage import LaneEdge, LaneGraph, LaneKind, LaneNode
from garage2usd.structure.lanes import dead_ends

KINDS = ("entrance", "straight", "t_junction", "crossroads", "straight", "exit")


def in_a_row(*edges, spacing_m=8.0, levels=(0, 0, 0, 0, 0, 0)):
    """Six nodes along X, each 7.4 x 6 m between the columns."""
    nodes = tuple(
        LaneNode(kind, (spacing_m * number, 0.0), (7.4, 6.0), f"[0, {number}]", height_m=-3.0 * level, level=level)
        for number, (kind, level) in enumerate(zip(KINDS, levels, strict=True))
    )
    return LaneGraph(nodes, tuple(LaneEdge(*edge) for edge in edges))


def test_a_carriageway_is_driven_in_both_directions_unless_it_is_one_way():
    lanes = in_a_row((0, 1, 5.0, True), (2, 1, 6.0, False))
    assert [(arc, edge.width_m) for arc, edge in lanes.arcs.items()] == [((0, 1), 5.0), ((2, 1), 6.0), ((1, 2), 6.0)]
    assert lanes.onward == ((1,), (2,), (1,), (), (), ())
    assert lanes.backward == ((), (0, 2), (1,), (), (), ())
    assert lanes.beside == ((1,), (0, 2), (1,), (), (), ())
    assert (lanes.portals("exit"), lanes.joined_portals("entrance", "exit")) == ([5], [0])


def test_two_edges_between_two_nodes_join_them_once():
    lanes = in_a_row((1, 2, 6.0, False), (2, 1, 5.0, True))
    assert (lanes.onward[1], lanes.backward[1], lanes.beside[1]) == ((2,), (2,), (2,))


def test_the_directed_graph_has_width_length_climb_and_levels_of_each_arc():
    lanes = in_a_row((0, 1, 5.0, True), (1, 2, 6.0, False), levels=(0, 0, 1, 1, 1, 1))
    assert isinstance(lanes.graph, nx.DiGraph)
    assert nx.is_frozen(lanes.graph)
    assert set(lanes.graph.edges) == set(lanes.arcs)
    assert lanes.graph.edges[2, 1] == {"width_m": 6.0, "length_m": 8.0, "climb_m": 3.0, "levels": (1, 0)}
    assert lanes.graph.nodes[2] == {"kind": "t_junction", "x_m": 16.0, "z_m": 0.0, "height_m": -3.0, "level": 1}


def test_cars_arrive_and_leave_without_turning_round():
    lanes = in_a_row((0, 1, 5.0, True), (1, 2, 6.0, False), (2, 3, 6.0, False), (2, 5, 5.0, True))
    assert lanes.arriving == {(0, 1), (1, 2), (2, 3), (2, 5)}
    assert lanes.leaving == {(0, 1), (1, 2), (3, 2), (2, 5)}
    assert lanes.near(0, 1) == [(0, 1)]
    assert lanes.near(3, 1) == [(2, 3), (3, 2)]
    assert lanes.near(3, 2) == [(2, 3), (3, 2), (1, 2), (2, 1), (2, 5)]


@pytest.mark.parametrize(("spacing_m", "is_backed_out_of"), [(8.0, True), (13.35, True), (13.351, False)])
def test_a_dead_end_of_26_m_is_backed_out_of(spacing_m, is_backed_out_of):
    """Two lanes long from border to border: twice the spacing, less 0.7 m, as the junction is wider than its tip."""
    both_ways = ((1, 0), (1, 5), (1, 2), (2, 3))
    lanes = in_a_row(*((one, other, 6.0, False) for one, other in both_ways), spacing_m=spacing_m)
    wide = LaneNode("t_junction", lanes.nodes[1].position, (8.8, 6.0), "[0, 1]")
    lanes = LaneGraph((lanes.nodes[0], wide, *lanes.nodes[2:]), lanes.edges)
    (found,) = [end for end in lanes.dead_ends if end.nodes == [3, 2]]
    assert (found.mouth, found.length_m) == (1, pytest.approx(2 * spacing_m - 0.7))
    assert lanes.into_dead_ends(26.0) >= ({(1, 2), (2, 3)} if is_backed_out_of else frozenset())
    assert ((1, 2) in lanes.into_dead_ends(26.0)) == is_backed_out_of


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_dead_ends_are_those_of_the_squares(seed):
    """They are found in the graph as among the squares, to the millimetre."""
    garage = garage2usd.generate(seed=seed)
    squares = list(garage.graph.number_of)
    found = [
        (tuple(squares[node] for node in end.nodes), round(end.length_m, 3)) for end in garage.graph.lanes.dead_ends
    ]
    assert found == [(end.squares, end.length_m) for end in dead_ends(garage.graph.structure)]


def test_the_lanes_of_a_plan_are_its_squares_in_metres():
    garage = garage2usd.generate(seed=4)
    squares, lanes = garage.graph, garage.graph.lanes
    columns_m, rows_m = squares.structure.column_edges_m, squares.structure.row_edges_m
    assert [node.kind for node in lanes.nodes] == [squares.kind(square) for square in squares.number_of]
    for (row, col), (x, z) in zip(squares.number_of, lanes.positions_m.tolist(), strict=True):
        assert (x, z) == pytest.approx((sum(columns_m[col : col + 2]) / 2, sum(rows_m[row : row + 2]) / 2))
    setback_m = garage.config.bay.carriageway_setback_m
    for edge in lanes.edges:
        kinds = [lanes.nodes[end].kind for end in (edge.start, edge.end)]
        assert edge.one_way == (LaneKind.ENTRANCE in kinds or LaneKind.EXIT in kinds)
        assert kinds[0] != LaneKind.EXIT
        assert kinds[1] != LaneKind.ENTRANCE
        one, other = (lanes.nodes[end] for end in (edge.start, edge.end))
        axis = 0 if one.position[0] == other.position[0] else 1
        assert edge.width_m == one.widths_m[axis] == other.widths_m[axis]
        assert one.sides_m[axis] == pytest.approx(edge.width_m + 2 * setback_m)
