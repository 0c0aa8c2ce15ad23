"""Generation of a data set: plans, shards, then manifest and page; resumable after interruption."""

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import pyarrow as pa
import pyarrow.parquet as pq

from garage2usd.common.errors import ConfigError
from garage2usd.common.output import HIDDEN_PREFIX, check_writable, only_run, store, writing
from garage2usd.common.package import VERSION
from garage2usd.common.progress import Progress, silent
from garage2usd.datasets.card import SUMS_FILE, damaged_assets, data_card, read_sums, sha256_of, sums_text
from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.drawn_plan import DrawnPlan, contour_shape, plan_table, plans_of
from garage2usd.datasets.drives import check_drives
from garage2usd.datasets.manifest import ManifestRow, manifest_table, table_bytes, text_of_rows
from garage2usd.datasets.plans import PlanDraw, chunks, landings_of, planned
from garage2usd.datasets.recipe import RECIPE_FILE, Recipe
from garage2usd.datasets.shards import Shard, failed_row, made_rows, make_shard, shards_of, sweep
from garage2usd.datasets.variety import PlanFigures
from garage2usd.exports import check_formats
from garage2usd.track_forms import require_form

if TYPE_CHECKING:
    from garage2usd.datasets.cluster import Workers

PLAN_FILE, TABLE_FILE, LINES_FILE, CARD_FILE = "plans.parquet", "manifest.parquet", "manifest.jsonl", "README.md"
PAGE_FILE = "variety.html"
_JOURNAL = f"{HIDDEN_PREFIX}plans.jsonl"


@dataclass(frozen=True)
class DataSet:
    """A generated data set.

    Attributes
    ----------
    folder
        Folder of the data set.
    rows
        One row per garage, by number; failed garages have an error.
    splits
        Names of all splits, including empty ones.
    """

    folder: Path
    rows: tuple[ManifestRow, ...]
    splits: tuple[str, ...]

    @property
    def failed(self) -> tuple[ManifestRow, ...]:
        """Rows of the garages that failed."""
        return tuple(row for row in self.rows if row.error)

    def counts(self) -> dict[str, int]:
        """Count the garages of each split, in the recipe's order."""
        counted = Counter(row.split for row in self.rows if not row.error)
        return {split: counted[split] for split in self.splits}


def make_dataset(
    recipe: Recipe,
    folder: str | Path,
    *,
    worker_count: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    progress: Progress = silent,
) -> DataSet:
    """Generate the data set of a recipe with many processes.

    The result is reproducible byte for byte, independent of the number of workers and of interruptions.

    Parameters
    ----------
    recipe
        The recipe.
    folder
        A new or empty folder; with `resume` the folder of an interrupted run of this recipe, or of a finished one,
        whose damaged files are made again.
    worker_count
        Number of local processes; one per core if left out.
    scheduler
        Address of a Dask scheduler whose workers do the work instead; they see the folder under the same path.
    resume
        True to continue a previous run of this recipe.
    progress
        Called with the number of planned, then of generated garages.

    Raises
    ------
    ConfigError
        If the folder has other contents, every garage of the recipe is infeasible, or the scheduler cannot be used.
    MissingExtraError
        If a package that records drives or writes maps is not installed.
    OutputError
        If files cannot be written, for example to a full disk; finished shards are kept for `resume`.
    """
    folder = Path(folder).absolute()
    recipe.check()
    if recipe.make.drives:
        check_drives(recipe.make.drives)
    for form in recipe.make.traffic.forms if recipe.make.traffic else ():
        require_form(f".{form}")
    check_formats(f".{name}" for name in recipe.make.exports)
    check_writable(folder)
    _check_folder(recipe, folder, resume=resume)
    from garage2usd.datasets.cluster import workers  # noqa: PLC0415 - refusals need no Dask

    with workers(count=worker_count, scheduler=scheduler) as pool:
        with writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
        with only_run(folder):
            _check_folder(recipe, folder, resume=resume)  # again: another run may have started here meanwhile
            store(folder / RECIPE_FILE, recipe.record().encode())
            sweep(folder)
            return _make(recipe, folder, pool, progress)


def _make(recipe: Recipe, folder: Path, pool: "Workers", progress: Progress) -> DataSet:
    plans = _plans(recipe, folder, pool, progress)
    shards = shards_of(recipe, plans)
    rows = _made(recipe, folder, pool, shards, progress)
    rows += [failed_row(drawn, drawn.error) for drawn in plans if drawn.error]
    rows.sort(key=lambda row: row.number)
    sweep(folder)  # unfinished files of killed workers
    with writing(folder):
        _finish(recipe, folder, plans, rows)
    return DataSet(folder, tuple(rows), tuple(recipe.splits))


def _check_folder(recipe: Recipe, folder: Path, *, resume: bool) -> None:
    """Check that a folder is new or empty, or holds this recipe's data set for a resumed run."""
    note = folder / RECIPE_FILE
    with writing(folder):
        there = folder.iterdir() if folder.exists() else ()
        if all(path.name.startswith(HIDDEN_PREFIX) for path in there):
            return
        known = note.read_text(encoding="utf-8") if note.is_file() else ""
    if known != recipe.record():
        held = "the data set of another recipe or version" if known else "other files"
        raise ConfigError("output", str(folder), f"a new or empty folder, as this one holds {held}")
    if not resume:
        raise ConfigError("output", str(folder), "a new or empty folder, or resume, as this recipe was begun there")


