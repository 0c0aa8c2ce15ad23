"""Shards of a data set: garages of one split, generated, packed and published together."""

import hashlib
import io
import secrets
import shutil
import tarfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from garage2usd.common.errors import MissingExtraError
from garage2usd.common.output import HIDDEN_PREFIX, store, writing
from garage2usd.common.randomness import Step, generator
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.manifest import ManifestRow, rows_of_text, text_of_rows
from garage2usd.datasets.plans import error_line, proportional
from garage2usd.datasets.recipe import ASSET_FOLDER, Recipe, ShardForm
from garage2usd.datasets.scene import make_scene

SHARD_FOLDER = "shards"
_SHARD_DIGITS = 6


@dataclass(frozen=True)
class Shard:
    """A shard: the garages of one file or folder.

    Attributes
    ----------
    name
        Split and number within the split, such as ``train-000003``.
    split
        Name of the split.
    plans
        Plans of its garages, ordered by number.
    """

    name: str
    split: str
    plans: tuple[DrawnPlan, ...]


def shards_of(recipe: Recipe, plans: Sequence[DrawnPlan]) -> list[Shard]:
    """Assign garages to splits by ratio and seed, and within splits to shards by number.

    Parameters
    ----------
    recipe
        Recipe with the ratios of splits, the seed, and the number of garages per shard.
    plans
        One plan per garage; plans with an error are left out.
    """
    good = [drawn for drawn in plans if not drawn.error]
    order = generator(recipe.seed, Step.SPLITS).permutation(len(good))
    shards = []
    first = 0
    for split, count in proportional(recipe.splits, len(good)).items():
        members = [good[number] for number in sorted(order[first : first + count].tolist())]
        first += count
        for number, start in enumerate(range(0, count, recipe.shards.garages)):
            part = tuple(members[start : start + recipe.shards.garages])
            shards.append(Shard(f"{split}-{number:0{_SHARD_DIGITS}}", split, part))
    return shards


def empty_splits(recipe: Recipe) -> list[str]:
    """Return the splits without garages, whose share rounds to none."""
    return [split for split, count in proportional(recipe.splits, recipe.count).items() if not count]


def make_shard(recipe: Recipe, folder: Path, shard: Shard) -> list[ManifestRow]:
    """Generate a shard's garages and publish them with their manifest rows.

    Parameters
    ----------
    recipe
        The recipe.
    folder
        Folder of the data set.
    shard
        Shard to generate.

    Returns
    -------
    list of ManifestRow
        Rows of the shard's garages; the row of a failed garage has its error.

    Raises
    ------
    OutputError
        If files cannot be written; no part of the shard remains.
    """
    is_tar = recipe.shards.form is ShardForm.TAR
    parent = folder / SHARD_FOLDER
    place = parent / f"{shard.name}.tar" if is_tar else parent / shard.name
    assets = None if recipe.make.self_contained else folder / ASSET_FOLDER
    with writing(place), _hidden_folder(parent) as staging:
        rows = [_row(recipe, drawn, staging, shard, assets) for drawn in shard.plans]
        if is_tar:
            packed = staging / f"{HIDDEN_PREFIX}{place.name}"
            _pack(packed, staging, rows)
            packed.replace(place)
        else:
            shutil.rmtree(place, ignore_errors=True)
            staging.rename(place)
        # the rows are published last, as a mark that the shard is complete
        store(parent / f"{shard.name}.jsonl", text_of_rows(rows).encode())
    return rows


def _row(recipe: Recipe, drawn: DrawnPlan, staging: Path, shard: Shard, assets: Path | None) -> ManifestRow:
    try:
        return make_scene(recipe, drawn, staging, split=shard.split, shard=shard.name, assets=assets)
    except (OSError, MissingExtraError):  # a failure of the machine, not of this garage
        raise
    except Exception as error:  # noqa: BLE001 - one garage that fails does not end ten thousand
        for path in staging.glob(f"{drawn.number:08}.*"):
            path.unlink()
        return failed_row(drawn, error_line(error), split=shard.split)


def failed_row(drawn: DrawnPlan, error: str, *, split: str = "") -> ManifestRow:
    """Return the manifest row of a failed garage."""
    return ManifestRow(
        number=drawn.number,
        key="",
        split=split,
        shard="",
        seed=drawn.seed,
        attempt=drawn.attempt,
        alternatives=drawn.alternatives,
        error=error,
    )


def made_rows(folder: Path, shard: Shard, form: ShardForm) -> list[ManifestRow] | None:
    """Read the rows of a complete and intact shard; None if the shard must be generated."""
    try:
        rows = rows_of_text((folder / SHARD_FOLDER / f"{shard.name}.jsonl").read_text(encoding="utf-8"))
    except (OSError, ValueError, KeyError):
        return None
    if [(row.number, row.seed) for row in rows] != [(drawn.number, drawn.seed) for drawn in shard.plans]:
        return None
    named = {f"{row.key}{file.suffix}": file.sha256 for row in rows for file in row.files}
    try:
        held = {
            f"{shard.name}/{name}": hashlib.sha256(data).hexdigest()
            for name, data in shard_members(folder, shard.name, form)
        }
    except (OSError, tarfile.TarError):
        return None
    return rows if held == named else None


def shard_members(folder: Path, name: str, form: ShardForm) -> Iterator[tuple[str, bytes]]:
    """Yield name and contents of each file of a shard; raises OSError or tarfile.TarError for a damaged shard."""
    if form is ShardForm.FOLDER:
        for path in sorted((folder / SHARD_FOLDER / name).iterdir()):
            yield path.name, path.read_bytes()
        return
    with tarfile.open(folder / SHARD_FOLDER / f"{name}.tar") as archive:
        for member in archive:
            held = archive.extractfile(member)
            yield member.name.rpartition("/")[2], held.read() if held else b""


def sweep(folder: Path) -> None:
    """Remove unfinished files of killed runs."""
    for path in (folder / SHARD_FOLDER).glob(f"{HIDDEN_PREFIX}*"):
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)


def _pack(path: Path, folder: Path, rows: Sequence[ManifestRow]) -> None:
    """Pack the files of garages in WebDataset's order, reproducibly."""
    with tarfile.open(path, "w", format=tarfile.USTAR_FORMAT) as archive:
        for row in rows:
            for file in row.files:
                name = f"{row.key}{file.suffix}"
                data = (folder / name.rpartition("/")[2]).read_bytes()
                entry = tarfile.TarInfo(name)
                entry.size = len(data)
                archive.addfile(entry, io.BytesIO(data))


@contextmanager
def _hidden_folder(place: Path) -> Iterator[Path]:
    """Yield a hidden temporary folder in `place`, removed afterwards unless renamed."""
    place.mkdir(parents=True, exist_ok=True)
    folder = place / f"{HIDDEN_PREFIX}{secrets.token_hex(8)}"
    folder.mkdir()
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
