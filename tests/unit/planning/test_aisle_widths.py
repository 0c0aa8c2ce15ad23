"""Widths of aisles by the kind of their stalls, against the clauses of the profiles and the swept path."""

import pytest

from garage2usd import GarageConfig, generate
from garage2usd.checks import check_layout
from garage2usd.driving.garage import prove_garage
from garage2usd.driving.layout_garage import layout_garage
from garage2usd.planning.aisle_widths import one_way_aisle_m
from garage2usd.profiles import load_profile
from garage2usd.structure.stall_shapes import StallShape

LADDER = """
............
E==========.
.=........=.
.=........=.
.==========.
.=........=.
.=........=.
.==========X
............
"""
KEPT = 1e-6


def angled(angle_deg):
    return {"kinds": {"angled": 1}, "angles_deg": [angle_deg]}


def ladder(stalls, aisles="one-way", **settings):
    return generate(GarageConfig(site={"structure": LADDER}, plan={"aisles": aisles}, stalls=stalls, **settings))


@pytest.mark.parametrize(
    ("profile", "angle_deg", "metres"),
    [
        ("cn-jgj100", 45, 3.8),
        ("cn-jgj100", 60, 4.5),
        ("cn-jgj100", 75, 5.0),
        ("cn-jgj100", 0, 3.8),
        ("de-garvo", 60, 4.0),
        # the profile has 3.0 m for both, the swept path more
        ("de-garvo", 45, 3.2),
        ("de-garvo", 0, 3.5),
        ("uk-istructe", 0, None),
        ("cn-jgj100", 90, None),
    ],
)
def test_the_least_width_is_that_of_the_profile_and_of_the_swept_path(profile, angle_deg, metres):
    assert one_way_aisle_m(StallShape(2.4, 5.3, angle_deg), load_profile(profile)) == metres


@pytest.mark.parametrize(
    ("stalls", "metres"), [(angled(45), 3.8), (angled(60), 4.5), ({"kinds": {"parallel": 1}}, 3.8)]
)
def test_one_way_aisles_are_as_wide_as_their_stalls_ask_for(stalls, metres):
    garage = ladder(stalls)
    assert garage.plan.structure.row_depths_mm[4] == pytest.approx(1000 * (metres + 0.7))
    findings = check_layout(garage.layout, garage.config)
    assert not [finding for finding in findings if finding.rule.endswith("aisle-width")]


@pytest.mark.parametrize("stalls", [angled(60), {"kinds": {"parallel": 1}}])
def test_a_car_gets_into_every_stall_of_narrow_aisles(stalls):
    garage = layout_garage(ladder(stalls, profile="de-garvo").layout)
    assert all(proof.is_proven for proof in prove_garage(garage, list(garage.stalls)))


@pytest.mark.parametrize(("stalls", "aisles"), [(angled(60), "two-way"), ({"kinds": {"perpendicular": 1}}, "one-way")])
def test_two_way_aisles_and_those_of_perpendicular_stalls_are_as_wide_as_ever(stalls, aisles):
    garage = ladder(stalls, aisles)
    assert min(edge.width_m for edge in garage.graph.lanes.edges) == garage.config.bay.aisle_width_m


@pytest.mark.parametrize("seed", range(8))
def test_each_aisle_is_wide_enough_for_each_of_its_stalls(seed):
    settings = {"site": {"width_cells": 12, "height_cells": 9}, "plan": {"episodes": 100, "starts": 1}}
    settings["plan"] |= {"aisles": "mixed", "one_way_share": 0.7} if seed % 2 else {"aisles": "one-way"}
    stalls = {"kinds": {"perpendicular": seed % 3, "angled": 3, "parallel": 1}}
    total = sum(stalls["kinds"].values())
    stalls["kinds"] = {kind: share / total for kind, share in stalls["kinds"].items()}
    garage = generate(GarageConfig(seed=seed, stalls=stalls, **settings))
    profile, lanes = garage.config.standard, garage.graph.lanes
    number_of = garage.graph.number_of
    for edge in lanes.edges:
        nodes = [lanes.nodes[edge.start], lanes.nodes[edge.end]]
        if any(node.is_portal for node in nodes):
            continue
        along_x = nodes[0].position[1] == nodes[1].position[1]
        beside = [
            row
            for row in garage.graph.stall_rows
            if number_of[row.edge.beyond(row.square)] in {edge.start, edge.end} and row.edge.along_x == along_x
        ]
        asked = [one_way_aisle_m(row.shape, profile) if edge.one_way else None for row in beside]
        least = [garage.config.bay.aisle_width_m if metres is None else metres for metres in asked]
        assert edge.width_m >= max(least, default=3.0) - KEPT


def test_stalls_against_the_traffic_keep_the_aisle_wide():
    run = {"first": (3, 2), "last": (3, 9), "edge": "down", "kind": "angled", "angle_deg": 60}
    widths = []
    for leans in ("with traffic", "against traffic"):
        garage = ladder({"runs": [{**run, "leans": leans}], "only_runs": True})
        widths.append(garage.plan.structure.row_depths_mm[4] / 1000 - 0.7)
    assert widths == pytest.approx([4.5, 6.0])


def test_given_sides_stay():
    garage = ladder(angled(60), bay={"square_side_m": 8.1})
    assert (garage.plan.structure.row_depths_mm == 8100).all()
