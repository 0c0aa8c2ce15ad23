"""Semantic classes, and the table of every labelled object: prim path, instance id, class, world bounds."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout import Layout, ObjectKind, Placement
from garage2usd.layout.specs import Spec
from garage2usd.stage.prototypes import asset_of

__all__ = ["CITYSCAPES", "OBJECT_LABELS", "label_table", "points_of"]

OBJECT_LABELS: dict[ObjectKind, str] = {
    ObjectKind.FLOOR: "floor",
    ObjectKind.STALL: "parking_stall",
    ObjectKind.CEILING: "ceiling",
    ObjectKind.WALL: "wall",
    ObjectKind.PORTAL: "vehicle_door",
    ObjectKind.OBSTACLE: "obstacle",
    ObjectKind.COLUMN: "column",
    ObjectKind.LIGHT: "light",
    ObjectKind.DUCT: "duct",
    ObjectKind.SPEED_BUMP: "speed_bump",
    ObjectKind.WHEEL_STOP: "wheel_stop",
    ObjectKind.NO_PARKING_SIGN: "traffic_sign",
    ObjectKind.CAR: "car",
    ObjectKind.RAMP: "ramp",
    ObjectKind.SKY: "sky",
    ObjectKind.BARRIER: "barrier",
    ObjectKind.STALL_NUMBER: "stall_number",
    ObjectKind.CHARGER: "charger",
    ObjectKind.SPRINKLER: "sprinkler",
    ObjectKind.EXIT_SIGN: "exit_sign",
    ObjectKind.MIRROR: "mirror",
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
    "duct": "static",
    "speed_bump": "road",
    "wheel_stop": "static",
    "traffic_sign": "traffic sign",
    "car": "car",
    "ramp": "road",
    "sky": "sky",
    "barrier": "guard rail",
    "stall_number": "parking",
    "charger": "static",
    "sprinkler": "static",
    "exit_sign": "traffic sign",
    "mirror": "static",
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
    objects = []
    for index, placement in enumerate(layout.placements):
        low, high = _bounds_m(placement)
        objects.append(
            {
                "path": paths[index],
                "id": index + 1,
                "class": OBJECT_LABELS[placement.kind],
                "min_m": np.round(low, 4).tolist(),
                "max_m": np.round(high, 4).tolist(),
            }
        )
    classes = [{"name": name, "id": number, "cityscapes": CITYSCAPES[name]} for number, name in enumerate(names, 1)]
    return {"classes": classes, "objects": objects}


def _bounds_m(placement: Placement) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    low, high = _turned_bounds_m(placement.spec, placement.yaw_rad)
    position = np.array(placement.position_m)
    return low + position, high + position


@lru_cache(maxsize=65536)
def _turned_bounds_m(spec: Spec, yaw_rad: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Bounds of an asset's points, turned about +Y."""
    points = points_of(spec)
    cos, sin = np.cos(yaw_rad), np.sin(yaw_rad)
    turned = points @ np.array([[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]])
    return turned.min(axis=0), turned.max(axis=0)


@lru_cache(maxsize=4096)
def points_of(spec: Spec) -> NDArray[np.float64]:
    """All points of an asset's meshes, and the corners of its light; float64, shape (n, 3)."""
    asset = asset_of(spec)
    points = [part.points.astype(np.float64) for part in asset.parts]
    if asset.light is not None:
        x, y, z = asset.light.width_m / 2, asset.light.height_m, asset.light.depth_m / 2
        points.append(np.array([(-x, y, -z), (-x, y, z), (x, y, -z), (x, y, z)]))
    return np.concatenate(points)
