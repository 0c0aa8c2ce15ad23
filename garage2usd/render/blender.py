"""Render the frames of a job with Blender's Cycles, as a separate program.

Usage: python -P blender.py JOB.json
       blender --background --factory-startup --python blender.py -- JOB.json

Blender's Python module brings a USD library of its own, which must not be loaded in one process with usd-core, so
nothing of garage2usd is imported. An installed Blender runs this file too. The report file of the job receives the
number of finished samples, line by line.
"""
# Over 300 lines: a program of its own, which finds no module beside it.

import ctypes
import importlib
import json
import math
import re
import signal
import sys
from pathlib import Path
from typing import Any, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix, Vector

_PR_SET_PDEATHSIG = 1
_INDEX_LIMIT = 32768
"""Limit of Blender's object indices; larger ids are rendered digit by digit."""
_POINT_FILTER_PX = 0.01
_BOUNCES, _DRAFT_BOUNCES = 6, 3
_TRANSPARENT_BOUNCES = 64
_OPAQUE = 0.5
_LENS = "lens"
"""Custom property of a Blender camera that holds its lens."""
_RAYS = Path(__file__).with_name("rays.osl")
_PARTS = "parts"
"""Folder of unfinished pictures."""
_SAMPLE = re.compile(r"(?:Rendered (\d+)/(\d+) Tiles, )?Sample (\d+)/\d+")
_WHOLE_PX = 2048
"""Side of the tiles of pictures other than colour."""


def main() -> None:
    """Render the job named on the command line."""
    if sys.platform == "linux":  # end with the parent process, even if that is killed
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    job = json.loads(Path(sys.argv[-1]).read_text(encoding="utf-8"))
    report = _Reporter(Path(job["report"]))
    to_blender = Matrix(job["to_blender"])
    scene, drawn = _build(job, to_blender)
    moving = _resting(drawn, job["moving"])
    report.listen()
    report.finish(0)
    colour = [frame for frame in job["frames"] if frame["colour"]]
    data = [frame for frame in job["frames"] if frame["data"]]
    if colour:
        _set_up_colour(scene, job)
        for frame in colour:
            aim(scene, frame, to_blender)
            _move(moving, frame["moved"], to_blender)
            _hide(drawn, frame, is_dark=False)
            report.watch(job["samples"])
            _write_light(scene) if frame["is_light"] else _write_png(scene)
            _draw(scene, Path(frame["colour"]))
            report.finish(job["samples"])
    if data:
        _set_up_data(scene, [each.item for each in drawn])
        for frame in data:
            # with rays from several cameras depth is ambiguous, so positions are needed
            scene.view_layers[0].use_pass_position = "eyes" in frame["lens"]
            aim(scene, frame, to_blender)
            _move(moving, frame["moved"], to_blender)
            _hide(drawn, frame, is_dark=True)
            for digit, path in enumerate(frame["data"]):
                for each in drawn:
                    index = each.number // _INDEX_LIMIT**digit % _INDEX_LIMIT
                    if each.item.pass_index != index:
                        each.item.pass_index = index
                _draw(scene, Path(path))
            report.finish(1)


class _Drawn(NamedTuple):
    """A Blender object of the scene with its instance id.

    Attributes
    ----------
    item, number
        The Blender object, and the instance id of the object that it belongs to.
    hangs
        True if bird's-eye views hide the object.
    is_for_above
        True if only bird's-eye views draw the object, False if only other views do; None for both.
    """

    item: bpy.types.Object
    number: int
    hangs: bool = False
    is_for_above: bool | None = None


class _Reporter:
    """Reporter of finished samples to a file."""

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="ascii", newline="\n", buffering=1)
        self._done = 0
        self._most = 0
        self._told = 0

    def listen(self) -> None:
        """Listen to Blender, which forgets listeners whenever a scene is read."""
        bpy.app.handlers.render_stats.append(self._on_statistics)

    def watch(self, samples: int) -> None:
        """Start counting the samples of a picture."""
        self._most = samples

    def finish(self, samples: int) -> None:
        """Add the samples of a finished picture."""
        self._done += samples
        self._most = 0
        self._tell(self._done)

    def _on_statistics(self, text: str, *_: object) -> None:
        found = _SAMPLE.search(str(text))
        if found and found[1]:
            self._tell(self._done + self._most * int(found[1]) // int(found[2]))
        elif found:
            self._tell(self._done + min(int(found[3]), self._most))

    def _tell(self, done: int) -> None:
        if done >= self._told:
            self._told = done
            print(done, file=self._file)


def _build(job: dict[str, Any], to_blender: Matrix) -> tuple[bpy.types.Scene, list[_Drawn]]:
    """Import each shape once, and place copies that share its mesh."""
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
        mtl_purpose="MTL_PREVIEW",
    )
    scene = bpy.context.scene
    name = job["property"]
    # Blender stores a prim's properties with the data of its object
    shapes = {item.data[name]: item for item in bpy.data.objects if item.data and name in item.data}
    for item in list(scene.collection.all_objects):
        for collection in item.users_collection:
            collection.objects.unlink(item)
    places = np.load(job["places"])
    columns = (places[name].tolist() for name in ("shape", "instance", "to_world", "hangs", "cut_m"))
    drawn: list[_Drawn] = []
    for shape, instance, place, hangs, cut_m in zip(*columns, strict=True):
        if shape in shapes:  # Blender cannot draw everything that USD can express
            item = shapes[shape].copy()
            item.parent = None
            item.animation_data_clear()
            item.hide_render = False
            item.matrix_world = to_world = to_blender @ Matrix(place)
            scene.collection.objects.link(item)
            if math.isnan(cut_m):
                drawn.append(_Drawn(item, instance, hangs=hangs))
            else:
                below = _cut(item, to_world, cut_m)
                scene.collection.objects.link(below)
                drawn += [_Drawn(item, instance, is_for_above=False), _Drawn(below, instance, is_for_above=True)]
    return scene, drawn


