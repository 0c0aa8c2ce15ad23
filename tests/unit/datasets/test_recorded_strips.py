"""Strips that are taken out of the recordings of a data set, from which `benchmarks/real.py` learns."""

import io
import json
import zipfile

import numpy as np
import pytest
from PIL import Image
from support.benchmarks import benchmark
from support.data_sets import small_recipe

from garage2usd.common.errors import ConfigError
from garage2usd.datasets import load_recipe
from garage2usd.sensors.rig.around_view_camera import AroundViewCamera

drawn_folder, strips, recorded_strips, real = map(benchmark, ("drawn_folder", "strips", "recorded_strips", "real"))
SHOWN = [[40.0, 20.0], [41.0, 80.0], [5.0, 20.0], [5.0, 80.0]]
HIDDEN_AND_OUT = [[60.0, 200.0], [-9.0, 260.0], [5.0, 200.0], [5.0, 260.0]]


def dataset(folder, drives):
    """A data set in folders; of each garage the frames of a drive: the camera, and its slots."""
    (folder / "shards").mkdir(parents=True)
    (folder / "recipe.json").write_text(small_recipe(shards={"form": "folder", "garages": 1}).record())
    for number, frames in enumerate(drives):
        shard = folder / "shards" / f"all-{number:06}"
        shard.mkdir()
        shard.with_suffix(".jsonl").touch()
        (shard / f"{number:08}.usdc").write_bytes(b"a stage")
        with zipfile.ZipFile(shard / f"{number:08}.drive_0.zip", "w") as drive:
            named = [(f"{camera}_{place:04}", camera, slots) for place, (camera, slots) in enumerate(frames)]
            for place, (name, _, _) in enumerate(named):
                packed = io.BytesIO()
                Image.fromarray(np.full((300, 96, 3), 10 * number + place, dtype=np.uint8)).save(packed, "png")
                drive.writestr(f"colour/{name}.png", packed.getvalue())
            table = [
                {"name": name, "camera": camera, "files": {"colour": f"colour/{name}.png"}} for name, camera, _ in named
            ]
            drive.writestr("frames.json", json.dumps({"frames": table}))
            slots = [
                {"name": name, "slots": [{"corners_px": places, "visibility": seen} for places, seen in slots]}
                for name, _, slots in named
            ]
            drive.writestr("slots.json", json.dumps({"frames": slots}))
    return folder


def test_strips_with_entry_corners_are_learnt_from(tmp_path):
    seen = ("left", [(SHOWN, [2, 2, 2, 2])])
    hidden = ("right", [(HIDDEN_AND_OUT, [1, 0, 2, 2])])
    rear_alone = ("left", [(SHOWN, [0, 0, 2, 2])])
    made = dataset(tmp_path / "made", [[seen, rear_alone, hidden, ("front", seen[1])], [rear_alone], [seen] * 9])
    real.main(["recorded", str(made), "-o", str(tmp_path / "drawn"), "--pictures", "3"])
    first, last = drawn_folder.read_drawn(tmp_path / "drawn")
    assert [strip.name for strip in first] == ["00000000_left/left_0000.png", "00000000_right/right_0002.png"]
    assert first[0].seen_px.tolist() == SHOWN[:2]
    assert first[1].corners_px.tolist() == [[96.0 - 60.0, 200.0]]  # mirrored
    assert first[1].is_occluded.tolist() == [True]
    assert [int(strip.pixels[0, 0, 0]) for strip in (*first, *last)] == [0, 2, 20, 24, 28]


def test_without_such_strips_the_data_set_is_named(tmp_path):
    made = dataset(tmp_path / "made", [[("left", [])]])
    with pytest.raises(ConfigError, match="entry corners"):
        list(recorded_strips.convert(made, tmp_path / "drawn", pictures=3))
    (made / "shards" / "all-000000" / "00000000.drive_0.zip").write_bytes(b"none")
    with pytest.raises(ConfigError, match="all-000000"):
        list(recorded_strips.convert(made, tmp_path / "drawn", pictures=3))


def test_the_recipes_differ_in_traffic_alone_and_their_rig_has_strips():
    in_traffic, without = (load_recipe(real.HERE / f"{name}.toml") for name in ("recorded_in_traffic", "recorded"))
    assert without.make == in_traffic.make
    for number in range(5):
        (busy, _), (empty, _) = (recipe.drawn(recipe.garage_seed(number, 0)) for recipe in (in_traffic, without))
        assert busy.model_copy(update={"traffic": empty.traffic}) == empty
        assert busy.traffic.arrivals_per_hour >= 100 * empty.traffic.arrivals_per_hour
    views = {
        camera.name: camera for camera in in_traffic.make.drives.rig.cameras if isinstance(camera, AroundViewCamera)
    }
    assert in_traffic.make.drives.rig == without.make.drives.rig
    assert tuple(views) == strips.SIDES
    assert {camera.lens.size_px for camera in views.values()} == {strips.SIZE_PX}
    assert [sensor.name for sensor in in_traffic.make.drives.rig.recorded] == list(strips.SIDES)
