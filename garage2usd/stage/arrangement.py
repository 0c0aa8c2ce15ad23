"""Assignment of a layout's objects to prims of the stage: tiles, groups of the building, or point instancers."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage.levels import GARAGE_NAME
from garage2usd.layout import Layout
from garage2usd.layout.table import compact
from garage2usd.objects import KINDS, TilePart
from garage2usd.structure.grid import Cell, Structure

_FIRST_NAMES = {
    "column": "Column",
    "hydrant_cabinet": "HydrantCabinet",
    "fire_extinguisher": "FireExtinguisher",
}
"""Kinds of the building that belong to a tile if tiles share prototypes, and the name of the first object on a tile. A
column, where four tiles meet, belongs to the first of them."""


@dataclass(frozen=True, eq=False)
class Arrangement:
    """Prims of the objects, which are identified by their rows in ``layout.placements``.

    Attributes
    ----------
    parts
        Names of the parts of a tile that equal tiles share; empty if tiles share no prototypes.
    squares
        (row, col) of each tile, in reading order; shape (tiles, 2).
    origins_m
        (x, z) of each tile's origin, the centre of its square; float64, shape (tiles, 2).
    order, borders
        Rows of all objects sorted by tile and part, and the start of each part in them, with the total length at the
        end.
    groups
        Rows of the objects of each group of the building.
    scattered
        Rows of the objects of each point instancer, in the order of its points.
    names
        Distinct names, as ASCII; shape (names,).
    name
        Index of each object's name in `names`; shape (n,).
    """

    parts: tuple[str, ...]
    squares: NDArray[np.intp]
    origins_m: NDArray[np.float64]
    order: NDArray[np.int32]
    borders: NDArray[np.intp]
    groups: dict[str, NDArray[np.intp]]
    scattered: dict[str, NDArray[np.intp]]
    names: NDArray[np.bytes_]
    name: NDArray[np.signedinteger[Any]]

    @property
    def nested(self) -> bool:
        """True if equal tiles share a prototype."""
        return bool(self.parts)

    def on_part(self, part: int) -> NDArray[np.int32]:
        """Rows of the objects of a part; parts are numbered consecutively from tile to tile."""
        return self.order[self.borders[part] : self.borders[part + 1]]

    def on_all_tiles(self) -> NDArray[np.int32]:
        """Rows of the objects of all tiles, tile by tile."""
        return self.order[self.borders[0] : self.borders[-1]]

    def paths(self) -> list[str]:
        """Prim path of each object; for a point of an instancer, its path and the point's index in brackets."""
        paths = [""] * len(self.name)
        for parent, rows in self._parents():
            for row, name in zip(rows.tolist(), self.name[rows].tolist(), strict=True):
                paths[row] = f"{parent}/{self.names[name].decode('ascii')}"
        for instancer, rows in self.scattered.items():
            for point, row in enumerate(rows.tolist()):
                paths[row] = f"/{GARAGE_NAME}/{instancer}[{point}]"
        return paths

    def _parents(self) -> Iterator[tuple[str, NDArray[np.intp]]]:
        tiles = (f"/{GARAGE_NAME}/Tiles/{row_name(row)}/{tile_name(row, col)}" for row, col in self.squares.tolist())
        groups = (f"{tile}/{part}" for tile in tiles for part in self.parts) if self.parts else tiles
        for group, (start, end) in zip(groups, pairwise(self.borders.tolist()), strict=True):
            yield group, self.order[start:end]
        for group, rows in self.groups.items():
            yield f"/{GARAGE_NAME}/{group}", rows


def arrange(layout: Layout, *, nested: bool) -> Arrangement:
    """Assign each object to a prim.

    Parameters
    ----------
    layout
        The objects.
    nested
        True if equal tiles share a prototype, and different tiles the prototypes of equal parts. Columns and their
        fittings then belong to tiles, and objects that would make every tile unique go to point instancers.
    """
    objects, structure = layout.placements, layout.structure
    squares = np.argwhere(structure.cells != Cell.OBSTACLE)
    tile_of_square = np.full(structure.shape, -1)
    tile_of_square[tuple(squares.T)] = np.arange(len(squares))
    rows, cols = objects.square.T
    tile = np.where(rows >= 0, tile_of_square[rows, cols], -1)
    names, name = objects.names, objects.name
    parts: tuple[str, ...] = ()
    part = np.zeros(len(tile), np.intp)
    scattered = {}
    if nested:
        parts = tuple(TilePart)
        part = np.array([parts.index(kind.part) for kind in KINDS])[objects.kind]
        name = name.astype(np.int32)
        for kind_name, first_name in _FIRST_NAMES.items():
            at = objects.rows_of(kind_name)
            on = tile_of_square[tuple(_squares_at(structure, objects.position_m[at]))]
            at, on = at[on >= 0], on[on >= 0]
            number = _numbers_among_equals(on)
            tile[at], name[at] = on, len(names) + number
            further = [f"{first_name}_{nth}" for nth in range(2, number.max(initial=0) + 2)]
            names = np.append(names, np.array([first_name, *further], dtype=np.bytes_))
        for kind in KINDS:
            if kind.scattered and len(at := objects.rows_of(kind.name)):
                scattered[kind.scattered] = at
                tile[at] = -2
                name[at] = 0
        # drops names that only points of instancers and columns had
        used = np.bincount(name, minlength=len(names)) > 0
        names, name = names[used], compact(np.cumsum(used) - 1)[name]
    width = max(len(parts), 1)
    key = np.where(tile >= 0, tile * width + part, tile)
    order = np.argsort(key, kind="stable").astype(np.int32)
    borders = np.searchsorted(key[order], np.arange(len(squares) * width + 1))
    middles = [(edges[1:] + edges[:-1]) / 2 for edges in (structure.column_edges_m, structure.row_edges_m)]
    origins = np.stack([middles[0][squares[:, 1]], middles[1][squares[:, 0]]], axis=1)
    return Arrangement(
        parts,
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


def _squares_at(structure: Structure, position_m: NDArray[np.float64]) -> NDArray[np.intp]:
    """Rows and columns of the squares at positions, the first square for a position on a border; shape (2, n)."""
    x, _, z = position_m.T - _BORDER_TOLERANCE_M
    edges_m = (structure.row_edges_m, structure.column_edges_m)
    squares = [np.searchsorted(edges, at) - 1 for edges, at in zip(edges_m, (z, x), strict=True)]
    return np.clip(squares, 0, np.array(structure.shape)[:, None] - 1)


def _numbers_among_equals(values: NDArray[np.intp]) -> NDArray[np.intp]:
    """Number of equal values before each value."""
    order = np.argsort(values, kind="stable")
    _, first, group = np.unique(values[order], return_index=True, return_inverse=True)
    numbers = np.empty_like(values)
    numbers[order] = np.arange(len(values)) - first[group]
    return numbers


def row_name(row: int) -> str:
    """Return the name of the prim that groups a row of tiles."""
    return f"Row_r{row:02d}"


def tile_name(row: int, col: int) -> str:
    """Return the name of a tile's prim."""
    return f"Tile_r{row:02d}_c{col:02d}"


def _grouped(layout: Layout, rows: NDArray[np.intp]) -> dict[str, NDArray[np.intp]]:
    """Rows of the building's objects by group, in the order of the first object of each group."""
    kinds = layout.placements.kind[rows]
    group_of_kind = np.array([kind.group for kind in KINDS])
    groups = group_of_kind[kinds]
    return {group: rows[groups == group] for group in dict.fromkeys(groups.tolist())}
