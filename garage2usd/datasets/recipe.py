"""The recipe of a data set: which garages, what is made of each, and into which splits and shards they go."""

import json
import zlib
from collections.abc import Iterator, Mapping
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, field_validator, model_validator

from garage2usd.common.documents import MAX_SETTINGS_BYTES, read_json, read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, derived_seed
from garage2usd.common.settings import Settings, validated
from garage2usd.common.version import VERSION
from garage2usd.config import GarageConfig, config_from_mapping, profile_setting
from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.distribution import Weight, distribution_of
from garage2usd.datasets.drives import DrivesConfig
from garage2usd.datasets.settings_table import first_value, over, pin_textures, resolved
from garage2usd.sensors.rig.rig import read_rig

__all__ = ["Alternative", "Distinct", "MakeConfig", "Recipe", "ShardForm", "ShardsConfig", "load_recipe"]

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
"""Settings that a recipe cannot have, and what it can have in their place."""

Name = Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]*$", max_length=60)]


class Distinct(StrEnum):
    """What no two garages of a data set share."""

    PLAN = "plan"
    """The plan in squares, also turned or mirrored."""
    SEED = "seed"
    """Nothing but the seed: plans may be equal."""


class ShardForm(StrEnum):
    """How the files of garages are kept."""

    TAR = "tar"
    """In tar archives, as WebDataset reads them."""
    FOLDER = "folder"
    """In folders, which are those archives unpacked."""


class Alternative(Settings):
    """Settings that are drawn together."""

    name: Name
    """What the manifest calls it."""
    weight: Weight = 1.0
    """How often it is drawn in relation to the other alternatives of its group."""
    garage: dict[str, Any] = Field(default_factory=dict)
    """Settings, as in the recipe's own table of that name, over which they go."""


class MakeConfig(Settings):
    """What is made of each garage, by the names of `garage2usd build`."""

    stage: bool = True
    """Whether there is a stage (``.usdc``, or ``.usdz`` where garages are self-contained)."""
    plan: bool = True
    """Whether there is a picture of the plan (``.plan.png``)."""
    labels: bool = True
    """Whether there is a table of the classes and bounds of all objects (``.labels.json``)."""
    difficulty: bool = True
    """Whether the ways into each stall are proven and rated (``.difficulty.json``), and so the garage."""
    exports: tuple[Literal["glb", "osm", "xodr", "xosc", "yaml"], ...] = ()
    """Formats that each stage is exported to, as by `build --with`."""
    drives: DrivesConfig | None = None
    """Drives that are recorded with a rig, as by `render --rig` (``.drive_0.zip``); left out, none."""
    gzip: bool = False
    """Whether files of text (maps, reports, labels) are compressed and end in ``.gz``: a tenth of their size."""
    self_contained: bool = False
    """Whether each stage is a ``.usdz`` with its assets, instead of referring to the data set's."""

    @field_validator("exports")
    @classmethod
    def _once(cls, exports: tuple[str, ...]) -> tuple[str, ...]:
        if len(set(exports)) < len(exports):
            raise ValueError("each format once")
        return exports

    @model_validator(mode="after")
    def _has_stage(self) -> Self:
        if (self.exports or self.drives or self.self_contained) and not self.stage:
            raise ValueError("stage = true where stages are exported, driven through or self-contained")
        return self


class ShardsConfig(Settings):
    """How garages are kept in files."""

    form: ShardForm = ShardForm.TAR
    """'tar' or 'folder'."""
    garages: int = Field(100, ge=1, le=100_000)
    """How many garages a shard has at most: what is made at once, and made again if it is interrupted."""


