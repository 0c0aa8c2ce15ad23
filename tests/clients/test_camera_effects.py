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


def test_effects_change_colour_alone_and_the_car_is_where_its_mask_says(tmp_path):
    built = build(GarageConfig(**SETTINGS), tmp_path / "small.usdc")
    front = read_rig("avp_surround").model_dump(mode="json")["sensors"][0]
    motion = {"exposure_s": 0.03, "readout_s": 0.05}
    effects = {"full_well_electrons": 2000.0, "exposure_spread_ev": 0.5, "jpeg_quality": 80, "dirt": 4, **motion}

    def recorded(name, **settings):
        sensors = [{**front, **settings}]
        rig = rig_from_mapping({"name": "r", "ego_visible": True, "sensors": sensors})
        asked = {"along": ":Stall_r00_c01_2", "every_m": 24, "scale": 0.15, "samples": 2, "slots": ()}
        return record(built.stage, tmp_path / name, rig=rig, pictures=(Picture.COLOUR, *TRUTH), **asked).folder

    perfect, real = recorded("perfect"), recorded("real", effects=effects)
    for kind in TRUTH:
        for path in (perfect / kind).iterdir():
            assert path.read_bytes() == (real / kind / path.name).read_bytes()
    assert (perfect / "slots.json").read_bytes() == (real / "slots.json").read_bytes()
    colours = [np.asarray(Image.open(folder / "colour" / "front_0000.png")) for folder in (perfect, real)]
    assert not np.array_equal(*colours)
    frame, driving = json.loads((real / "frames.json").read_text())["frames"][:2]
    assert frame["effects"]["jpeg_quality"] == 80
    assert frame["effects"]["cameras"]["front"]["gain"] >= 1.0
    assert driving["effects"]["exposure_s"] == 0.03
    assert np.linalg.norm(driving["effects"]["motion"]["velocity_m_s"]) == pytest.approx(2.5, abs=0.1)
    assert not (real / "light").exists()
    ids = read_ids(real / "instance" / "front_0000.png")
    mask = np.asarray(Image.open(real / "ego" / "front.png")) > 0
    assert mask.any()
    assert ((ids == ids.max()) == mask).mean() > 0.999
