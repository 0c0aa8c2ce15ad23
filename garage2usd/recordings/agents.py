"""Agents of tracks around a recording: where each is at the times of the poses, its models and labels."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets import Asset
from garage2usd.assets.figures import figure_asset
from garage2usd.assets.gait import walked
from garage2usd.assets.poses import Pose
from garage2usd.driving.tracks import AgentClass, AgentState, Floats, Track, Tracks
from garage2usd.objects.car import car_spec
from garage2usd.objects.trolley import TrolleySpec
from garage2usd.reading.labels import Labels
from garage2usd.sensors.formats.ros_scene import MarkedAgent
from garage2usd.sensors.rig.poses import CAR_FROM_VEHICLE, Matrix, Twist, VehiclePose, car_to_y_up
from garage2usd.stage.agent_models import CARS, body_of
from garage2usd.stage.ego_car import AGENTS_PATH, RestingAgent
from garage2usd.stage.prototypes import asset_of
from garage2usd.stage.track_people import figure_of

_HALF_S = 0.05
"""Time before and after a pose between which velocities are measured."""
_DIGITS = 4
_SAME_FLOOR_M = 1.5
_HALF_TURN = np.diag([-1.0, 1.0, -1.0, 1.0])


@dataclass(frozen=True)
class _Walking(Pose):
    """Pose of a person by the rotations of the joints."""

    joints: NDArray[np.float64] | None = None

    def turns(self) -> NDArray[np.float64]:
        """Return the rotations of the joints in the axes of the figure; shape (joints, 3, 3)."""
        return super().turns() if self.joints is None else self.joints


class Agents:
    """The agents of tracks, except the ego, at the times of a recording's poses.

    Parameters
    ----------
    tracks
        The tracks.
    times_s
        Time of each pose; shape (n,).
    ego
        Name of the agent that carries the sensors; empty for none.
    """

    def __init__(self, tracks: Tracks, times_s: Floats, ego: str = "") -> None:
        self.tracks = tracks
        self._times_s, self._ego = times_s, ego
        self._others = [track for track in tracks if track.agent.name != ego]
        self._there = [np.isfinite(track.at(times_s)[:, 0]) for track in self._others]
        self._kept = [number for number, there in enumerate(self._there) if there.any()]
        self._ids: dict[int, int] = {}
        self._part_ids: dict[tuple[int, int], int] = {}
        for number in self._kept:
            agent = self._others[number].agent
            if agent.kind in CARS:
                body_of(agent)

    @property
    def hidden_prims(self) -> list[str]:
        """Paths of the parked cars of the stage that are agents of the tracks."""
        return [track.agent.prim for track in self.tracks if track.agent.prim]

    def labelled(self, labels: Labels, first: int) -> Labels:
        """Return labels with an id for each agent from a first one on, and one for each pose of a person."""
        classes = {entry.name: number for number, entry in labels.classes.items()}
        ids, class_ids, parts = dict(labels.ids), dict(labels.class_ids), dict(labels.parts)
        for number, owner in enumerate(self._kept, first):
            self._ids[owner], ids[self._path(owner)] = number, number
            class_ids[number] = classes.get(self._others[owner].agent.kind.value, 0)
        people = ((owner, pose) for owner in self._kept if self._walks(owner) for pose in self._poses(owner))
        for number, (owner, pose) in enumerate(people, first + len(self._kept)):
            self._part_ids[owner, pose] = ids[self._path(owner, pose)] = number
            parts[number], class_ids[number] = self._ids[owner], class_ids[self._ids[owner]]
        return replace(labels, ids=ids, class_ids=class_ids, parts=parts)

    def _is_car(self, owner: int) -> bool:
        return self._others[owner].agent.kind in CARS

    def _walks(self, owner: int) -> bool:
        return self._others[owner].agent.kind is AgentClass.PERSON

    def _poses(self, owner: int) -> list[int]:
        """Numbers of the poses at which an agent is there."""
        return [number for number, there in enumerate(self._there[owner].tolist()) if there]

    def _path(self, owner: int, pose: int | None = None) -> str:
        return f"{AGENTS_PATH}/Agent_{owner:04d}" + ("" if pose is None else f"/At_{pose:04d}")

    @cached_property
    def models(self) -> list[RestingAgent]:
        """The agents' meshes at the origin: one for each car, and one for each pose of a person."""
        found = []
        for owner in self._kept:
            agent = self._others[owner].agent
            if self._walks(owner):
                figures = zip(self._poses(owner), self._figures(owner), strict=True)
                found += [RestingAgent(self._path(owner, pose), asset) for pose, asset in figures]
            else:
                is_car = agent.kind in CARS
                asset = asset_of(car_spec(body_of(agent), agent.paint) if is_car else TrolleySpec())
                found.append(RestingAgent(self._path(owner), asset, agent.paint))
        return found

    def _figures(self, owner: int) -> Iterator[Asset]:
        """Meshes of a person at each of its poses, who walks with feet that stay on the floor."""
        track = self._others[owner]
        _, drawn, factor = figure_of(track.agent)
        figure = drawn._replace(height_m=drawn.height_m * factor)
        own_s = self._times_s[self._there[owner]]
        times_s = np.union1d(track.time_s, own_s)
        states = track.at(times_s)
        motion = walked(figure.skeleton, times_s, states[:, [0, 2]], states[:, 3] + np.pi)
        for row in np.searchsorted(times_s, own_s).tolist():
            yield figure_asset(figure, _Walking(joints=motion.turns[row]))

    def shown(self, pose: int) -> dict[int, tuple[int, int]]:
        """Return the agents that are there at a pose: number of the track and id of the model, by id of the agent."""
        return {
            self._ids[owner]: (owner, self._part_ids.get((owner, pose), self._ids[owner]))
            for owner in self._kept
            if self._there[owner][pose]
        }

    def hidden(self, pose: int) -> list[int]:
        """Return the ids of the models that are not there at a pose."""
        there = {model for _, model in self.shown(pose).values()}
        models = [self._ids[owner] for owner in self._kept if not self._walks(owner)]
        return [number for number in [*models, *self._part_ids.values()] if number not in there]

    def moved(self, pose: int, to_stage: Matrix) -> dict[int, Matrix]:
        """Return the transform of each model that is there from the origin, in the stage's axes, by its id."""
        time_s = self._times_s[pose : pose + 1]
        return {model: self.model_places(owner, time_s, to_stage)[0] for owner, model in self.shown(pose).values()}

    def model_places(self, owner: int, times_s: Floats, to_stage: Matrix) -> Matrix:
        """Return the transforms of an agent's model from the origin at times, in the stage's axes."""
        # figures and trolleys look to +Z, agents to -Z
        turn = np.eye(4) if self._is_car(owner) else _HALF_TURN
        placed: Matrix = to_stage @ self.places(owner, times_s) @ turn @ np.linalg.inv(to_stage)
        return placed

    def places(self, owner: int, times_s: Floats) -> Matrix:
        """Return the transforms of an agent to metres with Y up at times; its ends hold beyond them."""
        track = self._others[owner]
        return car_to_y_up(track.at(_within(track, times_s)))

    def track(self, owner: int) -> Track:
        """Return the track of an agent by its number."""
        return self._others[owner]

    def velocity_m_s(self, owner: int, time_s: float) -> Floats:
        """Return the velocity of the middle of an agent's footprint in metres with Y up; shape (3,)."""
        track = self._others[owner]
        around = _within(track, np.array([time_s - _HALF_S, time_s + _HALF_S]))
        if around[0] == around[1]:
            return np.zeros(3)
        before, after = track.at(around)[:, :3]
        velocity: Floats = (after - before) / (around[1] - around[0])
        return velocity

    def stalls_taken(self, pose: int, grounds: Mapping[str, NDArray[np.float64]]) -> set[str]:
        """Return the names of those stalls, of corners (x, z), in which the middle of a car is at a pose."""
        import shapely  # noqa: PLC0415 - frames without slots do not need it

        owners = [owner for owner, _ in self.shown(pose).values() if self._is_car(owner)]
        middles = [self.places(owner, self._times_s[pose : pose + 1])[0, [0, 2], 3] for owner in owners]
        points = shapely.points(np.array(middles).reshape(-1, 2))
        return {name for name, corners in grounds.items() if shapely.intersects(shapely.Polygon(corners), points).any()}

    def outlines_m(self, pose: int, floor_m: float) -> list[Floats]:
        """Return the corners of the cars on or near a floor at a pose, in metres with Y up; each shape (4, 3)."""
        found = []
        for owner, _ in self.shown(pose).values():
            agent, place = self._others[owner].agent, self.places(owner, self._times_s[pose : pose + 1])[0]
            if self._is_car(owner) and abs(place[1, 3] - floor_m) < _SAME_FLOOR_M:
                half = np.array([agent.width_m, 0.0, agent.length_m]) / 2
                corners = half * np.array([(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)])
                found.append(corners @ place[:3, :3].T + place[:3, 3])
        return found

    def facts(self, to_stage: Matrix) -> dict[str, object]:
        """Describe the agents, and where each is at each pose, in the stage's axes, for the table of frames."""
        agents = [
            {
                "id": self._ids[owner],
                "path": self._path(owner),
                "name": agent.name,
                "class": agent.kind.value,
                "size_m": [agent.length_m, agent.width_m, agent.height_m],
                "body": agent.body,
                "paint": agent.paint,
                "prim": agent.prim,
                "behaviour": agent.behaviour,
            }
            for owner in self._kept
            for agent in (self._others[owner].agent,)
        ]
        states = [[self._state(owner, pose, to_stage) for owner, _ in self.shown(pose).values()]
                  for pose in range(len(self._times_s))]  # fmt: skip
        return {"source": self.tracks.source, "ego": self._ego, "agents": agents, "states": states}

    def marked(self, to_stage: Matrix) -> list[list[MarkedAgent]]:
        """Return the agents at each pose, in the stage's axes."""
        return [
            [self._marked(owner, float(time_s), to_stage) for owner, _ in self.shown(pose).values()]
            for pose, time_s in enumerate(self._times_s)
        ]

    def _marked(self, owner: int, time_s: float, to_stage: Matrix) -> MarkedAgent:
        agent = self._others[owner].agent
        to_world = to_stage @ self.places(owner, np.array([time_s]))[0] @ CAR_FROM_VEHICLE
        size_m = agent.length_m, agent.width_m, agent.height_m
        return MarkedAgent(self._ids[owner], agent.name, agent.kind.value, size_m, to_world)

    def _state(self, owner: int, pose: int, to_stage: Matrix) -> dict[str, object]:
        time_s = float(self._times_s[pose])
        track = self._others[owner]
        (row,) = track.sampled(np.array([time_s])).state.tolist()
        to_world = to_stage @ self.places(owner, np.array([time_s]))[0] @ CAR_FROM_VEHICLE
        velocity = to_stage[:3, :3] @ self.velocity_m_s(owner, time_s)
        return {
            "id": self._ids[owner],
            "agent_to_world": np.round(to_world, 6).tolist(),
            "velocity_m_s": [round(float(value), _DIGITS) + 0.0 for value in velocity],
            "speed_m_s": round(float(np.interp(time_s, track.time_s, track.speed_m_s)), _DIGITS) + 0.0,
            "state": AgentState(row).name.lower(),
        }


