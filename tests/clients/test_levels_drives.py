"""Drives through a garage of several levels, as scenarios and as recordings, against the stage's own meshes."""

import importlib.util
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image
from support.drive_judge import GROOVE_M, GROOVES, MILLIMETRE, assert_driven_on, assert_on_the_ground
from support.esmini_player import ESMINI, played
from support.label_tables import labelled_objects
from support.level_judge import LevelJudge, above, first_hits
from support.newton_reader import needs_newton
from support.openscenario_checker import issues_of, needs_checker
from support.openscenario_reader import OpenScenario
from support.small_levels import FLOORS_M, LIDAR, SMALL_LEVELS

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import Leg
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.openscenario import EGO
from garage2usd.recordings import CloudFormat, record
from garage2usd.render import Picture, SlotFormat
from garage2usd.render.pictures import read_depth
from garage2usd.sensors.rays.birds_eye import BirdsEye
from garage2usd.sensors.rig.rig import rig_from_mapping

pytestmark = pytest.mark.client
WHEELBASE_M, AHEAD_M, BEHIND_M, WIDTH_M = 2.7, 3.6, 1.2, 1.8
FRONT_M = 2.5e-3
"""Where a slope changes by 7.5 %, the pitch is that of a place 3 cm ahead of the front axle."""
RIG = {
    "name": "small",
    "title": "A LiDAR without noise and a front camera",
    "car": "hatchback",
    "sensors": [
        {**LIDAR, "name": "lidar", "rate_hz": 10.0},
        {
            "kind": "pinhole",
            "name": "front",
            "position_m": [1.1, 0.0, 1.55],
            "pitch_deg": 5.0,
            "size_px": [160, 90],
            "focal_px": [120.0, 120.0],
        },
    ],
}
EVERY_M = 16.0
"""Distance of the poses of a recording: less than that over which a ramp is far from both floors."""
ABOVE = BirdsEye(metres_per_px=0.1, size_px=(160, 160))
PICTURES = Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC
needs_blender = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"
)
LOWEST_M, RAMP_M = FLOORS_M["U2"], 40.0


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build(SMALL_LEVELS, tmp_path_factory.mktemp("levels") / "garage.usdc")


@pytest.fixture(scope="module")
def judge(built):
    return LevelJudge(built.stage)


@pytest.fixture(scope="module")
def ground(judge):
    return judge.ground()


@pytest.fixture(scope="module")
def scenario(built):
    return garage2usd.export(built.stage, [built.stage.with_suffix(".xosc")])[0]


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
    assert assert_driven_on(ground, rear, FLOORS_M.values()) > 500
    assert assert_driven_on(ground, front, FLOORS_M.values(), FRONT_M) > 500
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
    planner = DrivePlanner(garage_of_file(built.stage))
    number = next(number for number in judge.numbers if number.startswith("U1/"))
    states = planner.drive(number.lower(), entrance=1, exit=1, leg=Leg.IN).trajectory
    assert states.y_m[0] > 3.0
    assert np.abs(states.y_m[-1]) < 1e-6
    home = shapely.Polygon(judge.outlines[judge.numbers.index(number)][:, [0, 2]] * [1, -1])
    assert home.buffer(0.02).covers(outline(states.x_m[-1], -states.z_m[-1], states.yaw_rad[-1] + math.pi / 2))
    for field, wrong in (("entrance", 2), ("exit", 2), ("stall", number.partition("/")[2])):
        with pytest.raises(ConfigError, match=f"{field}: got"):
            planner.drive(**{field: wrong})


