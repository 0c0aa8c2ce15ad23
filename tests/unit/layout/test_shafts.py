"""Stair shafts: cores above one another on levels with different lanes."""

from dataclasses import replace

import pytest
import shapely

from garage2usd import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.layout.egress.exits import plan_egress
from garage2usd.layout.egress.shafts import LevelPlan
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

CONFIG = GarageConfig(seed=3, profile="uk-istructe", parking={"occupancy": 1.0})
AT_THE_TOP = """
............
E==========X
............
............
............
............
"""
ACROSS = """
............
.==========X
.=........=.
.=........=.
E==========.
............
"""
AT_THE_FOOT = """
............
............
............
............
E==========X
............
"""


def level(text):
    structure = Structure.from_arrays(cells_from_text(text.strip(), field="site.structure"), 8.1, 8.1)
    return LevelPlan(structure, build_lane_graph(structure, CONFIG.bay), CONFIG)


def laid_out(levels):
    return [
        lay_out(level.structure, level.graph, CONFIG, egress=egress)
        for level, egress in zip(levels, plan_egress(levels), strict=True)
    ]


def blocks(cores):
    return {replace(core, recess_m=0.0).ground.normalize().wkt for core in cores}


def assert_built_in_free_ground(layout):
    """Cores and shafts replace the stalls in their way, and their cars; doors open to a lane."""
    grounds = [core.ground for core in (*layout.cores, *layout.shafts)]
    assert grounds
    taken = shapely.union_all(grounds)
    for stall in layout.quads:
        assert stall.polygon.intersection(taken).area < 1e-6
    assert not {stall.name for stall in layout.quads} & {name for core in layout.cores for name in core.stalls}
    lanes = shapely.union_all(
        [shapely.box(*_bounds(layout.structure, square)) for square in layout.source.lane_squares.graph.nodes]
    )
    for core in layout.cores:
        passage = core.ground.difference(shapely.from_wkt(next(iter(blocks([core])))))
        assert passage.area == pytest.approx(core.width_m * core.recess_m, abs=1e-6)
        assert 0.5 <= core.recess_m <= 3.6
        assert passage.distance(lanes) < 1e-6
        assert core.ground.intersection(lanes).area < 1e-6


def _bounds(structure, square):
    row, col = square
    x, z = structure.column_edges_m, structure.row_edges_m
    return x[col], z[row], x[col + 1], z[row + 1]


def test_cores_of_different_lanes_stand_above_one_another():
    top, low = laid_out([level(AT_THE_TOP), level(ACROSS)])
    assert blocks(low.cores) <= blocks(top.cores) | blocks(top.shafts)
    assert len(low.cores) == len(top.cores) == 2
    for layout in (top, low):
        assert_built_in_free_ground(layout)


def test_a_shaft_passes_a_level_without_a_lane_there_and_ends_at_one_above():
    top, low = laid_out([level(AT_THE_TOP), level(AT_THE_FOOT)])
    assert blocks(top.shafts) == blocks(low.cores)
    assert not blocks(top.cores) & blocks(low.cores)
    assert not low.shafts
    for layout in (top, low):
        assert_built_in_free_ground(layout)
    closed = [place for place in top.of_kind("obstacle") if place.name.startswith("Shaft_")]
    assert len(closed) == 2
    assert shapely.distance(*[core.ground for core in low.cores]) > 30
    assert not any(place.spec.has_door for place in closed)


def test_one_level_has_the_cores_that_it_had_alone():
    alone = level(ACROSS)
    egress = plan_egress([alone])[0]
    layout = lay_out(alone.structure, alone.graph, CONFIG)
    assert egress.cores == layout.cores
    assert egress.shafts == ()
