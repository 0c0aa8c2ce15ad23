"""Ground that agents reserve: a raster of each level and ramp, each cell held by one car or by people.

Two agents never hold the same cell, and an agent is always within its own, so that no two touch.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.native import Float64Table, Int64s, Int64Table, elementary, in_c

Cells = NDArray[np.int64]
Floats = NDArray[np.float64]
CELL_M = 0.2
MARGIN_M = 0.06
"""Margin around each car within its cells: two cars are at least twice as far apart."""
_BEYOND_M = 40.0
"""Reach of the ground beyond lanes and stalls: ramps to the street."""
_USUAL_CELLS = 700


class _Slices(NamedTuple):
    """Poses (x, z, sine and cosine of the yaw) and their layers, and the number of poses of a slice of a path."""

    poses: Float64Table
    layers: Int64Table
    step: int


class _Layers(NamedTuple):
    """Least column and row, columns, rows and first cell of each layer, and the size of a cell."""

    of: Int64Table
    cell_m: float


class _Found(NamedTuple):
    """Where the cells of each slice end, and the cells; filled by C."""

    ends: Int64s
    cells: Int64s


@in_c
def _write_cells(slices: _Slices, layers: _Layers, ahead: float, behind: float, half: float, found: _Found) -> int:
    raise NotImplementedError


class Raster:
    """The cells of all layers of a garage.

    Parameters
    ----------
    boxes
        Least and greatest (x, z) of each layer in metres; shape (layers, 2, 2).

    Attributes
    ----------
    size
        Number of cells.
    """

    def __init__(self, boxes: Floats) -> None:
        self._low = np.floor((boxes[:, 0] - _BEYOND_M) / CELL_M).astype(np.int64)
        size = np.ceil((boxes[:, 1] + _BEYOND_M) / CELL_M).astype(np.int64) - self._low + 1
        self._columns, self._rows = size[:, 0], size[:, 1]
        self._first = np.concatenate([[0], np.cumsum(size[:, 0] * size[:, 1])])
        self.size = int(self._first[-1])
        self._layers = np.ascontiguousarray(np.column_stack([self._low, size, self._first[:-1]]))

    def slices(self, poses: Floats, body: Floats, layers: Sequence[Sequence[int]], step: int) -> list[Cells]:
        """Return the cells that hold a car's outline with a margin along each slice of a path, ascending.

        Parameters
        ----------
        poses
            (x, z, yaw) of the rear axle; shape (n, 3).
        body
            Distance from the rear axle to nose and tail, and half the width; shape (3,).
        layers
            One or two layers of each pose.
        step
            Number of poses of a slice; its last one is also the first one of the next slice.
        """
        ahead, behind, half = (body + MARGIN_M + CELL_M * math.sqrt(0.5)).tolist()
        turned = [elementary.sin(poses[:, 2]), elementary.cos(poses[:, 2])]
        table = np.ascontiguousarray(np.concatenate([poses[:, :2], np.stack(turned, axis=1)], axis=1))
        both = np.array([(each[0], each[-1]) for each in layers])
        slices, of = _Slices(table, both, step), _Layers(self._layers, CELL_M)
        ends = np.zeros((len(poses) - 1) // step, dtype=np.int64)
        found = np.empty(_USUAL_CELLS * len(ends), dtype=np.int64)
        count = _write_cells(slices, of, ahead, behind, half, _Found(ends, found))
        if count > len(found):
            found = np.empty(count, dtype=np.int64)
            _write_cells(slices, of, ahead, behind, half, _Found(ends, found))
        return np.split(found[:count], ends[:-1])

    def discs(self, places: Floats, radius_m: float, layer: int) -> list[Cells]:
        """Return the cells that hold a disc at each (x, z); shape (n, 2)."""
        radius = radius_m + CELL_M * math.sqrt(0.5)
        steps = np.arange(-math.ceil(radius / CELL_M) - 1, math.ceil(radius / CELL_M) + 2)
        cols, rows = np.moveaxis(np.round(places / CELL_M).astype(np.int64)[:, :, None] + steps, 1, 0)
        away_x, away_z = cols * CELL_M - places[:, :1], rows * CELL_M - places[:, 1:]
        place, row, col = np.nonzero(np.hypot(away_x[:, None, :], away_z[:, :, None]) <= radius)
        numbers = self._number(cols[place, col], rows[place, row], layer)
        return np.split(numbers, np.searchsorted(place, np.arange(1, len(places))))

    def _number(self, col: Cells, row: Cells, layer: Cells | int) -> Cells:
        col = np.clip(col - self._low[layer, 0], 0, self._columns[layer] - 1)
        row = np.clip(row - self._low[layer, 1], 0, self._rows[layer] - 1)
        cells: Cells = self._first[layer] + row * self._columns[layer] + col
        return cells

    def marked(self, is_marked: NDArray[np.bool_], layer: int) -> Floats:
        """Return the middles (x, z) of marked cells of a layer; shape (n, 2)."""
        own = np.flatnonzero(is_marked[self._first[layer] : self._first[layer + 1]])
        return self._middles(own, layer)

    def places(self, cells: Cells, layer: int) -> Floats:
        """Return the middles (x, z) of those cells that are of a layer; shape (n, 2)."""
        own = cells[(cells >= self._first[layer]) & (cells < self._first[layer + 1])] - self._first[layer]
        return self._middles(own, layer)

    def _middles(self, own: Cells, layer: int) -> Floats:
        middles: Floats = (np.stack(np.divmod(own, self._columns[layer])[::-1], axis=1) + self._low[layer]) * CELL_M
        return middles


class Ground:
    """Who holds each cell of a raster.

    Parameters
    ----------
    raster
        The raster.

    Attributes
    ----------
    owner
        Number of the moving car that holds each cell; 0 for none. Parked cars hold none, as paths are proven clear of
        them.
    people
        Number of people who hold each cell.
    claims
        Number of cars that wait for people to leave each cell; nobody else walks onto it.
    """

    def __init__(self, raster: Raster) -> None:
        self.raster = raster
        self.owner = np.zeros(raster.size, dtype=np.int32)
        self._held = np.zeros(raster.size, dtype=np.int16)
        self.people = np.zeros(raster.size, dtype=np.int16)
        self.claims = np.zeros(raster.size, dtype=np.int16)

    def of_cars(self, layer: int) -> Floats:
        """Return the middles (x, z) of the cells of a layer that cars hold; shape (n, 2)."""
        return self.raster.marked(self.owner > 0, layer)

    def is_free(self, cells: Cells, agent: int) -> bool:
        """Return True if cells are held by nobody but a car itself."""
        owner = self.owner[cells]
        return bool(((owner == 0) | (owner == agent)).all()) and not self.people[cells].any()

    def hold(self, cells: Cells, agent: int) -> None:
        """Let a car hold cells that are free for it; each call is ended by one of `release`."""
        self.owner[cells] = agent
        self._held[cells] += 1

    def release(self, cells: Cells) -> None:
        """End one hold of a car on cells."""
        self._held[cells] -= 1
        self.owner[cells[self._held[cells] == 0]] = 0
