"""Text, TOML and JSON that anybody may have written: read as far as a limit, and refused in one kind of error."""

import json
import os
import stat
import tomllib
from pathlib import Path
from typing import Any, NoReturn

from garage2usd.errors import ConfigError

__all__ = ["MAX_REPORT_BYTES", "MAX_SETTINGS_BYTES", "is_file", "read_bytes", "read_json", "read_text", "read_toml"]

MAX_SETTINGS_BYTES = 16 * 1024 * 1024
"""Configurations, profiles and structures are no larger."""
MAX_REPORT_BYTES = 512 * 1024 * 1024
"""Reports of builds list each stall."""


def is_file(path: Path) -> bool:
    """Whether a path leads to a regular file; `pathlib` raises for names that no file can have."""
    return os.path.isfile(path)  # noqa: PTH113


def read_bytes(path: Path, *, field: str, max_bytes: int = MAX_SETTINGS_BYTES) -> bytes:
    """The bytes of a regular file.

    Parameters
    ----------
    path
        The file; a symbolic link is followed, as everywhere.
    field
        What an error calls it: a setting or an argument.
    max_bytes
        How large it may be; no more of it is read.

    Raises
    ------
    ConfigError
        If it cannot be read, is no regular file (a pipe would never end), or is too large.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise ConfigError(field, str(path), "a regular file")
        with path.open("rb") as file:
            data = file.read(max_bytes + 1)
    except (OSError, ValueError) as error:  # a path with a null byte is a ValueError
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise ConfigError(field, str(path), f"a readable file ({reason})") from None
    if len(data) > max_bytes:
        raise ConfigError(field, str(path), f"a file of at most {max_bytes} bytes")
    return data


def read_text(path: Path, *, field: str, max_bytes: int = MAX_SETTINGS_BYTES) -> str:
    """The text of a file in UTF-8; raises `ConfigError` as `read_bytes`, and for other encodings."""
    try:
        return read_bytes(path, field=field, max_bytes=max_bytes).decode()
    except UnicodeDecodeError as error:
        raise ConfigError(field, str(path), f"UTF-8 text ({error.reason} at byte {error.start})") from None


def read_toml(path: Path, *, field: str) -> dict[str, Any]:
    """The tables of a TOML file; raises `ConfigError` as `read_text`, and for what is no TOML."""
    text = read_text(path, field=field)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # brackets a thousand deep, numbers of 5000 digits
        raise ConfigError(field, str(path), f"TOML ({error})") from None


def read_json(path: Path, *, field: str, max_bytes: int) -> Any:  # noqa: ANN401 - whatever JSON holds
    """The value of a JSON file; raises `ConfigError` as `read_text`, and for what is no JSON, NaN and infinity too."""
    text = read_text(path, field=field, max_bytes=max_bytes)
    try:
        return json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise ConfigError(field, str(path), f"JSON ({error})") from None


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number")
