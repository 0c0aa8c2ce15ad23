"""Patterns of textures: cells against a search tree, thin lines against their true width."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from garage2usd.assets.fields import cells, joint, strokes, trowel_marks

SHAPE = 96, 120


def generator():
    return np.random.Generator(np.random.PCG64(7))


def test_cells_are_those_of_the_nearest_points_and_end_where_two_are_as_far():
    found = cells(generator(), SHAPE, (6, 5))
    rng = generator()
    jitter = [rng.integers(0, 1024, size=(6, 5)) / 1024 for _ in range(2)]
    places = np.stack(
        [(np.arange(6)[:, None] + jitter[0]) * (96 / 6), (np.arange(5)[None, :] + jitter[1]) * (120 / 5)], axis=2
    )
    rows, columns = np.indices(SHAPE)
    points = places.reshape(-1, 2)
    away, which = cKDTree(points, boxsize=SHAPE).query(np.stack([rows, columns], axis=2).reshape(-1, 2), k=2)
    # of the nearest lattice cells alone, so that a point two cells away may be nearer in few places
    same = found.which.ravel() == which[:, 0]
    assert same.mean() > 0.98
    assert found.from_point.ravel()[same] == pytest.approx(away[same, 0])
    assert (found.from_edge >= 0).all()
    border = found.which != np.roll(found.which, 1, axis=1)
    assert found.from_edge[border].max() <= 1.0


@pytest.mark.parametrize("width", [0.05, 0.4, 1.0, 2.5])
@pytest.mark.parametrize("place", [10.0, 10.3, 10.5])
def test_a_line_covers_as_much_as_it_is_wide(width, place):
    assert joint(np.abs(np.arange(21) - place), width).sum() == pytest.approx(width)


def test_strokes_and_marks_repeat_and_are_the_same_each_time():
    for draw in (
        lambda rng: strokes(rng, SHAPE, 9, (20.0, 60.0), (0.5, 6.0)),
        lambda rng: trowel_marks(rng, SHAPE, 9, (20.0, 40.0), 4.0),
    ):
        field = draw(generator())
        assert (field == draw(generator())).all()
        assert np.abs(field).max() > 0.2
        for axis in (0, 1):
            steps = np.abs(field - np.roll(field, 1, axis=axis)).mean(axis=1 - axis)
            assert steps[0] <= 1.5 * steps.max()
