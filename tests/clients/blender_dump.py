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
                light = instance.object.data
                entry["shape"], entry["sides_m"], entry["rgb"] = (
                    light.shape,
                    [light.size, light.size_y],
                    list(light.color),
                )
                entry["w_per_m2"] = light.energy
                assert not light.normalize  # else these were watts
                entry["down"] = list(instance.matrix_world.to_3x3() @ Vector((0, 0, -1)))
            drawn.append(entry)
    # an image is read when its pixels are asked for; before that it only has the size of its header
    images = [
        {"name": image.name, "size": list(image.size), "values": len(image.pixels), "read": image.has_data}
        for image in bpy.data.images
    ]
    materials = [{"name": item.name.split(".")[0], **_shown(item)} for item in bpy.data.materials if item.users]
    with open(output, "w") as file:
        json.dump({"objects": objects, "drawn": drawn, "images": images, "materials": materials}, file)


def _shown(material):
    """By input of its surface: name of the image, empty for none, and the value or the image's factor."""
    (surface,) = (node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    names = ("Base Color", "Roughness", "Metallic", "Normal", "Emission Color")
    shown = {name: _given(surface.inputs[name]) for name in names}
    image, colour = shown["Emission Color"]
    strength = surface.inputs["Emission Strength"].default_value
    shown["Emission Color"] = image, [strength * part for part in colour[:3]]
    return shown


def _given(socket):
    """Name of the image that a socket gets, and what it is multiplied with; or no name, and the socket's own value."""
    value = socket.default_value
    if not socket.is_linked:
        return "", list(value) if hasattr(value, "__len__") else value
    node, factor = socket.links[0].from_node, [1.0, 1.0, 1.0]
    while node.type != "TEX_IMAGE":
        if node.type == "VECT_MATH" and node.operation == "MULTIPLY_ADD":
            factor = list(node.inputs[1].default_value)
        node = next(given.links[0].from_node for given in node.inputs if given.is_linked)
    return node.image.name, factor


def _usd_place(matrix):
    """Blender's Z-up world position as (x, y, z) of the Y-up stage."""
    x, y, z = matrix.to_translation()
    return [x, z, -y]


main(sys.argv[-2], sys.argv[-1])
