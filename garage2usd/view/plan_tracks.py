"""Tracks of cars and people, as lines on the plan of a level or alone: one line for each way of an agent."""

import colorsys
from collections.abc import Iterator

import numpy as np
import shapely

from garage2usd.driving.tracks import AgentClass, AgentState, Track, Tracks
from garage2usd.garage.levels import level_name
from garage2usd.view.drawing import Colour, Disc, Drawing, Line, Point, Region, Text
from garage2usd.view.plan_sheet import INK, PAPER

_WIDTH_M = {AgentClass.PERSON: 0.08}
_CAR_WIDTH_M = 0.16
_NEAR_M = 0.02
"""Deviation of a drawn line from the track."""
_GOLDEN = 0.618034
_PARKED: Colour = (206, 222, 238)
_MARGIN_M, _LETTERS_M, _SCALE_BAR_M = 3.0, 1.0, 10.0
_MAX_PX_PER_M, _MAX_SIDE_PX = 14.0, 2000


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


def draw_tracks(tracks: Tracks) -> dict[str, Drawing]:
    """Draw tracks without their garage: ways, and the outlines of cars where they park, by the name of the level.

    +X is to the right and +Z down; all levels have the same frame. Levels without tracks are left out.
    """
    places = [np.stack([track.x_m, track.z_m], axis=1) for track in tracks]
    if not places:
        return {}
    ends = np.concatenate(places)
    low, high = ends.min(axis=0) - _MARGIN_M, ends.max(axis=0) + _MARGIN_M
    (left, top), (right, bottom) = low.tolist(), high.tolist()
    bar = left + _LETTERS_M, bottom - _LETTERS_M
    scale = min(_MAX_PX_PER_M, _MAX_SIDE_PX / float((high - low).max()))
    drawings = {}
    for level in np.unique(np.concatenate([track.level for track in tracks])).tolist():
        on_level = [track for track in tracks if (track.level == level).any()]
        words = f"{level_name(level)}: ways of {len(on_level)} agents"
        elements: list[Region | Line | Disc | Text] = [
            *(region for track in on_level for region in _parked(track, level)),
            *track_lines(tracks, level),
            Text((left + _LETTERS_M, top + _LETTERS_M), words, _LETTERS_M, INK, is_left=True, kind="title"),
            Line([bar, (bar[0] + _SCALE_BAR_M, bar[1])], INK, _LETTERS_M / 8, "scale"),
            Text((bar[0] + _SCALE_BAR_M + 0.5, bar[1]), "10 m", _LETTERS_M, INK, is_left=True, kind="scale"),
        ]
        drawings[level_name(level)] = Drawing((left, top), (right, bottom), scale, PAPER, words, elements)
    return drawings


def _parked(track: Track, level: int) -> Iterator[Region]:
    """Draw the outline of an agent at each place of a level where it stands parked."""
    at = np.flatnonzero((track.state == AgentState.PARKED) & (track.level == level))
    seen = set()
    for sample in at[np.concatenate([[True], np.diff(at) > 1])] if len(at) else ():
        x, z, yaw = (float(column[sample]) for column in (track.x_m, track.z_m, track.yaw_rad))
        ahead, beside = np.array([-np.sin(yaw), -np.cos(yaw)]), np.array([np.cos(yaw), -np.sin(yaw)])
        half_m = track.agent.length_m / 2, track.agent.width_m / 2
        corners: list[Point] = [
            tuple((np.array([x, z]) + along * half_m[0] * ahead + across * half_m[1] * beside).tolist())
            for along, across in ((1, 1), (1, -1), (-1, -1), (-1, 1))
        ]
        if (x, z) not in seen:
            seen.add((x, z))
            yield Region(corners, _PARKED, "parked", track.agent.name)


def _colour(number: int) -> Colour:
    """Return the colour of an agent: hues around the circle in steps of the golden ratio, which never come close."""
    red, green, blue = (round(255 * part) for part in colorsys.hls_to_rgb(number * _GOLDEN % 1.0, 0.42, 0.85))
    return red, green, blue
