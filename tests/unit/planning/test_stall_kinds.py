from collections import Counter
from pathlib import Path

import pytest

from garage2usd import ConfigError, GarageConfig, generate, load_config
from garage2usd.checks import judged_layout
from garage2usd.garage import StallKind
from garage2usd.planning import given_plan, runs_of_settings, settings_of_runs, with_stall_kinds
from garage2usd.structure.grid import cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph
from garage2usd.structure.stall_runs import capacity_of_runs

SMALL = {"site": {"width_cells": 9, "height_cells": 7}, "plan": {"episodes": 100, "starts": 1}}
LARGE = {"site": {"width_cells": 20, "height_cells": 16}, "plan": {"episodes": 100, "starts": 1}}
SAMPLES = Path(__file__).parents[3] / "samples"
MIXED = {"perpendicular": 0.6, "angled": 0.25, "parallel": 0.15}


def shares_of(garage, of=lambda stall: str(stall.stall_kind)):
    names = [of(stall) for stall in garage.layout.stalls]
    return {name: names.count(name) / len(names) for name in sorted(set(names))}


@pytest.mark.parametrize("seed", range(3))
def test_the_stalls_have_the_shares_of_their_kinds(seed):
    garage = generate(GarageConfig(seed=seed, stalls={"kinds": MIXED}, **LARGE))
    assert shares_of(garage) == pytest.approx(MIXED, abs=0.05)


@pytest.mark.parametrize("kind", ["perpendicular", "angled", "parallel"])
def test_all_stalls_can_be_of_one_kind(kind):
    garage = generate(GarageConfig(stalls={"kinds": {kind: 1, "perpendicular": kind == "perpendicular"}}, **SMALL))
    assert shares_of(garage) == {kind: 1.0}


def test_sizes_are_drawn_too():
    sizes = {"standard": 0.5, "compact": 0.3, "van": 0.2}
    garage = generate(GarageConfig(stalls={"sizes": sizes}, **LARGE))
    widths = {2.4: "standard", 2.3: "compact", 3.0: "van"}
    assert shares_of(garage, lambda stall: widths[stall.width_m]) == pytest.approx(sizes, abs=0.06)


def test_a_garage_of_one_kind_has_no_runs():
    garage = generate(GarageConfig(**SMALL))
    assert garage.plan.runs == ()
    assert garage.plan is with_stall_kinds(garage.plan, garage.config)


def test_the_score_counts_the_stalls_of_the_runs():
    garage = generate(GarageConfig(stalls={"kinds": MIXED}, **SMALL))
    capacity = capacity_of_runs(garage.plan.structure, garage.config.bay, garage.plan.runs)
    assert garage.plan.score.stalls == capacity.sum() == sum(row.count for row in garage.graph.stall_rows)


def test_given_sides_are_kept_and_what_does_not_fit_them_is_left_out():
    bay = {"square_side_m": 5.4, "column_size_m": 0.4}
    garage = generate(GarageConfig(bay=bay, stalls={"kinds": {"angled": 1, "perpendicular": 1}}, **SMALL))
    assert (garage.plan.structure.column_widths_mm == 5400).all()
    # at 60 and 75 degrees stalls are deeper than 5.4 m, at 45 degrees 5.445 m
    assert shares_of(garage) == {"perpendicular": 1.0}


def test_the_runs_of_a_plan_give_the_same_garage_again():
    garage = generate(GarageConfig(stalls={"kinds": MIXED}, **SMALL))
    structure, config = garage.plan.structure, garage.config
    given = GarageConfig(
        **{
            **config.model_dump(),
            "site": {"structure": str(structure)},
            "bay": {
                **config.bay.model_dump(),
                "dimensioned": False,
                "column_widths_m": structure.R[0],
                "row_depths_m": structure.C[:, 0],
            },
            "stalls": {
                **config.stalls.model_dump(),
                "runs": [run.model_dump() for run in settings_of_runs(garage.plan.runs)],
                "only_runs": True,
            },
        }
    )
    again = generate(given)
    assert again.plan.runs == garage.plan.runs
    assert list(again.layout.stalls) == list(garage.layout.stalls)


def test_settings_of_runs_are_the_inverse_of_runs_of_settings():
    garage = generate(GarageConfig(stalls={"kinds": MIXED}, **SMALL))
    assert tuple(runs_of_settings(settings_of_runs(garage.plan.runs), garage.config)) == garage.plan.runs


GIVEN = {"first": (1, 0), "last": (1, 2), "edge": "up", "kind": "angled", "angle_deg": 45}


def given_garage(**changed):
    return GarageConfig(
        site={"structure": "E==X\n...."},
        bay={"square_side_m": 8.1},
        stalls={"runs": [{**GIVEN, **changed}], "only_runs": True},
    )


def test_a_given_run_has_its_kind_and_no_other_square_has_stalls():
    config = given_garage(first=(1, 1))
    garage = generate(config)
    assert {stall.square for stall in garage.layout.stalls} <= {(1, 1), (1, 2)}
    assert {stall.angle_deg for stall in garage.layout.stalls} == {45.0}


@pytest.mark.parametrize(
    ("changed", "field"),
    {
        "no lane beyond the edge": ({"edge": "down"}, "stalls.runs[0]"),
        "outside": ({"last": (1, 9)}, "stalls.runs[0]"),
        "not in a line": ({"last": (2, 2)}, "stalls.runs.0"),
        "backwards": ({"first": (1, 2), "last": (1, 0)}, "stalls.runs.0"),
        "an angle for parallel stalls": ({"kind": "parallel"}, "stalls.runs.0"),
        "angled without an angle": ({"angle_deg": None}, "stalls.runs.0"),
        "too flat an angle": ({"angle_deg": 10}, "stalls.runs.0.angle_deg"),
    }.values(),
)
def test_a_run_that_cannot_be_is_refused_by_its_field(changed, field):
    with pytest.raises(ConfigError) as error:
        generate(given_garage(**changed))
    assert error.value.field == field


