"""A drive of its own through traffic: a car that is left at the street, parks itself, stays and comes back."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import DriveConfig, Leg
from garage2usd.config.vehicles import DRIVEN_PAINT
from garage2usd.driving.timing import Motion
from garage2usd.driving.tracks import COLUMNS, Agent, AgentClass, AgentState, Floats, Track, Tracks
from garage2usd.garage.levels import nearest_floor
from garage2usd.maps.drives import DrivePlanner
from garage2usd.sensors.rig.poses import car_to_y_up
from garage2usd.stage.driving_car import body_within

AVP = "avp"
"""Name of the car."""
_STAY_S, _TRY_EVERY_S = 10.0, 1.0
_JUDGED_EVERY_S, _APART_M = 0.25, 0.3
"""Step of the check of outlines, and least distance between the car and others."""
_SAME_FLOOR_M = 1.5
_TRIED = 12


def with_own_drive(
    tracks: Tracks, garage: BuiltGarage, settings: DriveConfig, *, along: str | None, begins_s: float = 0.0
) -> Tracks:
    """Add a car to tracks that drives from the street to a stall, stays for ten seconds, and drives back.

    Parameters
    ----------
    tracks
        The tracks.
    garage
        The garage.
    settings
        Limits of the car's motion.
    along
        ``ENTRANCE:STALL``; None for the nearest entrance and the first stall that stays free and is reached.
    begins_s
        Least time at which it begins.

    Raises
    ------
    ConfigError
        If no stall is free for the whole time, or the traffic leaves no gap.

    Notes
    -----
    The others do not see the car: it sets out, and leaves its stall, at the first second at which its outline comes no
    nearer than 0.3 m to another agent until it stands.
    """
    entrance, _, stall = (along or ":").partition(":")
    if along is not None and (not stall or not (entrance.isdecimal() or not entrance)):
        raise ConfigError("along", along, "ENTRANCE:STALL as 1:A1-08")
    planner, others = DrivePlanner(garage, settings), _Others(tracks)
    for name in [stall] if stall else _free(garage, tracks):
        try:
            route = planner.drive(name, entrance=int(entrance) if entrance else None, leg=Leg.IN).route
        except ConfigError:
            if stall:
                raise
            continue
        parts, now_s = [], begins_s
        for leg in (Leg.IN, Leg.OUT):
            motion = planner.drive(name, entrance=int(entrance) if entrance else None, leg=leg).motion
            start_s = others.first_gap_s(motion, now_s, tracks.duration_s)
            if start_s is None:
                break
            parts.append((start_s, motion))
            now_s = start_s + motion.ends_s + _STAY_S
        else:
            track = _track(parts, route.stall, tracks.step_s, garage)
            ordered = sorted((*tracks, track), key=lambda each: (each.time_s[0], each.agent.name))
            return replace(tracks, tracks=tuple(ordered))
    raise ConfigError("ego", AVP, f"traffic with a gap for a drive to {stall or 'a free stall'} and back")


def _free(garage: BuiltGarage, tracks: Tracks) -> Iterator[str]:
    """Yield the names of some stalls that no car stands in at any time, spread over the garage."""
    used = {name for track in tracks for _, _, name in track.stall}
    free = [
        stall.name for stall in garage.stalls if stall.takes_cars and not stall.is_occupied and stall.name not in used
    ]
    yield from free[:: max(len(free) // _TRIED, 1)]


class _Others:
    """Outlines of the agents of tracks over time."""

    def __init__(self, tracks: Tracks) -> None:
        self._tracks = [*tracks]

    def first_gap_s(self, motion: Motion, from_s: float, until_s: float) -> float | None:
        """Return the first time, in whole seconds, at which a drive is clear of all agents; None if there is none."""
        own_s = np.arange(0.0, motion.ends_s + _JUDGED_EVERY_S, _JUDGED_EVERY_S)
        states = _states(motion, own_s)
        body = body_within(motion.car)
        own = _outlines(states, body.length_m, body.width_m)
        for start_s in np.arange(np.ceil(from_s), until_s - motion.ends_s - _STAY_S, _TRY_EVERY_S).tolist():
            if not any(_touches(own, states, track, start_s + own_s) for track in self._tracks):
                return float(start_s)
        return None


def _touches(own: NDArray[np.object_], states: Floats, track: Track, times_s: Floats) -> bool:
    found = track.at(times_s)
    reach = (track.agent.length_m + np.ptp(shapely.bounds(own[0])[[0, 2]]) + 2.0) / 2 + 2.0
    near = np.flatnonzero(
        (np.hypot(found[:, 0] - states[:, 0], found[:, 2] - states[:, 2]) < reach)
        & (np.abs(found[:, 1] - states[:, 1]) < _SAME_FLOOR_M)
    )
    if not len(near):
        return False
    others = _outlines(found[near], track.agent.length_m, track.agent.width_m)
    return bool((shapely.distance(own[near], others) < _APART_M).any())


def _outlines(states: Floats, length_m: float, width_m: float) -> NDArray[np.object_]:
    half = np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]) * (width_m / 2, 0.0, length_m / 2)
    places = car_to_y_up(states)
    corners = half @ np.swapaxes(places[:, :3, :3], 1, 2) + places[:, None, :3, 3]
    outlines: NDArray[np.object_] = shapely.polygons(corners[..., [0, 2]])
    return outlines


def _states(motion: Motion, times_s: Floats) -> Floats:
    """Return x, y, z of the middle of the footprint, yaw and pitch at times of a drive."""
    at, ahead_m = motion.at(np.minimum(times_s, motion.ends_s)), body_within(motion.car).rear_axle_m
    level = ahead_m * np.cos(at.pitch_rad)
    x, z = at.x_m - level * np.sin(at.yaw_rad), at.z_m - level * np.cos(at.yaw_rad)
    return np.stack([x, at.y_m + ahead_m * np.sin(at.pitch_rad), z, at.yaw_rad, at.pitch_rad], axis=1)


def _track(parts: list[tuple[float, Motion]], stall: str, step_s: float, garage: BuiltGarage) -> Track:
    """Return the track of the drives, between which the car is parked."""
    body = body_within(parts[0][1].car)
    sizes = body.length_m, body.width_m, body.height_m, body.rear_axle_m, body.wheelbase_m
    agent = Agent(AVP, AgentClass(body.semantic_class), *sizes, body.name, DRIVEN_PAINT)
    times, states, driven, counts = [], [], [], list[int]()
    for start_s, motion in parts:
        own_s = np.arange(0.0, motion.ends_s + step_s, step_s)
        at = motion.at(np.minimum(own_s, motion.ends_s))
        times.append(np.round(start_s + own_s, 6))
        states.append(_states(motion, own_s))
        driven.append(np.stack([at.speed_m_s, at.acceleration_m_s2, at.steering_rad], axis=1))
        counts.append(len(own_s))
    time_s, whole, motions = (np.concatenate(each) for each in (times, states, driven))
    motions[[counts[0] - 1, counts[0]], :2] = 0.0
    state = np.where(motions[:, 0] < 0, AgentState.MANOEUVRES, AgentState.DRIVES).astype(np.int8)
    state[counts[0] - 1 : counts[0]] = AgentState.PARKED
    floors = [level.place.floor_m for level in garage.levels]
    level = np.array([nearest_floor(floors, height) for height in whole[:, 1].tolist()], np.int8)
    whole[:, 3] = np.unwrap(whole[:, 3])
    columns = dict(zip(COLUMNS, (time_s, *whole.T, *motions.T), strict=True))
    stays = ((counts[0] - 1, counts[0] + 1, stall),)
    return Track(agent, **columns, state=state, level=level, stall=stays).rounded()
