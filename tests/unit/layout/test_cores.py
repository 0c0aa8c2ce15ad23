import math

import numpy as np
import pytest
import shapely
from scipy import ndimage
from support.footprints import footprint

from garage2usd.config import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.layout.egress.cores import obstacle_cores
from garage2usd.layout.egress.exits import compartments_of
from garage2usd.planning import dimension
from garage2usd.profiles import load_profile
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

CN = load_profile("cn-jgj100")
LADDER = "\n".join(
    ["." * 14, "E" + "=" * 12 + "X", *(["." * 14, ".=..........=.", "." + "=" * 12 + "."] * 3), "." * 14]
).replace("." * 14 + "\n.=..........=.", ".=..........=.\n.=..........=.")


def laid_out(text=LADDER, **settings):
    config = GarageConfig(**settings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    structure = dimension(structure, bay=config.bay) if config.bay.dimensioned else structure
    return lay_out(structure, build_lane_graph(structure, config.bay), config), config


@pytest.fixture(scope="module")
def garage():
    return laid_out()


def ground(core):
    along, across = core.width_m / 2, core.depth_m / 2
    half = (along, across) if core.along_x else (across, along)
    (x, z) = core.centre_m
    return shapely.box(x - half[0], z - half[1], x + half[0], z + half[1])


def test_a_core_touches_no_column_wall_car_stall_light_or_other_core(garage):
    layout, _ = garage
    cores = [ground(core) for core in layout.cores]
    assert len(cores) >= 2
    others = [place for kind in ("column", "wall", "car", "no_parking_sign",
                                 "light", "speed_bump", "cone")
              for place in layout.of_kind(kind)]  # fmt: skip
    grounds = [footprint(place) for place in others]
    grounds += [shapely.Polygon(stall.corners_m()) for stall in layout.stalls]
    for core in cores:
        assert max(core.intersection(other).area for other in grounds) < 1e-6
    for index, core in enumerate(cores):
        assert all(core.disjoint(other) for other in cores[:index])


def test_the_stalls_in_whose_place_a_core_stands_are_gone_and_no_others(garage):
    layout, config = garage
    without, _ = laid_out(fittings={"stair_cores": False})
    gone = {stall.name for stall in without.stalls} - {stall.name for stall in layout.stalls}
    assert gone == {name for core in layout.cores for name in core.stalls}
    assert all(len(core.stalls) <= 2 for core in layout.cores)
    for core in layout.cores:
        near = [stall for stall in layout.stalls if stall.square == core.square and stall.edge is core.edge]
        car = config.standard.design_car_width.amount
        for stall in near:
            gap = shapely.Polygon(stall.corners_m()).distance(ground(core)) + (stall.width_m - car) / 2
            assert gap >= config.standard.wall_clearance.amount - 1e-6


def test_every_compartment_is_small_enough_hangs_together_and_has_its_exits(garage):
    layout, config = garage
    structure, numbers = layout.structure, layout.compartments
    assert ((numbers > 0) == (structure.cells != Cell.OBSTACLE)).all()
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / 1e6
    assert numbers.max() >= 2
    for number in range(1, numbers.max() + 1):
        assert areas[numbers == number].sum() <= config.standard.fire_compartment_area_sprinklered.amount
        assert ndimage.label(numbers == number)[1] == 1
        doors = [core.door_m for core in layout.cores if numbers[core.lane] == number]
        assert len(doors) >= config.standard.personnel_exits.amount
        for stall in layout.stalls:
            if numbers[stall.square] == number:
                nearest = min(math.dist(stall.centre_m, door) for door in doors)
                assert nearest <= config.standard.exit_distance_sprinklered.amount


def test_a_door_opens_onto_its_lane_over_a_crossing_and_a_landing(garage):
    layout, _ = garage
    floors = {place.square: place.spec for place in layout.of_kind("floor")}
    signs = {place.square for place in layout.of_kind("no_parking_sign")}
    for core in layout.cores:
        assert layout.structure.cells[core.lane] == Cell.LANE
        assert core.square in signs
        painted = {marking.surface.value for marking in floors[core.square].markings}
        assert "paint_yellow" in painted
        bars = [marking for marking in floors[core.lane].markings if marking.surface.value == "paint_white"]
        assert len(bars) >= 5
        step = (core.lane[1] - core.square[1], core.lane[0] - core.square[0])
        assert np.dot(np.subtract(core.door_m, core.centre_m), step) == pytest.approx(core.depth_m / 2)


def test_obstacles_beside_lanes_are_cores_with_their_door_on_a_lane():
    text = ".......\nE=====X\n..#....\n..=....\n.#.#...\n"
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, [5.3, 6.7, 7.8, 6.7, 5.3])
    (core,) = obstacle_cores(structure)
    assert (core.square, core.lane) == ((2, 2), (3, 2))
    layout, _ = laid_out("........\nE======X\n..#..#..\n........\n", bay={"dimensioned": False})
    doors = {place.name: place.yaw_rad for place in layout.of_kind("obstacle") if place.spec.has_door}
    assert doors == {"Obstacle_r02_c02": math.pi, "Obstacle_r02_c05": math.pi}  # towards -Z, where the lane is
    assert [core.stalls for core in layout.cores] == [(), ()]


def test_a_garage_of_few_stalls_keeps_them_all():
    layout, _ = laid_out("....\nE==X\n....")
    assert layout.cores == ()
    assert len(layout.stalls) == 12


@pytest.mark.parametrize("seed", range(20))
def test_any_floor_is_divided_into_compartments_that_are_small_enough(seed):
    rng = np.random.default_rng(seed)
    cells = np.where(rng.random((14, 17)) < 0.15, Cell.OBSTACLE, Cell.FREE).astype(np.int8)
    structure = Structure.from_arrays(cells, 8.1, 7.0)
    numbers = compartments_of(structure, CN.fire_compartment_area)
    for number in range(1, numbers.max() + 1):
        assert 0 < (numbers == number).sum() * 8.1 * 7.0 <= 2000
        assert ndimage.label(numbers == number)[1] == 1
    assert ((numbers == 0) == (cells == Cell.OBSTACLE)).all()
    assert (compartments_of(structure, None)[cells != Cell.OBSTACLE] == 1).all()
