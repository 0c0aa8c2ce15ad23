"""The recipe of a data set: settings of garages, their outputs, splits and shards."""
# Over 300 lines: each setting with its meaning, and the checks of all that a recipe may draw.

import json
from collections.abc import Iterator, Mapping
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from garage2usd.common.documents import MAX_SETTINGS_BYTES, read_json, read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import VERSION
from garage2usd.common.randomness import Step, derived_seed
from garage2usd.common.settings import Settings, validated
from garage2usd.config import GarageConfig, config_from_mapping, profile_setting
from garage2usd.config.files import FOLDERS
from garage2usd.config.starting_points import varied_settings
from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.distribution import Weight, distribution_of
from garage2usd.datasets.drives import DrivesConfig
from garage2usd.datasets.operated import TrafficOutputs
from garage2usd.datasets.recipe_settings import (
    MOST_EVEN,
    drawn_place,
    even_place,
    first_value,
    merge_settings,
    pin_textures,
    resolved,
    setting_generator,
)
from garage2usd.sensors.rig.rig import read_rig
from garage2usd.site.levels import check_levels

ASSET_FOLDER = "assets"
RECIPE_FILE = "recipe.json"
_VERSION_KEY, _RECIPE_KEY = "garage2usd", "recipe"
_FROM_SHARD = f"../../{ASSET_FOLDER}"
_DECIDED = {
    ("seed",): "no seed: each garage gets one from the recipe's",
    ("stage", "assets"): "nothing: the garages of a data set share their assets, unless they are self-contained",
    ("stage", "asset_folder"): "nothing: the assets stand in the data set",
    ("site", "structure_file"): "structure, with the drawing itself, as a data set is made on several machines",
    ("bay", "column_widths_file"): "column_widths_m, as a data set is made on several machines",
    ("bay", "row_depths_file"): "row_depths_m, as a data set is made on several machines",
}
"""Settings that a recipe must not have, and their alternatives."""

Name = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]*$", max_length=60)]


class Distinct(StrEnum):
    """Distinctness of a data set's garages."""

    PLAN = "plan"
    """Plans differ, up to rotation and reflection."""
    SEED = "seed"
    """Only seeds differ; plans may be equal."""


class ShardForm(StrEnum):
    """Storage of garages' files."""

    TAR = "tar"
    """Tar archives, as read by WebDataset."""
    FOLDER = "folder"
    """Folders, with the contents of those archives."""


class Alternative(Settings):
    """An alternative of a group: settings drawn together."""

    name: Name
    """Name of the alternative in the manifest."""
    weight: Weight = 1.0
    """Weight of the alternative relative to the others of its group."""
    garage: dict[str, Any] = Field(default_factory=dict)
    """Settings of the alternative, which override the recipe's table of that name."""


class MakeConfig(Settings):
    """Settings of the outputs for each garage, named as in `garage2usd build`."""

    stage: bool = True
    """True to write a stage (``.usdc``, or ``.usdz`` if self-contained)."""
    plan: bool = True
    """True to write a picture of the plan (``.plan.png``)."""
    labels: bool = True
    """True to write a table of the classes and bounds of all objects (``.labels.json``)."""
    difficulty: bool = True
    """True to prove the drives of each stall and rate the difficulty of stalls (``.difficulty.json``) and garage."""
    exports: tuple[Literal["add.xml", "dxf", "geojson", "glb", "osm", "osm.xml", "xodr", "xosc", "yaml"], ...] = ()
    """Formats to which each stage is exported, as by `build --with`."""
    drives: DrivesConfig | None = None
    """Settings of drives recorded with a rig, as by `render --rig` (``.drive_0.zip``); none if left out. With `traffic`
    they are drives in it."""
    traffic: TrafficOutputs | None = None
    """Settings of the outputs of the garage in operation, as by `garage2usd traffic`; none if left out."""
    gzip: bool = False
    """True to compress text files (maps, reports, labels) to ``.gz``, a tenth of their size."""
    self_contained: bool = False
    """True to make each stage a ``.usdz`` with its assets, instead of referring to the data set's assets."""

    @field_validator("exports")
    @classmethod
    def _once(cls, exports: tuple[str, ...]) -> tuple[str, ...]:
        if len(set(exports)) < len(exports):
            raise ValueError("each format once")
        return exports

    @model_validator(mode="after")
    def _has_stage(self) -> Self:
        if (self.exports or self.drives or self.traffic or self.self_contained) and not self.stage:
            raise ValueError("stage = true where stages are exported, operated, driven through or self-contained")
        return self


class ShardsConfig(Settings):
    """Settings of the storage of garages."""

    form: ShardForm = ShardForm.TAR
    """'tar' or 'folder'."""
    garages: int = Field(100, ge=1, le=100_000)
    """Maximum number of garages per shard, which is the unit of generation and of repetition after an interruption."""


