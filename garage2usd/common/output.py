"""Output that is whole or absent: made elsewhere, then moved into place."""

# Over 300 lines: what is refused before the work, what is made elsewhere and what is moved hold only together.

import os
import re
import secrets
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from pathlib import Path
from typing import IO

from garage2usd.common.errors import ConfigError, OutputError
from garage2usd.common.system import KEEPS_OPEN_FILES, LONGEST_PATH, lock, name_fault, persistently

__all__ = [
    "HIDDEN_PREFIX",
    "can_say",
    "check_file",
    "check_name",
    "check_writable",
    "drafting",
    "only_run",
    "publish",
    "publish_at",
    "staging_folder",
    "store",
    "unfinished_folder",
    "writing",
]

HIDDEN_PREFIX = ".garage2usd-"
"""Prefix of the names of temporary output files, before they are moved into place."""
_KEY = "work.txt"
_AT_WORK = "another run is at work in it; wait until that has ended, or name another folder"
_LOCK = "lock.bin"
"""Locked while a run is at work in the folder; the system opens it when the run ends, however that happens."""
_CONTROL = "control characters"
_LONGEST_NAME_BYTES = 220
"""File systems take 255, of which other files' endings take some."""
_UNSPEAKABLE = re.compile(r"[\x00-\x1f\x7f-\x9f\ud800-\udfff]")
_UNSPEAKABLE_BY_USD = "@\\"


def can_say(path: str | Path) -> bool:
    """Whether USD and formats of text can say a path: it is in UTF-8, and has no control characters."""
    return _UNSPEAKABLE.search(str(path)) is None


def check_name(path: Path, *, of_layer: bool = False) -> None:
    """Find out whether the name of a file that is to be written can be said in text files.

    Parameters
    ----------
    path
        The file.
    of_layer
        Whether USD has to say it too.

    Raises
    ------
    ConfigError
        If it cannot.
    """
    unspeakable = f"'@', '\\' and {_CONTROL}" if of_layer else _CONTROL
    if not can_say(path.name) or (of_layer and any(sign in path.name for sign in _UNSPEAKABLE_BY_USD)):
        raise ConfigError("output", str(path), f"a file name in UTF-8 without {unspeakable}")
    if fault := name_fault(path.name):
        raise ConfigError("output", str(path), fault)


def check_file(path: Path, *, with_it: Iterable[Path] = ()) -> None:
    """Find out before the work whether a file can stand at a path, and beside it others with a little longer names.

    Raises
    ------
    ConfigError
        If its name is too long, or a folder stands in its place or in that of a file that comes with it.
    OutputError
        If its folder cannot be written.
    """
    try:
        bytes_ = len(os.fsencode(path.name))
    except UnicodeEncodeError:
        raise ConfigError("output", str(path), "a file name that the system can have") from None
    if bytes_ > _LONGEST_NAME_BYTES:
        raise ConfigError("output", str(path), f"a file name of at most {_LONGEST_NAME_BYTES} bytes")
    if LONGEST_PATH is not None and len(str(path.absolute())) > LONGEST_PATH:
        raise ConfigError("output", str(path), f"a path of at most {LONGEST_PATH} characters from its drive on")
    check_writable(path.parent)
    for place in (path, *with_it):
        if place.is_dir():
            raise ConfigError("output", str(place), "a path at which no folder stands")


def check_writable(folder: Path) -> None:
    """Find out before the work whether files can be written into `folder` or the folder it will be made in.

    Raises
    ------
    OutputError
        If they cannot.
    """
    try:
        existing = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
        with tempfile.TemporaryFile(dir=existing):
            pass
    except OSError as error:
        raise OutputError(folder, f"cannot write here ({error.strerror})") from None


@contextmanager
def writing(place: Path, *, where: str = "") -> Iterator[None]:
    """Raise `OutputError` in place of any other OSError, with the file that it names or else `place`.

    A file that only this program knows of, as it is not in its place yet, is called `place`, and `where` it is told.
    """
    try:
        yield
    except OSError as error:
        named, reason = (
            (error.path, error.reason) if isinstance(error, OutputError) else (error.filename, error.strerror)
        )
        if isinstance(named, str | Path) and HIDDEN_PREFIX not in str(named):
            raise OutputError(named, reason or str(error)) from None
        raise OutputError(place, f"{reason or error}{where}") from None


