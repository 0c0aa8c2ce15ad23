"""Ways between two poses among scenes of the kind that published sets have: each is judged by shapely and a bicycle."""

import itertools
import json
import math

import numpy as np
import pytest
import shapely
from support.driving_simulation import simulate

from garage2usd.driving import (
    DesignCar,
    DrivenGarage,
    LanePose,
    Limits,
    Obstacles,
    Outcome,
    Pose,
    find_way,
    prove_garage,
    way_search,
)
from garage2usd.driving.trajectory import write_witness
from garage2usd.driving.way_search import Task, find_way_by_steps, reeds_shepp_words, search
from garage2usd.garage import LaneEdge, LaneGraph, LaneNode, Stall, StallUse

CAR = DesignCar()
RADIUS_M = CAR.rear_axle_radius_m


def box(middle, yaw_rad, length_m, width_m):
    """A rectangle along a yaw."""
    along, across = (
        np.array([-math.sin(yaw_rad), -math.cos(yaw_rad)]),
        np.array([-math.cos(yaw_rad), math.sin(yaw_rad)]),
    )
    corners = [
        np.array(middle) + ahead * length_m / 2 * along + left * width_m / 2 * across
        for ahead, left in ((1, 1), (1, -1), (-1, -1), (-1, 1))
    ]
    return shapely.Polygon(corners)


def car_at(middle, yaw_rad):
    return box(middle, yaw_rad, CAR.length_m, CAR.width_m)


def parallel(spare_m=1.5):
    """A kerbside stall longer than the car by so much, with a wall beside it; the street runs to -Z."""
    apart_m = CAR.length_m + spare_m / 2
    walls = [shapely.box(1.15, -15, 1.35, 15), shapely.box(-6.0, -15, -5.8, 15)]
    shapes = [car_at((0, -apart_m), 0.0), car_at((0, apart_m), 0.0), *walls]
    return CAR.centred((0, 0), 0.0), CAR.centred((-3.0, -5.0), 0.0), shapes


def angled(degrees):
    """A stall at an angle between two cars, off an aisle of 3.6 m that runs to +X and has cars on its other side."""
    turn = math.radians(degrees)
    yaw = -math.pi / 2 + turn
    pitch = 2.4 / math.sin(turn)
    middles = [(number * pitch, -2.9) for number in range(-3, 4)]
    cars = [car_at(middle, yaw) for middle in middles if middle != (0.0, -2.9)]
    nearest_m = max(shapely.bounds(shapely.union_all(cars))[3], -2.9)
    wall = shapely.box(-20, nearest_m + 3.6, 20, nearest_m + 3.8)
    return CAR.centred((0.0, -2.9), yaw), CAR.centred((-8.0, nearest_m + 1.8), -math.pi / 2), [*cars, wall]


def dead_end():
    """The last bay of a blind aisle of 5.2 m, which is left nose first and entered from its open end."""
    cars = [car_at((x, -2.65), 0.0) for x in (-7.2, -4.8, -2.4)]
    walls = [shapely.box(-14, 5.2, 3, 5.4), shapely.box(2.2, -6, 2.4, 5.4), shapely.box(-14, -5.5, 3, -5.3)]
    return CAR.centred((0.0, -2.65), math.pi), CAR.centred((-9.0, 2.6), -math.pi / 2), [*cars, *walls]


def tight():
    """A stall 20 cm wider than the car between walls, off an aisle of 4.6 m, entered askew."""
    walls = [shapely.box(-9, -6, -1.0, -0.3), shapely.box(1.0, -6, 9, -0.3), shapely.box(-9, 4.6, 9, 4.8)]
    return CAR.centred((0.0, -2.75), 0.0), CAR.centred((-5.0, 2.4), math.radians(-80.0)), walls


SCENES = {
    "parallel": parallel(),
    "angled at 45 degrees": angled(45),
    "angled at 60 degrees": angled(60),
    "dead end": dead_end(),
    "tight": tight(),
}


