"""Run with Open3D and pypcd4: read a PCD file with both; usage: pcd_dump.py IN.pcd OUT.npz."""

import sys

import numpy as np
import open3d
from pypcd4 import PointCloud

cloud = open3d.t.io.read_point_cloud(sys.argv[1])
found = {f"open3d_{name}": cloud.point[name].numpy() for name in cloud.point}
own = PointCloud.from_path(sys.argv[1])
found |= {f"pypcd4_{name}": own.pc_data[name] for name in own.fields}
np.savez(sys.argv[2], **found)
