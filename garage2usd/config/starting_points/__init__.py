"""Starting points: named configurations of usual garages, for those who do not want to choose settings yet."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from garage2usd.common.documents import shipped_toml
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, config_from_mapping, profile_setting

STARTING_POINTS = ("airport-us", "mall-cn", "office-uk", "residential-de")
"""Names of the starting points: a use and a country."""
_VARY = "vary"
"""Section of a file with distributions of settings, in which the garages of a data set differ."""


def starting_point(name: str, *, profile: str | Path | None = None) -> GarageConfig:
    """Return the configuration of a starting point, designed to another profile if one is given.

    Raises
    ------
    ConfigError
        If the name is not one of `STARTING_POINTS`, or there is no such profile.
    """
    settings, _ = _read(name)
    return config_from_mapping({**settings, **({} if profile is None else {"profile": profile_setting(profile)})})


def varied_settings(name: str) -> dict[str, Any]:
    """Return the settings of a starting point, with distributions of those in which the garages of a data set differ.

    Raises
    ------
    ConfigError
        If the name is not one of `STARTING_POINTS`.
    """
    settings, varied = _read(name)
    return {**settings, **{section: {**settings.get(section, {}), **given} for section, given in varied.items()}}


def _read(name: str) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    if name not in STARTING_POINTS:
        raise ConfigError("like", name, f"one of {', '.join(STARTING_POINTS)}")
    settings = shipped_toml(__name__, name)
    return settings, settings.pop(_VARY)
