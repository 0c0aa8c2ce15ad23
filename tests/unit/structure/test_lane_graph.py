import pytest

from garage2usd.common.errors import UnreachableStallError
from garage2usd.config import BayConfig
from garage2usd.garage import LaneKind
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import StallType, build_lane_graph


def graph_of(text):
    return build_lane_graph(Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1), BayConfig())


def test_kinds_count_lanes_and_portals():
    graph = graph_of(
        """
        .=...
        E===X
        .=...
        """
    )
    assert graph.kind((1, 1)) is LaneKind.CROSSROADS  # raw S would sum 2 + 1 + 1 + 1 = 5
    assert graph.kind((1, 2)) is LaneKind.STRAIGHT
    assert graph.kind((0, 1)) is LaneKind.STRAIGHT
    assert graph.kind((1, 0)) is LaneKind.ENTRANCE
    assert graph.kind((1, 4)) is LaneKind.EXIT


def test_two_lanes_and_an_entrance_are_a_t_junction():
    graph = graph_of("X==.\n.E..")
    assert graph.kind((0, 1)) is LaneKind.T_JUNCTION


def test_stall_types():
    graph = graph_of(
        """
        E=====X
        .=.=.=.
        .===...
        .......
        """
    )
    assert graph.stall_types[1, 2] is StallType.TYPE_1  # four lanes around
    assert graph.stall_types[1, 4] is StallType.TYPE_1
    assert graph.stall_types[2, 4] is StallType.TYPE_3
    assert graph.stall_types[1, 0] is StallType.TYPE_3
    assert graph.stall_types[2, 5] is StallType.TYPE_3
    assert graph.stall_types[3, 6] is StallType.TYPE_4
    corner = graph_of("E==X\n.=..\n....")
    assert corner.stall_types[1, 2] is StallType.TYPE_2


def test_lengths_are_metres_between_centres():
    structure = Structure.from_arrays(cells_from_text("E=X", field="S"), [6.0, 8.0, 10.0], 5.0)
    graph = build_lane_graph(structure, BayConfig()).graph
    assert graph.edges[(0, 0), (0, 1)]["length_m"] == pytest.approx(7.0)
    assert graph.edges[(0, 1), (0, 2)]["length_m"] == pytest.approx(9.0)


@pytest.mark.parametrize(
    ("text", "cells"),
    [
        ("E=.=\n.=..\n...X", {(0, 2), (1, 0), (1, 2), (1, 3), (2, 1)}),  # the exit touches no lane
        ("E=X.\n....\n====", {(1, 0), (1, 2), (1, 3)}),  # a lane apart
        ("=E=\n...\n.X.", {(1, 0), (1, 2)}),  # lanes joined only through a portal
    ],
)
def test_unreachable_stalls_are_named_and_drawn(text, cells):
    with pytest.raises(UnreachableStallError) as caught:
        graph_of(text)
    assert cells <= set(caught.value.cells)
    drawn = caught.value.drawing.splitlines()
    assert all(drawn[row][col] == "?" for row, col in caught.value.cells)


def test_the_graph_is_frozen():
    graph = graph_of("E=X\n...").graph
    with pytest.raises(Exception, match="Frozen"):
        graph.add_node((9, 9))
