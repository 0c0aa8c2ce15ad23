"""Plans of a data set: each garage draws until it has one of its own, whatever the order they are made in."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.data_sets import small_recipe

from garage2usd.common.errors import ConfigError
from garage2usd.datasets.drawn_plan import DrawnPlan, plan_table, plans_of
from garage2usd.datasets.plans import PlanDraw, planned, proportional, replanned
from garage2usd.pipeline import generate
from garage2usd.structure.symmetry import plan_digest


def fake(number, attempt, digest):
    """A plan as it is drawn, or one that failed where there is no digest."""
    return DrawnPlan(number=number, attempt=attempt, seed=1, digest=digest, error="" if digest else "no room")


def run(recipe, digest_of, order):
    """The plans of a recipe whose plans are fakes, made in an order."""
    draw = PlanDraw(recipe)
    count = 0
    while requests := draw.missing():
        made = [fake(number, attempt, digest_of(number, attempt)) for number, attempt in requests]
        count += len(made)
        for place in order.permutation(len(made)):
            draw.add([made[place]])
    return draw.plans(), count


@given(digests=st.lists(st.lists(st.sampled_from(["", *"abcdef"]), min_size=4, max_size=4), min_size=1, max_size=6))
def test_no_two_garages_have_a_plan_and_the_order_does_not_matter(digests):
    recipe = small_recipe(count=len(digests), attempts=4)
    orders = [np.random.default_rng(seed) for seed in range(2)]
    try:
        (plans, _), (again, _) = (run(recipe, lambda n, a: digests[n][a], order) for order in orders)
    except ConfigError:
        assert not any(any(row) for row in digests)
        return
    assert plans == again
    assert [drawn.number for drawn in plans] == list(range(len(digests)))
    taken = [drawn.digest for drawn in plans if not drawn.error]
    assert len(set(taken)) == len(taken) > 0
    # a garage without a plan drew nothing but failures and plans that others have
    for drawn in plans:
        if drawn.error:
            assert set(digests[drawn.number]) <= {"", *taken}


def test_garages_that_have_a_plan_are_not_drawn_again():
    recipe = small_recipe(count=5, attempts=3)
    plans, count = run(recipe, lambda number, attempt: "a" if attempt == 0 else f"{number}", np.random.default_rng(1))
    assert count == 5 + 4
    assert [drawn.attempt for drawn in plans] == [0, 1, 1, 1, 1]


def test_equal_plans_stay_where_only_seeds_are_to_differ():
    recipe = small_recipe(count=3, distinct="seed")
    plans, count = run(recipe, lambda *_: "a", np.random.default_rng(1))
    assert count == 3
    assert [drawn.digest for drawn in plans] == ["a"] * 3


def test_a_recipe_by_which_no_garage_is_possible_is_refused():
    recipe = small_recipe(count=2, attempts=2, garage={"site": {"structure": "E#X"}})
    draw = PlanDraw(recipe)
    for _ in range(2):
        draw.add(planned(recipe, draw.missing()))
    with pytest.raises(ConfigError, match=r"^garage: got .*; allowed: settings by which one of 2 garages is possible$"):
        draw.missing()


def test_plans_survive_their_table_and_become_the_same_garages_again():
    recipe = small_recipe()
    drawn = planned(recipe, [(0, 0), (1, 0)])
    assert plans_of(plan_table(drawn)) == drawn
    for each in drawn:
        config, _ = recipe.drawn(each.seed)
        made, again = generate(config), generate(config, plan=replanned(each, config))
        assert made.plan.structure == again.plan.structure
        assert made.plan.score == again.plan.score
        assert plan_digest(made.plan.structure.cells[::-1].T) == each.digest
        assert made.layout.counts() == again.layout.counts()


def test_directions_and_kinds_of_stalls_survive_their_table():
    mixed = {"plan": {"aisles": "one-way"}, "stalls": {"kinds": {"angled": 0.6, "parallel": 0.4}}}
    recipe = small_recipe(garage=mixed)
    drawn = plans_of(plan_table(planned(recipe, [(0, 0), (1, 0)])))
    assert all(each.tail for each in drawn)
    for each in drawn:
        config, _ = recipe.drawn(each.seed)
        made, again = generate(config), generate(config, plan=replanned(each, config))
        assert made.plan.runs == again.plan.runs != ()
        assert made.plan.directions == again.plan.directions
        assert made.plan.structure == again.plan.structure
        assert list(made.layout.stalls) == list(again.layout.stalls)


def test_a_table_of_usual_plans_has_no_column_for_others():
    assert "tail" not in plan_table(planned(small_recipe(), [(0, 0)])).column_names


def test_levels_are_drawn_until_each_has_its_share():
    recipe = small_recipe(count=6, difficulty={"normal": 1, "extreme": 2}, attempts=8)
    levels = {0: "normal", 1: "complex", 2: "extreme"}
    draw = PlanDraw(recipe)
    while requests := draw.missing():
        draw.add(
            fake(number, attempt, f"{number}-{attempt}").model_copy(update={"level": levels[(number + attempt) % 3]})
            for number, attempt in requests
        )
    found = [drawn.level for drawn in draw.plans()]
    assert (found.count("normal"), found.count("extreme")) == (2, 4)


def test_levels_that_a_recipe_does_not_reach_are_one_error():
    recipe = small_recipe(count=4, difficulty={"normal": 1, "extreme": 1}, attempts=3)
    draw = PlanDraw(recipe)
    for attempt in range(3):
        draw.add(
            fake(number, attempt, f"{number}-{attempt}").model_copy(update={"level": "normal"})
            for number, _ in draw.missing()
        )
    with pytest.raises(ConfigError, match=r"^difficulty: got .* 3 attempts each; not found were 2 of 2 extreme$"):
        draw.missing()


def test_plans_say_their_level_where_it_is_asked_for():
    (drawn,) = planned(small_recipe(difficulty={"normal": 1, "complex": 1}), [(0, 0)])
    assert drawn.level in {"normal", "complex", "extreme"}
    assert plans_of(plan_table([drawn])) == [drawn]


@given(
    ratios=st.dictionaries(st.text(min_size=1, max_size=3), st.floats(0.01, 1e6), min_size=1, max_size=5),
    total=st.integers(0, 10_000),
)
def test_proportional_numbers_add_up_and_are_within_one(ratios, total):
    found = proportional(ratios, total)
    assert sum(found.values()) == total
    for key, ratio in ratios.items():
        assert abs(found[key] - total * ratio / sum(ratios.values())) < 1 + 1e-6
