"""Heights of an OpenDRIVE map are over the road, which climbs on ramps; what stands beside them does not."""

from dataclasses import replace

import numpy as np
import pytest
from support.opendrive_reader import OpenDrive
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.as_built import BuiltGarage
from garage2usd.as_built.shapes import Body, Thing, box_shape
from garage2usd.config.outputs import MapsConfig
from garage2usd.garage_sources import read_built
from garage2usd.maps.opendrive import write_opendrive

NAME, HEIGHT_M = "/Garage/Walls/BesideTheRamp", 3.0


def test_a_wall_beside_a_ramp_stands_on_the_floor(tmp_path):
    subject = read_built(build(GarageConfig(**SETTINGS), tmp_path / "small.usdc").stage).garage
    ramp = next(thing for thing in subject.things if thing.label == "ramp")
    points = np.concatenate([body.world_points() for body in ramp.bodies])
    low, high = points.min(axis=0), points.max(axis=0)
    across = int(high[0] - low[0] > high[2] - low[2]) * 2  # the axis along which the ramp is narrow
    middle = (low + high) / 2
    middle[across] = high[across] + 1.0
    corner = np.array([0.2, 0.0, 0.2])
    shape = box_shape(np.array([*middle]) * (1, 0, 1) - corner, middle * (1, 0, 1) + corner + (0, HEIGHT_M, 0))
    wall = Thing(NAME, "wall", (Body(shape, np.eye(4), touches=True),))
    level = replace(subject.levels[0], things=(*subject.things, wall))
    write_opendrive(BuiltGarage.of_level(level), tmp_path / "small.xodr", MapsConfig())
    read = OpenDrive(tmp_path / "small.xodr")
    ((road, thing),) = [
        (road, thing) for road in read.root.iter("road") for thing in road.iter("object") if thing.get("name") == NAME
    ]
    road_m = read.height(road, float(thing.get("s")))
    assert road_m > 0.5
    base_m = road_m + float(thing.get("zOffset"))
    assert base_m == pytest.approx(0.0, abs=2e-3)
    assert base_m + float(thing.get("height")) == pytest.approx(HEIGHT_M, abs=2e-3)
