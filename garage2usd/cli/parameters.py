"""Options and tables shared by several commands, with the same names, help and completion."""

import logging
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

__all__ = [
    "INPUT_FILE",
    "drive_options",
    "echo_notices",
    "echo_table",
    "end_incomplete",
    "log_steps",
    "profile_option",
    "seed_option",
]

_INCOMPLETE = 3
INPUT_FILE = click.Path(dir_okay=False, path_type=Path)
"""An input file; a missing or damaged one ends in exit code 1, with the error of its reader."""

seed_option = click.option(
    "--seed", metavar="N", type=click.IntRange(0, 2**63 - 1), help="Seed, in place of the configuration's."
)
"""Option for the seed of a garage made from a configuration."""


def profile_option(text: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Option for the standard; `text` gives its purpose."""
    names = "cn-jgj100, de-garvo, uk-istructe, us-ada or a TOML file"
    return click.option("--profile", metavar="NAME|FILE", shell_complete=_profiles, help=f"{text}: {names}.")


def drive_options(where: str, stall: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Options that select a drive; `where` and `stall` begin the help of the portals and of the stall."""
    number = click.IntRange(min=1)
    options = [
        click.option("--stall", metavar="NAME", help=f"{stall}: its name, or the number painted in it."),
        click.option(
            "--entrance", metavar="N", type=number, help=f"{where}: the entrance, from 1 on in reading order."
        ),
        click.option(
            "--exit", "exit_", metavar="N", type=number, help=f"{where}: the exit, from 1 on in reading order."
        ),
        click.option(
            "--leg",
            type=click.Choice(["both", "in", "out"]),
            help=f"{where}: only come, only leave, or both, which is the default.",
        ),
    ]

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


def echo_table(lines: Iterable[tuple[str, str]]) -> None:
    """Print (name, value) pairs, the names aligned to the right."""
    for name, value in lines:
        click.echo(f"{name:>10}  {value}")


def echo_notices(notices: Iterable[str]) -> None:
    """Print what is not used of the user's files, or not represented by an export format, on standard error."""
    for notice in notices:
        click.echo(notice, err=True)


class _Told(logging.Handler):
    """A handler of what is logged, which hands each line to a function."""

    def __init__(self, say: Callable[[str], None]) -> None:
        super().__init__()
        self._say = say

    def emit(self, record: logging.LogRecord) -> None:
        self._say(self.format(record))


def log_steps(say: Callable[[str], None]) -> None:
    """Hand each line that the package logs to a function: what each step decided, and how long it took."""
    log = logging.getLogger("garage2usd")
    log.setLevel(logging.INFO)
    log.handlers[:] = [_Told(say)]


def end_incomplete(lacking: Sequence[str]) -> None:
    """Name the files that were not written for want of an extra, on standard error, and end with an exit code of 3."""
    for line in lacking:
        click.echo(f"Error: {line}", err=True)
    if lacking:
        raise click.exceptions.Exit(_INCOMPLETE)


def _profiles(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the name of a shipped profile, or else a file name."""
    from garage2usd.profiles import PROFILE_NAMES  # noqa: PLC0415 - keeps --help instant

    names = [CompletionItem(name) for name in PROFILE_NAMES if name.startswith(incomplete)]
    return names or [CompletionItem(incomplete, type="file")]
