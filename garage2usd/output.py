"""Output that is whole or absent: made elsewhere, then moved into place."""

import errno
import os
import re
import secrets
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from garage2usd.errors import ConfigError, OutputError

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

__all__ = [
    "HIDDEN_PREFIX",
    "check_length",
    "check_name",
    "check_writable",
    "only_run",
    "publish",
    "staging_folder",
    "store",
    "unfinished_folder",
    "writing",
]

HIDDEN_PREFIX = ".garage2usd-"
"""What the names of files begin with that are not in their place yet."""
_KEY = "work.txt"
_AT_WORK = "another run is at work in it; wait until that has ended, or name another folder"
_LOCK = "lock.bin"
"""Locked while a run is at work in the folder; the system opens it when the run ends, however that happens."""
_LONGEST_NAME_BYTES = 220
"""File systems take 255, of which other files' endings take some."""
_UNSPEAKABLE = re.compile(r"[@\\\x00-\x1f\x7f\ud800-\udfff]")


def check_length(path: Path) -> None:
    """Find out whether files can have a name, and ``_learning.png`` after it; raises `ConfigError` if they cannot."""
    if len(path.name.encode("utf-8", "surrogatepass")) > _LONGEST_NAME_BYTES:
        raise ConfigError("output", str(path), f"a file name of at most {_LONGEST_NAME_BYTES} bytes")


def check_name(path: Path) -> None:
    """Find out whether a layer that is to be written can have a name, and USD say it.

    Raises
    ------
    ConfigError
        If it cannot.
    """
    check_length(path)
    if _UNSPEAKABLE.search(path.name):
        raise ConfigError("output", str(path), "a file name in UTF-8 without '@', '\\' and control characters")


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
def writing(place: Path) -> Iterator[None]:
    """Raise `OutputError` in place of any other OSError, with the file that it names or else `place`."""
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(error.filename or place, error.strerror or str(error)) from None


@contextmanager
def staging_folder() -> Iterator[Path]:
    """A temporary folder to make files in; gone afterwards, whatever happened."""
    with tempfile.TemporaryDirectory(prefix="garage2usd-") as name:
        yield Path(name)


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
    note, lock = place / _KEY, place / _LOCK
    with writing(place):
        if place.exists() and (not note.exists() or note.read_text(encoding="utf-8") != key):
            allowed = f"another folder, or this one when {place} is removed, which holds what is left of other work"
            raise ConfigError("output", str(folder), allowed)
        place.mkdir(parents=True, exist_ok=True)
        file = lock.open("a+b")
    is_left = True
    with file:
        if not _takes(file, lock):
            raise OutputError(place, _AT_WORK)
        store(note, key.encode())
        try:
            yield place
            is_left = False
        except BaseException:
            is_left = any(path.is_file() and path not in {note, lock} for path in place.rglob("*"))
            raise
        finally:
            if not is_left:
                _remove(place)
    if sys.platform == "win32" and not is_left:  # which removes no file that is open
        with suppress(OSError):
            lock.unlink()
            place.rmdir()


@contextmanager
def only_run(folder: Path) -> Iterator[None]:
    """See to it that no other run works in an existing folder.

    Raises
    ------
    OutputError
        If another one does, or the folder cannot be written.
    """
    lock = folder / f"{HIDDEN_PREFIX}{_LOCK}"
    with writing(lock):
        file = lock.open("a+b")
    with file:
        if not _takes(file, lock):
            raise OutputError(folder, _AT_WORK)
        try:
            yield
        finally:
            with suppress(OSError):
                lock.unlink()


def _takes(file: IO[bytes], path: Path) -> bool:
    """Lock a file that was opened at a path, until it is closed; whether nobody else has, and it still stands there.

    Where a file system has no locks, nobody has.
    """
    try:
        if sys.platform == "win32":
            file.seek(0)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno not in {errno.EACCES, errno.EAGAIN, errno.EDEADLK}
    # the other run may have ended, and removed the folder, after the file was opened
    return path.exists() and os.path.samestat(path.stat(), os.fstat(file.fileno()))


def publish(items: Sequence[Path], folder: Path) -> tuple[Path, ...]:
    """Move finished files and folders into `folder`, the last one last, replacing what has their names.

    All of them are first copied beside their places under hidden names; only when that went well are they renamed.

    Returns
    -------
    tuple of Path
        Their places.

    Raises
    ------
    OutputError
        If they could not be written; what stood there before still does.
    """
    made = _make_folder(folder)
    hidden = [folder / f"{HIDDEN_PREFIX}{os.getpid()}-{item.name}" for item in items]
    places = [folder / item.name for item in items]
    with writing(folder):
        try:
            for item, copy in zip(items, hidden, strict=True):
                if item.is_dir():
                    shutil.copytree(item, copy)
                else:
                    shutil.copyfile(item, copy)
            for copy, place in zip(hidden, places, strict=True):
                _replace(copy, place)
        except BaseException:
            for copy in hidden:
                _remove(copy)
            for parent in made:
                with suppress(OSError):
                    parent.rmdir()
            raise
    return tuple(places)


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
            raise OutputError(error.filename or path, error.strerror or str(error)) from None
    finally:
        with suppress(OSError):
            hidden.unlink(missing_ok=True)


def _holds(path: Path, data: bytes) -> bool:
    """Whether a file can be read and holds `data`."""
    try:
        return path.stat().st_size == len(data) and path.read_bytes() == data
    except OSError:
        return False


def _make_folder(folder: Path) -> list[Path]:
    """Make `folder` and its parents; returns those that were missing, innermost first."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    return missing


def _replace(copy: Path, place: Path) -> None:
    if copy.is_dir() and place.exists():
        old = place.with_name(f"{HIDDEN_PREFIX}{os.getpid()}-old-{place.name}")
        place.rename(old)
        copy.rename(place)
        _remove(old)
    else:
        copy.replace(place)


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)
