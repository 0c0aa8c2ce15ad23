"""Difficulty of tracks: encounters of agents, the least time to a collision, and waits."""

from collections.abc import Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.driving.tracks import AgentClass, AgentState, Floats, Track, Tracks

_CARS = {AgentClass.CAR, AgentClass.VAN, AgentClass.TRUCK}
_STEP_S = 0.2
_NEAR_M, _REACH_M, _SAME_FLOOR_M = 2.0, 25.0, 1.5
_MOVES_M_S, _STILL_M_S = 0.2, 1e-6
_WAIT_S, _SHORTEST_S = 1.0, 1e-6


class Encounters(NamedTuple):
    """Difficulty figures of tracks.

    Attributes
    ----------
    encounters
        Number of encounters: stretches of time in which the outlines of two agents, of whom one at least is a car and
        one at least moves, and none is parked, are less than 2 m apart.
    least_ttc_s
        Least time to a collision of two such agents if both kept their velocity (Hayward, 1972); infinite for none.
    waits, longest_wait_s
        Number of waits of cars of a second or more, and the longest of them.
    """

    encounters: int
    least_ttc_s: float
    waits: int
    longest_wait_s: float


class _Going(NamedTuple):
    """States of an agent at all times: places (x, y, z), yaw and velocity (x, z), NaN where it is not there."""

    track: Track
    states: Floats
    velocity_m_s: Floats
    is_parked: NDArray[np.bool_]


def encounters(tracks: Tracks) -> Encounters:
    """Measure encounters, times to collision and waits of tracks, at 5 Hz."""
    times_s = tracks.times(_STEP_S)
    going = [_going(track, times_s) for track in tracks]
    count, least_s = 0, np.inf
    for first, second in combinations(going, 2):
        if not {first.track.agent.kind, second.track.agent.kind} & _CARS:
            continue
        rows = _near(first, second)
        if len(rows):
            gaps_m = shapely.distance(_outlines(first, rows), _outlines(second, rows))
            close = rows[gaps_m < _NEAR_M]
            count += int((np.diff(close, prepend=-2) > 1).sum())
            least_s = min(least_s, float(times_to_collision(*_pair(first, second, rows)).min()))
    waits_s = [wait for track in tracks for wait in _waits_s(track)]
    return Encounters(count, least_s, len(waits_s), max(waits_s, default=0.0))


def _going(track: Track, times_s: Floats) -> _Going:
    ends_s = np.clip(times_s + np.array([[-_STEP_S], [_STEP_S]]) / 2, track.time_s[0], track.time_s[-1])
    lasting_s = np.maximum(ends_s[1] - ends_s[0], _SHORTEST_S)
    velocity = (track.at(ends_s[1]) - track.at(ends_s[0]))[:, [0, 2]] / lasting_s[:, None]
    before = np.clip(np.searchsorted(track.time_s, times_s, side="right") - 1, 0, len(track) - 1)
    return _Going(track, track.at(times_s)[:, :4], velocity, track.state[before] == AgentState.PARKED)


def _near(first: _Going, second: _Going) -> NDArray[np.int64]:
    """Return the times at which two agents may meet: near one another, on one floor, one moving, none parked."""
    away = np.abs(first.states[:, :3] - second.states[:, :3])
    moves = np.maximum(np.linalg.norm(first.velocity_m_s, axis=1), np.linalg.norm(second.velocity_m_s, axis=1))
    is_near = (np.hypot(away[:, 0], away[:, 2]) < _REACH_M) & (away[:, 1] < _SAME_FLOOR_M) & (moves > _MOVES_M_S)
    return np.flatnonzero(is_near & ~first.is_parked & ~second.is_parked)


def _axes(yaw_rad: Floats) -> Floats:
    """Return the directions (x, z) ahead and to the right; shape (n, 2, 2)."""
    sin, cos = np.sin(yaw_rad), np.cos(yaw_rad)
    return np.stack([np.stack([-sin, -cos], axis=1), np.stack([cos, -sin], axis=1)], axis=1)


def _halves_m(going: _Going) -> Floats:
    return np.array([going.track.agent.length_m, going.track.agent.width_m]) / 2


def _outlines(going: _Going, rows: NDArray[np.int64]) -> NDArray[np.object_]:
    signs = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1)]) * _halves_m(going)
    corners = signs @ _axes(going.states[rows, 3]) + going.states[rows][:, None, [0, 2]]
    outlines: NDArray[np.object_] = shapely.polygons(corners)
    return outlines


def _pair(first: _Going, second: _Going, rows: NDArray[np.int64]) -> tuple[Floats, Floats, Floats]:
    axes = np.concatenate([_axes(each.states[rows, 3]) for each in (first, second)], axis=1)
    reach = sum(
        (np.abs(np.einsum("nij,nkj->nik", axes, _axes(each.states[rows, 3]))) @ _halves_m(each))
        for each in (first, second)
    )
    away = (second.states - first.states)[rows][:, [0, 2]]
    closing = (second.velocity_m_s - first.velocity_m_s)[rows]
    return np.asarray(reach), np.einsum("nij,nj->ni", axes, away), np.einsum("nij,nj->ni", axes, closing)


def times_to_collision(reach: Floats, away: Floats, closing: Floats) -> Floats:
    """Return the time until two rectangles that keep their velocities touch, infinite if they do not; shape (n,).

    Parameters
    ----------
    reach, away, closing
        Along each of the four directions of their sides the sum of their half extents, the distance of their centres
        and its rate; shape (n, 4).

    Notes
    -----
    Convex bodies touch while their projections overlap along all directions of sides (separating axes); each pair of
    projections does so for one interval of time.
    """
    is_still = np.abs(closing) < _STILL_M_S
    rate = np.where(is_still, 1.0, closing)
    ends = np.sort(np.stack([(-reach - away) / rate, (reach - away) / rate]), axis=0)
    never = np.where(np.abs(away) <= reach, -np.inf, np.inf)
    begins_s = np.where(is_still, never, ends[0]).max(axis=1)
    ends_s = np.where(is_still, -never, ends[1]).min(axis=1)
    times: Floats = np.where((begins_s < ends_s) & (ends_s > 0), np.maximum(begins_s, 0.0), np.inf)
    return times


def _waits_s(track: Track) -> Iterator[float]:
    """Yield the durations of the waits of a car."""
    is_waiting = (track.state == AgentState.WAITS) & (track.agent.kind in _CARS)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], is_waiting, [False]]).astype(np.int8)))
    for first, past in edges.reshape(-1, 2).tolist():
        lasted = float(track.time_s[min(past, len(track) - 1)] - track.time_s[first])
        if lasted >= _WAIT_S:
            yield lasted
