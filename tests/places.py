"""Comparing where things stand with where they should stand."""

import numpy as np
from scipy.spatial import KDTree

MILLIMETRE = 0.001


def assert_same_places(found, expected, tolerance_m=MILLIMETRE):
    """Two sets of points, in any order, are the same within a tolerance."""
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    assert len(found) == len(expected)
    if not len(expected):
        return
    distance, partner = KDTree(found).query(expected)
    assert distance.max() < tolerance_m
    assert len(set(partner.tolist())) == len(expected)
