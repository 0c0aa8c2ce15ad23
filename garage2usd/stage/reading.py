"""Stages that anybody may have written, opened after a look at their files."""

import re
import stat
import zipfile
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Tf, Usd, UsdGeom

from garage2usd.errors import StageError
from garage2usd.limits import allow_seconds

__all__ = ["STAGE_SUFFIXES", "lacks", "metres_y_up", "number_of", "numbers_of", "open_stage", "usd_reason", "usd_text"]

_Scalar = TypeVar("_Scalar", bound=np.generic)
_DEFAULT_TIME = Usd.TimeCode.Default()
STAGE_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
_MAX_FILE_BYTES = 2 * 1024**3
_MAX_PACKAGE_FILES = 100_000
_LEAST_S, _OPENING_S_PER_MB, _READING_S_PER_MB = 1.5, 4.0, 60.0
"""Processor time for the root layer, and then for all that is done with the stage, by the size of the files."""
_REASON_CHARACTERS = 300
_NO_TEXT = "it holds bytes that are no text"
_Z_UP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, 1.0, 0, 0], [0, 0, 0, 1.0]])
_SAID = re.compile(r"at line \d+ in file \S+ : '(.*?)'(?= Error in |$)")


def open_stage(path: Path) -> Usd.Stage:
    """Open a stage for reading.

    Raises
    ------
    StageError
        If it is no regular file of a known kind and size, a package that USD would not read (compressed or encrypted
        entries, entries that leave it, one that stands there twice), or it or a layer that it names is damaged.
    """
    _check_file(path)
    if path.suffix == ".usdz":
        _check_package(path)
    allow_seconds(_LEAST_S + _OPENING_S_PER_MB * path.stat().st_size / 1e6)
    layers = _open_layers(path)
    try:
        stage = Usd.Stage.Open(layers[0])
    except Tf.ErrorException as error:
        raise StageError(path, f"USD cannot compose it ({usd_reason(error)})") from None
    files = {used.realPath.partition("[")[0] for used in stage.GetUsedLayers()} - {""}
    allow_seconds(_LEAST_S + _READING_S_PER_MB * sum(Path(file).stat().st_size for file in files) / 1e6)
    return stage


def metres_y_up(stage: Usd.Stage) -> NDArray[np.float64]:
    """The matrix for row vectors from a stage's coordinates to metres, Y up; float64, shape (4, 4)."""
    matrix = np.eye(4)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        matrix = _Z_UP_TO_Y_UP.copy()
    scale = UsdGeom.GetStageMetersPerUnit(stage)
    matrix[:3, :3] *= scale if scale > 0 else 1.0
    return matrix


def number_of(attribute: Usd.Attribute, time: Usd.TimeCode = _DEFAULT_TIME) -> float:
    """The number that an attribute holds; 0 for none.

    Raises
    ------
    StageError
        If it holds something else: USD gives whatever a file has, not what the schema says.
    """
    value = attribute.Get(time)
    try:
        return float(0.0 if value is None else value)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def numbers_of(
    attribute: Usd.Attribute, dtype: type[_Scalar], *, width: int = 1, time: Usd.TimeCode = _DEFAULT_TIME
) -> NDArray[_Scalar]:
    """The numbers that an attribute holds, shape (n, width), or (n,) for a width of 1; none if it has no value.

    Raises
    ------
    StageError
        If it holds something else.
    """
    value = attribute.Get(time)
    try:
        numbers = np.asarray(() if value is None else value, dtype=dtype)
        return numbers.reshape(-1, width) if width > 1 else numbers.reshape(-1)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def lacks(attribute: Usd.Attribute, what: str) -> StageError:
    """The error of an attribute that holds something else than it should."""
    file = attribute.GetStage().GetRootLayer().realPath
    return StageError(file, f"{attribute.GetPath()} holds no {what}")


def _open_layers(path: Path) -> list[Sdf.Layer]:
    """The layer of a file and all that it leads to, but for those that are not there, which a stage may lack.

    USD tries a damaged layer again for each prim that refers to it.
    """
    layers: dict[str, Sdf.Layer | None] = {}
    waiting = [str(path)]
    while waiting:
        name = waiting.pop()
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


def usd_reason(error: Exception) -> str:
    """What an error of USD says, without the place in USD's sources where it was raised."""
    text = _NO_TEXT if isinstance(error, UnicodeDecodeError) else usd_text(lambda: str(error))
    said = _SAID.findall(text)
    return "; ".join(dict.fromkeys(said) or [text])[:_REASON_CHARACTERS]


def usd_text(read: Callable[[], str]) -> str:
    """A text of USD in one line, which may repeat bytes of a file that are none."""
    try:
        return " ".join(read().split())
    except UnicodeDecodeError:
        return _NO_TEXT


def _check_file(path: Path) -> None:
    if path.suffix not in STAGE_SUFFIXES:
        raise StageError(path, f"no stage; a stage ends in {', '.join(STAGE_SUFFIXES)}")
    try:
        status = path.stat()
    except (OSError, ValueError) as error:
        raise StageError(path, (error.strerror if isinstance(error, OSError) else None) or str(error)) from None
    if not stat.S_ISREG(status.st_mode):
        raise StageError(path, "no regular file")
    if not 0 < status.st_size <= _MAX_FILE_BYTES:
        raise StageError(path, f"{status.st_size} bytes; a stage has 1 to {_MAX_FILE_BYTES}")


def _check_package(path: Path) -> None:
    """Look at a package's directory; USD maps its stored entries into memory and unpacks nothing."""
    try:
        with zipfile.ZipFile(path) as package:
            entries = package.infolist()
    except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile) as error:
        raise StageError(path, f"no package ({error})") from None
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
            raise StageError(path, f"the entry {entry.filename!r} stands there twice")
        names.add(entry.filename)
