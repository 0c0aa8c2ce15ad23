"""Files that a configuration refers to: S, R and C as text or NumPy arrays, and folders of textures and models."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from garage2usd.common.documents import ARRAY_SUFFIXES, read_arrays, read_text
from garage2usd.common.errors import ConfigError


class _Given(NamedTuple):
    """A matrix that a file may hold: section, setting, the setting with the file's path, and name in .npz files."""

    section: str
    key: str
    file_key: str
    name: str


_MATRICES = (
    _Given("site", "structure", "structure_file", "S"),
    _Given("bay", "column_widths_m", "column_widths_file", "R"),
    _Given("bay", "row_depths_m", "row_depths_file", "C"),
)


FOLDERS = (("look", "textures"), ("look", "font"), ("vehicles", "models"))
"""Section and setting of each folder of the user's files, and of the user's font."""


def is_array_file(path: Path) -> bool:
    """True if a file is a NumPy array, judged by its extension."""
    return path.suffix.lower() in ARRAY_SUFFIXES


def matrices_of(path: Path, *, field: str) -> dict[str, dict[str, Any]]:
    """Read the settings held by a NumPy file with S, or with S, R and C.

    Raises
    ------
    ConfigError
        If the file cannot be read, or lacks S.
    """
    arrays = read_arrays(path, field=field, names=[given.name for given in _MATRICES])
    settings: dict[str, dict[str, Any]] = {}
    for given in _MATRICES:
        if given.name in arrays:
            settings.setdefault(given.section, {})[given.key] = arrays[given.name]
    return settings


def with_files(settings: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Replace the paths of matrix files by the matrices that they hold.

    Parameters
    ----------
    settings
        Settings that are valid apart from the files.
    folder
        Folder of relative paths.

    Raises
    ------
    ConfigError
        If a file cannot be read, or both an .npz file and the settings give R or C.
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
    """Make the paths of texture and model folders and of a font absolute; other settings stay, valid or not."""
    result = dict(settings)
    for section, key in FOLDERS:
        match result.get(section):
            case {**given} if key in given:
                result[section] = {**given, key: absolute_in(folder, given[key])}
    return result


def absolute_in(folder: Path, named: Any) -> Any:  # noqa: ANN401 - whatever the setting holds
    """Make a path, or each path of a list, absolute; anything else is returned unchanged, valid or not."""
    if isinstance(named, list):
        return [absolute_in(folder, each) for each in named]
    return str((folder / named).absolute()) if isinstance(named, str) and named else named


def _put(matrix: Any, given: _Given, settings: dict[str, Any], path: Path) -> None:  # noqa: ANN401
    """Set a matrix read from a file, unless the settings give it already."""
    section = settings.setdefault(given.section, {})
    for key in (given.key, given.file_key):
        if key in section:
            raise ConfigError(f"{given.section}.{key}", section[key], f"no {given.name} beside that of {path}")
    section[given.key] = matrix


def without_files(error: ConfigError, settings: Mapping[str, Any]) -> ConfigError:
    """Report an error in a file's value under the setting that names the file."""
    for given in _MATRICES:
        section = settings.get(given.section)
        named = section.get(given.file_key) if isinstance(section, Mapping) else None
        key = f"{given.section}.{given.key}"
        if named is not None and f"{error.field}.".startswith(f"{key}."):
            field = f"{given.section}.{given.file_key}{error.field.removeprefix(key)}"
            return ConfigError(field, error.value, f"{error.allowed} in {named}")
    return error


def _read(given: _Given, path: Path, field: str) -> dict[str, dict[str, Any]]:
    """Read a matrix file; settings by section and key."""
    if is_array_file(path):
        if given.name == "S":
            return matrices_of(path, field=field)
        return {given.section: {given.key: read_arrays(path, field=field, names=[given.name])[given.name]}}
    text = read_text(path, field=field)
    return {given.section: {given.key: text if given.name == "S" else _numbers(text, path, field)}}


def _numbers(text: str, path: Path, field: str) -> Any:  # noqa: ANN401 - one number, some, or rows of them
    """Parse numbers separated by commas or blanks: a list for a single line or column, else a matrix."""
    try:
        rows = [[float(word) for word in line.replace(",", " ").split()] for line in text.splitlines() if line.strip()]
    except ValueError as error:
        raise ConfigError(field, str(path), f"metres as numbers ({error})") from None
    if not rows:
        raise ConfigError(field, str(path), "metres as numbers, not an empty file")
    if len(rows) == 1:
        return rows[0]
    return [row[0] for row in rows] if all(len(row) == 1 for row in rows) else rows
