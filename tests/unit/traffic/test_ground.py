"""The cells of a car on its way, against all cells tested one by one."""

import numpy as np
import pytest

from garage2usd.traffic.ground import CELL_M, MARGIN_M, Ground, Raster

_BODY = np.array([3.7, 1.1, 0.9])
_RASTER = Raster(np.array([[[-3.0, -2.0], [4.0, 5.0]], [[0.0, 0.0], [9.0, 3.0]]]))


def _covered(poses, layer):
    """Numbers of the cells of a layer whose middles the outline covers at some pose."""
    low, size, first = _RASTER._layers[layer, :2], _RASTER._layers[layer, 2:4], int(_RASTER._layers[layer, 4])
    cols, rows = np.meshgrid(np.arange(size[0]), np.arange(size[1]))
    ahead, behind, half = _BODY + MARGIN_M + CELL_M * np.sqrt(0.5)
    found = np.zeros(cols.shape, dtype=bool)
    for x, z, yaw in poses:
        away_x, away_z = (cols + low[0]) * CELL_M - x, (rows + low[1]) * CELL_M - z
        forward = -np.sin(yaw) * away_x - np.cos(yaw) * away_z
        left = -np.cos(yaw) * away_x + np.sin(yaw) * away_z
        found |= (forward <= ahead) & (forward >= -behind) & (np.abs(left) <= half)
    return first + np.flatnonzero(found)


@pytest.mark.parametrize("seed", range(4))
def test_cells_of_slices_are_those_that_the_outline_covers(seed):
    draw = np.random.default_rng(seed)
    poses = np.cumsum(draw.uniform(-0.5, 0.5, (9, 3)), axis=0)
    layers = [(0,), (0,), (0,), (0, 1), (0, 1), (1, 0), (1,), (1,), (1,)]
    found = _RASTER.slices(poses, _BODY, layers, 2)
    assert len(found) == 4
    for number, cells in enumerate(found):
        own = range(2 * number, 2 * number + 3)
        parts = [_covered([poses[each] for each in own if layer in layers[each]], layer) for layer in (0, 1)]
        assert np.array_equal(cells, np.concatenate(parts))


def test_ground_is_free_again_once_each_hold_is_released():
    ground = Ground(_RASTER)
    cells = np.array([3, 4, 5])
    ground.hold(cells, 1)
    ground.hold(cells[:2], 1)
    assert ground.is_free(cells, 1)
    assert not ground.is_free(cells, 2)
    ground.release(cells)
    assert not ground.is_free(cells, 2)
    ground.release(cells[:2])
    assert ground.is_free(cells, 2)
    assert not ground.owner.any()
