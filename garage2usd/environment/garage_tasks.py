"""Parking tasks in garages: stalls, starts on proven paths, further parked cars and traffic, drawn at random."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path as FilePath
from typing import NamedTuple

import numpy as np

from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.driving import DesignCar, Nose, Obstacles, prove_garage
from garage2usd.driving.obstacles import Floats
from garage2usd.driving.path import Path
from garage2usd.driving.tracks import Track, Tracks
from garage2usd.environment.simulation import Simulation
from garage2usd.environment.task import BEYOND_M, STEP_S, TICKS, ParkingTask
from garage2usd.garage import LaneKind, Stall
from garage2usd.garage_model import Garage
from garage2usd.garage_sources import BuiltSource, built_source, generated_of, read_built
from garage2usd.maps.level_routes import LevelRoutes
from garage2usd.pipeline import generate

Source = str | FilePath | GarageConfig | Garage
_TRIED = 200
_FURTHEST_M = 60.0
_SETTINGS = ".toml"
_EACH = 5


class _Way(NamedTuple):
    """A proven path between a lane and a stall, and whether it is clear of a car in each other stall."""

    path: Path
    is_full: bool


class GarageTasks:
    """Parking tasks in garages.

    Parameters
    ----------
    sources
        Garages: configurations, files of garages, or garages as `garage2usd.generate` returns them; at least one.
    task
        ``"park"`` drives into a stall, ``"leave"`` out of one.
    nose
        ``"in"`` or ``"out"``: the orientation of the parked car; drawn for each task if left out.
    distance_m
        Least and greatest length in metres of the path between start and goal, from which it is drawn evenly. Where the
        street is nearer, the path begins or ends there.
    filled
        Probability with which a design car stands in each empty stall, in addition to the parked cars; 0 to 1. It
        applies to paths that are proven to be clear of them all.
    tracks
        Agents that move, in the only garage, or their table (Parquet or CSV, extra ``traffic``); they do not see the
        car. The time of the start is drawn.
    steps
        Greatest number of steps of a task, for which agents are there.
    car
        The car; the design car if left out.

    Raises
    ------
    ConfigError, TracksError
        If a setting is not one of these, or a file is not such a table.

    Notes
    -----
    A task begins on a path that the planner has proven (`garage2usd.driving`), with 0.05 m between the car and all that
    stands there, so that its goal can be reached. Traffic is not part of the proof; tasks whose start or goal traffic
    stands on are not drawn. Paths are searched when they are first drawn, and kept; a garage of 90 stalls takes
    about ten seconds in all.
    """

    def __init__(
        self,
        sources: Sequence[Source],
        *,
        task: str = "park",
        nose: str | None = None,
        distance_m: tuple[float, float] = (2.0, 15.0),
        filled: float = 0.0,
        tracks: Tracks | str | FilePath | None = None,
        steps: int = 400,
        car: DesignCar | None = None,
    ) -> None:
        if task not in {"park", "leave"}:
            raise ConfigError("task", task, "park, leave")
        if nose not in {None, *Nose}:
            raise ConfigError("nose", nose, f"None, {', '.join(Nose)}")
        if not (len(distance_m) == 2 and 0 < distance_m[0] <= distance_m[1] <= _FURTHEST_M):  # noqa: PLR2004
            raise ConfigError("distance_m", distance_m, f"two ascending lengths over 0 and up to {_FURTHEST_M:g} m")
        if not 0 <= filled <= 1:
            raise ConfigError("filled", filled, "0 to 1")
        if isinstance(tracks, str | FilePath):
            from garage2usd.maps.track_tables import read_tracks  # noqa: PLC0415 - needs an extra

            tracks = read_tracks(tracks)
        if tracks is not None and (len(sources) != 1 or tracks.duration_s < steps * STEP_S):
            allowed = f"tracks of at least {steps * STEP_S:g} s, the longest task, and a single garage"
            raise ConfigError("tracks", f"{tracks.duration_s:g} s in {len(sources)} garages", allowed)
        self._is_leaving, self._distance_m, self._filled, self._tracks = task == "leave", distance_m, filled, tracks
        self._noses = tuple(Nose) if nose is None else (Nose(nose),)
        self._car, self._ticks = car or DesignCar(), steps * TICKS + 1
        self._levels: list[_Level] = []
        for source in sources:
            built = _built(source)
            self._levels += [
                _Level(level, number, LevelRoutes(level, built.drive, self._car), self._car, _tracked(tracks))
                for number, level in enumerate(built.garage.levels)
            ]
        self._stalls = [(level, stall) for level in self._levels for stall in level.routes.road.garage.stalls]
        if not self._stalls:
            raise ConfigError("source", len(sources), "garages with stalls for cars")

    def draw(self, random: np.random.Generator) -> ParkingTask:
        """Draw a task.

        Raises
        ------
        ConfigError
            If 200 draws give no stall that is proven and free of traffic.
        """
        for _ in range(_TRIED):
            level, stall = self._stalls[int(random.integers(len(self._stalls)))]
            nose = self._noses[int(random.integers(len(self._noses)))]
            distance_m = random.uniform(*self._distance_m)
            way = level.way(stall, nose, is_leaving=self._is_leaving)
            if way is not None:
                task = self._task(level, stall, way, distance_m, random)
                if self._tracks is None:
                    return task
                start_s = random.uniform(0.0, self._tracks.duration_s - (self._ticks - 1) * STEP_S / TICKS)
                among = _among(task, self._tracks, start_s, self._ticks, level.number)
                if among is not None:
                    return among
        raise ConfigError(
            "source", f"{len(self._stalls)} stalls", "garages with a free stall that cars get into and out"
        )

    def _task(
        self, level: "_Level", stall: Stall, way: _Way, distance_m: float, random: np.random.Generator
    ) -> ParkingTask:
        path = way.path.reversed() if self._is_leaving else way.path
        path = path.rest(max(path.length_m - distance_m, 0.0))
        path = path.reversed() if self._is_leaving else path
        obstacles, absent = level.around(stall)
        if self._filled and way.is_full:
            stands = random.random(len(absent.names)) < self._filled
            obstacles = obstacles.joined(absent.kept(stands[absent.owner]))
        return ParkingTask(stall.name, self._car, path.start, path.end, obstacles, path, stalls=level.corners)


class _Level:
    """A level of a garage, with the paths that were searched on it."""

    def __init__(
        self, level: BuiltLevel, number: int, routes: LevelRoutes, car: DesignCar, tracked: frozenset[str]
    ) -> None:
        self.number, self.routes, self._car = number, routes, car
        standing = routes.road.standing
        driven = [name for name in standing.names if level.place.path_in_whole(name) in tracked]
        self._standing, self._absent = standing.without(driven), routes.road.garage.absent_cars(car)
        self.corners = np.array([stall.corners for stall in level.stalls]).reshape(-1, 4, 2)
        self.around, self.way = lru_cache(maxsize=None)(self._around), lru_cache(maxsize=None)(self._way)

    def _around(self, stall: Stall) -> tuple[Obstacles, Obstacles]:
        """Return what stands around a stall, and a car in each empty stall; without what the stall itself holds."""
        own = self.routes.road.garage.unseen(stall)
        return self._standing.without(own), self._absent.without(own)

    def _way(self, stall: Stall, nose: Nose, *, is_leaving: bool) -> _Way | None:
        """Return the path into a stall from as far as the street, or out of it; None if none is proven."""
        routes = self.routes
        (proof,) = prove_garage(routes.road.garage, [stall], car=self._car, noses=(nose,), most_explained=0)
        if proof.way_in is None or proof.way_out is None:
            return None
        portals = routes.router.portals(LaneKind.EXIT if is_leaving else LaneKind.ENTRANCE)
        led = routes.leg_of(stall.name, proof, portals, parked=None, is_in=not is_leaving)
        own = Path.of_way(proof.way_out if is_leaving else proof.way_in)
        return _Way(own if led is None else led[0], proof.is_full)


def _built(source: Source) -> BuiltSource:
    """Return a garage as built of any source."""
    if isinstance(source, str | FilePath):
        path = FilePath(source)
        if path.suffix.lower() != _SETTINGS:
            return read_built(path)
        source = generated_of(path, None)
    garage = generate(source) if isinstance(source, GarageConfig) else source
    return built_source(garage, source="a garage")


def _tracked(tracks: Tracks | None) -> frozenset[str]:
    """Return the prims of the parked cars that tracks move."""
    return frozenset(track.agent.prim for track in tracks or () if track.agent.prim)


def _among(task: ParkingTask, tracks: Tracks, start_s: float, ticks: int, level: int) -> ParkingTask | None:
    """Return a task among the agents near it from a time on; None if an agent stands on its start or goal."""
    times = start_s + np.arange(ticks) * (STEP_S / TICKS)
    (x, z), half_m = task.arena
    moving, sizes = [], []
    for track in tracks:
        poses = _on_level(track, times, level)
        if (np.abs(poses[:, :2] - (x, z)).max(axis=1, initial=0.0) < half_m + BEYOND_M).any():
            moving.append(poses)
            sizes.append((track.agent.length_m, track.agent.width_m))
    if not moving:
        return task
    among = replace(task, moving=np.stack(moving, axis=1), sizes_m=np.array(sizes))
    probe = Simulation(1)
    for pose, last in ((task.start, 1), (task.goal, ticks)):
        probe.place(0, replace(among, start=pose))
        for tick in range(0, last, _EACH * TICKS):
            probe.lot.ticks[0] = tick
            if probe.touching()[0]:
                return None
    return among


def _on_level(track: Track, times: Floats, level: int) -> Floats:
    """Return x, z and yaw of an agent at times, NaN while it is elsewhere; shape (n, 3)."""
    poses = track.at(times)[:, [0, 2, 3]]
    before = np.clip(np.searchsorted(track.time_s, times, side="right") - 1, 0, len(track) - 1)
    poses[track.level[before] != level] = np.nan
    return poses
