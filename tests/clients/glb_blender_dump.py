"""Run by a test in a process of its own: import a GLB into Blender, write down what stands where and take a picture."""

import json
import sys

import bpy
from mathutils import Vector


def main(file, output, picture, camera):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    bpy.context.view_layer.update()
    objects = []
    for item in bpy.data.objects:
        entry = {"name": item.name, "said": {key: _plain(item[key]) for key in item.keys()}}  # noqa: SIM118
        if item.type == "MESH":
            meshes = [
                other for other in (item, *item.children_recursive) if other.type == "MESH"
            ]  # what is painted is below
            points = [other.matrix_world @ vertex.co for other in meshes for vertex in other.data.vertices]
            x, y, z = zip(*points, strict=True)
            entry["low"] = [min(x), min(z), -max(y)]
            entry["high"] = [max(x), max(z), -min(y)]
            entry["mesh"] = item.data.name
            entry["smooth"] = sum(polygon.use_smooth for polygon in item.data.polygons) / len(item.data.polygons)
        objects.append(entry)
    images = [{"name": image.name, "size": list(image.size), "values": len(image.pixels)} for image in bpy.data.images]
    materials = [material.name for material in bpy.data.materials]
    with open(output, "w") as written:
        json.dump({"objects": objects, "images": images, "materials": materials}, written)
    if picture:
        _take(picture, *json.loads(camera))


def _plain(value):
    return value.to_dict() if hasattr(value, "to_dict") else value.to_list() if hasattr(value, "to_list") else value


def _take(picture, place, target, degrees):
    """What Cycles sees from a place of the Y-up stage, with light from everywhere."""
    place, target = (Vector((x, -z, y)) for x, y, z in (place, target))
    camera = bpy.data.objects.new("Eye", bpy.data.cameras.new("Eye"))
    camera.data.sensor_fit, camera.data.angle = "VERTICAL", degrees * 3.141592653589793 / 180
    camera.location, camera.rotation_mode = place, "QUATERNION"
    camera.rotation_quaternion = (target - place).to_track_quat("-Z", "Y")
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera, scene.world = camera, bpy.data.worlds.new("Even")
    scene.world.use_nodes = True
    scene.render.engine, scene.cycles.samples, scene.cycles.seed = "CYCLES", 16, 0
    scene.render.resolution_x, scene.render.resolution_y = 640, 360
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


main(*sys.argv[-4:])
