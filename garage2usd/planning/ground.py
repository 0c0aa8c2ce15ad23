"""Ground: a site as flat arrays for the compiled loops."""

from typing import NamedTuple

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.config.plan import CirculationMode, DeadEnds
from garage2usd.native import Bools, Float64s, Int8s, Int32s, Int32Table, Int64s, Int64Table
from garage2usd.planning.circulation import CirculationRules, rules_of
from garage2usd.structure.dead_ends import DEAD_END_LIMIT_MM
from garage2usd.structure.grid import Cell, CellArray, Structure
from garage2usd.structure.stalls import capacity_table

__all__ = ["PADDING", "Ground", "Lanes", "capacity_by_edges", "cells_of", "ground_of", "lanes_of"]

PADDING = 4
"""Squares outside on each side of a site, as many as the widest window sees beyond one of its squares."""

Lanes = Bools
"""bool, shape (squares,): which of `Ground.squares` are lanes."""


class Ground(NamedTuple):
    """A site as flat arrays on a matrix padded with squares outside; a square is an index into them.

    Attributes
    ----------
    stride
        Squares in a padded row: the step from a square to the one below.
    cells
        int8, shape (padded,): values of `Cell`, no lanes.
    capacity
        int32, shape (padded, 16): stalls on the square if it is free, by its edges that are open to lanes, as the sum
        of 1 up, 2 down, 4 left, 8 right.
    sides_mm
        int64, shape (padded, 2): depth along Z and width along X.
    squares
        int64: the free squares in reading order.
    entrances, portals
        int64: squares with entrances, and with entrances then exits.
    weights
        float64, shape (3,): k_1, k_2, k_3 of the score.
    dead_end_cost
        What a dead-end aisle over `dead_end_limit_mm` costs beside the score.
    dead_end_limit_mm
        Length up to which a dead-end aisle is free.
    rules
        Rules of circulation.
    """

    stride: int
    cells: Int8s
    capacity: Int32Table
    sides_mm: Int64Table
    squares: Int64s
    entrances: Int64s
    portals: Int64s
    weights: Float64s
    dead_end_cost: float
    dead_end_limit_mm: int
    rules: CirculationRules


def ground_of(site: Structure, *, bay: BayConfig, plan: PlanConfig) -> Ground:
    """Flatten a site; its lanes, if any, become free squares."""
    static = np.where(site.cells == Cell.LANE, Cell.FREE, site.cells).astype(np.int8)
    cells = np.pad(static, PADDING, constant_values=Cell.OBSTACLE)
    flat = cells.ravel()
    depths = np.broadcast_to(site.row_depths_mm[:, None], site.shape)
    widths = np.broadcast_to(site.column_widths_mm, site.shape)
    squares = np.flatnonzero(flat == Cell.FREE)
    capacity = np.pad(capacity_by_edges(site, bay), [(PADDING, PADDING), (PADDING, PADDING), (0, 0)])
    # a turning stall lost, where rules leave no dead end that is so long
    keeps_turning_stalls = plan.dead_ends is DeadEnds.STANDARD and plan.circulation_mode is CirculationMode.ALLOW
    entrances, exits = np.flatnonzero(flat == Cell.ENTRANCE), np.flatnonzero(flat == Cell.EXIT)
    return Ground(
        stride=cells.shape[1],
        cells=flat,
        capacity=capacity.reshape(-1, capacity.shape[-1]),
        sides_mm=np.stack([np.pad(side, PADDING).ravel() for side in (depths, widths)], axis=1).astype(np.int64),
        squares=squares,
        entrances=entrances,
        portals=np.concatenate((entrances, exits)),
        weights=np.array([plan.stall_weight, plan.parking_time_weight, plan.unused_weight]),
        dead_end_cost=plan.stall_weight if keeps_turning_stalls else 0.0,
        dead_end_limit_mm=DEAD_END_LIMIT_MM,
        rules=rules_of(plan, squares=len(squares)),
    )


def lanes_of(structure: Structure, ground: Ground) -> Lanes:
    """Read the lanes of a structure on the same site."""
    flat = np.pad(structure.cells, PADDING, constant_values=Cell.OBSTACLE).ravel()
    lanes: Lanes = flat[ground.squares] == Cell.LANE
    return lanes


def cells_of(ground: Ground, lanes: Lanes) -> CellArray:
    """Build the structure matrix with lanes on some squares of the ground; int8, shape (rows, cols)."""
    padded = ground.cells.copy()
    padded[ground.squares[lanes]] = Cell.LANE
    return padded.reshape(-1, ground.stride)[PADDING:-PADDING, PADDING:-PADDING].copy()


def capacity_by_edges(site: Structure, bay: BayConfig) -> Int32s:
    """Tabulate the stalls on each square by its edges open to lanes as in `Ground.capacity`.

    int32, shape (rows, cols, 16).
    """
    table = capacity_table(site, bay)
    layers = []
    for edges in range(16):
        along_x = (0, table.along_x, table.along_x, table.along_x_double)[edges & 3]
        along_z = (0, table.along_z, table.along_z, table.along_z_double)[edges >> 2]
        layers.append(np.maximum(along_x, along_z) + np.zeros(site.shape, dtype=np.int64))
    return np.ascontiguousarray(np.stack(layers, axis=-1).astype(np.int32))
