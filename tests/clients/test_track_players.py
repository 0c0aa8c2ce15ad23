"""Tracks in the forms of others, played by the programs for which they are: SUMO's tools, MetaDrive and esmini."""

import json
import math
import os
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.esmini_player import ESMINI, agents_played
from support.hand_made_tracks import driven, staged, track_of, tracks_of, walker
from support.map_judges import HAS_JUDGES, run_sumo_tool, sumo_network, sumo_schema_faults
from support.sample_files import REPOSITORY
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd.driving.tracks import Agent, AgentClass, AgentState
from garage2usd.garage_sources import read_built
from garage2usd.track_forms import write_tracks

METADRIVE = Path(os.environ.get("GARAGE2USD_METADRIVE", REPOSITORY / ".venv/metadrive/bin/python"))
REPLAYED_S = 90.0
pytestmark = pytest.mark.client
needs_sumo = pytest.mark.skipif(not HAS_JUDGES, reason="no environment with SUMO")


def agents(garage):
    """Cars, one of the stage and one that double-parks, a person, a child that runs and a trolley that rolls."""
    taken = {level.place.in_whole(home.name) for level in garage.levels for _, home in level.cars.values() if home}
    free = [stall.name for stall in garage.stalls if stall.takes_cars and stall.name not in taken]
    x, z = garage.lanes.nodes[garage.stalls[0].access].position
    double = driven(garage, "car_001", free[-1], begins_s=20.0, body="saloon", paint="blue")
    child = walker("person_001", (x, z - 1.0), (x + 2.0, z - 1.0), begins_s=8.0, speed_m_s=2.5)
    rolls = np.arange(12.0, 15.05, 0.1)
    trolley = Agent("trolley_000", AgentClass.TROLLEY, 0.9, 0.6, 1.0, behaviour="rolls")
    return tracks_of(
        driven(garage, "car_000", free[0]),
        replace(double, agent=replace(double.agent, behaviour="double_parks")),
        staged(garage),
        walker("person_000", (x - 1.5, z), (x + 1.5, z), begins_s=5.0),
        replace(child, agent=replace(child.agent, height_m=1.2, behaviour="runs")),
        track_of(trolley, rolls, x_m=x + 0.3 * (rolls - 12), z_m=z + 1.0, yaw_rad=-np.pi / 2, state=AgentState.STANDS),
        seed=3,
    )


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The garage's stage, its tracks, and their files by extension."""
    folder = tmp_path_factory.mktemp("players")
    built = garage2usd.build(SMALL_LEVELS, folder / "garage.usdc")
    garage = read_built(built.stage).garage
    tracks = agents(garage)
    names = {".fcd.xml": "run.fcd.xml", ".xosc": "run.xosc", ".pkl": "set/sd_run.pkl"}
    (folder / "set").mkdir()
    files = {suffix: write_tracks(folder / name, tracks, garage) for suffix, name in names.items()}
    return built.stage, tracks, files


def rear_axle(track, times):
    """Map's places of the middle of the rear axle at times, headings and pitches."""
    x, y, z, yaw, pitch = track.at(times).T
    back = track.agent.rear_axle_m
    ahead = np.stack([-np.sin(yaw) * np.cos(pitch), np.cos(yaw) * np.cos(pitch), np.sin(pitch)], axis=1)
    return np.stack([x, -z, y], axis=1) - back * ahead, yaw + math.pi / 2, pitch


