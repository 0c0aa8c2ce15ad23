"""Recipes: what they draw for a garage, and what they refuse before a garage is made."""

import pytest
from PIL import Image
from support.data_sets import SMALL, small_recipe

from garage2usd import build
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import AssetPlace
from garage2usd.datasets import Recipe, load_recipe

GROUPS = {
    "size": [
        {"name": "small", "weight": 3, "garage": {"site": {"width_cells": 5, "height_cells": 4}}},
        {
            "name": "large",
            "garage": {"site": {"width_cells": {"range": [12, 14]}, "height_cells": 9, "entrances": 2}},
        },
    ]
}


def test_the_same_seed_draws_the_same_settings_and_others_draw_others():
    recipe = small_recipe(count=40)
    seeds = [recipe.garage_seed(number, attempt) for number in range(40) for attempt in range(3)]
    assert len(set(seeds)) == len(seeds)
    configs = [recipe.drawn(seed)[0] for seed in seeds]
    assert [config.digest() for config in configs] == [recipe.drawn(seed)[0].digest() for seed in seeds]
    assert {config.site.width_cells for config in configs} == {4, 5, 6}
    assert all(0.2 <= config.parking.occupancy <= 0.9 for config in configs)
    assert len({config.parking.occupancy for config in configs}) == len(configs)
    assert [config.seed for config in configs] == seeds


def test_a_distribution_more_leaves_the_other_draws_as_they_are():
    one = small_recipe()
    other = small_recipe(garage={**SMALL["garage"], "fittings": {"floor_stain_rate": {"range": [0.0, 1.0]}}})
    for number in range(20):
        seed = one.garage_seed(number, 0)
        mine, yours = one.drawn(seed)[0], other.drawn(seed)[0]
        assert (mine.site, mine.parking) == (yours.site, yours.parking)


def test_what_is_in_a_group_is_drawn_together():
    recipe = small_recipe(groups=GROUPS)
    drawn = [recipe.drawn(recipe.garage_seed(number, 0)) for number in range(400)]
    names = [alternatives["size"] for _, alternatives in drawn]
    assert 60 <= names.count("large") <= 140  # of 400 a quarter
    for config, alternatives in drawn:
        is_large = alternatives["size"] == "large"
        assert (config.site.entrances == 2) is is_large
        assert (config.site.width_cells in {12, 13, 14}) is is_large


def test_stages_refer_to_the_assets_of_the_data_set_unless_they_are_self_contained():
    config, _ = small_recipe().drawn(1)
    assert (config.stage.assets, config.stage.asset_folder) == ("shared", "../../assets")
    config, _ = small_recipe(make={"self_contained": True}).drawn(1)
    assert config.stage.assets == "own"


@pytest.mark.parametrize(
    ("garage", "field"),
    [
        ({"site": {"width_cells": {"range": [2, 9]}}}, "garage.site.width_cells"),
        ({"site": {"width_cells": {"choice": [5, 7, 2000]}}}, "garage.site.width_cells"),
        ({"site": {"width": 5}}, "garage.site.width"),
        (
            {"parking": {"occupancy": {"mix": [{"value": 0.5}, {"value": {"range": [0.5, 1.5]}}]}}},
            "garage.parking.occu",
        ),
        ({"seed": 4}, "garage.seed"),
        ({"stage": {"assets": "own"}}, "garage.stage.assets"),
        ({"site": {"structure_file": "a.txt"}}, "garage.site.structure_file"),
    ],
)
def test_settings_that_cannot_be_used_are_found_before_a_garage_is_made(garage, field):
    with pytest.raises(ConfigError) as caught:
        small_recipe(garage=garage).check()
    assert caught.value.field.startswith(field)


def test_alternatives_are_tried_too():
    bad = {"size": [*GROUPS["size"], {"name": "wrong", "garage": {"bay": {"stall_width_m": 9.0}}}]}
    with pytest.raises(ConfigError, match=r"garage\.bay\.stall_width_m"):
        small_recipe(groups=bad).check()


