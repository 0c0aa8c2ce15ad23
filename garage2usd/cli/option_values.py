"""Values of options that click has no types for: sizes, places, and some of several words."""

import re

import click
from click.shell_completion import CompletionItem

__all__ = ["Place", "Several", "Size"]

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


class Place(click.ParamType[tuple[float, float, float]]):
    """A place in the stage, as ``12,1.6,-8.5``."""

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
    """Some of several words, with commas."""

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
