"""Semantic classes, and the table of every labelled object: prim path, instance id, class, world bounds."""

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from garage2usd.layout import Layout
from garage2usd.objects import KINDS
from garage2usd.reading.label_table import LabelledObject, LabelTable, SemanticClass
from garage2usd.stage.bounds import world_bounds_m

__all__ = ["OBJECT_LABELS", "label_table"]

OBJECT_LABELS: dict[str, str] = {kind.name: kind.label for kind in KINDS}
"""Semantic class of each kind of object, authored on every instance root."""


def label_table(layout: Layout, paths: Sequence[str]) -> LabelTable:
    """Classes and objects of a layout.

    Parameters
    ----------
    layout
        The objects.
    paths
        Prim path of each placement by its index in ``layout.placements``.

    Returns
    -------
    LabelTable
        The placements have ids from 1 in their order.
    """
    low, high = ((np.round(corners, 4) + 0.0).tolist() for corners in world_bounds_m(layout.placements))
    objects: dict[str, list[LabelledObject]] = defaultdict(list)
    for number, (path, kind, least, most) in enumerate(
        zip(paths, layout.placements.kind.tolist(), low, high, strict=True), 1
    ):
        parent, _, name = path.rpartition("/")
        objects[parent].append(LabelledObject(name, number, KINDS[kind].number, least, most))
    return LabelTable(
        classes=tuple(SemanticClass(name=kind.label, id=kind.number, cityscapes=kind.cityscapes) for kind in KINDS),
        objects={parent: tuple(rows) for parent, rows in objects.items()},
    )
