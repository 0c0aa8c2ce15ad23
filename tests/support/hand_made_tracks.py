"""Tracks made by hand: proven drives of cars, one of which parks for ten seconds, a car of the stage, and a person."""

from dataclasses import replace

import numpy as np

from garage2usd.config.outputs import Leg
from garage2usd.config.vehicles import DRIVEN_BODIES, body_named
from garage2usd.driving.tracks import Agent, AgentClass, AgentState, Track, Tracks
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.parked_cars import parked_cars

STEP_S = 0.1
PARKED_S = 10.0
COLUMNS = ("x_m", "y_m", "z_m", "yaw_rad", "pitch_rad", "speed_m_s", "acceleration_m_s2", "steering_rad")


def track_of(agent, time_s, *, level=0, state=AgentState.DRIVES, stall=(), **columns):
    """A track of columns that may be numbers; speeds and accelerations follow from the places if left out."""
    count = len(time_s)
    full = {name: np.broadcast_to(np.asarray(columns.get(name, 0.0), float), count).copy() for name in COLUMNS}
    if "speed_m_s" not in columns and count > 1:
        full["speed_m_s"] = np.hypot(np.gradient(full["x_m"], time_s), np.gradient(full["z_m"], time_s))
        full["acceleration_m_s2"] = np.gradient(full["speed_m_s"], time_s)
    whole = {
        name: np.broadcast_to(np.asarray(value, np.int8), count).copy()
        for name, value in (("state", state), ("level", level))
    }
    return Track(agent, np.asarray(time_s, float), stall=stall, **full, **whole)


def car(name, body="hatchback", paint="red", **more):
    found = body_named(body)
    sizes = found.length_m, found.width_m, found.height_m, found.rear_axle_m, found.wheelbase_m
    return Agent(name, AgentClass.CAR, *sizes, body, paint, **more)


def person(name, **more):
    return Agent(name, AgentClass.PERSON, 0.5, 0.6, 1.8, body="0", **more)


def driven(garage, name, stall, *, begins_s=0.0, body="hatchback", paint="red"):
    """A car that drives into a stall, parks there for ten seconds, and leaves."""
    planner, agent = DrivePlanner(garage), car(name, body, paint)
    parts, begins, counts = [], begins_s, []
    for leg in (Leg.IN, Leg.OUT):
        motion = planner.drive(stall, leg=leg).motion
        own = np.arange(0.0, motion.ends_s + STEP_S, STEP_S)
        states = motion.at(np.minimum(own, motion.ends_s))
        back = agent.rear_axle_m
        columns = {column: getattr(states, column) for column in COLUMNS}
        columns["x_m"] = states.x_m - back * np.sin(states.yaw_rad) * np.cos(states.pitch_rad)
        columns["z_m"] = states.z_m - back * np.cos(states.yaw_rad) * np.cos(states.pitch_rad)
        columns["y_m"] = states.y_m + back * np.sin(states.pitch_rad)
        parts.append((begins + own, columns))
        counts.append(len(own))
        begins += own[-1] + PARKED_S
    time_s = np.round(np.concatenate([time for time, _ in parts]) / STEP_S) * STEP_S
    columns = {column: np.concatenate([part[column] for _, part in parts]) for column in COLUMNS}
    for column in ("speed_m_s", "acceleration_m_s2"):
        columns[column][[counts[0] - 1, counts[0]]] = 0.0
    # two whole turns apart, the headings of the legs are one
    columns["yaw_rad"] = np.unwrap(columns["yaw_rad"])
    floors = np.array([level.place.floor_m for level in garage.levels])
    level = np.abs(columns["y_m"][:, None] - floors).argmin(axis=1)
    state = np.full(len(time_s), AgentState.DRIVES, np.int8)
    parked = slice(counts[0] - 1, counts[0] + 1)
    state[parked] = AgentState.PARKED
    stalls = ((parked.start, parked.stop, stall),)
    return track_of(agent, time_s, level=level, state=state, stall=stalls, **columns)


