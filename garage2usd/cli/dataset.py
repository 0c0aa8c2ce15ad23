"""The command ``garage2usd dataset``."""

import sys
from pathlib import Path

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.parameters import INPUT_FILE, echo_notices, echo_table
from garage2usd.common.errors import DataSetError

__all__ = ["dataset"]


@click.command(short_help="Make a data set of many garages, or verify one.")
@click.argument("recipe", required=False, type=INPUT_FILE)
@click.option(
    "--output",
    "-o",
    metavar="FOLDER",
    type=click.Path(file_okay=False, path_type=Path),
    help="Where the data set goes.",
)
@click.option("--count", metavar="N", type=click.IntRange(1), help="How many garages, in place of the recipe's count.")
@click.option(
    "--workers", metavar="N", type=click.IntRange(1, 4096), help="How many processes work on it here; one a core."
)
@click.option(
    "--scheduler", metavar="ADDRESS", help="The Dask scheduler of a cluster that works on it instead: tcp://host:8786."
)
@click.option("--self-contained", is_flag=True, help="Make each stage a .usdz with its assets.")
@click.option(
    "--resume", is_flag=True, help="Go on where a run of this recipe was interrupted, or repair its data set."
)
@click.option(
    "--verify",
    metavar="FOLDER",
    type=click.Path(file_okay=False, path_type=Path),
    help="Say what is wrong with a data set.",
)
def dataset(
    *,
    recipe: Path | None,
    output: Path | None,
    count: int | None,
    workers: int | None,
    scheduler: str | None,
    self_contained: bool,
    resume: bool,
    verify: Path | None,
) -> None:
    """Generate the distinct garages of RECIPE (TOML), with a manifest and a data card.

    Plans are drawn first; a duplicate, also a rotated or reflected one, is drawn again. The command can be interrupted
    at any time and resumed by --resume. The same recipe gives the same bytes with any number of workers.

    \b
    Examples:
      garage2usd dataset samples/recipes/mixed.toml -o garages --count 1000
      garage2usd dataset --verify garages
    """  # noqa: D301 - click's mark for a block that is not wrapped
    if verify is not None:
        if recipe is not None or output is not None:
            raise click.UsageError("Give --verify FOLDER alone, without a RECIPE and --output.")
        _verify(verify, workers=workers, scheduler=scheduler)
        return
    if recipe is None or output is None:
        raise click.UsageError("Give a RECIPE and --output FOLDER, or --verify FOLDER.")
    from garage2usd.datasets import load_recipe, make_dataset  # noqa: PLC0415 - keeps --help instant
    from garage2usd.datasets.recipe import folder_remarks  # noqa: PLC0415
    from garage2usd.datasets.shards import empty_splits  # noqa: PLC0415

    asked = load_recipe(recipe)
    changed = asked.model_copy(
        update={
            **({} if count is None else {"count": count}),
            **({"make": asked.make.model_copy(update={"self_contained": True})} if self_contained else {}),
        }
    )
    for split in empty_splits(changed):
        share = changed.splits[split] / sum(changed.splits.values()) * changed.count
        click.echo(f"{split} gets none of the {changed.count} garages: its share is {share:.2g}", err=True)
    echo_notices(folder_remarks(changed))
    with Bars(sys.stderr, unit="garages") as progress:
        made = make_dataset(
            changed, output, worker_count=workers, scheduler=scheduler, resume=resume, progress=progress
        )
    echo_table((split, f"{garages} garages") for split, garages in made.counts().items())
    echo_table([("failed", str(len(made.failed))), ("data set", f"{made.folder}/")])
    if made.failed:
        first = made.failed[0]
        raise DataSetError(
            made.folder, f"{len(made.failed)} garages failed, the first with seed {first.seed}: {first.error}"
        )


def _verify(folder: Path, *, workers: int | None, scheduler: str | None) -> None:
    from garage2usd.datasets import verify_dataset  # noqa: PLC0415 - keeps --help instant

    with Bars(sys.stderr, unit="shards") as progress:
        faults = verify_dataset(folder, worker_count=workers, scheduler=scheduler, progress=progress)
    for fault in faults:
        click.echo(f"{fault.place}: {fault.what}")
    if faults:
        raise DataSetError(folder, f"{len(faults)} faults were found")
    click.echo(f"Nothing is wrong with {folder}")
