"""LiDAR simulation: the rays of a sweep, and the point cloud of the returns."""

import math
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.randomness import Step, generator
from garage2usd.sensors.rays.moved_scene import MovedScene
from garage2usd.sensors.rays.point_cloud import PointCloud
from garage2usd.sensors.rays.ray_scene import RayScene
from garage2usd.sensors.rays.reflectance import returned
from garage2usd.sensors.rig.sensors import Lidar, SolidStateLidar, SpinningLidar

_PRISM_RPM = 7294.0, -4664.0
"""Speeds of the two rotating prisms of a Livox Mid-40."""


@dataclass(frozen=True, eq=False)
class Beams:
    """The rays of a LiDAR sweep in firing order.

    Attributes
    ----------
    directions
        Unit vectors in the sensor's axes (ISO 8855: x forward, y left, z up); float64, shape (n, 3).
    ring
        Index of the laser or row, from 0 at the top; uint16, shape (n,).
    """

    directions: NDArray[np.float64]
    ring: NDArray[np.uint16]


def measure(
    scene: RayScene | MovedScene,
    sensor: Lidar,
    sensor_to_world: NDArray[np.float64],
    *,
    seed: int = 0,
    sweep: int = 0,
    given_in: NDArray[np.float64] | None = None,
) -> PointCloud:
    """Simulate one sweep of a rig's LiDAR.

    Parameters
    ----------
    scene
        Surfaces that the rays may hit.
    sensor
        The LiDAR; its name is part of the noise's seed, so that each LiDAR has noise of its own.
    sensor_to_world
        Transform from the LiDAR's axes to the stage's, in metres, for column vectors; shape (4, 4), or (rays, 4, 4) of
        a LiDAR that moves during the sweep.
    seed, sweep
        Seed of the noise and number of the sweep; rosettes advance with the sweep as well.
    given_in
        As of `scan`.

    Notes
    -----
    See `scan` for the method.
    """
    return scan(
        scene,
        beams_of(sensor, sweep),
        sensor_to_world,
        range_m=sensor.range_m,
        range_noise_m=sensor.range_noise_m,
        seed=seed,
        sensor=sensor.name,
        sweep=sweep,
        given_in=given_in,
    )


def ray_times_s(sensor: Lidar) -> NDArray[np.float64]:
    """Return the time of each ray of a sweep from the middle of the sweep; all lasers that spin fire together."""
    match sensor:
        case SpinningLidar():
            turns = np.repeat(np.arange(sensor.azimuth_steps) / sensor.azimuth_steps, len(sensor.beams_deg))
        case SolidStateLidar():
            turns = np.arange(sensor.columns * sensor.rows) / (sensor.columns * sensor.rows)
        case _:
            raise TypeError(f"{type(sensor).__name__} has no rays")
    times: NDArray[np.float64] = (turns - 0.5) / sensor.rate_hz
    return times


def beams_of(sensor: Lidar, sweep: int = 0) -> Beams:
    """Return the rays of one sweep of a LiDAR.

    Raises
    ------
    TypeError
        If the sensor is of an unknown kind of LiDAR.
    """
    match sensor:
        case SpinningLidar():
            return spinning_beams(sensor.beams_deg, sensor.azimuth_steps)
        case SolidStateLidar(pattern="rosette"):
            return rosette_beams(
                sensor.horizontal_deg,
                sensor.vertical_deg,
                sensor.columns * sensor.rows,
                begins_s=sweep / sensor.rate_hz,
                lasts_s=1 / sensor.rate_hz,
            )
        case SolidStateLidar():
            return raster_beams(sensor.horizontal_deg, sensor.vertical_deg, sensor.columns, sensor.rows)
    raise TypeError(f"{type(sensor).__name__} has no rays")


def spinning_beams(elevations_deg: Sequence[float], azimuth_steps: int) -> Beams:
    """Return the rays of a spinning LiDAR: stacked lasers that turn about z, from straight ahead to the left.

    Parameters
    ----------
    elevations_deg
        Elevation of each laser over the horizon; rings are numbered from the highest one.
    azimuth_steps
        Steps per revolution; all lasers fire at each step.
    """
    elevations = np.radians(np.sort(np.asarray(elevations_deg, dtype=np.float64))[::-1])
    azimuths = np.arange(azimuth_steps) * (2 * math.pi / azimuth_steps)
    azimuth, elevation = (grid.ravel() for grid in np.meshgrid(azimuths, elevations, indexing="ij"))
    ring = np.tile(np.arange(len(elevations), dtype=np.uint16), azimuth_steps)
    return Beams(_directions(azimuth, elevation), ring)