def _plans(recipe: Recipe, folder: Path, pool: "Workers", progress: Progress) -> list[DrawnPlan]:
    """Draw or read the plan of each garage of the data set."""
    file, journal = folder / PLAN_FILE, folder / _JOURNAL
    with suppress(OSError, ValueError, pa.ArrowException):
        if read_sums(folder).get(PLAN_FILE, known := sha256_of(file)) != known:
            raise ValueError(f"{PLAN_FILE} was damaged")
        plans = plans_of(pq.read_table(file))
        if [drawn.number for drawn in plans] == list(range(recipe.count)):
            return plans
    draw = PlanDraw(recipe, _journalled(journal))
    with writing(file), journal.open("a", encoding="utf-8", newline="\n") as lines:
        while requests := draw.missing():
            left = len(requests)
            progress("plans", recipe.count - left, recipe.count)
            for part, made in pool.each(planned, chunks(requests), recipe):
                draw.add(made)
                lines.write("".join(f"{drawn.model_dump_json()}\n" for drawn in made))
                lines.flush()
                left -= len(part)
                progress("plans", recipe.count - left, recipe.count)
    plans = draw.plans()
    store(file, table_bytes(plan_table(plans)))
    return plans


def _journalled(journal: Path) -> Iterator[DrawnPlan]:
    """Yield the plans in an interrupted run's journal, without an incomplete last line."""
    if not journal.is_file():
        return
    for line in journal.read_text(encoding="utf-8", errors="replace").splitlines():
        with suppress(ValueError):
            yield DrawnPlan.model_validate_json(line)


def _made(
    recipe: Recipe, folder: Path, pool: "Workers", shards: Sequence[Shard], progress: Progress
) -> list[ManifestRow]:
    """Generate missing or incomplete shards, and return the rows of all planned garages."""
    total = sum(len(shard.plans) for shard in shards)
    rows: dict[str, list[ManifestRow]] = {}
    for shard in shards:
        there = made_rows(folder, shard, recipe.shards.form)
        if there is not None:
            rows[shard.name] = there
    done = sum(map(len, rows.values()))
    progress("garages", done, total)
    damaged = damaged_assets(folder)
    missing = [shard for shard in shards if shard.name not in rows]
    for shard, made in _each(recipe, folder, pool, missing):
        rows[shard.name] = made
        done += len(made)
        progress("garages", done, total)
    # damaged assets are made again together with the garages that refer to them
    for shard in shards:
        if all((folder / name).exists() for name in damaged):
            break
        for _ in _each(recipe, folder, pool, [shard]):
            pass
    return [row for made in rows.values() for row in made]


def _each(
    recipe: Recipe, folder: Path, pool: "Workers", shards: Sequence[Shard]
) -> Iterator[tuple[Shard, list[ManifestRow]]]:
    return pool.each(make_shard, shards, recipe, folder)


def _plan_figures(row: ManifestRow, drawn: DrawnPlan, recipe: Recipe) -> PlanFigures:
    cells = drawn.structure.cells
    return PlanFigures(
        key=f"{row.number:08}",
        split=row.split,
        cells=cells,
        stalls=row.stalls,
        loops=row.loops,
        longest_dead_end_m=row.longest_dead_end_m,
        area_per_stall_m2=row.area_per_stall_m2,
        gross_area_per_stall_m2=row.gross_area_per_stall_m2,
        contour=contour_shape(cells),
        level=Level(row.difficulty) if row.difficulty else None,
        levels=row.levels,
        of_levels=drawn.digest,
        landings=landings_of(drawn, recipe),
    )


def _finish(recipe: Recipe, folder: Path, plans: Sequence[DrawnPlan], rows: Sequence[ManifestRow]) -> None:
    """Write manifest, card and page of the data set; the checksums come last, as a mark of completion."""
    from garage2usd.contact_sheet import SHEET_SUFFIXES  # noqa: PLC0415 - refusals need no USD
    from garage2usd.datasets.page import write_page  # noqa: PLC0415 - nor Matplotlib

    store(folder / PLAN_FILE, table_bytes(plan_table(plans)))
    store(folder / TABLE_FILE, table_bytes(manifest_table(rows)))
    store(folder / LINES_FILE, text_of_rows(rows).encode())
    splits = list(recipe.splits)
    figures = [_plan_figures(row, drawn, recipe) for row, drawn in zip(rows, plans, strict=True) if not row.error]
    page = folder / f"{HIDDEN_PREFIX}{PAGE_FILE}"
    with writing(folder / PAGE_FILE):
        write_page(
            page,
            sorted(figures, key=lambda plan: splits.index(plan.split)),
            title=recipe.name,
            sheets=sorted(path for suffix in SHEET_SUFFIXES for path in folder.glob(f"*{suffix}")),
            facts={"recipe": RECIPE_FILE, "seed": str(recipe.seed), "garage2usd": VERSION},
        )
        page.replace(folder / PAGE_FILE)
    store(folder / CARD_FILE, data_card(recipe, rows).encode())
    store(folder / SUMS_FILE, sums_text(folder).encode())
    with suppress(FileNotFoundError):
        (folder / _JOURNAL).unlink()
