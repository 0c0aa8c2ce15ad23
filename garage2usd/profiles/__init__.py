"""Standards as data: the sizes that a garage is designed to and checked against, each with its source."""

from functools import cache
from pathlib import Path
from typing import Any

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import validated
from garage2usd.profiles.clauses import Area, Clause, Confidence, Length, LengthRange, Severity, Steps
from garage2usd.profiles.profile import PROFILE_NAMES, Profile, nearest_profile, shipped_settings

__all__ = [
    "DEFAULT_PROFILE",
    "NO_PROFILE",
    "PROFILE_NAMES",
    "Area",
    "Clause",
    "Confidence",
    "Length",
    "LengthRange",
    "Profile",
    "Severity",
    "Steps",
    "is_profile_file",
    "load_profile",
    "read_profile",
]

DEFAULT_PROFILE = "cn-jgj100"
NO_PROFILE = "none"
"""Name of a profile without clauses, which requires nothing."""
_WORDS = frozenset({"name", "title", "country"})
"""Keys of a profile that are not clauses."""
_ALLOWED = f"one of {', '.join(PROFILE_NAMES)}"


def is_profile_file(name: str) -> bool:
    """True if a profile is given by the path of a file instead of a name."""
    return name not in PROFILE_NAMES and (name.lower().endswith(".toml") or "/" in name or "\\" in name)


def load_profile(name_or_file: str | Path, *, folder: Path | None = None) -> Profile:
    """Load a shipped profile by its name, or a profile of the user from a TOML file.

    Parameters
    ----------
    name_or_file
        One of `PROFILE_NAMES`, or a path.
    folder
        Folder of a relative path; the working directory if left out.

    Raises
    ------
    ConfigError
        If there is no such profile, the file cannot be read, or it holds an unknown clause or a value that is not
        allowed.
    """
    name = str(name_or_file)
    if name in PROFILE_NAMES:
        return _shipped(name)
    if not is_profile_file(name):
        raise ConfigError(
            "profile", name, f"{_ALLOWED}, or a path that ends in .toml; the nearest is {nearest_profile(name)}"
        )
    return read_profile(read_toml((folder or Path()) / name, field="profile"))


def read_profile(settings: dict[str, Any]) -> Profile:
    """Validate a profile given as nested mappings, as TOML reads them.

    Parameters
    ----------
    settings
        A name and clauses, which with ``based_on`` replace those of a shipped profile or are added to them; or the name
        of a shipped profile alone.

    Raises
    ------
    ConfigError
        If a clause is unknown or its value is not allowed; names the clause, the value and the allowed ones. If the
        settings have no clause and no shipped profile has the name; names the nearest one. If clauses of a shipped
        profile are changed under its name.
    """
    profile = validated(Profile, settings, within="profile")
    name, is_shipped = profile.name, profile.name in PROFILE_NAMES
    if settings.keys() <= _WORDS:
        if is_shipped:
            return _shipped(name)
        if name != NO_PROFILE:
            allowed = f"{_ALLOWED}, or clauses beside the name, or '{NO_PROFILE}' for none"
            raise ConfigError("profile.name", name, f"{allowed}; the nearest is {nearest_profile(name)}")
    if is_shipped and dict(profile.clauses()) != dict(_shipped(name).clauses()):
        allowed = f"another name where clauses differ from the shipped profile, and based_on = '{name}' to change some"
        raise ConfigError("profile.name", name, allowed)
    return profile


@cache
def _shipped(name: str) -> Profile:
    return validated(Profile, shipped_settings(name), within="profile")
