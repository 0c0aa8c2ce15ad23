import dataclasses
import itertools
import math

import numpy as np
import pytest
import shapely

from garage2usd.config import BayConfig
from garage2usd.garage import StallKind
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.stall_runs import StallRun, capacity_of_runs, rows_of_runs, runs_of_rows, turn_of
from garage2usd.structure.stalls import Edge, StallRow, StallShape, stall_rows

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
        if angle_deg in {0.0, 90.0}:
            assert all(outline.intersection(column).area < 1e-5 for column in standing)
        assert outline.difference(inside.buffer(2e-3)).area < 1e-6
    if shape.depth_m > sides_m[1]:
        assert not found


def clear_ground(outline, shape, lean, sign):
    """What columns leave clear for a car in an angled stall: its rectangle, 0.25 m before it, half of the mouth.

    The car stands between the sides of the outline, on a rectangle that touches the mouth's line in one corner.
    """
    (left, mouth), (right, _), _, _, _ = outline.exterior.coords
    near, far = (right, left) if lean > 0 else (left, right)
    angle = math.radians(shape.angle_deg)
    inwards = np.array([lean * math.cos(angle), sign * math.sin(angle)])
    across = np.array([-lean * math.sin(angle), sign * math.cos(angle)])
    corner = np.array([near, mouth])
    spots = [corner + s * inwards + w * across for s in (-0.25, shape.length_m) for w in (0, shape.width_m)]
    return shapely.MultiPoint([*spots, (near + 0.5 * (far - near), mouth)]).convex_hull


@pytest.mark.parametrize("lean", [1, -1])
@pytest.mark.parametrize("angle_deg", ANGLES_DEG)
@pytest.mark.parametrize("sides_m", [(8.1, 8.1), (7.86, 6.1), (5.55, 6.0), (11.1, 5.8)])
def test_a_run_has_no_fewer_angled_stalls_than_a_search_by_geos_finds(sides_m, angle_deg, lean):
    """The search takes the first of places 1 cm apart at which neither a column nor the stall before is in the way."""
    structure, shape = structure_of(*sides_m), StallShape(2.4, 5.3, angle_deg)
    (run,) = (run for run in shaped(structure, shape, lean) if run.edge is Edge.UP and run.first[0] == 2)
    rows = rows_of_runs(structure, BAY, [run])
    found = sum(row.count for row in rows)
    standing, half_m = shapely.STRtree(list(columns(structure))), sides_m[0] / 2
    for row in rows:
        for outline in outlines(structure, row):
            ground = clear_ground(outline, shape, lean, 1)
            touched = standing.query(ground, predicate="intersects")
            assert shapely.area(shapely.intersection(standing.geometries[touched], ground)).sum() < 1e-4
    if shape.depth_m > sides_m[1]:
        assert not found
        return
    lean_m = lean * shape.depth_m / math.tan(math.radians(angle_deg))
    first_m, end_m = sides_m[0], 6 * sides_m[0]
    least_m, most_m = first_m + GAP_M - min(0, lean_m), end_m - GAP_M - shape.pitch_m - max(0, lean_m)
    searched, place_m = 0, least_m
    while place_m <= most_m + 1e-9:
        row = StallRow(2, 1, Edge.UP, shape, (place_m - first_m - half_m,), lean)
        (outline,) = outlines(structure, row)
        is_free = not len(standing.query(clear_ground(outline, shape, lean, 1), predicate="overlaps"))
        searched, place_m = searched + is_free, place_m + (shape.pitch_m if is_free else 0.01)
    assert searched <= found


@pytest.mark.parametrize(("angle_deg", "side_m", "stalls"), [(75.0, 8.1, 3), (60.0, 5.55, 2), (45.0, 6.8, 2)])
def test_columns_in_the_triangles_of_angled_stalls_cost_no_stall(angle_deg, side_m, stalls):
    capacity = capacity_of_runs(
        structure_of(side_m, 8.1), BAY, shaped(structure_of(side_m, 8.1), StallShape(2.4, 5.3, angle_deg))
    )
    assert capacity[2, 2:5].tolist() == [stalls] * 3


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
