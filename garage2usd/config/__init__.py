"""All settings of a garage: frozen, validated models, read from TOML and described by a JSON schema."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field, ValidationError, field_validator

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, config_error
from garage2usd.config.design import designed_settings
from garage2usd.config.files import with_files, with_textures, without_files
from garage2usd.config.fittings import ClutterConfig, FittingsConfig, ParkingConfig
from garage2usd.config.look import LookConfig
from garage2usd.config.outputs import MapsConfig, StageConfig, UpAxis
from garage2usd.config.own_cars import VehiclesConfig, read_own_cars
from garage2usd.config.plan import PlanConfig
from garage2usd.config.site import BayConfig, BuildingConfig, SiteConfig
from garage2usd.config.stalls import StallsConfig
from garage2usd.config.texture_sets import texture_remarks
from garage2usd.config.traffic import TrafficConfig
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
    "TrafficConfig",
    "VehiclesConfig",
    "config_from_mapping",
    "config_in",
    "config_schema",
    "load_config",
    "profile_setting",
]


_DIRECTIONS = ("aisles", "one_way_share", "one_way")
"""Settings of the plan that enter the digest only if they differ from their defaults, so that older digests stay valid.
"""
_LATER_CLAUSES = ("motorcycle_stall_width", "motorcycle_stall_length", "curved_ramp_slope")
"""Clauses of profiles for which the same holds."""


class GarageConfig(Settings):
    """All settings of a garage. The same settings and version give the same bytes."""

    seed: int = Field(0, ge=0, lt=2**63)
    """Seed of every random step."""
    site: SiteConfig = SiteConfig()
    """Contour, portals and obstacles."""
    bay: BayConfig = BayConfig()
    """Sizes of squares, stalls, columns and aisles."""
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
    """Models of cars that the user supplies."""
    clutter: ClutterConfig = ClutterConfig()
    """People and loose objects."""
    look: LookConfig = LookConfig()
    """The garage's look: finishes, markings, lights and signs."""
    stage: StageConfig = StageConfig()
    """Files of the stage."""
    maps: MapsConfig = MapsConfig()
    """Maps and scenarios."""
    traffic: TrafficConfig = Field(TrafficConfig(), exclude_if=lambda traffic: traffic == TrafficConfig())
    """The garage in operation, as the command traffic shows it."""
    profile: str | Profile = DEFAULT_PROFILE
    """The standard that the garage is designed to: 'cn-jgj100', 'de-garvo', 'uk-istructe', 'us-ada', a TOML file with a
    profile of the user, or the contents of such a file. A relative path is resolved against the folder of the
    configuration file. Defaults that violate the profile are replaced; values given by the user are kept."""

    def __init__(self, **settings: Any) -> None:  # noqa: ANN401 - pydantic's own signature
        """Validate `settings`.

        Raises
        ------
        ConfigError
            If a key is unknown or a value is not allowed.
        """
        try:
            standard = _standard(settings)
            if isinstance(settings.get("profile"), Mapping):
                settings["profile"] = standard.name if standard.name in PROFILE_NAMES else standard
            super().__init__(**designed_settings(standard, settings))
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
        """True if S, R or C are to be read from files, as `load_config` does."""
        bay = self.bay
        return any(file is not None for file in (self.site.structure_file, bay.column_widths_file, bay.row_depths_file))

    def with_seed(self, seed: int) -> "GarageConfig":
        """Return the same settings with another seed."""
        return GarageConfig(**{**self._given(), "seed": seed})

    def with_usual_profile(self, name: str) -> "GarageConfig":
        """Return the same settings with a shipped profile instead of the default one; unchanged if they give one."""
        return self if "profile" in self.model_fields_set else GarageConfig(**self._given(), profile=name)

    def _given(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in type(self).model_fields if name in self.model_fields_set}

    def remarks(self) -> tuple[str, ...]:
        """Describe the use of the user's textures, and the unused parts of textures and car models, in lines.

        Raises
        ------
        ConfigError
            If a folder cannot be read.
        """
        textures = texture_remarks(self.look.textures) if self.look.textures else ()
        models = read_own_cars(self.vehicles.models)[1] if self.vehicles.models else ()
        return (*textures, *(line for model in models for line in model.remarks))

    def digest(self) -> str:
        """SHA-256 of the canonical JSON of all settings that decide the garage.

        ``maps`` is left out. Of texture and model folders and a font, the digest of the contents counts, not the path.
        """
        of_look: dict[str, Any] = {"textures": {"folder"} if self.look.textures else True}
        if self.look.font:
            of_look["font"] = {"file"}
        # keeps the digests of garages without models, which are older than this setting
        of_vehicles = {"models": {"folder"}} if self.vehicles.models else True
        excluded: dict[str, Any] = {"maps": True, "look": of_look, "vehicles": of_vehicles}
        if self.stalls == StallsConfig():  # for the same reason
            excluded["stalls"] = True
        if not self.bay.column_setback_m:
            excluded["bay"] = {"column_setback_m"}
        if all(getattr(self.plan, name) == PlanConfig.model_fields[name].default for name in _DIRECTIONS):
            excluded["plan"] = set(_DIRECTIONS)
        if self.stage.up_axis is UpAxis.Y:
            excluded["stage"] = {"up_axis"}
        if isinstance(self.profile, Profile):
            excluded["profile"] = {name for name in _LATER_CLAUSES if getattr(self.profile, name) is None}
        settings = self.model_dump(mode="json", exclude=excluded)
        canonical = json.dumps(settings, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(canonical.encode()).hexdigest()


def _standard(settings: Mapping[str, Any]) -> Profile:
    """Load the profile of settings that are not validated yet; an empty profile if the setting is invalid.

    Raises
    ------
    ConfigError
        If the profile is given by its contents and a value in it is not allowed.
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
        The file. Relative paths in it (``profile``, files of S, R and C, folders of textures and models) are resolved
        against its folder. Profile and matrices are read into the configuration; textures and models are recorded by
        a digest of their contents.
    profile
        Name or file of a profile that replaces the one in the file.

    Raises
    ------
    ConfigError
        If the file cannot be read, is not TOML, or holds an unknown key or a value that is not allowed.
    """
    path = Path(path)
    return config_in(read_toml(path, field="CONFIG"), path.parent, profile=profile)


def config_in(settings: Mapping[str, Any], folder: Path, *, profile: str | Path | None = None) -> GarageConfig:
    """Validate settings as TOML reads them, whose relative paths start at a folder; the rest as for `load_config`."""
    settings = with_textures(settings, folder)
    if profile is not None:
        settings["profile"] = profile_setting(profile)
    elif isinstance(settings.get("profile"), str):
        settings["profile"] = profile_setting(settings["profile"], folder=folder)
    config = config_from_mapping(settings)
    if not config.names_files:
        return config
    try:
        return config_from_mapping(with_files(settings, folder))
    except ConfigError as error:
        raise without_files(error, settings) from None


def profile_setting(name_or_file: str | Path, *, folder: Path | None = None) -> str | Profile:
    """Return the value of the setting ``profile`` for the name of a shipped profile or the path of a file.

    Raises
    ------
    ConfigError
        If there is no such profile, or the file holds an unknown clause or a value that is not allowed.
    """
    profile = load_profile(name_or_file, folder=folder)
    return profile.name if str(name_or_file) in PROFILE_NAMES else profile


def config_schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of the configuration."""
    schema = GarageConfig.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    return schema
