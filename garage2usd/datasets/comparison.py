"""Comparison of a data set with published figures of real garages."""

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.common.package import VERSION
from garage2usd.datasets.making import TABLE_FILE
from garage2usd.datasets.manifest import MANIFEST_SCHEMA, ManifestRow, rows_of_table
from garage2usd.datasets.published import PublishedFigure, PublishedFigures, Quantity, read_published

_SHARES = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Shares of the quantiles that a comparison tells."""
_DIGITS = 6
_MOST_COUNTED = 4
"""Number of levels from which on buildings are counted together."""


@dataclass(frozen=True, eq=False)
class Compared:
    """A quantity of a data set beside its published figure.

    Attributes
    ----------
    published
        The published figure.
    values
        Values of the data set, ascending; float64, shape (n,). Empty for shares.
    counts
        Count of each category of a quantity given by shares; metres for lanes.
    """

    published: PublishedFigure
    values: NDArray[np.float64]
    counts: dict[str, float]

    @property
    def count(self) -> int:
        """Number of values, or of counted objects; metres for lanes."""
        return len(self.values) if self.published.distribution else round(sum(self.counts.values()))

    @property
    def shares(self) -> dict[str, float]:
        """Share of each category; empty for a distribution, and where nothing is counted."""
        total = sum(self.counts.values())
        return {name: count / total for name, count in self.counts.items()} if total else {}

    @property
    def is_of_shares(self) -> bool:
        """True if the distance is in points of share."""
        return self.published.distribution is None

    @property
    def distance(self) -> float | None:
        """Distance between data set and published figure; None where the data set has no value.

        For a distribution, the Kolmogorov-Smirnov distance, from 0 to 1; for one that is known in part, the distance
        to the nearest distribution that agrees with it. For shares, the greatest difference of a category in points
        (0 to 100).
        """
        if not self.count:
            return None
        distribution = self.published.distribution
        if distribution is not None:
            return round(distribution.distance(self.values), _DIGITS)
        known = self.published.shares or {}
        return round(100 * max(abs(share - known[name]) for name, share in self.shares.items()), _DIGITS)

    def quantile(self, share: float) -> float | None:
        """Return a quantile of the data set's values; None without values."""
        return float(np.quantile(self.values, share)) if len(self.values) else None

    def record(self) -> dict[str, Any]:
        """Return the comparison of the quantity for JSON."""
        published = self.published
        told: dict[str, Any] = {
            "quantity": str(published.quantity),
            "title": published.title,
            "unit": published.unit,
            "country": published.country,
            "count": self.count,
            "distance": self.distance,
            "distance_unit": "points of share" if self.is_of_shares else "Kolmogorov-Smirnov",
        }
        if published.distribution is None:
            told["published"] = dict(published.shares or {})
            told["measured"] = {name: round(share, _DIGITS) for name, share in self.shares.items()}
        else:
            told["published"] = {f"{share:g}": published.distribution.quantile(share) for share in _SHARES}
            if published.between is not None:
                told["published"] = {"0": published.between.low, "1": published.between.high}
            told["measured"] = {f"{share:g}": self.quantile(share) for share in _SHARES}
        return {**told, "source": published.source, "assumption": published.assumption}


@dataclass(frozen=True, eq=False)
class Comparison:
    """A data set beside published figures.

    Attributes
    ----------
    folder
        Folder of the data set.
    garages
        Number of its garages, without failed ones.
    title
        Title of the published figures.
    quantities
        Each quantity, in the order of the published figures.
    """

    folder: Path
    garages: int
    title: str
    quantities: tuple[Compared, ...]

    def text(self) -> str:
        """Return the comparison as JSON."""
        document = {
            "garage2usd": VERSION,
            "garages": self.garages,
            "against": self.title,
            "figures": [compared.record() for compared in self.quantities],
        }
        return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def compare_dataset(folder: str | Path, published: PublishedFigures | None = None) -> Comparison:
    """Compare a data set with published figures of real garages.

    Parameters
    ----------
    folder
        Folder of a finished data set, of which the manifest alone is read.
    published
        The figures; those of the package if left out.

    Raises
    ------
    ConfigError
        If the folder does not hold a data set of this version, or none of its garages was made.
    """
    folder = Path(folder)
    table = folder / TABLE_FILE
    if not table.is_file():
        raise ConfigError("compare", str(folder), "the folder of a finished data set")
    try:
        held = pq.read_table(table)
    except (OSError, pa.ArrowException) as error:
        raise ConfigError("compare", str(table), f"the manifest of a data set ({error})") from None
    if not held.schema.equals(MANIFEST_SCHEMA):
        raise ConfigError("compare", str(table), f"a manifest with the columns of version {VERSION}")
    return compare_rows(rows_of_table(held), published, folder=folder)


