"""The choice among the best lanes by the stalls that they hold."""

from functools import cache

import pytest

from garage2usd import GarageConfig, generate
from garage2usd.planning import completed, dimensioned, plan_lanes, with_directions, with_stall_kinds
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.planning.plan import Plan
from garage2usd.site import make_site

ANGLED = {"kinds": {"angled": 1}, "angles_deg": [60]}
MIXED = {"kinds": {"perpendicular": 0.3, "angled": 0.5, "parallel": 0.2}}


def config_of(seed=0, stalls=MIXED, plan=None, **settings):
    plan = {"episodes": 100, "starts": 1, "aisles": "one-way", **(plan or {})}
    return GarageConfig(seed=seed, site={"width_cells": 10, "height_cells": 8}, plan=plan, stalls=stalls, **settings)


def lanes_of(config):
    site = make_site(config.site, bay=config.bay, seed=config.seed, fittings=config.fittings)
    return plan_lanes(site, plan=config.plan, bay=config.bay, seed=config.seed)


@cache
def planned(seed):
    return lanes_of(config_of(seed))


def floor_m2(plan):
    return plan.structure.floor_m2 / plan.score.stalls


@pytest.mark.parametrize("stalls", [ANGLED, MIXED])
@pytest.mark.parametrize("seed", range(4))
def test_no_finalist_holds_its_stalls_on_less_floor(seed, stalls):
    config, plan = config_of(seed, stalls), planned(seed)
    found = completed(plan, config)
    for entry in plan.archive[:12]:
        if len(circulation(entry.structure).faults(rules_of(config.plan, squares=80))) <= len(found.gave_way):
            lanes = Plan(dimensioned(entry.structure, config.bay), entry.score)
            assert floor_m2(found) <= floor_m2(with_stall_kinds(with_directions(lanes, config), config))
    assert floor_m2(found) <= floor_m2(with_stall_kinds(with_directions(plan, config), config))
    assert len(found.gave_way) <= len(plan.gave_way)
    assert any((found.structure.cells == entry.structure.cells).all() for entry in plan.archive[:12])


def test_some_garage_gains_by_other_lanes():
    configs = [config_of(seed, ANGLED) for seed in range(4)]
    plans = [(planned(config.seed), completed(planned(config.seed), config)) for config in configs]
    assert any((before.structure.cells != after.structure.cells).any() for before, after in plans)


def test_on_given_sides_the_score_decides():
    config = config_of(1, bay={"square_side_m": 8.1})
    plan = lanes_of(config)
    first = with_stall_kinds(with_directions(plan, config), config)
    found = completed(plan, config)
    assert found.score.value >= first.score.value
    assert (found.structure.column_widths_mm == 8100).all()


@pytest.mark.parametrize("aisles", ["two-way", "one-way"])
def test_garages_of_the_usual_stalls_keep_their_lanes(aisles):
    config = config_of(stalls={}, plan={"aisles": aisles})
    plan = lanes_of(config)
    assert completed(plan, config).structure is plan.structure


def test_lanes_that_are_drawn_from_the_archive_stay():
    config = config_of(2, plan={"choice": "draw", "quality_floor": 0.5})
    plan = lanes_of(config)
    assert (completed(plan, config).structure.cells == plan.structure.cells).all()


def test_free_kinds_are_chosen_once():
    config = config_of(3, {"kinds": "free", "sizes": {"standard": 0.6, "large": 0.4}})
    garage = generate(config)
    assert {run.shape.angle_deg for run in garage.plan.runs} == {90.0}
    assert floor_m2(garage.plan) <= floor_m2(with_stall_kinds(with_directions(planned(3), config), config))