@needs_newton
def test_newton_s_rays_meet_its_ramps_where_the_car_drives(built, scenario, tmp_path):
    rear, front = (
        places[(places[:, 1] > LOWEST_M + 0.05) & (places[:, 1] < -0.05)]
        for places in axles(OpenScenario(scenario).track())
    )
    eyes = above(np.concatenate([rear, front]), 1.0)
    rays, output = tmp_path / "rays.npz", tmp_path / "far.npy"
    np.savez(rays, origins=eyes, directions=np.tile([0.0, -1.0, 0.0], (len(eyes), 1)))
    command = [sys.executable, Path(__file__).with_name("newton_rays.py"), built.stage]
    subprocess.run([*command, "/Garage/Levels/U2/Ramps", rays, output], check=True, capture_output=True)
    for deep, within_m in zip(np.split(np.load(output) - 1.0, [len(rear)]), (MILLIMETRE, FRONT_M), strict=True):
        assert np.median(np.abs(deep)) < 1e-5
        assert deep.min() > -within_m
        over_groove = deep > within_m
        assert deep[over_groove].max() < GROOVE_M + within_m
        assert over_groove.mean() < GROOVES


@needs_checker
def test_asam_s_checker_has_no_issue(scenario, tmp_path):
    assert issues_of(scenario, tmp_path) == []


if ESMINI is not None:

    def test_esmini_drives_over_the_ramps_to_the_street(scenario, judge, ground):
        track = OpenScenario(scenario).track()
        rows, collisions = played(ESMINI, scenario, track[-1, 0])
        assert collisions == []
        places = np.stack([rows[:, 1], rows[:, 3], -rows[:, 2]], axis=1)
        assert assert_driven_on(ground, places, FLOORS_M.values()) > 500
        assert rows[:, 3].min() == pytest.approx(LOWEST_M, abs=1e-4)
        assert np.abs(rows[-1, 1:4] - track[-1, 1:4]).max() < MILLIMETRE
        assert rows[-1, 3] > 3.0


@pytest.fixture(scope="module")
def recorded(built, judge, tmp_path_factory):
    """Folder and table of a recording on the way to a stall of the lowest level that is free."""
    taken = {car["path"].split("/")[3] for car in labelled_objects(built.labels) if car["class"] == "car"}
    assert taken == {*FLOORS_M}
    number = next(
        number
        for number, level in zip(judge.numbers, judge.stall_levels, strict=True)
        if level == 1 and number.endswith("A1-01")
    )
    made = record(
        built.stage,
        tmp_path_factory.mktemp("recorded") / "out",
        rig=rig_from_mapping(RIG),
        along=f"1:{number}",
        every_m=EVERY_M,
        samples=1,
        pictures=PICTURES,
        points=[CloudFormat.NPZ],
        birds_eye=ABOVE,
        slots=[SlotFormat.JSON],
    )
    return made.folder, json.loads(made.frames.read_text())


def vehicles(table):
    """Level and pose of the vehicle at each pose of the recording."""
    return [(sweep["level"], np.array(sweep["vehicle_to_world"])) for sweep in table["sweeps"]]


@needs_blender
@pytest.mark.soak
def test_a_recording_is_made_on_the_floors_and_ramps_and_names_the_level(recorded, ground):
    _, table = recorded
    poses = vehicles(table)
    wheels = [pose @ [far, 0.0, 0.0, 1.0] for _, pose in poses for far in (0.0, WHEELBASE_M)]
    assert_on_the_ground(ground, np.array(wheels)[:, :3], FLOORS_M.values(), FRONT_M)
    names = [name for name, _ in poses]
    heights = [pose[1, 3] for _, pose in poses]
    assert names == ["U1" if height > LOWEST_M / 2 else "U2" for height in heights]
    assert {*names} == {*FLOORS_M}
    assert any(LOWEST_M + 0.5 < height < -0.5 for height in heights)
    assert [frame["level"] for frame in table["frames"]] == [names[frame["pose"]] for frame in table["frames"]]
    assert table["drive"]["stall"].startswith("U2/")


