"""Settings of traffic: cars that arrive, park and leave, and people who walk."""

import math
from enum import StrEnum

import numpy as np
from pydantic import Field, field_validator

from garage2usd.common.settings import Settings

_HOURS = 24.0


class Day(StrEnum):
    """Kinds of day, whose occupancy differs by hour."""

    WEEKDAY = "weekday"
    WEEKEND = "weekend"


_OCCUPANCY: dict[Day, dict[float, float]] = {
    Day.WEEKDAY: {2: 0.28, 6: 0.31, 8: 0.52, 10: 0.74, 12: 0.76, 14: 0.71, 16: 0.65, 18: 0.55, 20: 0.46, 22: 0.35},
    Day.WEEKEND: {
        2: 0.32, 6: 0.28, 8: 0.30, 10: 0.41, 12: 0.55, 14: 0.64, 16: 0.65, 18: 0.60, 20: 0.55, 22: 0.47,
    },
}  # fmt: skip
"""Mean occupancy by hour of the day, as in `samples/recipes/world.toml`."""


class TrafficConfig(Settings):
    """A garage in operation."""

    minutes: float = Field(25.0, gt=0.0, le=1440.0)
    """Duration."""
    hour: float = Field(10.0, ge=0.0, lt=_HOURS)
    """Hour of the day at the start."""
    day: Day = Day.WEEKDAY
    """Kind of day, whose occupancy by hour arrivals follow."""
    stay_minutes: float = Field(70.0, gt=0.0, le=1440.0)
    """Median of the stays, which are log-normal."""
    stay_spread: float = Field(0.7, ge=0.0, le=2.0)
    """Standard deviation of the logarithm of the stays."""
    arrivals_per_hour: float | None = Field(None, ge=0.0, le=3600.0)
    """Mean number of arrivals per hour. The mean stay is then such that as many of the cars present at the start leave
    per hour (Little's law), counting at least half of the occupancy of that hour. If left out, arrivals follow from
    the stays and the occupancy."""
    permits: float = Field(0.02, ge=0.0, le=1.0)
    """Share of the arriving cars that have a permit for accessible stalls, which they prefer."""
    waits_for_stall: float = Field(0.0, ge=0.0, le=1.0)
    """Share of the arriving cars that wait on the aisle for a stall whose car is about to leave, where there is one."""
    double_parks: float = Field(0.0, ge=0.0, le=1.0)
    """Share of the arriving cars that stop on an aisle for a minute or so on their way."""
    wrong_way: float = Field(0.0, ge=0.0, le=1.0)
    """Share of the arriving cars that drive against a one-way aisle, where that leads to their stalls."""
    people: bool = True
    """True if people walk between their cars and the stair cores."""
    people_in_car: tuple[float, float, float, float] = (0.66, 0.23, 0.07, 0.04)
    """Shares of cars with one, two, three and four people, 1.5 on average as in Mobilität in Deutschland 2017; those of
    a car walk together."""
    running_children: float = Field(0.05, ge=0.0, le=1.0)
    """Share of cars with passengers of which one is a child who runs across the aisle."""
    trolleys: float = Field(0.0, ge=0.0, le=1.0)
    """Share of drivers who bring their shopping to the car in a trolley, and take it back to the stair core."""
    loose_trolleys: float = Field(0.2, ge=0.0, le=1.0)
    """Share of these trolleys that roll away while they are unloaded."""

    @field_validator("people_in_car")
    @classmethod
    def _are_shares(cls, shares: tuple[float, ...]) -> tuple[float, ...]:
        if min(shares) < 0 or not math.isclose(sum(shares), 1.0, abs_tol=1e-6):
            raise ValueError("four shares of at least 0 whose sum is 1")
        return shares

    def occupancy(self, hour: float) -> float:
        """Return the mean occupancy at an hour of the day, linear between the table's hours."""
        table = _OCCUPANCY[self.day]
        return float(np.interp(hour, [*table], [*table.values()], period=_HOURS))

    def mean_stay_minutes(self, present: int, capacity: int) -> float:
        """Return the mean of the stays of some cars that are present at the start, in a garage of some capacity."""
        if self.arrivals_per_hour:
            return 60.0 * max(present, capacity * self.occupancy(self.hour) / 2, 1.0) / self.arrivals_per_hour
        return self.stay_minutes * math.exp(self.stay_spread**2 / 2)