class Recipe(Settings):
    """Everything that decides a data set. The same recipe and version give the same bytes."""

    name: Name
    """What the data set is called."""
    description: str = Field("", max_length=10_000)
    """What it is for, in a sentence or two; for the data card."""
    licence: str = Field("", max_length=200)
    """Under which licence it is given to others; for the data card."""
    seed: int = Field(0, ge=0, lt=2**63)
    """Seed of every draw."""
    count: int = Field(100, ge=1, le=10_000_000)
    """How many garages."""
    distinct: Distinct = Distinct.PLAN
    """'plan': no two garages have one plan, turned or mirrored; 'seed': they may."""
    attempts: int = Field(40, ge=1, le=10_000)
    """How often a garage is drawn at most, until one is possible and its plan is not there yet."""
    garage: dict[str, Any] = Field(default_factory=dict)
    """The settings of `garage2usd build`; in place of any value a distribution may stand."""
    difficulty: dict[Level, Annotated[float, Field(gt=0, le=1e9)]] = Field(default_factory=dict)
    """How many garages are of each level of difficulty ('normal', 'complex', 'extreme'), in relation to each other;
    garages of other levels are drawn again. Left out, as they come."""
    groups: dict[Name, tuple[Alternative, ...]] = Field(default_factory=dict)
    """Of each group one alternative is drawn for each garage, whose settings go over `garage`."""
    make: MakeConfig = MakeConfig()
    """What is made of each garage."""
    shards: ShardsConfig = ShardsConfig()
    """How they are kept."""
    splits: dict[Name, Annotated[float, Field(gt=0, le=1e9)]] = Field(
        default_factory=lambda: {"train": 0.8, "validation": 0.1, "test": 0.1}, min_length=1
    )
    """The parts of the data set and their sizes in relation to each other."""

    @field_validator("groups")
    @classmethod
    def _has_alternatives(cls, groups: dict[str, tuple[Alternative, ...]]) -> dict[str, tuple[Alternative, ...]]:
        for group, alternatives in groups.items():
            names = [alternative.name for alternative in alternatives]
            if not names or len(set(names)) != len(names):
                raise ValueError(f"in {group} one or more alternatives, each with a name of its own")
        return groups

    def garage_seed(self, number: int, attempt: int) -> int:
        """The seed of a garage at an attempt to draw it."""
        return derived_seed(self.seed, Step.GARAGES, number, attempt)

    def drawn(self, seed: int) -> tuple[GarageConfig, dict[str, str]]:
        """The configuration of a garage, and the names of its alternatives by group.

        Each distribution has a generator of its own, by the name of its setting, so that one that is added or taken
        away leaves the others' draws as they are.

        Raises
        ------
        ConfigError
            If settings were drawn that cannot be used.
        """
        chosen = {}
        settings = self.garage
        for group, alternatives in sorted(self.groups.items()):
            weights = np.cumsum([alternative.weight for alternative in alternatives])
            place = _generator(seed, f"groups.{group}").random() * weights[-1]
            alternative = alternatives[int(np.searchsorted(weights, place, side="right"))]
            chosen[group] = alternative.name
            settings = over(settings, alternative.garage)

        def draw(value: object, field: str) -> object:
            distribution = distribution_of(value, field=field)
            return value if distribution is None else distribution.draw(_generator(seed, field))

        return self._config(resolved(settings, "garage", draw), seed), chosen

    def record(self) -> str:
        """The recipe with the version of garage2usd as JSON, which `load_recipe` reads again."""
        return json.dumps({_VERSION_KEY: VERSION, _RECIPE_KEY: self.model_dump(mode="json")}, indent=1) + "\n"

    def check(self) -> None:
        """Find out whether settings that may be drawn can be used.

        Tried are the ends of each distribution, with the first values of the others.

        Raises
        ------
        ConfigError
            If they cannot; names the setting, the value and what is allowed.
        """
        for settings in self._variants():
            ends_of: dict[str, tuple[Any, ...]] = {}
            self._config(resolved(settings, "garage", partial(first_value, ends_of=ends_of)), 0)
            for asked, ends in ends_of.items():
                for end in ends:
                    self._config(resolved(settings, "garage", partial(first_value, ends_of={}, given={asked: end})), 0)

    def _variants(self) -> Iterator[dict[str, Any]]:
        """The settings with each alternative, beside the first ones of other groups."""
        first = self.garage
        for alternatives in self.groups.values():
            first = over(first, alternatives[0].garage)
        yield first
        for group, alternatives in self.groups.items():
            for alternative in alternatives[1:]:
                settings = self.garage
                for other, others in self.groups.items():
                    settings = over(settings, (alternative if other == group else others[0]).garage)
                yield settings

    def _config(self, settings: dict[str, Any], seed: int) -> GarageConfig:
        for keys, allowed in _DECIDED.items():
            _refuse(settings, keys, allowed)
        given = dict(settings)
        stage = given.get("stage", {})
        if not self.make.self_contained and isinstance(stage, dict):
            given["stage"] = {**stage, "assets": "shared", "asset_folder": _FROM_SHARD}
        try:
            return config_from_mapping({**given, "seed": seed})
        except ConfigError as error:
            raise ConfigError(f"garage.{error.field}", error.value, error.allowed) from None


def load_recipe(path: str | Path) -> Recipe:
    """Read a recipe: TOML, or the ``recipe.json`` of a data set.

    Parameters
    ----------
    path
        The file; a profile, a rig and textures of one's own that it names are looked for in its folder. Of textures the
        recipe has the whole path and the digest of what they hold.

    Raises
    ------
    ConfigError
        If it cannot be read, has an unknown key or a value that is not allowed, or could draw settings that cannot be
        used.
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


def _recorded(path: Path) -> dict[str, Any]:
    """The settings of a recipe that stands in a data set."""
    document = read_json(path, field="RECIPE", max_bytes=MAX_SETTINGS_BYTES)
    if not isinstance(document, dict) or not isinstance(document.get(_RECIPE_KEY), dict):
        raise ConfigError("RECIPE", str(path), f"a recipe (TOML), or a data set's {RECIPE_FILE}")
    return dict(document[_RECIPE_KEY])


def _generator(seed: int, field: str) -> np.random.Generator:
    """The generator of one distribution of one garage."""
    return np.random.Generator(
        np.random.PCG64(np.random.SeedSequence([seed, int(Step.SETTINGS), zlib.crc32(field.encode())]))
    )


def _refuse(settings: Mapping[str, Any], keys: tuple[str, ...], allowed: str) -> None:
    """Raise `ConfigError` for settings that a recipe cannot have."""
    value: Any = settings
    for key in keys:
        if not isinstance(value, Mapping) or key not in value:
            return
        value = value[key]
    raise ConfigError(".".join(("garage", *keys)), value, allowed)
