"""An upper bound of the score by counting, for sites too large for the proven optimum."""

import numpy as np

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.grid import Structure
from garage2usd.planning.ground import ground_of
from garage2usd.planning.optimum import free_hops

__all__ = ["counting_bound"]


def counting_bound(site: Structure, *, bay: BayConfig, plan: PlanConfig | None = None) -> float:
    """A value of y' that no feasible structure on a site exceeds.

    Notes
    -----
    L lanes have ``4 L`` edges; joined to one piece they spend ``2 (L - 1)`` on each other and at least one on each of
    P portals, so they serve ``F <= 2 L + 2 - P`` squares. With ``F + L <= A`` free squares ``F <= (2 A + 2 - P) / 3``.
    No square is nearer than over free squares, so T_S is at least the mean over the F nearest; where squares hold
    different numbers of stalls, at least the least. U_S is at least 0.
    """
    ground = ground_of(site, bay=bay, plan=plan or PlanConfig())
    squares = ground.squares
    served = min(len(squares), max(0, (2 * len(squares) + 2 - len(ground.portals)) // 3))
    hops = free_hops(ground)[squares]
    most = ground.capacity[squares].max(axis=1)
    nearest = np.sort(np.maximum(hops, 2))
    mean = float(nearest[:served].mean()) if (most == most[0]).all() and served else 2.0
    stalls = int(np.sort(most)[::-1][:served].sum())
    return float(ground.weights[0] * stalls + ground.weights[1] * mean)
