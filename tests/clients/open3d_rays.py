"""Run with Open3D: cast rays at triangles; usage: open3d_rays.py IN.npz OUT.npz."""

import sys

import numpy as np
import open3d

given = np.load(sys.argv[1])
scene = open3d.t.geometry.RaycastingScene(nthreads=1)
scene.add_triangles(
    open3d.core.Tensor(given["vertices"].astype(np.float32)), open3d.core.Tensor(given["triangles"].astype(np.uint32))
)
rays = np.hstack([given["origins"], given["directions"]]).astype(np.float32)
found = scene.cast_rays(open3d.core.Tensor(rays))
np.savez(sys.argv[2], range=found["t_hit"].numpy(), triangle=found["primitive_ids"].numpy().astype(np.int64))
