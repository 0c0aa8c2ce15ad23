"""Column tables of the objects and of the stalls of a garage, compact and fast for a million objects."""

from abc import abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.layout.placement import PlacedStall, Placement, stall_name
from garage2usd.objects import KINDS, Spec
from garage2usd.structure.grid import NEIGHBOUR_STEPS
from garage2usd.structure.lane_graph import StallType
from garage2usd.structure.stalls import Edge

_Entry = TypeVar("_Entry")
_ROWS = {kind.name: row for row, kind in enumerate(KINDS)}
EDGES, STALL_TYPES, STALL_USES = tuple(Edge), tuple(StallType), tuple(StallUse)
STALL_SIZES = tuple(size.value for size in SizeClass)
"""Size classes in the order of their numbers in the table."""
_TYPE_NUMBERS = {stall_type: number for number, stall_type in enumerate(STALL_TYPES)}
_SIZE_NUMBERS = {size: number for number, size in enumerate(STALL_SIZES)}
_USE_NUMBERS = {use: number for number, use in enumerate(STALL_USES)}


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


class StallTable(Table[PlacedStall]):
    """The stalls of a garage as a sequence, stored as one array per column.

    Attributes
    ----------
    square
        (row, col) of each stall's square; int32, shape (n, 2).
    ordinal
        Number of each stall on its square, from 1; uint16, shape (n,).
    edge, stall_type, use
        Index of each in `EDGES`, `STALL_TYPES` and `STALL_USES`; uint8, shape (n,).
    centre_m, size_m
        (x, z) of the centre, and width and length; float64, shape (n, 2).
    yaw_rad
        Rotation of each stall about +Y; float64, shape (n,).
    angle_deg
        Angle of each stall's long sides to its lane; float64, shape (n,).
    turn
        1 for a stall entered by a right turn, else -1; int8, shape (n,).
    size
        Index of the size class in `STALL_SIZES`; uint8, shape (n,).
    number
        Painted number as text; shape (n,).
    """

    def __init__(self, stalls: Iterable[PlacedStall]) -> None:
        stalls = tuple(stalls)
        self.square = np.array([stall.square for stall in stalls], dtype=np.int32).reshape(-1, 2)
        self.ordinal = np.array([stall.ordinal for stall in stalls], dtype=np.uint16)
        self.edge = np.array([stall.edge for stall in stalls], dtype=np.uint8)
        self.stall_type = np.array([_TYPE_NUMBERS[stall.stall_type] for stall in stalls], dtype=np.uint8)
        self.use = np.array([_USE_NUMBERS[stall.use] for stall in stalls], dtype=np.uint8)
        self.centre_m = np.array([stall.centre_m for stall in stalls], dtype=np.float64).reshape(-1, 2)
        self.size_m = np.array([(stall.width_m, stall.length_m) for stall in stalls]).reshape(-1, 2)
        self.yaw_rad = np.array([stall.yaw_rad for stall in stalls], dtype=np.float64)
        self.angle_deg = np.array([stall.angle_deg for stall in stalls], dtype=np.float64)
        self.turn = np.array([stall.turn for stall in stalls], dtype=np.int8)
        self.size = np.array([_SIZE_NUMBERS[stall.size] for stall in stalls], dtype=np.uint8)
        self.number = np.array([stall.number for stall in stalls], dtype=np.str_)

    def __len__(self) -> int:
        """Number of stalls."""
        return len(self.edge)

    @property
    def takes_cars(self) -> NDArray[np.bool_]:
        """True if cars park in each stall; bool, shape (n,)."""
        return np.array([use.takes_cars for use in STALL_USES])[self.use]

    @property
    def access_square(self) -> NDArray[np.int32]:
        """(row, col) of the lane square at each stall's entry; int32, shape (n, 2)."""
        return self.square + np.array(NEIGHBOUR_STEPS, dtype=np.int32)[self.edge]

    def names(self) -> list[str]:
        """Ids of all stalls."""
        rows, cols = self.square.T.tolist()
        return list(map(stall_name, zip(rows, cols, strict=True), self.ordinal.tolist()))

    def at(self, rows: NDArray[np.intp]) -> list[PlacedStall]:
        """Return the stalls at some rows of the table."""
        columns = (
            map(tuple, self.square[rows].tolist()),
            self.ordinal[rows].tolist(),
            (EDGES[edge] for edge in self.edge[rows].tolist()),
            (STALL_TYPES[stall_type] for stall_type in self.stall_type[rows].tolist()),
            map(tuple, self.centre_m[rows].tolist()),
            *self.size_m[rows].T.tolist(),
            self.yaw_rad[rows].tolist(),
            (STALL_USES[use] for use in self.use[rows].tolist()),
            map(str, self.number[rows].tolist()),
            self.angle_deg[rows].tolist(),
            self.turn[rows].tolist(),
            (STALL_SIZES[size] for size in self.size[rows].tolist()),
        )
        return list(map(PlacedStall, *columns))
