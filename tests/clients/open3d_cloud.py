"""Run with Open3D: distances of points of PCD files from triangles; usage: open3d_cloud.py MESH.npz OUT.npz PCD..."""

import sys

import numpy as np
import open3d

mesh, output, *clouds = sys.argv[1:]
given = np.load(mesh)
scene = open3d.t.geometry.RaycastingScene(nthreads=1)
scene.add_triangles(
    open3d.core.Tensor(given["vertices"].astype(np.float32)), open3d.core.Tensor(given["triangles"].astype(np.uint32))
)
read = [np.asarray(open3d.io.read_point_cloud(path).points) for path in clouds]
points = np.concatenate(read)
far = scene.compute_distance(open3d.core.Tensor(points.astype(np.float32))).numpy()
np.savez(output, points=points, far=far, counts=[len(each) for each in read])
