"""Rendering: pictures of a stage by Blender's Cycles, with depth, normals, instances and classes as ground truth."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Usd, UsdGeom

from garage2usd.common.errors import ConfigError
from garage2usd.common.output import check_file, check_writable, publish, staging_folder
from garage2usd.common.package import require
from garage2usd.common.progress import Announce, Progress, silent, unheard
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import Labels, read_labels
from garage2usd.render.blender_process import WITHOUT_MODULE, find_blender
from garage2usd.render.cameras import View, find_views
from garage2usd.render.devices import Device, check_birds_eye_device, default_samples, find_device, modules_for
from garage2usd.render.drawing import Drawing
from garage2usd.render.free_views import OVERHEAD, free_view
from garage2usd.render.pictures import Picture, with_needed
from garage2usd.render.tables import NEEDED, SlotFormat, SlotLabels, check_slots, write_frames
from garage2usd.scenes.values import metres_per_unit, up_axis
from garage2usd.sensors.rays.birds_eye import Orthographic
from garage2usd.sensors.slots import read_slots
from garage2usd.stage.labels import OBJECT_LABELS

__all__ = ["Device", "Picture", "Rendering", "SlotFormat", "render_stage"]

_LEAST_SIDE_PX, _GREATEST_SIDE_PX = 16, 8192
_CEILING = frozenset({OBJECT_LABELS["ceiling"]})


@dataclass(frozen=True)
class Rendering:
    """The files of a rendered data set.

    Attributes
    ----------
    folder
        Folder of the data set.
    frames
        The table of its frames.
    names
        Name of each frame.
    pictures
        The kinds of pictures; each has a folder of its name with a file for each frame.
    """

    folder: Path
    frames: Path
    names: tuple[str, ...]
    pictures: tuple[Picture, ...]


def render_stage(
    stage: str | Path,
    output: str | Path,
    *,
    cameras: Sequence[str] = (),
    frames: str | None = None,
    at_m: tuple[float, float, float] | None = None,
    look_at_m: tuple[float, float, float] | None = None,
    size_px: tuple[int, int] = (1280, 720),
    samples: int | None = None,
    seed: int = 0,
    pictures: Collection[Picture] = tuple(Picture),
    slots: Collection[SlotFormat] | None = None,
    device: Device = Device.AUTO,
    blender: str | Path | None = None,
    progress: Progress = silent,
    announce: Announce = unheard,
) -> Rendering:
    """Render the cameras of a stage with pixel-wise ground truth.

    Parameters
    ----------
    stage
        A stage of garage2usd or another one with perspective cameras.
    output
        Folder of the data set; files of the same names are replaced.
    cameras, frames
        As for `garage2usd.render.cameras.find_views`; without both only the cameras that stand still, if there are any.
    at_m, look_at_m
        Position and target of an additional camera, as for `garage2usd.render.free_views.free_view`; both or none. If
        `cameras` is empty, it replaces all cameras of the stage.
    size_px
        Width and height; the width takes the cameras' horizontal aperture.
    samples
        Samples per pixel of the colour picture; None for as many as two cores draw in two minutes, from 2 to 64.
    seed
        Seed of the colour picture's samples.
    pictures
        The kinds of pictures to render.
    slots
        Formats of parking slots to write beside ``slots.json``; None for no slots. Slots are derived from depth and
        instances.
    device
        Device that draws the colour. Colour drawn by a GPU differs in its bytes from that of the processor, which draws
        all other pictures.
    blender
        An installed Blender of version 5.0 or later; None for the Python module `bpy` or, without it, a Blender on the
        path or at its usual place. Pictures differ between versions.
    progress
        Called with the number of finished samples.
    announce
        Called with a description of the pictures, and with the time per picture once the first one is drawn.

    Raises
    ------
    ConfigError
        If a camera, a position, a frame or a size is invalid, a format of slots needs other pictures or views, or the
        device does not exist.
    MissingExtraError
        If Blender, or the package that reads its pictures, is not installed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    RenderError
        If Blender fails.
    StageError
        If the stage or the table of labels beside it cannot be read, or has no slots although they are requested.
    """
    path, folder = Path(stage), Path(output)
    if not all(_LEAST_SIDE_PX <= side <= _GREATEST_SIDE_PX for side in size_px):
        raise ConfigError("size", size_px, f"sides of {_LEAST_SIDE_PX} to {_GREATEST_SIDE_PX} pixels")
    kinds = tuple(kind for kind in Picture if kind in pictures)
    if not kinds:
        raise ConfigError("pictures", list(pictures), f"at least one of {', '.join(Picture)}")
    drawn_by = find_blender(blender)
    require("render", modules_for(device, drawn_by), without=WITHOUT_MODULE)
    check_writable(folder)
    check_file(folder / "frames.json")
    opened = open_stage(path)
    views = _views(opened, cameras, frames, at_m, look_at_m, size_px)
    has_birds_eye = any(isinstance(view.lens, Orthographic) for view in views)
    if has_birds_eye:
        check_birds_eye_device(device)
    labels = read_labels(opened, path)
    hidden = _hidden(opened, labels, views)
    if slots is not None:
        check_slots(slots, kinds, has_ground_view=has_birds_eye)
        read_slots(opened)  # raises before the work if there are no slots
    drawn_on = find_device(device, has_rays=False, blender=drawn_by)
    with staging_folder(folder) as staging:
        finished = staging / "finished"
        drawn = with_needed(kinds, NEEDED if slots is not None else ())
        count = samples or default_samples((view.size_px for view in views), drawn_on)
        drawing = Drawing(opened, labels, views, hidden, drawn, count, seed, finished, device=drawn_on)
        visible = drawing.draw(staging, progress, announce)
        classes = [sorted(OVERHEAD) if hide else [] for hide in hidden]
        table = write_frames(
            finished / "frames.json",
            list(zip(views, visible, classes, strict=True)),
            labels,
            kinds,
            stage=path,
            about={"size_px": list(size_px)},
        )
        told = [] if slots is None else SlotLabels(opened, labels, views, finished).write(slots)
        places = publish([*(finished / kind for kind in kinds), *told, table], folder)
    return Rendering(folder, places[-1], tuple(view.name for view in views), kinds)


def _views(
    stage: Usd.Stage,
    cameras: Sequence[str],
    frames: str | None,
    at_m: tuple[float, float, float] | None,
    look_at_m: tuple[float, float, float] | None,
    size_px: tuple[int, int],
) -> list[View]:
    """Collect the views of the stage's cameras and of the free camera."""
    if at_m is None and look_at_m is None:
        views = find_views(stage, cameras=cameras, frames=frames, size_px=size_px)
        still = [] if cameras or frames is not None else [view for view in views if view.frame is None]
        return still or views
    if at_m is None:
        raise ConfigError("at", None, "the place of the camera that looks at look_at")
    if look_at_m is None:
        raise ConfigError("look_at", None, "the place that the camera at at looks at")
    views = find_views(stage, cameras=cameras, frames=frames, size_px=size_px) if cameras else []
    return [*views, free_view(stage, at_m, look_at_m, size_px, [view.name for view in views])]


def _hidden(stage: Usd.Stage, labels: Labels, views: Sequence[View]) -> list[list[int]]:
    """Return for each view the ids of overhead objects, if its camera is above the ceiling; otherwise none."""
    boxes = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), [UsdGeom.Tokens.default_])
    up = up_axis(stage)
    ceilings = [stage.GetPrimAtPath(path) for path in labels.paths_of(_CEILING)]
    tops = [boxes.ComputeWorldBound(prim).ComputeAlignedRange().GetMax()[up] for prim in ceilings if prim]
    top_m = max(tops, default=np.inf) * metres_per_unit(stage)
    overhead = [labels.ids[path] for path in labels.paths_of(OVERHEAD)]
    return [overhead if view.camera_to_world[up, 3] > top_m else [] for view in views]
