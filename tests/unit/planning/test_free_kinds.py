"""The kind of stall that planning chooses, against each kind alone and against endless modules."""

import pytest
from support.benchmarks import benchmark
from support.soak import soak_but

from garage2usd import ConfigError, GarageConfig, generate
from garage2usd.profiles import PROFILE_NAMES, load_profile, read_profile
from garage2usd.reading.report import Report
from garage2usd.report import make_report

stall_kinds = benchmark("stall_kinds")

FREE = {"kinds": "free"}
SMALL = {"site": {"width_cells": 10, "height_cells": 8}, "plan": {"episodes": 100, "starts": 1, "aisles": "one-way"}}
COLS = 16
LADDER = "\n".join(
    [
        "." * COLS,
        f"E{'=' * (COLS - 2)}.",
        *[f".={'.' * (COLS - 4)}=."] * 2,
        f".{'=' * (COLS - 2)}.",
        *[f".={'.' * (COLS - 4)}=."] * 2,
        f".{'=' * (COLS - 2)}X",
        "." * COLS,
    ]
)
"""Three long aisles, which are all turned to one way."""


def with_aisle(metres, name="cn-jgj100"):
    """A profile whose aisles between perpendicular stalls are wider."""
    settings = load_profile(name).model_dump(mode="json", exclude_none=True)
    settings["aisle_width"]["value"] = metres
    return read_profile({**settings, "name": "client"})


def kinds_alone(angles_deg=(60, 45, 75)):
    angled = [{"kinds": {"angled": 1}, "angles_deg": [angle]} for angle in angles_deg]
    return [{"kinds": {"perpendicular": 1}}, *angled, {"kinds": {"parallel": 1}}]


def angles_of(garage):
    return {stall.angle_deg for stall in garage.layout.stalls}


@pytest.mark.parametrize("profile", soak_but(["de-garvo"], PROFILE_NAMES))
@pytest.mark.parametrize("aisles", ["two-way", "one-way"])
def test_the_kind_is_that_of_the_module_with_the_least_floor(profile, aisles):
    garage = generate(
        GarageConfig(**SMALL | {"plan": SMALL["plan"] | {"aisles": aisles}}, profile=profile, stalls=FREE)
    )
    modules = stall_kinds.best_modules(load_profile(profile), garage.config.bay)
    assert angles_of(garage) == {min(modules, key=modules.__getitem__).angle_deg}


@pytest.mark.parametrize("settings", soak_but(1, [SMALL, {"profile": with_aisle(12.0), "site": {"structure": LADDER}}]))
def test_no_kind_alone_needs_less_floor(settings):
    def floor_m2(stalls):
        plan = generate(GarageConfig(stalls=stalls, **settings)).plan
        return plan.structure.floor_m2 / plan.score.stalls

    assert floor_m2(FREE) == min(map(floor_m2, kinds_alone()))


def test_a_free_garage_of_perpendicular_stalls_is_the_usual_one():
    free, usual = (generate(GarageConfig(stalls=stalls, **SMALL)) for stalls in (FREE, {}))
    assert free.plan.runs == ()
    assert free.plan.structure == usual.plan.structure
    assert list(free.layout.placements) == list(usual.layout.placements)


def test_sizes_are_drawn_for_the_kind_that_is_chosen():
    stalls = {**FREE, "sizes": {"standard": 0.7, "compact": 0.3}}
    garage = generate(GarageConfig(stalls=stalls, **SMALL))
    assert {run.shape.size for run in garage.plan.runs} == {"standard", "compact"}
    assert angles_of(garage) == {90.0}


def test_a_report_gives_the_chosen_kind_without_choosing():
    garage = generate(GarageConfig(stalls=FREE, **SMALL))
    report = make_report(garage, seconds={})
    again = Report.model_validate_json(report.model_dump_json()).garage_config()
    assert not again.stalls.is_free
    assert generate(again).plan.structure == garage.plan.structure


def test_another_word_for_kinds_is_refused():
    with pytest.raises(ConfigError, match="'free', or the share of each kind") as error:
        GarageConfig(stalls={"kinds": "any"})
    assert error.value.field == "stalls.kinds"
