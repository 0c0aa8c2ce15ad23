"""Beams under the ceiling of a surveyed garage, along the lines on which its columns stand."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from garage2usd.config import BayConfig
from garage2usd.layout.ceiling.beams import beams
from garage2usd.layout.placement import Placement
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.layout.surveyed.lines import OFF_LINE_M

__all__ = ["surveyed_beams"]

_BEAMS = -3
"""First number of the pairs by which beams are known until they are put on their tiles."""


def surveyed_beams(
    ground: SurveyedGround, bay: BayConfig, ceiling_m: float, depth_m: float, pillars: Sequence[Placement]
) -> list[Placement]:
    """Place beams along the rows of columns in both directions, from wall to wall, as under a plan's squares.

    Parameters are those of `garage2usd.layout.ceiling.beams.beams`.
    """
    fields = ground.fields
    if fields is None:
        return []
    lines = fields.column_edges_m, fields.row_edges_m
    snapped = [_on_lines(place, lines) for place in pillars]
    found = beams(fields, bay, ceiling_m, depth_m, snapped)
    return [replace(place, square=(_BEAMS, number)) for number, place in enumerate(found)]


def _on_lines(place: Placement, lines: tuple[NDArray[np.float64], NDArray[np.float64]]) -> Placement:
    """Return a column moved onto the lines that it is nearest to, if they are near."""
    x, y, z = place.position_m
    at = [float(own[np.argmin(np.abs(own - value))]) for own, value in zip(lines, (x, z), strict=True)]
    if abs(at[0] - x) > OFF_LINE_M or abs(at[1] - z) > OFF_LINE_M:
        return place
    return replace(place, position_m=(at[0], y, at[1]))
