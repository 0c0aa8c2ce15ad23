"""SUMO's parking areas of the samples: SUMO loads them, drives to each and parks in each stall."""

import itertools
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from support.map_judges import HAS_JUDGES, run_sumo, sumo_network, sumo_parked
from support.sample_files import REPOSITORY, SAMPLES
from support.soak import soak_but
from support.stage_lanes import judged_stage

import garage2usd
from garage2usd.config.outputs import MapsConfig

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(not HAS_JUDGES, reason="no environment with SUMO"),
]
NEAR_M, NEAR_DEG = 2e-3, 0.02
STOPS_WITHIN_M = 1.0
QUICK = [sample for sample in SAMPLES if sample.stem not in {"large_20x30", "looks"}]
MIXED = REPOSITORY / "samples/mixed_stalls.toml"
BADGES = {"accessible": "accessible", "ev": "ev", "motorcycle": "motorcycle"}
CARS = {"standard", *BADGES}
SITE = {"width_cells": 7, "height_cells": 6}


class Sumo:
    """A stage's parking areas and the network that netconvert makes of its map."""

    def __init__(self, stage, folder, **settings):
        self.folder, self.heard, self.areas_of = folder, [], settings.get("areas", "bay")
        self.judged = judged_stage(stage)
        files = garage2usd.export(
            stage, [folder / "g.add.xml"], settings=MapsConfig(sumo=settings), notice=self.heard.append
        )
        assert [file.name for file in files] == ["g.add.xml", "g.netccfg", "g.xodr"]
        self.areas, configuration, _ = files
        self.network = sumo_network(configuration, folder)
        self.elements = {area.get("id"): area for area in ET.parse(self.areas).getroot()}
        root = ET.parse(self.network).getroot()
        self.edges = [edge.get("id") for edge in root.iter("edge") if edge.get("function") != "internal"]
        self.follows = {
            (one.get("from"), one.get("to")) for one in root.iter("connection") if one.get("from") in self.edges
        }
        self.shapes = {
            lane.get("id"): np.array([place.split(",")[:2] for place in lane.get("shape").split()], dtype=float)
            for lane in root.iter("lane")
        }
        self.sources = [edge for edge in self.edges if edge not in {after for _, after in self.follows}]
        self.sinks = [edge for edge in self.edges if edge not in {before for before, _ in self.follows}]

    def parked(self):
        """Where a vehicle for each space stands, all of which come by the first entrance."""
        routes = ET.Element("routes")
        ET.SubElement(routes, "vType", id="small", length="3", minGap="0.5")
        wanted = [name for name, area in self.elements.items() for _ in area.iter("space")]
        for number, name in enumerate(wanted):
            badges = self.elements[name].get("acceptedBadges")
            trip = ET.SubElement(routes, "trip", id=str(number), type="small", depart=str(10 * number))
            trip.attrib |= {"from": self.sources[0], "to": self.sinks[0]}
            trip.attrib |= {"parkingBadges": badges} if badges else {}
            ET.SubElement(trip, "stop", parkingArea=name, duration="100000")
        path = self.folder / "g.rou.xml"
        ET.ElementTree(routes).write(path)
        found = sumo_parked(self.network, self.areas, path, self.folder, expected=len(wanted))
        assert found["said"] == ""
        assert [found["parked"][str(number)]["area"] for number in range(len(wanted))] == wanted
        return found["parked"].values()

    def complaints(self):
        """What is wrong with the vehicles that SUMO parks, as the stage has its stalls."""
        stalls = {name: stall for name, stall in self.judged.lanes.stalls.items() if stall["use"] in CARS}
        left = dict(stalls)
        for vehicle in self.parked():
            place = np.array(vehicle["front"])
            near = [name for name in left if (np.abs(far_end(stalls[name]["corners"])[0] - place[:2]) < NEAR_M).all()]
            if len(near) != 1:
                yield f"a vehicle stands at {place}, before {near}"
                continue
            stall = left.pop(near[0])
            if near[0] not in self.elements[vehicle["area"]].find("param[@key='stalls']").get("value").split():
                yield f"{near[0]} is not in its area {vehicle['area']}"
            heading_deg = far_end(stall["corners"])[1]
            # from north, clockwise
            if abs((90 - heading_deg - vehicle["angle_deg"] + 180) % 360 - 180) > NEAR_DEG:
                yield f"a vehicle in {near[0]} stands at {vehicle['angle_deg']} degrees"
            if abs(place[2]) > NEAR_M:
                yield f"a vehicle in {near[0]} stands {place[2]} m high"
            if self.areas_of != "row":
                yield from self._beside_its_lane(near[0], stall, vehicle)
        if left:
            yield f"no vehicle parks in {sorted(left)}"

    def _beside_its_lane(self, name, stall, vehicle):
        """The vehicle has left its lane on the ground before its bay."""
        shape = self.shapes[self.elements[vehicle["area"]].get("lane")]
        steps = np.linalg.norm(np.diff(shape, axis=0), axis=1)
        runs = np.append(0, np.cumsum(steps))
        place = np.array([np.interp(vehicle["at_m"], runs, shape[:, axis]) for axis in (0, 1)])
        access = stall["access"]
        half = self.judged.lanes.widths[access] / 2 + STOPS_WITHIN_M
        around = [access, *self.judged.lanes.graph().to_undirected()[access]]
        beside = [np.abs(place * (1, -1) - self.judged.lanes.middles[one]) <= half for one in around]
        if not any(one.all() for one in beside):
            yield f"a vehicle leaves its lane at {place} for {name}"


