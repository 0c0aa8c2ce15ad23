"""Compiled hill climbing: flips of single squares and of straight pairs that make a plan worth more."""

import numba as nb
import numpy as np

from garage2usd.planning.kernel import lanes_connected, next_random, untouched_portal, value_of

__all__ = ["climb"]


@nb.njit(cache=True)
def climb(kind, capacity, stride, squares, entrances, portals, weights, seed, passes):
    """Improve a feasible matrix in place by flips of one square or of a straight pair; returns its value."""
    random = np.array([seed], dtype=np.uint64)
    distance = np.empty(len(kind), dtype=np.int32)
    queue = np.empty(len(kind), dtype=np.int64)
    order = squares.copy()
    value, _n, _t, _u = value_of(kind, capacity, stride, entrances, squares, weights, distance, queue)
    steps = (0, stride, 1)
    for _ in range(passes):
        for index in range(len(order) - 1, 0, -1):
            other = int(next_random(random) % np.uint64(index + 1))
            order[index], order[other] = order[other], order[index]
        improved = False
        for q in order:
            for step in steps:
                p = q + step
                if kind[q] != 0 and kind[q] != 1:
                    continue
                if kind[p] != 0 and kind[p] != 1:
                    continue
                kind[q] = 1 - kind[q]
                if step != 0:
                    kind[p] = 1 - kind[p]
                better = untouched_portal(kind, portals, stride) < 0
                if better:
                    tried, _n, _t, _u = value_of(kind, capacity, stride, entrances, squares, weights, distance, queue)
                    better = tried > value + 1e-9 and lanes_connected(kind, squares, stride, distance, queue)
                if better:
                    value = tried
                    improved = True
                else:
                    kind[q] = 1 - kind[q]
                    if step != 0:
                        kind[p] = 1 - kind[p]
        if not improved:
            break
    return value