@pytest.mark.parametrize(
    ("text", "field"),
    [
        ("count = 3", "name"),
        ('name = "A b"', "name"),
        ('name = "a"\ncount = 0', "count"),
        ('name = "a"\nsplits = { train = 0 }', "splits"),
        ('name = "a"\nsplits = {}', "splits"),
        ('name = "a"\nwhat = 1', "what"),
        ('name = "a"\n[make]\nstage = false\nexports = ["xodr"]', "make"),
        ('name = "a"\n[make]\nexports = ["dwg"]', "make.exports"),
        ('name = "a"\n[make]\nexports = ["glb", "osm", "glb"]', "make.exports"),
        ('name = "a"\n[make.drives]\nevery_m = 2', "make.drives.rig"),
        ('name = "a"\n[make.drives]\nrig = "none"', "make.drives.rig"),
        ('name = "a"\n[make.drives]\nrig = "none.toml"', "make.drives.rig"),
        ('name = "a"\n[make.drives]\nrig = "lidar_32"\ncount = 0', "make.drives.count"),
        ('name = "a"\n[make]\nstage = false\n[make.drives]\nrig = "lidar_32"', "make"),
        ('name = "a"\n[[groups.size]]\nname = "x"\n[[groups.size]]\nname = "x"', "groups"),
        ('name = "a"\n[garage]\nprofile = "nowhere.toml"', "profile"),
    ],
)
def test_recipes_are_strict(tmp_path, text, field):
    path = tmp_path / "recipe.toml"
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        load_recipe(path)
    assert caught.value.field.startswith(field)


def test_what_a_data_set_records_is_the_recipe_again(tmp_path):
    recipe = Recipe(**SMALL, groups=GROUPS)
    path = tmp_path / "recipe.json"
    path.write_text(recipe.record())
    assert load_recipe(path) == recipe


def test_textures_of_a_recipe_are_beside_it_and_pinned_by_what_they_hold(tmp_path):
    (tmp_path / "mine").mkdir()
    Image.new("RGB", (8, 8), (90, 80, 70)).save(tmp_path / "mine" / "floor_color.png")
    groups = '[[groups.look]]\nname = "own"\n[groups.look.garage.look]\ntextures = "mine"\n'
    (tmp_path / "recipe.toml").write_text(f'name = "own"\n{groups}')
    recipe = load_recipe(tmp_path / "recipe.toml")
    textures = recipe.drawn(1)[0].look.textures
    assert (textures.folder, len(textures.sha256)) == (str(tmp_path / "mine"), 64)
    (tmp_path / "recipe.json").write_text(recipe.record())
    assert load_recipe(tmp_path / "recipe.json") == recipe
    Image.new("RGB", (8, 8)).save(tmp_path / "mine" / "floor_color.png")
    with pytest.raises(ConfigError, match="that it was given with"):
        generate_stage(recipe.drawn(1)[0], tmp_path)


def generate_stage(config, folder):
    own = config.model_copy(update={"stage": config.stage.model_copy(update={"assets": AssetPlace.OWN})})
    return build(own, folder / "garage.usdc")


def test_even_groups_have_their_shares_over_any_numbers_and_together():
    first = [{"name": "a", "weight": 0.35}, {"name": "b", "weight": 0.65}]
    second = [{"name": "c", "weight": 0.1}, {"name": "d", "weight": 0.9}]
    recipe = small_recipe(groups={"one": first, "two": second, "three": first}, even=["one", "two"])
    drawn = [recipe.drawn(recipe.garage_seed(n, n % 3), n)[1] for n in range(400)]
    assert recipe.drawn(7, 5)[1]["one"] == recipe.drawn(8, 5)[1]["one"]
    for start, end in ((0, 400), (100, 200), (333, 400)):
        part = drawn[start:end]
        assert abs(sum(each["one"] == "a" for each in part) - 0.35 * len(part)) <= 2
        assert abs(sum(each["two"] == "c" for each in part) - 0.1 * len(part)) <= 2
    assert abs(sum(each["one"] == "a" and each["two"] == "c" for each in drawn) - 0.035 * 400) <= 5
    with pytest.raises(ConfigError, match="number"):
        recipe.drawn(7)
    with pytest.raises(ConfigError, match="even with names of groups"):
        load_with(even=["four"])


def load_with(**changes):
    from garage2usd.common.settings import validated
    from garage2usd.datasets.recipe import Recipe

    return validated(Recipe, {"name": "x", **changes})
