"""Folder of maps for Autoware: Lanelet2 map, projection, point cloud map, and poses to start from and to park at."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltGarage, BuiltLevel
from garage2usd.config.outputs import MapsConfig
from garage2usd.driving.car import DesignCar
from garage2usd.driving.garage import Nose
from garage2usd.garage import Stall
from garage2usd.maps.autoware_lanelets import add_autoware_level
from garage2usd.maps.driven_lanelets import DrivenLanelet, entered
from garage2usd.maps.frame import heading_rad, map_point
from garage2usd.maps.ground_plan import LevelPlan
from garage2usd.maps.lanelet2 import add_buildings, write_map
from garage2usd.maps.level_networks import LevelNetwork, level_networks
from garage2usd.maps.osm_file import OsmFile
from garage2usd.maps.point_cloud_map import point_cloud, write_point_cloud

Floats = NDArray[np.float64]
_STEP_M = 1.0
_START = 0.2
"""Share of the lanelet into a level after which the rear axle of a car is that starts there."""
_DIGITS = 4


def write_autoware(
    garage: BuiltGarage,
    folder: Path,
    settings: MapsConfig,
    *,
    plans: Sequence[LevelPlan],
) -> None:
    """Write the maps of a garage into a folder, as Autoware's launch files take it for `map_path`.

    Parameters
    ----------
    garage
        The garage of a stage.
    folder
        The folder, which is created.
    settings
        Geographic position and speed limit.
    plans
        The ground plans of its levels.

    Raises
    ------
    StageError
        If a level has no complete lane graph, or a ramp leads to no landing.

    Notes
    -----
    Autoware looks lanelets and parking lots up by x and y alone. A garage of several levels has a map of each of them
    beside that of all, for planning on this level.
    """
    folder.mkdir()
    eyes = write_lanelet_maps(garage, folder, settings, plans)
    if garage.stage is None:
        raise ValueError("a garage without a stage")
    write_point_cloud(point_cloud(garage.stage, eyes), folder)


def write_lanelet_maps(
    garage: BuiltGarage, folder: Path, settings: MapsConfig, plans: Sequence[LevelPlan]
) -> NDArray[np.float64]:
    """Write the files of an existing folder but the point cloud, and return places along all lanes; shape (n, 3)."""
    starts: list[str] = []
    every = list(zip(level_networks(garage, on_its_side=True), plans, strict=True))
    lanelets, osm = _write_map(garage, folder / "lanelet2_map.osm", settings, every)
    for network, plan in every if len(every) > 1 else ():
        _write_map(garage, folder / f"lanelet2_map_{network.level.place.name}.osm", settings, [(network, plan)])
    eyes = []
    for (network, _), own in zip(every, lanelets, strict=True):
        osm.floor_m = 0.0
        centres = [_centre(osm, lanelet) for lanelet in own]
        eyes += centres
        starts += _starts(network.level, own, centres)
    goals = [line for network, _ in every for line in _goals(network.level)]
    car = DesignCar()
    lines = [
        "# Poses of base_link, the middle of the rear axle on the floor, for a car of these measures",
        f"# in metres: length {car.length_m}, wheelbase {car.wheelbase_m}, rear overhang {car.rear_overhang_m}.",
        "frame_id: map",
        *("starts:", *starts),
        *("goals:", *goals),
    ]
    _write_text(folder / "goal_poses.yaml", lines)
    _write_text(folder / "map_projector_info.yaml", ["projector_type: Local"])
    return np.concatenate(eyes)


def _write_map(
    garage: BuiltGarage, path: Path, settings: MapsConfig, levels: Sequence[tuple[LevelNetwork, LevelPlan]]
) -> tuple[list[tuple[DrivenLanelet, ...]], OsmFile]:
    """Write the map of some levels, and return the lanelets of each, and the map with their points."""
    osm, lanelets = OsmFile(settings.latitude_deg, settings.longitude_deg), []
    for (level, network), plan in levels:
        osm.floor_m = level.place.floor_m
        lanelets.append(add_autoware_level(osm, level, network, settings))
        add_buildings(osm, plan)
    write_map(osm, garage, path)
    return lanelets, osm


def _centre(osm: OsmFile, lanelet: DrivenLanelet) -> Floats:
    """Return points about a metre apart along the middle of a lanelet; shape (n, 3)."""
    sides = [np.array([osm.place(point) for point in points]) for points in (lanelet.left, lanelet.right)]
    lines = [shapely.LineString(side) for side in sides]
    shares = np.linspace(0.0, 1.0, max(2, math.ceil(max(line.length for line in lines) / _STEP_M) + 1))
    left, right = (
        shapely.get_coordinates(shapely.line_interpolate_point(line, shares, normalized=True), include_z=True)
        for line in lines
    )
    middle: Floats = (left + right) / 2
    return middle


def _starts(level: BuiltLevel, lanelets: Sequence[DrivenLanelet], centres: Sequence[Floats]) -> Iterator[str]:
    """Yield the entries of the poses at which a car comes into a level, from the street or down a ramp."""
    centre_of = dict(zip(lanelets, centres, strict=True))
    for number, lanelet in enumerate(entered(lanelets, level), start=1):
        line = shapely.LineString(centre_of[lanelet])
        place, ahead = (
            shapely.get_coordinates(line.interpolate(share, normalized=True), include_z=True)[0]
            for share in (_START, _START + 0.05)
        )
        pose = _pose((place[0], place[1]), place[2], math.atan2(*(ahead - place)[1::-1]))
        yield f"  - {{name: {_quoted(f'{level.place.name} {number}'.strip())}, pose: {pose}}}"


def _goals(level: BuiltLevel) -> Iterator[str]:
    """Yield the entry of each stall for cars, with the pose of a car parked nose in and nose out."""
    taken = level.taken_stalls
    for stall in level.stalls:
        if stall.takes_cars:
            facts: Mapping[str, str] = {
                "stall": _quoted(stall.name),
                "number": _quoted("" if stall.number is None else level.place.own_name(str(stall.number))),
                "level": _quoted(level.place.name),
                "use": _quoted(str(stall.use)),
                "occupied": json.dumps(stall in taken),
                **{f"nose_{nose}": _parked(stall, nose, level.place.floor_m) for nose in Nose},
            }
            yield f"  - {{{', '.join(f'{name}: {value}' for name, value in facts.items())}}}"


def _parked(stall: Stall, nose: Nose, floor_m: float) -> str:
    pose = DesignCar().centred(stall.centre, stall.yaw_rad + nose.turn_rad)
    return _pose(map_point((pose.x_m, pose.z_m)), floor_m, heading_rad(pose.yaw_rad))


def _pose(place: tuple[float, float], height_m: float, heading: float) -> str:
    """Return a pose in the form of the message geometry_msgs/Pose."""
    x, y, z, sine, cosine = (
        round(float(value), _DIGITS) + 0.0 for value in (*place, height_m, math.sin(heading / 2), math.cos(heading / 2))
    )
    return f"{{position: {{x: {x}, y: {y}, z: {z}}}, orientation: {{x: 0.0, y: 0.0, z: {sine}, w: {cosine}}}}}"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _write_text(path: Path, lines: Sequence[str]) -> None:
    path.write_text("\n".join([*lines, ""]), encoding="utf-8", newline="\n")
