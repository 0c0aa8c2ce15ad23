"""``frames.json``: where the cameras stood, what their pictures are called, and what can be seen in them."""

import json
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import View
from garage2usd.render.pictures import Picture, VisibleInstance, class_colour
from garage2usd.version import VERSION

__all__ = ["write_frames"]

_CONVENTIONS = {
    "world": "the stage's axes, in metres",
    "camera": "+X right, +Y down, +Z forward (OpenCV)",
    "world_to_camera": "4 x 4, rows first, for column vectors: p_camera = world_to_camera @ p_world",
    "intrinsics": "u = (K @ p_camera)[0] / z, v likewise; pixel (column, row) covers [column, column + 1) and its "
    "middle is column + 0.5",
    "depth": "z of the camera (planar, not along the ray) in metres, 32-bit float, channel Z; infinite where there is "
    "nothing",
    "normals": "of the surface without normal maps, in the world's axes, channels X, Y, Z; 0 where there is nothing",
    "instance": "id = red + 256 * green + 65536 * blue; 0 is nothing, or nothing labelled",
    "semantic": "grey is the id of the class; 0 is nothing, or nothing labelled",
    "box_px": "left, top, right, bottom of what can be seen; right and bottom are the first that it does not reach",
}


def write_frames(
    path: Path,
    entries: Sequence[tuple[View, Sequence[VisibleInstance] | None, Sequence[str]]],
    labels: Labels,
    kinds: Collection[Picture],
    *,
    size_px: tuple[int, int],
    stage: Path,
) -> Path:
    """Write the table of frames.

    Parameters
    ----------
    path
        The file.
    entries
        View, visible objects (None where none were drawn) and hidden classes of each frame.
    labels
        What the objects are.
    kinds
        The kinds of pictures there are.
    size_px
        Width and height.
    stage
        What was drawn.
    """
    name_of = {number: name for name, number in labels.ids.items()}
    document = {
        "version": VERSION,
        "stage": stage.name,
        "conventions": _CONVENTIONS,
        "size_px": list(size_px),
        "classes": [
            {**entry.model_dump(), "colour": list(class_colour(number))}
            for number, entry in sorted(labels.classes.items())
        ],
        "frames": [
            {
                "name": view.name,
                "camera": view.camera,
                "frame": view.frame,
                "files": {kind: f"{kind}/{view.name}{kind.extension}" for kind in kinds},
                "intrinsics": view.lens.matrix(size_px).tolist(),
                "world_to_camera": view.world_to_camera().tolist(),
                "hidden_classes": list(hidden),
                **({} if visible is None else {"instances": [_instance(each, labels, name_of) for each in visible]}),
            }
            for view, visible, hidden in entries
        ],
    }
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    return path


def _instance(visible: VisibleInstance, labels: Labels, name_of: dict[int, str]) -> dict[str, Any]:
    return {
        "id": visible.id,
        "path": name_of[visible.id],
        "class": labels.classes[labels.class_ids[visible.id]].name,
        "box_px": list(visible.box_px),
        "pixels": visible.pixels,
    }
