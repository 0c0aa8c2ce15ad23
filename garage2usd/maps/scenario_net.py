"""Tracks as a scenario of ScenarioNet, a dictionary that MetaDrive plays: agents, and lanes as a map."""

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.package import VERSION
from garage2usd.driving.tracks import AgentClass, AgentState, Track, Tracks
from garage2usd.maps.frame import map_points

STEP_S = 0.1
"""Step of MetaDrive's scenarios."""
_PROTOCOL = 4
_TYPES = {AgentClass.PERSON: "PEDESTRIAN", AgentClass.TROLLEY: "OTHER"}
"""Types of MetaDrive that are not vehicles."""


def write_scenario_net(path: Path, tracks: Tracks, garage: BuiltGarage, *, step_s: float = STEP_S) -> None:
    """Write tracks as a pickled dictionary in the form of MetaDrive's ``ScenarioDescription``.

    Parameters
    ----------
    path
        The file.
    tracks
        The tracks.
    garage
        The garage, whose lanes are the map.
    step_s
        Time step.
    """
    path.write_bytes(pickle.dumps(scenario_of(tracks, garage, step_s=step_s), protocol=_PROTOCOL))


def scenario_of(tracks: Tracks, garage: BuiltGarage, *, step_s: float = STEP_S) -> dict[str, Any]:
    """Return tracks in the form of MetaDrive's ``ScenarioDescription``; parameters as of `write_scenario_net`.

    Notes
    -----
    All is in the common map frame (`garage2usd.maps.frame`), with heights as third coordinates. The dictionary holds
    NumPy arrays and types of Python only. ``sdc_id`` names the vehicle that is in the garage longest, of
    those that are there at the beginning if there are any.
    """
    times = tracks.times(step_s)
    agents = {track.agent.name: _agent(track, times) for track in tracks}
    vehicles = [track for track in tracks if track.agent.kind not in _TYPES]
    # MetaDrive's own car begins where this one is at the first step
    longest = max(
        vehicles, key=lambda track: (track.time_s[0] == 0, float(track.time_s[-1] - track.time_s[0])), default=None
    )
    stem = Path(tracks.source).stem or "garage"
    return {
        "id": f"{stem}-{tracks.facts.get('seed', 0)}",
        "version": f"garage2usd {VERSION}",
        "length": len(times),
        "tracks": agents,
        "dynamic_map_states": {},
        "map_features": _lanes(garage),
        "metadata": {
            "ts": times.astype(np.float32),
            "metadrive_processed": False,
            "coordinate": "metadrive",
            "dataset": "garage2usd",
            "scenario_id": f"{stem}-{tracks.facts.get('seed', 0)}",
            "sample_rate": step_s,
            "sdc_id": longest.agent.name if longest else "",
            "source_file": tracks.source,
        },
    }


def _agent(track: Track, times: np.ndarray[Any, np.dtype[np.float64]]) -> dict[str, Any]:
    """Return an agent with states at all times, which are 0 where it is not in the garage."""
    own, agent = track.sampled(times), track.agent
    heading = own.yaw_rad + np.pi / 2
    speed = np.where((own.state == AgentState.PARKED) | (own.state == AgentState.STANDS), 0.0, own.speed_m_s)
    first = int(np.searchsorted(times, own.time_s[0] - 1e-9)) if len(own) else 0
    there = slice(first, first + len(own))
    values: dict[str, Any] = {
        "position": np.column_stack([map_points(np.stack([own.x_m, own.z_m], axis=1)), own.y_m]),
        "heading": np.mod(heading + np.pi, 2 * np.pi) - np.pi,
        "velocity": speed[:, None] * np.stack([np.cos(heading), np.sin(heading)], axis=1),
        "length": np.full(len(own), agent.length_m),
        "width": np.full(len(own), agent.width_m),
        "height": np.full(len(own), agent.height_m),
    }
    state: dict[str, Any] = {"valid": np.zeros(len(times), bool)}
    state["valid"][there] = True
    for name, column in values.items():
        state[name] = np.zeros((len(times), *column.shape[1:]), np.float32)
        state[name][there] = column
    kind = _TYPES.get(agent.kind, "VEHICLE")
    metadata = {
        "type": kind,
        "track_length": len(times),
        "object_id": agent.name,
        "dataset": "garage2usd",
        "class": str(agent.kind),
        "body": agent.body,
        "behaviour": agent.behaviour,
    }
    return {"type": kind, "state": state, "metadata": metadata}


def _lanes(garage: BuiltGarage) -> dict[str, dict[str, Any]]:
    """Return the lanes as features of a map, one for each direction of an edge of the lane graph."""
    lanes, found = garage.lanes, {}
    if lanes is None:
        return {}
    arcs = {arc: f"lane_{number}" for number, arc in enumerate(lanes.arcs)}
    for (start, end), edge in lanes.arcs.items():
        nodes = lanes.nodes[start], lanes.nodes[end]
        line = map_points([node.position for node in nodes])
        if np.allclose(line[0], line[1]):
            continue
        ground = shapely.LineString(line).buffer(edge.width_m / 2, cap_style="flat")
        after = [arcs[end, other] for other in lanes.onward[end] if other != start and (end, other) in arcs]
        before = [arcs[other, start] for other in lanes.backward[start] if other != end and (other, start) in arcs]
        found[arcs[start, end]] = {
            "type": "LANE_SURFACE_UNSTRUCTURE",
            "polyline": np.column_stack([line, [node.height_m for node in nodes]]).astype(np.float32),
            "polygon": shapely.get_coordinates(ground)[:-1].astype(np.float32),
            "width": float(edge.width_m),
            "entry_lanes": before,
            "exit_lanes": after,
            "left_neighbor": [],
            "right_neighbor": [],
            "speed_limit_kmh": 10.0,
        }
    return found
