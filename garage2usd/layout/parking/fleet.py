"""Which cars park: a body and a paint for each, by the shares of their market."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import accumulate

from garage2usd.config import ParkingConfig
from garage2usd.config.markets import load_market, market_of
from garage2usd.config.vehicles import PAINTS, CarBody

__all__ = ["Fleet"]


class Fleet:
    """The cars of a market, with the shares that a configuration has of its own.

    Parameters
    ----------
    parking
        The configuration.
    country
        ISO 3166 code of the profile's country, empty where it names none.

    Attributes
    ----------
    segments, paints
        Shares of the classes of bodies and of the paints, as parts of their sum.
    reversed_share
        Share of the cars that stand nose out.
    """

    def __init__(self, parking: ParkingConfig, country: str) -> None:
        market = load_market(parking.market) if parking.market else market_of(country)
        self.segments = dict(parking.bodies or market.segments.shares)
        self.paints = dict(parking.paints or market.paints.shares)
        self.reversed_share = market.reversed.share if parking.reversed_share is None else parking.reversed_share

        self._paint_sums = _sums([self.paints.get(paint, 0.0) for paint in PAINTS])
        self._body_sums: dict[tuple[CarBody, ...], list[float]] = {}

    def body_of(self, bodies: tuple[CarBody, ...], share: float) -> CarBody:
        """The body at a share from 0 to 1 of some bodies, whose class has its share of those that are there."""
        if bodies not in self._body_sums:
            self._body_sums[bodies] = _sums(body_weights(bodies, self.segments))
        return bodies[_at(share, self._body_sums[bodies])]

    def paint_of(self, share: float) -> str:
        """The paint at a share from 0 to 1."""
        return PAINTS[_at(share, self._paint_sums)]


def body_weights(bodies: Sequence[CarBody], segments: Mapping[str, float]) -> list[float]:
    """The weight of each of some bodies: its class's share, evenly; all alike where none of their classes has any."""
    counts = Counter(body.segment for body in bodies)
    weights = [segments.get(body.segment, 0.0) / counts[body.segment] for body in bodies]
    return weights if sum(weights) > 0 else [1.0] * len(bodies)


def _sums(weights: Sequence[float]) -> list[float]:
    """The sum of the weights up to each one of them."""
    return list(accumulate(weights))


def _at(share: float, sums: Sequence[float]) -> int:
    """Number of the part at a share from 0 to 1 of the sum."""
    return next(number for number, so_far in enumerate(sums) if share * sums[-1] < so_far)
