"""Prediction tasks of tracks: what is past and what is asked for, in a table and in files of ScenarioNet."""

import pickle

import numpy as np
import pandas as pd
import pytest
from click.testing import CliRunner
from support.hand_made_tracks import hand_made
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.maps.prediction_tasks import prediction_tasks, write_prediction_scenarios, write_prediction_table
from garage2usd.track_forms import write_predictions, write_tracks

PAST, FUTURE = 20, 60


@pytest.fixture(scope="module")
def garage():
    return garage_as_made(garage2usd.generate(SMALL_LEVELS), source="garage", kind="plan")


@pytest.fixture(scope="module")
def tracks(garage):
    return hand_made(garage)


@pytest.fixture(scope="module")
def tasks(tracks):
    return prediction_tasks(tracks)


def test_targets_are_there_for_eight_seconds_and_move(tracks, tasks):
    by_name = {track.agent.name: track for track in tracks}
    assert len(tasks) > 20
    asked = set()
    for task in tasks:
        assert task.time_s % 2.0 == pytest.approx(0.0, abs=1e-6)
        for name in task.targets:
            track = by_name[name]
            assert track.time_s[0] <= task.time_s - 2.0 + 1e-6
            assert track.time_s[-1] >= task.time_s + 6.0 - 1e-6
            places = track.at(task.time_s + np.arange(0.0, 6.05, 0.1) - 1e-9)
            assert np.hypot(*np.diff(places[:, [0, 2]], axis=0).T).sum() > 0.99
        asked |= {*task.targets}
    assert asked >= {"car_000", "car_001", "person_000"}


def test_the_table_has_the_tracks_of_each_task(tracks, tasks, tmp_path):
    write_prediction_table(tmp_path / "tasks.parquet", tasks)
    table = pd.read_parquet(tmp_path / "tasks.parquet")
    by_name = {track.agent.name: track for track in tracks}
    assert table.groupby("task").size().index.tolist() == list(range(len(tasks)))
    for (number, name), rows in table.groupby(["task", "agent"]):
        task = tasks[number]
        assert rows.is_target.eq(name in task.targets).all()
        times = rows.time_s + rows.step * 0.1
        x, y, z, yaw, _ = by_name[name].at(times.to_numpy()).T
        there = np.isfinite(x)  # ends may differ in the last digit
        assert rows.x_m.to_numpy()[there] == pytest.approx(x[there], abs=1e-3)
        assert rows.y_m.to_numpy()[there] == pytest.approx(-z[there], abs=1e-3)
        assert rows.z_m.to_numpy()[there] == pytest.approx(y[there], abs=1e-3)
        ahead = np.stack([np.cos(rows.heading_rad), np.sin(rows.heading_rad)])
        assert ahead[:, there] == pytest.approx(np.stack([-np.sin(yaw), np.cos(yaw)])[:, there], abs=1e-3)
        if name in task.targets:
            assert rows.step.tolist() == list(range(-PAST, FUTURE + 1))


def test_scenarios_are_those_that_scenario_net_reads(garage, tasks, tmp_path):
    files = write_prediction_scenarios(tmp_path / "base", tasks[:5], garage)
    summary = pickle.loads((tmp_path / "base" / "dataset_summary.pkl").read_bytes())  # noqa: S301 - our own
    mapping = pickle.loads((tmp_path / "base" / "dataset_mapping.pkl").read_bytes())  # noqa: S301
    assert len(files) == 7
    assert [*summary] == [*mapping] == sorted(summary)
    for task, (file, metadata) in zip(tasks, summary.items(), strict=False):
        scenario = pickle.loads((tmp_path / "base" / file).read_bytes())  # noqa: S301
        assert scenario["metadata"] == metadata | {"ts": scenario["metadata"]["ts"]}
        assert scenario["length"] == PAST + FUTURE + 1 == len(scenario["metadata"]["ts"])
        assert metadata["current_time_index"] == PAST
        assert set(metadata["tracks_to_predict"]) == {*task.targets}
        for name, asked in metadata["tracks_to_predict"].items():
            assert list(scenario["tracks"])[asked["track_index"]] == asked["track_id"] == name
            state = scenario["tracks"][name]["state"]
            assert state["valid"].all()
            assert state["position"].shape == (PAST + FUTURE + 1, 3)
        assert metadata["sdc_id"] in task.targets


def test_the_command_writes_tasks_of_tracks(garage, tracks, tmp_path):
    settings = tmp_path / "g.toml"
    settings.write_text("[site]\nwidth_cells = 5\nheight_cells = 5\n[plan]\nepisodes = 30\n")
    built = garage2usd.build(garage2usd.load_config(settings), tmp_path / "g.usdc")
    write_tracks(tmp_path / "run.parquet", tracks, garage)
    arguments = ["traffic", str(built.stage), "--tracks", str(tmp_path / "run.parquet")]
    said = CliRunner().invoke(main, [*arguments, "--predictions", str(tmp_path / "tasks.parquet")])
    assert said.exit_code == 0, said.output
    assert "prediction tasks" in said.output
    assert len(pd.read_parquet(tmp_path / "tasks.parquet").task.unique()) == len(prediction_tasks(tracks))
    refused = CliRunner().invoke(main, [*arguments, "--minutes", "3"])
    assert "only without --tracks" in refused.output
    (tmp_path / "there").mkdir()
    with pytest.raises(ConfigError, match="a new folder"):
        write_predictions(tmp_path / "there", tracks, garage)
