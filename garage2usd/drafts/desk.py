"""The desk at which a file is drawn: its draft, its file, windows that share it, and its stage for the 3D view."""

import tempfile
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any, ClassVar, Generic, TypeVar

from garage2usd.common.errors import ConfigError, Garage2UsdError, OutputError
from garage2usd.drafts.draft import Draft
from garage2usd.drafts.draft_file import SUFFIX, DraftFile
from garage2usd.reading.files import open_stage
from garage2usd.view.viewer import Looks, ShownScene, read_scene

Told = dict[str, Any]
"""A message to the page, as JSON has it."""
_Model = TypeVar("_Model")


class RefusalError(Garage2UsdError):
    """A message that does not fit the drawing as it is now: of an older version, or over changes of the file."""


class Desk(ABC, Generic[_Model]):
    """A drawing, in the hands of one or several windows of a browser.

    Parameters
    ----------
    file
        Its file.
    draft
        The drawing, as it is in the file or new.
    """

    page: ClassVar[str]
    """File of the page that draws it."""
    told: ClassVar[tuple[str, ...]] = ("state", "findings", "changed_outside")
    """Names of the methods that tell the page something."""
    done: ClassVar[tuple[str, ...]] = ("edit", "undo", "redo", "restore", "reload", "save", "build")
    """Names of the methods that take messages of the page."""

    def __init__(self, file: DraftFile, draft: Draft[_Model]) -> None:
        self._lock = threading.RLock()
        self._file, self.draft = file, draft
        self._kept = file.kept()
        self._hold = ExitStack()
        self._at_build = threading.Lock()
        self._views: dict[str, ShownScene] = {}
        self._built: dict[str, Told] = {}

    def hold(self) -> None:
        """Ensure until it is closed that the file stands open on no other page; raises `OutputError` where it does."""
        self._hold_on(self._file)

    def _hold_on(self, file: DraftFile) -> None:
        with ExitStack() as hold:
            hold.enter_context(file.held())
            self._hold.close()
            self._hold = hold.pop_all()
        self._file = file

    @property
    def file(self) -> DraftFile:
        """The file of the drawing."""
        return self._file

    # what the page is told

    def state(self) -> Told:
        """Tell all that the page shows."""
        with self._lock:
            draft = self.draft
            told = {
                "number": draft.number,
                "name": self._file.path.name,
                "folder": str(self._file.path.parent),
                "is_new": self._file.saved is None,
                "is_saved": draft.text == self._file.saved,
                "can_undo": draft.can_undo,
                "can_redo": draft.can_redo,
                "kept": self._kept is not None,
                "view": self._view_name(),
            }
            more = self._drawing()
        return {**told, **more()}

    @abstractmethod
    def _drawing(self) -> Callable[[], Told]:
        """Prepare, while nothing changes, what the page is told of the drawing itself."""

    @abstractmethod
    def findings(self) -> Told:
        """Check the drawing with all objects; a second or more."""

    def changed_outside(self) -> Told:
        """Tell if the file is no longer as it was read, and for other windows which version of which file this is."""
        return {"changed": self._file.has_changed, "number": self.draft.number, "name": self._file.path.name}

    # what the page does

    def edit(self, message: Told) -> Told:
        """Apply an edit of the version that the page has."""

        def change() -> None:
            if message.get("number") != self.draft.number:
                raise RefusalError("the drawing was changed in another window; it is shown as it is now")
            self._edit(message.get("edit"), str(message.get("stroke", "")))

        return self._changed(change)

    @abstractmethod
    def _edit(self, edit: Any, stroke: str) -> None:  # noqa: ANN401 - what JSON holds
        """Read an edit and apply it; raises `ConfigError`."""

    def undo(self, _: Told) -> Told:
        """Undo an edit."""
        return self._changed(self.draft.undo)

    def redo(self, _: Told) -> Told:
        """Redo an edit."""
        return self._changed(self.draft.redo)

    def restore(self, message: Told) -> Told:
        """Take the work that an earlier page left unsaved, or discard it."""

        def change() -> None:
            if self._kept is not None and message.get("take"):
                self.draft.replace(self._kept)
            self._kept = None

        return self._changed(change)

    def reload(self, _: Told) -> Told:
        """Take the file as others changed it; what was drawn can be brought back by undo."""

        def change() -> None:
            file = DraftFile(self._file.path)
            if file.saved is not None:
                self.draft.replace(file.saved)
            self._file.saved = file.saved

        return self._changed(change)

    def save(self, message: Told) -> Told:
        """Save the drawing, under another name of the same folder if one is given."""
        with self._lock:
            file = file_beside(self._file, message.get("name") or self._file.path.name)
            name = file.path.name
            if file is not self._file and file.saved is not None and not message.get("over"):
                raise RefusalError(f"{name} is there already")
            if file is self._file and file.has_changed and not message.get("over"):
                raise RefusalError(f"{name} has changed since it was read here")
            before = self._file
            if file is not before:
                self._hold_on(file)
            file.save(self.draft.text, over_changes=True)
            if file is not before:
                before.discard()
            self._kept = None
        return self.state()

    def build(self, _: Told) -> Told:
        """Build the garage for the 3D view, once; tells the name of the view, and its number of stalls."""
        with self._at_build:
            with self._lock:
                write, name = self._writer(), self._view_name()
                shown = self.view(name)
            try:
                if shown is not None and not shown.is_ready:
                    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
                        stage, told = write(Path(folder, self._file.path.stem))
                        shown.show(read_scene(open_stage(stage), stage, Looks()))
                    self._built = {name: told}
            except Garage2UsdError:
                self._drop_views(but=0)
                raise
            return {"view": name, **self._built[name]}

    @abstractmethod
    def _writer(self) -> Callable[[Path], tuple[Path, Told]]:
        """Return what writes the stage of the present drawing below a path without suffix, and tells of it."""

    def view(self, name: str) -> ShownScene | None:
        """Return a 3D view by its name; that of the present drawing also before it is built, and waits for that."""
        with self._lock:
            if name not in self._views and name == self._view_name():
                self._drop_views(but=1)  # the one before may stand open
                self._views[name] = ShownScene()
            return self._views.get(name)

    def _view_name(self) -> str:
        return str(self.draft.number)

    def _drop_views(self, *, but: int) -> None:
        for name in list(self._views)[: len(self._views) - but]:
            self._views.pop(name).release()

    def close(self) -> None:
        """Stop all work and let the file go; unsaved work stays beside it."""
        self._drop_views(but=0)
        self._hold.close()

    def _changed(self, change: Callable[[], None]) -> Told:
        with self._lock:
            change()
            if self._kept is None:  # else the work of before would be lost before anybody was asked
                try:
                    self._file.keep(self.draft.text)
                except OutputError as error:
                    return {**self.state(), "warning": str(error)}
        return self.state()


def file_beside(file: DraftFile, name: object) -> DraftFile:
    """Return the file of a name in the same folder, the same one for its own name; raises `ConfigError`."""
    if not isinstance(name, str) or name != Path(name).name or not name.endswith(SUFFIX) or name == SUFFIX:
        raise ConfigError("name", name, f"a file name in this folder that ends in {SUFFIX}")
    return file if name == file.path.name else DraftFile(file.path.with_name(name))
