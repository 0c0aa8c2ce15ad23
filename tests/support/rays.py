"""Rays through the meshes of a stage: read with pxr, cast with Embree, independent of Blender and garage2usd."""

import numpy as np
import trimesh
from pxr import Usd, UsdGeom


class Rays:
    """The meshes of some objects of a stage, by which rays are stopped.

    Parameters
    ----------
    stage
        With Y up, in metres.
    ids
        Number of each object by the path of its prim; what is below another such prim belongs to that one.
    """

    def __init__(self, stage, ids):
        places = UsdGeom.XformCache()
        triangles, owners = [], []
        for path, number in ids.items():
            below = iter(Usd.PrimRange(stage.GetPrimAtPath(path), Usd.TraverseInstanceProxies()))
            for prim in below:
                if str(prim.GetPath()) != path and str(prim.GetPath()) in ids:
                    below.PruneChildren()
                elif prim.IsA(UsdGeom.Mesh):
                    place = np.array(places.GetLocalToWorldTransform(prim))
                    mesh = UsdGeom.Mesh(prim)
                    points = np.array(mesh.GetPointsAttr().Get()) @ place[:3, :3] + place[3, :3]
                    found = fans(mesh)
                    triangles.append(points[found])
                    owners.append(np.full(len(found), number))
        corners = np.concatenate(triangles)
        self._owners = np.concatenate(owners)
        self._mesh = trimesh.Trimesh(
            corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), process=False, validate=False
        )

    def cast(self, origins, directions):
        """Owner (0 where nothing is met), place and normal of the first surface that each ray meets."""
        places, rays, faces = self._mesh.ray.intersects_location(origins, directions, multiple_hits=False)
        owner = np.zeros(len(origins), dtype=int)
        place, normal = np.full((len(origins), 3), np.inf), np.zeros((len(origins), 3))
        owner[rays], place[rays], normal[rays] = self._owners[faces], places, self._mesh.face_normals[faces]
        return owner, place, normal


def fans(mesh):
    """Triangles of convex faces as numbers of points; shape (n, 3)."""
    counts, indices = np.array(mesh.GetFaceVertexCountsAttr().Get()), np.array(mesh.GetFaceVertexIndicesAttr().Get())
    starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
    corners = [
        (indices[starts[large]], indices[starts[large] + step], indices[starts[large] + step + 1])
        for step in range(1, counts.max(initial=0) - 1)
        for large in [counts >= step + 2]
    ]
    return np.concatenate([np.stack(each, axis=1) for each in corners])
