"""A recording in traffic of a small garage: an ego, cars that move in its sight, and a person."""

from types import SimpleNamespace

import numpy as np
from pxr import Sdf, Usd, UsdGeom

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.recordings import CloudFormat, Traffic, record
from garage2usd.stage.traffic import write_traffic_layer
from support.hand_made_tracks import driven, staged, tracks_of, walker
from support.small_garage import SETTINGS

TOP = {
    "kind": "spinning_lidar",
    "name": "top",
    "position_m": (0.6, 0.0, 1.8),
    "channels": 24,
    "lowest_deg": -25.0,
    "highest_deg": 5.0,
    "azimuth_steps": 720,
    "range_m": (0.3, 60.0),
    "rate_hz": 5.0,
}
EGO = "car_000"


def busy(garage):
    """Two cars, one eight seconds behind the other, a car that backs out, and a person who walks along an aisle."""
    free = [stall.name for stall in garage.stalls if stall.takes_cars and not stall.is_occupied]
    x, z = garage.lanes.nodes[garage.stalls[0].access].position
    return tracks_of(
        driven(garage, EGO, free[-1]),
        driven(garage, "car_001", free[0], begins_s=5.0, body="saloon", paint="blue"),
        staged(garage),
        walker("person_000", (x - 1.5, z + 2.0), (x + 1.5, z + 2.0), begins_s=4.0),
        seed=3,
    )


class Recorded:
    """The stage, the tracks, and what the LiDAR of the ego recorded of them."""

    def __init__(self, folder, rig, *, ego=EGO, between_s=(6.0, 14.0), **options):
        self.folder, self.stage = folder, garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "g.usdc").stage
        self.garage = garage_of_file(self.stage)
        self.tracks = busy(self.garage)
        self.by_name = {track.agent.name: track for track in self.tracks}
        self.traffic = Traffic(self.tracks, ego, 0.5, between_s)
        options = {"points": [CloudFormat.NPZ], **options}
        self.made = record(self.stage, folder / "out", rig=rig, traffic=self.traffic, **options)
        self.layers = self._played(folder)

    def _played(self, folder):
        """The tracks as a layer over time, by other code than that of recordings."""
        write_traffic_layer(folder / "traffic.usdc", self.tracks)
        layer = Sdf.Layer.CreateNew(str(folder / "whole.usda"))
        layer.subLayerPaths = ["./traffic.usdc", f"./{self.stage.name}"]
        layer.Save()
        return Usd.Stage.Open(str(folder / "whole.usda"))

    def placed(self, name, time_s):
        """Transform of an agent at a time from the axes of its prim, for column vectors, by USD."""
        prim = UsdGeom.Xformable(self.layers.GetPrimAtPath(f"/Garage/Traffic/{name}"))
        return np.array(prim.ComputeLocalToWorldTransform(Usd.TimeCode(time_s * 24.0))).T

    def body(self, name):
        """Triangles of a car at rest, with its wheels, in the axes of its prim."""
        root = self.layers.GetPrimAtPath(f"/Garage/Traffic/{name}")
        cache, found = UsdGeom.XformCache(0.0), []
        to_prim = cache.GetLocalToWorldTransform(root).GetInverse()
        for prim in Usd.PrimRange(root, Usd.TraverseInstanceProxies()):
            if prim.IsA(UsdGeom.Mesh):
                mesh = UsdGeom.Mesh(prim)
                matrix = np.array(cache.GetLocalToWorldTransform(prim) * to_prim)
                points = np.array(mesh.GetPointsAttr().Get(), float) @ matrix[:3, :3] + matrix[3, :3]
                counts, corners = (
                    np.array(each.Get()) for each in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
                )
                starts = np.cumsum(counts) - counts
                for step in range(1, counts.max() - 1):
                    large = starts[counts >= step + 2]
                    found.append(points[np.stack([corners[large + each] for each in (0, step, step + 1)], axis=1)])
        return np.concatenate(found)


def middle_of(track, time_s):
    """Place of an agent's footprint at a time, and its heading and pitch."""
    return SimpleNamespace(
        **dict(zip(("x", "y", "z", "yaw", "pitch"), track.at(np.array([time_s]))[0].tolist(), strict=True))
    )
