"""Difficulty of stalls and garages: its features, its ranks in the reference set, and the set itself."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.sample_files import REPOSITORY

from garage2usd import GarageConfig, generate
from garage2usd.common.documents import json_text
from garage2usd.common.errors import ConfigError
from garage2usd.config.plan import UnreachableStalls
from garage2usd.datasets.difficulty import (
    REFERENCE_FILE,
    Level,
    garage_difficulty,
    midranks,
    ranked,
    reference,
    scores_of,
    stall_difficulties,
)
from garage2usd.datasets.reference import make_reference, reference_settings, reference_stalls
from garage2usd.datasets.stall_features import StallFeatures, measured_stalls
from garage2usd.driving import prove_stalls

QUICK = {"episodes": 100, "climb_top": 2}
STALL = StallFeatures("Stall_r00_c00_1", 1, 1, 0.12, True, 6.0, 1, 50.0)
NARROW = {
    "structure": """
#######
E====.#
#..=..X
#..====
#..=..#
#######
""",
    "bay": {"row_depths_m": [8.1, 8.1, 5.4, 3.2, 5.4, 8.1], "column_widths_m": 8.1},
}
UNPROVEN = StallFeatures("Stall_r00_c00_2", None, None, None, None, 5.0, 2, 50.0)


@pytest.fixture(scope="module")
def garage():
    return generate(GarageConfig(seed=3, site={"height_cells": 6, "width_cells": 7}, plan=QUICK))


@pytest.fixture(scope="module")
def proofs(garage):
    return prove_stalls(garage.layout)


@pytest.fixture(scope="module")
def features(garage, proofs):
    return measured_stalls(garage, proofs=proofs)


def test_features_are_those_of_the_proofs(features, proofs):
    assert [stall.stall for stall in features] == [proof.stall for proof in proofs]
    for stall, proof in zip(features, proofs, strict=True):
        assert stall.is_proven
        assert (stall.gear_changes_in, stall.gear_changes_out) == (
            proof.way_in.gear_changes,
            proof.way_out.gear_changes,
        )
        assert stall.clearance_m == pytest.approx(min(proof.way_in.clearance_m, proof.way_out.clearance_m), abs=1e-6)
        assert stall.is_clear_when_full is proof.is_full


def test_proofs_are_asked_where_none_are_given(garage, features):
    assert measured_stalls(garage) == features


def test_proofs_of_another_garage_are_refused(garage, proofs):
    with pytest.raises(ConfigError, match=r"a proof for each of the \d+ stalls, in order"):
        stall_difficulties(garage, proofs=proofs[1:])


def test_the_aisle_is_as_wide_as_asked(garage, features):
    widths = {stall.aisle_width_m for stall in features}
    assert min(widths) == garage.config.bay.aisle_width_m


def test_light_is_that_of_the_layout(garage):
    layout = garage.layout
    stalls = {stall.stall: stall.illuminance_lux for stall in measured_stalls(garage)}
    if len(stalls) == len(layout.stalls):
        assert np.mean(list(stalls.values())) == pytest.approx(layout.illuminance.stalls.mean, abs=0.01)
    assert min(stalls.values()) >= layout.illuminance.stalls.minimum - 0.01
    assert max(stalls.values()) <= layout.illuminance.stalls.maximum + 0.01


def test_neighbours_are_those_that_a_driver_sees_left_and_right(garage, features):
    layout = garage.layout
    taken = {car.stall for car in layout.of_kind("car")}
    stalls = {stall.name: stall for stall in layout.stalls}
    for stall in features:
        own = stalls[stall.stall]
        beside = 0
        for side in (-1, 1):
            near = [
                (abs(x), other)
                for name, other in stalls.items()
                if name != stall.stall and other.edge == own.edge
                # in line, to that side, a column in between at most
                for x, z in [seen_from(own, other.centre_m)]
                if abs(z) < 0.1 and 0 < side * x < own.width_m + 1.2
            ]
            beside += bool(near) and min(near, key=lambda pair: pair[0])[1].name in taken
        assert stall.occupied_neighbours == beside
    assert {stall.occupied_neighbours for stall in features} == {0, 1, 2}


def seen_from(stall, point):
    """A point in the frame of a stall: across it and along it."""
    dx, dz = point[0] - stall.centre_m[0], point[1] - stall.centre_m[1]
    cos, sin = np.cos(stall.yaw_rad), np.sin(stall.yaw_rad)
    return dx * cos - dz * sin, dx * sin + dz * cos


def test_a_garage_without_cars_has_no_occupied_neighbours_and_a_full_one_the_most():
    config = {"seed": 3, "site": {"height_cells": 6, "width_cells": 7}, "plan": QUICK}
    counts = {
        occupancy: sum(
            stall.occupied_neighbours
            for stall in measured_stalls(generate(GarageConfig(**config, parking={"occupancy": occupancy})))
        )
        for occupancy in (0.0, 0.5, 1.0)
    }
    assert counts[0.0] == 0
    assert counts[0.5] < counts[1.0]


HARDER = [
    ("gear_changes_in", range(6)),
    ("gear_changes_out", range(6)),
    ("clearance_m", np.linspace(1.0, 0.04, 60)),
    ("is_clear_when_full", (True, False)),
    ("aisle_width_m", np.linspace(13, 4, 60)),
    ("occupied_neighbours", range(3)),
    ("illuminance_lux", np.linspace(250, 1, 60)),
]


@pytest.mark.parametrize(("name", "values"), HARDER, ids=[name for name, _ in HARDER])
def test_the_score_rises_with_each_feature(name, values):
    stalls = [replace(STALL, **{name: value}) for value in values]
    scores = [found.score for found in ranked(stalls, reference())]
    assert scores == sorted(scores)
    assert scores[0] < scores[-1]
    levels = [list(Level).index(found.level) for found in ranked(stalls, reference())]
    assert levels == sorted(levels)


def test_the_score_runs_from_0_to_1():
    easiest = StallFeatures("a", 0, 0, 1.0, True, 50.0, 0, 9999.0)
    hardest = StallFeatures("b", 9, 9, 0.0, False, 2.0, 2, 0.0)
    easy, hard = ranked([easiest, hardest], reference())
    # many stalls of the reference are as easy in some features
    assert 0 <= easy.score < 0.3
    assert 0.9 < hard.score <= 1
    assert (easy.level, hard.level) == (Level.NORMAL, Level.EXTREME)


def test_a_stall_without_ways_has_no_score_and_counts_apart():
    stall, unproven = ranked([STALL, UNPROVEN], reference())
    assert (unproven.score, unproven.level, unproven.features.is_proven) == (None, None, False)
    found = garage_difficulty([stall, unproven])
    assert found.unproven == 1
    assert found.normal + found.complex + found.extreme == 1
    assert found.score == stall.score


def tight_garage():
    """A lane of 4 m between two rows of stalls, half of them taken."""
    return generate(
        GarageConfig(
            site={"structure": "....\nE==X\n...."},
            bay={"stall_width_m": 2.1, "column_widths_m": 8.1, "row_depths_m": (5.7, 4.0, 5.7)},
            plan={"unreachable_stalls": "keep", "circulation": "allow"},
            parking={"occupancy": 0.5},
        )
    )


def test_ways_that_only_free_stalls_leave_make_a_stall_harder():
    stalls = stall_difficulties(tight_garage())
    crossed = [stall for stall in stalls if not stall.features.is_clear_when_full]
    assert 0 < len(crossed) < len(stalls)
    for stall in crossed:
        (if_clear,) = ranked([replace(stall.features, is_clear_when_full=True)], reference())
        assert stall.score > if_clear.score
    assert {stall.level for stall in stalls} <= {Level.COMPLEX, Level.EXTREME}


def test_stalls_that_no_car_gets_into_are_told_apart():
    site, plan = {"structure": NARROW["structure"]}, {"unreachable_stalls": "keep"}
    narrow = generate(GarageConfig(site=site, bay=NARROW["bay"], plan=plan))
    stalls = stall_difficulties(narrow)
    found = garage_difficulty(stalls)
    unproven = [stall for stall in stalls if stall.score is None]
    assert 0 < found.unproven == len(unproven) < len(stalls)
    assert {stall.features.aisle_width_m for stall in unproven} == {2.5}
    assert found.normal + found.complex + found.extreme + found.unproven == len(stalls)


def test_a_garage_without_proven_stalls_has_no_difficulty():
    found = garage_difficulty(ranked([UNPROVEN], reference()))
    assert (found.score, found.level, found.unproven) == (None, None, 1)
    assert garage_difficulty([]).level is None


def test_a_garage_is_as_difficult_as_its_stalls_on_average(garage, proofs):
    stalls = stall_difficulties(garage, proofs=proofs)
    found = garage_difficulty(stalls)
    assert found.score == pytest.approx(np.mean([stall.score for stall in stalls]), abs=1e-6)
    assert [found.normal, found.complex, found.extreme] == [
        sum(stall.level is level for stall in stalls) for level in Level
    ]


samples = st.lists(st.integers(-5, 5), min_size=2, max_size=40)


@settings(deadline=None)
@given(samples, st.lists(st.floats(-7, 7), min_size=1, max_size=20))
def test_midranks_of_values_that_are_there_are_the_middle_of_their_places(sample, others):
    known = sorted(sample)
    places = np.arange(len(known)) / (len(known) - 1)
    for value in set(sample):
        middle = np.mean([place for place, other in zip(places, known, strict=True) if other == value])
        assert midranks([value], known)[0] == pytest.approx(middle)
    ranks = midranks(sorted(others), known)
    assert (np.diff(ranks) >= -1e-12).all()
    assert ((ranks >= 0) & (ranks <= 1)).all()


def test_midranks_of_a_constant():
    assert midranks([0, 1, 2], [1, 1, 1]).tolist() == [0, 0.5, 1]


def test_midranks_between_quantiles_run_straight():
    assert midranks([0, 2.5, 5, 7.5, 10], [0, 5, 10]).tolist() == [0, 0.25, 0.5, 0.75, 1]


def test_levels_are_terciles_of_the_reference():
    shipped = reference()
    scores = np.array([garage.score for garage in shipped.garages])
    lower, upper = shipped.garage_terciles
    shares = np.array(
        [(scores <= lower).mean(), ((scores > lower) & (scores <= upper)).mean(), (scores > upper).mean()]
    )
    assert shares == pytest.approx([1 / 3] * 3, abs=0.01)
    quantiles = np.array(shipped.stall_scores)
    assert midranks(shipped.stall_terciles, quantiles) == pytest.approx([1 / 3, 2 / 3], abs=0.011)


def test_the_reference_is_large_and_mixed():
    shipped = reference()
    assert len(shipped.garages) == 200
    assert shipped.stalls == sum(garage.stalls for garage in shipped.garages) > 10_000
    assert all(len(values) == 101 for values in shipped.quantiles.values())
    assert all(values[0] < values[-1] for name, values in shipped.quantiles.items() if name != "is_clear_when_full")


@pytest.mark.parametrize("place", [1, 5, 12])
def test_garages_of_the_reference_made_again_have_the_same_figures(place):
    shipped = reference()
    row = shipped.garages[place]
    stalls = reference_stalls(row.seed)
    proven = [stall for stall in stalls if stall.is_proven]
    assert (len(proven), len(stalls) - len(proven)) == (row.stalls, row.unproven)
    assert scores_of(stalls, shipped.quantiles).mean() == pytest.approx(row.score, abs=1e-6), (
        "run `python -m garage2usd.datasets.reference garage2usd/datasets` and commit the result"
    )


def test_settings_of_the_reference_are_drawn_by_the_seed_alone():
    assert reference_settings(7) == reference_settings(7) != reference_settings(8)
    kept = {reference_settings(seed)["plan"]["unreachable_stalls"] for seed in range(20)}
    assert kept == {UnreachableStalls.KEEP}


def test_a_reference_of_few_garages_ranks_them_among_themselves(features):
    made = make_reference({1: features, 2: (*features, UNPROVEN)})
    assert made.stalls == 2 * len(features)
    assert [(row.seed, row.stalls, row.unproven) for row in made.garages] == [
        (1, len(features), 0),
        (2, len(features), 1),
    ]
    assert np.mean([found.score for found in ranked(features, made)]) == pytest.approx(0.5, abs=0.03)


def test_the_shipped_file_is_as_it_would_be_written():
    assert REFERENCE_FILE.is_relative_to(REPOSITORY)
    assert REFERENCE_FILE.read_text() == json_text(reference().model_dump(mode="json"))
