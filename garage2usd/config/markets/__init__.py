"""Car markets as data: shares of body classes and paints, and of cars parked nose out."""

from collections.abc import Mapping
from functools import cache
from typing import Annotated, Literal, get_args

from pydantic import AfterValidator, Field

from garage2usd.common.documents import shipped_toml
from garage2usd.common.settings import Settings, validated
from garage2usd.config.vehicles import PAINTS, SEGMENTS

__all__ = ["MARKET_NAMES", "Market", "MarketName", "PaintShares", "SegmentShares", "load_market", "market_of"]

MarketName = Literal["china", "germany", "uk", "usa", "world"]
MARKET_NAMES: tuple[str, ...] = get_args(MarketName)
"""Names of the shipped markets."""
_WORLD = "world"

Share = Annotated[float, Field(ge=0, le=1)]


def _shares_of(names: tuple[str, ...]) -> AfterValidator:
    """Validator of shares by name, at least one of them positive; they are normalised by their sum."""

    def checked(shares: Mapping[str, float]) -> Mapping[str, float]:
        if unknown := sorted(set(shares) - set(names)):
            raise ValueError(f"shares of {', '.join(names)}, not of {', '.join(unknown)}")
        if not sum(shares.values()) > 0:
            raise ValueError("shares of which one at least is more than 0")
        return shares

    return AfterValidator(checked)


SegmentShares = Annotated[dict[str, Share], _shares_of(SEGMENTS)]
"""Shares of the body classes, normalised by their sum."""
PaintShares = Annotated[dict[str, Share], _shares_of(PAINTS)]
"""Shares of the paints, normalised by their sum."""


class Segments(Settings):
    """Shares of the body classes in a market."""

    shares: SegmentShares
    """Share by class."""
    source: str
    """Source of the figures, and the assumptions among them."""


class Paints(Settings):
    """Shares of the paints in a market."""

    shares: PaintShares
    """Share by paint."""
    source: str
    """Source of the figures, and the assumptions among them."""


class Reversed(Settings):
    """Share of the parked cars that stand nose out in a market."""

    share: Share
    """Share of all parked cars."""
    source: str
    """Source of the figure."""


class Market(Settings):
    """Mix of cars in a market."""

    title: str
    """Title of the market."""
    countries: tuple[str, ...]
    """ISO 3166 codes of the countries whose profiles use this market."""
    segments: Segments
    """Shares of the body classes."""
    paints: Paints
    """Shares of the paints."""
    reversed: Reversed
    """Share of cars parked nose out."""


@cache
def load_market(name: str) -> Market:
    """Load a market by its name, one of `MARKET_NAMES`."""
    return validated(Market, shipped_toml("garage2usd.config.markets", name), within="market")


@cache
def market_of(country: str) -> Market:
    """Return the market of a country by its ISO 3166 code; the world's if the country has none."""
    return next(
        (market for market in map(load_market, MARKET_NAMES) if country in market.countries), load_market(_WORLD)
    )
