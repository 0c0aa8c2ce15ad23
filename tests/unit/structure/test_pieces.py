import numpy as np
import pytest
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from garage2usd.structure.squares import joined, pieces_of


@pytest.mark.parametrize("share", [0.0, 0.3, 0.55, 0.8, 1.0])
def test_pieces_are_those_of_scipy(share):
    rng = np.random.default_rng(3)
    for _ in range(60):
        mask = rng.random(rng.integers(1, 25, size=2)) < share
        numbers, count = pieces_of(mask)
        expected, expected_count = ndimage.label(mask)
        assert (numbers == expected).all()
        assert count == expected_count


def test_a_winding_path_is_one_piece():
    mask = np.ones((41, 41), dtype=bool)
    mask[1::4, :-1] = mask[3::4, 1:] = False
    assert pieces_of(mask)[1] == 1
    mask[1, -1] = False
    assert pieces_of(mask)[1] == 2


@pytest.mark.parametrize("pairs", [0, 20, 60, 200])
def test_joined_are_told_by_their_lowest(pairs):
    rng = np.random.default_rng(pairs)
    first, second = rng.integers(0, 80, size=(2, pairs))
    labels = connected_components(coo_array((np.ones(pairs), (first, second)), (80, 80)), directed=False)[1]
    expected = [np.flatnonzero(labels == label)[0] for label in labels]
    assert joined(80, first, second).tolist() == expected
