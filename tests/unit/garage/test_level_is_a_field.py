"""Levels and heights are set in one place, the nodes of the lane graph, and reach stalls, the stage and its reader."""

from dataclasses import replace
from functools import cached_property

import pytest
from pxr import Sdf, Usd, Vt

from garage2usd.config import config_from_mapping
from garage2usd.garage import LaneGraph
from garage2usd.layout import lay_out
from garage2usd.reading.lanes import read_lanes
from garage2usd.stage.curves import write_lane_graph
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import LaneSquares, build_lane_graph

PLAN = "......\n.====E\n.=..=.\n.=..=.\n.====X\n......"
LOWER_M = -3.3
LOWER_FROM_ROW = 3


@pytest.fixture
def layout(monkeypatch):
    one_level = LaneSquares.lanes.func

    def lanes(self):
        made = one_level(self)
        nodes = tuple(
            replace(node, height_m=LOWER_M, level=1) if row >= LOWER_FROM_ROW else node
            for node, (row, _) in zip(made.nodes, self.number_of, strict=True)
        )
        return LaneGraph(nodes, made.edges)

    replaced = cached_property(lanes)
    replaced.__set_name__(LaneSquares, "lanes")
    monkeypatch.setattr(LaneSquares, "lanes", replaced)
    config = config_from_mapping({"seed": 3})
    structure = Structure.from_arrays(cells_from_text(PLAN, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


@pytest.fixture
def stage(layout, tmp_path):
    write_lane_graph(tmp_path / "LaneGraph.usda", layout)
    stage = Usd.Stage.CreateInMemory()
    stage.SetMetadata("metersPerUnit", 1.0)
    stage.SetMetadata("upAxis", "Y")
    root = stage.DefinePrim("/Garage")
    stage.SetDefaultPrim(root)
    stage.DefinePrim("/Garage/LaneGraph").GetReferences().AddReference(str(tmp_path / "LaneGraph.usda"))
    return stage


def test_levels_and_heights_of_nodes_are_those_of_stalls_and_of_the_stage(layout, stage):
    read = read_lanes(stage)
    assert not read.faults
    assert {(node.level, round(node.height_m, 5)) for node in read.nodes} == {(0, 0.0), (1, LOWER_M)}
    assert [node.level for node in read.nodes] == [node.level for node in layout.lane_graph.nodes]
    assert {stall.level for stall in layout.quads} == {0, 1}
    for stall, made in zip(read.stalls, layout.quads, strict=True):
        assert stall.level == made.level == layout.lane_graph.nodes[made.access].level
    climbs = {round(climb_m, 5) for *_, climb_m in read.graph.graph.edges(data="climb_m")}
    assert climbs == {0.0, LOWER_M, -LOWER_M}
    assert read.graph.floor_m(1) == pytest.approx(LOWER_M)


def test_levels_that_are_no_numbers_are_a_fault(stage):
    nodes = stage.GetPrimAtPath("/Garage/LaneGraph/Nodes")
    nodes.RemoveProperty("garage:lane:level")
    count = len(nodes.GetAttribute("garage:lane:kind").Get())
    stage.SetEditTarget(stage.GetSessionLayer())
    attribute = nodes.CreateAttribute("garage:lane:level", Sdf.ValueTypeNames.TokenArray)
    attribute.SetTypeName(Sdf.ValueTypeNames.TokenArray)
    attribute.Set(Vt.TokenArray(["U2"] * count))
    read = read_lanes(stage)
    assert [fault.message for fault in read.faults] == ["garage:lane:level that is not whole numbers"]
    assert {node.level for node in read.nodes} == {0}
