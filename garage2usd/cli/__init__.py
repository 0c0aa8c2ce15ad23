"""The command line: arguments, progress bars and exit codes."""

import atexit
import gc
import os
import sys

import click

from garage2usd.cli.build import build
from garage2usd.cli.check import check
from garage2usd.cli.dataset import compare, dataset
from garage2usd.cli.doctor import doctor
from garage2usd.cli.draw import draw
from garage2usd.cli.drive import drive
from garage2usd.cli.export import export
from garage2usd.cli.import_layout import import_layout
from garage2usd.cli.look import look
from garage2usd.cli.options import Commands
from garage2usd.cli.plan import plan
from garage2usd.cli.process import SUPERVISED, open_streams, supervise
from garage2usd.cli.render import render
from garage2usd.cli.shipped import meshes, schema, textures
from garage2usd.cli.traffic import traffic
from garage2usd.cli.view import view
from garage2usd.common.limits import ONE_THREAD
from garage2usd.common.package import VERSION

__all__ = ["main", "run"]


_KEPT_OBJECTS = 50_000
"""Allocations before a run of Python's cyclic garbage collector: 700 by default, though nearly all objects stay
alive."""
_MANY_THREADS = {"render", "dataset", "look"}
"""Commands that use threads of Blender, or processes whose threads are limited at their start."""
_EXIT_CODES = """Results go to standard output, messages to standard error. The exit code is 1 where something was
refused or found wrong, also for a file that is missing; 2 for wrong usage; 3 where all files were written
except exports whose extra is not installed; else 0."""


_GREETING = """garage2usd generates underground parking garages as OpenUSD stages. Three commands to begin with:

  garage2usd build --like residential-de --open    # build a garage, and walk through it in the browser
  garage2usd drive garage.usdz                     # prove that a car gets into each stall and out again
  garage2usd export garage.usdz -o garage.glb      # the garage for programs without USD; also maps and scenarios

`garage2usd --help` lists all commands, `garage2usd build --help` tells how one is used."""


@click.group(
    cls=Commands,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog=_EXIT_CODES,
)
@click.version_option(VERSION, "-V", "--version", prog_name="garage2usd")
@click.pass_context
def main(ctx: click.Context) -> None:
    """Generate underground parking garages and export them as OpenUSD stages."""
    if ctx.invoked_subcommand is None:
        click.echo(_GREETING)


for _command in (
    build,
    check,
    compare,
    dataset,
    doctor,
    draw,
    drive,
    export,
    import_layout,
    look,
    meshes,
    plan,
    render,
    schema,
    textures,
    traffic,
    view,
):
    main.add_command(_command)


def run() -> None:
    """Run the program `garage2usd`; commands that read stages run in a separate process."""
    open_streams()
    gc.set_threshold(_KEPT_OBJECTS)
    # otherwise Python's final garbage collections take a fifth of a second after a build
    atexit.register(gc.freeze)
    name = next((word for word in sys.argv[1:] if not word.startswith("-")), "")
    if name not in _MANY_THREADS:
        for variable, value in ONE_THREAD.items():
            os.environ.setdefault(variable, value)
    if name in SUPERVISED:
        supervise(main, name=name)
    main()
