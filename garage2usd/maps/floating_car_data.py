"""Tracks as floating car data of SUMO: for each time step the vehicles and persons in the garage; and their types."""

import math
from pathlib import Path

import numpy as np

from garage2usd.driving.tracks import Agent, AgentClass, Tracks
from garage2usd.maps.frame import map_points
from garage2usd.maps.xml_text import number_text, tag_text, write_lines

STEP_S = 1.0
"""Default step, that of SUMO."""
_DIGITS = 3
_TAGS = {AgentClass.PERSON: "person", AgentClass.TROLLEY: "container"}
"""Elements of agents that are not vehicles."""
_ORDER = ["vehicle", "person", "container"]
_CLASSES = {
    AgentClass.CAR: "passenger",
    AgentClass.VAN: "delivery",
    AgentClass.TRUCK: "truck",
    AgentClass.PERSON: "pedestrian",
    AgentClass.TROLLEY: "container",
}


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
    As SUMO writes them, a vehicle's place is the middle of its front, that of a person or a container, which a trolley
    is, the middle; angles are degrees clockwise from north. Speeds have no sign there, so that a car in reverse has the
    amount of its speed. The type of an agent is its body or class, and a special behaviour after a point.
    """
    times = tracks.times(step_s)
    rows: list[dict[str, list[str]]] = [{tag: [] for tag in _ORDER} for _ in times]
    for track in tracks:
        own, agent = track.sampled(times), track.agent
        tag = _TAGS.get(agent.kind, "vehicle")
        ahead_m = agent.length_m / 2 if tag == "vehicle" else 0.0
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
            head |= {"type": _type(agent), "speed": values["speed"], "slope": values["slope"]}
            rows[first + number][tag].append(f"        {tag_text(tag, head)}/>")
    lines = ["<fcd-export>"]
    for time, row in zip(times.tolist(), rows, strict=True):
        lines.append(f'    <timestep time="{time:.{_digits(step_s)}f}">')
        lines += [line for tag in _ORDER for line in row[tag]]
        lines.append("    </timestep>")
    write_lines([*lines, "</fcd-export>"], path)


def write_vehicle_types(path: Path, tracks: Tracks) -> None:
    """Write the types of the agents of tracks, with class and size, as an additional file of SUMO.

    The size of a type is that of its largest agent.
    """
    found: dict[str, list[Agent]] = {}
    for track in tracks:
        found.setdefault(_type(track.agent), []).append(track.agent)
    lines = ["<additional>"]
    for name, agents in sorted(found.items()):
        sizes = {
            side: number_text(max(getattr(agent, f"{side}_m") for agent in agents))
            for side in ("length", "width", "height")
        }
        lines.append(f"    {tag_text('vType', {'id': name, 'vClass': _CLASSES[agents[0].kind], **sizes})}/>")
    write_lines([*lines, "</additional>"], path)


def _type(agent: Agent) -> str:
    # bodies of people are numbers
    body = agent.body if agent.kind not in _TAGS else ""
    return ".".join(filter(None, (body or str(agent.kind), agent.behaviour)))


def _digits(step_s: float) -> int:
    """Decimals of times: at least the two of SUMO."""
    return max(2, -math.floor(math.log10(step_s)) + 1)
