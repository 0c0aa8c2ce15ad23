"""Fleet of parked cars: bodies and paints by their market shares, and a choice of models for each garage."""

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import accumulate

from garage2usd.config import ParkingConfig
from garage2usd.config.markets import load_market, market_of
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, CarBody


class Fleet:
    """Market shares of car bodies and paints, overridden by the configuration, and the models of one garage.

    Parameters
    ----------
    parking
        Settings of parking.
    country
        ISO 3166 code of the profile's country; empty for none.
    ranks
        Random number of each body of the catalogue; of a segment's bodies that fit a stall, the least are chosen.

    Attributes
    ----------
    segments, paints
        Shares of vehicle segments and of paints, relative to their sum.
    reversed_share
        Share of the cars parked nose out.

    Notes
    -----
    Segments keep their market shares in every garage. Only the models of a segment are limited, as each body is one
    more asset of 130 KB: garages differ in their models, and a data set has all of them.
    """

    def __init__(self, parking: ParkingConfig, country: str, ranks: Sequence[float]) -> None:
        market = load_market(parking.market) if parking.market else market_of(country)
        self.segments = dict(parking.bodies or market.segments.shares)
        self.paints = dict(parking.paints or market.paints.shares)
        self.reversed_share = market.reversed.share if parking.reversed_share is None else parking.reversed_share

        self._more_models = parking.more_models
        self._rank = dict(zip(CAR_BODIES, ranks, strict=True))
        self._paint_sums = _cumulative_sums([self.paints.get(paint, 0.0) for paint in PAINTS])
        self._models: dict[tuple[CarBody, ...], tuple[list[CarBody], list[float]]] = {}

    def body_of(self, bodies: tuple[CarBody, ...], share: float) -> CarBody:
        """Return the body at a quantile from 0 to 1 of some bodies, weighted by the shares of their segments."""
        if bodies not in self._models:
            models = self._models_of(bodies)
            self._models[bodies] = models, _cumulative_sums(body_weights(models, self.segments))
        models, sums = self._models[bodies]
        return models[_index_at(share, sums)]

    def _models_of(self, bodies: Sequence[CarBody]) -> list[CarBody]:
        """Choose the garage's models of each segment among some bodies."""
        total = sum(self.segments.values())
        chosen: Counter[str] = Counter()
        models: list[CarBody] = []
        for body in sorted(bodies, key=lambda body: self._rank[body]):
            share = self.segments.get(body.segment, 0.0) / total if total else 1.0
            if chosen[body.segment] <= round(self._more_models * share):
                chosen[body.segment] += 1
                models.append(body)
        return models

    def paint_of(self, share: float) -> str:
        """Return the paint at a quantile from 0 to 1."""
        return PAINTS[_index_at(share, self._paint_sums)]


def body_weights(bodies: Sequence[CarBody], segments: Mapping[str, float]) -> list[float]:
    """Return the weight of each body: an equal part of its segment's share; all 1 if all shares are 0."""
    counts = Counter(body.segment for body in bodies)
    weights = [segments.get(body.segment, 0.0) / counts[body.segment] for body in bodies]
    return weights if sum(weights) > 0 else [1.0] * len(bodies)


def _cumulative_sums(weights: Sequence[float]) -> list[float]:
    """Return the cumulative sums of some weights."""
    return list(accumulate(weights))


def _index_at(share: float, sums: Sequence[float]) -> int:
    """Return the index of the weight at a quantile from 0 to 1, by cumulative sums."""
    return next(number for number, so_far in enumerate(sums) if share * sums[-1] < so_far)
