"""Garages of several levels in data sets: files, rows, the same bytes after a kill, and what does not go with them."""

import gzip
import json

import numpy as np
import pytest
from pxr import Usd
from support.data_sets import small_recipe, tree_of

import garage2usd
from garage2usd.common.errors import ConfigError
from garage2usd.datasets import cluster, make_dataset, verify_dataset
from garage2usd.datasets.drawn_plan import plan_table, plans_of
from garage2usd.datasets.garage_choice import chosen_garages
from garage2usd.datasets.plans import planned, remade
from garage2usd.reading.report import Report
from garage2usd.structure.symmetry import levels_digest, plan_digest

LEVELS = {
    "profile": {"name": "none"},
    "parking": {"occupancy": 0.2},
    "building": {"levels": {"choice": [1, 2]}, "storey_m": 2.9, "ramp_slope_percent": 20, "ramp_transition_m": 2.0},
    "fittings": {"ceiling_height_m": 2.6},
    "plan": {"episodes": 30, "starts": 1, "climb": False},
    "site": {"width_cells": {"range": [8, 9]}, "height_cells": 5},
}


def recipe_of_levels(**changes):
    return small_recipe(
        **{"count": 2, "seed": 4, "garage": LEVELS, "splits": {"all": 1}, "shards": {"garages": 1}, **changes}
    )


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A data set of garages of one and two levels, its folder, and its rows."""
    recipe = recipe_of_levels(make={"exports": ["xodr"], "gzip": True}, shards={"garages": 1, "form": "folder"})
    with pytest.MonkeyPatch.context() as patch:
        _in_one_process(patch)
        folder = tmp_path_factory.mktemp("levels") / "set"
        data_set = make_dataset(recipe, folder)
    return recipe, folder, data_set.rows


def _in_one_process(patch):
    class OneProcess:
        def each(self, function, tasks, *shared):
            return ((task, function(*shared, task)) for task in tasks)

    class Context:
        def __init__(self, **_):
            pass

        def __enter__(self):
            return OneProcess()

        def __exit__(self, *_):
            pass

    patch.setattr(cluster, "workers", Context)


def test_rows_tell_levels_stalls_and_links_as_reports_do(made):
    _, folder, rows = made
    assert not any(row.error for row in rows)
    assert {row.levels for row in rows} == {1, 2}
    for row in rows:
        assert len(row.level_stalls) == row.levels
        assert sum(row.level_stalls) == row.stalls
        report = json.loads(gzip.decompress((folder / "shards" / f"{row.key}.report.json.gz").read_bytes()))
        told = Report.model_validate(report)
        assert told.parking_stalls == row.stalls
        assert [level.parking_stalls for level in told.levels] == [*row.level_stalls]
        assert [(link.kind, link.upper, link.lower, link.direction) for link in told.links] == [
            (link.kind, link.upper, link.lower, link.direction) for link in row.links
        ]
        parked = [stall for level in told.levels for stall in level.stalls if stall.occupied]
        assert row.cars == len(parked)


def test_stages_open_with_all_levels_and_their_stalls(made):
    _, folder, rows = made
    (row, *_) = (row for row in rows if row.levels == 2)
    stage = Usd.Stage.Open(str(folder / "shards" / f"{row.key}.usdc"))
    assert [prim.GetName() for prim in stage.GetPrimAtPath("/Garage/Levels").GetChildren()] == ["U1", "U2"]
    assert stage.GetPrimAtPath("/Garage").GetCustomDataByKey("seed") == row.seed
    count = len(stage.GetPrimAtPath("/Garage/LaneGraph/Stalls").GetAttribute("garage:stall:id").Get() or [])
    assert count >= row.stalls
    assert {f".{name}.plan.png" for name in ("U1", "U2")} < {file.suffix for file in row.files}


def test_a_set_of_levels_verifies_and_a_resumed_one_has_the_same_bytes(made, tmp_path, monkeypatch):
    recipe, folder, _ = made
    _in_one_process(monkeypatch)
    assert verify_dataset(folder) == []

    class Killed(BaseException):
        """A kill."""

    def ended(place, text):
        raise Killed

    again = tmp_path / "set"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("garage2usd.datasets.making._finish", lambda *_: ended(None, None))
        with pytest.raises(Killed):
            make_dataset(recipe, again)
    first = min((again / "shards").glob("*.jsonl"))
    first.unlink()
    make_dataset(recipe, again, resume=True)
    assert tree_of(again) == tree_of(folder)


def test_plans_of_levels_survive_their_table_and_become_the_same_garages_again():
    recipe = recipe_of_levels(garage={**LEVELS, "building": {**LEVELS["building"], "levels": 2}})
    drawn = plans_of(plan_table(planned(recipe, [(0, 0)])))
    config, _ = recipe.drawn(drawn[0].seed)
    made, again = garage2usd.generate(config), remade(drawn[0], config)
    assert [level.layout.counts() for level in made.levels] == [level.layout.counts() for level in again.levels]
    assert made.building.levels == again.building.levels
    wrong = drawn[0].model_copy(update={"lower": (drawn[0].rows,)})
    with pytest.raises(ConfigError, match="the plans of garage 0"):
        remade(wrong, config)


def test_digests_of_levels_are_equal_for_the_whole_building_turned_alone():
    random = np.random.default_rng(3)
    one, two = random.integers(-1, 4, (2, 5, 7)).astype(np.int8)
    assert levels_digest([one]) == plan_digest(one)
    turned = [np.rot90(cells[:, ::-1]) for cells in (one, two)]
    assert levels_digest([one, two]) == levels_digest(turned)
    assert levels_digest([one, two]) != levels_digest([one, two[:, ::-1]])
    assert levels_digest([one, two]) != levels_digest([two, one])


def test_what_does_not_go_with_levels_is_refused_before_the_first_garage():
    with pytest.raises(ConfigError) as caught:
        recipe_of_levels(garage={**LEVELS, "building": {"levels": 2, "storey_m": 2.7}}).check()
    assert caught.value.field == "garage.building.storey_m"


@pytest.mark.parametrize("is_finished", [True, False])
def test_garages_of_levels_come_to_contact_sheets_with_their_tape(made, is_finished, tmp_path):
    recipe, folder, rows = made
    (row, *_) = (row for row in rows if row.levels == 2)
    path = folder / "recipe.json"
    if not is_finished:
        path = tmp_path / "recipe.json"
        path.write_text(recipe.record())
    (garage,) = chosen_garages(path, [row.number])
    assert garage.name == f"garage {row.number}"
    assert garage.plan is None
    levels = garage2usd.generate(garage.config, tape=garage.tape).levels
    assert [level.layout.parking_stalls for level in levels] == [*row.level_stalls]
