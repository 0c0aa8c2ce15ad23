"""A stage's file read as a scene."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.errors import StageError
from garage2usd.reading.label_table import read_label_table
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.values import metres_y_up
from garage2usd.view.viewer.looks import Looks
from garage2usd.view.viewer.scene import LaneCurves, Placed, Scene, Shape, StallCorners, moved

__all__ = ["read_scene"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")


def read_scene(stage: Usd.Stage, path: Path) -> Scene:
    """Everything that the viewer shows of a stage.

    Parameters
    ----------
    stage
        The stage.
    path
        Its file; ``<stem>_labels.json`` beside it gives the instance ids.

    Raises
    ------
    StageError
        If nothing in the stage can be drawn, or the table of labels is none.
    """
    looks = Looks()
    objects = looks.objects(stage, metres_y_up(stage))
    if not objects:
        raise StageError(path, "nothing in it can be drawn")
    remarks = [f"{count} prims of type {kind} are not drawn" for kind, count in sorted(looks.undrawn.items())]
    return Scene(
        name=path.name,
        facts=_facts(stage),
        objects=objects,
        shapes=looks.shapes,
        palettes=looks.palettes,
        surfaces=looks.surfaces,
        lanes=_lanes(stage),
        ids=_ids(path),
        bounds_m=_bounds_m(objects, looks.shapes),
        remarks=remarks,
    )


def _facts(stage: Usd.Stage) -> dict[str, str]:
    root = stage.GetDefaultPrim()
    data = root.GetCustomData() if root else {}
    return {name: str(data[name]) for name in _FACTS if name in data}


def _lanes(stage: Usd.Stage) -> LaneCurves | None:
    """The lane graph and the stalls, as far as they are sound; None where there are none."""
    lanes = read_lanes(stage)
    if not lanes.nodes and not lanes.stalls:
        return None
    middles = [(node.position[0], node.height_m, node.position[1]) for node in lanes.nodes]
    return LaneCurves(
        nodes_m=np.array(middles, dtype=np.float32).reshape(-1, 3),
        kinds=[node.kind for node in lanes.nodes],
        edges=np.array([(edge.start, edge.end) for edge in lanes.edges], dtype=np.int32).reshape(-1, 2),
        forward=[edge.one_way for edge in lanes.edges],
        stalls=[
            StallCorners(
                {"id": stall.name, "use": str(stall.use), "accessNode": stall.access, **dict(stall.facts)},
                np.array(stall.corners, dtype=np.float32),
            )
            for stall in lanes.stalls
        ],
    )


def _ids(path: Path) -> dict[str, int]:
    """Instance id of each object by its path; empty without a table."""
    table = read_label_table(path)
    return {entry.path: entry.id for entry in table.objects} if table else {}


def _bounds_m(objects: list[Placed], shapes: list[Shape]) -> NDArray[np.float64]:
    boxes = np.array([_corners(shape) for shape in shapes])
    matrices = np.array([placed.matrix for placed in objects])
    corners = boxes[[placed.shape for placed in objects]] @ matrices[:, :3, :3] + matrices[:, 3:, :3]
    bounds: NDArray[np.float64] = np.stack([corners.min(axis=(0, 1)), corners.max(axis=(0, 1))])
    return bounds


def _corners(shape: Shape) -> NDArray[np.float64]:
    """Eight corners of a shape's bounds in its own space; its lights where it has no triangles."""
    points: list[NDArray[Any]] = [light.matrix[3:, :3] for light in shape.lights]
    if shape.parts:
        points = [moved(part.positions_m, place) for part, place in zip(shape.parts, shape.matrices, strict=True)]
    every = np.concatenate(points)
    pair = np.stack([every.min(axis=0), every.max(axis=0)])
    return np.array([[pair[c >> axis & 1, axis] for axis in range(3)] for c in range(8)], dtype=np.float64)
