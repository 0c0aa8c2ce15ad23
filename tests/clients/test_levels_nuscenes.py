"""nuscenes-devkit loads a drive over a ramp as a scene of each level, with a map and with boxes at its height."""

import json
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
from support.label_tables import labelled_objects
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge
from support.small_levels import FLOORS_M, LIDAR, SMALL_LEVELS

import garage2usd
from garage2usd.recordings import CloudFormat, Sequence, record
from garage2usd.sensors.formats.nuscenes import NUSCENES_VERSION
from garage2usd.sensors.rig.rig import rig_from_mapping

pytestmark = [
    pytest.mark.soak,
    pytest.mark.client,
    pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with nuscenes-devkit"),
]

EVERY_M = 12.0
"""Distance of the poses, of which three are on the ramp, above its middle and below."""
MILLIMETRE = 1e-3
U1, U2 = FLOORS_M
HALF_WAY_M = (FLOORS_M[U1] + FLOORS_M[U2]) / 2


@pytest.fixture(scope="module")
def loaded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("nuscenes")
    built = garage2usd.build(SMALL_LEVELS, folder / "two.usdc")
    made = record(
        built.stage,
        folder / "drive",
        rig=rig_from_mapping({"name": "top", "car": "hatchback", "sensors": [LIDAR]}),
        along="1:U2/A1-01",
        every_m=EVERY_M,
        points=[CloudFormat.NPZ],
        sequences=[Sequence.NUSCENES],
    )
    data = made.folder / "nuscenes"
    maps = json.loads((data / NUSCENES_VERSION / "map.json").read_text())
    to_global = np.array(maps[0]["stage_to_global"])
    assert all(each["stage_to_global"] == maps[0]["stage_to_global"] for each in maps)
    objects = {entry["id"]: entry for entry in labelled_objects(built.labels)}
    for entry in objects.values():
        entry["level"] = entry["path"].split("/")[3]
        middle = (np.array(entry["min_m"]) + np.array(entry["max_m"])) / 2
        entry["place"] = (to_global[:3, :3] @ middle + to_global[:3, 3])[:2].tolist()
    (folder / "places.json").write_text(json.dumps([entry["place"] for entry in objects.values()]))
    arguments = data, NUSCENES_VERSION, folder / "found.json", folder / "places.json"
    run_judge("nuscenes_dump.py", *arguments, folder=folder)
    found = json.loads((folder / "found.json").read_text())
    for scene in found["scenes"]:
        scene["level"] = scene["location"].removeprefix("two_")
    table = json.loads(made.frames.read_text())
    clouds = [np.load(made.folder / sweep["files"]["npz"]) for sweep in table["sweeps"]]
    return SimpleNamespace(found=found, objects=objects, sweeps=table["sweeps"], clouds=clouds, data=data)


def test_the_drive_is_a_scene_of_each_level_with_a_log_and_a_map(loaded):
    scenes = loaded.found["scenes"]
    assert [(scene["name"], scene["location"], scene["map"]) for scene in scenes] == [
        ("scene-0001", "two_U1", "maps/two_U1.png"),
        ("scene-0002", "two_U2", "maps/two_U2.png"),
    ]
    assert {path.name for path in (loaded.data / "maps").iterdir()} == {"two_U1.png", "two_U2.png"}
    levels = [scene["level"] for scene in scenes for _ in scene["samples"]]
    assert levels == [sweep["level"] for sweep in loaded.sweeps]


def test_no_chain_crosses_scenes(loaded):
    """The program follows all of them from their beginnings; what is seen from both levels is two instances."""
    instances = loaded.found["instances"].values()
    counts = Counter(instance["id"] for instance in instances)
    assert len({(instance["id"], instance["scene"]) for instance in instances}) == len(instances)
    assert {*counts.values()} == {1, 2}
    for scene in loaded.found["scenes"]:
        met = Counter(box["instance"] for sample in scene["samples"] for box in sample["boxes"])
        own = {token: each for token, each in loaded.found["instances"].items() if each["scene"] == scene["name"]}
        assert met == {token: each["count"] for token, each in own.items()}