@needs_sumo
def test_sumo_s_tools_take_the_floating_car_data(run, tmp_path):
    stage, tracks, files = run
    data, types = files[".fcd.xml"]
    for file, schema in ((data, "fcd_file.xsd"), (types, "additional_file.xsd")):
        assert sumo_schema_faults(file, schema, tmp_path) == [""]
    ids = {track.agent.name: track for track in tracks}
    # in their metres, as SUMO's exporter of traces writes them
    run_sumo_tool("traceExporter.py", "-i", data, "--persons", "--orig-ids", "--gpx-output", "a.gpx", folder=tmp_path)
    traces = {one.findtext("name"): one.findall("trkseg/trkpt") for one in ET.parse(tmp_path / "a.gpx").iter("trk")}
    assert set(traces) == {name for name, track in ids.items() if track.agent.kind is not AgentClass.TROLLEY}
    for name, points in traces.items():
        track = ids[name]
        times = np.array([float(point.findtext("time")) for point in points])
        assert times.tolist() == [*range(math.ceil(track.time_s[0] - 1e-6), math.floor(track.time_s[-1] + 1e-6) + 1)]
        places, heading, pitch = rear_axle(track, times)
        ahead = 0.0 if track.agent.kind is AgentClass.PERSON else track.agent.rear_axle_m + track.agent.length_m / 2
        level = ahead * np.cos(pitch)
        places = places[:, :2] + level[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=1)
        found = np.array([(float(point.get("lon")), float(point.get("lat"))) for point in points])
        assert np.abs(found - places).max() < 2e-3
    # replayed over the garage's network, on whose lanes cars drive
    _, configuration, *_ = garage2usd.export(stage, [tmp_path / "garage.add.xml"])
    network = sumo_network(configuration, tmp_path)
    files = f'<net-file value="{network}"/><additional-files value="{types}"/>'
    (tmp_path / "play.sumocfg").write_text(f"<configuration><input>{files}</input></configuration>")
    run_sumo_tool("fcdReplay.py", "-k", "play.sumocfg", "-f", data, folder=tmp_path)


@pytest.mark.skipif(not METADRIVE.exists(), reason="no environment with MetaDrive")
def test_metadrive_replays_the_dictionary(run, tmp_path):
    _, tracks, files = run
    steps = round(REPLAYED_S / 0.1)
    command = [METADRIVE, Path(__file__).with_name("metadrive_replay.py"), files[".pkl"][0], steps, tmp_path / "a.json"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    told = json.loads((tmp_path / "a.json").read_text())
    assert told["types"]["num_objects_each_type"] == {"VEHICLE": 3, "PEDESTRIAN": 2, "OTHER": 1}
    times = np.arange(1, steps + 1) * 0.1
    for track in tracks:
        rows = [row.get(track.agent.name) for row in told["rows"]]
        x, _, z, yaw, _ = track.at(times).T
        there = ~np.isnan(x)
        is_own = track.agent.name == "car_900"
        if track.agent.kind is AgentClass.TROLLEY:
            assert rows == [None] * steps  # which MetaDrive does not play
            continue
        if not is_own:  # which stays
            assert [row is not None for row in rows] == there.tolist()
        found = np.array([row for row, is_there in zip(rows, there, strict=True) if is_there])
        # its own car moves on by a step of physics
        assert np.abs(found[:, :2] - np.stack([x, -z], axis=1)[there]).max() < (0.1 if is_own else 1e-3)
        off = np.angle(np.exp(1j * (found[:, 2] - yaw[there] - np.pi / 2)))
        assert np.abs(off).max() < (0.05 if is_own else 1e-3)


if ESMINI is not None:

    def test_esmini_plays_all_agents(run, tmp_path):
        _, tracks, files = run
        rows = agents_played(ESMINI, files[".xosc"][0], {track.agent.name for track in tracks}, tmp_path)
        assert set(rows) == {track.agent.name for track in tracks}
        for track in tracks:
            played = rows[track.agent.name]
            times = played[:, 0]
            assert times[[0, -1]] == pytest.approx(track.time_s[[0, -1]], abs=0.11)
            inside = (times >= track.time_s[0]) & (times <= track.time_s[-1])
            places, heading, pitch = rear_axle(track, times[inside])
            assert np.linalg.norm(played[inside, 1:4] - places, axis=1).max() < 5e-3
            # esmini holds headings from vertex to vertex
            off = np.angle(np.exp(1j * (played[inside, 4] - heading)))
            if track.agent.wheelbase_m:
                assert np.abs(np.degrees(off)).max() < 2.5
                assert np.abs(np.angle(np.exp(1j * (played[inside, 5] + pitch)))).max() < 0.05
