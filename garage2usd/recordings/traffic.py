"""The traffic around a recording, and the times of its poses."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.driving.tracks import AgentState, Floats, Track, Tracks
from garage2usd.stage.agent_models import CARS


@dataclass(frozen=True, eq=False)
class Traffic:
    """The traffic around a recording.

    Attributes
    ----------
    tracks
        The tracks.
    ego
        Name of the car of the tracks that carries the sensors, `AVP` for a car with a drive of its own, or empty for
        sensors in the world only.
    every_s
        Time between two poses.
    between_s
        First and last time of the recording; None for all.
    """

    tracks: Tracks
    ego: str = ""
    every_s: float = 0.5
    between_s: tuple[float, float] | None = None


def pose_times(
    tracks: Tracks, ego: str, every_s: float, between_s: tuple[float, float] | None
) -> tuple[Track | None, Floats]:
    """Choose the times of a recording's poses: multiples of a step at which the ego is there and is not parked.

    Raises
    ------
    ConfigError
        If the ego is not a car of the tracks, or no time is left.
    """
    begins_s, ends_s = between_s or (0.0, tracks.duration_s)
    times: Floats = np.round(np.arange(np.ceil(begins_s / every_s - 1e-9), ends_s / every_s + 1e-9) * every_s, 6)
    track = None
    if ego:
        cars = {each.agent.name: each for each in tracks if each.agent.kind in CARS}
        track = cars.get(ego)
        if track is None:
            raise ConfigError("ego", ego, f"avp, or a car of the tracks: {_some([*cars])}")
        times = times[(times >= track.time_s[0]) & (times <= track.time_s[-1])]
        times = times[track.sampled(times).state != AgentState.PARKED]
    if not len(times):
        raise ConfigError("between", between_s, f"times at which {ego or 'the tracks'} can be recorded")
    return track, times


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "")  # noqa: PLR2004
