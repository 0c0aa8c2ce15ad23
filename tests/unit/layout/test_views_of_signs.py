"""Signs over vehicle doors as drivers see them: no raised barrier arm is in the way."""

import numpy as np
import pytest
from support.overlaps import Solids
from support.sight import EYE_M, part_named, share_hidden, spread_over, triangles, world
from support.small_survey import surveyed

from garage2usd.config import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

PLANS = ("..........\nE========X\n..........", "..........\nX========E\n..........")
"""The first door's gate is raised: that of the entrance, then that of the exit."""
BEFORE_M = np.array([4.0, 7.0, 12.0, 20.0, 30.0, 45.0])


def laid_out(text, **fittings):
    config = GarageConfig(fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def doors_with_gates(layout):
    gates = {gate.name.removeprefix("Barrier"): gate for gate in layout.of_kind("barrier")}
    return [(door, gates[door.name.removeprefix("Portal")]) for door in layout.of_kind("portal") if door.spec.is_open]


def assert_signs_are_seen(layout):
    """From both sides of the lane, near and far, no more of a sign than a hundredth is behind its gate."""
    raised = 0
    for door, gate in doors_with_gates(layout):
        names = {part.name for part in door.spec.asset().parts}
        if "SignLegend" not in names:
            continue
        points = spread_over(world(door, part_named(door, "SignLegend").points))
        side = door.spec.door_width_m / 4
        eyes = [(across, EYE_M, far) for across in (-side, 0.0, side) for far in BEFORE_M.tolist()]
        assert share_hidden(world(door, eyes), points, triangles(gate)) < 0.01, (door.name, gate.spec)
        raised += gate.spec.is_raised
    return raised


@pytest.mark.parametrize("heights", [(3.2, 2.2), (2.8, 2.2), (3.6, 2.5), (4.5, 2.2), (8.0, 2.2)])
@pytest.mark.parametrize("plan", PLANS, ids=["entrance", "exit"])
def test_raised_arms_hide_no_sign_over_a_door(plan, heights):
    ceiling_m, clear_m = heights
    layout = laid_out(plan, ceiling_height_m=ceiling_m, clear_height_m=clear_m)
    assert assert_signs_are_seen(layout) == 1
    for door, gate in doors_with_gates(layout):
        low_m, high_m = door.spec.sign_heights_m
        assert high_m - low_m >= 0.2
        if gate.spec.is_raised:
            arm = triangles(gate)[:, :, 1]
            over = arm[(arm.min(axis=1) > 1.5)]
            assert over.max() < ceiling_m - 0.1
    assert not [names for names in Solids(layout).clashes() if "barrier" in {each.kind for each in names}]


def test_a_gate_is_lowered_where_its_arm_would_leave_no_legible_sign():
    layout = laid_out(PLANS[1], ceiling_height_m=2.62)
    (door, gate), *_ = doors_with_gates(layout)
    assert not gate.spec.is_raised
    assert door.spec.sign_heights_m[1] - door.spec.sign_heights_m[0] > 0.15
    assert assert_signs_are_seen(layout) == 0


def test_signs_over_the_doors_of_an_import_are_seen_past_raised_arms(tmp_path):
    assert assert_signs_are_seen(surveyed(tmp_path)) == 1
