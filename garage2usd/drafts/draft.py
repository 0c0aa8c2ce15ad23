"""A garage that is being drawn: its configuration as text, with edits, undo and redo."""

import tomllib
from pathlib import Path
from typing import NamedTuple

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, config_in
from garage2usd.drafts.edits import Edit, applied

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


class Version(NamedTuple):
    """A configuration: its text, and its validated settings."""

    text: str
    config: GarageConfig


class Draft:
    """A garage that is being drawn. Each version of it is a configuration that loads.

    Parameters
    ----------
    text
        The configuration, TOML.
    folder
        Folder at which its relative paths start.

    Raises
    ------
    ConfigError
        If the text is not TOML, or holds an unknown key or a value that is not allowed.
    """

    def __init__(self, text: str, folder: Path) -> None:
        self.folder = folder
        self.number = 0
        """Counts the changes, so that an edit of an older version is known."""
        self._past: list[Version] = []
        self._future: list[Version] = []
        self._stroke = ""
        self._now = self._version(text)

    @property
    def text(self) -> str:
        """The configuration as TOML."""
        return self._now.text

    @property
    def config(self) -> GarageConfig:
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

    def edit(self, edit: Edit, *, stroke: str = "") -> None:
        """Apply an edit; raises `ConfigError` or `GenerationError`, and changes nothing, where it is refused.

        Edits with the same `stroke`, as while a mouse is dragged, are undone together.
        """
        self._take(self._version(applied(edit, self.text, self.config)), stroke)

    def replace(self, text: str) -> None:
        """Take another text, as of a file that changed; raises as the constructor, and can be undone."""
        self._take(self._version(text), "")

    def _take(self, version: Version, stroke: str) -> None:
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

    def _set(self, version: Version) -> None:
        self._now = version
        self.number += 1

    def _version(self, text: str) -> Version:
        try:
            settings = tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            raise ConfigError("CONFIG", "text", f"TOML ({error})") from None
        return Version(text, config_in(settings, self.folder))
