"""A recording in traffic, judged by nuscenes-devkit, and its pictures by the depth that Blender draws."""

import importlib.util
import json
from collections import defaultdict

import numpy as np
import OpenEXR
import pytest
from support.recorded_traffic import EGO, TOP, Recorded, middle_of
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge

from garage2usd.recordings import Sequence
from garage2usd.render import Picture, SlotFormat
from garage2usd.render.pictures import read_depth, read_ids
from garage2usd.sensors.formats.nuscenes import NUSCENES_VERSION
from garage2usd.sensors.rays.sight import seen_points
from garage2usd.sensors.rig.rig import rig_from_mapping

pytestmark = pytest.mark.client
CENTIMETRE = 0.01
HALL = {
    "kind": "pinhole",
    "name": "hall",
    "mount": "world",
    "position_m": (3.0, -9.0, 2.3),
    "pitch_deg": 12.0,
    "size_px": (96, 64),
    "focal_px": (50, 50),
}


@pytest.fixture(scope="module")
def loaded(tmp_path_factory):
    folder = tmp_path_factory.mktemp("traffic")
    rig = rig_from_mapping({"name": "own", "sensors": [TOP]})
    recorded = Recorded(folder, rig, sequences=[Sequence.NUSCENES])
    data = recorded.made.folder / "nuscenes"
    run_judge("nuscenes_dump.py", data, NUSCENES_VERSION, folder / "found.json", folder=folder)
    return recorded, json.loads((folder / "found.json").read_text())


@pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with nuscenes-devkit")
def test_nuscenes_has_the_boxes_velocities_and_ids_of_the_tracks(loaded):
    recorded, found = loaded
    names = {agent["id"]: agent["name"] for agent in json.loads(recorded.made.frames.read_text())["traffic"]["agents"]}
    to_stage = np.linalg.inv(found["stage_to_global"])
    tokens, times, moving = defaultdict(set), defaultdict(list), 0
    for sample in found["samples"]:
        time_s = sample["timestamp"] / 1e6
        for box in sample["boxes"]:
            instance = found["instances"][box["instance"]]
            name = names.get(instance["id"])
            assert len(box["given"]) == 3
            if name is None:
                assert box["given"] == [0.0, 0.0, 0.0]
                continue
            tokens[name].add(box["instance"])
            times[name].append(time_s)
            track = recorded.by_name[name]
            there = middle_of(track, time_s)
            corners = np.array(box["corners"]) @ to_stage[:3, :3].T + to_stage[:3, 3]
            up = np.array([0, np.cos(there.pitch), 0]) * track.agent.height_m / 2
            lean = np.sin(there.pitch) * np.array([np.sin(there.yaw), 0, np.cos(there.yaw)])
            middle = corners.mean(axis=0) - up - lean * track.agent.height_m / 2
            assert middle == pytest.approx((there.x, there.y, there.z), abs=CENTIMETRE)
            ahead = corners[:4].mean(axis=0) - corners[4:].mean(axis=0)
            assert np.linalg.norm(ahead) == pytest.approx(track.agent.length_m, abs=CENTIMETRE)
            assert ahead[[0, 2]] / np.linalg.norm(ahead) == pytest.approx(
                (-np.sin(there.yaw) * np.cos(there.pitch), -np.cos(there.yaw) * np.cos(there.pitch)), abs=CENTIMETRE
            )
            around = track.at(np.array([time_s - 0.05, time_s + 0.05]))[:, :3]
            if np.isfinite(around).all():
                east, up_m_s, south = (around[1] - around[0]) / 0.1
                assert box["given"] == pytest.approx((east, -south, up_m_s), abs=2e-3)
                moving += abs(east) + abs(south) > 0.3
            kind = "pedestrian" if name.startswith("person") else "vehicle"
            assert [each.partition(".")[0] for each in box["attributes"]] == [kind]
    assert {name: len(own) for name, own in tokens.items()} == dict.fromkeys(("car_001", "car_900", "person_000"), 1)
    assert moving > 12
    # between key frames the devkit's velocities are those of the tracks
    for sample, before, after in zip(found["samples"][1:], found["samples"], found["samples"][2:], strict=False):
        for box in sample["boxes"]:
            name = names.get(found["instances"][box["instance"]]["id"])
            seen = [any(other["instance"] == box["instance"] for other in each["boxes"]) for each in (before, after)]
            if name and all(seen):
                ends = recorded.by_name[name].at(np.array([before["timestamp"], after["timestamp"]]) / 1e6)
                east, _, south = (ends[1] - ends[0])[:3] / ((after["timestamp"] - before["timestamp"]) / 1e6)
                assert box["velocity"][:2] == pytest.approx((east, -south), abs=0.08)


@pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with nuscenes-devkit")
def test_points_of_agents_are_in_boxes_that_go_with_their_speed(loaded):
    """All points of a car that stands are in its box, and nearly all of one that moves during the sweep."""
    recorded, found = loaded
    table = json.loads(recorded.made.frames.read_text())
    total = inside = 0
    for sample, sweep in zip(found["samples"], table["sweeps"], strict=True):
        boxes = {found["instances"][box["instance"]]["id"]: box for box in sample["boxes"]}
        for seen in sweep["instances"]:
            if seen["path"].startswith("/Agents") and seen["class"] == "car":
                box = boxes[seen["id"]]
                assert box["said"] == seen["points"]
                total += seen["points"]
                inside += len(box["inside"])
    assert total > 500
    assert inside / total > 0.85  # mirrors, and what moved since


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_pictures_show_agents_where_they_are_at_their_time(tmp_path):
    rig = rig_from_mapping({"name": "own", "sensors": [HALL]})
    recorded = Recorded(
        tmp_path,
        rig,
        ego="",
        between_s=(9.0, 11.5),
        samples=1,
        pictures=[Picture.DEPTH, Picture.INSTANCE],
        slots=[SlotFormat.JSON],
        flow=True,
    )
    table = json.loads(recorded.made.frames.read_text())
    assert table["traffic"]["ego"] == ""
    agents = {agent["id"]: agent for agent in table["traffic"]["agents"]}
    assert EGO in {agent["name"] for agent in agents.values()}
    assert ["flow" in frame for frame in table["frames"]] == [True] * 5 + [False]
    pixels, flows = defaultdict(int), []
    for frame in table["frames"]:
        files = {kind: recorded.made.folder / file for kind, file in frame["files"].items()}
        depth_m, ids = read_depth(files["depth"]), read_ids(files["instance"])
        lens = rig.cameras[0].lens
        places = seen_points(lens, depth_m, np.linalg.inv(frame["world_to_camera"]))
        states = {state["id"]: state for state in table["traffic"]["states"][frame["pose"]]}
        for number, agent in agents.items():
            own = places[ids == number]
            if not len(own):
                continue
            track, (across, high) = recorded.by_name[agent["name"]], agent["size_m"][1:]
            there = middle_of(track, frame["time_s"])
            assert number in states
            ahead = np.array([-np.sin(there.yaw), -np.cos(there.yaw)])
            away = own[:, [0, 2]] - (there.x, there.z)
            along, side = away @ ahead, away @ np.array([ahead[1], -ahead[0]])
            # limbs of people who walk, and mirrors, reach out of the box
            reach = 0.45 if agent["class"] == "person" else 0.25
            assert np.abs(along).max() < agent["size_m"][0] / 2 + reach
            assert np.abs(side).max() < across / 2 + reach
            assert (own[:, 1] > there.y - 0.05).all()
            assert (own[:, 1] < there.y + high + 0.3).all()
            pixels[agent["class"]] += len(own)
            if "flow" in frame and agent["class"] == "car" and track.time_s[-1] > frame["time_s"] + 0.5:
                flows += judged_flow(recorded, frame, agent["name"], own, ids == number)
        if "flow" in frame:
            still = read_flow(recorded.made.folder / frame["flow"])[~np.isin(ids, [*agents]) & np.isfinite(depth_m)]
            assert np.abs(still).max() < 1e-2
    slots = json.loads((recorded.made.folder / "slots.json").read_text())
    assert slots["frames"][0]["slots"]
    assert all(slot["occupied"] in {True, False} for frame in slots["frames"] for slot in frame["slots"])
    assert max(flows) > 3.0  # pixels
    assert pixels["car"] > 60
    assert pixels["person"] > 10


def read_flow(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return np.stack([np.array(file.channels()[name].pixels) for name in "UV"], axis=-1)


def judged_flow(recorded, frame, name, places, mask):
    """Lengths of the flow of a car, which is that of its body in the layer of the tracks that USD plays."""
    before, after = (recorded.placed(name, frame["time_s"] + seconds) for seconds in (0.0, 0.5))
    move = after @ np.linalg.inv(before)
    to_camera = np.array(frame["world_to_camera"]) @ np.vstack([move[:3], [0, 0, 0, 1]])
    moved = places @ to_camera[:3, :3].T + to_camera[:3, 3]
    (focal_x, _, across), (_, focal_y, down), _ = np.array(frame["intrinsics"])
    pixels = np.stack([focal_x * moved[:, 0], focal_y * moved[:, 1]], axis=1) / moved[:, 2:] + (across, down)
    rows, columns = np.nonzero(mask)
    expected = pixels - np.stack([columns + 0.5, rows + 0.5], axis=1)
    flow = read_flow(recorded.made.folder / frame["flow"])[mask]
    ahead = moved[:, 2] > 1.0
    assert flow[ahead] == pytest.approx(expected[ahead], abs=0.3)
    return np.linalg.norm(expected[ahead], axis=1).tolist()
