"""Reading of a stage's file as a viewer scene."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import StageError
from garage2usd.reading.label_table import read_label_table
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.reading.whole_garage import garage_root
from garage2usd.scenes.values import metres_y_up
from garage2usd.view.viewer.looks import Looks
from garage2usd.view.viewer.scene import Placed, Scene, Shape, box_corners, moved

__all__ = ["read_scene"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def read_scene(stage: Usd.Stage, path: Path) -> Scene:
    """Read a stage as a viewer scene.

    Parameters
    ----------
    stage
        The stage.
    path
        The stage's file; ``<stem>_labels.json`` beside it provides the instance ids.

    Raises
    ------
    StageError
        If nothing in the stage can be drawn, or the file beside it is not a label table.
    """
    looks = Looks()
    objects = looks.objects(stage, metres_y_up(stage))
    if not objects:
        raise StageError(path, "nothing in it can be drawn")
    remarks = [f"{count} prims of type {kind} are not drawn" for kind, count in sorted(looks.undrawn.items())]
    remarks += looks.remarks.lines()
    return Scene(
        name=path.name,
        facts=_facts(stage),
        objects=objects,
        shapes=looks.shapes.values,
        palettes=looks.palettes.values,
        surfaces=looks.surfaces,
        textures=looks.shown.textures,
        pictures=looks.drawn.pictures,
        lanes=read_lanes(stage),
        ids=_ids(path),
        bounds_m=_bounds_m(objects, looks.shapes.values),
        remarks=remarks,
        levels=levels_of(stage),
    )


def _facts(stage: Usd.Stage) -> dict[str, str]:
    root = garage_root(stage)
    data = root.GetCustomData() if root else {}
    return {name: str(data[name]) for name in _FACTS if name in data}


def _ids(path: Path) -> dict[str, int]:
    """Instance id of each object by its path; empty without a label table."""
    table = read_label_table(path)
    return {path: entry.id for path, entry in table.by_path()} if table else {}


def _bounds_m(objects: list[Placed], shapes: list[Shape]) -> NDArray[np.float64]:
    boxes = np.array([_corners(shape) for shape in shapes])
    matrices = np.array([placed.matrix for placed in objects])
    corners = boxes[[placed.shape for placed in objects]] @ matrices[:, :3, :3] + matrices[:, 3:, :3]
    bounds: NDArray[np.float64] = np.stack([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])
    return bounds


def _corners(shape: Shape) -> NDArray[np.float64]:
    """Eight corners of a shape's bounding box in its own space; those of its lights if it has no triangles."""
    points: list[NDArray[Any]] = [moved(piece.mesh.positions_m, piece.matrix) for piece in shape.pieces]
    points = points or [light.matrix[3:, :3] for light in shape.lights]
    return box_corners(np.concatenate(points)).astype(np.float64)
