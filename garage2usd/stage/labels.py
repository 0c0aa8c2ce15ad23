"""Semantic classes, and the table of every labelled object: prim path, instance id, class, world bounds."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from garage2usd.layout import Layout
from garage2usd.objects import KINDS
from garage2usd.stage.bounds import world_bounds_m

__all__ = ["CITYSCAPES", "OBJECT_LABELS", "label_table"]

OBJECT_LABELS: dict[str, str] = {kind.name: kind.label for kind in KINDS}
"""Semantic class of each kind of object, authored on every instance root."""

CITYSCAPES: dict[str, str] = {kind.label: kind.cityscapes for kind in KINDS}
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
        ``classes``: name, id and Cityscapes name of each class; ``objects``: for each placement in their order
        ``path``, ``id`` from 1, ``class``, and ``min_m`` and ``max_m``, the corners of its bounds in the world.
    """
    low, high = (np.round(corners, 4).tolist() for corners in world_bounds_m(layout.placements))
    objects = [
        {"path": path, "id": number, "class": KINDS[kind].label, "min_m": least, "max_m": most}
        for number, (path, kind, least, most) in enumerate(
            zip(paths, layout.placements.kind.tolist(), low, high, strict=True), 1
        )
    ]
    classes = [{"name": kind.label, "id": kind.number, "cityscapes": kind.cityscapes} for kind in KINDS]
    return {"classes": classes, "objects": objects}
