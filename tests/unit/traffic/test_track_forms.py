"""Tracks in each form, read back by a program or schema that is not ours, and compared with the tracks."""

import math
import pickle
import xml.etree.ElementTree as ET
from dataclasses import replace
from operator import attrgetter

import numpy as np
import pytest
from pxr import Sdf
from support.hand_made_tracks import hand_made, tracks_of
from support.map_judges import HAS_JUDGES, sumo_schema_faults
from support.openscenario_checker import issues_of, needs_checker
from support.openscenario_reader import positions
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import body_named
from garage2usd.driving.tracks import Agent, AgentClass, AgentState
from garage2usd.track_forms import TRACK_SUFFIXES, write_tracks


@pytest.fixture(scope="module")
def garage():
    return garage_as_made(garage2usd.generate(SMALL_LEVELS), source="garage", kind="plan")


@pytest.fixture(scope="module")
def tracks(garage):
    return hand_made(garage)


@pytest.fixture(scope="module")
def written(garage, tracks, tmp_path_factory):
    folder = tmp_path_factory.mktemp("forms")
    return {suffix: write_tracks(folder / f"run{suffix}", tracks, garage) for suffix in TRACK_SUFFIXES}


def named(tracks, name):
    return next(track for track in tracks if track.agent.name == name)


def nose(yaw, pitch):
    """Direction of the nose in the map's frame: east, north, up."""
    return np.stack([-np.sin(yaw) * np.cos(pitch), np.cos(yaw) * np.cos(pitch), np.sin(pitch)], axis=-1)


def test_each_form_is_whole_and_has_its_files_beside_it(written, garage, tracks, tmp_path):
    names = {suffix: sorted(file.suffix for file in files) for suffix, files in written.items()}
    assert names.pop(".csv") == [".csv", ".json"]
    assert names.pop(".xosc") == [".xodr", ".xosc"]
    assert names.pop(".fcd.xml") == [".xml", ".xml"]
    assert all(len(files) == 1 for files in names.values())
    for suffix, files in written.items():
        assert files[0].name == f"run{suffix}"
        again = write_tracks(tmp_path / f"RUN{suffix.upper()}", tracks, garage)
        assert again[0].name == f"RUN{suffix.upper()}"
        if suffix != ".xosc":  # which names its map
            assert again[0].read_bytes() == files[0].read_bytes()


@pytest.mark.parametrize("name", ["run.txt", "run.xml", ".csv", "run"])
def test_other_extensions_are_one_line(name, garage, tracks, tmp_path):
    with pytest.raises(ConfigError, match=r"^output: got .*; allowed: a path that ends in \.parquet, \.csv, \.usda"):
        write_tracks(tmp_path / name, tracks, garage)
    assert not [*tmp_path.iterdir()]