@needs_blender
@pytest.mark.soak
def test_lidar_and_depth_on_a_ramp_are_those_of_rays_of_trimesh(recorded, built, judge):
    folder, table = recorded
    ramps = judge.mesh("ramp")
    ids = [entry["id"] for entry in labelled_objects(built.labels) if entry["class"] == "ramp"]
    sloped = drawn = 0
    for sweep in table["sweeps"]:
        cloud, place = np.load(folder / sweep["files"]["npz"]), np.array(sweep["sensor_to_world"])
        points = cloud["points_m"][np.isin(cloud["instance"], ids)].astype(float)
        far = np.linalg.norm(points, axis=1)
        found = first_hits(ramps, np.broadcast_to(place[:3, 3], points.shape), points / far[:, None] @ place[:3, :3].T)
        if len(points):
            assert np.abs(found - far).max() < MILLIMETRE
            heights = points @ place[1, :3] + place[1, 3]
            sloped += ((heights > LOWEST_M + 0.2) & (heights < -0.2)).sum()
    for frame in (frame for frame in table["frames"] if frame["camera"] == "front"):
        depth_m = read_depth(folder / frame["files"]["depth"])
        rows, columns = np.nonzero(np.isin(ids_of(folder / frame["files"]["instance"]), ids) & (depth_m < 20.0))
        rays = np.stack([columns + 0.5, rows + 0.5, np.ones(len(rows))], axis=1)
        rays = rays @ np.linalg.inv(frame["intrinsics"]).T
        place, sizes = np.linalg.inv(frame["world_to_camera"]), np.linalg.norm(rays, axis=1)
        origins = np.broadcast_to(place[:3, 3], rays.shape)
        if len(rows):
            found = first_hits(ramps, origins, rays / sizes[:, None] @ place[:3, :3].T) / sizes
            assert np.quantile(np.abs(found - depth_m[rows, columns]), 0.98) < MILLIMETRE  # at edges of grooves
            drawn += len(rows)
    assert min(sloped, drawn) > 1000


def ids_of(path):
    """The id that each pixel of an instance picture shows."""
    return np.asarray(Image.open(path)).astype(int) @ [1, 256, 65536]


@needs_blender
@pytest.mark.soak
def test_a_birds_eye_view_shows_the_vehicle_s_own_level_and_the_ramps_down_from_it(recorded, judge):
    folder, table = recorded
    slots = json.loads((folder / "slots.json").read_text())
    outlines = dict(zip(judge.stall_ids, judge.outlines, strict=True))
    assert {slot["name"]: slot["level"] for slot in slots["slots"]} == {
        name: name.partition("/")[0] for name in outlines
    }
    seen = {frame["name"]: frame["slots"] for frame in slots["frames"]}
    counted = 0
    for frame in (frame for frame in table["frames"] if frame["camera"] == "birds_eye"):
        own = f"/Garage/Levels/{frame['level']}/"
        paths = [each["path"] for each in frame["instances"]]
        assert paths
        assert all(path.startswith((own, "/Garage/Levels/U2/Ramps/Ramp_")) for path in paths)
        to_vehicle = np.linalg.inv(frame["vehicle_to_world"])
        for slot in seen[frame["name"]]:
            assert slot["name"].startswith(f"{frame['level']}/")
            ahead, left = (outlines[slot["name"]] @ to_vehicle[:2, :3].T + to_vehicle[:2, 3]).T
            places = 80 - (left - ABOVE.centre_m[1]) / 0.1, 80 - (ahead - ABOVE.centre_m[0]) / 0.1
            assert np.abs(np.stack(places, axis=1) - slot["corners_px"]).max() < 0.1
            counted += 1
        column, row = np.floor(frame["vehicle_px"]).astype(int)
        free = np.asarray(Image.open(folder / frame["free_space"]))
        assert free[row, column]
        if abs(frame["vehicle_to_world"][1][0]) > 0.05:  # on a ramp: free as far as its walls
            assert free[row - 40 : row, column].all()
            assert not free[row].all()
    assert counted > 10