def compare_rows(
    rows: Sequence[ManifestRow], published: PublishedFigures | None = None, *, folder: Path | None = None
) -> Comparison:
    """Compare the garages of manifest rows with published figures; raises as `compare_dataset`."""
    known = published or read_published()
    made = [row for row in rows if not row.error]
    place = folder or Path()
    if not made:
        raise ConfigError("compare", str(place), "a data set with a garage that was made")
    return Comparison(place, len(made), known.title, tuple(_compared(figure, made) for figure in known.figures))


def _compared(figure: PublishedFigure, rows: Sequence[ManifestRow]) -> Compared:
    asked = [row for row in rows if figure.country in {"", row.country}]
    if figure.quantity in _COUNTS:
        each = [_COUNTS[figure.quantity](row) for row in asked]
        counts = dict.fromkeys(figure.quantity.categories, 0.0)
        for name, amount in chain.from_iterable(each):
            counts[name] += amount
        return Compared(figure, np.zeros(0), counts)
    values = chain.from_iterable(_VALUES[figure.quantity](row) for row in asked)
    return Compared(figure, np.sort(np.array(list(values), dtype=np.float64)), {})


def _of_positive(value: float) -> Iterator[float]:
    if value > 0:
        yield value


def _kinds(row: ManifestRow) -> Iterator[tuple[str, float]]:
    yield "perpendicular", row.stalls - row.angled_stalls - row.parallel_stalls
    yield "angled", row.angled_stalls
    yield "parallel", row.parallel_stalls


def _levels(row: ManifestRow) -> Iterator[tuple[str, float]]:
    yield str(row.levels) if row.levels < _MOST_COUNTED else f"{_MOST_COUNTED} or more", 1


def _one_way(row: ManifestRow) -> Iterator[tuple[str, float]]:
    yield "one-way", row.one_way_lanes_m
    yield "two-way", row.lanes_m - row.one_way_lanes_m


def _nose_out(row: ManifestRow) -> Iterator[tuple[str, float]]:
    yield "nose out", row.nose_out_cars
    yield "nose in", row.perpendicular_cars - row.nose_out_cars


_VALUES: "MappingProxyType[Quantity, Callable[[ManifestRow], Iterator[float]]]" = MappingProxyType(
    {
        Quantity.STALLS: lambda row: iter([row.stalls]),
        Quantity.LEVEL_STALLS: lambda row: iter(row.level_stalls),
        Quantity.STALL_WIDTH: lambda row: _of_positive(row.stall_width_m),
        Quantity.STALL_LENGTH: lambda row: _of_positive(row.stall_length_m),
        Quantity.AISLE_WIDTH: lambda row: _of_positive(row.aisle_width_m),
        Quantity.OCCUPANCY: lambda row: iter([row.cars / row.stalls] if row.stalls else []),
        Quantity.AREA_PER_STALL: lambda row: _of_positive(row.area_per_stall_m2),
    }
)
_COUNTS: "MappingProxyType[Quantity, Callable[[ManifestRow], Iterator[tuple[str, float]]]]" = MappingProxyType(
    {
        Quantity.LEVELS: _levels,
        Quantity.KINDS: _kinds,
        Quantity.ONE_WAY: _one_way,
        Quantity.NOSE_OUT: _nose_out,
    }
)
