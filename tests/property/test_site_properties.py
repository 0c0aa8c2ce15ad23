import networkx as nx
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.config import BayConfig, SiteConfig
from garage2usd.site import make_site
from garage2usd.structure.grid import Cell

sites = st.builds(
    dict,
    width_cells=st.integers(9, 30),
    height_cells=st.integers(7, 20),
    rectangles=st.integers(0, 8),
    entrances=st.integers(1, 2),
    exits=st.integers(1, 2),
    obstacles=st.integers(0, 2),
)


@settings(max_examples=80, deadline=None)
@given(sites, st.integers(0, 2**32))
def test_every_site_keeps_the_paper_s_rules(kwargs, seed):
    config = SiteConfig(**kwargs)
    cells = make_site(config, bay=BayConfig(), seed=seed).cells
    again = make_site(config, bay=BayConfig(), seed=seed).cells
    assert (cells == again).all()

    assert cells.shape == config.shape
    assert (cells == Cell.ENTRANCE).sum() == config.entrances
    assert (cells == Cell.EXIT).sum() == config.exits
    assert not (cells == Cell.LANE).any()

    padded = np.pad(cells, 1, constant_values=-1)
    portals = np.argwhere(cells >= 2)
    for index, (row, col) in enumerate(portals):
        around = padded[row : row + 3, col : col + 3]
        sides = around[0], around[2], around[:, 0], around[:, 2]
        assert sum((side == -1).all() for side in sides) == 1
        assert (around[1, [0, 2]] == 0).any() or (around[[0, 2], 1] == 0).any()
        for other in portals[:index]:
            assert np.abs(other - (row, col)).sum() >= config.min_portal_distance_cells

    grid = nx.grid_2d_graph(*cells.shape)
    free = grid.subgraph([square for square in grid if cells[square] == Cell.FREE])
    assert nx.is_connected(free)
    inside = (cells != Cell.OBSTACLE).sum() + config.obstacles
    assert inside >= cells.size * (config.min_fill if config.rectangles else 1)
