"""The structure of a garage: the paper's matrices S, R and C as one immutable value.

Axes: ``row`` grows downwards in text and along +Z in the stage, ``col`` grows to the right and along +X.
"""
# Over 300 lines: S, R and C are one value, and each of their errors names what is allowed.

import hashlib
from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.structure.squares import bordered, pieces_of

CellArray = NDArray[np.int8]
Mask = NDArray[np.bool_]

NEIGHBOUR_STEPS: tuple[tuple[int, int], ...] = ((-1, 0), (1, 0), (0, -1), (0, 1))
"""(row, col) steps to the four neighbours theta: up, down, left, right."""


class Cell(IntEnum):
    """Kind of a square: the values of the structure matrix S."""

    OBSTACLE = -1
    FREE = 0
    LANE = 1
    ENTRANCE = 2
    EXIT = 3


_SYMBOL = {Cell.OBSTACLE: "#", Cell.FREE: ".", Cell.LANE: "=", Cell.ENTRANCE: "E", Cell.EXIT: "X"}
_CELL_BY_SYMBOL = {symbol: cell for cell, symbol in _SYMBOL.items()}
_TEXT_FORM = "rows of equal length of '#' outside or obstacle, '.' free, '=' lane, 'E' entrance, 'X' exit"
_LEAST_CELL, _GREATEST_CELL = min(Cell), max(Cell)
_MAX_SIDE_CELLS = 2000
_MM_PER_M = 1000
_MIN_SIDE_MM, _MAX_SIDE_MM = 1_000, 50_000


def cells_from_text(text: str, *, field: str) -> CellArray:
    """Parse a structure matrix from its drawing in characters.

    Parameters
    ----------
    text
        One line per row, one character per square (see `Cell`), or numbers -1 to 3 separated by whitespace or commas.
    field
        Name of the setting with the text, for the error.

    Returns
    -------
    CellArray
        int8, shape (rows, cols).

    Raises
    ------
    ConfigError
        If a character is unknown or the rows differ in length.
    """
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    if not lines:
        raise ConfigError(field, text, _TEXT_FORM)
    numeric = any(character.isdigit() for character in text)
    rows = [_numbers(line, field) if numeric else _symbols(line, field) for line in lines]
    if len({len(row) for row in rows}) != 1:
        lengths = [len(row) for row in rows]
        raise ConfigError(field, f"rows of {lengths} squares", _TEXT_FORM)
    return np.array(rows, dtype=np.int8)


def cells_to_text(cells: CellArray) -> str:
    """Draw a structure matrix as text, one line per row; the inverse of `cells_from_text`."""
    return "\n".join("".join(_SYMBOL[Cell(value)] for value in row) for row in cells.tolist())