def _cut(item: bpy.types.Object, to_world: Matrix, height_m: float) -> bpy.types.Object:
    """Cut an object at a height, keep the part below and close the cut."""
    import bmesh  # noqa: PLC0415 - available once bpy is imported

    below = item.copy()
    below.data = item.data.copy()
    shape = bmesh.new()
    shape.from_mesh(below.data)
    found = bmesh.ops.bisect_plane(
        shape,
        geom=[*shape.verts, *shape.edges, *shape.faces],
        plane_co=to_world.inverted() @ Vector((0.0, 0.0, height_m)),
        plane_no=to_world.to_3x3().transposed() @ Vector((0.0, 0.0, 1.0)),
        clear_outer=True,
    )
    rim = [part for part in found["geom_cut"] if isinstance(part, bmesh.types.BMEdge)]
    bmesh.ops.triangle_fill(shape, edges=rim, use_beauty=True)
    shape.to_mesh(below.data)
    shape.free()
    return below


def _draw(scene: bpy.types.Scene, path: Path) -> None:
    """Render a picture, whose file appears only when complete.

    Blender receives a path within the working directory, since it interprets `#` and braces, which the user's path may
    contain.
    """
    part = Path(_PARTS, path.name)
    part.parent.mkdir(exist_ok=True)
    scene.render.filepath = str(part)
    bpy.ops.render.render(write_still=True)
    part.replace(path)


def aim(scene: bpy.types.Scene, frame: dict[str, Any], to_blender: Matrix) -> None:
    """Set the Blender camera to the pose and lens of a frame."""
    if scene.camera is None:
        scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
        scene.collection.objects.link(scene.camera)
    scene.camera.matrix_world = to_blender @ Matrix(frame["camera_to_world"])
    _take_lens(scene.camera.data, frame["lens"], *frame["size_px"])
    scene.render.resolution_x, scene.render.resolution_y = frame["size_px"]
    scene.render.resolution_percentage = 100


def _take_lens(camera: bpy.types.Camera, lens: dict[str, Any], width: int, height: int) -> None:
    """Set the lens of the Blender camera; a second camera would reload the scene, which takes a second."""
    name = json.dumps([lens, width, height])
    if camera.get(_LENS) == name:
        return
    camera[_LENS] = name
    camera.sensor_fit = "HORIZONTAL"
    camera.clip_start, camera.clip_end = lens["clip_m"]
    camera.shift_x, camera.shift_y = lens.get("shift", (0.0, 0.0))
    if lens["kind"] == "perspective":
        camera.type = "PERSP"
        camera.sensor_width = lens["aperture_mm"]
        camera.lens = lens["focal_mm"]
    elif lens["kind"] == "orthographic":
        camera.type, camera.ortho_scale = "ORTHO", lens["width_m"]
    else:
        _look_along_rays(camera, lens, width, height)


