import numpy as np
import pytest

from garage2usd.config import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.layout.zones import Zones
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

PLAN = """
.........
E=======X
.=.....=.
.=======.
.=.....=.
"""


def laid_out(**fittings):
    config = GarageConfig(fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(PLAN, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def structure_of(rows, columns):
    return Structure.from_arrays(np.zeros((rows, columns), dtype=np.int8), 8.1, 8.1)


def test_zones_are_blocks_of_squares_with_letters_along_columns_and_numbers_along_rows():
    zones = Zones(structure_of(9, 9))
    assert [str(zones.of((0, column))) for column in range(9)] == ["A1"] * 4 + ["B1"] * 4 + ["C1"]
    assert [str(zones.of((row, 0))) for row in range(9)] == ["A1"] * 4 + ["A2"] * 4 + ["A3"]


@pytest.mark.parametrize(("rows", "columns"), [(1000, 3), (3, 1000), (400, 400)])
def test_letters_and_numbers_suffice_for_any_garage(rows, columns):
    zones = Zones(structure_of(rows, columns))
    last = zones.of((rows - 1, columns - 1))
    assert last.number <= 99
    assert last.letter.isalpha()
    assert "IO".find(last.letter) < 0


def test_stalls_count_from_one_in_each_zone():
    layout = laid_out()
    zones = Zones(layout.structure)
    by_zone = {}
    for stall in layout.stalls:
        assert bool(stall.number) == stall.use.takes_cars
        if not stall.number:
            continue
        zone, number = stall.number.split("-")
        assert zone == str(zones.of(stall.square))
        by_zone.setdefault(zone, []).append(int(number))
    assert len(by_zone) > 2
    assert all(numbers == list(range(1, len(numbers) + 1)) for numbers in by_zone.values())


def test_without_zones_stalls_count_through_the_garage_and_columns_are_bare():
    layout = laid_out(zones=False)
    numbers = [stall.number for stall in layout.stalls if stall.use.takes_cars]
    assert numbers == [f"{n:03d}" for n in range(1, len(numbers) + 1)]
    assert not layout.of_kind("zone_plate")


def test_each_column_shows_the_zone_of_a_square_beside_it():
    layout = laid_out()
    zones, edges = Zones(layout.structure), (layout.structure.row_edges_m, layout.structure.column_edges_m)
    shown = {}
    for plate in sorted(layout.of_kind("zone_plate"), key=lambda plate: -plate.position_m[1]):
        x, _, z = plate.position_m
        shown[x, z] = shown.get((x, z), "") + plate.spec.text
    feet = {(place.position_m[0], place.position_m[2]) for place in layout.of_kind("column")}
    assert set(shown) == feet
    for (x, z), text in shown.items():
        beside = {
            str(zones.of((int(np.searchsorted(edges[0], z + dz)) - 1, int(np.searchsorted(edges[1], x + dx)) - 1)))
            for dz in (-1, 1)
            for dx in (-1, 1)
        }
        assert text in beside