def way_between(parked, other, shapes, **limits):
    """The search from a parked pose to a place of 5 cm."""
    ahead_m = CAR.length_m / 2 - CAR.rear_overhang_m
    middle = other.x_m - math.sin(other.yaw_rad) * ahead_m, other.z_m - math.cos(other.yaw_rad) * ahead_m
    lane = LanePose(middle, other.yaw_rad, 0.05, 0.05)
    named = Obstacles.of((str(number), shape) for number, shape in enumerate(shapes))
    return find_way(CAR, parked, named, [lane], Limits(**limits))


@pytest.mark.parametrize(("parked", "other", "shapes"), SCENES.values(), ids=SCENES)
def test_a_place_is_met_exactly_and_nothing_is_touched_on_the_way(parked, other, shapes):
    found = way_between(parked, other, shapes)
    assert found.outcome is Outcome.REACHED
    way = found.way
    assert way.gear_changes <= 4
    end = way.end
    assert (end.x_m, end.z_m) == pytest.approx((other.x_m, other.z_m), abs=1e-6)
    assert math.remainder(end.yaw_rad - other.yaw_rad, math.tau) == pytest.approx(0.0, abs=1e-6)
    start = (way.start.x_m, way.start.z_m, way.start.yaw_rad)
    track = simulate(start, [(str(move.gear), move.curvature_per_m, move.length_m) for move in way.moves])
    assert track[-1] == pytest.approx((end.x_m, end.z_m, end.yaw_rad), abs=1e-6)
    bodies = shapely.polygons([CAR.corners(Pose(*pose)) for pose in track.tolist()])
    assert max(np.hypot(*np.diff(track[:, :2], axis=0).T)) <= 0.05
    nearest_m = shapely.distance(bodies, shapely.union_all(shapes)).min()
    assert Limits().margin_m <= way.clearance_m <= nearest_m + 1e-6


def test_the_same_scene_gives_the_same_way():
    assert way_between(*SCENES["tight"]).way == way_between(*SCENES["tight"]).way


def test_a_parallel_stall_hardly_longer_than_the_car_takes_many_short_moves():
    assert way_between(*parallel(0.8)).outcome is Outcome.IMPOSSIBLE
    assert 4 < way_between(*parallel(0.8), gear_changes=20).way.gear_changes <= 20


def street(spare_m):
    """A garage of one stall along a lane that is driven one way, to -Z."""
    shapes = parallel(spare_m)[2]
    kinds = ("entrance", "straight", "straight", "exit")
    nodes = [LaneNode(kind, (-3.3, 12.0 - 8.0 * number), (4.4, 8.0), str(number)) for number, kind in enumerate(kinds)]
    lanes = LaneGraph(tuple(nodes), tuple(LaneEdge(number, number + 1, 2.8, one_way=True) for number in range(3)))
    standing = Obstacles.of((str(number), shape) for number, shape in enumerate(shapes))
    corners = ((-1.0, 2.5), (1.0, 2.5), (1.0, -2.5), (-1.0, -2.5))
    stall = Stall("A1-01", corners, StallUse.STANDARD, 1)
    return DrivenGarage((stall,), lanes, standing, frozenset({stall.name}))


def test_a_stall_that_steps_do_not_reach_is_proven_by_the_guided_search():
    (proof,) = prove_garage(street(1.4))
    assert proof.outcome is Outcome.REACHED
    assert not proof.is_undecided
    for way in (proof.way_in, proof.way_out):
        assert way.gear_changes <= 4
        assert way.clearance_m >= Limits().margin_m
    parked, lane = CAR.centred((0.0, 0.0), 0.0), LanePose((-3.3, 0.0), 0.0, 16.0, 1.0)
    assert find_way_by_steps(CAR, parked, street(1.4).standing, [lane], Limits()).way is None


