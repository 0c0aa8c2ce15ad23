"""Recordings of a garage by the LiDARs of a rig, and cameras whose pictures are plain."""

import numpy as np
from PIL import Image

from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.sensors.formats.recording import Recording, Shot
from garage2usd.sensors.rays.lidar import measure
from garage2usd.sensors.rays.point_cloud import CloudFormat, write_cloud
from garage2usd.sensors.rays.ray_scene import read_ray_scene
from garage2usd.sensors.rig.sensors import Lidar

AHEAD_IS_X = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
"""From the axes of a vehicle that drives along +X to those of a stage with Y up."""


def vehicle_at(x, z, turn_deg=0.0):
    """A vehicle on the floor that looks along +X, turned to the left."""
    turn = np.radians(turn_deg)
    matrix = np.eye(4)
    left = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    matrix[:3, :3] = AHEAD_IS_X @ left
    matrix[:3, 3] = x, 0, z
    return matrix


class Recorded:
    """A recording at some crossings of lanes, half a second apart, and what was recorded."""

    def __init__(self, built, rig, folder, places=3):
        self.built = built
        self.stage = open_stage(built.stage)
        self.labels = read_labels(self.stage, built.stage)
        self.scene = read_ray_scene(self.stage, self.labels)
        self.clouds, self.vehicles, shots = [], [], []
        nodes = [node.position for node in read_lanes(self.stage).nodes if not node.is_portal]
        for pose, (x, z) in enumerate(nodes[:: len(nodes) // places][:places]):
            vehicle = vehicle_at(float(x), float(z), 35.0 * pose)
            self.vehicles.append(vehicle)
            for sensor in rig.sensors:
                name = f"{sensor.name}_{pose:04}"
                if isinstance(sensor, Lidar):
                    cloud = measure(self.scene, sensor, vehicle @ sensor.sensor_to_vehicle, sweep=pose)
                    self.clouds.append(cloud)
                    path = folder / f"{name}.npz"
                    write_cloud(cloud, path, CloudFormat.NPZ)
                    files = {"npz": path}
                else:
                    path = folder / f"{name}.png"
                    Image.new("RGB", sensor.size_px, (pose, 100, 200)).save(path)
                    files = {"colour": path}
                shots.append(Shot(name, sensor, pose, pose / 2, vehicle, files))
        self.recording = Recording(rig.name, built.stage, tuple(shots))
