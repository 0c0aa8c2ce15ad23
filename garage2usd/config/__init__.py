"""All settings of a garage: frozen, validated models; TOML in, JSON schema out."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field, ValidationError, field_validator

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, config_error
from garage2usd.config.building import BuildingConfig
from garage2usd.config.clutter import ClutterConfig
from garage2usd.config.design import designed_settings
from garage2usd.config.files import with_files, with_textures, without_files
from garage2usd.config.fittings import FittingsConfig, ParkingConfig
from garage2usd.config.look import LookConfig
from garage2usd.config.maps import MapsConfig
from garage2usd.config.own_cars import VehiclesConfig
from garage2usd.config.plan import PlanConfig
from garage2usd.config.site import BayConfig, SiteConfig
from garage2usd.config.stage import StageConfig
from garage2usd.config.stalls import StallsConfig
from garage2usd.profiles import DEFAULT_PROFILE, PROFILE_NAMES, Profile, load_profile, read_profile

__all__ = [
    "BayConfig",
    "BuildingConfig",
    "ClutterConfig",
    "FittingsConfig",
    "GarageConfig",
    "LookConfig",
    "MapsConfig",
    "ParkingConfig",
    "PlanConfig",
    "SiteConfig",
    "StageConfig",
    "StallsConfig",
    "VehiclesConfig",
    "config_from_mapping",
    "config_schema",
    "load_config",
    "profile_setting",
]


_DIRECTIONS = ("aisles", "one_way_share", "one_way")
"""Settings of the plan that came after its digest."""


class GarageConfig(Settings):
    """Everything that decides a garage. The same configuration and version give the same bytes."""

    seed: int = Field(0, ge=0, lt=2**63)
    """Seed of every random step."""
    site: SiteConfig = SiteConfig()
    """Contour, portals and obstacles."""
    bay: BayConfig = BayConfig()
    """Sizes of squares and stalls."""
    building: BuildingConfig = Field(BuildingConfig(), exclude_if=lambda building: building == BuildingConfig())
    """Levels and the ramps between them."""
    stalls: StallsConfig = StallsConfig()
    """Kinds and sizes of stalls."""
    plan: PlanConfig = PlanConfig()
    """The lane planner."""
    fittings: FittingsConfig = FittingsConfig()
    """Walls, lights, ducts, bumps, stops and signs."""
    parking: ParkingConfig = ParkingConfig()
    """Parked cars."""
    vehicles: VehiclesConfig = VehiclesConfig()
    """Cars of one's own."""
    clutter: ClutterConfig = ClutterConfig()
    """People and things that stand about."""
    look: LookConfig = LookConfig()
    """How it looks."""
    stage: StageConfig = StageConfig()
    """The stage's files."""
    maps: MapsConfig = MapsConfig()
    """Maps and scenarios."""
    profile: str | Profile = DEFAULT_PROFILE
    """The standard that the garage is designed to: 'cn-jgj100', 'de-garvo', 'uk-istructe', 'us-ada', a TOML file with a
    profile of one's own, whose relative path starts at the configuration file, or its contents. What it asks for takes
    the place of defaults that do not satisfy it; settings that are given stay."""

    def __init__(self, **settings: Any) -> None:  # noqa: ANN401 - pydantic's own signature
        """Validate `settings`.

        Raises
        ------
        ConfigError
            If a key is unknown or a value is not allowed.
        """
        try:
            super().__init__(**designed_settings(_standard(settings), settings))
        except ValidationError as error:
            raise config_error(error, GarageConfig) from None

    @field_validator("profile")
    @classmethod
    def _known(cls, profile: str | Profile) -> str | Profile:
        if isinstance(profile, str) and profile not in PROFILE_NAMES:
            raise ValueError(f"one of {', '.join(PROFILE_NAMES)}, or the contents of a profile")
        return profile

    @property
    def standard(self) -> Profile:
        """The profile that the garage is designed to."""
        return load_profile(self.profile) if isinstance(self.profile, str) else self.profile

    @property
    def names_files(self) -> bool:
        """Whether S, R or C are in files that `load_config` reads."""
        bay = self.bay
        return any(file is not None for file in (self.site.structure_file, bay.column_widths_file, bay.row_depths_file))

    def with_seed(self, seed: int) -> "GarageConfig":
        """The same settings with another seed."""
        return GarageConfig(**{**{name: getattr(self, name) for name in type(self).model_fields}, "seed": seed})

    def digest(self) -> str:
        """SHA-256 of the canonical JSON of all settings that decide the garage.

        These are all but ``maps`` and the places of its textures and models, of which counts what they hold.
        """
        of_look = {"textures": {"folder"}} if self.look.textures else {"textures"}
        # without models it is what it was before there were any
        of_vehicles = {"models": {"folder"}} if self.vehicles.models else True
        excluded: dict[str, Any] = {"maps": True, "look": of_look, "vehicles": of_vehicles}
        if self.stalls == StallsConfig():  # likewise
            excluded["stalls"] = True
        if all(getattr(self.plan, name) == PlanConfig.model_fields[name].default for name in _DIRECTIONS):
            excluded["plan"] = set(_DIRECTIONS)
        settings = self.model_dump(mode="json", exclude=excluded)
        canonical = json.dumps(settings, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(canonical.encode()).hexdigest()


def _standard(settings: Mapping[str, Any]) -> Profile:
    """The profile that settings name or hold, before they are validated; one that asks for nothing if it is unusable.

    Raises
    ------
    ConfigError
        If it is a profile of the user's own with a value that is not allowed.
    """
    given = settings.get("profile", DEFAULT_PROFILE)
    if isinstance(given, Profile):
        return given
    if isinstance(given, Mapping):
        return read_profile(dict(given))
    return load_profile(given) if given in PROFILE_NAMES else Profile(name="none")


def config_from_mapping(settings: Mapping[str, Any]) -> GarageConfig:
    """Validate settings given as nested mappings, as TOML reads them."""
    return GarageConfig(**settings)


def load_config(path: str | Path, *, profile: str | Path | None = None) -> GarageConfig:
    """Read a TOML configuration.

    Parameters
    ----------
    path
        The file. Relative paths in it, of ``profile``, of files with S, R and C, of textures or of models, start at its
        folder; they are read here, so that the configuration carries profile and matrices itself, and of the textures
        and models what they hold as a digest.
    profile
        Name or file of a profile that takes the place of the file's own.

    Raises
    ------
    ConfigError
        If the file cannot be read, is not TOML, or holds an unknown key or a value that is not allowed.
    """
    path = Path(path)
    settings = with_textures(read_toml(path, field="CONFIG"), path.parent)
    if profile is not None:
        settings["profile"] = profile_setting(profile)
    elif isinstance(settings.get("profile"), str):
        settings["profile"] = profile_setting(settings["profile"], folder=path.parent)
    config = config_from_mapping(settings)
    if not config.names_files:
        return config
    try:
        return config_from_mapping(with_files(settings, path.parent))
    except ConfigError as error:
        raise without_files(error, settings) from None


def profile_setting(name_or_file: str | Path, *, folder: Path | None = None) -> str | Profile:
    """The value of the setting ``profile`` for a shipped profile's name or a file.

    Raises
    ------
    ConfigError
        If there is no such profile, or the file holds what no profile has.
    """
    profile = load_profile(name_or_file, folder=folder)
    return profile.name if str(name_or_file) in PROFILE_NAMES else profile


def config_schema() -> dict[str, Any]:
    """JSON schema (2020-12) of the configuration."""
    schema = GarageConfig.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    return schema
