"""The command ``garage2usd traffic``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE
from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import counted

if TYPE_CHECKING:
    from garage2usd.driving.tracks import Tracks

_SUFFIXES = ".parquet, .csv, .usda, .usdc, .xosc, .fcd.xml, .mcap, .pkl"
_SHOWN = 8


@click.command(short_help="Operate a garage: cars arrive, park and leave, people walk.")
@click.argument("path", type=INPUT_FILE)
@click.option("--minutes", type=float, metavar="MINUTES", help="Duration; 25 unless the settings say otherwise.")
@click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True, help="Seed of the run.")
@click.option("--hour", type=float, metavar="HOUR", help="Hour of the day at the start, 0 to 24.")
@click.option(
    "--arrivals-per-hour", type=float, metavar="NUMBER", help="Mean number of cars that arrive in an hour, and leave."
)
@click.option("--people/--no-people", default=None, help="Let people walk between their cars and the stair cores.")
@click.option(
    "--output",
    "-o",
    "outputs",
    metavar="FILE",
    type=click.Path(path_type=Path),
    multiple=True,
    help=f"Write the tracks; the form follows from the name: {_SUFFIXES}. May be given several times.",
)
@click.option(
    "--tracks",
    metavar="FILE",
    type=INPUT_FILE,
    help="Take these tracks (.parquet, .csv) of the garage instead of operating it.",
)
@click.option(
    "--predictions",
    metavar="FILE|FOLDER",
    type=click.Path(path_type=Path),
    help="Write prediction tasks, of 2 s of past and 6 s of future: a table (.parquet), or a folder of ScenarioNet.",
)
def traffic(
    *,
    path: Path,
    minutes: float | None,
    seed: int,
    hour: float | None,
    arrivals_per_hour: float | None,
    people: bool | None,
    tracks: Path | None,
    predictions: Path | None,
    outputs: tuple[Path, ...],
) -> None:
    """Operate a garage for some minutes: cars arrive, look for a stall, park, stay and leave; people walk.

    PATH is a stage, the report of a build, or a configuration with a structure. Arrivals are a Poisson process whose
    rate follows the occupancy by hour of the day. Cars keep to their side of two-way aisles, drive only over ground
    that they have reserved, and wait where they block nobody, so that no two touch. At junctions they yield by the
    country's rule. The settings are those of `[traffic]`, among them the shares of cars that wait for a stall,
    double-park or use an accessible stall, of cars with passengers, of children who run and of shopping trolleys.

    \b
    Examples:
      garage2usd traffic garage.usdz
      garage2usd traffic garage.usdz --minutes 25 --seed 7 -o tracks.parquet
      garage2usd traffic garage.usdz --hour 17.5 -o traffic.usdc -o traffic.xosc
      garage2usd traffic garage.usdz --tracks tracks.parquet --predictions tasks.parquet
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.common.settings import validated  # noqa: PLC0415 - keeps --help instant
    from garage2usd.config.traffic import TrafficConfig  # noqa: PLC0415
    from garage2usd.garage_sources import read_built  # noqa: PLC0415
    from garage2usd.track_forms import check_tracks_file, write_predictions, write_tracks  # noqa: PLC0415
    from garage2usd.traffic import Operation  # noqa: PLC0415

    for output in outputs:
        check_tracks_file(output)
    given = {"minutes": minutes, "hour": hour, "arrivals_per_hour": arrivals_per_hour, "people": people}
    asked = {name: value for name, value in given.items() if value is not None}
    if tracks is not None and asked:
        name, value = next(iter(asked.items()))
        raise ConfigError(name.replace("_", "-"), value, "only without --tracks")
    with Bars(sys.stderr) as progress:
        source = read_built(path, progress=progress)
        if tracks is not None:
            from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - of an extra

            run = read_tracks(tracks)
        else:
            settings = validated(TrafficConfig, {**source.traffic.model_dump(), **asked}, within="traffic")
            run = Operation(source.garage, progress=progress).run(settings, seed=seed, progress=progress)
        for output in counted("files", outputs, len(outputs), progress):
            write_tracks(output, run, source.garage)
    if predictions is not None:
        count = write_predictions(predictions, run, source.garage)
        click.echo(f"{count:>6}  prediction tasks")
    _tell(run)


def _tell(run: "Tracks") -> None:
    """Print the counts of a run and what it has to say."""
    facts = run.facts
    if "arrivals" in facts:
        click.echo(
            f"{facts['arrivals']:>6}  cars arrive, {facts['departures']} leave, {facts['turned_away']} find no stall"
        )
        click.echo(f"{facts['walks']:>6}  walks")
    for line in run.log[:_SHOWN]:
        click.echo(line)
    if len(run.log) > _SHOWN:
        click.echo(f"and {len(run.log) - _SHOWN} lines more")
