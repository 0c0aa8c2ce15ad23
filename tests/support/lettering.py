"""What is written on a mesh, by its shape."""

import numpy as np
import shapely

from garage2usd.assets.glyphs import text_shape

GRID_M = 1e-5


def outline(points, counts, indices):
    """The faces of a mesh seen from the front, as one shape in (x, y) with y upwards."""
    faces = np.split(np.asarray(indices), np.cumsum(counts)[:-1])
    flat = np.asarray(points)[:, :2].astype(float)
    return shapely.union_all([shapely.Polygon(flat[face]) for face in faces], grid_size=GRID_M)


def agreement(shape, word):
    """Share of the area that a shape has in common with a word as large, in the same place."""
    low_x, low_y, high_x, high_y = shape.bounds
    text = shapely.transform(text_shape(word, 1.0), lambda points: points * (1, -1))
    x0, y0, x1, y1 = text.bounds
    fit = shapely.transform(
        text,
        lambda points: (points - (x0, y0)) / (x1 - x0, y1 - y0) * (high_x - low_x, high_y - low_y) + (low_x, low_y),
    )
    return shape.intersection(fit).area / shape.union(fit).area


def read(shape, words):
    """The one of some words that a shape shows."""
    best = max(words, key=lambda word: agreement(shape, word))
    assert agreement(shape, best) > 0.9
    return best
