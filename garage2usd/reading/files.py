"""Stage files from untrusted sources, validated before USD opens them, and digests of what a stage holds."""

import hashlib
import re
import stat
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path, PurePosixPath

from pxr import Ar, Sdf, Tf, Usd, UsdUtils

from garage2usd.common.documents import is_file
from garage2usd.common.errors import StageError
from garage2usd.common.limits import allow_seconds
from garage2usd.common.output import can_say
from garage2usd.common.usd_messages import collect_usd_messages

STAGE_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
_MAX_FILE_BYTES = 2 * 1024**3
_MAX_PACKAGE_FILES = 100_000
_LEAST_S, _OPENING_S_PER_MB, _READING_S_PER_MB = 1.5, 4.0, 60.0
"""Limits of processor time in seconds: for any file, and per megabyte of the files to open and to read a stage."""
_REASON_CHARACTERS = 300
_NO_TEXT = "it holds bytes that are not text"
_SAID = re.compile(r"at line \d+ in file \S+ : '(.*?)'(?= Error in |$)")
_DIGEST_IN_NAME = re.compile(r"_[0-9a-f]{16}(?=\.usdc)")


def open_stage(path: Path) -> Usd.Stage:
    """Validate a stage's files and open it for reading.

    Raises
    ------
    StageError
        If it is not a regular file of a known kind and size, a package that USD would not read (compressed or encrypted
        entries, entries outside of it, an entry that occurs twice), or it or a layer that it names is damaged.
    """
    collect_usd_messages()
    _check_file(path)
    if path.suffix.lower() == ".usdz":
        _check_package(path)
    layers = _open_layers(path)
    allow_seconds(_LEAST_S + _OPENING_S_PER_MB * _megabytes(layer.realPath for layer in layers))
    try:
        stage = Usd.Stage.Open(layers[0])
    except Tf.ErrorException as error:
        raise StageError(path, f"USD cannot compose it ({usd_reason(error)})") from None
    allow_seconds(_LEAST_S + _READING_S_PER_MB * _megabytes(used.realPath for used in stage.GetUsedLayers()))
    return stage


def _open_layers(path: Path) -> list[Sdf.Layer]:
    """Open the layer of a file and all layers that it refers to; missing ones are permitted.

    USD tries a damaged layer again for each prim that refers to it. The limit of time is that of each layer.
    """
    layers: dict[str, Sdf.Layer | None] = {}
    waiting = [str(path.absolute())]  # USD does not take "anon:a.usda" alone for the name of a file
    while waiting:
        name = waiting.pop()
        allow_seconds(_LEAST_S + _OPENING_S_PER_MB * _megabytes([name]))
        try:
            layer = Sdf.Layer.FindOrOpen(name)
        except Tf.ErrorException as error:
            damaged = "USD cannot read it" if not layers else f"USD cannot read {name}, which it refers to"
            raise StageError(path, f"{damaged} ({usd_reason(error)})") from None
        layers[name] = layer
        if layer:
            assets = filter(None, layer.GetCompositionAssetDependencies())  # without those to the layer itself
            named = [Sdf.ComputeAssetPathRelativeToLayer(layer, asset) for asset in assets]
            waiting += [other for other in dict.fromkeys(named) if other and other not in layers]
    found = [layer for layer in layers.values() if layer]
    if not found:
        raise StageError(path, "USD cannot read it")
    return found


def _megabytes(names: Iterable[str]) -> float:
    """Return the size of the files that hold layers, in megabytes; missing ones have none."""
    files = {Path(Ar.SplitPackageRelativePathOuter(name)[0]) for name in names}
    return sum(file.stat().st_size for file in files if is_file(file)) / 1e6


def usd_reason(error: Exception) -> str:
    """Return the message of a USD error, without the location in USD's sources."""
    text = _NO_TEXT if isinstance(error, UnicodeDecodeError) else usd_text(lambda: str(error))
    said = _SAID.findall(text)
    return "; ".join(dict.fromkeys(said) or [text])[:_REASON_CHARACTERS]


def usd_text(read: Callable[[], str]) -> str:
    """Return a text of USD on one line; a placeholder if it quotes bytes that are not text."""
    try:
        return " ".join(read().split())
    except UnicodeDecodeError:
        return _NO_TEXT


def _check_file(path: Path) -> None:
    if path.suffix.lower() not in STAGE_SUFFIXES:
        raise StageError(path, f"not a stage: a stage ends in {', '.join(STAGE_SUFFIXES)}")
    if not can_say(path.absolute()):
        raise StageError(path, "its path is not in UTF-8, or has control characters, which USD does not take")
    try:
        status = path.stat()
    except (OSError, ValueError) as error:
        raise StageError(path, (error.strerror if isinstance(error, OSError) else None) or str(error)) from None
    if not stat.S_ISREG(status.st_mode):
        raise StageError(path, "not a regular file")
    if not 0 < status.st_size <= _MAX_FILE_BYTES:
        raise StageError(path, f"{status.st_size} bytes; a stage has 1 to {_MAX_FILE_BYTES}")


def _check_package(path: Path) -> None:
    """Validate the directory of a USD package; USD maps its stored entries into memory and unpacks nothing."""
    try:
        with zipfile.ZipFile(path) as package:
            entries = package.infolist()
    except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise StageError(path, f"not a package ({reason})") from None
    if not 0 < len(entries) <= _MAX_PACKAGE_FILES:
        raise StageError(path, f"a package of {len(entries)} files; it may have 1 to {_MAX_PACKAGE_FILES}")
    names = set()
    for entry in entries:
        place = PurePosixPath(entry.filename)
        if place.is_absolute() or ".." in place.parts or "\\" in entry.filename or not place.parts:
            raise StageError(path, f"the entry {entry.filename!r} leaves the package")
        if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
            raise StageError(path, f"the entry {entry.filename!r} is compressed or encrypted; a package only stores")
        if entry.filename in names:
            raise StageError(path, f"the entry {entry.filename!r} occurs twice")
        names.add(entry.filename)


def stage_digest(path: Path, *, digits: int = 64) -> str:
    """Digest the text of all layers of a stage and the bytes of its other files; hexadecimal digits of SHA-256.

    Raises
    ------
    StageError
        If the stage or one of its files cannot be read.
    """
    layers, assets, missing = UsdUtils.ComputeAllDependencies(str(path))
    if missing or not layers:
        raise StageError(path, f"cannot read {', '.join(missing) or 'it'}")
    texts = [_DIGEST_IN_NAME.sub("", layer.ExportToString()).encode() for layer in layers]
    sums = sorted(hashlib.sha256(data).hexdigest() for data in texts + [Path(asset).read_bytes() for asset in assets])
    return hashlib.sha256("\n".join(sums).encode()).hexdigest()[:digits]
