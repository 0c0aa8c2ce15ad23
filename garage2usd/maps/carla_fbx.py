"""Write meshes as FBX with Blender, as a separate program.

Usage: python -P carla_fbx.py JOB.json
       blender --background --factory-startup --python carla_fbx.py -- JOB.json

As with `garage2usd.render.blender`, nothing of garage2usd is imported. The same job gives the same bytes: ids are
numbers in order of their first use, and the time of creation is that of FBX's other constants.
"""

import ctypes
import importlib
import itertools
import json
import signal
import sys
from datetime import datetime
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy_extras.node_shader_utils import PrincipledBSDFWrapper

_PR_SET_PDEATHSIG = 1
_CM = 0.01
_WRITTEN = datetime(1970, 1, 1)  # noqa: DTZ001 - FBX has the time without its zone
_FIRST_ID = 1000
_Array = np.ndarray[Any, Any]


def main() -> None:
    """Write the meshes of the job named on the command line."""
    if sys.platform == "linux":  # end with the parent process, even if that is killed
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    job = json.loads(Path(sys.argv[-1]).read_text(encoding="utf-8"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", _CM
    folder = Path(job["fbx"]).parent
    materials = [_material(each, folder) for each in job["materials"]]
    with np.load(job["arrays"]) as arrays:
        columns = [arrays[name] for name in ("positions", "normals", "coordinates", "triangles", "materials")]
        counts = arrays["counts"]
    vertex = triangle = 0
    for name, (vertices, triangles) in zip(job["names"], counts.tolist(), strict=True):
        of_vertices, of_triangles = slice(vertex, vertex + vertices), slice(triangle, triangle + triangles)
        own = [*(column[of_vertices] for column in columns[:3]), *(column[of_triangles] for column in columns[3:])]
        scene.collection.objects.link(bpy.data.objects.new(name, _mesh(name, own, materials)))
        vertex, triangle = vertex + vertices, triangle + triangles
    _fix_what_differs()
    bpy.ops.export_scene.fbx(
        filepath=job["fbx"],
        object_types={"MESH"},
        apply_unit_scale=True,
        apply_scale_options="FBX_SCALE_NONE",
        axis_forward="Y",  # Blender's own axes, which are those of the map and of Unreal's importer
        axis_up="Z",
        use_mesh_modifiers=False,
        mesh_smooth_type="FACE",
        bake_anim=False,
        path_mode="STRIP",
    )


def _mesh(name: str, columns: list[_Array], materials: list[bpy.types.Material]) -> bpy.types.Mesh:
    """Make a mesh of positions, normals, coordinates, triangles, and the numbers of the triangles' materials."""
    positions, normals, coordinates, triangles, surfaces = columns
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.astype(np.float32).ravel())
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.ravel())
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    used = np.unique(surfaces[surfaces >= 0])
    for number in used.tolist():
        mesh.materials.append(materials[number])
    if len(used):
        mesh.polygons.foreach_set("material_index", np.searchsorted(used, surfaces).astype(np.int32))
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", coordinates[triangles.ravel()].astype(np.float32).ravel())
    mesh.update(calc_edges=True)
    if len(used):
        mesh.normals_split_custom_set_from_vertices(normals.tolist())
    else:
        mesh.shade_flat()
    return mesh


def _material(values: dict[str, Any], folder: Path) -> bpy.types.Material:
    """Make a material by Blender's wrapper, which the export reads."""
    material = bpy.data.materials.new(values["name"])
    material.use_nodes = True
    surface = PrincipledBSDFWrapper(material, is_readonly=False)
    surface.base_color = values["colour_rgb"]
    surface.roughness, surface.metallic, surface.alpha = values["roughness"], values["metallic"], values["opacity"]
    strength = max(values["emissive_rgb"])
    surface.emission_color = [part / strength if strength else 0.0 for part in values["emissive_rgb"]]
    surface.emission_strength = strength
    if values["picture"]:
        image = bpy.data.images.load(str(folder / values["picture"]), check_existing=True)
        surface.base_color_texture.image = image
        if values["has_alpha"]:
            surface.alpha_texture.image = image
    if values["normals"]:
        surface.normalmap_texture.image = bpy.data.images.load(str(folder / values["normals"]), check_existing=True)
    return material


def _fix_what_differs() -> None:
    """Number the ids of FBX, which are else hashes that differ by run, and fix the time and the folder of pictures."""
    export: Any = importlib.import_module("io_scene_fbx.export_fbx_bin")
    tools: Any = importlib.import_module("io_scene_fbx.fbx_utils")
    numbers = itertools.count(_FIRST_ID)
    tools._key_to_uuid = lambda _taken, _key: tools.UUID(next(numbers))  # noqa: SLF001 - has no setting
    names = export._gen_vid_path  # noqa: SLF001
    export._gen_vid_path = lambda image, scene: (names(image, scene)[1],) * 2  # noqa: SLF001
    header = export.fbx_header_elements
    export.fbx_header_elements = lambda root, data, time=None: header(root, data, time or _WRITTEN)


if __name__ == "__main__":
    main()
