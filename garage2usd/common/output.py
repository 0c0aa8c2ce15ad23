"""Atomic output: files are made in a temporary folder, then moved into place."""

# Over 300 lines: the checks before the work, temporary folders and moves are one protocol.

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

HIDDEN_PREFIX = ".garage2usd-"
"""Prefix of the names of temporary output files, before they are moved into place."""
_KEY = "work.txt"
_AT_WORK = "another run is at work in it; wait until that has ended, or name another folder"
_LOCK = "lock.bin"
"""Lock file of a run at work in a folder; the system releases the lock when the process ends, for any reason."""
_CONTROL = "control characters"
_LONGEST_NAME_BYTES = 220
"""Longest file name: file systems allow 255 bytes, of which derived names need some."""
_UNSPEAKABLE = re.compile(r"[\x00-\x1f\x7f-\x9f\ud800-\udfff]")
_UNSPEAKABLE_BY_USD = "@\\"


def can_say(path: str | Path) -> bool:
    """Return True if the path of an output can be stored in USD and text files: UTF-8 without control characters."""
    return _UNSPEAKABLE.search(str(path)) is None


def check_name(path: Path, *, of_layer: bool = False) -> None:
    """Check that the name of an output file can be stored in text files.

    Parameters
    ----------
    path
        The file.
    of_layer
        True if USD must be able to store the name too.

    Raises
    ------
    ConfigError
        If the name cannot be stored.
    """
    unspeakable = f"'@', '\\' and {_CONTROL}" if of_layer else _CONTROL
    if not can_say(path.name) or (of_layer and any(sign in path.name for sign in _UNSPEAKABLE_BY_USD)):
        raise ConfigError("output", str(path), f"a file name in UTF-8 without {unspeakable}")
    if fault := name_fault(path.name):
        raise ConfigError("output", str(path), fault)


def check_file(path: Path, *, with_it: Iterable[Path] = ()) -> None:
    """Check before the work that a file can be written at a path, and files with slightly longer names beside it.

    Raises
    ------
    ConfigError
        If its name is too long, or a folder stands at its path or at that of an accompanying file.
    OutputError
        If its folder is not writable.
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
    """Check before the work that files can be written into `folder`, or into its nearest existing parent.

    Raises
    ------
    OutputError
        If the folder is not writable.
    """
    try:
        existing = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
        with tempfile.TemporaryFile(dir=existing):
            pass
    except OSError as error:
        raise OutputError(folder, f"cannot write here ({error.strerror})") from None


@contextmanager
def writing(place: Path, *, where: str = "") -> Iterator[None]:
    """Convert any other OSError to an `OutputError` that names the error's file, or else `place`.

    A temporary file, unknown to the user, is reported as `place`; `where` is a folder of such files.
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
    """Create a temporary folder that is removed on exit in any case.

    Parameters
    ----------
    place
        Destination of the files, which errors name instead of the temporary path. If left out, errors are unchanged.

    Raises
    ------
    OutputError
        If a file cannot be written in the folder.
    """
    with writing(place or Path(tempfile.gettempdir())):
        folder = tempfile.TemporaryDirectory(prefix=HIDDEN_PREFIX)
    with folder as name, drafting(place) if place else nullcontext():
        yield Path(name)


def drafting(place: Path) -> AbstractContextManager[None]:
    """Convert OSErrors as `writing` does, for a file made in a system folder for temporary files."""
    return writing(place, where=f" in {tempfile.gettempdir()}, where it is made first")


@contextmanager
def unfinished_folder(folder: Path, key: str) -> Iterator[Path]:
    """Provide a folder ``<folder>.unfinished`` beside `folder` for long work that is done in pieces.

    An interruption leaves the folder for the next run with the same key. It is removed when the work is complete, or if
    no piece was finished.

    Parameters
    ----------
    folder
        Final destination of the result.
    key
        Identifies the work.

    Raises
    ------
    ConfigError
        If the folder belongs to other work.
    OutputError
        If the folder cannot be created, or another run uses it.
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
def only_run(folder: Path, *, of_file: str = "", otherwise: str = _AT_WORK) -> Iterator[None]:
    """Ensure that no other run uses an existing folder, or one file in it.

    Raises
    ------
    OutputError
        If another run uses it, with the reason `otherwise`, or the folder is not writable.
    """
    locked = folder / f"{HIDDEN_PREFIX}{of_file and f'{of_file}-'}{_LOCK}"
    with writing(folder):
        file = locked.open("a+b")
    with file:
        if not _takes(file, locked):
            raise OutputError(folder / of_file, otherwise)
        try:
            yield
        finally:
            with suppress(OSError):
                locked.unlink()


def _takes(file: IO[bytes], path: Path) -> bool:
    """Lock an open file until it is closed; True if the lock was free and the file is still at its path."""
    try:
        lock(file)
    except BlockingIOError:
        return False
    # another run may have removed the folder after the file was opened
    return path.exists() and os.path.samestat(path.stat(), os.fstat(file.fileno()))


def publish(items: Sequence[Path], folder: Path) -> tuple[Path, ...]:
    """Move finished files and folders into `folder` under their names, as `publish_at`; return their paths."""
    return publish_at({item: folder / item.name for item in items})


def publish_at(places: Mapping[Path, Path]) -> tuple[Path, ...]:
    """Move finished files and folders to their destinations, the last one last, replacing existing ones.

    All of them are first copied beside their destinations under hidden names, and renamed only if every copy succeeds.
    If one cannot be renamed because another program holds the existing file open, those before it are put back.

    Returns
    -------
    tuple of Path
        The destinations.

    Raises
    ------
    OutputError
        If the files could not be written. The files that existed before are unchanged, or where the message says.
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
        for parent in sorted(made, reverse=True):  # contents of a folder before the folder itself
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
    """Copy a file, or a folder recursively; errors name the destination."""
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
    """Write `data` to a file that several processes may write concurrently with equal contents.

    A file with these contents is left unchanged. Any other, for example one truncated by a full disk, is replaced
    atomically.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    if _holds(path, data):
        return
    hidden = path.with_name(f"{HIDDEN_PREFIX}{secrets.token_hex(8)}-{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        hidden.write_bytes(data)
        hidden.replace(path)
    except OSError as error:
        if not _holds(path, data):  # some systems forbid replacing a file while another process reads it
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
    """Create `folder` and its parents; return those that were missing."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    return missing


def _replace(copy: Path, place: Path, old: Path) -> None:
    """Move a file or folder to its place, and keep the previous one as `old`; on failure the place is unchanged."""
    is_refused = not copy.is_dir() and place.is_dir() and not place.is_symlink()  # a file cannot replace a folder
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
    """Link the file at `place` to `old`, so that `place` is never empty; return False if links are not possible."""
    if not place.is_file() or place.is_symlink():
        return False
    try:
        os.link(place, old)
    except (OSError, NotImplementedError):
        return False
    return True


def _put_back(place: Path, old: Path) -> bool:
    """Restore the previous file or folder at a place, or leave it empty if there was none; return True on success."""
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
