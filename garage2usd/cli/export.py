"""``garage2usd export``."""

import sys
from pathlib import Path

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.parameters import INPUT_FILE, echo_table

__all__ = ["export"]


@click.command(short_help="Export a stage as GLB or as an occupancy grid.")
@click.argument("path", type=INPUT_FILE)
@click.option(
    "--output",
    "-o",
    "outputs",
    metavar="FILE",
    type=click.Path(path_type=Path),
    multiple=True,
    required=True,
    help="A file: .glb for a scene, .yaml for a robot's occupancy grid with its picture beside it; may be repeated.",
)
@click.option(
    "--config",
    metavar="FILE",
    type=INPUT_FILE,
    help="A configuration (TOML) whose section [maps] holds, in place of the report's or the defaults.",
)
def export(*, path: Path, outputs: tuple[Path, ...], config: Path | None) -> None:
    """Export a garage for programs that read no USD.

    PATH is a stage, also one that other tools have edited, which is exported as it stands; or the report of a build,
    whose garage is made again.

    \b
    Examples:
      garage2usd export garage.usdz -o garage.glb
      garage2usd export garage_report.json -o garage.glb -o garage.yaml
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.exports import export as export_garage  # noqa: PLC0415

    settings = load_config(config).maps if config else None
    with Bars(sys.stderr) as progress:
        files = export_garage(path, outputs, settings=settings, progress=progress)
    echo_table(("file", str(file)) for file in files)
