"""Standards as data: the sizes that a garage is designed to and checked against, each with its source."""

import tomllib
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import validated
from garage2usd.profiles.clauses import Area, Clause, Confidence, Length, LengthRange, Severity, Steps
from garage2usd.profiles.profile import Profile

__all__ = [
    "DEFAULT_PROFILE",
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
PROFILE_NAMES = ("cn-jgj100", "de-garvo", "uk-istructe", "us-ada")
"""Names of the shipped profiles."""


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
        raise ConfigError("profile", name, f"one of {', '.join(PROFILE_NAMES)}, or a path that ends in .toml")
    return read_profile(read_toml((folder or Path()) / name, field="profile"))


def read_profile(settings: dict[str, Any]) -> Profile:
    """Validate a profile given as nested mappings, as TOML reads them.

    Raises
    ------
    ConfigError
        If a clause is unknown or its value is not allowed; names the clause, the value and the allowed ones.
    """
    return validated(Profile, settings, within="profile")


@cache
def _shipped(name: str) -> Profile:
    text = (resources.files("garage2usd.profiles") / f"{name}.toml").read_text(encoding="utf-8")
    return read_profile(tomllib.loads(text))
