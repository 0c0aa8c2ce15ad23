"""The command line: arguments, progress, exit codes."""

import json
import signal
import sys
from collections import Counter
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Self, TextIO

import click

from garage2usd.errors import ConfigError, Garage2UsdError
from garage2usd.version import VERSION

if TYPE_CHECKING:
    from click._termui_impl import ProgressBar

    from garage2usd.pipeline import Build

__all__ = ["main"]

_USAGE_FIELDS = {"output"}
_TERMINATED = 128 + signal.SIGTERM


class _Commands(click.Group):
    """Turns the errors that garage2usd raises on purpose into one line and an exit code."""

    def invoke(self, ctx: click.Context) -> object:
        """Run a command; usage errors end in 2, all others in 1. A real bug shows its traceback."""
        signal.signal(signal.SIGTERM, _termination)
        try:
            return super().invoke(ctx)
        except Garage2UsdError as error:
            click.echo(f"Error: {error}", err=True)
            usage = isinstance(error, ConfigError) and error.field in _USAGE_FIELDS
            ctx.exit(2 if usage else 1)


class _Termination:
    """SIGTERM unwinds like an exception, so that temporary files go."""

    def __init__(self) -> None:
        self._asked = False

    def __call__(self, _signal: int, _frame: FrameType | None) -> None:
        """Handle the signal."""
        self._asked = True
        sys.exit(_TERMINATED)

    def insist(self) -> None:
        """Unwind now, if whatever was running when the signal came swallowed the exception, as callbacks from C do."""
        if self._asked:
            sys.exit(_TERMINATED)


_termination = _Termination()


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(VERSION, "-V", "--version", prog_name="garage2usd")
def main() -> None:
    """Generate underground parking garages and export them as OpenUSD stages."""


@main.command()
@click.argument("config", required=False, type=click.Path(dir_okay=False, path_type=Path))
@click.option("--seed", type=click.IntRange(0, 2**63 - 1), help="Seed, in place of the configuration's.")
@click.option("--tape", help="The tape of a plan, as its report has it: make its lanes again instead of learning.")
@click.option("--learning-curve", is_flag=True, help="Draw the return of each episode as well.")
@click.option("--best-plans", type=click.IntRange(0, 200), default=0, help="Draw so many of the best plans as well.")
@click.option(
    "--output",
    "-o",
    type=click.Path(path_type=Path),
    default=Path("garage.usdz"),
    show_default=True,
    help="The stage: .usda, .usdc or .usdz. Plan picture and report are written beside it.",
)
def build(
    *, config: Path | None, seed: int | None, tape: str | None, learning_curve: bool, best_plans: int, output: Path
) -> None:
    """Build the garage that CONFIG (TOML) describes, or a good default one.

    \b
    Examples:
      garage2usd build --seed 7 --output garage.usdz
      garage2usd build samples/paper_7x9.toml -o out/paper.usda
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.config import load_config  # noqa: PLC0415 - keeps --help instant
    from garage2usd.pipeline import build as build_garage  # noqa: PLC0415

    with _Bars(sys.stderr) as progress:
        made = build_garage(
            load_config(config) if config else None,
            output,
            seed=seed,
            tape=tape,
            learning_curve=learning_curve,
            best_plans=best_plans,
            progress=progress,
        )
    _describe(made)


def _describe(made: "Build") -> None:
    from garage2usd.planning import area_per_stall_m2  # noqa: PLC0415 - keeps --help instant

    garage, layout, score = made.garage, made.garage.layout, made.garage.plan.score
    rows, cols = layout.structure.shape
    counts = layout.counts()
    uses = ", ".join(f"{count} {use}" for use, count in Counter(stall.use for stall in layout.stalls).most_common())
    figures = f"N_S {score.stalls}, T_S {score.parking_time_squares:.2f} squares, U_S {score.unused_squares}"
    lines = [
        ("squares", f"{rows} x {cols}, {counts['floor']} inside"),
        ("stalls", f"{len(layout.stalls)} ({uses}), {counts['car']} with a car"),
        ("m2/stall", f"{area_per_stall_m2(layout.structure, garage.config.bay):.1f}"),
        ("score", f"{score.value:.2f} ({figures})"),
        ("reachable", "every stall, from an entrance and to an exit"),
        ("seed", str(garage.config.seed)),
        ("stage", str(made.stage)),
        *([("assets", f"{made.asset_folder}/")] if made.asset_folder else []),
        *(("picture", str(picture)) for picture in made.pictures),
        ("report", str(made.report)),
        ("labels", str(made.labels)),
        ("Unity", f"add the package unity_importer, then drop {_dropped(made)} into Assets"),
        ("seconds", ", ".join(f"{step} {value:.2f}" for step, value in made.seconds.items())),
    ]
    for name, value in lines:
        click.echo(f"{name:>10}  {value}")


def _dropped(made: "Build") -> str:
    """What a Unity project needs of a build."""
    return made.stage.name if made.asset_folder is None else f"{made.stage.name} and {made.asset_folder.name}/"


@main.command()
def schema() -> None:
    """Print the JSON schema of the configuration."""
    from garage2usd.config import config_schema  # noqa: PLC0415

    click.echo(json.dumps(config_schema(), indent=2))


@main.command()
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
def textures(folder: Path) -> None:
    """Bake the texture set that the wheel ships into FOLDER, byte for byte, a folder for each quality."""
    from garage2usd.assets import bake_textures  # noqa: PLC0415
    from garage2usd.output import check_writable, publish, staging_folder  # noqa: PLC0415

    check_writable(folder)
    with staging_folder() as staging:
        bake_textures(staging)
        folders = publish(sorted(staging.iterdir()), folder)
    click.echo(f"{sum(len(list(place.iterdir())) for place in folders)} textures in {folder}")


class _Bars:
    """One progress bar for each step that reports, on a terminal only."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._step = ""
        self._bar: ProgressBar[int] | None = None

    def __enter__(self) -> Self:
        """Start without a bar."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the last bar."""
        self._end()

    def __call__(self, step: str, done: int, total: int) -> None:
        """Show that `done` of `total` units of `step` are finished."""
        _termination.insist()
        if not self._stream.isatty():
            return
        if step != self._step or self._bar is None:
            self._end()
            self._step = step
            self._bar = click.progressbar(length=total, label=f"{step:>10}", file=self._stream)
            self._bar.__enter__()
        self._bar.update(done - self._bar.pos)

    def _end(self) -> None:
        if self._bar is not None:
            self._bar.update((self._bar.length or 0) - self._bar.pos)
            self._bar.__exit__(None, None, None)
            self._bar = None
