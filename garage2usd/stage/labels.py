"""The label table: prim path, instance id, semantic class and world bounds of every labelled object."""

from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout import Layout, ObjectTable
from garage2usd.objects import CLASSES, CLASSES_VERSION, KINDS
from garage2usd.objects.pieces import PIECES, PieceClass, piece_name, pieces_of
from garage2usd.reading.label_table import LabelledObject, LabelTable, SemanticClass
from garage2usd.stage.bounds import world_bounds_m
from garage2usd.stage.prototypes import asset_of

__all__ = ["OBJECT_LABELS", "label_table"]

OBJECT_LABELS: dict[str, str] = {kind.name: kind.label for kind in KINDS}
"""Semantic class of each kind of object, authored on every instance root."""
_DECIMALS = 3
"""Decimals of bounds in metres."""
_Bounds = tuple[tuple[float, float, float], tuple[float, float, float]]


def label_table(layout: Layout, paths: Sequence[str]) -> LabelTable:
    """Make the label table of a layout: classes and objects.

    Parameters
    ----------
    layout
        The objects.
    paths
        Prim path of each placement by its index in ``layout.placements``.

    Returns
    -------
    LabelTable
        The placements with ids from 1 in their order, then their pieces with separate classes.
    """
    placements = layout.placements
    objects: dict[str, list[LabelledObject]] = defaultdict(list)
    of_spec = [spec.kind.number for spec in placements.specs]
    numbers = [of_spec[spec] for spec in placements.spec.tolist()]
    for number, (path, class_id, (least, most)) in enumerate(
        zip(paths, numbers, _bounds_m(placements), strict=True), 1
    ):
        parent, _, name = path.rpartition("/")
        objects[parent].append(LabelledObject(name, number, class_id, least, most))
    for number, (row, piece, (least, most)) in enumerate(_pieces(placements), len(numbers) + 1):
        parent, _, name = paths[row].rpartition("/")
        entry = LabelledObject(f"{name}/{piece_name(piece.label)}", number, piece.number, least, most)
        objects[parent].append(entry)
    stalls = placements.rows_of("stall").tolist()
    parked = zip(stalls, layout.cars_in_stalls().tolist(), strict=True)
    return LabelTable(
        classes_version=CLASSES_VERSION,
        classes=tuple(SemanticClass(name=each.label, id=each.number, cityscapes=each.cityscapes) for each in CLASSES),
        objects={parent: tuple(rows) for parent, rows in objects.items()},
        parked=tuple((stall + 1, car + 1) for stall, car in parked if car >= 0),
        number_plates=tuple((plates + 1, car + 1, text) for plates, car, text in layout.plates_of_cars()),
    )


def _pieces(objects: ObjectTable) -> list[tuple[int, PieceClass, _Bounds]]:
    """Row, class and bounds of each labelled piece of the objects, sorted by row and class."""
    classes_of = [pieces_of(asset_of(spec)) for spec in objects.specs]
    found: list[tuple[int, PieceClass, _Bounds]] = []
    for piece in PIECES:
        has_piece = np.array([piece.label in classes for classes in classes_of], dtype=bool)
        rows = np.flatnonzero(has_piece[objects.spec])
        if len(rows):
            found += [
                (row, piece, box) for row, box in zip(rows.tolist(), _bounds_m(objects, rows, piece), strict=True)
            ]
    return sorted(found, key=lambda entry: (entry[0], entry[1].number))


def _bounds_m(
    objects: ObjectTable, rows: NDArray[np.intp] | slice = slice(None), piece: PieceClass | None = None
) -> Iterator[_Bounds]:
    corners = world_bounds_m(objects, rows, piece=None if piece is None else piece.label)
    low, high = ((np.round(each, _DECIMALS) + 0.0).tolist() for each in corners)
    return zip(low, high, strict=True)