@pytest.fixture
def little_effort(monkeypatch):
    """Searches that end after twenty places."""
    monkeypatch.setattr(way_search, "_PASSES", ((0.36, 20), (0.24, 20)))
    monkeypatch.setattr(way_search, "_MOST_PLACES", 20)


@pytest.mark.usefixtures("little_effort")
def test_a_stall_whose_search_ends_at_its_bound_is_undecided_and_so_told(tmp_path):
    (proof,) = prove_garage(street(2.0))
    assert proof.outcome is Outcome.UNDECIDED
    write_witness(tmp_path / "ways.json", [proof])
    (told,) = json.loads((tmp_path / "ways.json").read_text())["stalls"]
    assert (told["proven"], told["undecided"]) == (False, True)


def test_a_stall_that_is_too_short_is_impossible_and_not_undecided(tmp_path):
    (proof,) = prove_garage(street(0.5))
    assert proof.outcome is Outcome.IMPOSSIBLE
    write_witness(tmp_path / "ways.json", [proof])
    (told,) = json.loads((tmp_path / "ways.json").read_text())["stalls"]
    assert not told["proven"]
    assert "undecided" not in told


def test_a_closed_yard_is_impossible():
    parked, other, shapes = dead_end()
    shut = [*shapes, shapely.box(-5.8, -0.3, -5.6, 5.4)]
    assert way_between(parked, other, shut).outcome is Outcome.IMPOSSIBLE


@pytest.mark.usefixtures("little_effort")
def test_too_few_places_are_undecided():
    assert way_between(*tight()).outcome is Outcome.UNDECIDED


def test_where_the_floor_is_parted_no_place_is_looked_at():
    wall = np.array([[(-30, -6), (30, -6), (30, -5), (-30, -5)]], float)
    scene = Obstacles.of([("wall", shapely.Polygon(wall[0]))]).met_by(CAR)
    goal = np.array([[0, -0.5, -15.5, 0.5, -14.5]])
    task = Task(scene, np.zeros(3), goal, RADIUS_M, 0.05, 20.0, 0.24, 4, 10_000, 120, is_guided=True)
    assert search(task, np.zeros(1, np.int64))[::2] == (0, 1)
    open_ = task._replace(scene=Obstacles.of([("wall", shapely.box(3, -6, 30, -5))]).met_by(CAR))
    assert search(open_, np.zeros(1, np.int64)).outcome == 1


def driven(start, word):
    pose = Pose(*start)
    for steering, length_m in word:
        pose = pose.moved(length_m, steering / RADIUS_M)
    return pose


def poses(count, seed):
    rng = np.random.default_rng(seed)
    return rng.uniform((-9, -9, -math.pi), (9, 9, math.pi), (count, 3))


def test_each_word_leads_to_its_pose():
    for start, end in itertools.pairwise(poses(300, 0)):
        words = reeds_shepp_words(start, end, RADIUS_M)
        assert len(words) >= 1
        for word in words:
            at = driven(start, word)
            assert (at.x_m, at.z_m) == pytest.approx(tuple(end[:2]), abs=1e-9)
            assert math.remainder(at.yaw_rad - end[2], math.tau) == pytest.approx(0.0, abs=1e-9)


def test_no_way_is_shorter_than_the_shortest_word():
    """Ways of five random pieces, most of them short, where each of the 48 words may be the best one."""
    rng = np.random.default_rng(1)
    kinds = set()
    for _ in range(3000):
        way = np.stack([rng.integers(-1, 2, 5), rng.normal(0, 2.5, 5)], axis=1)
        end = driven((0.0, 0.0, 0.0), way)
        words = reeds_shepp_words(np.zeros(3), np.array([end.x_m, end.z_m, end.yaw_rad]), RADIUS_M)
        lengths = np.abs(words[..., 1]).sum(axis=1)
        assert lengths.min() <= np.abs(way[:, 1]).sum() + 1e-7
        kinds.add(tuple(map(tuple, np.sign(words[lengths.argmin()]).astype(int).tolist())))
    assert len(kinds) > 30
