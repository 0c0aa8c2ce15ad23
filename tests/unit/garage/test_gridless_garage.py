"""A garage without a grid: a slanted one-way aisle with angled stalls, which driving and maps take as it is."""

import math
import xml.etree.ElementTree as ET

import pytest
import shapely
from support.opendrive_reader import OpenDrive

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.config.outputs import MapsConfig
from garage2usd.driving import DesignCar, prove_garage
from garage2usd.driving.layout_garage import StandingThing, assembled
from garage2usd.garage import LaneEdge, LaneGraph, LaneNode, Stall, StallKind, StallUse
from garage2usd.maps.frame import map_point
from garage2usd.maps.lanelet2 import write_lanelet2
from garage2usd.maps.network import RIGHT
from garage2usd.maps.opendrive import write_opendrive
from garage2usd.maps.road_builder import network_of

AISLE_M, PITCH_M = 4.6, 2.5 / math.sin(math.pi / 3)
KINDS = ("entrance", "straight", "straight", "straight", "exit")


def garage_at(heading_rad, angle_deg=60.0):
    """Four stretches of 10 m, and eight stalls of 2.5 x 5 m on their right side."""
    along = math.cos(heading_rad), math.sin(heading_rad)
    right = -along[1], along[0]

    def at(ahead_m, aside_m):
        return ahead_m * along[0] + aside_m * right[0], ahead_m * along[1] + aside_m * right[1]

    nodes = [LaneNode(kind, at(10.0 * number, 0.0), (AISLE_M, AISLE_M), str(number), sides_m=(10.0, 10.0))
             for number, kind in enumerate(KINDS)]  # fmt: skip
    edges = [LaneEdge(number, number + 1, AISLE_M, one_way=True) for number in range(len(KINDS) - 1)]
    lean_m, depth_m = 5.0 * math.cos(math.radians(angle_deg)), 5.0 * math.sin(math.radians(angle_deg))
    stalls = []
    for number in range(8):
        ahead, aside = 9.0 + number * PITCH_M, AISLE_M / 2 + 0.2
        mouth = (at(ahead + PITCH_M, aside), at(ahead, aside))
        rear = (at(ahead + lean_m, aside + depth_m), at(ahead + lean_m + PITCH_M, aside + depth_m))
        corners = (*mouth, *rear)
        access = min(range(1, 4), key=lambda node: math.dist(nodes[node].position, at(ahead + PITCH_M / 2, 0.0)))
        stalls.append(Stall(f"P{number}", corners, StallUse.STANDARD, access))
    return LaneGraph(tuple(nodes), tuple(edges)), tuple(stalls)


@pytest.mark.parametrize("heading_rad", [0.0, 0.4])
def test_a_car_gets_into_angled_stalls_of_a_one_way_aisle(heading_rad):
    lanes, stalls = garage_at(heading_rad)
    assert {stall.kind for stall in stalls} == {StallKind.ANGLED}
    driven = assembled(stalls, lanes, [StandingThing("pillar", "column", shapely.box(-50, -50, -49, -49))])
    proofs = prove_garage(driven, stalls[2:6], car=DesignCar())
    for proof in proofs:
        assert proof.is_proven, proof
        assert proof.way_in.gear_changes <= 1


def test_against_the_lean_no_car_gets_in_forward():
    """The same stalls on an aisle that is driven the other way."""
    lanes, stalls = garage_at(0.0)
    turned = LaneGraph(lanes.nodes, tuple(edge._replace(start=edge.end, end=edge.start) for edge in lanes.edges))
    assert not turned.arriving
    kinds = KINDS[::-1]
    nodes = tuple(
        LaneNode(kind, node.position, node.widths_m, node.name, sides_m=node.sides_m)
        for kind, node in zip(kinds, lanes.nodes, strict=True)
    )
    turned = LaneGraph(nodes, turned.edges)
    assert len(turned.arriving) == 4
    (with_lean,) = prove_garage(assembled(stalls, lanes, []), stalls[3:4])
    (against,) = prove_garage(assembled(stalls, turned, []), stalls[3:4])
    assert not against.is_proven or against.way_in.gear_changes > with_lean.way_in.gear_changes


def test_its_roads_have_one_lane():
    lanes, stalls = garage_at(0.0)
    network = network_of(BuiltLevel("by hand", "plan", lanes, stalls))
    assert {road.lanes for road in network.roads} == {(RIGHT,)}
    assert sum(road.line.length_m for road in network.roads) == pytest.approx(40.0 + 4.6, abs=0.7)


def test_its_stalls_lie_in_opendrive_and_lanelet2_where_they_are(tmp_path):
    lanes, stalls = garage_at(0.4)
    garage = BuiltGarage.of_level(BuiltLevel("by hand", "plan", lanes, stalls))
    write_opendrive(garage, tmp_path / "map.xodr", MapsConfig())
    road_map = OpenDrive(tmp_path / "map.xodr")
    found = {}
    for road in road_map.roads.values():
        for item in road.iter("object"):
            s, t, turn = (float(item.get(name)) for name in ("s", "t", "hdg"))
            (x, y), heading = road_map.place(road, s, t)
            cos, sin = math.cos(heading + turn), math.sin(heading + turn)
            local = [(float(corner.get("u")), float(corner.get("v"))) for corner in item.iter("cornerLocal")]
            found[item.get("name")] = {
                (round(x + u * cos - v * sin, 3), round(y + u * sin + v * cos, 3)) for u, v in local
            }
    assert found == {
        stall.name: {(round(x, 3), round(y, 3)) for x, y in map(map_point, stall.corners)} for stall in stalls
    }
    write_lanelet2(garage, tmp_path / "map.osm", MapsConfig())
    map_ = ET.parse(tmp_path / "map.osm").getroot()
    subtypes = [
        tag.get("v") for relation in map_.iter("relation") for tag in relation.iter("tag") if tag.get("k") == "subtype"
    ]
    assert subtypes.count("parking") == len(stalls)
