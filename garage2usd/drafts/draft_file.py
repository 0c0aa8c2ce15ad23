"""The file of a drawing: saved whole, kept beside itself while it is drawn, never written over what others changed."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Self

from garage2usd.common.documents import read_text
from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.common.output import check_file, only_run, store

SUFFIX = ".toml"
UNSAVED = ".unsaved"


class DraftFile:
    """The file of a drawing.

    Parameters
    ----------
    path
        The configuration; a new one if there is no such file.

    Attributes
    ----------
    path
        The file, symbolic links resolved.
    saved
        Its text when it was last read or written; None for a file that is not there yet.

    Raises
    ------
    ConfigError
        If it cannot be read, or its name does not end in ``.toml``.
    """

    def __init__(self, path: Path) -> None:
        if path.suffix.lower() != SUFFIX:
            raise ConfigError("CONFIG", str(path), f"a path that ends in {SUFFIX}")
        self.path = path.resolve()
        self.saved = self._on_disk()

    @classmethod
    def new(cls, folder: Path, stem: str = "garage") -> Self:
        """Return the file of a new drawing: the first free one of ``garage.toml``, ``garage_2.toml`` and so on."""
        number = 1
        while (path := folder / f"{stem}{f'_{number}' * (number > 1)}{SUFFIX}").exists():
            number += 1
        return cls(path)

    def _on_disk(self) -> str | None:
        if not self.path.exists():
            return None
        # `read_text` would drop a byte order mark, which is kept as all other bytes are
        return read_text(self.path, field="CONFIG")

    @contextmanager
    def held(self) -> Iterator[None]:
        """Ensure that the file stands open on no other page; raises `OutputError` where it does."""
        open_elsewhere = "it stands open on another page; go on there, or end that one first"
        with only_run(self.path.parent, of_file=self.path.name, otherwise=open_elsewhere):
            yield

    @property
    def has_changed(self) -> bool:
        """True if the file is no longer as it was last read or written."""
        try:
            return self._on_disk() != self.saved
        except ConfigError:
            return True

    def save(self, text: str, *, over_changes: bool = False) -> None:
        """Write the file; raises `OutputError` where it has changed, unless its changes are to be lost."""
        if not over_changes and self.has_changed:
            raise OutputError(self.path, "the file has changed since it was read here")
        check_file(self.path)
        store(self.path, text.encode())
        self.saved = text
        self.discard()

    @property
    def _beside(self) -> Path:
        return self.path.with_name(f".{self.path.name}{UNSAVED}")

    def keep(self, text: str) -> None:
        """Write unsaved work beside the file, or remove it where there is none."""
        if text == self.saved:
            self.discard()
        else:
            store(self._beside, text.encode())

    def kept(self) -> str | None:
        """Return the unsaved work of a page that ended without saving; None if there is none."""
        with suppress(ConfigError):
            text = read_text(self._beside, field="CONFIG") if self._beside.exists() else None
            return None if text == self.saved else text
        return None

    def discard(self) -> None:
        """Remove the unsaved work that stands beside the file."""
        with suppress(OSError):
            self._beside.unlink(missing_ok=True)