@pytest.mark.parametrize(
    ("stalls", "field"),
    [
        ({"kinds": {"perpendicular": 0}}, "stalls"),
        ({"sizes": {"standard": 0.0}}, "stalls"),
        ({"kinds": {"slanted": 1}}, "stalls.kinds.slanted"),
        ({"sizes_m": {"standard": (2, 5)}}, "stalls"),
        ({"only_runs": True}, "stalls"),
        ({"angles_deg": []}, "stalls.angles_deg"),
    ],
)
def test_shares_that_say_nothing_are_refused(stalls, field):
    with pytest.raises(ConfigError) as error:
        GarageConfig(stalls=stalls)
    assert error.value.field.startswith(field.split(".")[0])


def test_the_paper_s_matrices_are_those_of_the_plan_before_kinds():
    site = cells_from_text("E===X\n.....\n.....", field="S")
    config = GarageConfig(site={"structure": "E===X\n.....\n....."}, stalls={"kinds": {"angled": 1}})
    garage = generate(config)
    assert (garage.plan.structure.cells == site).all()
    plan = given_plan(garage.site, bay=config.bay)
    assert (plan.structure.cells == garage.plan.structure.cells).all()
    build_lane_graph(garage.plan.structure, config.bay, garage.plan.runs)


@pytest.mark.parametrize(
    ("sample", "gross_m2"), [("mixed_stalls.toml", 37.0), ("two_levels.toml", 33.0), ("three_levels.toml", 45.0)]
)
def test_samples_take_the_floor_that_the_planner_reached(sample, gross_m2):
    garage = generate(load_config(SAMPLES / sample))
    ground_m2 = sum(level.layout.area.gross_m2 for level in garage.levels)
    assert ground_m2 / garage.parking_stalls <= gross_m2


@pytest.mark.parametrize(("angle_deg", "clear_m"), [(45, 3.8), (60, 4.5), (75, 5.0)])
def test_one_way_aisles_of_angled_stalls_are_as_wide_as_the_profile_asks(angle_deg, clear_m):
    stalls = {"kinds": {"angled": 1}, "angles_deg": [angle_deg]}
    plan = {**SMALL["plan"], "aisles": "one-way"}
    garage = generate(GarageConfig(seed=1, site=SMALL["site"], plan=plan, stalls=stalls))
    widths_m = {round(edge.width_m, 3) for edge in garage.lanes.edges}
    assert min(widths_m) == pytest.approx(clear_m, abs=0.01)
    both_ways = generate(GarageConfig(seed=1, stalls=stalls, **SMALL))
    assert min(edge.width_m for edge in both_ways.lanes.edges) >= garage.config.bay.aisle_width_m - 0.01
    findings, _ = judged_layout(garage.layout, garage.config)
    assert not {"angled-aisle-width", "column-clearance", "column-in-stall"} & {finding.rule for finding in findings}


def test_parallel_stalls_stand_in_rows():
    garage = generate(GarageConfig(seed=4, stalls={"kinds": MIXED}, **LARGE))
    parallel = [run for run in garage.plan.runs if run.shape.kind is StallKind.PARALLEL]
    assert parallel
    assert all(len(run.squares) > 1 for run in parallel)


def on_fixed_squares(side_m, **stalls):
    site, bay = {"width_cells": 9, "height_cells": 7}, {"dimensioned": False, "square_side_m": side_m}
    return GarageConfig(seed=1, site=site, bay=bay, stalls=stalls)


def test_shares_that_a_site_does_not_hold_are_told_in_one_line():
    garage = generate(on_fixed_squares(5.4, kinds={"perpendicular": 0.6, "parallel": 0.4}))
    asked, held = "perpendicular = 0.60, parallel = 0.40", "perpendicular = 1.00, parallel = 0.00"
    assert garage.remarks == (f"stalls.kinds: got {asked}; the lanes planned on this site hold {held}",)
    # what is told are the shares of the stalls that were planned
    mixed = generate(on_fixed_squares(8.1, kinds={"perpendicular": 0.1, "angled": 0.9}, angles_deg=[60]))
    counts = Counter()
    for row in mixed.graph.stall_rows:
        counts[row.shape.kind.value] += row.count
    is_far = abs(counts["angled"] / counts.total() - 0.9) > 0.05
    assert len(mixed.remarks) == is_far
    assert all(f"angled = {counts['angled'] / counts.total():.2f}" in line.split(";")[1] for line in mixed.remarks)
    assert generate(on_fixed_squares(8.1)).remarks == ()


@pytest.mark.parametrize(("side_m", "asked_deg", "nearest_deg"), [(5.4, 75, 43), (5.6, 75, 82)])
def test_angles_that_no_square_holds_are_refused_with_the_nearest_one(side_m, asked_deg, nearest_deg):
    with pytest.raises(ConfigError, match=rf"stalls.angles_deg: got \[{asked_deg}.0\]; allowed: {nearest_deg}, "):
        generate(on_fixed_squares(side_m, kinds={"angled": 1.0}, angles_deg=[asked_deg]))
    garage = generate(on_fixed_squares(side_m, kinds={"angled": 1.0}, angles_deg=[nearest_deg]))
    assert {stall.angle_deg for stall in garage.layout.stalls} == {nearest_deg}
