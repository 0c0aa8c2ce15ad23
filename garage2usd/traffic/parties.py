"""Parties: the people of a car, who walk together."""

import numpy as np

from garage2usd.config.traffic import TrafficConfig
from garage2usd.traffic.walker import Person

_SPEED_M_S, _SPREAD_M_S = 1.34, 0.2
"""Mean and standard deviation of walking speeds (Weidmann, Transporttechnik der Fussgänger, 1993: 1.34 m/s)."""
_TALL_M, _CHILD_TALL_M = (1.72, 0.08), (1.0, 1.3)
"""Stature: mean and standard deviation of adults, and range of children of four to eight years."""


def drawn_party(car: int, settings: TrafficConfig, draw: np.random.Generator) -> list[Person]:
    """Draw the people of a car, the driver first; all walk at the speed of the slowest."""
    shares = np.cumsum(settings.people_in_car)
    count = 1 + int(np.searchsorted(shares, draw.random() * shares[-1], side="right"))
    speed = min(float(np.clip(draw.normal(_SPEED_M_S, _SPREAD_M_S), 0.8, 1.8)) for _ in range(count))
    runs = count > 1 and draw.random() < settings.running_children
    found = []
    for seat in range(count):
        is_child = runs and seat == count - 1
        tall = draw.uniform(*_CHILD_TALL_M) if is_child else np.clip(draw.normal(*_TALL_M), 1.5, 1.95)
        found.append(Person(car, seat, speed, float(tall), is_child))
    return found
