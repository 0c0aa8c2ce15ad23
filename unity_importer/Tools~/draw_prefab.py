"""Draw a prefab as the fakes of Unity's classes hold it, with Blender's Cycles.

Usage: mono PrefabDump.exe prefab STAGE.usdz > PREFAB.json
       python draw_prefab.py PREFAB.json STAGE.usdz PICTURE [--camera Inside] [--width 960] [--samples 48]

Everything comes from the prefab: meshes with their normals and texture coordinates, world transforms, the camera,
lights with their angles, strengths and shadows, colors, smoothness and glow of the materials. Of the stage only
the pixels of JPEG files are taken. Normal maps and packed maps are left out. Needs Blender's Python module
(``pip install bpy==5.0.1``).
"""

import argparse
import base64
import json
import math
import zipfile
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

import bpy
import numpy as np
from mathutils import Matrix, Vector

SRGB_KNEE = 0.04045
OPAQUE_QUEUE = 2000
TO_BLENDER = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
"""Unity is left-handed with Y up, Blender right-handed with Z up; it is its own inverse."""


def main() -> None:
    """Build the scene and render it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prefab", type=Path)
    parser.add_argument("stage", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--camera", default="Inside")
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--samples", type=int, default=48)
    options = parser.parse_args()
    prefab = json.loads(options.prefab.read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with TemporaryDirectory() as folder:
        with zipfile.ZipFile(options.stage) as package:
            package.extractall(folder)
        files = {path.name: path for path in Path(folder).rglob("*.jpg")}
        assets = prefab["assets"]
        materials = {name: material(one, assets, files) for name, one in assets.items() if one["type"] == "Material"}
        add_objects(prefab["objects"], assets, materials, options.camera)
        render(options)


def add_objects(objects: list[dict], assets: dict, materials: dict, camera: str) -> None:
    """Whatever of the prefab is shown, and the camera of this name."""
    meshes: dict[tuple, bpy.types.Mesh] = {}
    for item in objects:
        place = Matrix([*(item["world"][row : row + 4] for row in (0, 4, 8)), (0, 0, 0, 1)])
        name = PurePosixPath(item["path"]).name
        if "camera" in item and name == camera:
            data = bpy.data.cameras.new(name)
            data.sensor_fit, data.angle = "VERTICAL", math.radians(item["camera"]["fieldOfView"])
            bpy.context.scene.camera = add(data, looking(place))
        if not item["shown"]:
            continue
        if "mesh" in item:
            key = item["mesh"], *item["materials"]
            if key not in meshes:
                meshes[key] = mesh(assets[item["mesh"]], [materials[one] for one in item["materials"]])
            add(meshes[key], TO_BLENDER @ place @ TO_BLENDER)
        if item.get("light", {}).get("enabled"):
            add(light(item["light"]), looking(place))


def add(data: bpy.types.ID, place: Matrix) -> bpy.types.Object:
    """An object of the scene at a place in Blender's axes."""
    made = bpy.data.objects.new(data.name, data)
    made.matrix_world = place
    bpy.context.scene.collection.objects.link(made)
    return made


def looking(place: Matrix) -> Matrix:
    """Where a camera or light of Unity's, which look along +Z, stands in Blender, where they look along -Z."""
    forward, up = ((TO_BLENDER @ place).to_3x3() @ Vector(axis) for axis in ((0, 0, 1), (0, 1, 0)))
    axes = Matrix((forward.cross(up), up, -forward)).transposed().to_4x4()
    return Matrix.Translation(TO_BLENDER @ place.translation) @ axes


def mesh(asset: dict, materials: list[bpy.types.Material]) -> bpy.types.Mesh:
    """A Mesh of Unity's in Blender's axes: as these mirror, its triangles turn the other way."""
    made = bpy.data.meshes.new(asset["name"])
    triangles = [part[at : at + 3][::-1] for part in asset["parts"] for at in range(0, len(part), 3)]
    made.from_pydata(swapped(asset["vertices"]), [], triangles)
    numbers = [number for number, part in enumerate(asset["parts"]) for _ in range(0, len(part), 3)]
    made.polygons.foreach_set("material_index", numbers)
    for one in materials:
        made.materials.append(one)
    if asset["uv"]:
        layer = made.uv_layers.new()
        for loop, vertex in enumerate(made.loops):
            layer.data[loop].uv = asset["uv"][2 * vertex.vertex_index : 2 * vertex.vertex_index + 2]
    made.normals_split_custom_set_from_vertices(swapped(asset["normals"]))
    return made


