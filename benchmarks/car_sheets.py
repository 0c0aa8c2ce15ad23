"""Contact sheets of car bodies from the front quarter, the rear quarter and the side, drawn by Blender's Cycles.

``python benchmarks/car_sheets.py FOLDER [NAME ...]`` draws the bodies named, or all, ten a sheet; with ``--view front``
all on one sheet, as the documentation shows them.
"""

import argparse
import math
import tempfile
from collections.abc import Sequence
from pathlib import Path

import bpy
from PIL import Image, ImageDraw

from garage2usd.assets.cars import car
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, CarBody, body_named
from garage2usd.objects.car import KIND, PAINT_SET
from garage2usd.stage.prototype_layer import write_prototype

_A_SHEET, _A_ROW = 10, 6
_VIEWS_DEG = {"front": (215.0, 16.0), "rear": (35.0, 16.0), "side": (90.0, 3.0)}
"""Where the camera stands: the angle around the car from its tail, and over the floor."""
_FOCAL_MM, _DISTANCE_LENGTHS = 60.0, 2.1


def main() -> None:
    """Draw the sheets."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--width", type=int, default=400)
    parser.add_argument("--view", choices=_VIEWS_DEG)
    arguments = parser.parse_args()
    bodies = [body_named(name) for name in arguments.names] or list(CAR_BODIES)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    size = arguments.width, arguments.width * 9 // 16
    if arguments.view:
        grid = draw_grid(bodies, size, arguments.samples, arguments.view)
        grid.save(arguments.folder / f"cars_{arguments.view}.jpg", quality=88)
        return
    for number, first in enumerate(range(0, len(bodies), _A_SHEET)):
        sheet = draw_sheet(bodies[first : first + _A_SHEET], size, arguments.samples, first)
        sheet.save(arguments.folder / f"cars_{number:02d}.png")


def draw_grid(bodies: Sequence[CarBody], size_px: tuple[int, int], samples: int, view: str) -> Image.Image:
    """One view of each body, in rows."""
    width, height = size_px
    grid = Image.new("RGB", (width * _A_ROW, height * -(-len(bodies) // _A_ROW)), "white")
    draw = ImageDraw.Draw(grid)
    with tempfile.TemporaryDirectory() as folder:
        for place, body in enumerate(bodies):
            x, y = place % _A_ROW * width, place // _A_ROW * height
            paint = PAINTS[(place + place // _A_ROW) % len(PAINTS)]
            grid.paste(_draw_views(body, Path(folder), size_px, samples, paint, [view])[0], (x, y))
            draw.text((x + 6, y + 4), f"{body.name}  {body.length_m:g} m", fill=(240, 240, 240))
    return grid


def draw_sheet(bodies: Sequence[CarBody], size_px: tuple[int, int], samples: int, first: int = 0) -> Image.Image:
    """A row of views for each body, in paints one after the other from number `first`."""
    width, height = size_px
    sheet = Image.new("RGB", (width * len(_VIEWS_DEG), height * len(bodies)))
    draw = ImageDraw.Draw(sheet)
    with tempfile.TemporaryDirectory() as folder:
        for row, body in enumerate(bodies):
            paint = PAINTS[(first + row) % len(PAINTS)]
            drawn = _draw_views(body, Path(folder), size_px, samples, paint, list(_VIEWS_DEG))
            for column, view in enumerate(drawn):
                sheet.paste(view, (column * width, row * height))
            said = f"{body.name}  {body.length_m} x {body.width_m} x {body.height_m} m"
            draw.text((6, row * height + 4), said, fill=(20, 20, 20))
    return sheet


def _draw_views(
    body: CarBody, folder: Path, size_px: tuple[int, int], samples: int, paint: str, views: Sequence[str]
) -> list[Image.Image]:
    asset = folder / f"{body.name}.usdc"
    write_prototype(car(body), asset, kind=KIND, quality=TextureQuality.LOW)
    shown = folder / f"{body.name}_shown.usda"
    shown.write_text(
        f'#usda 1.0\n(\n upAxis = "Y"\n metersPerUnit = 1\n defaultPrim = "Car"\n)\ndef Xform "Car" (\n'
        f' prepend references = @./{asset.name}@\n variants = {{ string {PAINT_SET} = "{paint}" }}\n) {{}}\n'
    )
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.wm.usd_import(filepath=str(shown))
    _light(scene)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = True
    scene.render.resolution_x, scene.render.resolution_y = size_px
    scene.view_settings.view_transform = "AgX"
    pictures = []
    for name in views:
        around_deg, over_deg = _VIEWS_DEG[name]
        camera = bpy.data.objects.new(name, bpy.data.cameras.new(name))
        camera.data.lens = _FOCAL_MM
        away, around, over = _DISTANCE_LENGTHS * body.length_m, math.radians(around_deg), math.radians(over_deg)
        # Blender's Z is up, and the nose looks to its +Y
        camera.location = (
            away * math.sin(around) * math.cos(over),
            -away * math.cos(around) * math.cos(over),
            away * math.sin(over) + body.height_m * 0.45,
        )
        camera.rotation_euler = (math.pi / 2 - over, 0.0, around)
        scene.collection.objects.link(camera)
        scene.camera = camera
        scene.render.filepath = str(folder / f"{body.name}_{name}.png")
        bpy.ops.render.render(write_still=True)
        pictures.append(Image.open(scene.render.filepath).convert("RGB"))
    return pictures


def _light(scene: bpy.types.Scene) -> None:
    """A grey floor below four long lamps, as a garage has them, in a dim room."""
    bpy.ops.mesh.primitive_plane_add(size=60)
    floor = bpy.data.materials.new("Floor")
    floor.use_nodes = True
    floor.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.3, 0.3, 0.3, 1)
    bpy.context.object.data.materials.append(floor)
    for x in (-4.5, -1.5, 1.5, 4.5):
        lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "AREA"))
        lamp.data.shape, lamp.data.size, lamp.data.size_y, lamp.data.energy = "RECTANGLE", 0.3, 9.0, 260
        lamp.location = (x, 0, 4.2)
        scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("Room")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.5, 0.52, 0.55, 1)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5


if __name__ == "__main__":
    main()
