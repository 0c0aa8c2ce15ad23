"""SUMO in garages of several levels: vehicles drive from the street to every stall of the lowest level, and back."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
from support.level_judge import LevelJudge
from support.map_judges import HAS_JUDGES, run_sumo, sumo_network, sumo_parked
from support.small_levels import FLOORS_M, SMALL_LEVELS
from support.soak import soak_but

import garage2usd

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_JUDGES, reason="no environment with SUMO"),
]
NEAR_M = 2e-3
LONGEST_STEP_M = 14.0
"""In one second of SUMO's default speed on roads without a limit."""
HELICES = {
    "building": {"levels": 2, "storey_m": 3.6, "ramps": "helix"},
    "site": {"width_cells": 10, "height_cells": 10},
}


class LevelsSumo:
    """SUMO's files of a garage of levels, with the edges that begin and end at the street."""

    def __init__(self, config, folder):
        self.folder = folder
        self.stage = garage2usd.build(config, folder / "garage.usdc").stage
        self.areas, configuration, _ = garage2usd.export(self.stage, [folder / "g.add.xml"])
        self.network = sumo_network(configuration, folder)
        self.elements = {area.get("id"): area for area in ET.parse(self.areas).getroot()}
        root = ET.parse(self.network).getroot()
        edges = [edge for edge in root.iter("edge") if edge.get("function") != "internal"]
        ways = [(one.get("from"), one.get("to")) for one in root.iter("connection")]
        names = [edge.get("id") for edge in edges]
        self.sources = [name for name in names if name not in {after for _, after in ways}]
        self.sinks = [name for name in names if name not in {before for before, _ in ways}]
        self.heights = {
            lane.get("id"): [float((*place.split(","), 0)[2]) for place in lane.get("shape").split()]
            for edge in edges
            for lane in edge.iter("lane")
        }

    def routes(self, areas, *, seconds):
        routes = ET.Element("routes")
        ET.SubElement(routes, "vType", id="small", length="3", minGap="0.5")
        for number, name in enumerate(areas):
            trip = ET.SubElement(routes, "trip", id=str(number), type="small", depart=str(10 * number))
            trip.attrib |= {"from": self.sources[0], "to": self.sinks[0]}
            badges = self.elements[name].get("acceptedBadges")
            trip.attrib |= {"parkingBadges": badges} if badges else {}
            ET.SubElement(trip, "stop", parkingArea=name, duration=str(seconds))
        path = self.folder / "g.rou.xml"
        ET.ElementTree(routes).write(path)
        return path


@pytest.fixture(scope="module", params=soak_but(["straight"], ["straight", "helix"]))
def sumo(request, tmp_path_factory):
    changes = HELICES if request.param == "helix" else {}
    config = garage2usd.GarageConfig(**{**SMALL_LEVELS.model_dump(exclude_unset=True), **changes})
    return LevelsSumo(config, tmp_path_factory.mktemp(request.param))


def test_a_vehicle_parks_in_each_stall_of_each_level_at_its_height(sumo):
    judge = LevelJudge(sumo.stage)
    outlines = dict(zip(judge.stall_ids, judge.outlines, strict=True))
    wanted = [name for name, area in sumo.elements.items() for _ in area.iter("space")]
    found = sumo_parked(sumo.network, sumo.areas, sumo.routes(wanted, seconds=10**6), sumo.folder, expected=len(wanted))
    assert found["said"] == ""
    parked = list(found["parked"].values())
    assert len(parked) == len(wanted) > 100
    stalls = [
        name for area in sumo.elements.values() for name in area.find("param[@key='stalls']").get("value").split()
    ]
    assert len(stalls) == len({*stalls}) == len(wanted)
    left = {*stalls}
    for vehicle in parked:
        x, y, z = vehicle["front"]
        area = sumo.elements[vehicle["area"]].find("param[@key='stalls']").get("value").split()
        (stall,) = (
            name
            for name in left & {*area}
            if shapely.Polygon(outlines[name][:, [0, 2]]).distance(shapely.Point(x, -y)) < NEAR_M
        )
        left.remove(stall)
        assert z == pytest.approx(FLOORS_M[stall.partition("/")[0]], abs=NEAR_M)
    assert not left


def test_each_area_lies_on_a_lane_of_its_level(sumo):
    for area in sumo.elements.values():
        names = {name.partition("/")[0] for name in area.find("param[@key='stalls']").get("value").split()}
        (level,) = names
        assert np.array(sumo.heights[area.get("lane")]) == pytest.approx(FLOORS_M[level], abs=NEAR_M)


def test_a_vehicle_drives_down_to_a_stall_of_the_lowest_level_and_leaves_by_the_street(sumo):
    (name, *_) = (name for name, area in sumo.elements.items() if "U2/" in area.get("name"))
    routes = sumo.routes([name], seconds=30)
    options = {each: sumo.folder / f"{each}.xml" for each in ("tripinfo", "fcd", "stop")}
    outputs = [part for each, path in options.items() for part in (f"--{each}-output", path)]
    assert run_sumo(sumo.network, routes, sumo.folder, "-a", sumo.areas, *outputs) == ("", False)
    (trip,) = ET.parse(options["tripinfo"]).getroot()
    assert trip.get("arrivalLane").rpartition("_")[0] == sumo.sinks[0]
    (stop,) = ET.parse(options["stop"]).getroot()
    assert stop.get("parkingArea") == name
    places = np.array(
        [[one.get(axis, 0) for axis in "xyz"] for one in ET.parse(options["fcd"]).getroot().iter("vehicle")],
        dtype=float,
    )
    heights = places[:, 2]
    assert heights[[0, -1]].min() > FLOORS_M["U1"] - NEAR_M
    assert heights.min() == pytest.approx(FLOORS_M["U2"], abs=NEAR_M)
    on_ramps = (heights > FLOORS_M["U2"] + 0.2) & (heights < FLOORS_M["U1"] - 0.2)
    assert on_ramps.sum() >= 4
    assert np.abs(np.diff(heights)).max() < 0.25 * LONGEST_STEP_M  # no jump from level to level