def swapped(numbers: list[float]) -> list[tuple[float, float, float]]:
    """Vectors of Unity's in Blender's axes."""
    return list(zip(numbers[0::3], numbers[2::3], numbers[1::3], strict=True))


def material(asset: dict, assets: dict, files: dict[str, Path]) -> bpy.types.Material:
    """The surface of a Standard material."""
    made = bpy.data.materials.new(asset["name"])
    made.use_nodes = True
    surface = made.node_tree.nodes["Principled BSDF"]
    red, green, blue, alpha = asset["colors"]["_Color"]
    surface.inputs["Base Color"].default_value = (linear(red), linear(green), linear(blue), 1)
    surface.inputs["Metallic"].default_value = asset["floats"]["_Metallic"]
    packed = "_MetallicGlossMap" in asset["textures"]
    surface.inputs["Roughness"].default_value = 0.8 if packed else 1 - asset["floats"]["_Glossiness"]
    surface.inputs["Alpha"].default_value = alpha
    if "_EMISSION" in asset["keywords"]:
        surface.inputs["Emission Color"].default_value = asset["colors"]["_EmissionColor"]
        surface.inputs["Emission Strength"].default_value = 1
    image = picture(asset["textures"].get("_MainTex"), assets, files)
    if image is not None:
        pixels = made.node_tree.nodes.new("ShaderNodeTexImage")
        pixels.image = image
        made.node_tree.links.new(pixels.outputs["Color"], surface.inputs["Base Color"])
        if float(asset["queue"]) > OPAQUE_QUEUE:
            made.node_tree.links.new(pixels.outputs["Alpha"], surface.inputs["Alpha"])
    return made


def picture(texture: str | None, assets: dict, files: dict[str, Path]) -> bpy.types.Image | None:
    """Pixels that the prefab holds, or those of the JPEG file that it holds unread."""
    if texture is None:
        return None
    if texture in bpy.data.images:
        return bpy.data.images[texture]
    asset = assets[texture]
    if "pixels" not in asset:
        made = bpy.data.images.load(str(files[asset["name"]]))
        made.pack()
    else:
        made = bpy.data.images.new(texture, int(asset["width"]), int(asset["height"]), alpha=True)
        made.pixels.foreach_set(np.frombuffer(base64.b64decode(asset["pixels"]), np.uint8) / np.float32(255))
    made.name = texture
    return made


def linear(value: float) -> float:
    """Of a channel in sRGB."""
    return value / 12.92 if value <= SRGB_KNEE else ((value + 0.055) / 1.055) ** 2.4


def light(found: dict) -> bpy.types.Light:
    """A spot or point light; one of strength 1 makes white of a white surface 1 m away."""
    made = bpy.data.lights.new("Light", found["type"].upper())
    made.color = [linear(value) for value in found["color"]]
    # radiance of a white surface: I / pi in Blender, where I is power / (4 pi)
    made.energy = 4 * math.pi**2 * found["intensity"]
    made.use_shadow = found["shadows"] != "None"
    made.shadow_soft_size = 0
    if found["type"] == "Spot":
        made.spot_size = math.radians(found["spotAngle"])
        made.spot_blend = 1 - found["innerSpotAngle"] / found["spotAngle"]
    return made


def render(options: argparse.Namespace) -> None:
    """Write the picture."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = options.samples
    scene.cycles.use_denoising = True
    scene.cycles.max_bounces = 4
    scene.view_settings.view_transform = "AgX"
    scene.render.resolution_x, scene.render.resolution_y = options.width, options.width * 9 // 16
    scene.render.filepath = str(options.picture.absolute())
    scene.render.image_settings.file_format = "PNG"
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
