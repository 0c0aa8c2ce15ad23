import itertools
import time

import numpy as np
import pytest
from support.soak import soak_but

from garage2usd.config import BayConfig, GarageConfig
from garage2usd.pipeline import generate
from garage2usd.planning import area_per_stall_m2, dimension
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.stalls import Edge, door_edges, square_capacity

BAY = BayConfig()
LADDER = """
.........
E=======X
.=.......
.=.......
.=======.
.=.....=.
"""


def structure(text, R=8.1, C=8.1):
    return Structure.from_arrays(cells_from_text(text, field="S"), R, C)


def test_area_per_stall_by_hand():
    plan = structure("E=X\n...", [5.4, 8.1, 5.4], [6.7, 5.3])
    assert square_capacity(plan, BAY).sum() == 3
    assert area_per_stall_m2(plan, BAY) == pytest.approx((5.4 + 8.1 + 5.4) * (6.7 + 5.3) / 3)
    assert area_per_stall_m2(structure("E=X\n###"), BAY) == float("inf")


def test_aisles_are_as_wide_as_asked_and_stalls_just_fit():
    sized = dimension(structure(LADDER), bay=BAY)
    depths = sized.row_depths_mm.tolist()
    assert depths[1] == depths[4] == 6700  # 6 m between columns of 0.6 m with a margin of 0.05 m on both sides
    assert {depths[0], depths[2], depths[3]} <= {5300, 5400}
    widths = sized.column_widths_mm.tolist()
    assert widths[1] == widths[7] == 6700
    assert set(widths[2:7]) <= {5400, 7800}
    assert area_per_stall_m2(sized, BAY) < 0.8 * area_per_stall_m2(structure(LADDER), BAY)
    assert (sized.cells == structure(LADDER).cells).all()


def test_no_single_line_can_be_chosen_better():
    sized = dimension(structure(LADDER), bay=BAY)
    best = area_per_stall_m2(sized, BAY)
    aisle_rows, aisle_columns = {1, 4}, {1, 7}
    for axis, sizes in enumerate((sized.row_depths_mm, sized.column_widths_mm)):
        for line in set(range(len(sizes))) - (aisle_rows, aisle_columns)[axis]:
            for size in (5300, 5400, 7800):
                changed = [sized.row_depths_mm.copy(), sized.column_widths_mm.copy()]
                changed[axis][line] = size
                other = Structure(sized.cells, changed[1], changed[0])
                assert area_per_stall_m2(other, BAY) >= best - 1e-9


def test_sizes_that_come_only_from_the_longest_stalls_are_found():
    plan = structure(".#===\n....=\n....=\n.....")
    rows = [(6700,), *[(5300, 5400, 7800)] * 3]
    columns = [*[(5300, 5400, 7800)] * 4, (6700,)]
    least = min(
        area_per_stall_m2(Structure.from_arrays(plan.cells, np.divide(widths, 1000), np.divide(depths, 1000)), BAY)
        for depths in itertools.product(*rows)
        for widths in itertools.product(*columns)
    )
    assert area_per_stall_m2(dimension(plan, bay=BAY), BAY) == pytest.approx(least)


def test_what_the_user_gives_is_kept():
    config = GarageConfig(site={"structure": LADDER}, bay={"dimensioned": True, "column_widths_m": 8.0})
    sized = generate(config).plan.structure
    assert set(sized.column_widths_mm.tolist()) == {8000}
    assert sized.row_depths_mm[1] == 6700


@pytest.mark.parametrize("seed", soak_but(3, range(12)))
def test_every_dimensioned_garage_keeps_its_aisles(seed):
    config = GarageConfig(
        seed=seed,
        site={"width_cells": 12, "height_cells": 10, "rectangles": seed % 4},
        bay={"dimensioned": True, "aisle_width_m": 5.5},
        plan={"episodes": 300},
    )
    garage = generate(config)
    cells = garage.plan.structure.cells
    clear = 2 * config.bay.carriageway_setback_m
    lane = cells == Cell.LANE
    doors = door_edges(cells)
    door_rows = {row for (row, _), edge in doors.items() if edge in {Edge.LEFT, Edge.RIGHT}}
    door_cols = {col for (_, col), edge in doors.items() if edge in {Edge.UP, Edge.DOWN}}
    for row, col in np.argwhere(lane).tolist():
        # an aisle in line with a vehicle door is wider: 5 m are clear in the door, its frame and jambs stand beside
        if (col > 0 and lane[row, col - 1]) or (col + 1 < cells.shape[1] and lane[row, col + 1]):
            expected = 5.66 if row in door_rows else 5.5
            assert garage.plan.structure.C[row, col] - clear == pytest.approx(expected)
        if (row > 0 and lane[row - 1, col]) or (row + 1 < cells.shape[0] and lane[row + 1, col]):
            expected = 5.66 if col in door_cols else 5.5
            assert garage.plan.structure.R[row, col] - clear == pytest.approx(expected)
    assert 0 < len(garage.layout.stalls) <= garage.plan.score.stalls  # stair cores stand on some


def test_the_line_of_a_door_is_wide_enough_for_it():
    plan = structure(".=E..\n.=...\n.=X..")  # beside their lane, so that their column is no aisle
    assert dimension(plan, bay=BAY).column_widths_mm[2] == 5000 + 2 * 680
    assert dimension(plan, bay=BayConfig(portal_width_m=3.0)).column_widths_mm[2] == 5300


@pytest.mark.parametrize(("shape", "seconds"), [((20, 30), 0.1), ((100, 100), 1.0)])
def test_many_plans_can_be_dimensioned(shape, seconds):
    cells = np.zeros(shape, dtype=np.int8)
    cells[1::3] = cells[:, 1] = cells[:, -2] = Cell.LANE
    cells[0, 1], cells[0, -2] = Cell.ENTRANCE, Cell.EXIT
    plan = Structure.from_arrays(cells, 8.1, 8.1)
    start = time.process_time()
    sized = dimension(plan, bay=BAY)
    assert time.process_time() - start < seconds
    assert area_per_stall_m2(sized, BAY) < area_per_stall_m2(plan, BAY)
