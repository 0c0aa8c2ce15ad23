"""Tracks of cars and people on the plan of a level: one line for each way of an agent."""

import colorsys
from collections.abc import Iterator

import numpy as np
import shapely

from garage2usd.driving.tracks import AgentClass, Tracks
from garage2usd.view.drawing import Colour, Line

_WIDTH_M = {AgentClass.PERSON: 0.08}
_CAR_WIDTH_M = 0.16
_NEAR_M = 0.02
"""Deviation of a drawn line from the track."""
_GOLDEN = 0.618034


def track_lines(tracks: Tracks, level: int) -> Iterator[Line]:
    """Draw the ways of the agents' middles as far as they are on a level, each agent in a colour of its own."""
    for number, track in enumerate(tracks):
        places = np.stack([track.x_m, track.z_m], axis=1)
        here = np.flatnonzero(track.level == level)
        for run in np.split(here, np.flatnonzero(np.diff(here) > 1) + 1):
            points = places[run]
            if len(run) and np.ptp(points, axis=0).any():
                line = shapely.LineString(points).simplify(_NEAR_M)
                width_m = _WIDTH_M.get(track.agent.kind, _CAR_WIDTH_M)
                yield Line(list(line.coords), _colour(number), width_m, f"track {track.agent.kind} {track.agent.name}")


def _colour(number: int) -> Colour:
    """Return the colour of an agent: hues around the circle in steps of the golden ratio, which never come close."""
    red, green, blue = (round(255 * part) for part in colorsys.hls_to_rgb(number * _GOLDEN % 1.0, 0.42, 0.85))
    return red, green, blue
