"""One hierarchy of errors: what failed, the value, what is allowed, and the seed that reproduces it."""

import os
from collections.abc import Sequence

__all__ = [
    "ConfigError",
    "DataSetError",
    "Garage2UsdError",
    "GenerationError",
    "MissingExtraError",
    "OutputError",
    "RenderError",
    "ReportError",
    "StageError",
    "UnreachableStallError",
    "UnreadableFileError",
]


class Garage2UsdError(Exception):
    """Base of every error that garage2usd raises on purpose."""

    def __reduce__(self) -> "tuple[object, ...]":
        """Go to other processes by message and attributes, as each error takes other arguments."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(kind: type[Garage2UsdError], args: tuple[object, ...], attributes: dict[str, object]) -> Garage2UsdError:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(attributes)
    return error


class ConfigError(Garage2UsdError, ValueError):
    """A value given by the user that cannot be used.

    Parameters
    ----------
    field
        Dotted name of the setting, for example ``site.width_cells``.
    value
        The value as given.
    allowed
        What would have been accepted, in words.
    """

    def __init__(self, field: str, value: object, allowed: str) -> None:
        self.field = field
        self.value = value
        self.allowed = allowed
        super().__init__(f"{field}: got {_brief(value)}; allowed: {allowed}")


class DataSetError(Garage2UsdError):
    """A data set that is not whole.

    Parameters
    ----------
    path
        Its folder.
    reason
        What is wrong.
    """

    def __init__(self, path: object, reason: str) -> None:
        super().__init__(f"{_printable(path)}: {reason}")


class GenerationError(Garage2UsdError):
    """A random step that found no valid result within its bounded attempts.

    Parameters
    ----------
    step
        Name of the step on the road, for example ``portals``.
    reason
        What was missing, with figures.
    seed
        The seed that reproduces the failure.
    attempts
        How many attempts were made.
    """

    def __init__(self, step: str, reason: str, *, seed: int, attempts: int) -> None:
        self.step = step
        self.reason = reason
        self.seed = seed
        self.attempts = attempts
        super().__init__(f"{step}: {reason} (seed {seed}, {attempts} attempts)")


class UnreachableStallError(Garage2UsdError):
    """Stalls that no entrance reaches, or that reach no exit.

    Parameters
    ----------
    cells
        (row, col) of each square that holds such stalls.
    drawing
        The structure matrix as text with those squares marked ``?``.
    """

    def __init__(self, cells: Sequence[tuple[int, int]], drawing: str) -> None:
        self.cells = tuple(cells)
        self.drawing = drawing
        named = ", ".join(f"({row}, {col})" for row, col in self.cells)
        super().__init__(f"stalls on squares {named} have no route from an entrance and to an exit:\n{drawing}")


class OutputError(Garage2UsdError, OSError):
    """A file that could not be written; nothing was left behind.

    Parameters
    ----------
    path
        The path as given.
    reason
        What the operating system said.
    """

    def __init__(self, path: object, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{path}: {reason}")

    def __str__(self) -> str:
        """Path and reason, without OSError's errno form."""
        return f"{_printable(self.path)}: {self.reason}"


class UnreadableFileError(Garage2UsdError):
    """A file that is not what it should be.

    Parameters
    ----------
    path
        The file.
    reason
        What is wrong with it.
    """

    def __init__(self, path: object, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{_printable(path)}: {reason}")


class StageError(UnreadableFileError):
    """A stage, or a file that belongs to it, that cannot be read."""


class ReportError(UnreadableFileError):
    """A report of a build that cannot be used."""


class MissingExtraError(Garage2UsdError):
    """A part of garage2usd that is not installed.

    Parameters
    ----------
    command
        What was asked for.
    extra
        Name of the extra that brings what is missing.
    brings
        What that is, in words.
    """

    def __init__(self, command: str, extra: str, brings: str) -> None:
        self.command = command
        self.extra = extra
        super().__init__(f"{command} needs {brings}: pip install 'garage2usd[{extra}]'")


class RenderError(Garage2UsdError):
    """Blender ended without its pictures.

    Parameters
    ----------
    code
        Its exit code, or the negative number of the signal that ended it.
    said
        The last that it said.
    """

    def __init__(self, code: int, said: str) -> None:
        self.code = code
        self.said = said
        super().__init__(f"Blender ended with {code}: {said}")


def _printable(path: object) -> str:
    """A path in one line, in which signs that cannot be printed stand by their number."""
    return "".join(sign if sign.isprintable() else ascii(sign)[1:-1] for sign in str(path))


_BRIEF_CHARACTERS = 80


def _brief(value: object) -> str:
    """A value in one line: a path whole, as its end tells most; of others no more than their beginning."""
    text = repr(value).replace("\n", "")  # arrays take a line a row
    is_path = isinstance(value, str) and os.sep in value and "\n" not in value
    return text if is_path or len(text) <= _BRIEF_CHARACTERS else f"{text[:_BRIEF_CHARACTERS]}..."
