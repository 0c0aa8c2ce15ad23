"""OpenSCENARIO 1.2 scenario of a drive: the car follows its trajectory among parked cars."""

import math
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from garage2usd.common.package import VERSION, of_extra
from garage2usd.config.outputs import DriveConfig
from garage2usd.driving import DesignCar
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
_MINOR = 2
_HEIGHT_M, _WHEEL_M = 1.5, 0.62
_AFTER_S = 1.0
"""Seconds for which the scenario continues after the car has stopped."""
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
    entities = xosc.Entities()
    entities.add_scenario_object(EGO, _design_car(car, settings))
    init = xosc.Init()
    positions = _positions(trajectory)
    init.add_init_action(EGO, xosc.TeleportAction(positions[0]))
    init.add_init_action(EGO, _speed(0.0))
    for other in parked:
        entities.add_scenario_object(other.name, _standing_car(other))
        x, y = map_point(other.middle_m)
        heading, back_m = heading_rad(other.yaw_rad), _wheelbase_m(other) / 2
        x, y = x - back_m * elementary.cos(heading), y - back_m * elementary.sin(heading)
        place = xosc.WorldPosition(_number(x), _number(y), _number(other.floor_m), _number(heading), 0.0, 0.0)
        init.add_init_action(other.name, xosc.TeleportAction(place))
    times = [_number(time) for time in trajectory.time_s.tolist()]
    way = xosc.Trajectory(name, closed=False)
    way.add_shape(xosc.Polyline(times, positions))
    follow = xosc.FollowTrajectoryAction(way, xosc.FollowingMode.position, xosc.ReferenceContext.relative, 1, 0)
    storyboard = xosc.StoryBoard(init, _when("end", times[-1] + _AFTER_S, "stop"))
    storyboard.add_act(_act(follow))
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
        osc_minor_version=_MINOR,
        creation_date=_WRITTEN,
    )
    write_lines(element_lines(scenario.get_element(), indent=_INDENT, end="/>"), path)


def _positions(trajectory: Trajectory) -> list["xosc.WorldPosition"]:
    """Convert the trajectory's states to world positions; a nose that points up has a negative pitch."""
    places = map_points(np.stack([trajectory.x_m, trajectory.z_m], axis=1)).tolist()
    # headings without jumps of a full turn, so that players interpolate the short way round
    headings = (math.pi / 2 + trajectory.yaw_rad).tolist()
    return [
        xosc.WorldPosition(_number(x), _number(y), _number(height), _number(heading), _number(-pitch), 0.0)
        for (x, y), height, heading, pitch in zip(
            places, trajectory.y_m.tolist(), headings, trajectory.pitch_rad.tolist(), strict=True
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
    wheelbase_m, track_m = _wheelbase_m(parked), _number(0.85 * width)
    box = xosc.BoundingBox(width, length, height, _number(wheelbase_m / 2), 0.0, _number(height / 2))
    front = xosc.Axle(0.5, _WHEEL_M, track_m, wheelbase_m, _WHEEL_M / 2)
    rear = xosc.Axle(0.0, _WHEEL_M, track_m, 0.0, _WHEEL_M / 2)
    return xosc.Vehicle(parked.name, xosc.VehicleCategory.car, box, front, rear, 50.0, 5.0, 8.0)


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
