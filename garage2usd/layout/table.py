"""All objects of a garage in columns, so that a million of them stay light and quick to go through."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, overload

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout.placement import ObjectKind, Placement

if TYPE_CHECKING:
    from garage2usd.layout.specs import Spec

__all__ = ["KINDS", "ObjectTable"]

KINDS = tuple(ObjectKind)
"""The kinds by the number that a table holds for each."""
_KIND_NUMBERS = {kind: number for number, kind in enumerate(KINDS)}


class ObjectTable(Sequence[Placement]):
    """The objects of a garage: a sequence of placements, and its columns as arrays.

    Attributes
    ----------
    specs, names
        The different shapes and names.
    kind, spec, name
        Number of each object's kind in `KINDS`, of its shape in `specs` and of its name in `names`; shape (n,).
    position_m
        (x, y, z) of each; float64, shape (n, 3).
    yaw_rad
        Turn of each about +Y; float64, shape (n,).
    square
        (row, col) of the tile of each, (-1, -1) for what belongs to the building; int32, shape (n, 2).
    """

    def __init__(self, placements: Iterable[Placement]) -> None:
        """Take the columns out of placements."""
        placements = list(placements)
        specs: dict[Spec, int] = {}
        names: dict[str, int] = {}
        self.kind = np.array([_KIND_NUMBERS[place.kind] for place in placements], dtype=np.uint8)
        self.spec = np.array([specs.setdefault(place.spec, len(specs)) for place in placements], dtype=np.int32)
        self.name = np.array([names.setdefault(place.name, len(names)) for place in placements], dtype=np.int32)
        self.position_m = np.array([place.position_m for place in placements], dtype=np.float64).reshape(-1, 3)
        self.yaw_rad = np.array([place.yaw_rad for place in placements], dtype=np.float64)
        self.square = np.array([place.square or (-1, -1) for place in placements], dtype=np.int32).reshape(-1, 2)
        self.specs = tuple(specs)
        self.names = tuple(names)

    def __len__(self) -> int:
        """Number of objects."""
        return len(self.kind)

    @overload
    def __getitem__(self, index: int) -> Placement: ...

    @overload
    def __getitem__(self, index: slice) -> list[Placement]: ...

    def __getitem__(self, index: int | slice) -> Placement | list[Placement]:
        """One placement, or those of a slice."""
        if isinstance(index, slice):
            return self.at(np.arange(len(self))[index])
        return self.at(np.array([range(len(self))[index]]))[0]

    def __iter__(self) -> Iterator[Placement]:
        """All placements in order."""
        return iter(self.at(np.arange(len(self))))

    def at(self, rows: NDArray[np.intp]) -> list[Placement]:
        """The placements in some rows."""
        columns = (self.name, self.kind, self.spec, self.position_m, self.yaw_rad, self.square)
        return [
            Placement(
                self.names[name],
                KINDS[kind],
                self.specs[spec],
                (x, y, z),
                yaw,
                (row, col) if row >= 0 else None,
            )
            for name, kind, spec, (x, y, z), yaw, (row, col) in zip(
                *(column[rows].tolist() for column in columns), strict=True
            )
        ]

    def rows_of(self, *kinds: ObjectKind) -> NDArray[np.intp]:
        """Numbers of the rows that hold objects of some kinds."""
        return np.flatnonzero(np.isin(self.kind, [_KIND_NUMBERS[kind] for kind in kinds]))
