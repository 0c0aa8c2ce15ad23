"""Published figures of real garages as data: distributions and shares, each with its source."""

from enum import StrEnum
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator
from scipy import stats

from garage2usd.common.documents import read_toml
from garage2usd.common.settings import Settings, validated

WORLD_FILE = Path(__file__).with_name("world.toml")
"""The figures that the package ships."""

Share = Annotated[float, Field(ge=0, le=1)]
_WHOLE = 1e-6


class Quantity(StrEnum):
    """Quantities of garages that are compared."""

    STALLS = "stalls"
    """Stalls for cars of each garage."""
    LEVEL_STALLS = "level_stalls"
    """Stalls for cars of each level of each garage."""
    LEVELS = "levels"
    """Shares of garages with 1, 2, 3, and 4 or more levels."""
    STALL_WIDTH = "stall_width_m"
    """Width of the usual stalls of each garage."""
    STALL_LENGTH = "stall_length_m"
    """Length of the usual stalls of each garage."""
    AISLE_WIDTH = "aisle_width_m"
    """Clear width of the aisles in front of them."""
    KINDS = "kinds"
    """Shares of perpendicular, angled and parallel stalls."""
    ONE_WAY = "one_way"
    """Shares of the length of one-way and two-way lanes."""
    OCCUPANCY = "occupancy"
    """Parked cars for each stall of each garage."""
    NOSE_OUT = "nose_out"
    """Shares of the cars in perpendicular stalls that stand nose out and nose in."""
    AREA_PER_STALL = "area_per_stall_m2"
    """Floor for each stall of each garage."""

    @property
    def categories(self) -> tuple[str, ...]:
        """Categories of a quantity that is given by shares; empty for a distribution of numbers."""
        return _CATEGORIES.get(self, ())


_CATEGORIES = {
    Quantity.LEVELS: ("1", "2", "3", "4 or more"),
    Quantity.KINDS: ("perpendicular", "angled", "parallel"),
    Quantity.ONE_WAY: ("one-way", "two-way"),
    Quantity.NOSE_OUT: ("nose out", "nose in"),
}


