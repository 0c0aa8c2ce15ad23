"""Tracks as floating car data of SUMO: for each time step the vehicles and persons in the garage."""

import math
from pathlib import Path

import numpy as np

from garage2usd.driving.tracks import AgentClass, Tracks
from garage2usd.maps.frame import map_points
from garage2usd.maps.xml_text import number_text, tag_text, write_lines

STEP_S = 1.0
"""Default step, that of SUMO."""
_DIGITS = 3


def write_floating_car_data(path: Path, tracks: Tracks, *, step_s: float = STEP_S) -> None:
    """Write tracks as SUMO's ``fcd-export`` in the common map frame (`garage2usd.maps.frame`).

    Parameters
    ----------
    path
        The file.
    tracks
        The tracks.
    step_s
        Time step.

    Notes
    -----
    As SUMO writes them, a vehicle's place is the middle of its front, a person's the middle; angles are degrees
    clockwise from north. Speeds have no sign there, so that a car in reverse has the amount of its speed.
    """
    times = tracks.times(step_s)
    rows: list[tuple[list[str], list[str]]] = [([], []) for _ in times]
    for track in tracks:
        own, agent = track.sampled(times), track.agent
        is_person = agent.kind is AgentClass.PERSON
        ahead_m = 0.0 if is_person else agent.length_m / 2
        level = ahead_m * np.cos(own.pitch_rad)
        fronts = np.stack([own.x_m - level * np.sin(own.yaw_rad), own.z_m - level * np.cos(own.yaw_rad)], axis=1)
        columns = {
            "x": map_points(fronts)[:, 0],
            "y": map_points(fronts)[:, 1],
            "z": own.y_m + ahead_m * np.sin(own.pitch_rad),
            "angle": np.mod(np.degrees(-own.yaw_rad), 360.0),
            "speed": np.abs(own.speed_m_s),
            "slope": np.degrees(own.pitch_rad),
        }
        texts = {name: [number_text(round(value, _DIGITS)) for value in column] for name, column in columns.items()}
        first = round(own.time_s[0] / step_s) if len(own) else 0
        for number in range(len(own)):
            values = {name: column[number] for name, column in texts.items()}
            head = {"id": agent.name, "x": values["x"], "y": values["y"], "z": values["z"], "angle": values["angle"]}
            head |= {"type": agent.body or str(agent.kind), "speed": values["speed"], "slope": values["slope"]}
            rows[first + number][is_person].append(f"        {tag_text('person' if is_person else 'vehicle', head)}/>")
    lines = ["<fcd-export>"]
    for time, (vehicles, people) in zip(times.tolist(), rows, strict=True):
        lines += [f'    <timestep time="{time:.{_digits(step_s)}f}">', *vehicles, *people, "    </timestep>"]
    write_lines([*lines, "</fcd-export>"], path)


def _digits(step_s: float) -> int:
    """Decimals of times: at least the two of SUMO."""
    return max(2, -math.floor(math.log10(step_s)) + 1)
