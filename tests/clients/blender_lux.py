"""Measure the light on the floor of a stage by path tracing: run with Blender's Python, write values as JSON.

Usage: python blender_lux.py STAGE OUTPUT WIDTH_M DEPTH_M SIDE
"""

import json
import sys

import bpy

SAMPLES = 64
LIFT_M = 0.06


def main():
    stage, output, width, depth, side = sys.argv[1], sys.argv[2], *map(float, sys.argv[3:5]), int(sys.argv[5])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=stage)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = SAMPLES
    # a white sheet over the floor; stage x, y, z are Blender's x, z, -y
    bpy.ops.mesh.primitive_plane_add(size=1, location=(width / 2, -depth / 2, LIFT_M))
    sheet = bpy.context.object
    sheet.scale = (width, depth, 1)
    material = bpy.data.materials.new("Sheet")
    material.use_nodes = True
    image = bpy.data.images.new("Light", side, side, float_buffer=True)
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    sheet.data.materials.append(material)
    bpy.ops.object.select_all(action="DESELECT")
    sheet.select_set(True)
    bpy.context.view_layer.objects.active = sheet
    measured = {}
    for name, passes in (("direct", {"DIRECT"}), ("total", {"DIRECT", "INDIRECT"})):
        bpy.ops.object.bake(type="DIFFUSE", pass_filter=passes, margin=0)
        pixels = list(image.pixels)[1::4]  # green: near the eye's weights, and 0.97 of the light's red
        measured[name] = [pixels[row * side : (row + 1) * side] for row in range(side)]
    with open(output, "w") as file:
        json.dump(measured, file)


main()
