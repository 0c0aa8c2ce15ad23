"""Which object is what: the label table beside a stage, or what the stage itself says."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Usd

from garage2usd.errors import StageError
from garage2usd.objects import KINDS
from garage2usd.reading.label_table import LARGEST_CLASS_ID, LARGEST_ID, SemanticClass, read_label_table
from garage2usd.reading.walk import placed_objects

__all__ = ["CITYSCAPES", "Labels", "read_labels"]

CITYSCAPES: dict[str, str] = {kind.label: kind.cityscapes for kind in KINDS}
"""Name of the nearest Cityscapes class of each class."""


@dataclass(frozen=True, eq=False)
class Labels:
    """The labelled objects of a stage.

    Attributes
    ----------
    classes
        All classes by their id.
    ids
        Instance id of each object by its path; a point of an instancer has its number in brackets after the
        instancer's path.
    class_ids
        Id of each object's class by the object's id.
    """

    classes: Mapping[int, SemanticClass]
    ids: Mapping[str, int]
    class_ids: Mapping[int, int]

    def paths_of(self, names: frozenset[str]) -> Iterator[str]:
        """Paths of the objects of some classes."""
        wanted = {number for number, entry in self.classes.items() if entry.name in names}
        return (path for path, number in self.ids.items() if self.class_ids[number] in wanted)


def read_labels(stage: Usd.Stage, path: Path | None) -> Labels:
    """Read the table beside a stage; where there is none, number the stage's labelled prims in their order.

    Parameters
    ----------
    stage
        The stage.
    path
        Its file; the table of ``garage.usdc`` is ``garage_labels.json`` beside it. None for a stage that is in memory.

    Raises
    ------
    ConfigError
        If the table cannot be read.
    StageError
        If it is not a table of labels, or contradicts itself.
    """
    table = read_label_table(path) if path else None
    if table is None:
        return _labels_of(stage)
    return Labels(
        classes={entry.id: entry for entry in table.classes},
        ids={path: entry.id for path, entry in table.by_path()},
        class_ids={entry.id: entry.class_id for _, entry in table.by_path()},
    )


def _labels_of(stage: Usd.Stage) -> Labels:
    """Classes of this program keep their ids; others follow by name."""
    found = [(placed.path, placed.label) for placed in placed_objects(stage, np.eye(4)) if placed.label]
    others = sorted({name for _, name in found} - CITYSCAPES.keys())
    names = [*CITYSCAPES, *others]
    if len(names) > LARGEST_CLASS_ID or len(found) > LARGEST_ID:
        raise StageError(stage.GetRootLayer().realPath, f"{len(names)} classes of {len(found)} objects are too many")
    number_of = {name: number for number, name in enumerate(names, 1)}
    classes = {
        number: SemanticClass(name=name, id=number, cityscapes=CITYSCAPES.get(name))
        for name, number in number_of.items()
    }
    ids = {path: number for number, (path, _) in enumerate(found, 1)}
    return Labels(classes, ids, {number: number_of[name] for number, (_, name) in enumerate(found, 1)})
