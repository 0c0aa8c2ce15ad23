"""Semantic classes, and the table of every labelled object: prim path, instance id, class, world bounds."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from garage2usd.layout import Layout, ObjectKind
from garage2usd.layout.table import KINDS
from garage2usd.stage.bounds import world_bounds_m

__all__ = ["CITYSCAPES", "OBJECT_LABELS", "label_table"]

OBJECT_LABELS: dict[ObjectKind, str] = {
    ObjectKind.FLOOR: "floor",
    ObjectKind.STALL: "parking_stall",
    ObjectKind.CEILING: "ceiling",
    ObjectKind.WALL: "wall",
    ObjectKind.PORTAL: "vehicle_door",
    ObjectKind.OBSTACLE: "obstacle",
    ObjectKind.COLUMN: "column",
    ObjectKind.LIGHT: "light",
    ObjectKind.BEAM: "beam",
    ObjectKind.DUCT: "duct",
    ObjectKind.CABLE_TRAY: "cable_tray",
    ObjectKind.SPEED_BUMP: "speed_bump",
    ObjectKind.WHEEL_STOP: "wheel_stop",
    ObjectKind.NO_PARKING_SIGN: "traffic_sign",
    ObjectKind.CONE: "traffic_cone",
    ObjectKind.CAR: "car",
    ObjectKind.RAMP: "ramp",
    ObjectKind.SKY: "sky",
    ObjectKind.BARRIER: "barrier",
    ObjectKind.STALL_NUMBER: "stall_number",
    ObjectKind.ZONE_PLATE: "zone_plate",
    ObjectKind.CHARGER: "charger",
    ObjectKind.SPRINKLER: "sprinkler",
    ObjectKind.EXIT_SIGN: "exit_sign",
    ObjectKind.MIRROR: "mirror",
    ObjectKind.FLOOR_STAIN: "floor_stain",
}
"""Semantic class of each kind of object, authored on every instance root."""

CITYSCAPES: dict[str, str] = {
    "floor": "road",
    "parking_stall": "parking",
    "ceiling": "building",
    "wall": "wall",
    "vehicle_door": "wall",
    "obstacle": "building",
    "column": "pole",
    "light": "static",
    "beam": "building",
    "duct": "static",
    "cable_tray": "static",
    "speed_bump": "road",
    "wheel_stop": "static",
    "traffic_sign": "traffic sign",
    "traffic_cone": "static",
    "car": "car",
    "ramp": "road",
    "sky": "sky",
    "barrier": "guard rail",
    "stall_number": "parking",
    "zone_plate": "traffic sign",
    "charger": "static",
    "sprinkler": "static",
    "exit_sign": "traffic sign",
    "mirror": "static",
    "floor_stain": "road",
}
"""Name of the nearest Cityscapes class of each class."""


def label_table(layout: Layout, paths: Sequence[str]) -> dict[str, list[dict[str, Any]]]:
    """Classes and objects as plain values for JSON.

    Parameters
    ----------
    layout
        The objects.
    paths
        Prim path of each placement by its index in ``layout.placements``.

    Returns
    -------
    dict
        ``classes``: name, id from 1 and Cityscapes name of each class; ``objects``: for each placement in their order
        ``path``, ``id`` from 1, ``class``, and ``min_m`` and ``max_m``, the corners of its bounds in the world.
    """
    names = list(CITYSCAPES)
    class_of_kind = [OBJECT_LABELS[kind] for kind in KINDS]
    low, high = (np.round(corners, 4).tolist() for corners in world_bounds_m(layout.placements))
    objects = [
        {"path": path, "id": number, "class": class_of_kind[kind], "min_m": least, "max_m": most}
        for number, (path, kind, least, most) in enumerate(
            zip(paths, layout.placements.kind.tolist(), low, high, strict=True), 1
        )
    ]
    classes = [{"name": name, "id": number, "cityscapes": CITYSCAPES[name]} for number, name in enumerate(names, 1)]
    return {"classes": classes, "objects": objects}
