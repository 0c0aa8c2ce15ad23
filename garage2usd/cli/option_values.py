"""Types of command-line options that click lacks: image sizes, number ranges, points and lists of words."""

import re

import click
from click.shell_completion import CompletionItem

__all__ = ["Numbers", "Place", "Several", "Size"]

_NUMBERS = re.compile(r"(\d{1,18})(?::(\d{1,18}))?")
_MOST_NUMBERS = 10_000
_SIZE = re.compile(r"(\d{1,5})x(\d{1,5})")


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
