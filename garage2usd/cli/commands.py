"""The click group of all commands, with common error lines and exit codes."""

import sys
from typing import Any

import click

from garage2usd.cli.termination import TERMINATION
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.common.usd_messages import keep_usd_messages, usd_messages

__all__ = ["Commands"]

_MOST_USD_MESSAGES = 5
_USAGE_FIELDS = {"frames", "output", "profile"}


class Commands(click.Group):
    """Print each `Garage2UsdError` as one line and end with its exit code."""

    def main(self, *args: Any, **kwargs: Any) -> Any:  # noqa: ANN401 - as click has it
        """Run a command; usage errors end in 2, all others in 1. A real bug shows its traceback."""
        TERMINATION.install()
        keep_usd_messages()
        try:
            return super().main(*args, **kwargs)
        except Garage2UsdError as error:
            click.echo(f"Error: {error}", err=True)
            if error.kept:
                click.echo(f"kept, as far as it was planned: {', '.join(map(str, error.kept))}", err=True)
            is_usage = isinstance(error, ConfigError) and error.field in _USAGE_FIELDS
            sys.exit(2 if is_usage else 1)
        except Exception as error:
            # values of a stage are read lazily, so that any step may meet a damaged one
            if not _is_of_usd(error):
                raise
            from garage2usd.reading.files import usd_reason  # noqa: PLC0415 - it brings USD

            click.echo(f"Error: USD cannot read the stage ({usd_reason(error)})", err=True)
            sys.exit(1)
        finally:
            said = usd_messages()
            for message in said[:_MOST_USD_MESSAGES]:
                click.echo(f"in the stage: {message}", err=True)
            if len(said) > _MOST_USD_MESSAGES:
                click.echo(f"in the stage: {len(said) - _MOST_USD_MESSAGES} more, see garage2usd check", err=True)


def _is_of_usd(error: Exception) -> bool:
    """True if USD raised the error, or a name in a damaged stage is not valid text."""
    tf = sys.modules.get("pxr.Tf")
    return tf is not None and isinstance(error, (tf.ErrorException, UnicodeDecodeError))
