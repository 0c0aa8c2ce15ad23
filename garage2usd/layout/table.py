"""All objects of a garage in columns, so that a million of them stay light and quick to go through."""

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
    """A sequence whose entries are kept in columns and made when they are asked for."""

    @abstractmethod
    def at(self, rows: NDArray[np.intp]) -> list[_Entry]:
        """The entries in some rows."""

    @overload
    def __getitem__(self, index: int) -> _Entry: ...

    @overload
    def __getitem__(self, index: slice) -> list[_Entry]: ...

    def __getitem__(self, index: int | slice) -> _Entry | list[_Entry]:
        """One entry, or those of a slice."""
        if isinstance(index, slice):
            return self.at(np.arange(len(self))[index])
        return self.at(np.array([range(len(self))[index]]))[0]

    def __iter__(self) -> Iterator[_Entry]:
        """All entries in order."""
        return iter(self.at(np.arange(len(self))))


class ObjectTable(Table[Placement]):
    """The objects of a garage: a sequence of placements, and its columns as arrays.

    Attributes
    ----------
    specs
        The different shapes.
    names
        The different names, as ASCII; shape (names,).
    kind, spec, name
        Index of each object's kind in `garage2usd.objects.KINDS`, of its shape in `specs` and of its name in `names`;
        shape (n,).
    position_m
        (x, y, z) of each; float64, shape (n, 3).
    yaw_rad
        Turn of each about +Y; float64, shape (n,).
    square
        (row, col) of the tile of each, (-1, -1) for what belongs to the building; signed, shape (n, 2).
    ordinal
        Number on its square of the stall that each belongs to, 0 for what belongs to none; signed, shape (n,).
    """

    def __init__(self, parts: Iterable[Iterable[Placement]]) -> None:
        """Take the columns out of placements, part by part, so that only one part's are there at a time.

        What lies on squares comes first, square by square, and within one in the order of the parts.
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
        """Number of objects."""
        return len(self.kind)

    def at(self, rows: NDArray[np.intp]) -> list[Placement]:
        """The placements in some rows."""
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
        """Numbers of the rows that hold objects of some kinds, by their names.

        Raises
        ------
        KeyError
            If there is no such kind.
        """
        is_wanted = np.zeros(len(KINDS), np.bool_)
        is_wanted[[_ROWS[kind] for kind in kinds]] = True
        return np.flatnonzero(is_wanted[self.kind])


def compact(numbers: NDArray[np.integer[Any]]) -> NDArray[np.signedinteger[Any]]:
    """Numbers in the smallest signed type that holds them."""
    return numbers.astype(np.min_scalar_type(-1 - int(numbers.max(initial=0))))


def _columns(
    placements: Iterable[Placement], specs: dict[Spec, int], names: dict[str, int]
) -> tuple[NDArray[Any], ...]:
    """Shape, name, position, turn, square and ordinal of placements as arrays; new shapes and names get a number."""
    placements = list(placements)
    return (
        np.array([specs.setdefault(place.spec, len(specs)) for place in placements], dtype=np.int32),
        np.array([names.setdefault(place.name, len(names)) for place in placements], dtype=np.int32),
        np.array([place.position_m for place in placements], dtype=np.float64).reshape(-1, 3),
        np.array([place.yaw_rad for place in placements], dtype=np.float64),
        np.array([place.square or (-1, -1) for place in placements], dtype=np.int32).reshape(-1, 2),
        np.array([place.ordinal or 0 for place in placements], dtype=np.int32),
    )
