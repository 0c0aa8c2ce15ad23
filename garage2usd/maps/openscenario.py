"""OpenSCENARIO scenarios: a drive, 1.2, or all agents of tracks, 1.3, which follow trajectories among parked cars."""

import math
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import VERSION, of_extra
from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar
from garage2usd.driving.tracks import Agent, AgentClass, Track, Tracks, knots
from garage2usd.driving.trajectory import Trajectory
from garage2usd.maps.frame import heading_rad, map_point, map_points
from garage2usd.maps.parked_cars import ParkedCar
from garage2usd.maps.xml_text import element_lines, write_lines
from garage2usd.native import elementary

with of_extra("a scenario"):
    from scenariogeneration import xosc

EGO = "Ego"
"""Name of the driven car."""
_WRITTEN = datetime(2000, 1, 1, tzinfo=UTC).replace(tzinfo=None)
"""Constant time of writing, so that files are reproducible."""
_MINOR, _MINOR_OF_TRAFFIC = 2, 3
_HEIGHT_M, _WHEEL_M = 1.5, 0.62
_AFTER_S = 1.0
"""Seconds for which the scenario continues after the car has stopped."""
_SAME_S = 1e-6
_PERSON_KG, _TROLLEY_KG = 75.0, 25.0
_NEAR_M, _NEAR_RAD = 1e-3, math.radians(0.02)
"""Deviations from tracks that save vertices."""
_CATEGORIES = {
    AgentClass.CAR: xosc.VehicleCategory.car,
    AgentClass.VAN: xosc.VehicleCategory.van,
    AgentClass.TRUCK: xosc.VehicleCategory.truck,
}
_DIGITS = 6
_INDENT = "    "


def write_scenario(
    path: Path,
    trajectory: Trajectory,
    *,
    car: DesignCar,
    settings: DriveConfig,
    road_file: str,
    parked: Sequence[ParkedCar] = (),
    name: str = "drive",
    seed: int | None = None,
) -> None:
    """Write a drive as an OpenSCENARIO 1.2 file in the common map frame (`garage2usd.maps.frame`).

    Parameters
    ----------
    path
        The file.
    trajectory
        Trajectory of the car; the scenario ends a second after its last state.
    car, settings
        The car, and the limits of its motion.
    road_file
        Path of the OpenDRIVE file relative to the scenario's folder.
    parked
        The parked cars.
    name, seed
        Name and seed in the file's header.

    Notes
    -----
    Positions are those of the rear axle's middle on the floor, the origin of a vehicle in the standard; the bounding
    boxes say where the bodies are. esmini moves the box of a vehicle whose rear axle is elsewhere.
    """
    entities, init = xosc.Entities(), xosc.Init()
    entities.add_scenario_object(EGO, _design_car(car, settings))
    positions = _positions(trajectory)
    init.add_init_action(EGO, xosc.TeleportAction(positions[0]))
    init.add_init_action(EGO, _speed(0.0))
    _add_parked(parked, entities, init)
    times = [_number(time) for time in trajectory.time_s.tolist()]
    way = xosc.Trajectory(name, closed=False)
    way.add_shape(xosc.Polyline(times, positions))
    follow = xosc.FollowTrajectoryAction(way, xosc.FollowingMode.position, xosc.ReferenceContext.relative, 1, 0)
    storyboard = xosc.StoryBoard(init, _when("end", times[-1] + _AFTER_S, "stop"))
    storyboard.add_act(_act(follow))
    _write(path, name, seed, entities, storyboard, road_file=road_file, minor=_MINOR)


def write_traffic_scenario(
    path: Path, tracks: Tracks, *, road_file: str, parked: Sequence[ParkedCar] = (), name: str = "traffic"
) -> None:
    """Write tracks as an OpenSCENARIO 1.3 file in the common map frame; parameters as for `write_scenario`.

    Notes
    -----
    Each agent is an entity that follows a trajectory whose vertices have times of the simulation. Those that are not
    in the garage at the beginning are added when they come, and all are deleted when they leave before the end. Between
    vertices players interpolate linearly, and are within 1 mm and 0.02 degrees of the tracks. The origin of a car is
    its rear axle's middle, that of a person the middle of its footprint. `parked` are the cars that never move.
    """
    entities, init = xosc.Entities(), xosc.Init()
    storyboard = xosc.StoryBoard(init, _when("end", tracks.duration_s, "stop"))
    act = xosc.Act("traffic", _when("start", 0.0))
    for track in tracks:
        act.add_maneuver_group(_followed(track, tracks.duration_s, entities, init))
    _add_parked(parked, entities, init)
    if len(tracks):
        storyboard.add_act(act)
    seed = str(tracks.facts.get("seed"))
    number = int(seed) if seed.isdecimal() else None
    _write(path, name, number, entities, storyboard, road_file=road_file, minor=_MINOR_OF_TRAFFIC)


