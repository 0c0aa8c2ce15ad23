"""The scenario of a drive, read from its file alone and by ASAM's checker."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
import shapely.affinity
from support.openscenario_checker import issues_of, needs_checker
from support.openscenario_reader import OpenScenario
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.config.outputs import Leg
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.openscenario import EGO, write_scenario
from garage2usd.maps.parked_cars import parked_cars


@pytest.fixture(scope="module")
def garage():
    return garage2usd.generate(garage2usd.GarageConfig(**SETTINGS))


@pytest.fixture(scope="module")
def subject(garage):
    return garage_as_made(garage, source="garage", kind="plan")


@pytest.fixture(scope="module")
def drives(garage, subject):
    planner = DrivePlanner(subject)
    name = next(stall.name for stall in garage.layout.stalls if stall.use.takes_cars)
    return {leg: planner.drive(name, leg=leg) for leg in Leg}


@pytest.fixture(scope="module")
def scenarios(drives, subject, tmp_path_factory):
    folder = tmp_path_factory.mktemp("scenarios")

    def written(leg, name):
        drive = drives[leg]
        file = folder / name
        write_scenario(
            file,
            drive.motion.sampled(0.1),
            car=drive.car,
            settings=drive.settings,
            road_file="garage.xodr",
            parked=parked_cars(subject, free=[drive.route.stall]),
            name=f"{leg} {drive.route.stall}",
            seed=2,
        )
        return file

    return written


@pytest.mark.parametrize("leg", list(Leg))
def test_the_car_follows_its_trajectory_in_the_map_s_frame(drives, scenarios, leg):
    scenario = OpenScenario(scenarios(leg, f"{leg}.xosc"))
    states = drives[leg].motion.sampled(0.1)
    times, found = np.split(scenario.track(), [1], axis=1)
    assert times[:, 0] == pytest.approx(states.time_s, abs=1e-6)
    # north is the stage's -Z; the nose of a car with yaw 0 looks there
    assert found[:, 0] == pytest.approx(states.x_m, abs=1e-6)
    assert found[:, 1] == pytest.approx(-states.z_m, abs=1e-6)
    assert found[:, 2] == pytest.approx(states.y_m, abs=1e-6)
    noses = np.stack([np.cos(found[:, 3]), np.sin(found[:, 3])])
    assert noses[0] == pytest.approx(-np.sin(states.yaw_rad), abs=1e-5)
    assert noses[1] == pytest.approx(np.cos(states.yaw_rad), abs=1e-5)
    # a nose that looks up has a negative pitch in ISO 8855
    assert found[:, 4] == pytest.approx(-states.pitch_rad, abs=1e-6)
    assert scenario.inits[EGO] == pytest.approx(found[0])
    assert scenario.road_file == "garage.xodr"


def test_the_box_of_the_car_lies_about_its_rear_axle(drives, scenarios):
    root = ET.parse(scenarios(Leg.IN, "box.xosc")).getroot()
    ego = next(entity for entity in root.iter("ScenarioObject") if entity.get("name") == EGO)
    centre, size = ego.find(".//BoundingBox/Center"), ego.find(".//BoundingBox/Dimensions")
    x, length = float(centre.get("x")), float(size.get("length"))
    car = drives[Leg.IN].car
    assert (x - length / 2, x + length / 2) == pytest.approx((-car.rear_overhang_m, car.ahead_m))
    assert float(ego.find(".//FrontAxle").get("positionX")) == car.wheelbase_m


def test_parked_cars_stand_where_the_garage_has_them(garage, drives, scenarios):
    scenario = OpenScenario(scenarios(Leg.BOTH, "parked.xosc"))
    parked = drives[Leg.BOTH].route.stall
    cars = [car for car in garage.layout.of_kind("car") if car.stall != parked]
    assert cars
    found = [scenario.box(name) for name in scenario.vehicles if name != EGO]
    assert len(found) == len(cars)
    for car in cars:
        body, _ = car.outlines()  # and its mirrors
        ground = shapely.affinity.scale(shapely.Polygon(body), 1, -1, origin=(0, 0))
        box, along = max(found, key=lambda pair: pair[0].intersection(ground).area)
        assert ground.difference(box.buffer(0.02)).is_empty
        assert ground.buffer(0.02).covers(box)
        nose = np.array([-math.sin(car.yaw_rad), math.cos(car.yaw_rad)])
        assert nose @ along > 0.999


def test_the_same_drive_has_the_same_bytes(scenarios):
    one, other = (scenarios(Leg.IN, f"{name}.xosc").read_bytes() for name in ("one", "other"))
    assert one == other
    assert b"seed 2" in one


@needs_checker
@pytest.mark.parametrize("leg", list(Leg))
def test_asam_s_checker_has_no_issue(scenarios, tmp_path, leg):
    assert issues_of(scenarios(leg, f"checked_{leg}.xosc"), tmp_path) == []


@needs_checker
def test_asam_s_checker_sees_a_scenario_that_is_broken(scenarios, tmp_path):
    text = (
        scenarios(Leg.IN, "broken.xosc")
        .read_text()
        .replace("<ObjectController", "<Nothing", 1)
        .replace('entityRef="Ego"', 'entityRef="Nobody"')
    )
    broken = tmp_path / "broken.xosc"
    broken.write_text(text)
    assert issues_of(broken, tmp_path)
