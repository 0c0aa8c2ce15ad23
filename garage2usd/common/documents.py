"""Documents: untrusted text, TOML, JSON and NumPy files read up to a size limit, and JSON written compactly."""

import codecs
import io
import json
import os
import re
import stat
import tomllib
import zipfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from importlib import resources
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError

ARRAY_SUFFIXES = (".npy", ".npz")
"""Extensions of NumPy files."""
_HEADERS: dict[tuple[int, int], Callable[[io.BytesIO], tuple[tuple[int, ...], bool, np.dtype[Any]]]] = {
    (1, 0): npy_format.read_array_header_1_0,
    (2, 0): npy_format.read_array_header_2_0,
}
MAX_SETTINGS_BYTES = 16 * 1024 * 1024
"""Size limit of configurations, profiles and structures."""
MAX_REPORT_BYTES = 512 * 1024 * 1024
"""Size limit of build reports, which list every stall."""
_STRING_OR_ZERO = re.compile(r'(?P<string>"(?:[^"\\]|\\.)*")|(?<=\d)(?<!-0)\.0(?![\de])')
"""A string, or the ``.0`` of an integral number; that of -0.0 is kept, since integers have no signed zero."""


def is_file(path: Path) -> bool:
    """True if a path is a regular file; also False for names that no file can have, for which `pathlib` raises."""
    return os.path.isfile(path)  # noqa: PTH113


def read_bytes(path: Path, *, field: str, max_bytes: int = MAX_SETTINGS_BYTES) -> bytes:
    """Read the bytes of a regular file.

    Parameters
    ----------
    path
        The file; symbolic links are followed.
    field
        Name of the setting or argument, for the error.
    max_bytes
        Size limit; no more is read.

    Raises
    ------
    ConfigError
        If the file cannot be read, is not a regular file (a pipe might never end), or is too large.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise ConfigError(field, str(path), "a regular file")
        with path.open("rb") as file:
            data = file.read(max_bytes + 1)
    except (OSError, ValueError) as error:  # ValueError for a path with a null byte
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise ConfigError(field, str(path), f"a readable file ({reason})") from None
    if len(data) > max_bytes:
        raise ConfigError(field, str(path), f"a file of at most {max_bytes} bytes")
    return data


def read_text(path: Path, *, field: str, max_bytes: int = MAX_SETTINGS_BYTES, otherwise: str = "utf-8") -> str:
    """Read a text file in UTF-8, or in UTF-16 with a byte order mark, which is removed; or else in another encoding.

    Raises
    ------
    ConfigError
        As `read_bytes`, and for other encodings.
    """
    data = read_bytes(path, field=field, max_bytes=max_bytes)
    is_wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return data.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        if not is_wide and otherwise != "utf-8":
            with suppress(UnicodeDecodeError):
                return data.decode(otherwise)
        raise ConfigError(field, str(path), f"UTF-8 text ({error.reason} at byte {error.start})") from None


def read_toml(path: Path, *, field: str) -> dict[str, Any]:
    """Read a TOML file; raises `ConfigError` as `read_text`, and for invalid TOML."""
    text = read_text(path, field=field)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # for example brackets nested a thousand deep, numbers of 5000 digits
        raise ConfigError(field, str(path), f"TOML ({error})") from None


def shipped_toml(package: str, name: str) -> dict[str, Any]:
    """Read a TOML file that is shipped beside the modules of a package, such as ``garage2usd.assets``."""
    return tomllib.loads((resources.files(package) / f"{name}.toml").read_text(encoding="utf-8"))


def read_json(path: Path, *, field: str, max_bytes: int) -> Any:  # noqa: ANN401 - whatever JSON holds
    """Read a JSON file; raises `ConfigError` as `read_text`, and for invalid JSON, NaN and infinity included."""
    text = read_text(path, field=field, max_bytes=max_bytes)
    try:
        return json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError) as error:
        raise ConfigError(field, str(path), f"JSON ({error})") from None


def read_arrays(path: Path, *, field: str, names: Sequence[str]) -> dict[str, NDArray[Any]]:
    """Read arrays of numbers from a NumPy file, without unpickling.

    Parameters
    ----------
    path
        An ``.npy`` file, which holds the first of `names`, or an ``.npz`` file.
    field
        Name of the setting or argument, for the error.
    names
        Arrays to read from an ``.npz`` file; missing ones are skipped. If the file has only a single array, under any
        name, it counts as the first.

    Returns
    -------
    dict
        The arrays by name; the first one is always included.

    Raises
    ------
    ConfigError
        As `read_bytes`, and for a file in another format, without the first array, with data other than numbers, or
        with an array of more than 16 MB.
    """
    data = read_bytes(path, field=field)
    if path.suffix.lower() == ".npy":
        members = {names[0]: data}
    else:
        try:
            members = _members(data, names)
        except Exception as error:  # noqa: BLE001 - zipfile and its decompressors raise a dozen kinds for damaged files
            raise ConfigError(field, str(path), f"an .npz file ({error})") from None
    if names[0] not in members:
        raise ConfigError(field, str(path), f"an .npz file with the array {names[0]}, or with one array alone")
    arrays = {}
    for name, content in members.items():
        if len(content) > MAX_SETTINGS_BYTES:
            raise ConfigError(field, str(path), f"arrays of at most {MAX_SETTINGS_BYTES} bytes")
        try:
            arrays[name] = _array(content)
        except Exception as error:  # noqa: BLE001 - a header is a literal of Python, which fails in many ways
            raise ConfigError(field, str(path), f"an array of numbers in a file of NumPy ({error})") from None
    return arrays


def _members(data: bytes, names: Sequence[str]) -> dict[str, bytes]:
    """Leading bytes of the arrays of an .npz file, up to one byte beyond the size limit."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = {member.filename.removesuffix(".npy"): member for member in archive.infolist()}
        chosen = {name: members[name] for name in names if name in members}
        if not chosen and len(members) == 1:
            chosen = {names[0]: next(iter(members.values()))}
        found = {}
        for name, member in chosen.items():
            with archive.open(member) as file:
                found[name] = file.read(MAX_SETTINGS_BYTES + 1)
        return found