def raster_beams(horizontal_deg: float, vertical_deg: float, columns: int, rows: int) -> Beams:
    """Return the rays of a solid-state LiDAR: a raster of equal angles, row by row from the top left."""
    azimuths = math.radians(horizontal_deg) * (0.5 - (np.arange(columns) + 0.5) / columns)
    elevations = math.radians(vertical_deg) * (0.5 - (np.arange(rows) + 0.5) / rows)
    elevation, azimuth = (grid.ravel() for grid in np.meshgrid(elevations, azimuths, indexing="ij"))
    return Beams(_directions(azimuth, elevation), np.repeat(np.arange(rows, dtype=np.uint16), columns))


def rosette_beams(horizontal_deg: float, vertical_deg: float, count: int, *, begins_s: float, lasts_s: float) -> Beams:
    """Return the rays of a LiDAR with two rotating prisms, as in a Livox Mid-40: a rosette that no sweep repeats.

    Parameters
    ----------
    horizontal_deg, vertical_deg
        Field of view, which the rosette fills as an ellipse.
    count
        Number of rays, equally spaced in time.
    begins_s, lasts_s
        Start of the sweep since the prisms were aligned, and duration of the sweep.

    Notes
    -----
    Each prism deflects the ray by a quarter of the field of view in the direction of its rotation; small deflections
    add up.
    """
    times = begins_s + lasts_s * np.arange(count) / count
    first, second = (2 * math.pi * rpm / 60 * times for rpm in _PRISM_RPM)
    azimuth = math.radians(horizontal_deg) / 4 * (np.cos(first) + np.cos(second))
    elevation = math.radians(vertical_deg) / 4 * (np.sin(first) + np.sin(second))
    return Beams(_directions(azimuth, elevation), np.zeros(count, dtype=np.uint16))


def scan(
    scene: RayScene | MovedScene,
    beams: Beams,
    sensor_to_world: NDArray[np.float64],
    *,
    range_m: tuple[float, float],
    range_noise_m: float = 0.0,
    seed: int = 0,
    sensor: str = "",
    sweep: int = 0,
    given_in: NDArray[np.float64] | None = None,
) -> PointCloud:
    """Cast the rays of a LiDAR sweep and collect their returns as a point cloud.

    Parameters
    ----------
    scene
        Surfaces that the rays may hit.
    beams
        The rays.
    sensor_to_world
        Transform from the sensor's axes to the stage's, in metres, for column vectors; shape (4, 4), or (rays, 4, 4) of
        a sensor that moves during the sweep.
    range_m
        Least and greatest range of a return.
    range_noise_m
        Standard deviation of the range, normally distributed.
    seed, sensor, sweep
        Seed, sensor name and sweep number that determine the noise; the noise of a ray is independent of the other
        rays' hits.
    given_in
        Pose in whose axes a moving sensor's points are given, as by a driver that compensates for the ego motion; shape
        (4, 4). None gives each point in the axes of its own ray.

    Notes
    -----
    All rays of a sensor that stands start at the same place.
    """
    ways = (sensor_to_world[..., :3, :3] @ beams.directions[:, :, None])[..., 0]
    origins = np.broadcast_to(sensor_to_world[..., :3, 3], ways.shape)
    hits = scene.cast(origins, ways)
    measured_m = hits.range_m
    if range_noise_m > 0:
        draws = generator(seed, Step.LIDAR, attempt=zlib.crc32(f"{sweep} {sensor}".encode()))
        measured_m = measured_m + draws.normal(0.0, range_noise_m, len(measured_m))
    least_m, most_m = range_m
    kept = np.flatnonzero((hits.range_m >= least_m) & (hits.range_m <= most_m))
    triangle = hits.triangle[kept]
    points_m = beams.directions[kept] * measured_m[kept, None]
    if given_in is not None:
        points_m = (origins[kept] + ways[kept] * measured_m[kept, None] - given_in[:3, 3]) @ given_in[:3, :3]
    return PointCloud(
        points_m.astype(np.float32),
        _intensity(scene, triangle, hits.cos_incidence[kept]),
        scene.instance[triangle].astype(np.uint32),
        scene.class_id[triangle],
        beams.ring[kept],
        kept.astype(np.uint32),
    )


def _intensity(
    scene: RayScene | MovedScene, triangle: NDArray[np.int64], cos_incidence: NDArray[np.float64]
) -> NDArray[np.float32]:
    surface, intensity = scene.surface[triangle], np.zeros(len(triangle), dtype=np.float32)
    for number in np.unique(surface).tolist():
        own = surface == number
        intensity[own] = returned(scene.surfaces[number], cos_incidence[own])
    return intensity


def _directions(azimuth: NDArray[Any], elevation: NDArray[Any]) -> NDArray[np.float64]:
    level = np.cos(elevation)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=1)
