"""Drives that are recorded in the garages of a data set."""

import io
import json
import zipfile

import numpy as np
import pytest
from support.data_sets import LIDAR, small_recipe, tree_of

from garage2usd.common.errors import ConfigError
from garage2usd.datasets import load_recipe, make_dataset
from garage2usd.datasets.plans import planned
from garage2usd.datasets.shards import make_shard, shards_of

SCANNER = {**LIDAR, "columns": 100, "rows": 20}
DRIVES = {"rig": {"name": "scanner", "sensors": [SCANNER]}, "count": 2, "every_m": 6.0, "points": ["npz"]}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A shard of two garages with two drives each, and its rows."""
    recipe = small_recipe(splits={"train": 1}, shards={"garages": 2, "form": "folder"}, make={"drives": DRIVES})
    (shard,) = shards_of(recipe, planned(recipe, [(0, 0), (1, 0)]))
    folder = tmp_path_factory.mktemp("drives")
    return recipe, shard, folder, make_shard(recipe, folder, shard)


def test_each_drive_is_one_file_of_what_its_sensors_recorded(made):
    _, _, folder, rows = made
    for row in rows:
        assert not row.error
        assert {"drive_0.zip", "drive_1.zip"} < {file.suffix.removeprefix(".") for file in row.files}
        garage = folder / "shards" / row.key
        stalls = {
            entry["stall"]: entry
            for entry in json.loads(garage.with_name(f"{garage.name}.difficulty.json").read_text())["stalls"]
        }
        driven = []
        for number in range(2):
            with zipfile.ZipFile(garage.with_name(f"{garage.name}.drive_{number}.zip")) as archive:
                table = json.loads(archive.read("frames.json"))
                assert table["stage"] == f"{garage.name}.usdc"
                assert table["rig"]["name"] == "scanner"
                places = np.array([sweep["distance_m"] for sweep in table["sweeps"]])
                assert len(places) > 2
                assert np.diff(places)[:-1] == pytest.approx(DRIVES["every_m"], abs=1e-3)
                for sweep in table["sweeps"]:
                    with np.load(io.BytesIO(archive.read(sweep["files"]["npz"]))) as cloud:
                        assert 0 < len(cloud["points_m"]) <= SCANNER["columns"] * SCANNER["rows"]
            driven.append(table["drive"]["stall"])
            assert stalls[driven[-1]]["gear_changes_in"] is not None
        assert len(set(driven)) == len(driven)


@pytest.mark.soak
def test_drives_have_the_same_bytes_when_made_again(made, tmp_path):
    recipe, shard, folder, rows = made
    assert make_shard(recipe, tmp_path, shard) == rows
    assert tree_of(tmp_path) == tree_of(folder)


@pytest.mark.soak
def test_drives_lead_from_the_street_over_ramps_to_stalls_of_lower_levels(tmp_path):
    storey_m = 2.9
    garage = {
        "profile": {"name": "none"},
        "building": {"levels": 2, "storey_m": storey_m, "ramp_slope_percent": 20, "ramp_transition_m": 2.0},
        "fittings": {"ceiling_height_m": 2.6},
        "plan": {"episodes": 30, "starts": 1, "climb": False},
        "site": {"width_cells": 9, "height_cells": 5},
    }
    count = 8  # so many that stalls of both levels are among those drawn
    make = {"drives": {**DRIVES, "count": count}, "difficulty": False}
    recipe = small_recipe(garage=garage, count=1, splits={"all": 1}, shards={"garages": 1, "form": "folder"}, make=make)
    (shard,) = shards_of(recipe, planned(recipe, [(0, 0)]))
    (row,) = make_shard(recipe, tmp_path, shard)
    assert not row.error
    files = [file.suffix for file in row.files]
    assert not any(name.startswith(".difficulty") for name in files)
    place, arrived = tmp_path / "shards" / row.key, []
    for number in range(count):
        with zipfile.ZipFile(place.with_name(f"{place.name}.drive_{number}.zip")) as archive:
            table = json.loads(archive.read("frames.json"))
            level = table["drive"]["stall"].partition("/")[0]
            sweeps = table["sweeps"]
            levels = [sweep["level"] for sweep in sweeps]
            assert levels == sorted(levels)
            assert (levels[0], levels[-1]) == ("U1", level)
            heights = [np.array(sweep["vehicle_to_world"])[1, 3] for sweep in sweeps]
            floor_m = 0.0 if level == "U1" else -storey_m
            assert heights[-1] == pytest.approx(floor_m, abs=1e-3)
            assert any(-storey_m + 0.1 < height < -0.1 for height in heights) is (level == "U2")
            with np.load(io.BytesIO(archive.read(sweeps[-1]["files"]["npz"]))) as cloud:
                turn, place_m = np.split(np.array(sweeps[-1]["sensor_to_world"])[:3], [3], axis=1)
                seen_m = (turn @ cloud["points_m"].T + place_m)[1]
            # but for what is seen of ramps up and down
            low_m, high_m = np.quantile(seen_m, [0.05, 0.95])
            assert floor_m - 0.03 < low_m < high_m < floor_m + storey_m
            arrived.append(level)
    assert {*arrived} == {"U1", "U2"}


def test_a_rig_of_ones_own_stands_in_the_recipe(tmp_path):
    (tmp_path / "mine.toml").write_text(
        'name = "mine"\n[[sensors]]\n' + "".join(f"{key} = {json.dumps(value)}\n" for key, value in SCANNER.items())
    )
    path = tmp_path / "recipe.toml"
    path.write_text('name = "a"\n[make.drives]\nrig = "mine.toml"\n')
    recipe = load_recipe(path)
    assert recipe.make.drives.rig.sensors[0].columns == SCANNER["columns"]
    (tmp_path / "mine.toml").unlink()
    path = tmp_path / "recipe.json"
    path.write_text(recipe.record())
    assert load_recipe(path) == recipe


def test_what_a_rig_cannot_record_is_said_before_the_work(tmp_path):
    drives = {**DRIVES, "slots": ["json"]}
    with pytest.raises(ConfigError, match=r"make\.drives\.pictures"):
        make_dataset(small_recipe(make={"drives": drives}), tmp_path / "set")
    assert not (tmp_path / "set").exists()
