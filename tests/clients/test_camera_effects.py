"""Recordings by cameras with effects: the truth is that of perfect cameras, and the car is where its mask says."""

import json

import numpy as np
import pytest
from PIL import Image
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.recordings import record
from garage2usd.render import Picture
from garage2usd.render.pictures import read_ids
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

pytest.importorskip("bpy", reason="extra: blender")
TRUTH = Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC


@pytest.mark.soak
def test_effects_change_colour_alone_and_the_car_is_where_its_mask_says(tmp_path):
    built = build(GarageConfig(**SETTINGS), tmp_path / "small.usdc")
    front = read_rig("avp_surround").model_dump(mode="json")["sensors"][0]
    motion = {"exposure_s": 0.03, "readout_s": 0.05}
    effects = {"full_well_electrons": 2000.0, "exposure_spread_ev": 0.5, "jpeg_quality": 80, "dirt": 4, **motion}

    sensors = [{**front, "name": "perfect"}, {**front, "name": "real", "effects": effects}]
    rig = rig_from_mapping({"name": "r", "ego_visible": True, "sensors": sensors})
    asked = {"along": ":Stall_r00_c01_2", "every_m": 24, "scale": 0.15, "samples": 2, "slots": ()}
    made = record(built.stage, tmp_path / "made", rig=rig, pictures=(Picture.COLOUR, *TRUTH), **asked).folder
    for kind in TRUTH:
        paths = sorted((made / kind).glob("perfect_*"))
        assert len(paths) == 3
        for path in paths:
            assert path.read_bytes() == path.with_name(path.name.replace("perfect", "real")).read_bytes()
    told = json.loads((made / "slots.json").read_text())["frames"]
    seen = {name: [entry["slots"] for entry in told if entry["name"].startswith(name)] for name in ("perfect", "real")}
    assert any(seen["real"])
    assert seen["perfect"] == seen["real"]
    colours = [np.asarray(Image.open(made / "colour" / f"{name}_0000.png")) for name in ("perfect", "real")]
    assert not np.array_equal(*colours)
    frame, driving = (
        each for each in json.loads((made / "frames.json").read_text())["frames"][:4] if "effects" in each
    )
    assert frame["effects"]["jpeg_quality"] == 80
    assert frame["effects"]["cameras"]["real"]["gain"] >= 1.0
    assert driving["effects"]["exposure_s"] == 0.03
    assert np.linalg.norm(driving["effects"]["motion"]["velocity_m_s"]) == pytest.approx(2.5, abs=0.1)
    assert not (made / "light").exists()
    ids = read_ids(made / "instance" / "real_0000.png")
    mask = np.asarray(Image.open(made / "ego" / "real.png")) > 0
    assert mask.any()
    assert ((ids == ids.max()) == mask).mean() > 0.999
