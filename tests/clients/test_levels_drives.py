"""Scenarios through a garage of several levels, against the stage's meshes, by esmini and by ASAM's checker."""

import math

import numpy as np
import pytest
import shapely
from support.esmini_player import ESMINI, played
from support.label_tables import labelled_objects
from support.level_judge import LevelJudge
from support.openscenario_checker import issues_of, needs_checker
from support.openscenario_reader import OpenScenario
from support.small_levels import FLOORS_M, SMALL_LEVELS

import garage2usd
from garage2usd.as_built.levels import built_levels
from garage2usd.common.errors import ConfigError
from garage2usd.config.maps import Leg
from garage2usd.maps.level_drives import LevelsDrivePlanner
from garage2usd.maps.openscenario import EGO
from garage2usd.reading.files import open_stage

pytestmark = pytest.mark.client
WHEELBASE_M, AHEAD_M, BEHIND_M, WIDTH_M = 2.7, 3.6, 1.2, 1.8
MILLIMETRE = 1e-3
FRONT_M = 2.5e-3
"""Where a slope changes by 7.5 %, the pitch is that of a place 3 cm ahead of the front axle."""
GROOVE_M, GROOVES = 8e-3, 0.2
"""Depth of a groove for grip across a ramp, and the greatest share of a ramp that is grooves."""
LOWEST_M, RAMP_M = FLOORS_M["U2"], 40.0


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build_levels(SMALL_LEVELS, tmp_path_factory.mktemp("levels") / "garage.usdc")


@pytest.fixture(scope="module")
def judge(built):
    return LevelJudge(built.stage)


@pytest.fixture(scope="module")
def ground(judge):
    return judge.ground()


@pytest.fixture(scope="module")
def scenario(built):
    return garage2usd.export(built.stage, [built.stage.with_suffix(".xosc")])[0]


def assert_on_the_ground(ground, places, within_m=MILLIMETRE):
    """All places, (x, y, z) with Y up, lie close to a floor, to a ramp, or to a ramp over a groove."""
    heights, _ = ground.nearest(places)
    off = np.abs(heights - places[:, 1])
    is_sloped = (np.abs(places[:, 1, None] - [*FLOORS_M.values()]) > MILLIMETRE).all(axis=1)
    assert off[~is_sloped].max() < within_m
    # nothing lies under a place just over the upright side of a groove, but for another level
    over_groove = is_sloped & ~(off < within_m)
    is_beside = np.isnan(off) | (off > 1.0)
    assert off[over_groove & ~is_beside].max() < GROOVE_M + within_m
    assert over_groove.sum() < GROOVES * is_sloped.sum()
    assert is_beside.sum() < 0.05 * is_sloped.sum()
    return is_sloped.sum()


def axles(track):
    """Where the middles of the rear and of the front axle of each vertex stand, (x, y, z) with Y up."""
    _, x, y, z, heading, pitch, _ = np.asarray(track).T
    far = WHEELBASE_M * np.cos(pitch)
    front = x + far * np.cos(heading), z - WHEELBASE_M * np.sin(pitch), -(y + far * np.sin(heading))
    return np.stack([x, z, -y], axis=1), np.stack(front, axis=1)


def outline(x, y, heading):
    """The ground of the car, in the frame of maps."""
    along = np.array([math.cos(heading), math.sin(heading)])
    across = np.array([-along[1], along[0]])
    ends = ((AHEAD_M, 1), (AHEAD_M, -1), (-BEHIND_M, -1), (-BEHIND_M, 1))
    return shapely.Polygon([[x, y] + far * along + side * WIDTH_M / 2 * across for far, side in ends])


def longest_stand(track):
    """The vertex at which the car stands longest."""
    moves = np.flatnonzero(np.hypot(*np.diff(track[:, 1:3], axis=0).T) > 1e-6)
    return moves[np.argmax(np.diff(track[moves, 0]))] + 1


def street_m(judge, kind):
    """Places (x, z) of the portals to the street."""
    return judge.places[[node for node, own in enumerate(judge.kinds) if own == kind]][:, [0, 2]]


