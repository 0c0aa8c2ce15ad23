"""Traffic of the garages of a data set: tracks in several forms, prediction tasks, and figures of difficulty."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, field_validator

from garage2usd.as_built.garage import garage_of_file
from garage2usd.common.settings import Settings
from garage2usd.config.traffic import TrafficConfig
from garage2usd.driving.tracks import Tracks
from garage2usd.track_forms import write_predictions, write_tracks

_DIGITS = 3


class TrafficOutputs(Settings):
    """Settings of the outputs of each garage in operation; its demand is that of `garage.traffic`."""

    forms: tuple[Literal["csv", "fcd.xml", "mcap", "parquet", "pkl", "usdc", "xosc"], ...] = Field(
        ("parquet",), min_length=1
    )
    """Forms of the tracks, as of `garage2usd traffic` (`.tracks.parquet`)."""
    predictions: bool = False
    """True to write the prediction tasks of the tracks as a table (`.predictions.parquet`)."""

    @field_validator("forms")
    @classmethod
    def _once(cls, forms: tuple[str, ...]) -> tuple[str, ...]:
        if len(set(forms)) < len(forms):
            raise ValueError("each form once")
        return forms


def operate(
    stage: Path, config: TrafficOutputs, settings: TrafficConfig, *, seed: int
) -> tuple[Tracks, dict[str, Any]]:
    """Operate a garage of a data set and write its tracks beside its stage.

    Parameters
    ----------
    stage
        Stage of the garage.
    config
        The forms of the tracks.
    settings
        Duration and demand.
    seed
        Seed of the run.

    Returns
    -------
    tuple
        The tracks, and the traffic fields of the garage's manifest row.
    """
    from garage2usd.traffic import Operation  # noqa: PLC0415 - slow to import, and not always needed
    from garage2usd.traffic.encounters import encounters  # noqa: PLC0415 - as above

    garage = garage_of_file(stage)
    tracks = replace(Operation(garage).run(settings, seed=seed), source=stage.name)
    for form in config.forms:
        write_tracks(stage.with_name(f"{stage.stem}.tracks.{form}"), tracks, garage)
    if config.predictions:
        write_predictions(stage.with_name(f"{stage.stem}.predictions.parquet"), tracks, garage)
    met = encounters(tracks)
    return tracks, {
        **{name: tracks.facts[name] for name in ("arrivals", "departures", "walks")},
        "encounters": met.encounters,
        "least_ttc_s": round(met.least_ttc_s, _DIGITS) if math.isfinite(met.least_ttc_s) else -1.0,
        "waits": met.waits,
        "longest_wait_s": round(met.longest_wait_s, _DIGITS),
    }
