"""Chargers, hydrant cabinets and signs at cores: how they stand, hang and keep clear."""

import numpy as np
import pytest
import shapely
from support.footprints import footprint
from support.overlaps import Solids
from support.sight import triangles, world
from support.small_survey import surveyed

from garage2usd.config import GarageConfig
from garage2usd.garage import StallUse
from garage2usd.layout import lay_out
from garage2usd.objects.charger import ChargerSpec
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

CORES = """
..........
E========X
.#=....#=.
.========.
.=......=.
"""

DEFAULT = """
.=..=..=.
.=..=..=.
.=======E
.=..=..=.
.=..=..=.
.=..=..=.
.====.X=.
"""
"""The lanes of the default garage of seed 7: a row lies between a lane and the exit."""


def laid_out(text=CORES, **settings):
    config = GarageConfig(**settings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


@pytest.fixture(scope="module")
def charging():
    return laid_out(parking={"ev_share": 0.5, "occupancy": 1.0})


def parts(spec):
    return {part.name: part.points.astype(float) for part in spec.asset().parts}


def test_a_charger_has_a_cable_from_its_body_to_a_connector():
    own = parts(ChargerSpec())
    (x0, y0, z0), (x1, y1, z1) = (end(own["Connector"], axis=0) for end in (np.min, np.max))
    cable = own["Cable"]
    at_plug = (cable >= (x0, y0, z0)).all(axis=1) & (cable <= (x1, y1, z1)).all(axis=1)
    assert at_plug.any()
    front = own["Body"][:, 2].max()
    assert np.abs(cable[:, 2] - front).min() < 1e-3
    assert np.ptp(cable[:, 1]) > 0.4  # it hangs in a loop
    assert cable[:, 1].min() > 0.15
    assert y0 > 0.7


def test_a_car_meets_the_guard_before_the_charger():
    """At the heights of bumpers, over the whole width of the post."""
    own = parts(ChargerSpec())
    guard, others = own["Guard"], np.concatenate([points for name, points in own.items() if name != "Guard"])
    low = others[others[:, 1] < 0.7]
    assert guard[:, 2].max() > low[:, 2].max() + 0.05
    assert (guard[:, 0].min(), guard[:, 0].max()) == (
        pytest.approx(-guard[:, 0].max()),
        pytest.approx(guard[:, 0].max()),
    )
    assert guard[:, 0].max() > np.abs(low[:, 0]).max() + 0.05
    assert guard[:, 1].min() == 0
    assert guard[:, 1].max() > 0.6


def assert_cars_keep_off_guards(layout):
    posts = layout.of_kind("charger")
    cars = [footprint(car) for car in layout.of_kind("car")]
    tree = shapely.STRtree(cars)
    stalls = {stall.name: shapely.Polygon(stall.corners_m()) for stall in layout.stalls}
    for post in posts:
        ground = shapely.MultiPoint(triangles(post).reshape(-1, 3)[:, [0, 2]]).convex_hull
        assert not len(tree.query(ground.buffer(0.015), predicate="intersects")), post.name
        assert ground.within(stalls[post.stall].buffer(1e-6))
    return len(posts)


def test_no_parked_car_touches_the_guard_of_a_charger(charging):
    assert assert_cars_keep_off_guards(charging) > 5
    taken = {car.stall for car in charging.of_kind("car")}
    electric = {stall.name for stall in charging.stalls if stall.use is StallUse.EV}
    assert len(electric & taken) > 0.8 * len(electric)


def test_nor_does_a_car_of_an_import(tmp_path):
    assert assert_cars_keep_off_guards(surveyed(tmp_path, parking={"occupancy": 1.0})) == 11


def test_chargers_beside_parallel_stalls_touch_nothing():
    layout = laid_out(stalls={"kinds": {"parallel": 1}}, parking={"ev_share": 0.5, "occupancy": 1.0})
    assert layout.of_kind("charger")
    assert not [names for names in Solids(layout).clashes() if "charger" in {each.kind for each in names}]


@pytest.mark.parametrize("share", [0.08, 0.3])
def test_stalls_beside_the_ways_in_and_out_have_chargers_last(share):
    layout = laid_out(DEFAULT, parking={"ev_share": share}, fittings={"stair_cores": False})
    cells = layout.structure.cells
    portals = [tuple(square) for square in np.argwhere(cells >= Cell.ENTRANCE).tolist()]
    ways = set(portals)
    for row, col in portals:
        around = ((row - 1, col), (row + 1, col), (row, col - 1), (row, col + 1))
        ways |= {
            (r, c) for r, c in around if 0 <= r < len(cells) and 0 <= c < len(cells[0]) and cells[r, c] == Cell.LANE
        }
    electric = [stall for stall in layout.stalls if stall.use is StallUse.EV]
    assert len(electric) == round(share * len(layout.stalls))
    for stall in electric:
        (row, col), (lane_row, lane_col) = stall.square, stall.access_square
        behind = 2 * row - lane_row, 2 * col - lane_col
        assert not {stall.access_square, behind} & ways, stall.name


def test_where_all_stalls_have_chargers_those_beside_the_ways_have_too():
    layout = laid_out(parking={"ev_share": 1.0})
    assert not [stall for stall in layout.stalls if stall.use is StallUse.STANDARD]


def test_a_hydrant_cabinet_hangs_on_the_wall_and_on_no_post():
    own = parts(HydrantCabinetSpec())
    foot = own["Sides"][:, 1].min()
    below = np.concatenate(list(own.values()))
    below = below[below[:, 1] < foot - 1e-6]
    assert below[:, 1].min() > 0.5
    # what is below it comes out of the wall: brackets far apart, and the supply pipe
    brackets = own["Brackets"]
    assert np.ptp(brackets[:, 0]) > 0.25
    assert brackets[:, 2].min() == 0
    assert brackets[:, 1].max() == pytest.approx(foot)
    assert brackets[:, 2].max() > 0.7 * own["Sides"][:, 2].max()
    assert own["Pipe"][:, 2].min() == pytest.approx(0, abs=1e-6)
    assert own["Pipe"][:, 1].max() >= foot - 1e-6


def assert_signs_clear_cores(layouts):
    """Boxes and outlines of signs and of stair cores do not overlap."""
    found = 0
    for layout in layouts:
        cores = [place for place in layout.of_kind("obstacle") if place.spec.has_door]
        boxes = [shapely.box(*shapely.MultiPoint(triangles(core).reshape(-1, 3)[:, [0, 2]]).bounds) for core in cores]
        outlines = [shapely.Polygon(outline) for core in cores for outline in core.outlines()]
        for sign in layout.of_kind("no_parking_sign"):
            points = np.concatenate([world(sign, part.points) for part in sign.spec.asset().parts])
            ground = shapely.box(*shapely.MultiPoint(points[:, [0, 2]]).bounds)
            assert not any(ground.intersects(box) for box in boxes), sign.name
            own = [shapely.Polygon(outline) for outline in sign.outlines()]
            assert not any(one.intersects(other) for one in own for other in outlines), sign.name
            found += min((ground.distance(box) for box in boxes), default=9.0) < 0.5
    return found


def test_signs_before_cores_stand_clear_of_them():
    text = CORES.replace("#", ".")
    assert assert_signs_clear_cores([laid_out(text, fittings={"stair_cores": True})]) > 0
