"""Semantic classes, and the table of every labelled object: prim path, instance id, class, world bounds."""

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
        Its objects are the placements in their order, with ids from 1.
    """
    low, high = ((np.round(corners, 4) + 0.0).tolist() for corners in world_bounds_m(layout.placements))
    return LabelTable(
        classes=tuple(SemanticClass(name=kind.label, id=kind.number, cityscapes=kind.cityscapes) for kind in KINDS),
        objects=tuple(
            LabelledObject(path=path, id=number, class_name=KINDS[kind].label, min_m=least, max_m=most)
            for number, (path, kind, least, most) in enumerate(
                zip(paths, layout.placements.kind.tolist(), low, high, strict=True), 1
            )
        ),
    )