def _array(data: bytes) -> NDArray[Any]:
    """Parse the array of an .npy file, without allocating more than its actual size, whatever its header says.

    Raises
    ------
    ValueError
        If the header is invalid; other exceptions of NumPy are possible.
    """
    file = io.BytesIO(data)
    shape, is_by_columns, dtype = _HEADERS[npy_format.read_magic(file)](file)  # type: ignore[no-untyped-call]
    if dtype.kind not in "iuf":
        raise ValueError(f"it holds {dtype}")
    return np.frombuffer(file.read(), dtype).reshape(shape, order="F" if is_by_columns else "C")


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is not a number")


def short_json(value: object) -> str:
    """Format JSON without blanks, and with integral floats as integers: 2.0 as 2.

    Raises
    ------
    ValueError
        If a number is NaN or infinite, which JSON does not support.
    """
    text = json.dumps(value, separators=(",", ":"), allow_nan=False)
    return _STRING_OR_ZERO.sub(lambda found: found["string"] or "", text)


def json_text(document: Mapping[str, object]) -> str:
    """Format a JSON object with one line per key, per object of a list, and per list of an object; else compact."""
    return _in_lines(document, _inner) + "\n"


def _inner(value: object) -> str:
    match value:
        case [{}, *_]:
            return "[\n" + ",\n".join(map(short_json, value)) + "\n]"
        case dict() if any(isinstance(entry, list | tuple) for entry in value.values()):
            return _in_lines(value, short_json)
    return short_json(value)


def _in_lines(entries: Mapping[str, object], text: Callable[[object], str]) -> str:
    return "{\n" + ",\n".join(f"{short_json(key)}:{text(value)}" for key, value in entries.items()) + "\n}"
