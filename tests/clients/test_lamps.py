"""Recordings with the lamps of the ego car on: its light falls before and behind it, and the truth stays as it is."""

import numpy as np
import pytest
from PIL import Image
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.recordings import record
from garage2usd.render import Picture
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

pytest.importorskip("bpy", reason="extra: blender")
TRUTH = Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC


@pytest.mark.soak
def test_lamps_light_what_is_before_and_behind_the_car_and_change_no_truth(tmp_path):
    built = build(GarageConfig(**SETTINGS), tmp_path / "small.usdc")
    sensors = [
        sensor
        for sensor in read_rig("avp_surround").model_dump(mode="json")["sensors"]
        if sensor["name"] in {"front", "rear"}
    ]

    def recorded(lamps):
        rig = rig_from_mapping({"name": "r", "lamps": lamps, "sensors": sensors})
        asked = {"along": ":Stall_r00_c01_2", "every_m": 500, "scale": 0.05, "samples": 16, "slots": ()}
        return record(built.stage, tmp_path / lamps, rig=rig, pictures=(Picture.COLOUR, *TRUTH), **asked).folder

    dark, bright = recorded("off"), recorded("on")
    for kind in TRUTH:
        names = sorted(path.name for path in (dark / kind).iterdir())
        assert len(names) == 4
        for name in names:
            assert (dark / kind / name).read_bytes() == (bright / kind / name).read_bytes(), name
    assert (dark / "slots.json").read_bytes() == (bright / "slots.json").read_bytes()

    def lower_half(folder, camera):
        """Mean red, green and blue of the lower half where the car has parked."""
        picture = np.asarray(Image.open(folder / "colour" / f"{camera}_0001.png"))[..., :3].astype(float)
        return picture[len(picture) // 2 :].mean(axis=(0, 1))

    before = lower_half(bright, "front") - lower_half(dark, "front")
    assert before.min() > 8
    assert np.ptp(before) < 0.5 * before.min()
    red, green, blue = lower_half(bright, "rear") - lower_half(dark, "rear")
    assert red > 5
    assert red > 2 * max(green, blue)
