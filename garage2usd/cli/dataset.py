"""The commands ``garage2usd dataset`` and ``garage2usd compare``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, echo_notices, echo_table, like_option, output_option
from garage2usd.common.errors import DataSetError

if TYPE_CHECKING:
    from garage2usd.datasets.comparison import Compared

_TABLE = ".json"
_HEADS = ("quantity", "published", "data set", "distance")


@click.command(short_help="Make a data set of many garages, or verify one.")
@click.argument("recipe", required=False, type=INPUT_FILE)
@like_option
@output_option("Where the data set goes.", metavar="FOLDER", file_okay=False)
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
    like: str | None,
    output: Path | None,
    count: int | None,
    workers: int | None,
    scheduler: str | None,
    self_contained: bool,
    resume: bool,
    verify: Path | None,
) -> None:
    """Generate the distinct garages of RECIPE (TOML), or some --like a usual garage, with a manifest and a data card.

    Plans are drawn first; a duplicate, also a rotated or reflected one, is drawn again. The command can be interrupted
    at any time and resumed by --resume. The same recipe gives the same bytes with any number of workers.

    \b
    Examples:
      garage2usd dataset samples/recipes/mixed.toml -o garages --count 1000
      garage2usd dataset --like mall-cn --count 20 -o malls
      garage2usd dataset --verify garages
    """  # noqa: D301 - click's mark for a block that is not wrapped
    if verify is not None:
        if recipe is not None or like is not None or output is not None:
            raise click.UsageError("Give --verify FOLDER alone, without a RECIPE, --like and --output.")
        _verify(verify, workers=workers, scheduler=scheduler)
        return
    if (recipe is None) is (like is None) or output is None:
        raise click.UsageError("Give a RECIPE or --like NAME, and --output FOLDER; or --verify FOLDER.")
    from garage2usd.datasets import load_recipe, make_dataset  # noqa: PLC0415 - keeps --help instant
    from garage2usd.datasets.recipe import folder_remarks, recipe_like  # noqa: PLC0415
    from garage2usd.datasets.shards import empty_splits  # noqa: PLC0415

    asked = load_recipe(recipe) if recipe else recipe_like(like or "")
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


@click.command(short_help="Compare a data set with published figures of real garages.")
@click.argument("folder", type=click.Path(path_type=Path))
@click.option(
    "--figures",
    metavar="FILE",
    type=INPUT_FILE,
    help="Published figures (TOML) to compare with.  [default: those of the package]",
)
@output_option("The comparison as a table (.json) or a picture (.png, .svg); may be repeated.", several=True)
def compare(*, folder: Path, figures: Path | None, outputs: tuple[Path, ...]) -> None:
    """Compare the data set in FOLDER with published figures of real garages.

    Each line has a quantity, its published figure, that of the data set, and the distance between both: the
    Kolmogorov-Smirnov distance of a distribution, of which the median is printed; the greatest difference of a share in
    points; or the greater share of garages on one side of a range. Figures that are assumed, at least in part, are
    marked by an asterisk. The JSON table has the sources.

    \b
    Examples:
      garage2usd compare garages
      garage2usd compare garages -o world.json -o world.png
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.errors import ConfigError  # noqa: PLC0415 - keeps --help instant
    from garage2usd.common.output import check_file, drafting, publish_at, staging_folder  # noqa: PLC0415
    from garage2usd.datasets import compare_dataset, read_published  # noqa: PLC0415
    from garage2usd.datasets.comparison_picture import PICTURE_SUFFIXES, draw_comparison  # noqa: PLC0415

    allowed = (_TABLE, *PICTURE_SUFFIXES)
    for output in outputs:
        if output.suffix.lower() not in allowed or not output.stem:
            raise ConfigError("output", str(output), f"a path that ends in {', '.join(allowed)}")
        check_file(output)
    made = compare_dataset(folder, None if figures is None else read_published(figures))
    if outputs:
        with staging_folder(outputs[0]) as staging:
            places = {staging / f"{number}{output.suffix.lower()}": output for number, output in enumerate(outputs)}
            for file, output in places.items():
                with drafting(output):
                    if file.suffix == _TABLE:
                        file.write_text(made.text(), encoding="utf-8", newline="\n")
                    else:
                        draw_comparison(made, file)
            publish_at(places)
    rows = [_HEADS, *(_row(compared) for compared in made.quantities)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(_HEADS))]
    for row in rows:
        first, *others = (text.ljust(width) for text, width in zip(row, widths, strict=True))
        click.echo("  ".join([first, *others]).rstrip())
    click.echo(f"{made.garages} garages; * a figure that is assumed, at least in part")


def _row(compared: "Compared") -> tuple[str, str, str, str]:
    figure, distance = compared.published, compared.distance
    title = f"{figure.title}{', ' * bool(figure.unit)}{figure.unit}{' *' * bool(figure.assumption)}"
    if compared.is_of_shares:
        published, measured = _shares(figure.shares or {}), _shares(compared.shares)
        far = "" if distance is None else f"{distance:.1f} points"
    else:
        middle = None if figure.distribution is None else figure.distribution.quantile(0.5)
        between = figure.between
        published = _number(middle) if between is None else f"{between.low:g} to {between.high:g}"
        measured = _number(compared.quantile(0.5))
        far = "" if distance is None else f"{distance:.3f}"
    return title, published, measured or "no data", far


def _shares(shares: dict[str, float]) -> str:
    """Format shares in per cent, in the order of the categories; of two the first alone."""
    told = list(shares.values())
    first = told[:1] if len(told) == 2 else told  # noqa: PLR2004
    return " / ".join(f"{100 * share:.1f}" for share in first) + (" %" if told else "")


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.4g}"
