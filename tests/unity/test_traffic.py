"""Tracks played by `GarageTraffic`: where objects stand and how they look, compared with the tracks themselves."""

import json

import numpy as np
import pytest
from support.hand_made_tracks import hand_made
from support.small_levels import SMALL_LEVELS
from support.unity.layer import from_usd

from garage2usd import build
from garage2usd.driving.tracks import AgentState
from garage2usd.garage_sources import read_built
from garage2usd.track_forms import write_tracks

NEAR_M = 1e-3
NEAR_RAD = 1e-3


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A garage of levels with its tracks as CSV and over its stage: the stages without and with the layer, and both."""
    folder = tmp_path_factory.mktemp("traffic")
    built = build(SMALL_LEVELS, folder / "garage.usdc")
    garage = read_built(built.stage).garage
    tracks = hand_made(garage)
    write_tracks(folder / "run.csv", tracks, garage)
    write_tracks(folder / "run.usdc", tracks, garage)
    over = folder / "over.usda"
    over.write_text(
        '#usda 1.0\n(\n    defaultPrim = "Garage"\n    metersPerUnit = 1\n    upAxis = "Y"\n'
        "    subLayers = [@./run.usdc@, @./garage.usdc@]\n)\n"
    )
    return built.stage, over, folder / "run.csv", tracks.rounded()


def times_of(tracks):
    """Samples, times between them, and times at which agents come or go."""
    random = np.random.default_rng(4)
    ends = [end for track in tracks for end in (track.time_s[0], track.time_s[-1])]
    rows = [time for track in tracks for time in random.choice(track.time_s, 6)]
    return np.sort(np.concatenate([ends, rows, random.uniform(0, tracks.duration_s, 40), [tracks.duration_s]]))


def nose(yaw, pitch):
    """Directions of the nose, in Unity's axes."""
    return from_usd(np.stack([-np.sin(yaw) * np.cos(pitch), np.sin(pitch), -np.cos(yaw) * np.cos(pitch)], axis=-1))


def played(prefab_dump, stage, table, times):
    answer = prefab_dump.ask("traffic", stage, table, *times)
    assert "crash" not in answer, answer["crash"]
    return answer


def assert_on_tracks(answer, tracks, times):
    for track in tracks:
        agent, steps = track.agent, [step[track.agent.name] for step in answer["steps"]]
        there = np.array([step["there"] for step in steps])
        x, y, z, yaw, pitch = track.at(times).T
        assert (there == ~np.isnan(x)).all()
        ahead = nose(yaw, pitch)[there]
        middle = from_usd(np.stack([x, y, z], axis=1))[there]
        found = {key: np.array([step[key] for step in steps])[there] for key in ("position", "forward", "up")}
        assert np.abs(found["position"] - (middle - agent.rear_axle_m * ahead)).max() < NEAR_M
        assert np.abs(found["forward"] - ahead).max() < NEAR_RAD
        assert np.abs(found["up"] - nose(yaw, pitch + np.pi / 2)[there]).max() < NEAR_RAD
        assert {step["label"] for step in steps} == {agent.kind}
        if agent.wheelbase_m:
            wheels = {key: np.array([step[key] for step in steps])[there] for key in ("axle", "spoke", "hub")}
            steer = np.interp(times, track.time_s, track.steering_rad)[there]
            across = np.stack([np.cos(steer), 0 * steer, np.sin(steer)], axis=1)
            assert np.abs(wheels["axle"] - across).max() < NEAR_RAD
            # metres as the speed tells them, of which the path at the samples is a little less
            rolled = np.interp(times, track.time_s, rolled_of(track))[there] / wheels["hub"][:, 1]
            fore = np.stack([-np.sin(steer), 0 * steer, np.cos(steer)], axis=1)
            spoke = np.cos(rolled)[:, None] * [0, 1, 0] + np.sin(rolled)[:, None] * fore
            assert np.abs(wheels["spoke"] - spoke).max() < 0.02
    instances = [step["instance"] for step in answer["steps"][0].values()]
    assert len(set(instances)) == len(tracks)


def rolled_of(track):
    """Metres along the heading, by the middle of the rear axle's steps as those of the middle of the footprint."""
    places = np.stack([track.x_m, track.y_m, track.z_m], axis=1)
    steps = np.diff(places, axis=0)
    middle = (track.yaw_rad[1:] + track.yaw_rad[:-1]) / 2
    along = steps[:, 0] * -np.sin(middle) + steps[:, 2] * -np.cos(middle)
    return np.concatenate([[0], np.cumsum(np.sign(along) * np.linalg.norm(steps, axis=1))])