def far_end(corners):
    """The middle (x, y) of the end of a stall where the nose of a car stands, and its heading in degrees.

    From the corners (x, z) mouth left, mouth right, rear right, rear left: in parallel stalls cars stand along the
    mouth with the lane on their left, in others along the sides.
    """
    a, b, _, d = corners * (1, -1)
    mouth, side = b - a, d - a
    square = abs(mouth @ side) < 0.01 * np.linalg.norm(mouth) * np.linalg.norm(side)
    if square and np.linalg.norm(mouth) > np.linalg.norm(side):
        along, length = -mouth, np.linalg.norm(mouth)
        if np.cross(along, a - d) < 0:
            along = -along
    else:
        # the rectangle between the lines is shorter than the sides by what the corners of the mouth lean
        along, lean = side, abs(mouth @ side) / np.linalg.norm(side)
        length = np.linalg.norm(side) - lean
    along = along / np.linalg.norm(along)
    return corners.mean(axis=0) * (1, -1) + along * length / 2, np.degrees(np.arctan2(along[1], along[0]))


@pytest.fixture(scope="module")
def mixed(builds, tmp_path_factory):
    return Sumo(builds(MIXED, "usdc").stage, tmp_path_factory.mktemp("mixed"))


@pytest.mark.parametrize("sample", soak_but([MIXED], QUICK), ids=lambda path: path.stem)
def test_vehicles_park_in_every_stall(sample, builds, tmp_path):
    assert list(Sumo(builds(sample, "usdc").stage, tmp_path).complaints()) == []


def test_vehicles_with_a_badge_park_in_the_stalls_for_motorcycles(tmp_path):
    sizes = {"standard": 0.7, "motorcycle": 0.3}
    config = garage2usd.GarageConfig(seed=2, site=SITE, plan={"episodes": 100}, stalls={"sizes": sizes})
    sumo = Sumo(garage2usd.build(config, tmp_path / "g.usdc").stage, tmp_path)
    badges = [area.get("acceptedBadges") for area in sumo.elements.values()]
    assert badges.count("motorcycle") > 1
    assert list(sumo.complaints()) == []


@pytest.mark.parametrize("areas", ["row", "stall"])
def test_areas_are_rows_or_single_stalls(areas, builds, tmp_path):
    sumo = Sumo(builds(MIXED, "usdc").stage, tmp_path, areas=areas)
    counts = [len(area.findall("space")) for area in sumo.elements.values()]
    stalls = {name for name, stall in sumo.judged.lanes.stalls.items() if stall["use"] in CARS}
    assert sum(counts) == len(stalls)
    if areas == "stall":
        assert set(sumo.elements) == stalls
        vehicles = list(sumo.parked())
        for vehicle in vehicles:
            corners = sumo.judged.lanes.stalls[vehicle["area"]]["corners"]
            assert np.abs(far_end(corners)[0] - vehicle["front"][:2]).max() < NEAR_M
    else:
        rows = {(area.get("lane"), area.find("param[@key='use']").get("value")) for area in sumo.elements.values()}
        assert len(counts) == len(rows)
        assert list(sumo.complaints()) == []


def test_vehicles_against_a_one_way_lane_are_refused(mixed):
    against = [
        (after, before)
        for before, after in sorted(mixed.follows)
        if (after, before) not in mixed.follows and not {before, after} & {*mixed.sources, *mixed.sinks}
    ]
    assert len(against) > 10
    one_way = [edge for edge in mixed.edges if edge.startswith("-") and edge[1:] not in mixed.edges]
    assert len(one_way) > 5
    before, after = against[0]
    path = mixed.folder / "against.rou.xml"
    for edges in (f"{before} {after}", one_way[0][1:]):
        path.write_text(f'<routes><vehicle id="a" depart="0"><route edges="{edges}"/></vehicle></routes>')
        said, refused = run_sumo(mixed.network, path, mixed.folder)
        assert refused
        assert "no valid route" in said or "not known" in said
    path.write_text(f'<routes><vehicle id="a" depart="0"><route edges="{after} {before}"/></vehicle></routes>')
    assert run_sumo(mixed.network, path, mixed.folder) == ("", False)


def test_only_vehicles_with_a_badge_park_in_accessible_stalls(builds, tmp_path):
    sample = REPOSITORY / "samples/paper_7x9.toml"
    stage = builds(sample, "usdc").stage
    for badges, refused in ((True, True), (False, False)):
        sumo = Sumo(stage, tmp_path, badges=badges)
        name = next(
            name for name, area in sumo.elements.items() if area.find("param[@key='use']").get("value") == "accessible"
        )
        path = tmp_path / "a.rou.xml"
        trip = f'<trip id="a" depart="0" from="{sumo.sources[0]}" to="{sumo.sinks[0]}">'
        path.write_text(f'<routes>{trip}<stop parkingArea="{name}" duration="5"/></trip></routes>')
        said, is_refused = run_sumo(sumo.network, path, tmp_path, "-a", sumo.areas)
        assert is_refused == refused
        assert ("badge" in said) == refused


def test_occupied_stalls_and_those_left_out_are_named(mixed, builds, tmp_path):
    sumo = Sumo(builds(REPOSITORY / "samples/paper_7x9.toml", "usdc").stage, tmp_path)
    hatched = [name for name, stall in sumo.judged.lanes.stalls.items() if stall["use"] not in CARS]
    assert hatched
    (line,) = sumo.heard
    assert line.startswith(f"g.add.xml: stalls where nobody parks are left out ({len(hatched)}): ")
    assert hatched[0] in line
    for each in (sumo, mixed):
        occupied = [area.find("param[@key='occupied']").get("value").split() for area in each.elements.values()]
        assert set(itertools.chain(*occupied)) == {
            name for name in each.judged.taken if each.judged.lanes.stalls[name]["use"] in CARS
        }
        spaces = [space.get("name") for area in each.elements.values() for space in area.iter("space")]
        assert len(spaces) == len(set(spaces))
