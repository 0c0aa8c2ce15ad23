"""Column tables of the objects of a garage, compact and fast for a million objects."""

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout.placement import Placement
from garage2usd.objects import KINDS, Spec

__all__ = ["ObjectTable", "Table", "compact"]

_Entry = TypeVar("_Entry")
_ROWS = {kind.name: row for row, kind in enumerate(KINDS)}


class Table(Sequence[_Entry]):
    """Sequence with column storage; entries are created on access."""

    @abstractmethod
    def at(self, rows: NDArray[np.intp]) -> list[_Entry]:
        """Return the entries in some rows."""

    @overload
    def __getitem__(self, index: int) -> _Entry: ...

    @overload
    def __getitem__(self, index: slice) -> list[_Entry]: ...

    def __getitem__(self, index: int | slice) -> _Entry | list[_Entry]:
        """Return one entry, or the list of entries of a slice."""
        if isinstance(index, slice):
            return self.at(np.arange(len(self))[index])
        return self.at(np.array([range(len(self))[index]]))[0]

    def __iter__(self) -> Iterator[_Entry]:
        """Iterate over all entries in order."""
        return iter(self.at(np.arange(len(self))))


class ObjectTable(Table[Placement]):
    """Objects of a garage as a sequence of `Placement`, stored as one array for each column.

    Attributes
    ----------
    specs
        Distinct shapes.
    names
        Distinct names, as ASCII; shape (names,).
    kind, spec, name
        Index of each object's kind in `garage2usd.objects.KINDS`, of its shape in `specs` and of its name in `names`;
        shape (n,).
    position_m
        (x, y, z) of each object; float64, shape (n, 3).
    yaw_rad
        Rotation of each object about +Y; float64, shape (n,).
    square
        (row, col) of each object's tile, (-1, -1) for objects of the whole building; signed, shape (n, 2).
    ordinal
        Number of each object's stall on its square, 0 for objects without a stall; signed, shape (n,).
    """

    def __init__(self, parts: Iterable[Iterable[Placement]]) -> None:
        """Collect the columns of placements part by part; only one part is in memory at a time.

        Objects on squares come first, in the order of squares and of parts within a square.
        """
        specs: dict[Spec, int] = {}
        names: dict[str, int] = {}
        columns = [_columns(part, specs, names) for part in parts]
        spec, name, position, yaw, square, ordinal = (np.concatenate(column) for column in zip(*columns, strict=True))
        order = np.lexsort((square[:, 1], square[:, 0], square[:, 0] < 0))
        kinds = np.array([_ROWS[shape.kind.name] for shape in specs], dtype=np.uint8)
        self.kind, self.spec, self.name = kinds[spec[order]], compact(spec[order]), compact(name[order])
        self.position_m, self.yaw_rad = position[order], yaw[order]
        self.square, self.ordinal = compact(square[order]), compact(ordinal[order])
        self.specs, self.names = tuple(specs), np.array(list(names), dtype=np.bytes_)

    def __len__(self) -> int:
        """Return the number of objects."""
        return len(self.kind)

    def at(self, rows: NDArray[np.intp]) -> list[Placement]:
        """Return the placements in some rows."""
        columns = (self.name, self.spec, self.position_m, self.yaw_rad, self.square, self.ordinal)
        return [
            Placement(
                self.names[name].decode("ascii"),
                self.specs[spec],
                (x, y, z),
                yaw,
                (row, col) if row >= 0 else None,
                ordinal or None,
            )
            for name, spec, (x, y, z), yaw, (row, col), ordinal in zip(
                *(column[rows].tolist() for column in columns), strict=True
            )
        ]

    def rows_of(self, *kinds: str) -> NDArray[np.intp]:
        """Return the row indices of all objects of some kinds, by the names of the kinds.

        Raises
        ------
        KeyError
            If a kind is unknown.
        """
        is_wanted = np.zeros(len(KINDS), np.bool_)
        is_wanted[[_ROWS[kind] for kind in kinds]] = True
        return np.flatnonzero(is_wanted[self.kind])


def compact(numbers: NDArray[np.integer[Any]]) -> NDArray[np.signedinteger[Any]]:
    """Convert non-negative numbers, or -1, to the smallest sufficient signed integer type."""
    return numbers.astype(np.min_scalar_type(-1 - int(numbers.max(initial=0))))


def _columns(
    placements: Iterable[Placement], specs: dict[Spec, int], names: dict[str, int]
) -> tuple[NDArray[Any], ...]:
    """Return shape, name, position, yaw, square and ordinal of placements as arrays.

    New shapes are added to `specs` and new names to `names`, with their index.
    """
    placements = list(placements)
    return (
        np.array([specs.setdefault(place.spec, len(specs)) for place in placements], dtype=np.int32),
        np.array([names.setdefault(place.name, len(names)) for place in placements], dtype=np.int32),
        np.array([place.position_m for place in placements], dtype=np.float64).reshape(-1, 3),
        np.array([place.yaw_rad for place in placements], dtype=np.float64),
        np.array([place.square or (-1, -1) for place in placements], dtype=np.int32).reshape(-1, 2),
        np.array([place.ordinal or 0 for place in placements], dtype=np.int32),
    )
