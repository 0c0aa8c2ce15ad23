import json

import jsonschema
import numpy as np
import pytest
from support.sample_files import each_sample

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, config_from_mapping, config_schema, load_config
from garage2usd.pipeline import generate


@pytest.mark.parametrize(
    ("settings", "field", "allowed"),
    [
        ({"sed": 1}, "sed", "seed, site, bay"),
        ({"site": {"with_cells": 1}}, "site.with_cells", "width_cells"),
        ({"site": {"width_cells": -1}}, "site.width_cells", "greater than or equal to 3"),
        ({"bay": {"stall_width_m": float("nan")}}, "bay.stall_width_m", "finite"),
        ({"bay": {"column_widths_m": -3}}, "bay.column_widths_m", "greater than or equal to 1"),
        ({"bay": {"column_widths_m": [8.1, "a"]}}, "bay.column_widths_m", "number"),
        ({"plan": {"preset": "best"}}, "plan.preset", "'paper' or 'tuned'"),
        ({"fittings": {"clear_height_m": 6, "ceiling_height_m": 2.4}}, "fittings.ceiling_height_m", "which is 6.0"),
        ({"fittings": {"clear_height_m": 3.1}}, "fittings.ceiling_height_m", "at least 0.15 m over"),
        ({"fittings": {"clear_height_m": 2.3, "ceiling_height_m": 2.4}}, "fittings.ceiling_height_m", "which is 2.3"),
        ({"seed": -1}, "seed", "greater than or equal to 0"),
        ({"parking": {"occupancy": 1.5}}, "parking.occupancy", "less than or equal to 1"),
        ({"site": {"structure": "E=X", "contour": "..."}}, "site", "no contour beside a complete structure"),
        ({"site": {"width_cells": 1000, "height_cells": 1000}}, "site", "at most 250000 squares"),
    ],
)
def test_bad_settings_name_field_value_and_what_is_allowed(settings, field, allowed):
    with pytest.raises(ConfigError) as caught:
        config_from_mapping(settings)
    assert caught.value.field.startswith(field)
    assert allowed in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_ceiling_may_hang_just_over_the_clear_height():
    fittings = GarageConfig(fittings={"clear_height_m": 2.7, "ceiling_height_m": 2.85}).fittings
    assert (fittings.clear_height_m, fittings.ceiling_height_m) == (2.7, 2.85)


def test_configurations_are_frozen():
    with pytest.raises(ValueError, match="frozen"):
        GarageConfig().seed = 2


def test_the_digest_follows_every_setting():
    assert GarageConfig().digest() == GarageConfig(seed=0).digest()
    others = [GarageConfig(seed=1), GarageConfig(bay={"stall_width_m": 2.5}), GarageConfig(parking={"occupancy": 0.1})]
    assert len({config.digest() for config in (GarageConfig(), *others)}) == 4


@each_sample
def test_samples_satisfy_the_schema(sample):
    import tomllib

    schema = config_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(tomllib.loads(sample.read_text()), schema)
    assert load_config(sample).digest()


@each_sample
def test_a_saved_configuration_is_the_same_configuration(sample):
    config = load_config(sample)
    saved = GarageConfig(**json.loads(json.dumps(config.model_dump(mode="json"))))
    assert saved == config
    assert saved.digest() == config.digest()
    learn_little = {"plan": {**config.plan.model_dump(), "episodes": 20, "starts": 1}}
    one, other = (generate(GarageConfig(**{**kept.model_dump(), **learn_little})) for kept in (config, saved))
    assert one.plan.structure == other.plan.structure


def test_the_schema_refuses_what_the_models_refuse():
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"site": {"with_cells": 1}}, config_schema())
    described = [name for name, setting in config_schema()["properties"].items() if setting.get("description")]
    assert "seed" in described


def test_a_structure_file_is_read_beside_the_configuration(tmp_path):
    (tmp_path / "plan.txt").write_text("E=X\n...\n")
    (tmp_path / "garage.toml").write_text('[site]\nstructure_file = "plan.txt"\n')
    config = load_config(tmp_path / "garage.toml")
    assert config.site.structure == "E=X\n...\n"
    assert config.site.structure_file is None


@pytest.mark.parametrize(
    "content", [b"seed = ", b"\xff\xfes", b"\xfe\x01", b'[site]\nstructure_file = "nowhere.txt"\n']
)
def test_unreadable_files_are_configuration_errors(tmp_path, content):
    (tmp_path / "garage.toml").write_bytes(content)
    with pytest.raises(ConfigError):
        load_config(tmp_path / "garage.toml")
    with pytest.raises(ConfigError):
        load_config(tmp_path / "missing.toml")
    with pytest.raises(ConfigError):
        load_config(tmp_path)


def test_arrays_stand_for_drawings():
    S = np.array([[2, 1, 3], [0, 0, 0]])
    config = GarageConfig(site={"structure": S}, bay={"column_widths_m": np.array([5.0, 6.0, 7.0])})
    assert config.site.structure == "2 1 3\n0 0 0"
    assert config.bay.column_widths_m == (5.0, 6.0, 7.0)
    assert json.loads(config.model_dump_json())["site"]["structure"] == "2 1 3\n0 0 0"