def test_the_car_is_at_the_height_of_the_floor(loaded):
    sloped = 0
    for scene in loaded.found["scenes"]:
        heights = np.array([sample["ego"][2] for sample in scene["samples"]])
        is_off = np.abs(heights - FLOORS_M[scene["level"]]) > MILLIMETRE
        if scene["level"] == U1:
            assert (heights > HALF_WAY_M).all()
        else:
            assert (heights < HALF_WAY_M).all()
        sloped += (is_off & (heights < FLOORS_M[U1])).sum()
        assert np.count_nonzero(~is_off) >= 5
    assert sloped == 3


def test_points_of_the_floor_are_at_its_height(loaded):
    for scene in loaded.found["scenes"]:
        floor_m = FLOORS_M[scene["level"]]
        for sample in scene["samples"]:
            if abs(sample["ego"][2] - floor_m) < MILLIMETRE:
                heights = np.array(sample["heights"])[np.array(sample["classes"]) == "flat.driveable_surface"]
                assert len(heights) > 1000
                assert np.mean(np.abs(heights - floor_m) < 0.02) > 0.8


def test_boxes_hold_their_points_and_stand_on_the_floors_of_their_levels(loaded):
    points, boxes = Counter(), Counter()
    levels = [scene["level"] for scene in loaded.found["scenes"] for _ in scene["samples"]]
    cars = {number for number, entry in loaded.objects.items() if entry["class"] == "car"}
    for sample, cloud, level in zip(loaded.found["samples"], loaded.clouds, levels, strict=True):
        of_ids = {loaded.found["instances"][box["instance"]]["id"]: box for box in sample["boxes"]}
        assert sample["points"] == len(cloud["instance"])
        for number in cars.intersection(cloud["instance"].tolist()):
            own = np.flatnonzero(cloud["instance"] == number)
            assert {*own.tolist()} <= {*of_ids[number]["inside"]}
            assert of_ids[number]["said"] == len(own)
            points[level] += len(own)
        for number in cars & of_ids.keys():
            entry = loaded.objects[number]
            lowest = np.array(of_ids[number]["corners"])[:, 2].min()
            assert lowest == pytest.approx(FLOORS_M[entry["level"]], abs=0.03)
            boxes[entry["level"]] += 1
    assert {*points} == {*boxes} == {U1, U2}
    assert min(points.values()) > 500
    assert min(boxes.values()) >= 20


def test_the_car_is_on_the_map_of_its_level(loaded):
    assert all(sample["on_map"] for sample in loaded.found["samples"])
    assert not any(sample["off_map"] for sample in loaded.found["samples"])


def test_each_map_has_the_ground_of_its_own_level_and_both_ramps(loaded):
    free = Counter()
    for scene in loaded.found["scenes"]:
        for entry, is_free in zip(loaded.objects.values(), scene["on_map"], strict=True):
            hangs = entry["min_m"][1] > FLOORS_M[entry["level"]] + MILLIMETRE
            kind = "hung" if hangs and entry["class"] == "wall" else entry["class"]
            free[scene["level"], "own" if entry["level"] == scene["level"] else "other", kind, is_free] += 1
    for name in FLOORS_M:
        for standing in ("column", "wall", "obstacle"):
            assert free[name, "own", standing, False] > 3
            assert free[name, "own", standing, True] == 0
        assert free[name, "own", "parking_stall", True] > 90
        assert free[name, "own", "parking_stall", False] == 0
        # a column of the other level stands where the landing of this one has none
        assert free[name, "other", "column", True] > 0
    assert free[U2, "own", "ramp", True] == free[U1, "other", "ramp", True] == 2
    assert free[U1, "own", "ramp", True] == free[U2, "other", "ramp", False] == 2  # those to the street
    # at the foot of a ramp its slab's edge hangs over the way; above it, on U1, a wall ends the ramp
    assert free[U2, "own", "hung", True] == 2