@contextmanager
def staging_folder(place: Path | None = None) -> Iterator[Path]:
    """A temporary folder to make files in; gone afterwards, whatever happened.

    Parameters
    ----------
    place
        Where what is made goes: errors name it, and not what is in the folder. Left out, they stay as they are.

    Raises
    ------
    OutputError
        If something cannot be written there.
    """
    with writing(place or Path(tempfile.gettempdir())):
        folder = tempfile.TemporaryDirectory(prefix=HIDDEN_PREFIX)
    with folder as name, drafting(place) if place else nullcontext():
        yield Path(name)


def drafting(place: Path) -> AbstractContextManager[None]:
    """Raise `OutputError` as `writing`, for a file that is made in a folder for temporary files."""
    return writing(place, where=f" in {tempfile.gettempdir()}, where it is made first")


@contextmanager
def unfinished_folder(folder: Path, key: str) -> Iterator[Path]:
    """A folder beside `folder`, ``<folder>.unfinished``, for what is made piece by piece and takes long.

    It stays if the work is interrupted, however that happens, and is there again for the same work; it is gone when the
    work is done, or if nothing was finished.

    Parameters
    ----------
    folder
        Where the whole goes in the end.
    key
        Says which work it is.

    Raises
    ------
    ConfigError
        If it holds other work.
    OutputError
        If it cannot be made, or another run works in it.
    """
    place = folder.absolute().with_name(f"{folder.absolute().name}.unfinished")
    note, locked = place / _KEY, place / _LOCK
    with writing(place):
        if place.exists() and (not note.exists() or note.read_text(encoding="utf-8") != key):
            allowed = f"another folder, or this one when {place} is removed, which holds what is left of other work"
            raise ConfigError("output", str(folder), allowed)
        place.mkdir(parents=True, exist_ok=True)
        file = locked.open("a+b")
    is_left = True
    with file:
        if not _takes(file, locked):
            raise OutputError(place, _AT_WORK)
        store(note, key.encode())
        try:
            with writing(place):
                yield place
            is_left = False
        except BaseException:
            is_left = any(path.is_file() and path not in {note, locked} for path in place.rglob("*"))
            raise
        finally:
            if not is_left:
                _remove(place)
    if KEEPS_OPEN_FILES and not is_left:
        with suppress(OSError):
            locked.unlink()
            place.rmdir()


@contextmanager
def only_run(folder: Path) -> Iterator[None]:
    """See to it that no other run works in an existing folder.

    Raises
    ------
    OutputError
        If another one does, or the folder cannot be written.
    """
    locked = folder / f"{HIDDEN_PREFIX}{_LOCK}"
    with writing(folder):
        file = locked.open("a+b")
    with file:
        if not _takes(file, locked):
            raise OutputError(folder, _AT_WORK)
        try:
            yield
        finally:
            with suppress(OSError):
                locked.unlink()


def _takes(file: IO[bytes], path: Path) -> bool:
    """Lock a file that was opened at a path, until it is closed; whether nobody else has, and it still stands there."""
    try:
        lock(file)
    except BlockingIOError:
        return False
    # the other run may have ended, and removed the folder, after the file was opened
    return path.exists() and os.path.samestat(path.stat(), os.fstat(file.fileno()))


def publish(items: Sequence[Path], folder: Path) -> tuple[Path, ...]:
    """Move finished files and folders into `folder` under their names, and return their places; as `publish_at`."""
    return publish_at({item: folder / item.name for item in items})