def test_plain_figures_stand_where_the_tracks_say(prefab_dump, run):
    stage, _, table, tracks = run
    times = times_of(tracks)
    answer = played(prefab_dump, stage, table, times)
    assert_on_tracks(answer, tracks, times)
    for track in tracks:
        agent = track.agent
        steps = [(time, step[agent.name]) for time, step in zip(times, answer["steps"], strict=True)]
        for time, step in steps:
            x, y, z, yaw, pitch = track.at(np.array([time]))[0]
            # turned wheels reach out of the body
            steer = np.interp(time, track.time_s, track.steering_rad)
            if not step["there"] or abs(pitch) > 1e-6 or abs(steer) > 1e-3:
                continue
            reach = agent.length_m / 2 if agent.wheelbase_m else agent.width_m / 2
            half = np.abs([np.sin(yaw) * reach, np.cos(yaw) * reach])
            half += np.abs([np.cos(yaw) * agent.width_m / 2, np.sin(yaw) * agent.width_m / 2])
            low = np.array(step["low"])
            assert low[[0, 2]] == pytest.approx([x - half[0], -z - half[1]], abs=2e-3)
            # the box around a wheel that rolls, of 0.2 of the height, reaches below it
            assert y - 0.09 * agent.height_m < low[1] < y + 2e-3
            assert np.array(step["high"]) == pytest.approx([x + half[0], y + agent.height_m, -z + half[1]], abs=2e-3)


def test_parked_cars_that_move_are_hidden_while_it_plays(prefab_dump, run):
    stage, _, table, tracks = run
    (staged,) = (track.agent for track in tracks if track.agent.prim)
    answer = played(prefab_dump, stage, table, [0.0])
    hidden = {name for name, is_shown in answer["shown"].items() if not is_shown}
    number = staged.prim.rpartition("_")[2]
    assert hidden == {staged.prim, f"{staged.prim.rpartition('/')[0]}/NumberPlate_{number}"}
    assert len(answer["shown"]) > 10
    assert answer["left"] == 0


def test_the_models_of_the_layer_are_played_where_it_was_imported(prefab_dump, run):
    _, over, table, tracks = run
    times = times_of(tracks)
    answer = played(prefab_dump, over, table, times)
    assert_on_tracks(answer, tracks, times)
    for step in answer["steps"]:
        assert not any("low" in agent for agent in step.values()), "a plain figure instead of the model"
    (walker,) = (track for track in tracks if track.agent.kind == "person")
    for time, step in zip(times, answer["steps"], strict=True):
        told = step[walker.agent.name]
        # a figure that walks and one that stands, where the layer has both
        if told["there"] and "walking" in told:
            before = np.searchsorted(walker.time_s, time + 1e-9, side="right") - 1
            walks = walker.state[before] == AgentState.WALKS
            assert (told["walking"], told["standing"]) == (walks, not walks)


DAMAGES = {
    "1 of 2 samples": lambda rows, heading: (rows[:-1], heading),
    "cells": lambda rows, heading: ([*rows[:-1], rows[-1].rpartition(",")[0]], heading),
    "is no number": lambda rows, heading: ([rows[0], rows[1].replace("0.25", "a"), rows[2]], heading),
    "times of an agent do not ascend": lambda rows, heading: ([rows[0], rows[2], rows[1]], heading),
    "is no agent of the tracks": lambda rows, heading: (rows, {**heading, "agents": []}),
    "has no column level": lambda rows, heading: ([rows[0].replace("level", "storey"), *rows[1:]], heading),
    "the form of the tracks is 2, not 1": lambda rows, heading: (rows, {**heading, "form": 2}),
    "a text does not end": lambda rows, heading: ([*rows[:2], '"a'], heading),
}
HEADER = '"agent","time_s","x_m","y_m","z_m","yaw_rad","pitch_rad","speed_m_s","steering_rad","state","level","stall"'


@pytest.mark.parametrize("message", DAMAGES)
def test_damaged_tracks_are_named(prefab_dump, tmp_path, message):
    (tmp_path / "a.usda").write_text('#usda 1.0\ndef Xform "Garage" {}\n')
    name = 'car ""1"", ö'
    rows = [HEADER, f'"{name}",0,0.25,0,0,0,0,0,0,"parked",0,"a"', f'"{name}",1,0.25,0,0,0,0,0,0,"parked",0,"a"']
    agent = {"name": 'car "1", ö', "kind": "car", "width_m": 1.8, "prim": ""}
    heading = {"form": 1, "samples": 2, "duration_s": 1.0, "facts": {"a": [1, {"b": None}]}, "agents": [agent]}

    def ask(rows, heading):
        (tmp_path / "a.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
        (tmp_path / "a.json").write_text(json.dumps(heading), encoding="utf-8")
        return prefab_dump.ask("traffic", tmp_path / "a.usda", tmp_path / "a.csv", 0.5)

    assert ask(rows, heading)["steps"][0][agent["name"]]["position"] == [0.25, 0, 0]
    assert message in ask(*DAMAGES[message](rows, heading))["crash"]
