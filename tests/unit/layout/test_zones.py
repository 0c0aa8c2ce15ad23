import numpy as np
import pytest
import shapely
from scipy.spatial.distance import cdist
from support.sample_files import each_sample

from garage2usd.config import GarageConfig
from garage2usd.config.site import SiteConfig
from garage2usd.garage import StallKind
from garage2usd.layout import lay_out
from garage2usd.layout.parking.zones import Zones
from garage2usd.objects import MOUNTED
from garage2usd.objects.zone_plate import ZONE_PLATE_HEIGHT_M
from garage2usd.pipeline import generate
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


GARAGES = [
    {"width_cells": 5 + seed % 9, "height_cells": 4 + seed % 6, "rectangles": 1 + seed % 3, "obstacles": seed % 2}
    for seed in range(12)
]


@each_sample
def test_plates_of_the_samples_show_the_zones_of_the_stalls(sample, builds):
    assert_plates_show_the_zones_before_them(builds(sample, "usdc").garage.layout)


@pytest.mark.parametrize("seed", range(len(GARAGES)))
def test_plates_of_any_garage_show_the_zones_of_the_stalls(seed):
    site = SiteConfig(min_portal_distance_cells=2, **GARAGES[seed])
    assert_plates_show_the_zones_before_them(generate(GarageConfig(seed=seed, site=site)).layout)


def test_sides_around_the_border_of_two_zones_show_one_each_and_that_on_it_none():
    layout = laid_out()
    # between the squares (0, 3) and (0, 4), both of which hold stalls
    column = next(place for place in layout.of_kind("zone_plate") if place.name == "ZonePlates_r01_c04")
    x, _, z = column.position_m
    shown = {(round(at_x - x, 3), round(at_z - z, 3)): zone for zone, (at_x, at_z), _ in plates_of(column)}
    assert (shown[-0.3, 0.0], shown[0.3, 0.0]) == ("A1", "B1")
    assert (0.0, -0.3) not in shown


def plates_of(placement):
    """(zone, middle, way that it looks) of each plate of an object; (x, z) in the garage."""
    for plate in placement.spec.plates():
        yaw = placement.yaw_rad + plate.yaw_rad
        yield plate.text, placement.to_world(plate.middle), np.array([np.sin(yaw), np.cos(yaw)])


def test_what_hangs_on_a_column_covers_no_plate():
    layout = laid_out()
    foot = min(plate.position_m[1] for plate in layout.of_kind("zone_plate"))
    assert all(part.points[:, 1].max() < foot for mounted in MOUNTED for part in mounted.spec.asset().parts)
    assert foot + ZONE_PLATE_HEIGHT_M < GarageConfig().fittings.clear_height_m


def assert_plates_show_the_zones_before_them(layout):
    """The stall nearest before a plate is of its zone, the plate nearest to a stall too, and each zone has one."""
    stalls = [stall for stall in layout.stalls if stall.number]
    zones = np.array([stall.number.split("-")[0] for stall in stalls])
    plates = [plate for placement in layout.of_kind("zone_plate") for plate in plates_of(placement)]
    assert {text for text, _, _ in plates} == {*zones.tolist()}
    middles = np.array([stall.centre_m for stall in stalls])
    grounds = np.array([shapely.Polygon(stall.corners_m()) for stall in stalls])
    for text, place, ahead in plates:
        before = np.flatnonzero((middles - place) @ ahead > 0)
        distances = shapely.distance(shapely.Point(place), grounds[before])
        # of stalls that are as near as each other, one at least
        nearest = before[distances < distances.min() + 1e-3]
        assert text in zones[nearest], place
    # to the mouth of angled stalls, which lean away from the plates of their row
    quads = {stall.name: stall for stall in layout.quads}
    at = [quads[stall.name].mouth if stall.stall_kind is StallKind.ANGLED else stall.centre_m for stall in stalls]
    nearest = cdist(at, [place for _, place, _ in plates]).argmin(axis=1)
    assert [plates[plate][0] for plate in nearest.tolist()] == zones.tolist()
