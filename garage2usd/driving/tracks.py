"""Tracks: the states of everything that moves in a garage in operation, agent by agent over time."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum, StrEnum

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.package import drawn_by

Floats = NDArray[np.float64]
COLUMNS = {
    "time_s": 6,
    "x_m": 4,
    "y_m": 4,
    "z_m": 4,
    "yaw_rad": 5,
    "pitch_rad": 5,
    "speed_m_s": 4,
    "acceleration_m_s2": 4,
    "steering_rad": 5,
}
"""Columns of floats of a track, with the decimals to which files have them."""
_SAME_TIME_S = 1e-9
_APART = 1000.0


class AgentClass(StrEnum):
    """Semantic class of an agent."""

    CAR = "car"
    VAN = "van"
    TRUCK = "truck"
    PERSON = "person"
    TROLLEY = "shopping_trolley"


class AgentState(IntEnum):
    """State of an agent at a time."""

    DRIVES = 0
    WAITS = 1
    MANOEUVRES = 2
    PARKED = 3
    WALKS = 4
    STANDS = 5


@dataclass(frozen=True)
class Agent:
    """An agent: a vehicle or a person.

    Attributes
    ----------
    name
        Unique name, such as ``car_007`` or ``person_012``.
    kind
        Semantic class.
    length_m, width_m, height_m
        Size of its bounding box: along its heading, across, and up; of cars without mirrors.
    rear_axle_m
        Distance from the middle of the footprint back to the rear axle; 0 for persons.
    wheelbase_m
        Distance between the axles; 0 for persons.
    body
        Key of the catalogue of cars (`garage2usd.config.vehicles.CAR_BODIES`), or of the catalogue of people.
    paint
        Paint of a car, one of `PAINTS`; empty for persons.
    prim
        Path of the prim of a car that stands parked in the stage when the tracks begin; empty for others.
    behaviour
        Special behaviour by which the agent is labelled, such as ``waits_for_stall`` or ``runs``; empty for usual ones.
    """

    name: str
    kind: AgentClass
    length_m: float
    width_m: float
    height_m: float
    rear_axle_m: float = 0.0
    wheelbase_m: float = 0.0
    body: str = ""
    paint: str = ""
    prim: str = ""
    behaviour: str = ""


@dataclass(frozen=True, eq=False)
class Track:
    """The states of one agent; all arrays have shape (n,).

    Attributes
    ----------
    agent
        The agent.
    time_s
        Ascending multiples of the step of the tracks. Between samples that are further apart than a step the agent
        stands still. The agent is in the garage from the first sample to the last, both included.
    x_m, y_m, z_m
        Middle of its footprint on the floor, in the stage's frame: Y is up.
    yaw_rad
        Heading, right-handed about +Y, 0 points to -Z; continuous in time.
    pitch_rad
        Pitch of the floor under the agent, positive with the nose up.
    speed_m_s
        Speed along the floor, negative in reverse.
    acceleration_m_s2
        Rate of the speed.
    steering_rad
        Mean angle of the front wheels, positive to the left; 0 for persons.
    state
        `AgentState` by number; int8.
    level
        Number of its level, from 0; the upper one on the upper half of a ramp; int8.
    stall
        Name of the stall that it parks in or leaves, for each sample of a car that manoeuvres or is parked; empty
        otherwise. As intervals: (first sample, past the last sample, name).
    """

    agent: Agent
    time_s: Floats
    x_m: Floats
    y_m: Floats
    z_m: Floats
    yaw_rad: Floats
    pitch_rad: Floats
    speed_m_s: Floats
    acceleration_m_s2: Floats
    steering_rad: Floats
    state: NDArray[np.int8]
    level: NDArray[np.int8]
    stall: tuple[tuple[int, int, str], ...] = ()

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.time_s)

    def at(self, times_s: Floats) -> NDArray[np.float64]:
        """Return (x, y, z, yaw, pitch) at times, NaN where the agent is not in the garage; shape (len(times_s), 5)."""
        columns = (self.x_m, self.y_m, self.z_m, self.yaw_rad, self.pitch_rad)
        return np.stack(
            [np.interp(times_s, self.time_s, column, left=np.nan, right=np.nan) for column in columns], axis=1
        )

    def sampled(self, times_s: Floats) -> "Track":
        """Return the track at those of some ascending times at which the agent is in the garage.

        Numbers are interpolated linearly; states, levels and stalls are those of the sample before.
        """
        first, last = self.time_s[0] - _SAME_TIME_S, self.time_s[-1] + _SAME_TIME_S
        times = times_s[(times_s >= first) & (times_s <= last)]
        before = np.searchsorted(self.time_s, times + _SAME_TIME_S, side="right") - 1
        spans = ((*np.searchsorted(before, (start, end)).tolist(), name) for start, end, name in self.stall)
        columns = {name: np.interp(times, self.time_s, getattr(self, name)) for name in COLUMNS}
        stall = tuple((start, end, name) for start, end, name in spans if start < end)
        return Track(self.agent, **columns, state=self.state[before], level=self.level[before], stall=stall)

    def axle_m(self, back_m: float) -> Floats:
        """Return the places of a rear axle on the floor, a distance behind the middle; shape (n, 3)."""
        along = back_m * np.cos(self.pitch_rad)
        off = along * np.sin(self.yaw_rad), -back_m * np.sin(self.pitch_rad), along * np.cos(self.yaw_rad)
        places: Floats = np.stack([self.x_m, self.y_m, self.z_m], axis=1) + np.stack(off, axis=1)
        return places

    def rolled_m(self, back_m: float) -> Floats:
        """Return the way of a rear axle since the first sample, negative in reverse; shape (n,)."""
        steps = np.diff(self.axle_m(back_m), axis=0)
        ahead = np.stack([-np.sin(self.yaw_rad), -np.cos(self.yaw_rad)], axis=1)
        # signed by the heading, halfway between two samples
        signs = np.sign((steps[:, [0, 2]] * (ahead[1:] + ahead[:-1])).sum(axis=1))
        return np.concatenate([[0.0], np.cumsum(signs * np.linalg.norm(steps, axis=1))])

    def rounded(self) -> "Track":
        """Return the track with the decimals of `COLUMNS`."""
        columns = {name: np.round(getattr(self, name), digits) + 0.0 for name, digits in COLUMNS.items()}
        return Track(self.agent, **columns, state=self.state, level=self.level, stall=self.stall)


@dataclass(frozen=True, eq=False)
class Tracks:
    """The tracks of a garage in operation.

    Attributes
    ----------
    tracks
        One track for each agent that moves, in the order of their first samples; cars that never move are those of the
        stage.
    step_s
        Step of the samples.
    duration_s
        Duration of the tracks; they begin at 0.
    source
        File of the garage.
    facts
        Seed, settings and counts, as JSON can hold them.
    log
        One line for each event that a user may ask about: agents that were stuck, arrivals turned away.
    """

    tracks: tuple[Track, ...]
    step_s: float
    duration_s: float
    source: str = ""
    facts: Mapping[str, object] = field(default_factory=dict)
    log: tuple[str, ...] = ()

    _repr_html_ = drawn_by("garage2usd.view.notebook", "tracks_html")

    def rounded(self) -> "Tracks":
        """Return the tracks with the decimals of `COLUMNS`, which a table preserves."""
        return replace(self, tracks=tuple(track.rounded() for track in self.tracks))

    def times(self, step_s: float | None = None) -> Floats:
        """Return the times of all steps from 0 on, or of those of another step."""
        step = step_s or self.step_s
        return np.round(np.arange(int(self.duration_s / step + _SAME_TIME_S) + 1) * step, COLUMNS["time_s"])

    def __repr__(self) -> str:
        """Return the number of agents and the duration."""
        return f"<Tracks of {len(self)} agents in {self.duration_s:g} s>"

    def __iter__(self) -> Iterator[Track]:
        """Iterate over the tracks."""
        return iter(self.tracks)

    def __len__(self) -> int:
        """Return the number of tracks."""
        return len(self.tracks)


def knots(times: Floats, values: Floats, tolerance: float) -> NDArray[np.int64]:
    """Find samples between which a value is linear in time within a tolerance, by Douglas and Peucker (1973).

    Parameters
    ----------
    times, values
        Ascending times, and a value at each; shape (n,), of at least two.
    tolerance
        Greatest deviation.

    Returns
    -------
    ndarray
        Indices of the samples, with the first and the last.
    """
    # times are spaced so far apart that the distance from a line equals the difference in value
    apart = times * _APART
    line = shapely.LineString(np.stack([apart, values], axis=1)).simplify(tolerance, preserve_topology=False)
    kept: NDArray[np.int64] = np.searchsorted(apart, shapely.get_coordinates(line)[:, 0])
    return kept