def ego_poses(track: Track, times_s: Floats, to_stage: Matrix) -> list[VehiclePose]:
    """Return the poses of a car of tracks at times at which it is there, by the middle of its rear axle."""
    gone = np.linalg.norm(np.diff(np.stack([track.x_m, track.y_m, track.z_m]), axis=1), axis=0)
    distance_m = np.interp(times_s, track.time_s, np.concatenate([[0.0], np.cumsum(gone)]))

    def find_twist(time_s: float) -> Twist:
        around = _within(track, np.array([time_s - _HALF_S, time_s + _HALF_S]))
        before, after = vehicle_places(track, around)
        return Twist.between(before, after, float(around[1] - around[0]))

    return [
        VehiclePose(time, arc, to_stage @ place, lambda time=time: find_twist(time))  # type: ignore[misc]
        for time, arc, place in zip(times_s.tolist(), distance_m.tolist(), vehicle_places(track, times_s), strict=True)
    ]


def vehicle_places(track: Track, times_s: Floats) -> Matrix:
    """Return a car's transform from ISO 8855 axes at its rear axle to metres with Y up; its ends hold beyond them."""
    to_axle = np.eye(4)
    to_axle[2, 3] = track.agent.rear_axle_m
    places: Matrix = car_to_y_up(track.at(_within(track, times_s))) @ to_axle @ CAR_FROM_VEHICLE
    return places


def _within(track: Track, times_s: Floats) -> Floats:
    """Return times within those of a track."""
    return np.clip(times_s, track.time_s[0], track.time_s[-1])
