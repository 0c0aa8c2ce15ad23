"""Hierarchy of errors: each names the failure, the value, the allowed values, and the seed that reproduces it."""

import os
from collections.abc import Mapping, Sequence
from enum import Enum
from pathlib import Path
from typing import Any


class Garage2UsdError(Exception):
    """Base class of all errors that garage2usd raises on purpose.

    Attributes
    ----------
    plans
        Structure of each level that was planned before the garage failed, by its name: ``plan``, or ``U1_plan``.
    kept
        Files of these plans that a build has left.
    """

    plans: Mapping[str, Any] = {}
    kept: tuple[Path, ...] = ()

    def __reduce__(self) -> "tuple[object, ...]":
        """Pickle an error by message and attributes, as the constructors differ."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(kind: type[Garage2UsdError], args: tuple[object, ...], attributes: dict[str, object]) -> Garage2UsdError:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(attributes)
    return error


class ConfigError(Garage2UsdError, ValueError):
    """An invalid value given by the user.

    Parameters
    ----------
    field
        Dotted name of the setting, for example ``site.width_cells``.
    value
        The value as given.
    allowed
        Description of the allowed values.
    """

    def __init__(self, field: str, value: object, allowed: str) -> None:
        self.field = field
        self.value = value
        self.allowed = allowed
        super().__init__(f"{printable(field)}: got {_brief(value)}; allowed: {printable(' '.join(allowed.split()))}")


class DataSetError(Garage2UsdError):
    """An incomplete or damaged data set.

    Parameters
    ----------
    path
        Folder of the data set.
    reason
        Description of the defect.
    """

    def __init__(self, path: object, reason: str) -> None:
        super().__init__(f"{printable(path)}: {printable(' '.join(reason.split()))}")


class GenerationError(Garage2UsdError):
    """A random step without a valid result within its attempts.

    Parameters
    ----------
    step
        Name of the step in the pipeline, for example ``portals``.
    reason
        Description of the failure, with figures.
    seed
        Seed that reproduces the failure.
    attempts
        Number of attempts.
    """

    def __init__(self, step: str, reason: str, *, seed: int, attempts: int) -> None:
        self.step = step
        self.reason = reason
        self.seed = seed
        self.attempts = attempts
        super().__init__(f"{step}: {reason} (seed {seed}, {attempts} attempts)")


class UnreachableStallError(Garage2UsdError):
    """Stalls without a path from an entrance or to an exit.

    Parameters
    ----------
    cells
        (row, col) of each square with such stalls.
    drawing
        The structure matrix as text with these squares marked ``?``.
    """

    def __init__(self, cells: Sequence[tuple[int, int]], drawing: str) -> None:
        self.cells = tuple(cells)
        self.drawing = drawing
        named = ", ".join(f"({row}, {col})" for row, col in self.cells)
        super().__init__(f"stalls on squares {named} have no route from an entrance and to an exit:\n{drawing}")


class OutputError(Garage2UsdError, OSError):
    """A file that could not be written; no partial output remains.

    Parameters
    ----------
    path
        The path as given.
    reason
        Reason given by the operating system.
    """

    def __init__(self, path: object, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{path}: {reason}")

    def __str__(self) -> str:
        """Path and reason, without the error number of OSError."""
        return f"{printable(self.path)}: {self.reason}"


class UnreadableFileError(Garage2UsdError):
    """An invalid file.

    Parameters
    ----------
    path
        The file.
    reason
        Description of the defect.
    """

    def __init__(self, path: object, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{printable(path)}: {printable(' '.join(reason.split()))}")


class StageError(UnreadableFileError):
    """A stage, or a file that belongs to it, that cannot be read."""


class ReportError(UnreadableFileError):
    """A build report that cannot be used."""


class TracksError(UnreadableFileError):
    """A file of tracks that cannot be read."""


class MissingExtraError(Garage2UsdError):
    """An optional part of garage2usd that is not installed.

    Parameters
    ----------
    command
        The requested command or feature.
    extra
        Name of the extra that installs the missing package.
    brings
        Description of the missing package.
    install
        Command that installs the extra.
    """

    def __init__(self, command: str, extra: str, brings: str, install: str) -> None:
        self.command = command
        self.extra = extra
        super().__init__(f"{command} needs {brings}: {install}")


class RenderError(Garage2UsdError):
    """A failure of Blender during rendering.

    Parameters
    ----------
    code
        Exit code, or the negative number of the signal that ended Blender.
    said
        Last output of Blender.
    """

    def __init__(self, code: int, said: str) -> None:
        self.code = code
        self.said = said
        super().__init__(f"Blender ended with {code}: {said}")


def printable(path: object) -> str:
    """Format a path or name in one line, with escapes for non-printable characters."""
    return "".join(sign if sign.isprintable() else ascii(sign)[1:-1] for sign in str(path))


def _bare(value: object) -> object:
    """Return a value as it is written in a file: without the names of classes, which `repr` prints."""
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, Path):
        return str(value)
    for to_plain in ("tolist", "model_dump"):  # methods of arrays and of settings
        if hasattr(value, to_plain) and not isinstance(value, type):
            return _bare(getattr(value, to_plain)())
    if isinstance(value, Mapping):
        return {_bare(key): _bare(each) for key, each in value.items()}
    if isinstance(value, list | tuple) and type(value) in {list, tuple}:
        return type(value)(map(_bare, value))
    return value


_BRIEF_CHARACTERS = 80


def _brief(value: object) -> str:
    """Format a value in one line: a path in full, since its end is significant, any other value truncated."""
    text = repr(_bare(value)).replace("\n", "")  # arrays are printed over several lines
    is_path = isinstance(value, str) and os.sep in value and "\n" not in value
    return text if is_path or len(text) <= _BRIEF_CHARACTERS else f"{text[:_BRIEF_CHARACTERS]}..."
