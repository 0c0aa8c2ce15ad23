"""Pictures of a stage by Blender's Cycles, with depth, normals, instances and classes: a data set."""

from collections.abc import Collection, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.errors import ConfigError
from garage2usd.limits import lift
from garage2usd.output import check_writable, publish, staging_folder
from garage2usd.progress import Progress, silent
from garage2usd.reading.files import open_stage
from garage2usd.reading.labels import Labels, read_labels
from garage2usd.render.blender_process import check_blender, run_blender
from garage2usd.render.cameras import View, find_views
from garage2usd.render.drawn_prims import SHAPE_PROPERTY, read_drawn_prims, write_shapes
from garage2usd.render.frames_file import write_frames
from garage2usd.render.pictures import (
    INDEX_LIMIT,
    Picture,
    Surfaces,
    read_surfaces,
    visible_instances,
    write_colour,
    write_picture,
)
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.variants import SWITCHES

__all__ = ["Picture", "Rendering", "render_stage"]

_LEAST_SIDE_PX, _GREATEST_SIDE_PX = 16, 8192
_OVERHEAD = frozenset(OBJECT_LABELS[kind] for kind, switch in SWITCHES.items() if switch.variant_set == "ceiling")
_CEILING = frozenset({OBJECT_LABELS["ceiling"]})
_BLENDER_FROM = {
    UsdGeom.Tokens.y: np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    UsdGeom.Tokens.z: np.eye(3),
}
"""From the axes of a stage, by the one that is up, to Blender's."""


@dataclass(frozen=True)
class Rendering:
    """The files of a data set.

    Attributes
    ----------
    folder
        Where it stands.
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
    size_px: tuple[int, int] = (1280, 720),
    samples: int = 64,
    seed: int = 0,
    pictures: Collection[Picture] = tuple(Picture),
    progress: Progress = silent,
) -> Rendering:
    """Draw what the cameras of a stage see, and what it is, pixel by pixel.

    Parameters
    ----------
    stage
        A stage of garage2usd or another one with perspective cameras.
    output
        Folder that the data set goes to; files of the same names are replaced.
    cameras, frames
        As for `garage2usd.render.cameras.find_views`.
    size_px
        Width and height; the width takes the cameras' horizontal aperture.
    samples
        Of each pixel of the colour picture.
    seed
        Of the colour picture's samples.
    pictures
        What is drawn.
    progress
        Called with the number of samples that are done.

    Raises
    ------
    ConfigError
        If a camera, a frame or a size cannot be used.
    MissingExtraError
        If Blender is not installed.
    OutputError
        If the files cannot be written. They appear whole or not at all.
    RenderError
        If Blender fails.
    StageError
        If the stage or the table of labels beside it cannot be read.
    """
    path, folder = Path(stage), Path(output)
    if not all(_LEAST_SIDE_PX <= side <= _GREATEST_SIDE_PX for side in size_px):
        raise ConfigError("size", size_px, f"sides of {_LEAST_SIDE_PX} to {_GREATEST_SIDE_PX} pixels")
    kinds = tuple(kind for kind in Picture if kind in pictures)
    if not kinds:
        raise ConfigError("pictures", list(pictures), f"at least one of {', '.join(Picture)}")
    check_blender()
    check_writable(folder)
    opened = open_stage(path)
    views = find_views(opened, cameras=cameras, frames=frames)
    labels = read_labels(opened, path)
    progress("scene", 0, 1)
    scene = read_drawn_prims(opened, labels.ids)
    hidden = _hidden(opened, labels, views)
    with staging_folder() as staging:
        finished = staging / "finished"
        for kind in kinds:
            (finished / kind).mkdir(parents=True)
        write_shapes(opened, scene, staging / "shapes.usda")
        np.savez(staging / "places.npz", shape=scene.shape, instance=scene.instance, to_world=scene.to_world)
        axes = _BLENDER_FROM[UsdGeom.GetStageUpAxis(opened)]
        digits = 1 + int(scene.instance.max(initial=0) >= INDEX_LIMIT)
        jobs = [_frame_job(view, hide, staging, kinds, digits) for view, hide in zip(views, hidden, strict=True)]
        total = sum(samples * bool(job["colour"]) + bool(job["data"]) for job in jobs)
        job = {
            "shapes": str(staging / "shapes.usda"),
            "places": str(staging / "places.npz"),
            "mask": [str(prim) for prim in (*scene.shapes, *scene.materials, *scene.domes)],
            "property": SHAPE_PROPERTY,
            "to_blender": _affine(axes).tolist(),
            "samples": samples,
            "seed": seed,
            "size_px": size_px,
            "frames": jobs,
        }
        progress("render", 0, total)
        lift()
        run_blender(job, staging, lambda done: progress("render", done, total))
        entries = []
        for number, (view, frame_job, hide) in enumerate(zip(views, jobs, hidden, strict=True)):
            progress("masks", number, len(views))
            if frame_job["colour"]:
                write_colour(Path(frame_job["colour"]), finished / Picture.COLOUR / f"{view.name}.png")
            surfaces = read_surfaces(map(Path, frame_job["data"]), axes.T) if frame_job["data"] else None
            if surfaces:
                _write_pictures(view, surfaces, labels, kinds, finished)
            visible = visible_instances(surfaces.instance) if surfaces else None
            entries.append((view, visible, sorted(_OVERHEAD) if hide else []))
        table = write_frames(finished / "frames.json", entries, labels, kinds, size_px=size_px, stage=path)
        progress("masks", len(views), len(views))
        places = publish([*(finished / kind for kind in kinds), table], folder)
    return Rendering(folder, places[-1], tuple(view.name for view in views), kinds)


def _hidden(stage: Usd.Stage, labels: Labels, views: Sequence[View]) -> list[list[int]]:
    """For each view the ids of what hangs overhead, if its camera stands over the ceiling and would see only that."""
    boxes = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), [UsdGeom.Tokens.default_])
    up = 1 if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y else 2
    ceilings = [stage.GetPrimAtPath(path) for path in labels.paths_of(_CEILING)]
    tops = [boxes.ComputeWorldBound(prim).ComputeAlignedRange().GetMax()[up] for prim in ceilings if prim]
    top_m = max(tops, default=np.inf) * UsdGeom.GetStageMetersPerUnit(stage)
    overhead = [labels.ids[path] for path in labels.paths_of(_OVERHEAD)]
    return [overhead if view.camera_to_world[up, 3] > top_m else [] for view in views]


def _frame_job(view: View, hidden: list[int], staging: Path, kinds: Collection[Picture], digits: int) -> dict[str, Any]:
    data = [str(staging / f"{view.name}_{digit}.exr") for digit in range(digits)]
    return {
        "colour": str(staging / f"{view.name}.png") if Picture.COLOUR in kinds else None,
        "data": data if set(kinds) - {Picture.COLOUR} else [],
        "lens": asdict(view.lens),
        "camera_to_world": view.camera_to_world.tolist(),
        "hidden": hidden,
    }


def _write_pictures(view: View, surfaces: Surfaces, labels: Labels, kinds: Collection[Picture], finished: Path) -> None:
    for kind in kinds:
        if kind is not Picture.COLOUR:
            write_picture(kind, finished / kind / f"{view.name}{kind.extension}", surfaces, labels.class_ids)


def _affine(turn: NDArray[np.float64]) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    return matrix
