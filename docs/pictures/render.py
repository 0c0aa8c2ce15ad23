"""Render a stage with Blender's Cycles: the pictures of the README.

Usage: python docs/pictures/render.py STAGE inside|above PICTURE [--width 1280] [--samples 64]
       [--at X Y Z YAW_DEG PITCH_DEG] [--focal-mm 20]

Needs Blender's Python module (``pip install bpy==5.0.1``, Python 3.11).
"""

import argparse
import math
from pathlib import Path

import bpy
from mathutils import Euler, Matrix

_OVERHEAD = (
    *("Ceiling", "Beam", "Tube", "Duct", "CableTray", "Sky", "Sprinkler"),
    *("ExitSign", "NoEntrySign", "OneWaySign"),
)
_UP_AXIS_Y_TO_Z = Matrix.Rotation(math.pi / 2, 4, "X")


def main() -> None:
    """Import the stage, choose a camera, render."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stage", type=Path)
    parser.add_argument("view", choices=["inside", "above"])
    parser.add_argument("picture", type=Path)
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--at", type=float, nargs=5, metavar=("X", "Y", "Z", "YAW_DEG", "PITCH_DEG"))
    parser.add_argument("--focal-mm", type=float)
    options = parser.parse_args()

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=str(options.stage.absolute()))
    scene = bpy.context.scene
    scene.camera = bpy.data.objects["Above" if options.view == "above" else "Inside"]
    if options.at is not None:
        _move_camera(scene.camera, options.at)
    if options.focal_mm is not None:
        scene.camera.data.lens = options.focal_mm
    if options.view == "above":
        _open_the_roof(scene)
    _set_up_cycles(scene, options)
    bpy.ops.render.render(write_still=True)


def _move_camera(camera: bpy.types.Object, at: list[float]) -> None:
    """Place a camera by stage coordinates: Y up, metres, looking along -Z at yaw 0."""
    x, y, z, yaw_deg, pitch_deg = at
    turn = Euler((math.radians(pitch_deg), math.radians(yaw_deg), 0.0), "XYZ").to_matrix().to_4x4()
    camera.parent = None
    camera.matrix_world = _UP_AXIS_Y_TO_Z @ Matrix.Translation((x, y, z)) @ turn


def _open_the_roof(scene: bpy.types.Scene) -> None:
    """Hide what hangs overhead and light the garage with a soft sky."""
    for item in scene.objects:
        if item.name.startswith(_OVERHEAD):
            item.hide_render = True
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 1.0
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    scene.world = world


def _set_up_cycles(scene: bpy.types.Scene, options: argparse.Namespace) -> None:
    scene.render.engine = "CYCLES"
    scene.cycles.samples = options.samples
    scene.cycles.use_denoising = True
    scene.cycles.use_light_tree = True
    scene.cycles.max_bounces = 6
    scene.view_settings.view_transform = "AgX"
    scene.render.resolution_x = options.width
    scene.render.resolution_y = options.width * 9 // 16
    scene.render.filepath = str(options.picture.absolute())
    scene.render.image_settings.file_format = "PNG"


if __name__ == "__main__":
    main()
