"""Draw the camera ``Inside`` of a stage by Blender's own import and Cycles.

Usage: python blender_render.py STAGE PICTURE [--width 1280] [--samples 64]
"""

import argparse
from pathlib import Path

import bpy


def main():
    """Import the stage, choose the camera, render."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stage", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--samples", type=int, default=64)
    options = parser.parse_args()

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=str(options.stage.absolute()))
    scene = bpy.context.scene
    scene.camera = bpy.data.objects["Inside"]
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
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
