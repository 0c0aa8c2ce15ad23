"""Run by a test in a process of its own: import a stage into Blender and write down what stands where.

Blender's Python module brings its own USD library, which must not meet usd-core in one process.
"""

import json
import sys

import bpy
from mathutils import Vector


def main(stage, output):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=stage)
    bpy.context.view_layer.update()
    objects = [
        {"name": item.name.split(".")[0], "type": item.type, "place": _usd_place(item.matrix_world)}
        for item in bpy.data.objects
        if item.name in bpy.context.scene.objects
    ]
    drawn = []
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        if instance.object.type in {"LIGHT", "MESH"}:
            entry = {"type": instance.object.type, "name": instance.object.name.split(".")[0]}
            entry["place"] = _usd_place(instance.matrix_world)
            if instance.object.type == "LIGHT":
                entry["energy_w"] = instance.object.data.energy
                entry["down"] = list(instance.matrix_world.to_3x3() @ Vector((0, 0, -1)))
            drawn.append(entry)
    # an image is read when its pixels are asked for; before that it only has the size of its header
    images = [
        {"name": image.name, "size": list(image.size), "values": len(image.pixels), "read": image.has_data}
        for image in bpy.data.images
    ]
    with open(output, "w") as file:
        json.dump({"objects": objects, "drawn": drawn, "images": images}, file)


def _usd_place(matrix):
    """Blender's Z-up world position as (x, y, z) of the Y-up stage."""
    x, y, z = matrix.to_translation()
    return [x, z, -y]


main(sys.argv[-2], sys.argv[-1])
