"""Feet on a floor: how far shoes are from it, and how far they slide while they are on it."""

import numpy as np

_ON_FLOOR_M = 0.004


def heights_m(points, floor_m):
    """Height over the floor of the lowest point of both shoes in each frame; `points` has shape (frames, points, 3)."""
    return points[:, :, 1].min(axis=1) - floor_m


def slides_m(points, floor_m, least_frames=4):
    """Ways across the floor of points of shoes, each while it is on the floor without a break.

    The first and the last frame of each time are left out, as a foot lands and lifts between two frames.
    """
    found = []
    on = points[:, :, 1] < floor_m + _ON_FLOOR_M
    for number in np.flatnonzero(on.any(axis=0)):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], on[:, number], [False]]).astype(int))).reshape(-1, 2)
        for start, end in edges.tolist():
            if end - start >= least_frames:
                found.append(float(np.linalg.norm(np.ptp(points[start + 1 : end - 1, number][:, [0, 2]], axis=0))))
    return np.array(found)
