"""Demand: when cars arrive, and how long they stay.

Arrivals are a Poisson process whose rate replaces the cars that leave and leads the occupancy along its curve by hour;
stays are log-normal, as measured in car parks (Young, "A review of parking lot design models", Transport Reviews 1988).
"""

import math
from dataclasses import dataclass
from heapq import heapify, heappop, heappush

import numpy as np

from garage2usd.config.traffic import TrafficConfig

_STEP_S, _LEAD_S = 30.0, 900.0
"""Step of the arrival rate, and the time within which the occupancy is led back to its curve."""


@dataclass(frozen=True, slots=True)
class Demand:
    """Demand for one run.

    Attributes
    ----------
    leave_s
        Time at which each car that is parked at the start leaves, in their order; infinite for cars that stay.
    arrivals
        (time, stay) of each arrival in seconds, ascending.
    """

    leave_s: tuple[float, ...]
    arrivals: tuple[tuple[float, float], ...]


def drawn_demand(
    settings: TrafficConfig, parked: int, capacity: int, draw: np.random.Generator, *, staying: int = 0
) -> Demand:
    """Draw the demand of a run.

    Parameters
    ----------
    settings
        The settings.
    parked
        Number of cars parked at the start that can leave.
    capacity
        Number of stalls.
    draw
        Random generator.
    staying
        Number of cars parked at the start that never leave.

    Notes
    -----
    The rest of the stay of a car found parked has the density (1 - F(t)) / mean of a renewal process in equilibrium:
    a share, uniform on [0, 1], of a stay that is drawn with a weight in proportion to its length, which for a
    log-normal stay is a log-normal one whose median is larger by exp(spread^2).
    """
    end_s, spread = settings.minutes * 60, settings.stay_spread
    mean_s = 60 * settings.mean_stay_minutes(parked, capacity)
    mu = math.log(mean_s) - spread**2 / 2
    rests = np.exp(draw.normal(mu + spread**2, spread, parked)) * draw.uniform(size=parked)
    leave = [float(rest) if rest < end_s else math.inf for rest in rests]
    leaving = [time for time in leave if time < end_s]
    heapify(leaving)
    present, arrivals = parked, []
    for start in np.arange(0.0, end_s, _STEP_S).tolist():
        stop = min(start + _STEP_S, end_s)
        while leaving and leaving[0] < stop:
            heappop(leaving)
            present -= 1
        wanted = settings.occupancy(settings.hour + stop / 3600) * capacity - staying
        rate = present / mean_s + (wanted - present) / _LEAD_S
        if settings.arrivals_per_hour is not None:
            rate = settings.arrivals_per_hour / 3600
        for time in sorted(draw.uniform(start, stop, draw.poisson(max(rate, 0.0) * (stop - start))).tolist()):
            stay = float(np.exp(draw.normal(mu, spread)))
            arrivals.append((time, stay))
            present += 1
            if time + stay < end_s:
                heappush(leaving, time + stay)
    return Demand(tuple(leave), tuple(arrivals))