def test_a_form_that_fails_leaves_nothing(garage, tracks, tmp_path, monkeypatch):
    monkeypatch.setattr("garage2usd.maps.openscenario.write_traffic_scenario", lambda *_, **__: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        write_tracks(tmp_path / "a.xosc", tracks, garage)
    assert not [*tmp_path.iterdir()]


def test_vertices_of_the_scenario_lie_on_the_tracks(written, tracks):
    root = ET.parse(written[".xosc"][0]).getroot()
    assert (root.find("FileHeader").get("revMajor"), root.find("FileHeader").get("revMinor")) == ("1", "3")
    groups = {group.get("name"): group for group in root.iter("ManeuverGroup")}
    assert [*groups] == [track.agent.name for track in tracks]
    for track in tracks:
        group = groups[track.agent.name]
        (line,) = group.iter("Polyline")
        times = np.array([float(vertex.get("time")) for vertex in line.findall("Vertex")])
        found = np.array(positions(line))
        assert times[[0, -1]] == pytest.approx(track.time_s[[0, -1]])
        # at all samples, between the vertices too
        between = np.stack([np.interp(track.time_s, times, column) for column in found.T], axis=1)
        heading, pitch = between[:, 3], -between[:, 4]
        ahead = np.stack([np.cos(heading) * np.cos(pitch), np.sin(heading) * np.cos(pitch), np.sin(pitch)], axis=1)
        middle = between[:, :3] + track.agent.rear_axle_m * ahead
        expected = np.stack([track.x_m, -track.z_m, track.y_m], axis=1)
        assert np.abs(middle - expected).max() < 4e-3
        assert (ahead * nose(track.yaw_rad, track.pitch_rad)).sum(axis=1).min() > math.cos(math.radians(0.1))
        comes, leaves = (group.findall(f".//{action}") for action in ("AddEntityAction", "DeleteEntityAction"))
        assert len(comes) == (track.time_s[0] > 0)
        assert len(leaves) == (track.time_s[-1] < tracks.duration_s)
    assert {entity.get("name") for entity in root.iter("ScenarioObject")} > set(groups)
    assert len([*root.iter("Pedestrian")]) == 1
    # the cars of the stage but that which moves
    assert len([*root.iter("Vehicle")]) == 3 + 15 - 1


@needs_checker
def test_asam_finds_nothing_in_the_scenario(written, tmp_path):
    assert issues_of(written[".xosc"][0], tmp_path) == []


OSI_VALUES = [
    attrgetter(f"{name}.{part}")
    for name, parts in (
        ("position", "xyz"),
        ("orientation", ("yaw", "pitch")),
        ("velocity", "xyz"),
        ("acceleration", "xyz"),
    )
    for part in parts
]


def test_asam_s_utilities_read_the_trace_back_equal(written, tracks):
    from osi_utilities.tracefile.readers.multi import MultiTraceReader

    with MultiTraceReader() as reader:
        assert reader.open(written[".mcap"][0])
        messages = [result.message for result in reader]
    assert len(messages) == round(tracks.duration_s / tracks.step_s) + 1
    assert messages[0].version.version_major == 3
    times = np.array([message.timestamp.seconds + message.timestamp.nanos * 1e-9 for message in messages])
    assert np.diff(times) == pytest.approx(tracks.step_s)
    assert {moving.id.value for message in messages for moving in message.moving_object} == {*range(1, len(tracks) + 1)}
    for number, track in enumerate(tracks, 1):
        rows = [
            (time, moving)
            for time, message in zip(times.tolist(), messages, strict=True)
            for moving in message.moving_object
            if moving.id.value == number
        ]
        own = np.array([time for time, _ in rows])
        assert own[[0, -1]] == pytest.approx(track.time_s[[0, -1]])
        assert len(own) == round((track.time_s[-1] - track.time_s[0]) / tracks.step_s) + 1
        base = [moving.base for _, moving in rows]
        told = np.array([[read(one) for read in OSI_VALUES] for one in base])
        x, y, z, yaw, pitch = track.at(own).T
        places = np.stack([x, -z, y + track.agent.height_m / 2], axis=1)
        ahead = nose(yaw, pitch)
        speed, rate = (np.interp(own, track.time_s, column) for column in (track.speed_m_s, track.acceleration_m_s2))
        before = np.searchsorted(track.time_s, own + 1e-9, side="right") - 1
        stands = np.isin(track.state[before], (AgentState.PARKED, AgentState.STANDS))
        speed[stands] = rate[stands] = 0
        heading = np.angle(np.exp(1j * (yaw + np.pi / 2)))
        expected = [*places.T, heading, -pitch, *(ahead * speed[:, None]).T, *(ahead * rate[:, None]).T]
        off = told - np.stack(expected, axis=1)
        off[:, 3] = np.angle(np.exp(1j * off[:, 3]))
        # equal to the last decimal that is written
        assert np.abs(off).max() < 5.1e-6
        assert np.abs(told[:, 3]).max() <= math.pi + 1e-5
        # velocities are rates of the places
        rates = np.gradient(told[:, :3], own, axis=0)
        assert np.median(np.linalg.norm(told[:, 5:8] - rates, axis=1)) < 0.02
        moving = rows[0][1]
        assert moving.source_reference[0].identifier[0] == track.agent.name
        kind = "TYPE_PEDESTRIAN" if track.agent.kind == "person" else "TYPE_VEHICLE"
        assert moving.type == moving.Type.Value(kind)
        if kind == "TYPE_VEHICLE":
            axle = moving.vehicle_attributes.bbcenter_to_rear
            wheel = body_named(track.agent.body).wheel_radius_m
            assert (axle.x, axle.z) == pytest.approx((-track.agent.rear_axle_m, wheel - track.agent.height_m / 2))


def test_floating_car_data_have_fronts_and_angles_from_north(written, tracks):
    root = ET.parse(written[".fcd.xml"][0]).getroot()
    assert root.tag == "fcd-export"
    assert [float(step.get("time")) for step in root] == [*range(int(tracks.duration_s) + 1)]
    for track in tracks:
        tag = "person" if track.agent.kind == "person" else "vehicle"
        rows = [
            (float(step.get("time")), one)
            for step in root
            for one in step.iter(tag)
            if one.get("id") == track.agent.name
        ]
        assert len(rows) == math.floor(track.time_s[-1] + 1e-6) - math.ceil(track.time_s[0] - 1e-6) + 1
        x, y, z, yaw, pitch = track.at(np.array([time for time, _ in rows])).T
        found = {
            name: np.array([float(one.get(name)) for _, one in rows]) for name in ("x", "y", "z", "angle", "slope")
        }
        ahead = 0.0 if tag == "person" else track.agent.length_m / 2
        expected = np.stack([x, -z, y], axis=1) + ahead * nose(yaw, pitch)
        assert np.stack([found["x"], found["y"], found["z"]], axis=1) == pytest.approx(expected, abs=1e-3)
        north = np.radians(found["angle"])
        heading = np.stack([np.sin(north), np.cos(north)], axis=1)
        level = nose(yaw, np.zeros(len(yaw)))[:, :2]
        assert heading == pytest.approx(level, abs=1e-4)
        assert found["slope"] == pytest.approx(np.degrees(pitch), abs=1e-2)


@pytest.mark.client
@pytest.mark.skipif(not HAS_JUDGES, reason="no environment with SUMO")
def test_sumo_s_schema_takes_floating_car_data(written, tmp_path):
    file = written[".fcd.xml"][0]
    assert sumo_schema_faults(file, "fcd_file.xsd", tmp_path) == [""]
    (tmp_path / "b.xml").write_text(file.read_text().replace(' speed="', ' quick="', 1))
    assert "quick" in sumo_schema_faults(tmp_path / "b.xml", "fcd_file.xsd", tmp_path)[0]


def test_the_dictionary_of_scenario_net_is_whole(written, tracks, garage):
    """The rules of MetaDrive's ``ScenarioDescription.sanity_check``."""
    scenario = pickle.loads(written[".pkl"][0].read_bytes())  # noqa: S301 - our own
    assert {"tracks", "version", "id", "dynamic_map_states", "map_features", "length", "metadata"} <= set(scenario)
    length = scenario["length"]
    assert scenario["metadata"]["ts"].shape == (length,)
    assert scenario["metadata"]["coordinate"] == "metadrive"
    assert scenario["metadata"]["sdc_id"] in {"car_000", "car_001"}
    for track in tracks:
        told = scenario["tracks"][track.agent.name]
        state, valid = told["state"], told["state"]["valid"]
        assert told["metadata"]["object_id"] == track.agent.name
        assert all(len(column) == length for column in state.values())
        assert valid.sum() == pytest.approx((track.time_s[-1] - track.time_s[0]) / 0.1 + 1)
        assert all(np.abs(column[~valid]).sum() == 0 for column in state.values())
        x, y, z, yaw, _ = track.at(scenario["metadata"]["ts"].astype(float).round(3)[valid]).T
        assert state["position"][valid] == pytest.approx(np.stack([x, -z, y], axis=1), abs=1e-4)
        heading = np.stack([np.cos(state["heading"]), np.sin(state["heading"])], axis=1)[valid]
        assert heading == pytest.approx(nose(yaw, np.zeros(len(yaw)))[:, :2], abs=1e-4)
    features = scenario["map_features"]
    assert len(features) == len(garage.lanes.arcs)
    for feature in features.values():
        assert feature["polyline"].shape == (2, 3)
        assert all(
            features[name]["polyline"][0] == pytest.approx(feature["polyline"][1]) for name in feature["exit_lanes"]
        )


def test_a_layer_and_a_table_are_read_by_their_readers(written, tracks):
    assert Sdf.Layer.FindOrOpen(str(written[".usda"][0])).GetPrimAtPath("/Garage/Traffic/car_000")
    assert Sdf.Layer.FindOrOpen(str(written[".usdc"][0])).GetPrimAtPath("/Garage/Traffic/car_000")
    from garage2usd.maps.track_tables import read_tracks

    for suffix in (".parquet", ".csv"):
        assert len(read_tracks(written[suffix][0])) == len(tracks)


def test_each_form_but_layers_carries_class_and_behaviour(garage, tracks, tmp_path):
    """A child that runs, a trolley that rolls, and a car that drives the wrong way; a car of each class."""
    person, trolley = (
        named(tracks, "person_000"),
        Agent("trolley", AgentClass.TROLLEY, 0.9, 0.6, 1.0, behaviour="rolls"),
    )
    child = replace(person, agent=replace(person.agent, name="child", height_m=1.2, behaviour="runs"))
    car = named(tracks, "car_000")
    wrong = replace(car, agent=replace(car.agent, name="wrong", behaviour="wrong_way"))
    large = [
        replace(car, agent=replace(car.agent, name=kind, kind=AgentClass(kind), body="")) for kind in ("van", "truck")
    ]
    busy = tracks_of(person, child, replace(person, agent=trolley), wrong, *large)
    files = {
        suffix: write_tracks(tmp_path / f"run{suffix}", busy, garage)
        for suffix in (".xosc", ".fcd.xml", ".mcap", ".pkl")
    }
    agents = {track.agent.name: track.agent for track in busy}

    entities = {one.get("name"): one[0] for one in ET.parse(files[".xosc"][0]).getroot().iter("ScenarioObject")}
    tags = {name: entities[name].tag for name in agents}
    assert tags == dict.fromkeys(agents, "Vehicle") | {
        "person_000": "Pedestrian",
        "child": "Pedestrian",
        "trolley": "MiscObject",
    }
    assert [entities[name].get("vehicleCategory") for name in ("wrong", "van", "truck")] == ["car", "van", "truck"]
    for name, agent in agents.items():
        told = [one.get("value") for one in entities[name].iter("Property") if one.get("name") == "behaviour"]
        assert told == ([agent.behaviour] if agent.behaviour else [])

    rows = {one.get("id"): one for step in ET.parse(files[".fcd.xml"][0]).getroot() for one in step}
    assert {name: row.tag for name, row in rows.items()} == dict.fromkeys(agents, "vehicle") | {
        "person_000": "person",
        "child": "person",
        "trolley": "container",
    }
    types = {one.get("id"): one.attrib for one in ET.parse(files[".fcd.xml"][1]).getroot()}
    assert {row.get("type") for row in rows.values()} == set(types)
    assert {name: types[row.get("type")]["vClass"] for name, row in rows.items()} == {
        "person_000": "pedestrian",
        "child": "pedestrian",
        "trolley": "container",
        "wrong": "passenger",
        "van": "delivery",
        "truck": "truck",
    }
    assert rows["child"].get("type") == "person.runs"
    assert float(types["person.runs"]["height"]) == 1.2

    from osi_utilities.tracefile.readers.multi import MultiTraceReader

    with MultiTraceReader() as reader:
        assert reader.open(files[".mcap"][0])
        moving = {
            one.source_reference[0].identifier[0]: one for result in reader for one in result.message.moving_object
        }
    assert {name: one.type for name, one in moving.items()} == {
        name: getattr(
            one, {"person": "TYPE_PEDESTRIAN", "shopping_trolley": "TYPE_OTHER"}.get(agents[name].kind, "TYPE_VEHICLE")
        )
        for name, one in moving.items()
    }
    for name, agent in agents.items():
        assert [*moving[name].source_reference[0].identifier] == [name, agent.behaviour][: 1 + bool(agent.behaviour)]

    told = pickle.loads(files[".pkl"][0].read_bytes())["tracks"]  # noqa: S301 - our own
    assert {name: one["type"] for name, one in told.items()} == dict.fromkeys(agents, "VEHICLE") | {
        "person_000": "PEDESTRIAN",
        "child": "PEDESTRIAN",
        "trolley": "OTHER",
    }
    assert {name: (one["metadata"]["class"], one["metadata"]["behaviour"]) for name, one in told.items()} == {
        name: (agent.kind, agent.behaviour) for name, agent in agents.items()
    }


def test_an_empty_garage_is_written_in_each_form(garage, tracks, tmp_path):
    empty = replace(tracks_of(tracks.tracks[0]), tracks=())
    for suffix in TRACK_SUFFIXES:
        assert write_tracks(tmp_path / f"a{suffix}", empty, garage)[0].stat().st_size > 0
