"""Tapes of whole plans: lanes, directions and stalls, there and back."""

import numpy as np
import pytest
from support.soak import soak_but

from garage2usd import ConfigError, GarageConfig, generate
from garage2usd.common.errors import Garage2UsdError, GenerationError
from garage2usd.config.stalls import SizeClass
from garage2usd.planning import plan_tape_of, play_plan, rank_of, tail_of, tape_at, tape_of
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell

QUICK = {"episodes": 100, "starts": 1}
SMALL = {"width_cells": 9, "height_cells": 7}


def mixed(seed):
    """The settings of a garage with drawn shares of everything."""
    rng = np.random.default_rng(seed)
    kinds = dict(zip(("perpendicular", "angled", "parallel"), rng.dirichlet([1, 1, 1]).tolist(), strict=True))
    sizes = dict(zip(map(str, SizeClass), rng.dirichlet([4, *[1] * (len(SizeClass) - 1)]).tolist(), strict=True))
    return GarageConfig(
        seed=seed,
        site={
            "width_cells": int(rng.integers(9, 15)),
            "height_cells": int(rng.integers(7, 12)),
            "rectangles": int(rng.integers(0, 4)),
            "obstacles": int(rng.integers(0, 2)),
        },
        plan={**QUICK, "aisles": ["two-way", "one-way", "mixed"][seed % 3], "one_way_share": float(rng.random())},
        stalls={
            "kinds": kinds,
            "sizes": sizes if seed % 2 else {"standard": 1},
            "angles_deg": rng.uniform(30, 85, 3).round(int(rng.integers(0, 15))).tolist(),
        },
    )


def site_of(config):
    return make_site(config.site, bay=config.bay, seed=config.seed, fittings=config.fittings)


def without_draws(config):
    """The same settings, which ask for usual stalls on two-way aisles."""
    return GarageConfig(seed=config.seed, site=config.site, bay=config.bay, profile=config.profile)


@pytest.mark.parametrize("seed", soak_but(6, range(30)))
def test_plans_and_tapes_correspond_one_to_one(seed):
    config = mixed(seed)
    plan = generate(config).plan
    tape = plan_tape_of(plan)
    again = play_plan(site_of(config), tape_at(rank_of(tape)), without_draws(config))
    assert again.structure == plan.structure
    assert again.directions == plan.directions
    assert again.runs == plan.runs
    assert again.score == plan.score
    assert plan_tape_of(again) == tape


def test_a_tape_makes_the_same_garage_though_its_settings_ask_for_none_of_it():
    config = mixed(4)
    garage = generate(config)
    again = generate(without_draws(config), tape=plan_tape_of(garage.plan))
    assert list(again.layout.stalls) == list(garage.layout.stalls)
    assert again.graph.lanes.nodes == garage.graph.lanes.nodes
    assert again.graph.lanes.edges == garage.graph.lanes.edges


def test_a_plan_of_the_usual_stalls_has_the_tape_of_its_lanes():
    plan = generate(GarageConfig(site=SMALL, plan=QUICK)).plan
    assert plan_tape_of(plan) == tape_of(plan.structure)
    assert tail_of(plan) == ""


def test_a_tape_of_lanes_alone_leaves_the_rest_to_the_settings():
    config = mixed(1)
    garage = generate(config)
    again = generate(config, tape=tape_of(garage.plan.structure))
    assert again.plan.runs == garage.plan.runs
    assert again.plan.directions == garage.plan.directions


RING = "E====.\n.=..=.\n.====X\n......"
ONE_ANGLED_RUN = {
    "runs": [{"first": (1, 2), "last": (1, 3), "edge": "up", "kind": "angled", "angle_deg": 60}],
    "only_runs": True,
}


def test_a_tape_by_hand():
    config = GarageConfig(site={"structure": RING}, plan={"one_way": [((0, 1), (0, 2))]}, stalls=ONE_ANGLED_RUN)
    tail = tail_of(generate(config).plan)
    # version 1; directions; the ring is one stretch, driven as it is read
    head = "US" + "US" + "US"
    # one stall: angled, standard, an angle without decimals, 60 = (3 * 4 + 2) * 4 + 4
    stall = "US" + "US" + "S" + "S" + "LDRS"
    # beside the ring on its right and its left; the run, up to the end of its line; its other three sides; below
    lines = "SS" + "SS" + "USS" + "SS" * 3 + "SS"
    assert tail == head + stall + lines


