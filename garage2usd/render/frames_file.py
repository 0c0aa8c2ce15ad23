"""The table of frames, ``frames.json``: poses of the cameras, their picture files and visible objects."""

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from garage2usd.common.version import VERSION
from garage2usd.reading.labels import Labels
from garage2usd.render.cameras import View
from garage2usd.render.pictures import Picture, VisibleInstance, class_colour

__all__ = ["write_frames"]

_CONVENTIONS = {
    "world": "the stage's axes, in metres",
    "camera": "+X right, +Y down, +Z forward (OpenCV)",
    "world_to_camera": "4 x 4, rows first, for column vectors: p_camera = world_to_camera @ p_world",
    "intrinsics": "u = (K @ p_camera)[0] / z, v likewise; pixel (column, row) covers [column, column + 1) and its "
    "middle is column + 0.5",
    "depth": "z of the camera (planar, not along the ray) in metres, 32-bit float, channel Z; infinite where there is "
    "nothing; of fisheyes, whose frames say so, the distance along the ray, which in around views starts at the camera "
    "that serves the pixel",
    "normals": "of the surface without normal maps, in the world's axes, channels X, Y, Z; 0 where there is nothing",
    "instance": "id = red + 256 * green + 65536 * blue; 0 is nothing, or nothing labelled; number plates have "
    "the id of their car",
    "semantic": "grey is the id of the class; 0 is nothing, or nothing labelled",
    "box_px": "left, top, right, bottom of what can be seen; right and bottom are the first that it does not reach",
}


def write_frames(
    path: Path,
    entries: Sequence[tuple[View, Sequence[VisibleInstance] | None, Sequence[str]]],
    labels: Labels,
    kinds: Collection[Picture],
    *,
    stage: Path,
    about: Mapping[str, object],
) -> Path:
    """Write the table of frames of rendered views.

    Parameters
    ----------
    path
        The file.
    entries
        View, visible objects (None where none were drawn) and hidden classes of each frame.
    labels
        Table of labels of the stage.
    kinds
        The rendered kinds of pictures.
    stage
        Path of the rendered stage.
    about
        Entries about all frames, by key.
    """
    name_of = {number: name for name, number in labels.ids.items()}
    document = {
        "version": VERSION,
        "stage": stage.name,
        "conventions": _CONVENTIONS,
        **about,
        "classes_version": labels.classes_version,
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
                **_optics(view),
                "world_to_camera": view.world_to_camera().tolist(),
                "hidden_classes": list(hidden),
                **view.facts,
                **({} if visible is None else _seen(visible, labels, name_of)),
            }
            for view, visible, hidden in entries
        ],
    }
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8", newline="\n")
    return path


def _optics(view: View) -> dict[str, Any]:
    matrix = view.intrinsics()
    return {"depth": "along_ray"} if matrix is None else {"intrinsics": matrix.tolist()}


def _seen(visible: Sequence[VisibleInstance], labels: Labels, name_of: dict[int, str]) -> dict[str, Any]:
    """List the visible objects of a frame, with number plates merged into their cars."""
    found: dict[int, VisibleInstance] = {}
    for each in visible:
        number = labels.instance_of(each.id)
        found[number] = found[number].joined(each) if number in found else replace(each, id=number)
    plates = [
        {
            "id": labels.plates[each.id].car,
            "path": name_of[each.id],
            "text": labels.plates[each.id].text,
            "box_px": list(each.box_px),
            "pixels": each.pixels,
        }
        for each in visible
        if each.id in labels.plates
    ]
    return {
        "instances": [_instance(found[number], labels, name_of) for number in sorted(found)],
        "number_plates": plates,
    }


def _instance(visible: VisibleInstance, labels: Labels, name_of: dict[int, str]) -> dict[str, Any]:
    return {
        "id": visible.id,
        "path": name_of[visible.id],
        "class": labels.classes[labels.class_ids[visible.id]].name,
        "box_px": list(visible.box_px),
        "pixels": visible.pixels,
    }
