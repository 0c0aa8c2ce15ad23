"""100 random seeds over sizes 7x9 to 20x30: every garage builds, every stall is reached, nothing solid meets."""

import networkx as nx
import numpy as np
import pytest
from support.overlaps import assert_solid_objects_keep_apart
from support.soak import soak_but

from garage2usd.config import GarageConfig
from garage2usd.config.fittings import CEILING_ROOM_M
from garage2usd.pipeline import generate
from garage2usd.structure.grid import Cell


def settings(seed):
    rng = np.random.default_rng(seed)

    def draw(low, high):
        return int(rng.integers(low, high + 1))

    portals = draw(1, 2)
    clear_m = float(np.random.default_rng([seed, 1]).uniform(2.0, 2.8))
    room_m, column_m = np.random.default_rng([seed, 2]).uniform((CEILING_ROOM_M, 0.2), (2.0, 1.2)).tolist()
    return {
        "seed": seed,
        "site": {
            "height_cells": draw(7, 20),
            "width_cells": draw(9, 30),
            "rectangles": draw(0, 7),
            "entrances": portals,
            "exits": draw(1, 2),
            "obstacles": draw(0, 2),
        },
        "bay": {
            "column_widths_m": float(rng.uniform(5.5, 8.5)),
            "row_depths_m": float(rng.uniform(5.5, 8.5)),
            "column_size_m": column_m,
        },
        "fittings": {"clear_height_m": clear_m, "ceiling_height_m": max(2.4, clear_m + room_m)},
        # narrow bays and wide columns are drawn too, which no car gets between
        "plan": {
            "preset": "paper" if seed % 4 == 0 else "tuned",
            "episodes": 300,
            "unreachable_stalls": "keep",
        },
        "parking": {"occupancy": float(rng.uniform(0, 1)), "max_yaw_deg": 5.0},
    }


def reached(cells, kind):
    """Lane squares joined to a portal of a kind over lanes: an independent breadth-first search."""
    grid = nx.grid_2d_graph(*cells.shape)
    lanes = grid.subgraph([square for square in grid if cells[square] == Cell.LANE])
    found = set()
    for portal in map(tuple, np.argwhere(cells == kind).tolist()):
        for lane in grid[portal]:
            if cells[lane] == Cell.LANE:
                found |= nx.node_connected_component(lanes, lane)
    return found


@pytest.mark.parametrize("block", soak_but(1, range(10)))
def test_every_seed_builds_every_stall_is_reached_and_nothing_solid_meets(block):
    for seed in range(10 * block, 10 * block + 10):
        config = GarageConfig(**settings(seed))
        garage = generate(config)
        assert_solid_objects_keep_apart(garage.layout, config)
        cells = garage.plan.structure.cells
        both = reached(cells, Cell.ENTRANCE) & reached(cells, Cell.EXIT)
        assert garage.layout.stalls
        assert {stall.access_square for stall in garage.layout.stalls} <= both
        displaced = sum(len(core.stalls) for core in garage.layout.cores)
        assert len(garage.layout.stalls) + displaced == garage.plan.score.stalls
        for portal in np.argwhere(cells >= Cell.ENTRANCE):
            row, col = portal.tolist()
            around = [(row - 1, col), (row + 1, col), (row, col - 1), (row, col + 1)]
            assert any(square in both for square in around)
