"""Directions are set in one place, the edges of the lane graph, and reach stage, maps, proofs, routes and plan."""

import xml.etree.ElementTree as ET
from functools import cached_property
from itertools import pairwise

import pytest

from garage2usd.as_built.garage import garage_of_stage
from garage2usd.config import config_from_mapping
from garage2usd.driving import prove_stalls
from garage2usd.exports import export
from garage2usd.garage import LaneGraph
from garage2usd.garage_sources import check
from garage2usd.maps.drives import DrivePlanner
from garage2usd.pipeline import build
from garage2usd.reading.files import open_stage
from garage2usd.reading.lanes import read_lanes
from garage2usd.structure.lane_graph import LaneSquares
from garage2usd.view.plan_lanes import arrows
from garage2usd.view.plan_picture import route_of

PLAN = "......\n.====E\n.=..=.\n.=..=.\n.====X\n......"
ONE_WAY = [(1, 4), (1, 3), (1, 2), (1, 1), (2, 1), (3, 1), (4, 1), (4, 2), (4, 3), (4, 4)]
"""All lanes but the two on the right, from the entrance to the exit."""


@pytest.fixture
def built(tmp_path, monkeypatch):
    two_way = LaneSquares.lanes.func

    def lanes(self):
        made, number_of = two_way(self), self.number_of
        arcs = {(number_of[one], number_of[other]) for one, other in pairwise(ONE_WAY)}
        turned = [
            edge._replace(start=arc[0], end=arc[1], one_way=True)
            for edge in made.edges
            for arc in edge.arcs
            if arc in arcs
        ]
        kept = [edge for edge in made.edges if not arcs & {*edge.arcs}]
        return LaneGraph(made.nodes, tuple(turned + kept))

    replaced = cached_property(lanes)
    replaced.__set_name__(LaneSquares, "lanes")
    monkeypatch.setattr(LaneSquares, "lanes", replaced)
    settings = {"stage": {"texture_quality": "low"}, "site": {"structure": PLAN}, "seed": 3}
    return build(config_from_mapping(settings), tmp_path / "garage.usdc")


def test_a_direction_is_set_in_one_place(built, tmp_path):
    layout, lanes = built.garage.layout, read_lanes(open_stage(built.stage)).graph
    one_way = {(edge.start, edge.end) for edge in lanes.edges if edge.one_way}
    assert len(one_way) == len(ONE_WAY) - 1 + 2  # and those of the portals
    assert check(built.stage)[0] == []
    proofs = prove_stalls(layout)
    assert all(proof.is_proven for proof in proofs)

    (road_map,) = (path for path in export(built.stage, [tmp_path / "map.xodr"]) if path.suffix == ".xodr")
    roads = [road for road in ET.parse(road_map).iter("road") if road.get("junction") == "-1"]
    driven = [sum(lane.get("type") == "driving" for lane in road.iter("lane")) for road in roads]
    assert {*driven} == {0, 1, 2}  # 0 where stalls alone lie
    assert driven.count(2) == 1  # the road on the right

    for stall in layout.quads:
        route = route_of(layout.lane_graph, stall)
        assert {*pairwise((*route.to_stall, *route.from_stall[1:]))} <= {*lanes.arcs}
    assert len([*arrows(layout.lane_graph)]) == len(lanes.arcs)
    drive = DrivePlanner(garage_of_stage(open_stage(built.stage), source="")).drive()
    assert drive.route.arrival.length_m > 0
