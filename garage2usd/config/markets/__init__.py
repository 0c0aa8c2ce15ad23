"""Markets as data: which shares of cars have which class of body and which paint, and stand nose out."""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Annotated, Literal, get_args

from pydantic import AfterValidator, Field

from garage2usd.common.settings import Settings, validated
from garage2usd.config.vehicles import PAINTS, SEGMENTS

__all__ = ["MARKET_NAMES", "Market", "MarketName", "PaintShares", "SegmentShares", "load_market", "market_of"]

MarketName = Literal["china", "germany", "uk", "usa", "world"]
MARKET_NAMES: tuple[str, ...] = get_args(MarketName)
"""The markets that are shipped."""
_WORLD = "world"

Share = Annotated[float, Field(ge=0, le=1)]


def _shares_of(names: tuple[str, ...]) -> AfterValidator:
    """Shares by name, some of which are more than 0; they are parts of their sum."""

    def checked(shares: Mapping[str, float]) -> Mapping[str, float]:
        if unknown := sorted(set(shares) - set(names)):
            raise ValueError(f"shares of {', '.join(names)}, not of {', '.join(unknown)}")
        if not sum(shares.values()) > 0:
            raise ValueError("shares of which one at least is more than 0")
        return shares

    return AfterValidator(checked)


SegmentShares = Annotated[dict[str, Share], _shares_of(SEGMENTS)]
"""Shares by the class of a car's body, as parts of their sum."""
PaintShares = Annotated[dict[str, Share], _shares_of(PAINTS)]
"""Shares by paint, as parts of their sum."""


class Segments(Settings):
    """Shares of the classes of bodies."""

    shares: SegmentShares
    """By class."""
    source: str
    """Where they are from, and what of them is assumed."""


class Paints(Settings):
    """Shares of the paints."""

    shares: PaintShares
    """By paint."""
    source: str
    """Where they are from, and what of them is assumed."""


class Reversed(Settings):
    """The share of parked cars that stand nose out."""

    share: Share
    """Of all parked cars."""
    source: str
    """Where it is from."""


class Market(Settings):
    """The cars of a market."""

    title: str
    """Its name for people."""
    countries: tuple[str, ...]
    """ISO 3166 codes of the countries whose profiles have it."""
    segments: Segments
    """Classes of bodies."""
    paints: Paints
    """Paints."""
    reversed: Reversed
    """Cars nose out."""


@cache
def load_market(name: str) -> Market:
    """A market by its name, one of `MARKET_NAMES`."""
    text = (resources.files("garage2usd.config.markets") / f"{name}.toml").read_text(encoding="utf-8")
    return validated(Market, tomllib.loads(text), within="market")


@cache
def market_of(country: str) -> Market:
    """The market of a country by its ISO 3166 code, that of the world where it has none."""
    return next(
        (market for market in map(load_market, MARKET_NAMES) if country in market.countries), load_market(_WORLD)
    )
