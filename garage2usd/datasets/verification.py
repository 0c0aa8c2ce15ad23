"""Verification of a data set: file hashes, checks of stages, and comparison of plans."""

import hashlib
import tarfile
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from garage2usd.checks import Severity
from garage2usd.checks.safety import DEAD_LAMPS
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.common.output import staging_folder
from garage2usd.common.progress import Progress, silent
from garage2usd.common.system import link_folder
from garage2usd.config import GarageConfig
from garage2usd.datasets.card import SUMS_FILE, files_of, read_sums, sha256_of
from garage2usd.datasets.drawn_plan import DrawnPlan, plans_of
from garage2usd.datasets.making import LINES_FILE, PLAN_FILE, TABLE_FILE
from garage2usd.datasets.manifest import MANIFEST_SCHEMA, ManifestRow, rows_of_table, rows_of_text
from garage2usd.datasets.recipe import ASSET_FOLDER, RECIPE_FILE, Distinct, Recipe, load_recipe
from garage2usd.datasets.shards import SHARD_FOLDER, shard_members
from garage2usd.garage_sources import check
from garage2usd.maps.track_tables import read_tracks
from garage2usd.structure.symmetry import levels_digest

_STAGES = (".usdc", ".usdz")
_LIGHTING = frozenset({"lane-illuminance", "stall-illuminance"})
"""Rules that dead lamps of a look violate, which the build reports and the data set asks for."""


@dataclass(frozen=True, order=True)
class Fault:
    """A fault of a data set with its place: a file, or a garage's key."""

    place: str
    what: str


def verify_dataset(
    folder: str | Path,
    *,
    worker_count: int | None = None,
    scheduler: str | None = None,
    progress: Progress = silent,
) -> list[Fault]:
    """Verify a data set and list its faults.

    Faults are missing or changed files, stages that do not open or have errors by `garage2usd check`, rows that
    contradict files, and duplicate plans.

    Parameters
    ----------
    folder
        The data set, which is not changed.
    worker_count, scheduler, progress
        As for `garage2usd.datasets.make_dataset`.

    Returns
    -------
    list of Fault
        Faults sorted by place; empty if there are none.

    Raises
    ------
    ConfigError
        If the folder does not hold a finished data set.
    """
    folder = Path(folder).absolute()
    if not (folder / RECIPE_FILE).is_file():
        raise ConfigError("verify", str(folder), "the folder of a data set")
    if not (folder / SUMS_FILE).is_file():
        raise ConfigError("verify", str(folder), "a data set that is finished; --resume finishes this one")
    faults = list(_of_files(folder))
    try:
        recipe = load_recipe(folder / RECIPE_FILE)
        rows = _rows(folder)
        plans = plans_of(pq.read_table(folder / PLAN_FILE))
    except (OSError, ValueError, KeyError, pa.ArrowException, Garage2UsdError) as error:
        unread = Fault("manifest", "cannot be read, so that garages were not looked at")
        return sorted({*faults, unread, Fault("manifest", " ".join(str(error).split()))})
    faults += _of_rows(folder, rows)
    faults += _of_plans(recipe, rows, plans)
    made = [row for row in rows if not row.error]
    shards = sorted({row.shard for row in made})
    tasks = [_Task(name, tuple(row for row in made if row.shard == name)) for name in shards]
    from garage2usd.datasets.cluster import workers  # noqa: PLC0415 - refusals need no Dask

    with workers(count=worker_count, scheduler=scheduler) as pool:
        for number, (_, found) in enumerate(pool.each(_of_shard, tasks, folder, recipe), 1):
            faults += found
            progress("shards", number, len(shards))
    return sorted(set(faults))


@dataclass(frozen=True)
class _Task:
    """A shard to verify, with the rows of its garages."""

    shard: str
    rows: tuple[ManifestRow, ...]


def _of_files(folder: Path) -> Iterator[Fault]:
    """Yield faults of files: missing, modified or unexpected ones."""
    try:
        sums = read_sums(folder)
    except ValueError as error:
        yield Fault(SUMS_FILE, str(error))
        return
    there = set(files_of(folder))
    for name, digest in sums.items():
        if name not in there:
            yield Fault(name, "is missing")
        elif sha256_of(folder / name) != digest:
            yield Fault(name, "is not as it was made: its SHA-256 is another")
    for name in sorted(there - set(sums)):
        yield Fault(name, "is not of this data set")


def _rows(folder: Path) -> list[ManifestRow]:
    table = pq.read_table(folder / TABLE_FILE)
    if not table.schema.equals(MANIFEST_SCHEMA):
        raise ValueError(f"{TABLE_FILE} has other columns than manifests have")
    return rows_of_table(table)


