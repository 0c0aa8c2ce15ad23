"""Prediction tasks of tracks: the past of all agents and the future of some, as a table and as ScenarioNet's files."""

import pickle
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.common.package import of_extra
from garage2usd.driving.tracks import COLUMNS, AgentState, Floats, Track, Tracks
from garage2usd.maps.frame import map_points
from garage2usd.maps.scenario_net import STEP_S, scenario_of

PAST_S, FUTURE_S = 2.0, 6.0
"""Durations of nuScenes' prediction task."""
_EVERY_S, _LEAST_WAY_M = 2.0, 1.0
_PROTOCOL = 4


class PredictionTask(NamedTuple):
    """A prediction task: a time, and the agents whose future is asked for.

    Attributes
    ----------
    number, time_s
        Number of the task, and its time in the tracks.
    targets
        Names of the agents that are there in the whole past and future, and move by a metre or more in the future.
    tracks
        The tracks of the past and the future, whose times begin at 0 at the start of the past.
    """

    number: int
    time_s: float
    targets: tuple[str, ...]
    tracks: Tracks


def prediction_tasks(
    tracks: Tracks, *, past_s: float = PAST_S, future_s: float = FUTURE_S, every_s: float = _EVERY_S
) -> list[PredictionTask]:
    """Cut tracks into prediction tasks.

    Parameters
    ----------
    tracks
        The tracks.
    past_s, future_s
        Durations of past and future.
    every_s
        Time between two tasks.

    Returns
    -------
    list of PredictionTask
        Tasks with at least one target, in steps of 0.1 s.
    """
    found: list[PredictionTask] = []
    for time_s in np.round(np.arange(past_s, tracks.duration_s - future_s + 1e-9, every_s), 6).tolist():
        steps = np.arange(round((past_s + future_s) / STEP_S) + 1)
        times_s = np.round(time_s - past_s + steps * STEP_S, COLUMNS["time_s"])
        own = [each for each in (track.sampled(times_s) for track in tracks) if len(each)]
        targets = tuple(
            each.agent.name for each in own if len(each) == len(times_s) and _way_m(each, past_s) >= _LEAST_WAY_M
        )
        if targets:
            began_s = times_s[0]
            cut = tuple(replace(each, time_s=np.round(each.time_s - began_s, COLUMNS["time_s"])) for each in own)
            window = Tracks(cut, STEP_S, past_s + future_s, tracks.source, tracks.facts)
            found.append(PredictionTask(len(found), time_s, targets, window))
    return found


def _way_m(track: Track, past_s: float) -> float:
    """Return the way of an agent in the future."""
    future = slice(round(past_s / STEP_S), None)
    return float(np.hypot(np.diff(track.x_m[future]), np.diff(track.z_m[future])).sum())


def write_prediction_table(path: Path, tasks: Sequence[PredictionTask], *, past_s: float = PAST_S) -> None:
    """Write prediction tasks as a Parquet table with a row for each task, agent and step.

    Notes
    -----
    Columns are ``task``, ``time_s`` of the task in the tracks, ``agent``, ``class``, ``is_target``, ``step`` (0 is the
    present, negative steps of 0.1 s the past), ``x_m``, ``y_m`` and ``z_m`` in the frame of maps with z up,
    ``heading_rad`` (0 is east, counter-clockwise), ``speed_m_s`` (negative in reverse), ``length_m``, ``width_m``,
    ``height_m`` and ``state``. A task can be solved with rows of ``step <= 0``; its answer is the rows of its targets
    with ``step > 0``.
    """
    with of_extra("a table of prediction tasks", "traffic"):
        import pyarrow as pa  # noqa: PLC0415 - ScenarioNet's files do without it
        import pyarrow.parquet as pq  # noqa: PLC0415

    parts = [_rows(task, track, past_s) for task in tasks for track in task.tracks]
    names = ["task", "time_s", "agent", "class", "is_target", "step", "x_m", "y_m", "z_m", "heading_rad", "speed_m_s"]
    names += ["length_m", "width_m", "height_m", "state"]
    columns: dict[str, Any] = {name: np.concatenate([part[name] for part in parts]) if parts else [] for name in names}
    pq.write_table(pa.table(columns), path, compression="zstd", use_dictionary=["agent", "class", "state"])


def _rows(task: PredictionTask, track: Track, past_s: float) -> dict[str, Floats]:
    agent, count = track.agent, len(track)
    places = map_points(np.stack([track.x_m, track.z_m], axis=1))
    constants = {
        "task": task.number,
        "time_s": task.time_s,
        "agent": agent.name,
        "class": agent.kind.value,
        "is_target": agent.name in task.targets,
        "length_m": agent.length_m,
        "width_m": agent.width_m,
        "height_m": agent.height_m,
    }
    heading = np.mod(track.yaw_rad + 1.5 * np.pi, 2 * np.pi) - np.pi
    return {
        **{name: np.full(count, value) for name, value in constants.items()},
        "step": np.round((track.time_s - past_s) / STEP_S).astype(np.int64),
        "x_m": np.round(places[:, 0], 4),
        "y_m": np.round(places[:, 1], 4),
        "z_m": np.round(track.y_m, 4),
        "heading_rad": np.round(heading, 5),
        "speed_m_s": np.round(track.speed_m_s, 4),
        "state": np.array([AgentState(state).name.lower() for state in track.state.tolist()]),
    }


def write_prediction_scenarios(
    folder: Path, tasks: Sequence[PredictionTask], garage: BuiltGarage, *, past_s: float = PAST_S
) -> tuple[Path, ...]:
    """Write prediction tasks as a database of ScenarioNet: a pickle for each task, with a summary and a mapping.

    ``current_time_index``, ``tracks_to_predict`` and ``sdc_id`` in the metadata tell the present, the targets and the
    first of them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    summary: dict[str, dict[str, Any]] = {}
    for task in tasks:
        names = [track.agent.name for track in task.tracks]
        scenario = scenario_of(task.tracks, garage)
        scenario["id"] += f"-{task.number:04d}"
        kinds = {name: scenario["tracks"][name]["type"] for name in names}
        scenario["metadata"] |= {
            "id": scenario["id"],
            "scenario_id": scenario["id"],
            "current_time_index": round(past_s / STEP_S),
            "sdc_id": next((name for name in task.targets if kinds[name] == "VEHICLE"), task.targets[0]),
            "tracks_to_predict": {
                name: {"track_index": names.index(name), "track_id": name, "object_type": kinds[name], "difficulty": 0}
                for name in task.targets
            },
        }
        file = f"sd_garage2usd_{scenario['id']}.pkl"
        summary[file] = scenario["metadata"]
        (folder / file).write_bytes(pickle.dumps(scenario, protocol=_PROTOCOL))
    for name, table in (("dataset_summary.pkl", summary), ("dataset_mapping.pkl", dict.fromkeys(summary, ""))):
        (folder / name).write_bytes(pickle.dumps(table, protocol=_PROTOCOL))
    return tuple(sorted(folder.iterdir()))
