"""LiDAR: where the rays of a sweep go, and the points that come back."""

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
from garage2usd.sensors.rig.lidar_settings import Lidar, SolidStateLidar, SpinningLidar

__all__ = [
    "Beams",
    "beams_of",
    "measure",
    "raster_beams",
    "rosette_beams",
    "scan",
    "spinning_beams",
]

_PRISM_RPM = 7294.0, -4664.0
"""Of the two prisms of a Livox Mid-40."""


@dataclass(frozen=True, eq=False)
class Beams:
    """The rays of a sweep in the order in which they are sent.

    Attributes
    ----------
    directions
        Unit vectors in the sensor's axes, which are ISO 8855's: x forward, y left, z up; float64, shape (n, 3).
    ring
        Number of the laser or row, from 0 at the top; uint16, shape (n,).
    """

    directions: NDArray[np.float64]
    ring: NDArray[np.uint16]


def measure(
    scene: RayScene | MovedScene, sensor: Lidar, sensor_to_world: NDArray[np.float64], *, seed: int = 0, sweep: int = 0
) -> PointCloud:
    """What a LiDAR of a rig measures in one sweep.

    Parameters
    ----------
    scene
        What its rays meet.
    sensor
        The LiDAR; its name has a part in drawing the noise, so that each has its own.
    sensor_to_world
        From its axes to the stage's, in metres, for column vectors; shape (4, 4).
    seed, sweep
        What the noise is drawn by; the number of the sweep turns rosettes on as well.

    Notes
    -----
    See `scan` for how.
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
    )


def beams_of(sensor: Lidar, sweep: int = 0) -> Beams:
    """The rays of a sweep of a LiDAR.

    Raises
    ------
    TypeError
        If it is of no kind that has rays.
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
    """The rays of lasers above each other that turn around z, from straight ahead to the left.

    Parameters
    ----------
    elevations_deg
        Of each laser over the horizon; rings are numbered from the highest one.
    azimuth_steps
        In a turn; all lasers fire at each of them.
    """
    elevations = np.radians(np.sort(np.asarray(elevations_deg, dtype=np.float64))[::-1])
    azimuths = np.arange(azimuth_steps) * (2 * math.pi / azimuth_steps)
    azimuth, elevation = (grid.ravel() for grid in np.meshgrid(azimuths, elevations, indexing="ij"))
    ring = np.tile(np.arange(len(elevations), dtype=np.uint16), azimuth_steps)
    return Beams(_directions(azimuth, elevation), ring)


def raster_beams(horizontal_deg: float, vertical_deg: float, columns: int, rows: int) -> Beams:
    """Rays through the middles of the cells of a field of view, equal in angle, row by row from the top left."""
    azimuths = math.radians(horizontal_deg) * (0.5 - (np.arange(columns) + 0.5) / columns)
    elevations = math.radians(vertical_deg) * (0.5 - (np.arange(rows) + 0.5) / rows)
    elevation, azimuth = (grid.ravel() for grid in np.meshgrid(elevations, azimuths, indexing="ij"))
    return Beams(_directions(azimuth, elevation), np.repeat(np.arange(rows, dtype=np.uint16), columns))


def rosette_beams(horizontal_deg: float, vertical_deg: float, count: int, *, begins_s: float, lasts_s: float) -> Beams:
    """Rays that two turning prisms deflect, as a Livox Mid-40's: a rosette that no sweep repeats.

    Parameters
    ----------
    horizontal_deg, vertical_deg
        Field of view, which the rosette fills as an ellipse.
    count
        Of rays, at equal times.
    begins_s, lasts_s
        When the sweep begins after the prisms stood side by side, and how long it takes.

    Notes
    -----
    Each prism deflects by a quarter of the field of view into the direction that it has turned to; small deflections
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
) -> PointCloud:
    """Send the rays of a sweep and collect what comes back.

    Parameters
    ----------
    scene
        What they meet.
    beams
        The rays.
    sensor_to_world
        From the sensor's axes to the stage's, in metres, for column vectors; shape (4, 4).
    range_m
        Least and greatest range of a return; nothing comes back from what is nearer or farther.
    range_noise_m
        Standard deviation of the range, normally distributed.
    seed, sensor, sweep
        What the noise is drawn by; a ray's does not depend on what other rays meet.

    Notes
    -----
    All rays are sent from the same place, as if the car stood while the sensor turns: what drivers of sensors deliver
    after they have compensated for the car's motion.
    """
    turn = sensor_to_world[:3, :3]
    hits = scene.cast(sensor_to_world[:3, 3], beams.directions @ turn.T)
    measured_m = hits.range_m
    if range_noise_m > 0:
        draws = generator(seed, Step.LIDAR, attempt=zlib.crc32(f"{sweep} {sensor}".encode()))
        measured_m = measured_m + draws.normal(0.0, range_noise_m, len(measured_m))
    least_m, most_m = range_m
    kept = np.flatnonzero((hits.range_m >= least_m) & (hits.range_m <= most_m))
    triangle = hits.triangle[kept]
    return PointCloud(
        (beams.directions[kept] * measured_m[kept, None]).astype(np.float32),
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
    directions: NDArray[np.float64] = np.stack(
        [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=1
    )
    return directions
