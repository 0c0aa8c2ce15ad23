"""Options, types of values, tables and error lines that all commands share."""

import logging
import math
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from garage2usd.cli.process import TERMINATION
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.common.usd_messages import keep_usd_messages, usd_messages

_MOST_USD_MESSAGES = 5
_USAGE_FIELDS = {"frames", "output", "profile"}
_INCOMPLETE = 3
INPUT_FILE = click.Path(dir_okay=False, path_type=Path)
"""An input file; a missing or damaged one ends in exit code 1, with the error of its reader."""
seed_option = click.option(
    "--seed", metavar="N", type=click.IntRange(0, 2**63 - 1), help="Seed, in place of the configuration's."
)
"""Option for the seed of a garage made from a configuration."""
_NUMBERS = re.compile(r"(\d{1,18})(?::(\d{1,18}))?")
_MOST_NUMBERS = 10_000
_SIZE = re.compile(r"(\d{1,5})x(\d{1,5})")


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


def _complete_starting_point(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    from garage2usd.config.starting_points import STARTING_POINTS  # noqa: PLC0415 - keeps --help instant

    return [CompletionItem(name) for name in STARTING_POINTS if name.startswith(incomplete)]


like_option = click.option(
    "--like",
    metavar="NAME",
    shell_complete=_complete_starting_point,
    help="A usual garage to start from: airport-us, mall-cn, office-uk or residential-de.",
)
"""Option for a starting point in place of a configuration or recipe."""


def profile_option(text: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Option for the standard; `text` gives its purpose."""
    names = "cn-jgj100, de-garvo, uk-istructe, us-ada or a TOML file"
    return click.option("--profile", metavar="NAME|FILE", shell_complete=_profiles, help=f"{text}: {names}.")


def output_option(
    text: str,
    *,
    metavar: str = "FILE",
    several: bool = False,
    required: bool = False,
    default: str | None = None,
    **checks: bool,
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Option for what a command writes, or for several files; `text` describes it, and `checks` are click.Path's."""
    names, kind = ["--output", "-o", *(["outputs"] if several else [])], click.Path(path_type=Path, **checks)
    more: dict[str, Any] = {} if default is None else {"default": default, "show_default": True}
    return click.option(*names, metavar=metavar, type=kind, multiple=several, required=required, help=text, **more)


def count_option(name: str, most: int, default: int, text: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Option for a number from 1 to `most`; `text` describes it."""
    kind = click.IntRange(1, most)
    return click.option(name, metavar="N", type=kind, default=default, show_default=True, help=text)


def device_option(text: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Option for the device that renders; `text` describes it."""
    kind = click.Choice(["auto", "cpu", "gpu", "rays"])
    return click.option("--device", type=kind, default="auto", show_default=True, help=text)


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
    """Print notices on standard error, on unused parts of the user's files or data that a format cannot represent."""
    for notice in notices:
        click.echo(notice, err=True)


class _Told(logging.Handler):
    """A logging handler that passes each line to a function."""

    def __init__(self, say: Callable[[str], None]) -> None:
        super().__init__()
        self._say = say

    def emit(self, record: logging.LogRecord) -> None:
        self._say(self.format(record))


def log_steps(say: Callable[[str], None]) -> None:
    """Pass each line that the package logs to a function: decisions and duration of each step."""
    log = logging.getLogger("garage2usd")
    log.setLevel(logging.INFO)
    log.handlers[:] = [_Told(say)]


def end_incomplete(lacking: Sequence[str]) -> None:
    """Name the files whose extra is missing on standard error, and end with exit code 3."""
    for line in lacking:
        click.echo(f"Error: {line}", err=True)
    if lacking:
        raise click.exceptions.Exit(_INCOMPLETE)


def _profiles(_ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the name of a shipped profile, or else a file name."""
    from garage2usd.profiles import PROFILE_NAMES  # noqa: PLC0415 - keeps --help instant

    names = [CompletionItem(name) for name in PROFILE_NAMES if name.startswith(incomplete)]
    return names or [CompletionItem(incomplete, type="file")]


class Size(click.ParamType[tuple[int, int]]):
    """Width and height in pixels, as ``1280x720``."""

    name = "WIDTHxHEIGHT"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Read the two numbers."""
        if isinstance(value, tuple):
            return value
        found = _SIZE.fullmatch(str(value))
        if found is None:
            self.fail(f"{value!r} is not a size such as 1280x720", param, ctx)
        return int(found[1]), int(found[2])


class Numbers(click.ParamType[tuple[int, ...]]):
    """Integers from 0, as ``7``, ``0:48`` for 0 to 47, or several of these with commas."""

    name = "A:B,..."

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, ...]:
        """Read all of them, each once."""
        if isinstance(value, tuple):
            return value
        numbers: dict[int, None] = {}
        for part in str(value).split(","):
            found = _NUMBERS.fullmatch(part.strip())
            first = int(found[1]) if found else 0
            end = int(found[2]) if found and found[2] else first + 1
            if found is None or not 0 < end - first <= _MOST_NUMBERS:
                self.fail(f"{part!r} is no number, nor at most {_MOST_NUMBERS} numbers such as 0:48", param, ctx)
            numbers |= dict.fromkeys(range(first, end))
        return tuple(numbers)


class Place(click.ParamType[tuple[float, float, float]]):
    """A point in the stage, as ``12,1.6,-8.5``."""

    name = "X,Y,Z"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float, float]:
        """Read the three numbers."""
        if isinstance(value, tuple):
            return value
        try:
            x, y, z = map(float, str(value).split(","))
        except ValueError:
            self.fail(f"{value!r} is not a place such as 12,1.6,-8.5", param, ctx)
        return x, y, z


class Span(click.ParamType[tuple[float, float]]):
    """A first and a last second, as ``30:60``."""

    name = "S:S"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, float]:
        """Read the two numbers."""
        if isinstance(value, tuple):
            return value
        try:
            first, last = map(float, str(value).split(":"))
        except ValueError:
            self.fail(f"{value!r} is not a span such as 30:60", param, ctx)
        if not 0 <= first <= last < math.inf:
            self.fail(f"{value!r} is not a span of seconds from 0 on, the first one first", param, ctx)
        return first, last


class Several(click.ParamType[tuple[str, ...]]):
    """A comma-separated selection of words."""

    def __init__(self, name: str, words: tuple[str, ...]) -> None:
        self.name, self._words = name, words

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        """Split at commas."""
        if isinstance(value, tuple):
            return value
        kinds = tuple(part.strip() for part in str(value).split(","))
        unknown = [kind for kind in kinds if kind not in self._words]
        if unknown:
            self.fail(f"{unknown[0]!r} is not one of {', '.join(self._words)}", param, ctx)
        return kinds

    def shell_complete(self, _ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """The kinds that the last word may become."""
        begun, comma, last = incomplete.rpartition(",")
        return [CompletionItem(f"{begun}{comma}{kind}") for kind in self._words if kind.startswith(last)]
