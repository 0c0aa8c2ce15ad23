"""Run as a program of its own: draw the frames of a job with Blender's Cycles.

Usage: python -P blender.py JOB.json

Blender's Python module brings a USD library of its own, which must not meet usd-core in one process, so nothing of
garage2usd is imported. Each line on the file descriptor that the job names is a number of samples done.
"""

import ctypes
import json
import os
import re
import signal
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

_PR_SET_PDEATHSIG = 1
_INDEX_LIMIT = 32768
"""Blender's object indices are below this; the ids of larger scenes are drawn digit by digit."""
_POINT_FILTER_PX = 0.01
_BOUNCES = 6
_TRANSPARENT_BOUNCES = 64
_OPAQUE = 0.5
_SAMPLE = re.compile(r"Sample (\d+)/\d+")


def main() -> None:
    """Draw the job that the command line names."""
    if sys.platform == "linux":  # whoever waits for the pictures may be killed
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    job = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    report = _Reporter(job["report_fd"])
    to_blender = Matrix(job["to_blender"])
    scene, objects, ids = _build(job, to_blender)
    colour = [frame for frame in job["frames"] if frame["colour"]]
    data = [frame for frame in job["frames"] if frame["data"]]
    if colour:
        _set_up_colour(scene, job)
        for frame in colour:
            _aim(scene, frame, job["size_px"], to_blender)
            _hide(objects, ids, frame["hidden"], is_dark=False)
            report.watch(job["samples"])
            scene.render.filepath = frame["colour"]
            bpy.ops.render.render(write_still=True)
            report.finish(job["samples"])
    if data:
        _set_up_data(scene, objects)
        for frame in data:
            _aim(scene, frame, job["size_px"], to_blender)
            _hide(objects, ids, frame["hidden"], is_dark=True)
            for digit, path in enumerate(frame["data"]):
                for item, number in zip(objects, ids, strict=True):
                    item.pass_index = number // _INDEX_LIMIT**digit % _INDEX_LIMIT
                scene.render.filepath = path
                bpy.ops.render.render(write_still=True)
            report.finish(1)


class _Reporter:
    """Tells how many samples are done."""

    def __init__(self, descriptor: int) -> None:
        self._file = os.fdopen(descriptor, "w", buffering=1)
        self._done = 0
        self._most = 0
        bpy.app.handlers.render_stats.append(self._on_statistics)

    def watch(self, samples: int) -> None:
        """From now on samples of a picture are drawn."""
        self._most = samples

    def finish(self, samples: int) -> None:
        """A picture is drawn."""
        self._done += samples
        self._most = 0
        print(self._done, file=self._file)

    def _on_statistics(self, text: str, *_: object) -> None:
        found = _SAMPLE.search(str(text))
        if found:
            print(self._done + min(int(found[1]), self._most), file=self._file)


def _build(job: dict[str, Any], to_blender: Matrix) -> tuple[bpy.types.Scene, list[bpy.types.Object], list[int]]:
    """Import each shape once and put copies of it, which share its mesh, at all of its places."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(
        filepath=job["shapes"],
        prim_path_mask=",".join(job["mask"]),
        property_import_mode="USER",
        merge_parent_xform=False,
        set_frame_range=False,
        import_cameras=False,
        import_visible_only=False,
        import_guide=False,
        import_render=True,
    )
    scene = bpy.context.scene
    name = job["property"]
    # Blender keeps the properties of a prim that is drawn with its data
    shapes = {item.data[name]: item for item in bpy.data.objects if item.data and name in item.data}
    for item in list(scene.collection.all_objects):
        for collection in item.users_collection:
            collection.objects.unlink(item)
    places = np.load(job["places"])
    objects, ids = [], []
    for shape, instance, place in zip(
        places["shape"].tolist(), places["instance"].tolist(), places["to_world"], strict=True
    ):
        if shape in shapes:  # not all that USD can say can Blender draw
            item = shapes[shape].copy()
            item.parent = None
            item.animation_data_clear()
            item.hide_render = False
            item.matrix_world = to_blender @ Matrix(place)
            scene.collection.objects.link(item)
            objects.append(item)
            ids.append(instance)
    return scene, objects, ids


def _aim(scene: bpy.types.Scene, frame: dict[str, Any], size_px: list[int], to_blender: Matrix) -> None:
    """Take the camera of a frame."""
    lens = frame["lens"]
    if scene.camera is None:
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(scene.camera)
    camera = scene.camera
    camera.matrix_world = to_blender @ Matrix(frame["camera_to_world"])
    camera.data.sensor_fit = "HORIZONTAL"
    camera.data.sensor_width = lens["aperture_mm"]
    camera.data.lens = lens["focal_mm"]
    camera.data.shift_x, camera.data.shift_y = lens["shift"]
    camera.data.clip_start, camera.data.clip_end = lens["clip_m"]
    scene.render.resolution_x, scene.render.resolution_y = size_px
    scene.render.resolution_percentage = 100


def _hide(objects: list[bpy.types.Object], ids: list[int], hidden: list[int], *, is_dark: bool) -> None:
    """Hide what a camera looks through, and in the dark the lights."""
    looked_through = set(hidden)
    for item, number in zip(objects, ids, strict=True):
        item.hide_render = number in looked_through or (is_dark and item.type == "LIGHT")


def _set_up(scene: bpy.types.Scene, *, samples: int, seed: int) -> None:
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.seed = seed
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.transparent_max_bounces = _TRANSPARENT_BOUNCES
    scene.render.use_persistent_data = True


def _set_up_colour(scene: bpy.types.Scene, job: dict[str, Any]) -> None:
    _set_up(scene, samples=job["samples"], seed=job["seed"])
    scene.cycles.use_denoising = True
    scene.cycles.use_light_tree = True
    scene.cycles.max_bounces = _BOUNCES
    scene.view_settings.view_transform = "AgX"
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "8"


def _set_up_data(scene: bpy.types.Scene, objects: list[bpy.types.Object]) -> None:
    """One ray through the middle of each pixel, without light, so that nothing is ever a mixture of two objects."""
    _set_up(scene, samples=1, seed=0)
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"  # the box has a width of its own
    scene.cycles.filter_width = _POINT_FILTER_PX
    layer = scene.view_layers[0]
    layer.use_pass_combined = True
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_object_index = True
    layer.pass_alpha_threshold = _OPAQUE
    settings = scene.render.image_settings
    settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "ZIP"
    for material in {slot.material for item in objects for slot in item.material_slots if slot.material}:
        if material.node_tree is not None:
            _simplify(material.node_tree)


def _simplify(tree: bpy.types.NodeTree) -> None:
    """Remove normal maps, and round opacity to 0 or 1, which Cycles would otherwise sample at random."""
    for node in [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]:
        for link in node.inputs["Normal"].links:
            tree.links.remove(link)
        alpha = node.inputs["Alpha"]
        if alpha.is_linked:
            step = tree.nodes.new("ShaderNodeMath")
            step.operation = "GREATER_THAN"
            step.inputs[1].default_value = _OPAQUE
            tree.links.new(alpha.links[0].from_socket, step.inputs[0])
            tree.links.new(step.outputs[0], alpha)
        else:
            alpha.default_value = float(alpha.default_value > _OPAQUE)


if __name__ == "__main__":
    main()
