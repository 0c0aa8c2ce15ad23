"""The people of a run as Blender and three.js show them: feet stay on the floor, and where they are on it."""

import importlib.util
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.browser import find_browser, find_three, load_in_three
from support.footing import heights_m, slides_m
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.assets.gait import walked
from garage2usd.config import TrafficConfig
from garage2usd.maps.glb_walkers import walkers_glb
from garage2usd.stage.cameras import FRAMES_PER_SECOND
from garage2usd.stage.track_people import figure_of, gait_of
from garage2usd.stage.traffic import write_traffic_layer
from garage2usd.stage.walkers import Walker
from garage2usd.traffic import Operation

pytestmark = pytest.mark.client
HEIGHT_M, SLIDE_M = 0.02, 0.05
PEOPLE = 3
"""Number of people who are looked at in Blender, those who walk longest."""
WHOLE = """#usda 1.0
(
    defaultPrim = "Garage"
    metersPerUnit = 1
    upAxis = "Y"
    timeCodesPerSecond = 24
    endTimeCode = 8640
    subLayers = [@./traffic.usdc@]
)
def Xform "Garage" {}
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    stage = garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "garage.usdc").stage
    tracks = Operation(garage_of_file(stage)).run(TrafficConfig(minutes=6, arrivals_per_hour=80), seed=2)
    assert sum(track.agent.kind == "person" for track in tracks) >= 3
    return tracks


def assert_feet_hold(points, floor_m):
    heights = heights_m(points, floor_m)
    assert np.abs(heights).max() < HEIGHT_M
    slides = slides_m(points, floor_m)
    assert len(slides) > 20
    # a shoe of a person who turns about to step aside may slide by a little more
    assert (slides > SLIDE_M).mean() <= 0.005
    assert slides.max() < 1.2 * SLIDE_M


def test_sliding_and_floating_feet_are_seen():
    rng = np.random.default_rng(1)
    shoe = rng.uniform(0, 0.2, (30, 3)) * (1, 0.5, 1)
    shoe[:5, 1] = 0
    still = np.repeat(shoe[None], 24, axis=0)
    assert_feet_hold(np.concatenate([still] * 5, axis=1), 0.0)
    for fault in ((0.003, 0, 0), (0, 0.002, 0), (0, -0.002, 0)):
        with pytest.raises(AssertionError):
            assert_feet_hold(still + np.arange(24)[:, None, None] * np.array(fault), 0.0)


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_feet_hold_in_blender(run, tmp_path):
    layer, output = tmp_path / "whole.usda", tmp_path / "shoes.npz"
    chosen = sorted((track for track in run if track.agent.kind == "person"), key=len)[-PEOPLE:]
    write_traffic_layer(tmp_path / "traffic.usdc", replace(run, tracks=tuple(chosen)))
    layer.write_text(WHOLE)
    people = {track.agent.name: track for track in chosen}
    spans = []
    for name, track in people.items():
        frames = track.time_s[[0, -1]] * FRAMES_PER_SECOND
        spans += [name, str(int(np.ceil(frames[0]))), str(int(np.floor(frames[1])))]
    script = Path(__file__).with_name("blender_shoes_dump.py")
    subprocess.run(
        [sys.executable, str(script), str(layer), str(output), *spans], check=True, capture_output=True, timeout=600
    )
    shoes = np.load(output)
    assert set(shoes) == set(people)
    for name, track in people.items():
        assert_feet_hold(shoes[name], float(track.y_m[0]))
        # and they are under the person
        middle = shoes[name][:, :, [0, 2]].mean(axis=1)
        times = np.arange(int(np.ceil(track.time_s[0] * FRAMES_PER_SECOND)), 10**6)[: len(middle)] / FRAMES_PER_SECOND
        assert np.abs(middle - track.at(times)[:, [0, 2]]).max() < 0.5


@pytest.mark.skipif(not (find_browser() and find_three()), reason="no Chromium on the path, or no three.js")
def test_feet_hold_in_three(run, tmp_path):
    track = max((track for track in run if track.agent.kind == "person"), key=len)
    gait, (_, figure, factor) = gait_of(track), figure_of(track.agent)
    times, yaws = gait.frames / FRAMES_PER_SECOND, gait.yaw_rad + np.pi
    places = track.at(np.clip(times, *track.time_s[[0, -1]]))[:, :3]
    figure = figure._replace(height_m=figure.height_m * factor)
    motion = walked(figure.skeleton, times, places[:, [0, 2]], yaws)
    walker = Walker("Person", figure, places, yaws, motion)
    (tmp_path / "walker.glb").write_bytes(walkers_glb([walker], times))
    found = load_in_three(tmp_path / "walker.glb", tmp_path, page="walkers.html")
    assert found["complaints"] == []
    assert_feet_hold(np.array(found["points"]), float(track.y_m[0]))