def walker(name, start, end, *, begins_s=0.0, stands_s=5.0, speed_m_s=1.25, y_m=0.0, level=0):
    """A person who walks from one place (x, z) to another, stands there, and walks back."""
    start, end = np.array(start, float), np.array(end, float)
    way = end - start
    seconds = round(float(np.linalg.norm(way)) / speed_m_s / STEP_S) * STEP_S
    there = np.arange(0.0, seconds + STEP_S / 2, STEP_S)
    share = np.concatenate([there / seconds, [1.0], 1 - there / seconds])
    turns_s = seconds + stands_s
    time_s = np.concatenate([there, [turns_s - STEP_S], there + turns_s])
    time_s = np.round((begins_s + time_s) / STEP_S) * STEP_S
    places = start + share[:, None] * way
    yaw = np.arctan2(-way[0], -way[1])
    yaws = np.repeat([yaw, yaw + np.pi], [len(there) + 1, len(there)])
    state = np.full(len(time_s), AgentState.WALKS, np.int8)
    state[len(there) - 1 : len(there) + 1] = AgentState.STANDS
    return track_of(
        person(name), time_s, x_m=places[:, 0], z_m=places[:, 1], y_m=y_m, yaw_rad=yaws, state=state, level=level
    )


def staged(garage, number=0, *, name="car_900", back_m=1.0):
    """A parked car of the stage that stands ten seconds and then backs out a little."""
    found = parked_cars(garage)[number]
    level, path = next((level, path) for level in garage.levels for path in level.cars)
    body = min(DRIVEN_BODIES, key=lambda one: abs(one.length_m - found.length_m))
    agent = replace(car(name, body.name), prim=level.place.path_in_whole(path))
    agent = replace(agent, length_m=found.length_m, width_m=found.width_m)
    moving = np.arange(0.0, 2 * back_m, STEP_S)
    time_s = np.round(np.concatenate([[0.0], PARKED_S + moving]) / STEP_S) * STEP_S  # stands from 0 to the next
    gone = np.concatenate([[0.0], back_m * (1 - np.cos(np.pi * moving / (2 * back_m))) / 2])
    state = np.full(len(time_s), AgentState.MANOEUVRES, np.int8)
    state[0] = AgentState.PARKED
    return track_of(
        agent,
        time_s,
        x_m=found.middle_m[0] + gone * np.sin(found.yaw_rad),
        z_m=found.middle_m[1] + gone * np.cos(found.yaw_rad),
        y_m=found.floor_m,
        yaw_rad=found.yaw_rad,
        speed_m_s=-np.gradient(gone, time_s),
        state=state,
        stall=((0, len(time_s), "Stall"),),
    )


def tracks_of(*tracks, source="garage", **facts):
    """The tracks in the order of their first samples."""
    ordered = tuple(sorted(tracks, key=lambda track: (track.time_s[0], track.agent.name)))
    ends = max(float(track.time_s[-1]) for track in ordered)
    return Tracks(ordered, STEP_S, ends, source, facts, ("car_001 waits at 3.0 s",))


def hand_made(garage):
    """Two cars that drive to free stalls, one of the stage, and a person; 60 s apart, so that none touches."""
    taken = {level.place.in_whole(home.name) for level in garage.levels for _, home in level.cars.values() if home}
    free = [stall.name for stall in garage.stalls if stall.takes_cars and stall.name not in taken]
    x, z = garage.lanes.nodes[garage.stalls[0].access].position
    return tracks_of(
        driven(garage, "car_000", free[0]),
        driven(garage, "car_001", free[-1], begins_s=60.0, body="saloon", paint="blue"),
        staged(garage),
        walker("person_000", (x - 1.5, z), (x + 1.5, z), begins_s=300.0),
        seed=3,
        agents={"car": 3, "person": 1},
    )
