"""Run by a test in a process of its own: import a stage into Blender and write down where objects are in frames."""

import json
import sys

import bpy


def main(stage, output, frames, names):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=stage)
    scene = bpy.context.scene
    found = {name: [] for name in names}
    for frame in frames:
        scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        for name in names:
            matrix = bpy.data.objects[name].evaluated_get(graph).matrix_world
            # Blender's Z-up world as the Y-up stage
            turned = [[row[column] for column in range(4)] for row in (matrix[0], matrix[2], -matrix[1])]
            found[name].append(turned)
    with open(output, "w") as file:
        json.dump({"fps": scene.render.fps, "frames": [scene.frame_start, scene.frame_end], "places": found}, file)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], json.loads(sys.argv[3]), json.loads(sys.argv[4]))
