"""Run as a program: the place that Blender's position pass gives each pixel of a camera, on a sphere around the world.

Usage: python blender_positions.py JOBS.json

Each job has a frame as the renderer's own job has it, a `.npy` file to write, and maybe poles that stand at z = 0: x,
y, radius and height of each. The camera is the one of `garage2usd/render/blender.py`, the passes are set up as there,
and the world's axes are Blender's.
"""

import importlib.util
import json
import sys
from pathlib import Path

import bpy
import numpy as np
import OpenEXR
from mathutils import Matrix

REPOSITORY = Path(__file__).parents[2]

spec = importlib.util.spec_from_file_location("drawer", REPOSITORY / "garage2usd" / "render" / "blender.py")
drawer = importlib.util.module_from_spec(spec)
spec.loader.exec_module(drawer)

jobs = json.loads(Path(sys.argv[1]).read_text())
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6, radius=10)
scene = bpy.context.scene
drawer._set_up_data(scene, list(scene.objects))
scene.view_layers[0].use_pass_position = True
for job in jobs:
    path = Path(job["path"])
    for x, y, radius, height in job.get("poles", ()):
        bpy.ops.mesh.primitive_cylinder_add(vertices=64, radius=radius, depth=height, location=(x, y, height / 2))
    drawer.aim(scene, job["frame"], Matrix(np.eye(4).tolist()))
    scene.render.filepath = str(path.with_suffix(".exr"))
    bpy.ops.render.render(write_still=True)
    with OpenEXR.File(str(path.with_suffix(".exr")), separate_channels=True) as file:
        channels = {name: channel for part in file.parts for name, channel in part.channels.items()}
        names = [next(name for name in channels if name.endswith(f"Position.{axis}")) for axis in "XYZ"]
        depth = next(name for name in channels if "Depth" in name)
        np.save(path, np.stack([np.array(channels[name].pixels) for name in (*names, depth)], axis=-1))