def test_the_car_drives_on_the_floors_and_ramps_from_the_street_to_the_lowest_level_and_back(scenario, judge, ground):
    track = OpenScenario(scenario).track()
    rear, front = axles(track)
    assert assert_on_the_ground(ground, rear) > 500
    assert assert_on_the_ground(ground, front, FRONT_M) > 500
    assert track[:, 3].min() == pytest.approx(LOWEST_M, abs=1e-5)
    for end, kind in ((0, "entrance"), (-1, "exit")):
        assert track[end, 3] > 3.0  # at the top of a ramp to the street
        away = np.abs(street_m(judge, kind) - rear[end, [0, 2]])
        assert ((away.min(axis=1) < MILLIMETRE) & (away.max(axis=1) < RAMP_M)).any()  # before it, in line
    # the steepest is what the lane graph has
    ramps = judge.ramps()
    slopes = [np.abs(np.diff(ramp[:, 1]) / np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1)) for ramp in ramps]
    own = (rear[:, 1] > LOWEST_M + 1.0) & (rear[:, 1] < -1.0)
    assert np.abs(np.tan(track[own, 5])).max() == pytest.approx(max(map(max, slopes)), abs=1e-3)


def test_without_a_stall_it_parks_in_a_free_one_of_the_lowest_level(built, scenario, judge):
    track = OpenScenario(scenario).track()
    _, x, y, z, heading, pitch, _ = track[longest_stand(track)]
    assert (z, pitch) == pytest.approx((LOWEST_M, 0.0))
    body = outline(x, y, heading)
    homes = [
        number
        for number, (corners, level) in enumerate(zip(judge.outlines, judge.stall_levels, strict=True))
        if level == 1 and shapely.Polygon(corners[:, [0, 2]] * [1, -1]).buffer(0.02).covers(body)
    ]
    assert len(homes) == 1
    cars = [entry["path"] for entry in labelled_objects(built.labels) if entry["class"] == "car"]
    vehicles = OpenScenario(scenario).vehicles
    assert len(vehicles) - 1 == len(cars)  # it is free, so that all of them stay


def test_parked_cars_stand_on_the_floors_of_their_levels(built, scenario):
    read = OpenScenario(scenario)
    boxes = {name: read.box(name)[0].centroid for name in read.vehicles if name != EGO}
    for car in (entry for entry in labelled_objects(built.labels) if entry["class"] == "car"):
        (x0, y0, z0), (x1, _, z1) = car["min_m"], car["max_m"]
        floor_m = FLOORS_M[car["path"].split("/")[3]]
        assert y0 == pytest.approx(floor_m, abs=0.02)
        middle = shapely.Point((x0 + x1) / 2, -(z0 + z1) / 2)
        at = [name for name, place in boxes.items() if place.distance(middle) < 0.3 and read.inits[name][2] == floor_m]
        assert len(at) == 1
        boxes.pop(at[0])
    assert not boxes


def test_a_stall_is_named_with_its_level_and_portals_are_those_to_the_street(built, judge):
    planner = LevelsDrivePlanner(built_levels(open_stage(built.stage), built.stage))
    number = next(number for number in judge.numbers if number.startswith("U1/"))
    states = planner.drive(number.lower(), entrance=1, exit=1, leg=Leg.IN).trajectory
    assert states.y_m[0] > 3.0
    assert np.abs(states.y_m[-1]) < 1e-6
    home = shapely.Polygon(judge.outlines[judge.numbers.index(number)][:, [0, 2]] * [1, -1])
    assert home.buffer(0.02).covers(outline(states.x_m[-1], -states.z_m[-1], states.yaw_rad[-1] + math.pi / 2))
    for field, wrong in (("entrance", 2), ("exit", 2), ("stall", number.partition("/")[2])):
        with pytest.raises(ConfigError, match=f"{field}: got"):
            planner.drive(**{field: wrong})


@needs_checker
def test_asam_s_checker_has_no_issue(scenario, tmp_path):
    assert issues_of(scenario, tmp_path) == []


@pytest.mark.skipif(not ESMINI.exists(), reason="esmini is a program that is compiled; docs/guides/esmini.md says how")
def test_esmini_drives_over_the_ramps_to_the_street(scenario, judge, ground):
    track = OpenScenario(scenario).track()
    rows, collisions = played(ESMINI, scenario, track[-1, 0])
    assert collisions == []
    places = np.stack([rows[:, 1], rows[:, 3], -rows[:, 2]], axis=1)
    assert assert_on_the_ground(ground, places) > 500
    assert rows[:, 3].min() == pytest.approx(LOWEST_M, abs=1e-4)
    assert np.abs(rows[-1, 1:4] - track[-1, 1:4]).max() < MILLIMETRE
    assert rows[-1, 3] > 3.0
