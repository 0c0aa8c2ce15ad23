"""Grids with a border, against NumPy's own."""

import numpy as np
import pytest

from garage2usd.structure.squares import bordered


@pytest.mark.parametrize(("dtype", "value"), [(np.bool_, True), (np.int8, -1), (np.int64, 0)])
def test_a_border_is_that_of_numpy(dtype, value):
    grid = np.random.default_rng(0).integers(0, 2, (3, 5)).astype(dtype)
    found = bordered(grid, value)
    np.testing.assert_array_equal(found, np.pad(grid, 1, constant_values=value))
    assert found.dtype == grid.dtype