def _of_rows(folder: Path, rows: Sequence[ManifestRow]) -> Iterator[Fault]:
    """Yield contradictions between manifests."""
    by_number = {row.number: row for row in rows}
    texts = [LINES_FILE, *(f"{SHARD_FOLDER}/{name}.jsonl" for name in sorted({row.shard for row in rows if row.shard}))]
    for name in texts:
        try:
            others = rows_of_text((folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError, KeyError) as error:
            yield Fault(name, f"cannot be read ({error})")
            continue
        wrong = [other.number for other in others if by_number.get(other.number) != other]
        if wrong:
            yield Fault(name, f"says of garage {wrong[0]} what {TABLE_FILE} does not say")


def _of_plans(recipe: Recipe, rows: Sequence[ManifestRow], plans: Sequence[DrawnPlan]) -> Iterator[Fault]:
    """Yield duplicate plans, and plans that contradict their rows."""
    by_number = {drawn.number: drawn for drawn in plans}
    same: dict[str, list[ManifestRow]] = defaultdict(list)
    for row in rows:
        if row.error:
            continue
        drawn = by_number.get(row.number)
        digest = levels_digest(drawn.levels_cells()) if drawn and not drawn.error else ""
        if digest != row.plan_digest:
            yield Fault(row.key, f"has another plan in {PLAN_FILE}")
        same[digest].append(row)
    if recipe.distinct is Distinct.PLAN:
        for group in same.values():
            first, *others = group
            for other in others:
                where = "the same split" if other.split == first.split else f"{first.split} and {other.split}"
                yield Fault(other.key, f"has the plan of {first.key}: {where}")


def _of_shard(folder: Path, recipe: Recipe, task: _Task) -> list[Fault]:
    """List the faults of a shard's garages."""
    return list(_faults_of_shard(folder, recipe, task))


def _faults_of_shard(folder: Path, recipe: Recipe, task: _Task) -> Iterator[Fault]:
    expected = {f"{row.key}{file.suffix}": file.sha256 for row in task.rows for file in row.files}
    with staging_folder(folder) as staging:
        if (folder / ASSET_FOLDER).is_dir():
            link_folder(staging / ASSET_FOLDER, folder / ASSET_FOLDER)
        unpacked = staging / SHARD_FOLDER / task.shard
        unpacked.mkdir(parents=True)
        held = set()
        try:
            for name, data in shard_members(folder, task.shard, recipe.shards.form):
                path = f"{task.shard}/{name}"
                held.add(path)
                if hashlib.sha256(data).hexdigest() != expected.get(path):
                    yield Fault(path, "is not as it was made: its SHA-256 is another")
                (unpacked / name).write_bytes(data)
        except (OSError, tarfile.TarError) as error:
            yield Fault(f"{SHARD_FOLDER}/{task.shard}", f"cannot be read ({error})")
        for path in sorted(set(expected) - held):
            yield Fault(path, "is missing in its shard")
        for row in task.rows:
            for suffix in _STAGES:
                stage = staging / SHARD_FOLDER / f"{row.key}{suffix}"
                if stage.is_file():
                    yield from _of_tracks(stage, row)
                    yield from _of_stage(stage, row.key, recipe.drawn(row.seed, row.number)[0])


def _of_tracks(stage: Path, row: ManifestRow) -> Iterator[Fault]:
    """Yield faults of a garage's table of tracks, where there is one."""
    table = stage.with_name(f"{stage.stem}.tracks.parquet")
    if not table.is_file():
        return
    try:
        facts = read_tracks(table).facts
    except Garage2UsdError as error:
        yield Fault(row.key, f"its tracks cannot be read: {getattr(error, 'reason', error)}")
        return
    if (facts.get("arrivals"), facts.get("departures")) != (row.arrivals, row.departures):
        yield Fault(row.key, "its tracks have other arrivals and departures than its row")


def _of_stage(stage: Path, key: str, config: GarageConfig) -> Iterator[Fault]:
    profile = config.standard
    excused = _LIGHTING if config.look.may_be_dim else frozenset()
    try:
        findings, _ = check(stage, profile=profile)
    except Garage2UsdError as error:
        yield Fault(key, f"its stage does not open: {getattr(error, 'reason', error)}")
        return
    for finding in findings:
        if finding.severity is Severity.ERROR and not (finding.rule in excused and DEAD_LAMPS in finding.message):
            yield Fault(key, f"{finding.rule} by {profile.name}: {finding.place} {finding.message}")
