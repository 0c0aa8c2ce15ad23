import dataclasses
import itertools
import math

import pytest
import shapely

from garage2usd.config import BayConfig
from garage2usd.garage import StallKind
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.stall_runs import StallRun, capacity_of_runs, rows_of_runs, runs_of_rows, turn_of
from garage2usd.structure.stalls import Edge, StallShape, stall_rows

BAY = BayConfig(square_side_m=8.1)
GAP_M = BAY.row_ends_m / 2
HALF_COLUMN_M = BAY.column_size_m / 2
ANGLES_DEG = (30.0, 45.0, 60.0, 75.0, 85.0)
AISLE = """
.......
E=====X
.......
.......
"""


def structure_of(width_m, depth_m):
    return Structure.from_arrays(cells_from_text(AISLE, field="S"), width_m, depth_m)


def shaped(structure, shape, lean=1):
    runs = runs_of_rows(stall_rows(structure, BAY))
    return [dataclasses.replace(run, shape=shape, lean=lean) for run in runs]


def outlines(structure, row):
    """Each stall of a row as a polygon (x, z), from the definition of its shape and its start alone."""
    x, z = structure.column_edges_m, structure.row_edges_m
    middle = (x[row.col] + x[row.col + 1]) / 2
    angle = math.radians(row.shape.angle_deg)
    for start in row.starts_m:
        if row.shape.kind is StallKind.ANGLED:
            pitch = row.shape.width_m / math.sin(angle)
            depth = row.shape.length_m * math.sin(angle) + row.shape.width_m * math.cos(angle)
            lean = row.lean * depth / math.tan(angle)
        else:
            across = row.shape.kind is StallKind.PERPENDICULAR
            pitch, depth = (row.shape.width_m, row.shape.length_m)[:: 1 if across else -1]
            lean = 0.0
        mouth, sign = (z[row.row], 1) if row.edge is Edge.UP else (z[row.row + 1], -1)
        left = middle + start
        corners = [(left, 0), (left + pitch, 0), (left + pitch + lean, depth), (left + lean, depth)]
        yield shapely.Polygon([(px, mouth + sign * inside) for px, inside in corners])


def columns(structure):
    x, z = structure.column_edges_m, structure.row_edges_m
    cells = structure.cells
    for row, col in itertools.product(range(1, cells.shape[0]), range(1, cells.shape[1])):
        if (cells[row - 1 : row + 1, col - 1 : col + 1] == Cell.FREE).any():
            yield shapely.box(
                x[col] - HALF_COLUMN_M, z[row] - HALF_COLUMN_M, x[col] + HALF_COLUMN_M, z[row] + HALF_COLUMN_M
            )


@pytest.mark.parametrize("lean", [1, -1])
@pytest.mark.parametrize("angle_deg", [0.0, *ANGLES_DEG, 90.0])
@pytest.mark.parametrize("sides_m", [(8.1, 8.1), (6.3, 6.2), (9.09, 6.1), (11.1, 5.8), (7.77, 5.5)])
def test_no_stall_of_a_run_touches_another_or_a_column_or_leaves_the_run(sides_m, angle_deg, lean):
    structure = structure_of(*sides_m)
    shape = StallShape(2.4, 6.0 if angle_deg == 0 else 5.3, angle_deg)
    rows = rows_of_runs(structure, BAY, shaped(structure, shape, lean))
    found = [outline for row in rows for outline in outlines(structure, row)]
    standing = list(columns(structure))
    inside = shapely.box(sides_m[0] + GAP_M, 0, 6 * sides_m[0] - GAP_M, 4 * sides_m[1])
    for number, outline in enumerate(found):
        assert all(outline.intersection(other).area < 1e-2 for other in found[number + 1 :])
        assert all(outline.intersection(column).area < 1e-5 for column in standing)
        assert outline.difference(inside.buffer(2e-3)).area < 1e-6
    if shape.depth_m > sides_m[1]:
        assert not found


@pytest.mark.parametrize("angle_deg", ANGLES_DEG)
def test_a_run_has_as_many_angled_stalls_as_fit_between_the_columns(angle_deg):
    # along an endless row, what the columns leave of a square over the pitch; at the end the lean is lost once
    structure = structure_of(11.1, 8.1)
    shape = StallShape(2.4, 5.3, angle_deg)
    cot = 1 / math.tan(math.radians(angle_deg))
    fits = math.floor((11.1 - 2 * GAP_M - HALF_COLUMN_M * cot) / shape.pitch_m + 1e-9)
    capacity = capacity_of_runs(structure, BAY, shaped(structure, shape))
    assert capacity[2, 2:5].tolist() == [fits] * 3
    end = math.floor((11.1 - 2 * GAP_M - shape.depth_m * cot) / shape.pitch_m + 1e-9)
    assert capacity[2, 5] == max(end, 0)


def test_perpendicular_runs_are_the_rows_of_the_squares():
    structure = structure_of(8.1, 8.1)
    rows = stall_rows(structure, BAY)
    again = rows_of_runs(structure, BAY, runs_of_rows(rows))
    assert [(row.square, row.edge, row.count) for row in again] == [(row.square, row.edge, row.count) for row in rows]
    for one, other in zip(rows, again, strict=True):
        assert one.starts_m == pytest.approx(other.starts_m, abs=1e-9)


def test_two_rows_back_to_back_share_the_depth_of_their_squares():
    cells = cells_from_text("E==\n...\n==X", field="S")
    deep, shallow = (Structure.from_arrays(cells, 8.1, depth_m) for depth_m in (10.6, 10.5))
    runs = [StallRun((1, 0), (1, 2), edge, StallShape(2.4, 5.3)) for edge in (Edge.UP, Edge.DOWN)]
    assert capacity_of_runs(deep, BAY, runs)[1].tolist() == [3, 6, 3]
    assert not capacity_of_runs(shallow, BAY, runs).any()


@pytest.mark.parametrize("edge", Edge)
def test_stalls_that_lean_with_traffic_are_entered_by_a_turn_to_the_right(edge):
    """Traffic on the near side of a two-way lane keeps its right side to the stalls, seen from above."""
    outwards = {Edge.UP: (0, -1), Edge.DOWN: (0, 1), Edge.LEFT: (-1, 0), Edge.RIGHT: (1, 0)}[edge]
    # X to the right and Z down: who drives along (x, z) has (-z, x) on the right, which is where the stalls are
    driven = (-outwards[1], outwards[0])
    assert (-driven[1], driven[0]) == (-outwards[0], -outwards[1])
    along = driven[0] if edge.along_x else driven[1]
    rows = rows_of_runs(
        Structure.from_arrays([[0, 1], [1, 0]], 20.0, 20.0),
        BAY,
        [StallRun((0, 0), (0, 0), edge, StallShape(2.4, 5.3, 60.0), along)],
    )
    assert all(turn_of(row) == 1 for row in rows)
    assert bool(rows) == (edge in {Edge.DOWN, Edge.RIGHT})
