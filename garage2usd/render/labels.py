"""Which object is what: the label table beside a stage, or what the stage itself says."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pxr import Usd
from pydantic import BaseModel, Field, ValidationError

from garage2usd.documents import is_file, read_bytes
from garage2usd.errors import StageError
from garage2usd.reading.walk import placed_objects
from garage2usd.stage.labels import CITYSCAPES

__all__ = ["LARGEST_ID", "Labels", "SemanticClass", "read_labels"]

LARGEST_ID = 2**24 - 1
"""Ids of more than 24 bits fit no instance picture."""
_LARGEST_CLASS_ID = 255
_MAX_FILE_BYTES = 1024 * 1024 * 1024


class SemanticClass(BaseModel):
    """A class of objects: its name, its id from 1, and the nearest class of Cityscapes, where one is known."""

    name: str
    id: Annotated[int, Field(ge=1, le=_LARGEST_CLASS_ID)]
    cityscapes: str | None = None


class _Object(BaseModel):
    path: str
    id: Annotated[int, Field(ge=1, le=LARGEST_ID)]
    class_name: Annotated[str, Field(alias="class")]


class _Table(BaseModel):
    classes: list[SemanticClass]
    objects: list[_Object]


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


def read_labels(stage: Usd.Stage, path: Path) -> Labels:
    """Read the table beside a stage; where there is none, number the stage's labelled prims in their order.

    Parameters
    ----------
    stage
        The stage.
    path
        Its file; the table of ``garage.usdc`` is ``garage_labels.json`` beside it.

    Raises
    ------
    ConfigError
        If the table cannot be read.
    StageError
        If it is not a table of labels, or contradicts itself.
    """
    table = path.with_name(f"{path.stem}_labels.json")
    if not is_file(table):
        return _labels_of(stage)
    text = read_bytes(table, field="labels", max_bytes=_MAX_FILE_BYTES)
    try:
        return _labels_from(_Table.model_validate_json(text), table)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise StageError(table, f"not a table of labels: {place}: {first['msg']}") from None


def _labels_from(table: _Table, path: Path) -> Labels:
    class_of_name = {entry.name: entry.id for entry in table.classes}
    ids = {entry.path: entry.id for entry in table.objects}
    unknown = [entry for entry in table.objects if entry.class_name not in class_of_name]
    if unknown:
        raise StageError(path, f"{unknown[0].path} is of the class {unknown[0].class_name!r}, which is not listed")
    if not len(ids) == len({*ids.values()}) == len(table.objects):
        raise StageError(path, "a path or an id occurs twice")
    class_ids = {entry.id: class_of_name[entry.class_name] for entry in table.objects}
    return Labels({entry.id: entry for entry in table.classes}, ids, class_ids)


def _labels_of(stage: Usd.Stage) -> Labels:
    """Classes of this program keep their ids; others follow by name."""
    found = [(placed.path, placed.label) for placed in placed_objects(stage, np.eye(4)) if placed.label]
    others = sorted({name for _, name in found} - CITYSCAPES.keys())
    names = [*CITYSCAPES, *others]
    if len(names) > _LARGEST_CLASS_ID or len(found) > LARGEST_ID:
        raise StageError(stage.GetRootLayer().realPath, f"{len(names)} classes of {len(found)} objects are too many")
    number_of = {name: number for number, name in enumerate(names, 1)}
    classes = {
        number: SemanticClass(name=name, id=number, cityscapes=CITYSCAPES.get(name))
        for name, number in number_of.items()
    }
    ids = {path: number for number, (path, _) in enumerate(found, 1)}
    return Labels(classes, ids, {number: number_of[name] for number, (_, name) in enumerate(found, 1)})
