"""Ground that agents reserve: a raster of each level and ramp, each cell held by one car or by people.

Two agents never hold the same cell, and an agent is always within its own, so that no two touch.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from garage2usd.native import elementary

Cells = NDArray[np.int64]
Floats = NDArray[np.float64]
CELL_M = 0.2
MARGIN_M = 0.06
"""Margin around each car within its cells: two cars are at least twice as far apart."""
_BEYOND_M = 40.0
"""Reach of the ground beyond lanes and stalls: ramps to the street."""


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

    def rectangles(self, poses: Floats, body: Floats, layers: Sequence[int]) -> list[Cells]:
        """Return the cells that hold a car's outline with a margin at each pose.

        Parameters
        ----------
        poses
            (x, z, yaw) of the rear axle; shape (n, 3).
        body
            Distance from the rear axle to nose and tail, and half the width; shape (3,).
        layers
            Layer of each pose; shape (n,).
        """
        ahead, behind, half = body + MARGIN_M + CELL_M * math.sqrt(0.5)
        reach = math.ceil(((ahead + behind) / 2 + half) / CELL_M) + 1
        sin, cos = elementary.sin(poses[:, 2]), elementary.cos(poses[:, 2])
        middle = (ahead - behind) / 2
        steps = np.arange(-reach, reach + 1)
        x, z = poses[:, 0], poses[:, 1]
        cols = np.round((x - sin * middle) / CELL_M).astype(np.int64)[:, None] + steps
        rows = np.round((z - cos * middle) / CELL_M).astype(np.int64)[:, None] + steps
        away_x, away_z = cols * CELL_M - x[:, None], rows * CELL_M - z[:, None]
        sin, cos = sin[:, None], cos[:, None]
        forward = (-sin * away_x)[:, None, :] + (-cos * away_z)[:, :, None]
        left = (-cos * away_x)[:, None, :] + (sin * away_z)[:, :, None]
        pose, row, col = np.nonzero((forward <= ahead) & (forward >= -behind) & (np.abs(left) <= half))
        layer = np.asarray(layers)[pose]
        numbers = self._number(cols[pose, col], rows[pose, row], layer)
        return np.split(numbers, np.searchsorted(pose, np.arange(1, len(poses))))

    def discs(self, places: Floats, radius_m: float, layer: int) -> list[Cells]:
        """Return the cells that hold a disc at each (x, z); shape (n, 2)."""
        radius = radius_m + CELL_M * math.sqrt(0.5)
        steps = np.arange(-math.ceil(radius / CELL_M) - 1, math.ceil(radius / CELL_M) + 2)
        found = []
        for x, z in places.tolist():
            col, row = round(x / CELL_M) + steps, round(z / CELL_M) + steps
            inside = np.hypot((col * CELL_M - x)[None, :], (row * CELL_M - z)[:, None]) <= radius
            at = np.nonzero(inside)
            found.append(self._number(col[at[1]], row[at[0]], layer))
        return found

    def _number(self, col: Cells, row: Cells, layer: Cells | int) -> Cells:
        col = np.clip(col - self._low[layer, 0], 0, self._columns[layer] - 1)
        row = np.clip(row - self._low[layer, 1], 0, self._rows[layer] - 1)
        cells: Cells = self._first[layer] + row * self._columns[layer] + col
        return cells

    def are_near(self, marked: NDArray[np.bool_], places: Floats, layer: int, radius_m: float) -> NDArray[np.bool_]:
        """Return True for places (x, z) of a layer within a distance of marked cells; shape (n,)."""
        own = slice(int(self._first[layer]), int(self._first[layer + 1]))
        reach = math.ceil(radius_m / CELL_M)
        steps = np.arange(-reach, reach + 1) * CELL_M
        disc = np.hypot(steps[:, None], steps[None, :]) <= radius_m
        near = binary_dilation(marked[own].reshape(int(self._rows[layer]), int(self._columns[layer])), disc)
        cells = np.round(places / CELL_M).astype(np.int64) - self._low[layer]
        found: NDArray[np.bool_] = near[cells[:, 1], cells[:, 0]]
        return found


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
    """

    def __init__(self, raster: Raster) -> None:
        self.raster = raster
        self.owner = np.zeros(raster.size, dtype=np.int32)
        self._held = np.zeros(raster.size, dtype=np.int16)
        self.people = np.zeros(raster.size, dtype=np.int16)

    def near_cars(
        self, places: Floats, layer: int, radius_m: float, *, wanted: Sequence[Cells] = ()
    ) -> NDArray[np.bool_]:
        """Return True for places (x, z) within a distance of ground that a car holds, or wants; shape (n,)."""
        held = self.owner > 0
        for cells in wanted:
            held[cells] = True
        return self.raster.are_near(held, places, layer, radius_m)

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


def united(cells: Iterable[Cells]) -> Cells:
    """Return the distinct cells of several sets."""
    found: Cells = np.unique(np.concatenate(list(cells)))
    return found
