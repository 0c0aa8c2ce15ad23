"""Messages of errors: one line, without control characters and classes of the code, with the nearest keys."""

from pathlib import Path

import numpy as np
import pytest

from garage2usd.common.errors import ConfigError, StageError
from garage2usd.common.spelling import nearest
from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.config.site import SiteConfig
from garage2usd.garage import StallUse
from garage2usd.profiles import read_profile
from garage2usd.sensors.rig.rig import rig_from_mapping


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"vehicles": {"models": 5}}, "vehicles.models: got 5; allowed: a folder, or a file"),
        ({"look": {"textures": 5}}, "look.textures: got 5; allowed: a table with the keys folder, sha256"),
        ({"site": [1]}, "site: got [1]; allowed: a table with the keys width_cells"),
        ({"profile": 5}, "profile: got 5; allowed: text or a table"),
        ({"seed": "x"}, "seed: got 'x'; allowed: a whole number"),
        ({"plan": {"one_way": 5}}, "plan.one_way: got 5; allowed: a list"),
        ({"site": {"structure_file": 5}}, "site.structure_file: got 5; allowed: a path as text"),
        ({"bay": {"square_side_m": {}}}, "bay.square_side_m: got {}; allowed: a number"),
        ({"vehicles": {"models": ""}}, "vehicles.models.folder: got ''; allowed: at least 1 character"),
    ],
)
def test_settings_of_another_type_are_told_in_words(settings, said):
    with pytest.raises(ConfigError) as error:
        config_from_mapping(settings)
    assert str(error.value).startswith(said)
    for word in ("instance", "dictionary", "tuple", "Config", "Folder", "Input", "valid"):
        assert word not in str(error.value)


@pytest.mark.parametrize(
    ("read", "settings", "key"),
    [
        (config_from_mapping, {"site": {"widht_cells": 3}}, "width_cells"),
        (config_from_mapping, {"stie": {}}, "site"),
        (rig_from_mapping, {"name": "a", "sensor": []}, "sensors"),
        (rig_from_mapping, {"name": "a", "sensors": [{"kind": "pinhole", "nam": "x"}]}, "name"),
        (read_profile, {"nme": "x"}, "name"),
        (read_profile, {"name": "x", "stal_width": 5}, "stall_width"),
    ],
)
def test_misspelt_keys_get_the_nearest(read, settings, key):
    with pytest.raises(ConfigError, match=f"one of the keys .*; the nearest is {key}$"):
        read(settings)


def test_a_key_like_no_other_has_no_nearest():
    assert nearest("qqq", ["width", "height"]) == ""


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (StallUse.EV, "'ev'"),
        (Path("a/b"), "'a/b'"),
        (np.float64(2.5), "2.5"),
        (np.zeros((2, 2), dtype=int), "[[0, 0], [0, 0]]"),
        ({"use": (StallUse.EV,)}, "{'use': ('ev',)}"),
        ("a\nb\x1b", r"'a\nb\x1b'"),
    ],
)
def test_values_are_shown_as_files_have_them(value, shown):
    assert str(ConfigError("a", value, "b")) == f"a: got {shown}; allowed: b"


def test_no_value_names_its_class():
    with pytest.raises(ConfigError) as error:
        GarageConfig(bay=SiteConfig())
    assert "SiteConfig" not in str(error.value)


def test_messages_are_one_line_without_control_characters():
    assert str(ConfigError("way \x1b[2J", 1, "a\n  b\x07")) == r"way \x1b[2J: got 1; allowed: a b\x07"
    assert str(StageError("a\n.usd", "it\n broke\x1b")) == r"a\n.usd: it broke\x1b"
