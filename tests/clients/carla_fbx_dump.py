"""Run by a test in a process of its own: import an FBX by Blender's importer in C++, and write down its meshes."""

import json
import sys

import bpy
import numpy as np


def main(file, output):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.fbx_import(filepath=file, ignore_leaf_bones=False)
    bpy.context.view_layer.update()
    arrays, meshes = {}, []
    for number, item in enumerate(each for each in bpy.data.objects if each.type == "MESH"):
        mesh, matrix = item.data, np.array(item.matrix_world)
        points = np.empty(3 * len(mesh.vertices))
        mesh.vertices.foreach_get("co", points)
        corners = np.empty(len(mesh.loops), dtype=np.int32)
        mesh.loops.foreach_get("vertex_index", corners)
        surfaces = np.empty(len(mesh.polygons), dtype=np.int32)
        mesh.polygons.foreach_get("material_index", surfaces)
        normals = np.empty(3 * len(mesh.loops))
        mesh.corner_normals.foreach_get("vector", normals)
        assert {polygon.loop_total for polygon in mesh.polygons} == {3}
        arrays[f"triangles_{number}"] = (points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])[
            corners.reshape(-1, 3)
        ]
        arrays[f"materials_{number}"] = surfaces
        arrays[f"normals_{number}"] = normals.reshape(-1, 3, 3)
        meshes.append({"name": item.name, "materials": [own.name for own in mesh.materials]})
    images = {image.name: list(image.size) for image in bpy.data.images}
    np.savez(output, said=json.dumps({"meshes": meshes, "images": images}), **arrays)


main(*sys.argv[1:])
