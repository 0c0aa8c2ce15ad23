"""Which prim each object of a layout becomes: on a tile, in a group of the building, or a point of an instancer."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout import Layout
from garage2usd.layout.table import compact
from garage2usd.objects import KINDS
from garage2usd.structure.grid import Cell
from garage2usd.structure.lane_graph import Square

__all__ = ["ROOT_NAME", "Arrangement", "arrange", "row_name", "tile_name"]

ROOT_NAME = "Garage"

_AT_CORNERS = {"column": "Column"}
"""Names of what stands where four tiles meet: where tiles share prototypes, it belongs to the first of them."""


@dataclass(frozen=True, eq=False)
class Arrangement:
    """The prims of the objects, which are given by their rows in ``layout.placements``.

    Attributes
    ----------
    nested
        Whether equal tiles share a prototype.
    squares
        (row, col) of each tile, in reading order; shape (tiles, 2).
    origins_m
        (x, z) of each tile's origin, the middle of its square; float64, shape (tiles, 2).
    order, borders
        Rows of all objects by tile, and where in it each tile begins and the last one ends.
    groups
        Rows of the objects of each group of the building.
    scattered
        Rows of the objects of each point instancer, in the order of its points.
    names
        The different names, as ASCII; shape (names,).
    name
        Number of each object's name in `names`; shape (n,).
    """

    nested: bool
    squares: NDArray[np.intp]
    origins_m: NDArray[np.float64]
    order: NDArray[np.int32]
    borders: NDArray[np.intp]
    groups: dict[str, NDArray[np.intp]]
    scattered: dict[str, NDArray[np.intp]]
    names: NDArray[np.bytes_]
    name: NDArray[np.signedinteger[Any]]

    def on_tile(self, tile: int) -> NDArray[np.int32]:
        """Rows of the objects of a tile."""
        return self.order[self.borders[tile] : self.borders[tile + 1]]

    def on_all_tiles(self) -> NDArray[np.int32]:
        """Rows of the objects of all tiles, one tile after the other."""
        return self.order[self.borders[0] : self.borders[-1]]

    def on_tiles(self) -> Iterator[NDArray[np.int32]]:
        """Rows of the objects of each tile in turn."""
        return (self.order[start:end] for start, end in pairwise(self.borders.tolist()))

    def paths(self) -> list[str]:
        """Path of each object's prim; for a scattered one the instancer's, and the number of its point in brackets."""
        paths = [""] * len(self.name)
        for parent, rows in self._parents():
            for row, name in zip(rows.tolist(), self.name[rows].tolist(), strict=True):
                paths[row] = f"{parent}/{self.names[name].decode('ascii')}"
        for instancer, rows in self.scattered.items():
            for point, row in enumerate(rows.tolist()):
                paths[row] = f"/{ROOT_NAME}/{instancer}[{point}]"
        return paths

    def _parents(self) -> Iterator[tuple[str, NDArray[np.intp]]]:
        for (row, col), rows in zip(self.squares.tolist(), self.on_tiles(), strict=True):
            yield f"/{ROOT_NAME}/Tiles/{row_name(row)}/{tile_name((row, col))}", rows
        for group, rows in self.groups.items():
            yield f"/{ROOT_NAME}/{group}", rows


def arrange(layout: Layout, *, nested: bool) -> Arrangement:
    """Assign each object to a prim.

    Parameters
    ----------
    layout
        The objects.
    nested
        Whether equal tiles share a prototype. Columns then belong to tiles, and what makes all tiles different is
        scattered.
    """
    objects, structure = layout.placements, layout.structure
    squares = np.argwhere(structure.cells != Cell.OBSTACLE)
    tile_of_square = np.full(structure.shape, -1)
    tile_of_square[tuple(squares.T)] = np.arange(len(squares))
    rows, cols = objects.square.T
    tile = np.where(rows >= 0, tile_of_square[rows, cols], -1)
    names, name = objects.names, objects.name
    scattered = {}
    if nested:
        for corner_kind, common_name in _AT_CORNERS.items():
            at = objects.rows_of(corner_kind)
            corner_x, _, corner_z = objects.position_m[at].T
            # a corner is a border's number; the tile before it has that number less one
            row = np.searchsorted(structure.row_edges_m, corner_z - _BORDER_TOLERANCE_M) - 1
            col = np.searchsorted(structure.column_edges_m, corner_x - _BORDER_TOLERANCE_M) - 1
            tile[at] = tile_of_square[row, col]
            name = name.astype(np.int32)
            name[at] = len(names)
            names = np.append(names, np.bytes_(common_name))
        for kind in KINDS:
            at = objects.rows_of(kind.name)
            if kind.scattered and len(at):
                scattered[kind.scattered] = at
                tile[at] = -2
                name[at] = 0
        # most names were those of what is scattered and of columns
        used = np.bincount(name, minlength=len(names)) > 0
        names, name = names[used], compact(np.cumsum(used) - 1)[name]
    order = np.argsort(tile, kind="stable").astype(np.int32)
    borders = np.searchsorted(tile[order], np.arange(len(squares) + 1))
    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (structure.column_edges_m, structure.row_edges_m)]
    origins = np.stack([middles[0][squares[:, 1]], middles[1][squares[:, 0]]], axis=1)
    return Arrangement(
        nested,
        squares,
        origins,
        order,
        borders,
        _grouped(layout, np.flatnonzero(tile == -1)),
        scattered,
        names,
        name,
    )


_BORDER_TOLERANCE_M = 1e-6


def row_name(row: int) -> str:
    """Name of the group of a row of tiles."""
    return f"Row_r{row:02d}"


def tile_name(square: Square) -> str:
    """Name of a tile's prim."""
    return f"Tile_r{square[0]:02d}_c{square[1]:02d}"


def _grouped(layout: Layout, rows: NDArray[np.intp]) -> dict[str, NDArray[np.intp]]:
    """Rows of what belongs to the building, by group, in the order of their first objects."""
    kinds = layout.placements.kind[rows]
    group_of_kind = np.array([kind.group for kind in KINDS])
    groups = group_of_kind[kinds]
    return {group: rows[groups == group] for group in dict.fromkeys(groups.tolist())}