def squares_beside(square: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the (row, col) of the four neighbours of a square: up, down, left, right, inside the matrix or not."""
    row, col = square
    return [(row + down, col + right) for down, right in NEIGHBOUR_STEPS]


def edge_neighbour_count(mask: Mask) -> NDArray[np.int8]:
    """Count for each square how many of its four neighbours are set in `mask`.

    The outside counts as not set. Shape and order are those of `mask`.
    """
    padded = bordered(mask).astype(np.int8)
    count: NDArray[np.int8] = padded[:-2, 1:-1] + padded[2:, 1:-1] + padded[1:-1, :-2] + padded[1:-1, 2:]
    return count


def outside_squares(cells: CellArray) -> Mask:
    """Return the squares outside the contour: -1, connected to the padded border. Other -1 squares are obstacles."""
    blocked = bordered(cells == Cell.OBSTACLE, value=True)
    numbers, _ = pieces_of(blocked)
    outside: Mask = (numbers == numbers[0, 0])[1:-1, 1:-1]
    return outside


def sides_mm(sides_m: ArrayLike, *, field: str, shape: tuple[int, ...], axis: int) -> NDArray[np.int64]:
    """Return the sides of squares along one axis in whole millimetres.

    Parameters
    ----------
    sides_m
        Metres: one number, one per line of squares, or a matrix of `shape` constant across the other axis.
    field
        Name of the setting with the sides, for the error.
    shape
        (rows, cols).
    axis
        0 for row depths (C), 1 for column widths (R).

    Returns
    -------
    ndarray
        int64, shape (shape[axis],).

    Raises
    ------
    ConfigError
        If the shape does not fit, a side is not 1 to 50 m, or tiles would not meet.
    """
    try:
        given = np.asarray(sides_m, dtype=np.float64)
    except ValueError:
        raise ConfigError(field, sides_m, "rows of equal length") from None
    except (TypeError, OverflowError):
        raise ConfigError(field, sides_m, "metres as numbers") from None
    if not np.isfinite(given).all():
        raise ConfigError(field, given.tolist(), "finite metres")
    if given.ndim == 2 and given.shape == shape:  # noqa: PLR2004
        first = given.take([0], axis=1 - axis)
        if not (given == first).all():
            row, col = np.argwhere(given != first)[0]
            line = ("along a row", "along a column")[axis]
            expected = first[row, 0] if axis == 0 else first[0, col]
            raise ConfigError(f"{field}[{row}, {col}]", float(given[row, col]), f"{expected}, constant {line}")
        given = first.ravel()
    elif given.ndim == 0:
        given = np.full(shape[axis], float(given))
    if given.shape != (shape[axis],):
        raise ConfigError(field, f"shape {given.shape}", f"a number, shape ({shape[axis]},) or shape {tuple(shape)}")
    if not ((given >= _MIN_SIDE_MM / _MM_PER_M) & (given <= _MAX_SIDE_MM / _MM_PER_M)).all():
        raise ConfigError(field, given.tolist(), "sides of 1 to 50 m")
    whole: NDArray[np.int64] = np.rint(given * _MM_PER_M).astype(np.int64)
    return whole


@dataclass(frozen=True, eq=False)
class Structure:
    """A structure matrix with the sizes of its squares; equal if `digest` is equal.

    Attributes
    ----------
    cells
        int8, shape (rows, cols), values of `Cell`; read-only. The paper's S.
    column_widths_mm
        int64, shape (cols,): extent of each column along X. The paper's R, constant along a column.
    row_depths_mm
        int64, shape (rows,): extent of each row along Z. The paper's C, constant along a row.

    Raises
    ------
    ConfigError
        If a shape, a value of S, or a side outside 1 to 50 m does not fit.
    """

    cells: CellArray
    column_widths_mm: NDArray[np.int64]
    row_depths_mm: NDArray[np.int64]

    def __post_init__(self) -> None:
        """Validate shapes and values of the structure and keep read-only copies."""
        cells = np.array(self.cells, dtype=np.int8)
        widths = np.array(self.column_widths_mm, dtype=np.int64)
        depths = np.array(self.row_depths_mm, dtype=np.int64)
        if cells.ndim != 2 or 0 in cells.shape or max(cells.shape) > _MAX_SIDE_CELLS:  # noqa: PLR2004
            raise ConfigError("S", f"shape {cells.shape}", f"two axes of 1 to {_MAX_SIDE_CELLS} squares")
        if not _LEAST_CELL <= cells.min() <= cells.max() <= _GREATEST_CELL:
            raise ConfigError("S", sorted(set(cells.ravel().tolist()) - set(Cell)), "values -1, 0, 1, 2, 3")
        for field, sides, count in (("R", widths, cells.shape[1]), ("C", depths, cells.shape[0])):
            if sides.shape != (count,):
                raise ConfigError(field, f"shape {sides.shape}", f"one side for each of {count} lines of S")
            if not ((sides >= _MIN_SIDE_MM) & (sides <= _MAX_SIDE_MM)).all():
                raise ConfigError(field, (sides / _MM_PER_M).tolist(), "sides of 1 to 50 m")
        for name, array in (("cells", cells), ("column_widths_mm", widths), ("row_depths_mm", depths)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __reduce__(self) -> tuple[object, ...]:
        """Return constructor arguments for pickle, so that unpickled arrays are read-only again."""
        return type(self), (self.cells, self.column_widths_mm, self.row_depths_mm)

    @classmethod
    def from_arrays(cls, S: ArrayLike, R: ArrayLike, C: ArrayLike) -> "Structure":  # noqa: N803
        """Build a structure from the paper's three matrices.

        Parameters
        ----------
        S
            Integers -1 to 3, shape (rows, cols).
        R
            Column widths in metres: one number, shape (cols,), or shape (rows, cols) constant along a column.
        C
            Row depths in metres: one number, shape (rows,), or shape (rows, cols) constant along a row.

        Raises
        ------
        ConfigError
            If a shape or value does not fit, or R or C vary where tiles would no longer meet.
        """
        try:
            given = np.asarray(S)
        except ValueError:
            raise ConfigError("S", S, "rows of equal length") from None
        if given.dtype.kind not in "iu":
            raise ConfigError("S", f"dtype {given.dtype}", "integers -1, 0, 1, 2, 3")
        if given.ndim != 2:  # noqa: PLR2004
            raise ConfigError("S", f"shape {given.shape}", "two axes: rows, cols")
        if not np.isin(given, list(Cell)).all():  # before int8 can wrap a value
            raise ConfigError("S", sorted(set(given.ravel().tolist()) - set(Cell)), "values -1, 0, 1, 2, 3")
        return cls(
            given.astype(np.int8),
            sides_mm(R, field="R", shape=given.shape, axis=1),
            sides_mm(C, field="C", shape=given.shape, axis=0),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of the structure matrix, (rows, cols)."""
        rows, cols = self.cells.shape
        return rows, cols

    @cached_property
    def S(self) -> CellArray:  # noqa: N802
        """The paper's structure matrix; int8, shape (rows, cols)."""
        return self.cells

    @cached_property
    def R(self) -> NDArray[np.float64]:  # noqa: N802
        """The paper's width of each square in metres; shape (rows, cols)."""
        return np.broadcast_to(self.column_widths_mm / _MM_PER_M, self.shape)

    @cached_property
    def C(self) -> NDArray[np.float64]:  # noqa: N802
        """The paper's depth of each square in metres; shape (rows, cols)."""
        return np.broadcast_to((self.row_depths_mm / _MM_PER_M)[:, None], self.shape)

    @cached_property
    def column_edges_m(self) -> NDArray[np.float64]:
        """X of every column border in metres, from 0; shape (cols + 1,)."""
        return np.concatenate(([0], np.cumsum(self.column_widths_mm))) / _MM_PER_M

    @cached_property
    def row_edges_m(self) -> NDArray[np.float64]:
        """Z of every row border in metres, from 0; shape (rows + 1,)."""
        return np.concatenate(([0], np.cumsum(self.row_depths_mm))) / _MM_PER_M

    @property
    def floor_m2(self) -> float:
        """Floor area inside the contour, without obstacles."""
        return self.area_m2(self.cells != Cell.OBSTACLE)

    def area_m2(self, squares: Mask) -> float:
        """Return the area of some squares."""
        areas = np.outer(self.row_depths_mm, self.column_widths_mm)
        return float(areas[squares].sum()) / _MM_PER_M**2

    def cell_at(self, square: tuple[int, int]) -> Cell:
        """Return the kind of the square at (row, col); an obstacle outside the matrix."""
        row, col = square
        rows, cols = self.shape
        return Cell(self.cells[row, col]) if 0 <= row < rows and 0 <= col < cols else Cell.OBSTACLE

    def where(self, cell: Cell) -> list[tuple[int, int]]:
        """Return all squares of one kind as (row, col), in reading order."""
        return [(int(row), int(col)) for row, col in np.argwhere(self.cells == cell)]

    def with_cells(self, cells: CellArray) -> "Structure":
        """Return a structure with the same R and C and another S."""
        return Structure(cells, self.column_widths_mm, self.row_depths_mm)

    def digest(self) -> str:
        """SHA-256 of the structure's canonical bytes: shape, R and C in millimetres, S."""
        canonical = hashlib.sha256()
        for array in (np.array(self.shape), self.column_widths_mm, self.row_depths_mm):
            canonical.update(array.astype("<i8").tobytes())
        canonical.update(self.cells.tobytes())
        return canonical.hexdigest()

    def __eq__(self, other: object) -> bool:
        """Return True if shape, S, R and C of two structures are equal."""
        return isinstance(other, Structure) and self.digest() == other.digest()

    def __hash__(self) -> int:
        """Return the hash of the structure's digest."""
        return hash(self.digest())

    def __str__(self) -> str:
        """Draw S as text."""
        return cells_to_text(self.cells)


def _symbols(line: str, field: str) -> list[int]:
    unknown = sorted(set(line) - set(_CELL_BY_SYMBOL))
    if unknown:
        raise ConfigError(field, "".join(unknown), _TEXT_FORM)
    return [int(_CELL_BY_SYMBOL[character]) for character in line]


def _numbers(line: str, field: str) -> list[int]:
    values = line.replace(",", " ").split()
    allowed = {str(int(cell)) for cell in Cell}
    unknown = [value for value in values if value not in allowed]
    if unknown:
        raise ConfigError(field, unknown[0], "numbers -1, 0, 1, 2, 3")
    return [int(value) for value in values]