def _followed(track: Track, ends_s: float, entities: "xosc.Entities", init: "xosc.Init") -> "xosc.ManeuverGroup":
    """Add an agent to a scenario; return the manoeuvres by which it comes, follows its trajectory and leaves."""
    name = track.agent.name
    entities.add_scenario_object(name, _entity(track.agent))
    own = _kept(track)
    back_m, level = track.agent.rear_axle_m, np.cos(own.pitch_rad)
    places = np.stack([own.x_m, own.z_m], axis=1)
    places += (back_m * level)[:, None] * np.stack([np.sin(own.yaw_rad), np.cos(own.yaw_rad)], axis=1)
    positions = _world_positions(places, own.y_m - back_m * np.sin(own.pitch_rad), own.yaw_rad, own.pitch_rad)
    times = [_number(time) for time in own.time_s.tolist()]
    maneuver = xosc.Maneuver(f"{name} moves")
    if times[0] > 0:
        _add_event(maneuver, f"{name} comes", times[0], xosc.AddEntityAction(name, positions[0]))
    else:
        init.add_init_action(name, xosc.TeleportAction(positions[0]))
    if len(times) > 1:
        way = xosc.Trajectory(f"{name} way", closed=False)
        way.add_shape(xosc.Polyline(times, positions))
        follow = xosc.FollowTrajectoryAction(way, xosc.FollowingMode.position, xosc.ReferenceContext.absolute, 1, 0)
        _add_event(maneuver, f"{name} follows", times[0], follow)
    if times[-1] < ends_s - _SAME_S:
        _add_event(maneuver, f"{name} leaves", times[-1], xosc.DeleteEntityAction(name))
    group = xosc.ManeuverGroup(name)
    group.add_actor(name)
    if maneuver.events:
        group.add_maneuver(maneuver)
    return group


def _add_event(maneuver: "xosc.Maneuver", name: str, time_s: float, action: object) -> None:
    event = xosc.Event(name, xosc.Priority.parallel)
    event.add_action(name, action)
    event.add_trigger(_when(f"{name} at", time_s))
    maneuver.add_event(event)


def _kept(track: Track) -> Track:
    """Return the track with the samples between which it is linear within the tolerances."""
    if len(track) == 1:
        return track
    columns = [(column, _NEAR_M) for column in (track.x_m, track.y_m, track.z_m)]
    columns += [(column, _NEAR_RAD) for column in (track.yaw_rad, track.pitch_rad)]
    return track.sampled(track.time_s[np.unique(np.concatenate([knots(track.time_s, *one) for one in columns]))])


def _entity(agent: Agent) -> "xosc.Vehicle | xosc.Pedestrian | xosc.MiscObject":
    sizes = agent.width_m, agent.length_m, agent.height_m
    box = xosc.BoundingBox(*sizes, 0.0, 0.0, _number(agent.height_m / 2))
    if agent.kind is AgentClass.PERSON:
        entity = xosc.Pedestrian(agent.name, _PERSON_KG, xosc.PedestrianCategory.pedestrian, box)
    elif agent.kind is AgentClass.TROLLEY:
        entity = xosc.MiscObject(agent.name, _TROLLEY_KG, xosc.MiscObjectCategory.obstacle, box)
    else:
        entity = _vehicle(agent.name, *sizes, agent.rear_axle_m, agent.wheelbase_m, _CATEGORIES[agent.kind])
    if agent.behaviour:
        entity.add_property("behaviour", agent.behaviour)
    return entity


def _write(
    path: Path,
    name: str,
    seed: int | None,
    entities: "xosc.Entities",
    storyboard: "xosc.StoryBoard",
    *,
    road_file: str,
    minor: int,
) -> None:
    seeded = "" if seed is None else f", seed {seed}"
    description = f"{name}, by garage2usd {VERSION}{seeded}"
    scenario = xosc.Scenario(
        description,
        "garage2usd",
        xosc.ParameterDeclarations(),
        entities,
        storyboard,
        xosc.RoadNetwork(road_file),
        xosc.Catalog(),
        osc_minor_version=minor,
        creation_date=_WRITTEN,
    )
    # vertices of traffic stand so deep that indentation would be two thirds of the file
    indent = "" if minor == _MINOR_OF_TRAFFIC else _INDENT
    write_lines(element_lines(scenario.get_element(), indent=indent, end="/>"), path)


def _add_parked(parked: Sequence[ParkedCar], entities: "xosc.Entities", init: "xosc.Init") -> None:
    for other in parked:
        entities.add_scenario_object(other.name, _standing_car(other))
        x, y = map_point(other.middle_m)
        heading, back_m = heading_rad(other.yaw_rad), _wheelbase_m(other) / 2
        x, y = x - back_m * elementary.cos(heading), y - back_m * elementary.sin(heading)
        place = xosc.WorldPosition(_number(x), _number(y), _number(other.floor_m), _number(heading), 0.0, 0.0)
        init.add_init_action(other.name, xosc.TeleportAction(place))


