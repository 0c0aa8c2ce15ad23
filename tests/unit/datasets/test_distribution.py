"""Distributions of recipes: what they draw, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from garage2usd.common.errors import ConfigError
from garage2usd.datasets.distribution import distribution_of

DRAWS = 20_000
LEAST_P = 1e-4  # the seeds are fixed, so that these tests give the same each time


def drawn(value, count=DRAWS):
    distribution = distribution_of(value, field="x")
    random = np.random.default_rng(7)
    return [distribution.draw(random) for _ in range(count)]


def test_a_choice_is_drawn_by_its_weights():
    values = drawn({"choice": ["a", "b", "c"], "weights": [1, 2, 5]})
    counts = [values.count(value) for value in "abc"]
    assert stats.chisquare(counts, [DRAWS / 8, DRAWS / 4, DRAWS * 5 / 8]).pvalue > LEAST_P


def test_whole_ranges_have_both_ends_and_each_number_alike():
    values = drawn({"range": [5, 9]})
    assert all(isinstance(value, int) for value in values)
    assert stats.chisquare(np.bincount(values, minlength=10)[5:]).pvalue > LEAST_P


def test_ranges_are_uniform():
    assert stats.kstest(drawn({"range": [0.2, 0.9]}), stats.uniform(0.2, 0.7).cdf).pvalue > LEAST_P


def test_log_ranges_are_uniform_in_the_logarithm():
    values = drawn({"log_range": [0.01, 10.0]})
    assert stats.kstest(values, stats.loguniform(0.01, 10.0).cdf).pvalue > LEAST_P


def test_mixes_draw_their_parts_by_weight():
    values = drawn({"mix": [{"weight": 3, "value": {"range": [1, 2]}}, {"value": 10}]})
    assert set(values) == {1, 2, 10}
    assert stats.binomtest(values.count(10), DRAWS, 0.25).pvalue > LEAST_P


@given(low=st.integers(1, 1000), more=st.integers(0, 1000), seed=st.integers(0, 2**32))
def test_whole_log_ranges_stay_within_their_ends(low, more, seed):
    distribution = distribution_of({"log_range": [low, low + more]}, field="x")
    value = distribution.draw(np.random.default_rng(seed))
    assert isinstance(value, int)
    assert low <= value <= low + more


@pytest.mark.parametrize(
    ("value", "field"),
    [
        ({"choice": []}, "x.choice"),
        ({"choice": [1, 2], "weights": [1]}, "x"),
        ({"choice": [1, 2], "weights": [1, -1]}, "x.weights.1"),
        ({"range": [2, 1]}, "x"),
        ({"range": [1, 2, 3]}, "x.range"),
        ({"range": [1, float("nan")]}, "x.range.1"),
        ({"log_range": [0, 1]}, "x"),
        ({"range": [1, 2], "other": 3}, "x.other"),
        ({"mix": [{"value": {"range": [2, 1]}}]}, "x"),
    ],
)
def test_what_is_no_distribution_is_refused(value, field):
    with pytest.raises(ConfigError) as caught:
        distribution_of(value, field="x")
    assert caught.value.field.startswith(field)


@pytest.mark.parametrize("value", [3, "range", [1, 2], {"width_cells": 4}, {}])
def test_other_values_are_themselves(value):
    assert distribution_of(value, field="x") is None


def test_beta_draws_are_scaled_between_their_ends():
    values = drawn({"beta": [1.3, 2.0]})
    assert stats.kstest(values, stats.beta(1.3, 2.0).cdf).pvalue > LEAST_P
    values = drawn({"beta": [2, 3], "within": [5.5, 7.3]})
    assert stats.kstest(values, stats.beta(2, 3, 5.5, 1.8).cdf).pvalue > LEAST_P
    assert distribution_of({"beta": [1, 1], "within": [5.5, 7.3]}, field="x").ends() == (5.5, 7.3)


def test_log_normal_draws_are_cut_at_their_ends():
    values = drawn({"log_normal": [150, 0.7], "within": [60.0, 350.0]})
    whole = stats.lognorm(0.7, scale=150)
    low, high = whole.cdf([60, 350])
    assert stats.kstest(values, lambda x: (whole.cdf(x) - low) / (high - low)).pvalue > LEAST_P
    assert min(values) >= 60
    assert max(values) <= 350


def test_whole_log_normal_draws_have_each_number_by_its_share():
    values = drawn({"log_normal": [11, 0.3], "within": [9, 14]})
    assert all(isinstance(value, int) for value in values)
    edges = stats.lognorm(0.3, scale=11).cdf(np.arange(8.5, 15))
    expected = np.diff(edges) / (edges[-1] - edges[0])
    counts = np.bincount(values, minlength=15)[9:]
    assert stats.chisquare(counts, DRAWS * expected).pvalue > LEAST_P


@pytest.mark.parametrize(
    ("value", "field"),
    [
        ({"beta": [0, 1]}, "x.beta.0"),
        ({"beta": [1, 1], "within": [1, 0]}, "x"),
        ({"log_normal": [150, 0.7]}, "x.within"),
        ({"log_normal": [-1, 0.7], "within": [1, 2]}, "x.log_normal.0"),
        ({"log_normal": [150, 0.1], "within": [1000, 2000]}, "x"),
    ],
)
def test_beta_and_log_normal_distributions_that_cannot_be_drawn_are_refused(value, field):
    with pytest.raises(ConfigError) as caught:
        distribution_of(value, field="x")
    assert caught.value.field.startswith(field)
