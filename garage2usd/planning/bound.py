"""An upper bound of the score by counting, for sites too large for the proven optimum."""

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning.ground import ground_of
from garage2usd.planning.optimum import free_hops
from garage2usd.structure.grid import Structure

__all__ = ["counting_bound"]


def counting_bound(site: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> float:
    """A value of y' that no feasible structure on a site exceeds.

    Notes
    -----
    L lanes have ``4 L`` edges; joined to one piece they spend ``2 (L - 1)`` on each other and at least one on each of
    P portals, so they serve ``F <= 2 L + 2 - P`` squares. With ``F + L <= A`` free squares ``F <= (2 A + 2 - P) / 3``.

    The same holds for the lanes within h hops of an entrance: their pieces, at most the K free squares beside an
    entrance, serve ``F_h <= 2 L_h + K`` squares, and all of these are among the B squares that a way of h + 1 hops over
    free squares reaches. So at most ``(2 B + K) / 3`` squares have a parking time of h + 1, which bounds T_S from
    below; where squares hold different numbers of stalls, the least time does. U_S is at least 0.
    """
    ground = ground_of(site, bay=bay, plan=plan or PlanConfig())
    squares = ground.squares
    served = min(len(squares), max(0, (2 * len(squares) + 2 - len(ground.portals)) // 3))
    most = np.sort(ground.capacity[squares].max(axis=1))[::-1][:served]
    if not served or not most[0]:
        return 0.0
    stalls = np.cumsum(most)
    if most[-1] == most[0]:
        hops = free_hops(ground)[squares]
        reached = np.cumsum(np.bincount(hops[hops < len(ground.cells)]))
        nearest = np.searchsorted((2 * reached + (hops == 1).sum()) // 3, np.arange(1, served + 1))
        times = np.cumsum(np.maximum(nearest, 2)) / np.arange(1, served + 1)
    else:
        times = np.full(served, 2.0)
    return float((ground.weights[0] * stalls + ground.weights[1] * times).max())
