"""Labels of drawn strips beside their corners: the slots in each of them, and the ground that is free to drive on.

A folder of strips that has them has ``labels.json``, in which each picture's name has its slots, and a mask for each
picture in a folder ``free``: 255 where the pixel shows ground that a car can drive on, 0 where it shows anything else,
and 128 where it shows nothing that has a label, as under the car itself.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError
from strips import SIZE_PX, is_mirrored

from garage2usd.common.errors import ConfigError
from garage2usd.reading.labels import Labels
from garage2usd.render.pictures import Picture, classes_of, read_ids
from garage2usd.sensors.rays.birds_eye import FREE_CLASSES

__all__ = ["LABELS_FILE", "StripLabels", "read_strip_labels", "write_strip_labels"]

LABELS_FILE = "labels.json"
_MASKS = "free"
_FREE, _UNKNOWN, _TAKEN = 255, 128, 0
_MIRRORED = [1, 0, 3, 2]
"""Corners of a slot in a mirrored picture: what was left is right."""


@dataclass(frozen=True, eq=False)
class StripLabels:
    """What a strip shows, as `strips.Strip` has its pixels: mirrored where the right side is shown.

    Attributes
    ----------
    corners_px
        (column, row) of the corners of each slot, also outside the picture: left and right end of the entry as seen by
        a driver who enters forwards, right and left of the rear; float64, shape (n, 4, 2).
    visibility
        `garage2usd.sensors.slots.Visibility` of the ends of the entry; int64, shape (n, 2).
    is_occupied
        Whether a car stands in the slot, or over its lines; bool, shape (n,).
    is_free, is_known
        Whether pixels show ground that a car can drive on, and whether that is known; bool, shape (300, 96).
    """

    corners_px: NDArray[np.float64]
    visibility: NDArray[np.int64]
    is_occupied: NDArray[np.bool_]
    is_free: NDArray[np.bool_]
    is_known: NDArray[np.bool_]


def write_strip_labels(folder: Path, places: Mapping[str, Path], finished: Path, labels: Labels) -> None:
    """Write the labels of strips whose pictures stand in a folder.

    Parameters
    ----------
    folder
        Of the strips.
    places
        The picture of each view in it, by the view's name.
    finished
        What was drawn: ``slots.json`` and pictures of instances.
    labels
        Table of labels of the stage.
    """
    document = json.loads((finished / "slots.json").read_text(encoding="utf-8"))
    occupied = {slot["name"]: bool(slot["occupied"]) for slot in document["slots"]}
    slots = {
        str(places[frame["name"]]): [
            {
                "name": slot["name"],
                "corners_px": slot["corners_px"],
                "visibility": slot["visibility"][:2],
                "occupied": occupied[slot["name"]],
            }
            for slot in frame["slots"]
            if None not in slot["corners_px"]
        ]
        for frame in document["frames"]
    }
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(slots[name])}" for name in sorted(slots))
    (folder / LABELS_FILE).write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")
    free = [number for number, entry in labels.classes.items() if entry.name in FREE_CLASSES]
    for view, place in places.items():
        ids = read_ids(finished / Picture.INSTANCE / f"{view}{Picture.INSTANCE.extension}")
        classes = classes_of(ids, labels.class_ids)
        mask = np.where(classes == 0, _UNKNOWN, np.where(np.isin(classes, free), _FREE, _TAKEN)).astype(np.uint8)
        path = _mask_of(folder, str(place))
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(mask).save(path)


def read_strip_labels(folder: Path) -> dict[str, StripLabels]:
    """The labels of the strips of a folder, by the pictures' names.

    Raises
    ------
    ConfigError
        If the folder has none, or a mask is missing; names the file.
    """
    table = folder / LABELS_FILE
    try:
        named = json.loads(table.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ConfigError("drawn", str(table), "strips with labels, which `real.py draw` writes") from None
    return {name: _labels(folder, name, slots) for name, slots in named.items()}


def _labels(folder: Path, name: str, slots: list[dict[str, object]]) -> StripLabels:
    corners = np.array([slot["corners_px"] for slot in slots], dtype=np.float64).reshape(-1, 4, 2)
    visibility = np.array([slot["visibility"] for slot in slots], dtype=np.int64).reshape(-1, 2)
    path = _mask_of(folder, name)
    try:
        with Image.open(path) as image:
            mask = np.asarray(image.convert("L"))
    except (OSError, UnidentifiedImageError):
        raise ConfigError("drawn", str(path), "a mask of free ground for each picture") from None
    if is_mirrored(name):
        corners = corners[:, _MIRRORED] * (-1, 1) + (SIZE_PX[0], 0)
        visibility, mask = visibility[:, ::-1], mask[:, ::-1]
    occupied = np.array([slot["occupied"] for slot in slots], dtype=bool)
    return StripLabels(corners, visibility, occupied, mask == _FREE, mask != _UNKNOWN)


def _mask_of(folder: Path, name: str) -> Path:
    return (folder / _MASKS / name).with_suffix(".png")