def _look_along_rays(camera: bpy.types.Camera, lens: dict[str, Any], width: int, height: int) -> None:
    """Set a Blender camera's rays by an OSL shader.

    Blender's own compilation needs a module that its Python package lacks, so the shader is compiled here.
    """
    macros: dict[str, object] = {
        "WIDTH": float(width),
        "HEIGHT": float(height),
        "CENTRE_X": lens["centre_px"][0],
        "CENTRE_Y": lens["centre_px"][1],
        "STRETCH_X": lens["stretch"][0],
        "STRETCH_Y": lens["stretch"][1],
    }
    if "coefficients" in lens:
        macros["MAX_ANGLE"] = lens["max_angle_rad"]
        macros["COUNT"] = len(lens["coefficients"])
        macros["COEFFICIENTS"] = "{" + ", ".join(f"{value:.9e}" for value in lens["coefficients"]) + "}"
    if "eyes" in lens:
        macros.update(zip(("LEFT", "FRONT", "RIGHT", "REAR"), lens["car_m"], strict=True))
        macros["SEAM"] = lens["seam_m"]
        places = (", ".join(f"{value:.9e}" for value in place) for place in lens["eyes"])
        macros["EYES"] = "{" + ", ".join(f"vector({place})" for place in places) + "}"
    head = "".join(
        f"#define {name} {value:.9e}\n" if isinstance(value, float) else f"#define {name} {value}\n"
        for name, value in macros.items()
    )
    text = bpy.data.texts.new("rays.osl")
    text.write(head + _RAYS.read_text(encoding="utf-8"))
    osl = importlib.import_module("cycles.osl")  # available once bpy is imported
    said: list[str] = []
    is_compiled, _, bytecode, digest = osl.update_internal_script(lambda _kind, message: said.append(message), text)
    if not is_compiled:
        raise RuntimeError(" ".join(said))
    camera.type, camera.custom_mode = "CUSTOM", "INTERNAL"
    camera.custom_bytecode, camera.custom_bytecode_hash = bytecode, digest
    camera.update_tag()


def _resting(drawn: list[_Drawn], numbers: list[int]) -> dict[int, list[tuple[bpy.types.Object, Matrix]]]:
    """Return the Blender objects of the ids that move, with their poses in the stage."""
    found: dict[int, list[tuple[bpy.types.Object, Matrix]]] = {number: [] for number in numbers}
    for each in drawn:
        if each.number in found:
            found[each.number].append((each.item, each.item.matrix_world.copy()))
    return found


def _move(
    moving: dict[int, list[tuple[bpy.types.Object, Matrix]]],
    moved: list[tuple[int, list[list[float]]]],
    to_blender: Matrix,
) -> None:
    """Move the moving objects to their poses in a frame, given by matrices in the stage's axes."""
    for number, place in moved:
        matrix = to_blender @ Matrix(place) @ to_blender.inverted()
        for item, rest in moving[number]:
            there = matrix @ rest
            if item.matrix_world != there:
                item.matrix_world = there


def _hide(drawn: list[_Drawn], frame: dict[str, Any], *, is_dark: bool) -> None:
    """Hide objects from a frame's camera, though hidden lamps still shine; in the dark hide the lights."""
    looked_through, unseen, from_above = set(frame["hidden"]), set(frame["unseen"]), frame["from_above"]
    for item, number, hangs, is_for_above in drawn:
        is_hidden = is_dark if item.type == "LIGHT" else number in looked_through
        is_hidden |= is_for_above not in {None, from_above}
        if item.hide_render != is_hidden:  # an assignment makes Blender read the scene again, even without a change
            item.hide_render = is_hidden
        is_seen = not (hangs and from_above) and number not in unseen
        if item.visible_camera != is_seen:
            item.visible_camera = is_seen


def _set_up(scene: bpy.types.Scene, *, samples: int, seed: int) -> None:
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.seed = seed
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.tile_size = _WHOLE_PX
    scene.cycles.transparent_max_bounces = _TRANSPARENT_BOUNCES
    scene.render.use_persistent_data = True


def _set_up_colour(scene: bpy.types.Scene, job: dict[str, Any]) -> None:
    _set_up(scene, samples=job["samples"], seed=job["seed"])
    if job["device"] != "CPU":
        preferences = bpy.context.preferences.addons["cycles"].preferences
        preferences.compute_device_type = job["device"]
        preferences.refresh_devices()
        for device in preferences.devices:
            device.use = device.type == job["device"]
        scene.cycles.device = "GPU"
    else:
        scene.cycles.tile_size = job["tile_px"]
    scene.cycles.use_denoising = True
    scene.cycles.denoising_quality = "FAST" if job["is_draft"] else "HIGH"
    scene.cycles.use_light_tree = not job["is_draft"]
    scene.cycles.max_bounces = _DRAFT_BOUNCES if job["is_draft"] else _BOUNCES
    scene.view_settings.view_transform = job["view_transform"]
    scene.view_settings.exposure = job["exposure_ev"]
    scene.render.image_settings.color_mode = "RGB"


def _write_png(scene: bpy.types.Scene) -> None:
    """Set Blender to write 8-bit PNG pictures."""
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_depth = "8"


def _write_light(scene: bpy.types.Scene) -> None:
    """Set Blender to write linear light, from which a camera's picture is developed elsewhere."""
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"


def _set_up_data(scene: bpy.types.Scene, objects: list[bpy.types.Object]) -> None:
    """Set Blender to one ray through the middle of each pixel, without light, so that no pixel mixes two objects."""
    _set_up(scene, samples=1, seed=0)
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"  # the box filter ignores `filter_width`
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
