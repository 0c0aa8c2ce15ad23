"""Cars over their lines and misparked ones: slots, grids and maps of them, judged by shapely and other programs."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
from pxr import Usd
from support.footprints import footprint
from support.glb_reader import Glb
from support.label_tables import labelled_objects
from support.lanelet2_judge import Lanelet2Judge
from support.map_judges import HAS_JUDGES, HAS_LANELET2, asam_issues
from support.map_reader import FREE, OCCUPIED, read_map
from support.misparked_garage import SETTINGS, homes_of, taken_in
from support.opendrive_judge import MapJudge
from support.openscenario_checker import issues_of

from garage2usd import GarageConfig, build, export
from garage2usd.config.vehicles import body_named
from garage2usd.driving import prove_stalls
from garage2usd.sensors.slots import read_slots

ROUNDED_M = 0.15
"""By how much the corners of a body are rounded, and what of its outline is as low as its bumpers."""
CELL_M = 0.05


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The garage in all formats."""
    folder = tmp_path_factory.mktemp("misparked")
    built = build(GarageConfig(**SETTINGS), folder / "garage.usdc")
    suffixes = ("xodr", "osm", "glb", "xosc", "yaml")
    export(built.stage, [folder / f"garage.{suffix}" for suffix in suffixes])
    layout = built.garage.layout
    assert len(layout.reaching) > len(layout.misparked) >= len(layout.blocked) > 0
    return built, folder, taken_in(layout)


def test_each_stall_that_is_not_blocked_is_driven_to_with_the_cars_as_they_stand(made):
    layout = made[0].garage.layout
    proven = {proof.stall for proof in prove_stalls(layout) if proof.is_proven}
    parking = {stall.name for stall in layout.stalls if stall.use.takes_cars}
    assert proven == parking - set(layout.blocked)


def test_slots_and_prims_of_stalls_are_taken_where_cars_stand_or_reach(made):
    built, _, taken = made
    stage = Usd.Stage.Open(str(built.stage))
    assert {slot.stall.name for slot in read_slots(stage).slots if slot.stall.is_occupied} == taken
    prims = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    said = {prim.GetAttribute("garage:stall:id").Get(): prim for prim in prims if prim.GetName().startswith("Stall_")}
    is_taken = {name: prim.GetAttribute("garage:stall:occupied").Get() for name, prim in said.items() if name}
    assert {name for name, occupied in is_taken.items() if occupied} == taken


@pytest.mark.soak
def test_cells_under_cars_are_occupied_and_those_beside_them_free(made):
    """By the outlines of the cars where they stand, also past a line; what else stands is known from the labels."""
    built, folder, _ = made
    layout = built.garage.layout
    read = read_map(folder / "garage.yaml")
    x, y = np.meshgrid(*read.middles())
    cells = shapely.points(x, -y)
    cars = [footprint(car) for car in layout.of_kind("car")]
    past = 0
    for car, home, ground in zip(layout.of_kind("car"), homes_of(layout), cars, strict=True):
        body = body_named(car.spec.body)
        solid = ground.buffer((body.width_m - body.overall_width_m) / 2, join_style="mitre").buffer(-ROUNDED_M)
        under = shapely.contains(solid, cells)
        assert (read.cells[under] == OCCUPIED).all(), car.name
        stall = next(stall for stall in layout.stalls if stall.name == home)
        past += (under & ~shapely.contains(shapely.Polygon(stall.corners_m()), cells)).sum()
    assert past > 100
    others = [
        shapely.box(thing["min_m"][0], thing["min_m"][2], thing["max_m"][0], thing["max_m"][2])
        for thing in labelled_objects(built.labels)
        if thing["class"] in {"wall", "column", "wheel_stop", "charger", "traffic_cone", "traffic_sign"}
    ]
    solid = shapely.union_all([*cars, *others]).buffer(2 * CELL_M)
    stalls = shapely.union_all([shapely.Polygon(s.corners_m()) for s in layout.stalls if s.use.takes_cars])
    beside = shapely.contains(stalls.buffer(-0.4).difference(solid), cells)
    assert beside.sum() > 1000
    assert (read.cells[beside] == FREE).all()


def test_files_of_maps_tell_taken_stalls(made):
    _, folder, taken = made
    tags = [
        {tag.get("k"): tag.get("v") for tag in way.iter("tag")} for way in ET.parse(folder / "garage.osm").iter("way")
    ]
    assert {said["name"] for said in tags if said.get("occupied") == "yes"} == taken
    spaces = [thing for thing in ET.parse(folder / "garage.xodr").iter("object") if thing.get("type") == "parkingSpace"]
    data = [
        (thing.get("name"), {one.get("code"): one.get("value") for one in thing.iter("userData")}) for thing in spaces
    ]
    assert {name for name, said in data if said["occupied"] == "true"} == taken


def test_extras_of_a_glb_tell_which_car_blocks_a_stall(made):
    built, folder, taken = made
    nodes = Glb((folder / "garage.glb").read_bytes()).nodes
    said = [node["extras"]["stall"] for node in nodes if "stall" in node.get("extras", {})]
    assert {stall["id"] for stall in said if stall["occupied"]} == taken
    assert {stall["id"]: stall["blocked_by"] for stall in said if "blocked_by" in stall} == built.garage.layout.blocked


def test_cars_of_a_scenario_stand_as_they_do(made):
    """OpenSCENARIO's x, y and heading of each car, by its own file and the layout."""
    built, folder, _ = made
    places = {}
    for private in ET.parse(folder / "garage.xosc").iter("Private"):
        place = private.find(".//WorldPosition")
        if private.get("entityRef").startswith("Car_"):
            places[private.get("entityRef")] = [float(place.get(name)) for name in ("x", "y", "h")]
    expected = {
        (round(car.position_m[0], 2), round(-car.position_m[2], 2)): car.yaw_rad + math.pi / 2
        for car in built.garage.layout.of_kind("car")
    }
    assert len(places) >= len(expected) - 1
    for x, y, heading in places.values():
        at = min(expected, key=lambda place: math.dist(place, (x, y)))
        assert math.dist(at, (x, y)) < 1.5  # the reference is the rear axle
        assert abs(math.remainder(heading - expected[at], math.tau)) < 1e-3


@pytest.mark.client
@pytest.mark.skipif(not HAS_LANELET2, reason="no environment with lanelet2")
def test_lanelet2_reads_which_stalls_are_taken(made, tmp_path):
    assert list(Lanelet2Judge(made[0].stage, made[1] / "garage.osm", tmp_path).complaints()) == []


@pytest.mark.client
@pytest.mark.soak
@pytest.mark.skipif(not HAS_JUDGES, reason="no environment with asam-qc-opendrive, CARLA and SUMO")
def test_asam_carla_and_sumo_have_nothing_against_it(made, tmp_path):
    judge = MapJudge(made[0].stage, made[1] / "garage.xodr", tmp_path)
    assert asam_issues(made[1] / "garage.xodr", tmp_path) == []
    assert issues_of(made[1] / "garage.xosc", tmp_path) == []
    for complaints in (judge.of_carla, judge.of_sumo, judge.of_objects):
        assert list(complaints()) == []
