"""A group of commands that share their errors and exit codes."""

import signal

import click

from garage2usd.cli.termination import TERMINATION
from garage2usd.errors import ConfigError, Garage2UsdError

__all__ = ["Commands"]

_USAGE_FIELDS = {"output"}


class Commands(click.Group):
    """Turns the errors that garage2usd raises on purpose into one line and an exit code."""

    def invoke(self, ctx: click.Context) -> object:
        """Run a command; usage errors end in 2, all others in 1. A real bug shows its traceback."""
        signal.signal(signal.SIGTERM, TERMINATION)
        try:
            return super().invoke(ctx)
        except Garage2UsdError as error:
            click.echo(f"Error: {error}", err=True)
            usage = isinstance(error, ConfigError) and error.field in _USAGE_FIELDS
            ctx.exit(2 if usage else 1)