def publish_at(places: Mapping[Path, Path]) -> tuple[Path, ...]:
    """Move finished files and folders to their places, the last one last, replacing what stands there.

    All of them are first copied beside their places under hidden names; only when that went well are they renamed. If
    one cannot be, because another program has what stands there open, those before it are put back.

    Returns
    -------
    tuple of Path
        Their places.

    Raises
    ------
    OutputError
        If they could not be written; what stood there before still does, or is where the message says.
    """
    made: list[Path] = []
    replaced: list[tuple[Path, Path]] = []
    start = f"{HIDDEN_PREFIX}{os.getpid()}"
    hidden = [place.with_name(f"{start}-{number}-{place.name}") for number, place in enumerate(places.values())]
    try:
        for (item, place), copy in zip(places.items(), hidden, strict=True):
            made += _make_folder(place.parent)
            _copy(item, copy, place)
        for number, (copy, place) in enumerate(zip(hidden, places.values(), strict=True)):
            old = place.with_name(f"{start}-{number}-old-{place.name}")
            with writing(place):
                _replace(copy, place, old)
            replaced.append((place, old))
    except BaseException as error:
        lost = [(place, old) for place, old in reversed(replaced) if not _put_back(place, old)]
        for copy in hidden:
            _remove(copy)
        for parent in sorted(made, reverse=True):  # what lies within a folder goes before it
            with suppress(OSError):
                parent.rmdir()
        if lost and isinstance(error, OutputError):
            kept = ", ".join(f"what {place} was is {old}" for place, old in lost)
            raise OutputError(error.path, f"{error.reason}; {kept}") from None
        raise
    for _, old in replaced:
        _remove(old)
    return tuple(places.values())


def _copy(item: Path, copy: Path, place: Path) -> None:
    """Copy a file, or a folder with all that is in it; what cannot be copied is named by its place."""
    try:
        if not item.is_dir():
            shutil.copyfile(item, copy)
            return
        copy.mkdir()
    except OSError as error:
        raise OutputError(place, error.strerror or str(error)) from None
    for inner in item.iterdir():
        _copy(inner, copy / inner.name, place / inner.name)


def store(path: Path, data: bytes) -> None:
    """See to it that a file that several processes may write at once, all of them the same, holds `data`.

    A file that does is left alone. Any other, such as one of which a disk that was full took only the beginning, is
    replaced at once by a whole one, which nobody sees half written.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    if _holds(path, data):
        return
    hidden = path.with_name(f"{HIDDEN_PREFIX}{secrets.token_hex(8)}-{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        hidden.write_bytes(data)
        hidden.replace(path)
    except OSError as error:
        if not _holds(path, data):  # systems that keep files from being replaced while another process reads them
            named = path if error.filename == str(hidden) else error.filename
            raise OutputError(named or path, error.strerror or str(error)) from None
    finally:
        with suppress(OSError):
            hidden.unlink(missing_ok=True)


def _holds(path: Path, data: bytes) -> bool:
    """True if a file is readable and holds `data`."""
    try:
        return path.stat().st_size == len(data) and path.read_bytes() == data
    except OSError:
        return False


def _make_folder(folder: Path) -> list[Path]:
    """Make `folder` and its parents; returns those that were missing."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    return missing


def _replace(copy: Path, place: Path, old: Path) -> None:
    """Move a file or folder to its place, and keep what stood there as `old`; if it fails, the place is as before."""
    is_refused = not copy.is_dir() and place.is_dir() and not place.is_symlink()  # a file in a folder's place
    if is_refused or (not copy.is_dir() and _is_linked(place, old)):
        try:
            persistently(lambda: copy.replace(place))
        except BaseException:
            _remove(old)
            raise
        return
    stood = place.is_symlink() or place.exists()
    if stood:
        persistently(lambda: place.rename(old))
    try:
        persistently(lambda: copy.rename(place))
    except BaseException:
        if stood:
            _put_back(place, old)
        raise


def _is_linked(place: Path, old: Path) -> bool:
    """Link a file that stands at `place` to `old`, if there are links, so that one stands at `place` at any moment."""
    if not place.is_file() or place.is_symlink():
        return False
    try:
        os.link(place, old)
    except (OSError, NotImplementedError):
        return False
    return True


def _put_back(place: Path, old: Path) -> bool:
    """Restore what stood at a place, or nothing; whether that could be done."""
    try:
        if not (old.is_symlink() or old.exists()):
            _remove(place)
        elif old.is_dir() and not old.is_symlink():
            _remove(place)
            persistently(lambda: old.rename(place))
        else:
            persistently(lambda: old.replace(place))
    except OSError:
        return False
    return True


def _remove(path: Path) -> None:
    """Remove a file or folder, if no program has it open."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink(missing_ok=True)
