"""Files beside a configuration: S, R and C as text or files of NumPy, and the folders of textures and models."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from garage2usd.common.documents import ARRAY_SUFFIXES, read_arrays, read_text
from garage2usd.common.errors import ConfigError

__all__ = ["is_array_file", "matrices_of", "with_files", "with_textures", "without_files"]


class _Given(NamedTuple):
    """A matrix: its section, the setting that holds it, the one that names its file, and its name in an .npz file."""

    section: str
    key: str
    file_key: str
    name: str


_MATRICES = (
    _Given("site", "structure", "structure_file", "S"),
    _Given("bay", "column_widths_m", "column_widths_file", "R"),
    _Given("bay", "row_depths_m", "row_depths_file", "C"),
)


def is_array_file(path: Path) -> bool:
    """Whether a file is one of NumPy, by its name."""
    return path.suffix.lower() in ARRAY_SUFFIXES


def matrices_of(path: Path, *, field: str) -> dict[str, dict[str, Any]]:
    """The settings that a file of NumPy with S, or with S, R and C, stands for.

    Raises
    ------
    ConfigError
        If it cannot be read, or lacks S.
    """
    arrays = read_arrays(path, field=field, names=[given.name for given in _MATRICES])
    settings: dict[str, dict[str, Any]] = {}
    for given in _MATRICES:
        if given.name in arrays:
            settings.setdefault(given.section, {})[given.key] = arrays[given.name]
    return settings


def with_files(settings: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The settings with what the files hold that they name, in place of their names.

    Parameters
    ----------
    settings
        Settings that are valid apart from that.
    folder
        Where relative paths start.

    Raises
    ------
    ConfigError
        If a file cannot be read, or an .npz file and the settings both give R or C.
    """
    result = {name: dict(value) if isinstance(value, Mapping) else value for name, value in settings.items()}
    for given in _MATRICES:
        named = result.get(given.section, {}).get(given.file_key)
        if named is None:
            continue
        path, field = folder / named, f"{given.section}.{given.file_key}"
        found = _read(given, path, field)
        del result[given.section][given.file_key]
        for other in _MATRICES:
            if other.key in found.get(other.section, {}):
                _put(found[other.section][other.key], other, result, path)
    return result


def with_textures(settings: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The settings, valid or not, with the whole paths of folders of textures and models that have relative ones."""
    result = dict(settings)
    for section, key in (("look", "textures"), ("vehicles", "models")):
        match result.get(section):
            case {**given} if isinstance(named := given.get(key), str) and named:
                result[section] = {**given, key: str((folder / named).absolute())}
    return result


def _put(matrix: Any, given: _Given, settings: dict[str, Any], path: Path) -> None:  # noqa: ANN401
    """Set a matrix that a file holds, unless the settings have it already."""
    section = settings.setdefault(given.section, {})
    for key in (given.key, given.file_key):
        if key in section:
            raise ConfigError(f"{given.section}.{key}", section[key], f"no {given.name} beside that of {path}")
    section[given.key] = matrix


def without_files(error: ConfigError, settings: Mapping[str, Any]) -> ConfigError:
    """An error of a value that came from a file, as one that names the setting of that file."""
    for given in _MATRICES:
        section = settings.get(given.section)
        named = section.get(given.file_key) if isinstance(section, Mapping) else None
        key = f"{given.section}.{given.key}"
        if named is not None and f"{error.field}.".startswith(f"{key}."):
            field = f"{given.section}.{given.file_key}{error.field.removeprefix(key)}"
            return ConfigError(field, error.value, f"{error.allowed} in {named}")
    return error


def _read(given: _Given, path: Path, field: str) -> dict[str, dict[str, Any]]:
    """What a file holds, by section and key."""
    if is_array_file(path):
        if given.name == "S":
            return matrices_of(path, field=field)
        return {given.section: {given.key: read_arrays(path, field=field, names=[given.name])[given.name]}}
    text = read_text(path, field=field)
    return {given.section: {given.key: text if given.name == "S" else _numbers(text, path, field)}}


def _numbers(text: str, path: Path, field: str) -> Any:  # noqa: ANN401 - one number, some, or rows of them
    """Numbers apart by commas or blanks: all of one line or column, or a matrix."""
    try:
        rows = [[float(word) for word in line.replace(",", " ").split()] for line in text.splitlines() if line.strip()]
    except ValueError as error:
        raise ConfigError(field, str(path), f"metres as numbers ({error})") from None
    if not rows:
        raise ConfigError(field, str(path), "metres as numbers, not an empty file")
    if len(rows) == 1:
        return rows[0]
    return [row[0] for row in rows] if all(len(row) == 1 for row in rows) else rows
