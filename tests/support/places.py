"""Comparing where things stand with where they should stand."""

import numpy as np
from scipy.spatial import KDTree

MILLIMETRE = 0.001


def place_of_part(placement, part):
    """Where the origin of a part's mesh stands, (x, y, z): that of its object, or of its own pose in it."""
    x_m, y_m, z_m, _ = part.pose or (0.0, 0.0, 0.0, 0.0)
    ground = placement.to_world((x_m, z_m))
    return ground[0], placement.position_m[1] + y_m, ground[1]


def assert_same_places(found, expected, tolerance_m=MILLIMETRE):
    """Two collections of points, in any order, are the same within a tolerance; several may lie at one place."""
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    assert len(found) == len(expected)
    if not len(expected):
        return
    # what lies at one place lies there as often in both
    trees = KDTree(found), KDTree(expected)
    there, here = (tree.query_ball_point(expected, tolerance_m, return_length=True) for tree in trees)
    assert (there == here).all()
    assert trees[1].query(found)[0].max() < tolerance_m