def _positions(trajectory: Trajectory) -> list["xosc.WorldPosition"]:
    """Convert the trajectory's states to world positions; a nose that points up has a negative pitch."""
    places = np.stack([trajectory.x_m, trajectory.z_m], axis=1)
    return _world_positions(places, trajectory.y_m, trajectory.yaw_rad, trajectory.pitch_rad)


def _world_positions(
    places: NDArray[np.float64], heights: NDArray[np.float64], yaw: NDArray[np.float64], pitch: NDArray[np.float64]
) -> list["xosc.WorldPosition"]:
    """Convert places (x, z) of the stage, shape (n, 2), with heights, yaws and pitches, shape (n,), to positions."""
    # headings without jumps of a full turn, so that players interpolate the short way round
    headings = (math.pi / 2 + yaw).tolist()
    return [
        xosc.WorldPosition(_number(x), _number(y), _number(height), _number(heading), _number(-pitch), 0.0)
        for (x, y), height, heading, pitch in zip(
            map_points(places).tolist(), heights.tolist(), headings, pitch.tolist(), strict=True
        )
    ]


def _design_car(car: DesignCar, settings: DriveConfig) -> "xosc.Vehicle":
    middle_m = car.length_m / 2 - car.rear_overhang_m
    box = xosc.BoundingBox(car.width_m, car.length_m, _HEIGHT_M, middle_m, 0.0, _HEIGHT_M / 2)
    lock_rad = math.atan(car.wheelbase_m / car.rear_axle_radius_m)
    front = xosc.Axle(_number(lock_rad), _WHEEL_M, car.track_m, car.wheelbase_m, _WHEEL_M / 2)
    rear = xosc.Axle(0.0, _WHEEL_M, car.track_m, 0.0, _WHEEL_M / 2)
    most = settings.acceleration_m_s2
    return xosc.Vehicle("design_car", xosc.VehicleCategory.car, box, front, rear, settings.lane_speed_m_s, most, most)


def _standing_car(parked: ParkedCar) -> "xosc.Vehicle":
    width, length, height = (_number(value) for value in (parked.width_m, parked.length_m, parked.height_m))
    wheelbase_m = _wheelbase_m(parked)
    return _vehicle(parked.name, width, length, height, wheelbase_m / 2, wheelbase_m)


def _vehicle(
    name: str,
    width_m: float,
    length_m: float,
    height_m: float,
    ahead_m: float,
    wheelbase_m: float,
    category: "xosc.VehicleCategory" = xosc.VehicleCategory.car,
) -> "xosc.Vehicle":
    """Make a vehicle whose middle lies ahead of its rear axle."""
    track_m = _number(0.85 * width_m)
    box = xosc.BoundingBox(width_m, length_m, height_m, _number(ahead_m), 0.0, _number(height_m / 2))
    front = xosc.Axle(0.5, _WHEEL_M, track_m, wheelbase_m, _WHEEL_M / 2)
    rear = xosc.Axle(0.0, _WHEEL_M, track_m, 0.0, _WHEEL_M / 2)
    return xosc.Vehicle(name, category, box, front, rear, 50.0, 5.0, 8.0)


def _wheelbase_m(parked: ParkedCar) -> float:
    """Estimate a parked car's wheelbase, with axles symmetric about its middle, as scenarios require axles."""
    return _number(0.58 * parked.length_m)


def _speed(speed_m_s: float) -> "xosc.AbsoluteSpeedAction":
    at_once = xosc.TransitionDynamics(xosc.DynamicsShapes.step, xosc.DynamicsDimension.time, 0)
    return xosc.AbsoluteSpeedAction(speed_m_s, at_once)


def _act(action: "xosc.FollowTrajectoryAction") -> "xosc.Act":
    event = xosc.Event("follow", xosc.Priority.override)
    event.add_action("follow", action)
    event.add_trigger(_when("begin", 0.0))
    maneuver = xosc.Maneuver("drive")
    maneuver.add_event(event)
    group = xosc.ManeuverGroup("drive")
    group.add_actor(EGO)
    group.add_maneuver(maneuver)
    act = xosc.Act("drive", _when("start", 0.0))
    act.add_maneuver_group(group)
    return act


def _when(name: str, time_s: float, triggering: str = "start") -> "xosc.ValueTrigger":
    """Create a trigger of the simulation time."""
    later = xosc.SimulationTimeCondition(_number(time_s), xosc.Rule.greaterOrEqual)
    return xosc.ValueTrigger(name, 0, xosc.ConditionEdge.none, later, triggering)


def _number(value: float) -> float:
    return round(value, _DIGITS) + 0.0
