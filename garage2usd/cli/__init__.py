"""The command line: arguments, progress, exit codes. A module is a command."""

import click

from garage2usd.cli.build import build
from garage2usd.cli.commands import Commands
from garage2usd.cli.plan import plan
from garage2usd.cli.render import render
from garage2usd.cli.schema import schema
from garage2usd.cli.textures import textures
from garage2usd.version import VERSION

__all__ = ["main"]


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(VERSION, "-V", "--version", prog_name="garage2usd")
def main() -> None:
    """Generate underground parking garages and export them as OpenUSD stages."""


for _command in (build, plan, render, schema, textures):
    main.add_command(_command)