class Quantiles(Settings):
    """A distribution known by some of its quantiles; between two of them the share is interpolated linearly."""

    shares: tuple[Share, ...] = Field(min_length=2)
    """Shares of the values below each quantile, ascending."""
    values: tuple[float, ...]
    """The quantiles."""

    @model_validator(mode="after")
    def _ascending(self) -> Self:
        if len(self.shares) != len(self.values):
            raise ValueError("as many values as shares")
        if any(low >= high for ends in (self.shares, self.values) for low, high in pairwise(ends)):
            raise ValueError("shares and values that ascend")
        return self

    def share_below(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the share below each value, shape (n,); outside the known quantiles that of the outermost one."""
        return np.interp(values, self.values, self.shares)

    def quantile(self, share: float) -> float | None:
        """Return the value below which a share of the distribution lies; None outside the known quantiles."""
        if not self.shares[0] <= share <= self.shares[-1]:
            return None
        return float(np.interp(share, self.shares, self.values))

    def distance(self, values: NDArray[np.float64]) -> float:
        """Return the Kolmogorov-Smirnov distance of values, shape (n,), within the known quantiles.

        Notes
        -----
        Below the first and above the last quantile the published share is only known to lie beyond that of the
        quantile. The distance to the nearest such distribution is attained within the known ones.
        """
        ordered = np.sort(values)
        # the empirical share is constant between values and the published one ascends, so ends of steps suffice
        places = np.unique(np.concatenate([ordered, [self.values[0], self.values[-1]]]))
        places = places[(places >= self.values[0]) & (places <= self.values[-1])]
        below = np.searchsorted(ordered, places, "left") / len(ordered)
        at_most = np.searchsorted(ordered, places, "right") / len(ordered)
        known = self.share_below(places)
        # values below the first quantile and above the last one count on one side only
        before = np.where(places > self.values[0], np.abs(below - known), np.maximum(below - known, 0))
        after = np.where(places < self.values[-1], np.abs(at_most - known), np.maximum(known - at_most, 0))
        return float(max(before.max(), after.max()))


class _Range(Settings):
    """A range of values."""

    low: float
    """Least value."""
    high: float
    """Greatest value."""

    @model_validator(mode="after")
    def _ascending(self) -> Self:
        if not self.low < self.high:
            raise ValueError("low less than high")
        return self


class Uniform(_Range):
    """A uniform distribution."""

    def share_below(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the share below each value, shape (n,)."""
        return np.asarray(stats.uniform.cdf(values, self.low, self.high - self.low), dtype=np.float64)

    def quantile(self, share: float) -> float | None:
        """Return the quantile of a share."""
        return self.low + share * (self.high - self.low)

    def distance(self, values: NDArray[np.float64]) -> float:
        """Return the Kolmogorov-Smirnov distance of values, shape (n,)."""
        return float(stats.ks_1samp(values, self.share_below).statistic)


class Between(_Range):
    """A published range without a distribution between its ends."""

    def quantile(self, _share: float) -> float | None:
        """Return None: no quantile is known."""
        return None

    def distance(self, values: NDArray[np.float64]) -> float:
        """Return the distance of values, shape (n,), to the nearest distribution between the ends.

        It is the greater one of the shares below the low end and above the high end.
        """
        return float(max(np.mean(values < self.low), np.mean(values > self.high)))


class LogNormalFigure(Settings):
    """A log-normal distribution."""

    median: float = Field(gt=0)
    """Median."""
    spread: float = Field(gt=0)
    """Standard deviation of the natural logarithm."""

    def share_below(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the share below each value, shape (n,)."""
        return np.asarray(stats.lognorm.cdf(values, self.spread, scale=self.median), dtype=np.float64)

    def quantile(self, share: float) -> float | None:
        """Return the quantile of a share."""
        return float(stats.lognorm.ppf(share, self.spread, scale=self.median))

    def distance(self, values: NDArray[np.float64]) -> float:
        """Return the Kolmogorov-Smirnov distance of values, shape (n,)."""
        return float(stats.ks_1samp(values, self.share_below).statistic)


class PublishedFigure(Settings):
    """A published figure: a distribution by quantiles or by name, or shares of categories."""

    quantity: Quantity
    """The quantity."""
    title: str = Field(min_length=1, max_length=60)
    """Title in tables and pictures."""
    unit: str = Field("", max_length=10)
    """Unit of its values."""
    country: str = Field("", pattern=r"^([A-Z]{2})?$")
    """ISO 3166 code of the country whose garages it holds for; all garages if left out."""
    quantiles: Quantiles | None = None
    """Distribution by its quantiles."""
    uniform: Uniform | None = None
    """Uniform distribution."""
    log_normal: LogNormalFigure | None = None
    """Log-normal distribution."""
    between: Between | None = None
    """Least and greatest value, where nothing is known of the distribution between them."""
    shares: dict[str, Share] | None = None
    """Share of each category of the quantity."""
    source: str = Field(min_length=1)
    """Source of the figure."""
    assumption: str = ""
    """The part of the figure that is assumed; empty if all of it is published."""

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        forms = [self.quantiles, self.uniform, self.log_normal, self.between, self.shares]
        categories = self.quantity.categories
        if sum(form is not None for form in forms) != 1 or (self.shares is not None) != bool(categories):
            raise ValueError(
                "shares for a quantity of categories, else one of quantiles, uniform, log_normal and between"
            )
        if self.shares is not None and (
            set(self.shares) != set(categories) or abs(sum(self.shares.values()) - 1) > _WHOLE
        ):
            raise ValueError(f"a share of each of {', '.join(categories)}, 1 together")
        return self

    @property
    def distribution(self) -> Quantiles | Uniform | LogNormalFigure | Between | None:
        """The distribution, or its known quantiles or range; None for shares."""
        return self.quantiles or self.uniform or self.log_normal or self.between


class PublishedFigures(Settings):
    """A file of published figures."""

    title: str = ""
    """Title of the figures."""
    figures: tuple[PublishedFigure, ...] = Field(min_length=1)
    """The figures."""


def read_published(path: str | Path = WORLD_FILE) -> PublishedFigures:
    """Read published figures from TOML, by default those of the package.

    Raises
    ------
    ConfigError
        If the file cannot be read, has an unknown key or a value that is not allowed.
    """
    return validated(PublishedFigures, read_toml(Path(path), field="figures"))
