"""The data card and the checksums of a data set: a README of its contents, origin and use, and SHA-256 sums."""

import hashlib
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import jinja2

from garage2usd.common.output import HIDDEN_PREFIX
from garage2usd.common.package import VERSION
from garage2usd.datasets.manifest import ManifestRow
from garage2usd.datasets.recipe import ASSET_FOLDER, Recipe, ShardForm

_TEMPLATE = jinja2.Template(
    Path(__file__).with_name("card.md.jinja").read_text(encoding="utf-8"),
    keep_trailing_newline=True,
    autoescape=False,
)
SUMS_FILE = "SHA256SUMS"
_LINE = re.compile(r"([0-9a-f]{64})  (.+)")
_NAMED = re.compile(r".*_([0-9a-f]{16})\.[a-z]+")


def data_card(recipe: Recipe, rows: Sequence[ManifestRow]) -> str:
    """Write the data card of a data set in Markdown."""
    made = [row for row in rows if not row.error]
    splits = [
        {
            "name": split,
            "garages": sum(row.split == split for row in made),
            "stalls": sum(row.stalls for row in made if row.split == split),
            "cars": sum(row.cars for row in made if row.split == split),
            "shards": len({row.shard for row in made if row.split == split}),
        }
        for split in recipe.splits
    ]
    suffixes = Counter(file.suffix for row in made for file in row.files)
    first = next((row for row in made), None)
    text: str = _TEMPLATE.render(
        recipe=recipe,
        version=VERSION,
        rows=made,
        stalls=sum(row.stalls for row in made),
        failed=len(rows) - len(made),
        splits=splits,
        is_tar=recipe.shards.form is ShardForm.TAR,
        suffixes=sorted(suffixes),
        example=first,
        stage_suffix=".usdz" if recipe.make.self_contained else ".usdc",
    )
    return text


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
