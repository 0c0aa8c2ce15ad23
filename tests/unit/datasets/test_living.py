"""Garages of a data set in operation: their tracks, figures, prediction tasks, and drives in the traffic."""

import io
import json
import zipfile

import numpy as np
import pandas as pd
import pytest
from support.data_sets import LIDAR, small_recipe, tree_of
from support.sample_files import REPOSITORY

from garage2usd.common.errors import ConfigError
from garage2usd.datasets import load_recipe
from garage2usd.datasets.plans import planned
from garage2usd.datasets.shards import make_shard, shards_of
from garage2usd.datasets.verification import _of_tracks
from garage2usd.maps.track_tables import read_tracks
from garage2usd.traffic.encounters import encounters

SCANNER = {**LIDAR, "columns": 60, "rows": 12}
DRIVES = {"rig": {"name": "scanner", "sensors": [SCANNER]}, "every_s": 1.0, "longest_s": 6.0, "points": ["npz"]}
GARAGE = {
    "site": {"width_cells": 6, "height_cells": 5},
    "plan": {"episodes": 60, "climb": False},
    "parking": {"occupancy": 0.6},
    "traffic": {"minutes": 2.0, "arrivals_per_hour": {"range": [150, 250]}},
}
MAKE = {"traffic": {"predictions": True}, "drives": DRIVES, "difficulty": False, "plan": False}


def made_in(folder):
    recipe = small_recipe(garage=GARAGE, count=1, splits={"all": 1}, shards={"garages": 1, "form": "folder"}, make=MAKE)
    (shard,) = shards_of(recipe, planned(recipe, [(0, 0)]))
    (row,) = make_shard(recipe, folder, shard)
    return row, folder / "shards" / row.key


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return made_in(tmp_path_factory.mktemp("living"))


def test_rows_have_the_figures_of_the_tracks(made):
    row, place = made
    assert not row.error
    tracks = read_tracks(place.with_name(f"{place.name}.tracks.parquet"))
    assert tracks.source == f"{place.name}.usdc"
    assert tracks.duration_s == 120.0
    assert row.arrivals == tracks.facts["arrivals"] > 0
    assert (row.departures, row.walks) == (tracks.facts["departures"], tracks.facts["walks"])
    met = encounters(tracks)
    assert (row.encounters, row.waits) == (met.encounters, met.waits)
    assert row.least_ttc_s == pytest.approx(met.least_ttc_s if np.isfinite(met.least_ttc_s) else -1.0, abs=1e-3)
    tasks = pd.read_parquet(place.with_name(f"{place.name}.predictions.parquet"))
    assert tasks[tasks.is_target].groupby("task").size().min() >= 81


def test_drives_are_those_of_cars_in_the_traffic(made):
    _, place = made
    tracks = read_tracks(place.with_name(f"{place.name}.tracks.parquet"))
    with zipfile.ZipFile(place.with_name(f"{place.name}.drive_0.zip")) as archive:
        table = json.loads(archive.read("frames.json"))
        ego = next(track for track in tracks if track.agent.name == table["traffic"]["ego"])
        assert table["traffic"]["agents"]
        for sweep in table["sweeps"]:
            x, z = ego.at(np.array([sweep["time_s"]]))[0, [0, 2]]
            place_m = np.array(sweep["vehicle_to_world"])[[0, 2], 3]
            assert np.hypot(*(place_m - (x, z))) < ego.agent.rear_axle_m + 0.01
            with np.load(io.BytesIO(archive.read(sweep["files"]["npz"]))) as cloud:
                assert len(cloud["time_s"]) == len(cloud["points_m"]) > 0


def test_verification_reads_the_tracks(made, tmp_path):
    row, place = made
    stage = tmp_path / f"{place.name}.usdc"
    assert list(_of_tracks(stage, row)) == []
    table = stage.with_name(f"{stage.stem}.tracks.parquet")
    table.write_bytes(place.with_name(table.name).read_bytes())
    assert list(_of_tracks(stage, row)) == []
    (other,) = _of_tracks(stage, row.model_copy(update={"arrivals": row.arrivals + 1}))
    assert "other arrivals" in other.what
    table.write_bytes(b"PAR1")
    (damaged,) = _of_tracks(stage, row)
    assert "tracks cannot be read" in damaged.what


@pytest.mark.soak
def test_a_garage_in_operation_has_the_same_bytes_when_made_again(made, tmp_path):
    row, place = made
    again, _ = made_in(tmp_path)
    assert again == row
    assert tree_of(tmp_path) == tree_of(place.parents[2])


def test_the_recipe_of_the_samples_is_valid_and_others_are_named(tmp_path):
    recipe = load_recipe(REPOSITORY / "samples" / "recipes" / "living.toml")
    assert recipe.count == 12
    assert recipe.make.traffic.predictions
    wrong = tmp_path / "wrong.toml"
    for make, said in (
        ("stage = false\ntraffic = {}", "stage = true"),
        ("traffic = { forms = ['csv', 'csv'] }", "once"),
    ):
        wrong.write_text(f"name = 'wrong'\n[make]\n{make}\n")
        with pytest.raises(ConfigError, match=said):
            load_recipe(wrong)
