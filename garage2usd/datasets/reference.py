"""The difficulty reference set: 200 garages of mixed sizes and settings, with features of their stalls.

``python -m garage2usd.datasets.reference FOLDER`` writes ``difficulty.json``, which the package ships, in about two
minutes.
"""

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from garage2usd.common.documents import json_text
from garage2usd.common.errors import Garage2UsdError
from garage2usd.common.output import publish, staging_folder
from garage2usd.config import GarageConfig
from garage2usd.datasets.difficulty import REFERENCE_FILE, Reference, ReferenceGarage, proven_values, scores_of
from garage2usd.datasets.stall_features import StallFeatures, measured_stalls
from garage2usd.pipeline import generate

GARAGES = 200
_SIZES = ((5, 5), (6, 8), (7, 9), (9, 12), (12, 16), (16, 20))
_SHARES = (0.15, 0.2, 0.3, 0.2, 0.1, 0.05)
_LARGE_SQUARES = 100
_PROFILES = ("cn-jgj100", "de-garvo", "us-ada", "uk-istructe")
_PROFILE_SHARES = (0.55, 0.15, 0.15, 0.15)
_STEPS = 100
_DIGITS = 6


def reference_settings(seed: int) -> dict[str, Any]:
    """Draw the configuration of a reference garage from its seed.

    Notes
    -----
    The settings vary around the defaults: sizes from 5 x 5 to 16 x 20 squares, four profiles, random contours and
    obstacles on large sites, aisles of 5 to 7 m or a uniform grid, stalls of 2.2 to 2.6 m, occupancies from 0 to 1,
    half to twice the default illuminance. Plans are learned with few episodes, as they need not be optimal.
    """
    draw = np.random.default_rng([18, seed])
    rows, cols = _SIZES[draw.choice(len(_SIZES), p=_SHARES)]
    is_large = rows * cols >= _LARGE_SQUARES
    bay: dict[str, Any] = {"stall_width_m": round(float(draw.uniform(2.2, 2.6)), 2)}
    if draw.random() < 0.85:  # noqa: PLR2004 - share of garages whose squares fit their plan
        bay["aisle_width_m"] = round(float(draw.uniform(5.0, 7.0)), 2)
    else:
        bay["square_side_m"] = round(float(draw.uniform(5.9, 8.7)), 2)
    brightness = float(2 ** draw.uniform(-1, 1))
    return {
        "seed": seed,
        "profile": str(draw.choice(_PROFILES, p=_PROFILE_SHARES)),
        "site": {
            "height_cells": rows,
            "width_cells": cols,
            "rectangles": int(draw.integers(0, 4)) if is_large else 0,
            "obstacles": int(draw.integers(0, 4)) if is_large else 0,
        },
        "bay": bay,
        "plan": {"episodes": 400, "climb_top": 4, "unreachable_stalls": "keep"},
        "fittings": {
            "lane_lux": round(50 * brightness, 1),
            "stall_lux": round(30 * brightness, 1),
        },
        "parking": {"occupancy": round(float(draw.uniform(0, 1)), 2)},
    }


def reference_stalls(seed: int) -> tuple[StallFeatures, ...] | None:
    """Measure the stalls of a reference garage; None if its settings are infeasible."""
    try:
        return measured_stalls(generate(GarageConfig(**reference_settings(seed))))
    except Garage2UsdError:
        return None


def make_reference(garages: Mapping[int, tuple[StallFeatures, ...]]) -> Reference:
    """Compute the difficulty reference set from garages' stalls.

    Parameters
    ----------
    garages
        Stall features of each garage by its seed; at least one stall is proven.
    """
    stalls = [stall for found in garages.values() for stall in found]
    quantiles = {name: _quantiles(values) for name, values in proven_values(stalls).items()}
    scores = scores_of(stalls, quantiles)
    rows = []
    for seed, found in garages.items():
        own = scores_of(found, quantiles)
        if len(own):
            mean = round(float(own.mean()), _DIGITS)
            rows.append(ReferenceGarage(seed=seed, stalls=len(own), unproven=len(found) - len(own), score=mean))
    return Reference(
        stalls=len(scores),
        quantiles=quantiles,
        stall_scores=_quantiles(scores),
        stall_terciles=_terciles(scores),
        garage_terciles=_terciles(np.array([row.score for row in rows])),
        garages=tuple(rows),
    )


def _quantiles(values: NDArray[np.float64]) -> tuple[float, ...]:
    found = np.quantile(values, np.linspace(0, 1, _STEPS + 1), method="nearest")
    return tuple(np.round(found, _DIGITS).tolist())


def _terciles(values: NDArray[np.float64]) -> tuple[float, float]:
    lower, upper = np.round(np.quantile(values, (1 / 3, 2 / 3), method="lower"), _DIGITS).tolist()
    return lower, upper


def _garages() -> Iterator[tuple[int, tuple[StallFeatures, ...]]]:
    """Yield the first feasible reference garages, from seed 0."""
    count = seed = 0
    while count < GARAGES:
        found = reference_stalls(seed)
        if found is not None:
            yield seed, found
            count += 1
        seed += 1


@click.command()
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
def main(folder: Path) -> None:
    """Make the difficulty reference set and write it into FOLDER."""
    garages = {}
    for seed, stalls in _garages():
        garages[seed] = stalls
        click.echo(f"\r{len(garages)} of {GARAGES} garages", nl=False, err=True)
    made = make_reference(garages)
    with staging_folder(folder / REFERENCE_FILE.name) as staging:
        file = staging / REFERENCE_FILE.name
        file.write_text(json_text(made.model_dump(mode="json")), encoding="utf-8", newline="\n")
        (place,) = publish([file], folder)
    click.echo(f"\n{len(made.garages)} garages with {made.stalls} stalls in {place}")


if __name__ == "__main__":
    sys.exit(main())
