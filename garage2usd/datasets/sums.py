"""SHA-256 checksums of a data set's files, in the format of ``sha256sum``."""

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

from garage2usd.common.output import HIDDEN_PREFIX
from garage2usd.datasets.recipe import ASSET_FOLDER

__all__ = ["SUMS_FILE", "damaged_assets", "files_of", "read_sums", "sha256_of", "sums_text"]

SUMS_FILE = "SHA256SUMS"
_LINE = re.compile(r"([0-9a-f]{64})  (.+)")
_NAMED = re.compile(r".*_([0-9a-f]{16})\.[a-z]+")


def sums_text(folder: Path) -> str:
    """Format a checksum line for each file of a data set: SHA-256, two blanks, and path with slashes."""
    return "".join(f"{sha256_of(folder / name)}  {name}\n" for name in files_of(folder))


def read_sums(folder: Path) -> dict[str, str]:
    """Read the checksums of a data set by path; empty if it has none.

    Raises
    ------
    ValueError
        If a line is damaged.
    """
    file = folder / SUMS_FILE
    if not file.exists():
        return {}
    sums = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        found = _LINE.fullmatch(line)
        if found is None:
            raise ValueError(f"no SHA-256 and name: {line[:80]}")
        sums[found[2]] = found[1]
    return sums


def files_of(folder: Path) -> Iterator[str]:
    """Yield the paths of a data set's files, sorted, without checksums and unfinished files."""
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and name != SUMS_FILE and HIDDEN_PREFIX not in name:
            yield name


def sha256_of(path: Path) -> str:
    """Compute the SHA-256 of a file in hexadecimal."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def damaged_assets(folder: Path) -> list[str]:
    """Find missing and corrupt assets of a data set, and remove the corrupt ones."""
    try:
        listed = {name for name in read_sums(folder) if name.startswith(f"{ASSET_FOLDER}/")}
    except (OSError, ValueError):
        listed = set()
    there = {path.relative_to(folder).as_posix(): path for path in (folder / ASSET_FOLDER).rglob("*") if path.is_file()}
    damaged = sorted(listed - set(there))
    for name, path in sorted(there.items()):
        said = _NAMED.fullmatch(path.name)
        if said is None or not sha256_of(path).startswith(said[1]):
            path.unlink()
            damaged.append(name)
    return damaged