class Recipe(Settings):
    """The recipe of a data set, which determines its bytes for a given version of garage2usd."""

    name: Name
    """Name of the data set."""
    description: str = Field("", max_length=10_000)
    """Purpose of the data set in a sentence or two, for the data card."""
    licence: str = Field("", max_length=200)
    """Licence of the data set, for the data card."""
    seed: int = Field(0, ge=0, lt=2**63)
    """Seed of all random draws."""
    count: int = Field(100, ge=1, le=10_000_000)
    """Number of garages."""
    distinct: Distinct = Distinct.PLAN
    """'plan': plans differ, up to rotation and reflection; 'seed': plans may be equal."""
    attempts: int = Field(40, ge=1, le=10_000)
    """Maximum number of draws of a garage until it is feasible and its plan is new."""
    garage: dict[str, Any] = Field(default_factory=dict)
    """Settings of `garage2usd build`; any value may be a distribution."""
    difficulty: dict[Level, Annotated[float, Field(gt=0, le=1e9)]] = Field(default_factory=dict)
    """Relative numbers of garages of each level of difficulty ('normal', 'complex', 'extreme'); garages of other levels
    are redrawn. Levels are not controlled if left out."""
    groups: dict[Name, tuple[Alternative, ...]] = Field(default_factory=dict)
    """Groups of alternatives; each garage draws one alternative of each group, whose settings override `garage`."""
    even: tuple[Name, ...] = ()
    """Groups whose alternatives are spread evenly over the numbers of the garages instead of drawn: their shares then
    differ from the weights by few garages, also where plans are drawn again."""
    make: MakeConfig = MakeConfig()
    """Outputs for each garage."""
    shards: ShardsConfig = ShardsConfig()
    """Storage of the garages."""
    splits: dict[Name, Annotated[float, Field(gt=0, le=1e9)]] = Field(
        default_factory=lambda: {"train": 0.8, "validation": 0.1, "test": 0.1}, min_length=1
    )
    """Splits of the data set and their relative sizes."""

    @field_validator("groups")
    @classmethod
    def _has_alternatives(cls, groups: dict[str, tuple[Alternative, ...]]) -> dict[str, tuple[Alternative, ...]]:
        for group, alternatives in groups.items():
            names = [alternative.name for alternative in alternatives]
            if not names or len(set(names)) != len(names):
                raise ValueError(f"in {group} one or more alternatives, each with a name of its own")
        return groups

    @model_validator(mode="after")
    def _of_groups(self) -> Self:
        if unknown := sorted(set(self.even) - set(self.groups)):
            raise ValueError(f"even with names of groups, not {', '.join(unknown)}")
        if len(set(self.even)) < len(self.even) or len(self.even) > MOST_EVEN:
            raise ValueError(f"even with at most {MOST_EVEN} groups, each once")
        return self

    def garage_seed(self, number: int, attempt: int) -> int:
        """Return the seed of a garage at an attempt."""
        return derived_seed(self.seed, Step.GARAGES, number, attempt)

    def drawn(self, seed: int, number: int | None = None) -> tuple[GarageConfig, dict[str, str]]:
        """Draw the configuration of a garage and its alternatives, by group.

        Parameters
        ----------
        seed
            Seed of the garage at an attempt.
        number
            Number of the garage, which decides the alternatives of the groups in `even`; required if there are any.

        Each distribution has its own random generator, seeded by the name of its setting, so that adding or removing
        one distribution does not change the draws of the others.

        Raises
        ------
        ConfigError
            If the drawn settings are invalid, or the number is missing.
        """
        chosen = {}
        settings = self.garage
        for group, alternatives in sorted(self.groups.items()):
            weights = np.cumsum([alternative.weight for alternative in alternatives])
            place = self._place(seed, number, group) * weights[-1]
            alternative = alternatives[int(np.searchsorted(weights, place, side="right"))]
            chosen[group] = alternative.name
            settings = merge_settings(settings, alternative.garage)

        def draw(value: object, field: str) -> object:
            distribution = distribution_of(value, field=field)
            return value if distribution is None else distribution.draw(setting_generator(seed, field))

        return self._config(resolved(settings, "garage", draw), seed), chosen

    def _place(self, seed: int, number: int | None, group: str) -> float:
        """Return the place of a garage among the alternatives of a group, from 0 to 1."""
        if group not in self.even:
            return drawn_place(seed, group)
        if number is None:
            raise ConfigError("number", number, f"the number of a garage, as the group {group} is spread evenly")
        return even_place(self.seed, group, number, index=self.even.index(group))

    def record(self) -> str:
        """Return the recipe and the version of garage2usd as JSON, which `load_recipe` reads."""
        return json.dumps({_VERSION_KEY: VERSION, _RECIPE_KEY: self.model_dump(mode="json")}, indent=1) + "\n"

    def check(self) -> None:
        """Check that all settings which a recipe may draw are valid.

        The extreme values of each distribution are tested, together with the first values of the others.

        Raises
        ------
        ConfigError
            If a combination is invalid; names the setting, the value and what is allowed.
        """
        for settings in self._variants():
            ends_of: dict[str, tuple[Any, ...]] = {}
            self._config(resolved(settings, "garage", partial(first_value, ends_of=ends_of)), 0)
            for asked, ends in ends_of.items():
                for end in ends:
                    self._config(resolved(settings, "garage", partial(first_value, ends_of={}, given={asked: end})), 0)

    def _variants(self) -> Iterator[dict[str, Any]]:
        """Yield the settings of each alternative, combined with the first ones of other groups."""
        first = self.garage
        for alternatives in self.groups.values():
            first = merge_settings(first, alternatives[0].garage)
        yield first
        for group, alternatives in self.groups.items():
            for alternative in alternatives[1:]:
                settings = self.garage
                for other, others in self.groups.items():
                    settings = merge_settings(settings, (alternative if other == group else others[0]).garage)
                yield settings

    def _config(self, settings: dict[str, Any], seed: int) -> GarageConfig:
        for keys, allowed in _DECIDED.items():
            _refuse(settings, keys, allowed)
        given = dict(settings)
        stage = given.get("stage", {})
        if not self.make.self_contained and isinstance(stage, dict):
            given["stage"] = {**stage, "assets": "shared", "asset_folder": _FROM_SHARD}
        try:
            config = config_from_mapping({**given, "seed": seed})
            check_levels(config)
        except ConfigError as error:
            within = "" if error.field.startswith("make.") else "garage."
            raise ConfigError(f"{within}{error.field}", error.value, error.allowed) from None
        return config


