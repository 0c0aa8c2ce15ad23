"""A garage that is being drawn: its configuration or survey as text, with edits, undo and redo."""

import tomllib
from abc import abstractmethod
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from pydantic import TypeAdapter, ValidationError

from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings

NEW = '''# A garage drawn with `garage2usd draw`. '.' free, '=' lane, '#' outside or obstacle, 'E' entrance, 'X' exit.
seed = 0

[site]
structure = """
..........
.========E
.=......=.
.=......=.
.========.
.=......=.
.=......=.
X========.
..........
"""
'''
"""The drawing that a page without a configuration begins with."""
_MOST_STEPS = 1000
"""Number of edits that can be undone."""


_Model = TypeVar("_Model")


class Version(NamedTuple, Generic[_Model]):
    """A configuration or survey: its text, and its validated settings."""

    text: str
    config: _Model


class Edit(Settings, Generic[_Model]):
    """An edit of a configuration or survey."""

    @abstractmethod
    def applied(self, text: str, config: _Model) -> str:
        """Apply the edit to a text and return the new one; raises `Garage2UsdError` where it has no place in it."""


_Edit = TypeVar("_Edit")


def told_edit(edits: TypeAdapter[_Edit], message: Any) -> _Edit:  # noqa: ANN401 - what JSON holds
    """Read an edit from a message; raises `ConfigError` for anything else."""
    try:
        return edits.validate_python(message)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise ConfigError(".".join(map(str, first["loc"])) or "edit", first["input"], first["msg"]) from None


class Draft(Generic[_Model]):
    """A garage that is being drawn. Each version of it is a configuration, or a survey, that loads.

    Parameters
    ----------
    text
        The configuration, TOML.
    folder
        Folder at which its relative paths start.
    read
        Validates the settings of a text, with that folder.

    Raises
    ------
    ConfigError
        If the text is not TOML, or holds an unknown key or a value that is not allowed.
    """

    def __init__(self, text: str, folder: Path, read: Callable[[Mapping[str, Any], Path], _Model]) -> None:
        self.folder, self._read = folder, read
        self.number = 0
        """Counts the changes, so that an edit of an older version is known."""
        self._past: list[Version[_Model]] = []
        self._future: list[Version[_Model]] = []
        self._stroke = ""
        self._now = self._version(text)

    @property
    def text(self) -> str:
        """The configuration as TOML."""
        return self._now.text

    @property
    def config(self) -> _Model:
        """Its settings."""
        return self._now.config

    @property
    def can_undo(self) -> bool:
        """True if there is an edit to undo."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """True if there is an edit to redo."""
        return bool(self._future)

    def edit(self, edit: Edit[_Model], *, stroke: str = "") -> None:
        """Apply an edit; raises `ConfigError` or `GenerationError`, and changes nothing, where it is refused.

        Edits with the same `stroke`, as while a mouse is dragged, are undone together.
        """
        self._take(self._version(edit.applied(self.text, self.config)), stroke)

    def replace(self, text: str) -> None:
        """Take another text, as of a file that changed; raises as the constructor, and can be undone."""
        self._take(self._version(text), "")

    def _take(self, version: Version[_Model], stroke: str) -> None:
        if version.text == self.text:
            return
        if not (stroke and stroke == self._stroke):
            self._past = [*self._past[1 - _MOST_STEPS :], self._now]
        self._future, self._stroke = [], stroke
        self._set(version)

    def undo(self) -> None:
        """Return to the version before the last edit, byte for byte."""
        if self._past:
            self._future.append(self._now)
            self._set(self._past.pop())
            self._stroke = ""

    def redo(self) -> None:
        """Return to the version before the last undo."""
        if self._future:
            self._past.append(self._now)
            self._set(self._future.pop())
            self._stroke = ""

    def _set(self, version: Version[_Model]) -> None:
        self._now = version
        self.number += 1

    def _version(self, text: str) -> Version[_Model]:
        try:
            settings = tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            raise ConfigError("CONFIG", "text", f"TOML ({error})") from None
        return Version(text, self._read(settings, self.folder))