def small_garage():
    settings = {"site": {"structure": RING}, "plan": {"aisles": "one-way"}}
    config = GarageConfig(**settings, stalls={"kinds": {"angled": 0.6, "parallel": 0.4}})
    site = config.site.model_copy(update={"structure": RING.replace("=", ".")})
    return generate(config).plan, GarageConfig(site=site, bay=config.bay)


def test_a_letter_that_is_changed_lost_or_added_is_another_plan_or_an_error():
    plan, config = small_garage()
    tape, site = plan_tape_of(plan), site_of(config)
    lanes = len(tape_of(plan.structure))
    told, played = set(), 0
    for place in range(lanes, len(tape)):
        letters = ["", *"UDLRS", *(letter + tape[place] for letter in "UDLRSX")]
        for letter in letters:
            changed = tape[:place] + letter + tape[place + 1 :]
            if changed == tape:
                continue
            try:
                again = play_plan(site, changed, config)
            except (ConfigError, GenerationError) as error:
                told.add(type(error))
            else:
                assert plan_tape_of(again) == changed
                played += 1
    assert ConfigError in told
    assert played


def test_a_tape_that_is_cut_off_says_where():
    plan, config = small_garage()
    tape, site = plan_tape_of(plan), site_of(config)
    lanes = len(tape_of(plan.structure))
    for end in range(lanes + 1, len(tape)):
        with pytest.raises(ConfigError) as error:
            play_plan(site, tape[:end], config)
        assert error.value.field.startswith("tape[")
        assert error.value.allowed.endswith("; the tape ends here")
    assert play_plan(site, tape[:lanes], config).runs == ()


@pytest.mark.parametrize(
    ("tail", "field", "allowed"),
    {
        "another version": ("DSSS", "tape", "version 1"),
        "no version": ("SSS", "tape", "version 1"),
        "an unknown letter": ("UxS", "tape[{1}]", "letters U, D, L, R and S"),
        "neither two-way nor directions": ("USDS", "tape[{2}]", "0 for two-way aisles"),
        "an unknown direction": ("USUSLS", "tape[{4}]", "0, 1 or 2 for the direction"),
        "an unknown kind": ("USSUSLS", "tape[{5}]", "for the kind of stalls"),
        "an unknown size class": ("USSUSSRRRS", "tape[{6}]", "for the size class of stalls"),
        "too flat an angle": ("USSUSUSSSUS", "tape", "angles of 30 to 85 degrees"),
        "a number without end": ("U" * 100, "tape[{0}]", "the version"),
        "letters behind the end": ("USUSUSSUS", "tape[{7}]", "the end of the tape"),
        "nothing but the usual": ("USSS", "tape", "the canonical form"),
    }.values(),
)
def test_what_no_plan_has_is_refused(tail, field, allowed):
    plan, config = small_garage()
    lanes = tape_of(plan.structure)
    with pytest.raises(ConfigError) as error:
        play_plan(site_of(config), lanes + tail, config)
    place = int(field[6:-2]) if "[" in field else None
    assert error.value.field == (field if place is None else f"tape[{len(lanes) + place}]")
    assert allowed in error.value.allowed


def test_directions_by_which_a_stall_is_not_reached_are_refused():
    drawing = "E=.\n.=.\n.=.\nX=="
    plan = generate(GarageConfig(site={"structure": drawing})).plan
    config = GarageConfig(site={"structure": drawing.replace("=", ".")})
    with pytest.raises(GenerationError, match="along the directions of the tape"):
        # a single stretch, driven from the exit to the entrance
        play_plan(site_of(config), tape_of(plan.structure) + "USUSDSS", config)


def test_runs_that_share_squares_have_no_tape():
    run = ONE_ANGLED_RUN["runs"][0]
    stalls = {"runs": [run, {**run, "last": (1, 2)}], "only_runs": True}
    plan = generate(GarageConfig(site={"structure": RING}, stalls=stalls)).plan
    with pytest.raises(ConfigError):
        plan_tape_of(plan)


def test_a_tape_beside_lanes_is_refused():
    plan, _ = small_garage()
    with pytest.raises(Garage2UsdError, match="no tape beside a structure that has lanes"):
        generate(GarageConfig(site={"structure": RING}), tape=plan_tape_of(plan))


def test_the_lanes_of_a_tape_are_those_of_the_paper():
    plan, config = small_garage()
    tape = plan_tape_of(plan)
    steps = tape.index("S")
    assert steps == 2 * (plan.structure.cells == Cell.LANE).sum() - 1
    assert play_plan(site_of(config), tape[: steps + 1], config).directions.one_way == frozenset()