def load_recipe(path: str | Path) -> Recipe:
    """Load a recipe from TOML or from a data set's ``recipe.json``.

    Parameters
    ----------
    path
        The file. Relative paths of a profile, a rig or the user's textures are resolved against its folder. Textures
        are recorded by their absolute path and a digest of their contents.

    Raises
    ------
    ConfigError
        If the file cannot be read, has an unknown key or a value that is not allowed, or could draw invalid settings.
    """
    path = Path(path)
    settings = _recorded(path) if path.suffix.lower() == ".json" else read_toml(path, field="RECIPE")
    garage = settings.get("garage")
    if isinstance(garage, dict) and isinstance(garage.get("profile"), str):
        profile = profile_setting(garage["profile"], folder=path.parent)
        garage["profile"] = profile if isinstance(profile, str) else profile.model_dump(mode="json")
    pin_textures(settings, path.parent)
    match settings:
        case {"make": {"drives": {"rig": str(rig)} as drives}} if rig.lower().endswith(".toml"):
            try:
                drives["rig"] = read_rig(path.parent / rig).model_dump(mode="json")
            except ConfigError as error:
                raise ConfigError(f"make.drives.{error.field}", error.value, error.allowed) from None
    recipe = validated(Recipe, settings)
    recipe.check()
    return recipe


def recipe_like(name: str) -> Recipe:
    """Return a recipe whose garages are like a starting point, each with a size and look of its own.

    Raises
    ------
    ConfigError
        If the name is not one of `garage2usd.config.starting_points.STARTING_POINTS`.
    """
    return validated(Recipe, {"name": name, "garage": varied_settings(name)})


def folder_remarks(recipe: Recipe) -> tuple[str, ...]:
    """Return the remarks of `GarageConfig` on the user's folders that the garages of a recipe may draw, each once."""
    tables = [recipe.garage, *(each.garage for group in recipe.groups.values() for each in group)]
    remarks: dict[str, None] = {}
    for table in tables:
        for section, key in FOLDERS:
            match table.get(section):
                case {**given} if key in given and distribution_of(given[key], field=key) is None:
                    remarks |= dict.fromkeys(GarageConfig(**{section: {key: given[key]}}).remarks())
    return tuple(remarks)


def _recorded(path: Path) -> dict[str, Any]:
    """Read the settings of a data set's own recipe."""
    document = read_json(path, field="RECIPE", max_bytes=MAX_SETTINGS_BYTES)
    if not isinstance(document, dict) or not isinstance(document.get(_RECIPE_KEY), dict):
        raise ConfigError("RECIPE", str(path), f"a recipe (TOML), or a data set's {RECIPE_FILE}")
    return dict(document[_RECIPE_KEY])


def _refuse(settings: Mapping[str, Any], keys: tuple[str, ...], allowed: str) -> None:
    """Raise `ConfigError` for settings that a recipe must not have."""
    value: Any = settings
    for key in keys:
        if not isinstance(value, Mapping) or key not in value:
            return
        value = value[key]
    raise ConfigError(".".join(("garage", *keys)), value, allowed)
