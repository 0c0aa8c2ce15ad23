"""Circulation in metres, against squares of one size and a walk over a graph."""

from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from numpy.random import default_rng

from garage2usd.config import BayConfig
from garage2usd.planning import measured_circulation, neither_share
from garage2usd.structure.grid import Cell, Structure, cells_from_text

SIDE_M = 8.1


def structure_of(drawing, widths=SIDE_M, depths=SIDE_M):
    return Structure.from_arrays(cells_from_text(drawing, field="S"), widths, depths)


def random_structures(count):
    random = default_rng(11)
    for _ in range(count):
        shape = tuple(random.integers(3, 11, 2))
        cells = np.where(random.random(shape) < random.uniform(0.3, 0.75), Cell.LANE, Cell.FREE)
        cells[0, random.integers(shape[1])] = Cell.ENTRANCE
        cells[-1, random.integers(shape[1])] = Cell.EXIT
        sides = [random.integers(40, 90, size) / 10 for size in reversed(shape)]
        yield Structure.from_arrays(cells, SIDE_M, SIDE_M), Structure.from_arrays(cells, *sides)


def graph_of(structure):
    """Lanes and portals; an edge is as long as the halves of its two squares."""
    x = (structure.column_edges_m[1:] + structure.column_edges_m[:-1]) / 2
    z = (structure.row_edges_m[1:] + structure.row_edges_m[:-1]) / 2
    nodes = {(int(row), int(col)) for row, col in np.argwhere(structure.cells >= Cell.LANE)}
    graph = nx.Graph()
    graph.add_nodes_from(nodes)
    for row, col in nodes:
        for other in ((row + 1, col), (row, col + 1)):
            if other in nodes:
                graph.add_edge((row, col), other, length=abs(z[other[0]] - z[row]) + abs(x[other[1]] - x[col]))
    return graph


def test_squares_of_one_size_are_as_long_as_they_are_many():
    seen = 0
    for structure, _ in random_structures(300):
        found = measured_circulation(structure)
        for run in (*found.dead_ends, *found.stretches):
            assert run.length_m == pytest.approx(SIDE_M * run.length_squares)
        assert max((run.length_squares for run in found.dead_ends), default=0) == found.circulation.dead_end_squares
        longest = found.circulation.longest_stretch_squares
        assert max((run.length_squares for run in found.stretches), default=0) == longest
        assert found.dead_end_m == pytest.approx(SIDE_M * found.circulation.dead_end_squares)
        assert found.stretch_m == pytest.approx(SIDE_M * longest)
        seen += bool(found.dead_ends) and bool(found.stretches)
    assert seen > 50


def test_dead_ends_are_the_trees_that_hang_on_what_stays():
    """Their lanes are those that no simple path between what stays runs through; their depth is their longest path."""
    branched = 0
    for _, structure in random_structures(300):
        found = measured_circulation(structure)
        pruned = {(int(row), int(col)) for row, col in np.argwhere(found.circulation.rounds > 0)}
        assert sorted(square for run in found.dead_ends for square in run.squares) == sorted(pruned)
        graph = graph_of(structure)
        for run in found.dead_ends:
            tree = graph.subgraph(run.squares)
            assert nx.is_tree(tree)
            hangs_on = {other for square in run.squares for other in graph[square]} - set(run.squares) - pruned
            assert len(hangs_on) <= 1
            if not hangs_on:
                continue  # lanes that no car gets to
            (anchor,) = hangs_on
            whole = graph.subgraph({*run.squares, anchor})
            steps = nx.single_source_shortest_path_length(whole, anchor)
            assert run.length_squares == max(steps.values())
            # each lane counts by its side along the step towards the anchor
            path = nx.shortest_path(whole, run.squares[0], anchor)
            sides = [
                structure.column_widths_mm[col] if row == ahead[0] else structure.row_depths_mm[row]
                for (row, col), ahead in pairwise(path)
            ]
            assert run.length_m == pytest.approx(sum(sides) / 1000)
            branched += len(run.squares) > run.length_squares
    assert branched > 20


@pytest.mark.parametrize(
    ("drawing", "widths", "depths", "length_m"),
    [
        ("E==X", [5, 6, 7, 5], 8, 13),
        ("E==#\n##=#\n##=X", [5, 6, 7, 5], [8, 9, 10], 6 + (7 + 8) / 2 + 9 + (10 + 7) / 2),
    ],
)
def test_a_bend_is_as_long_as_the_halves_of_its_sides(drawing, widths, depths, length_m):
    found = measured_circulation(structure_of(drawing, widths, depths))
    assert found.stretch_m == pytest.approx(length_m)
    assert not found.dead_ends


def test_floor_that_is_neither_lane_nor_stall():
    drawing = "....\nE==X\n...."
    bay = BayConfig()
    floor = 12 * SIDE_M**2
    stalls = 12 * bay.stall_width_m * bay.stall_length_m
    assert neither_share(structure_of(drawing), bay) == pytest.approx(1 - (4 * SIDE_M**2 + stalls) / floor)
    assert neither_share(structure_of("E==X"), bay) == 0
