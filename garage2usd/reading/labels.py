"""Labels of a stage's objects: the label table beside the stage, or the labels of its prims; class of number plates."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import StageError
from garage2usd.objects import CLASSES, CLASSES_VERSION
from garage2usd.reading.label_table import LARGEST_CLASS_ID, LARGEST_ID, SemanticClass, read_label_table
from garage2usd.scenes.walk import placed_objects

PLATE_TEXT = "garage:numberPlate:text"
"""Attribute of the prim of a car's number plates: the text on both plates."""
CAR_OF_PLATE = "garage:numberPlate:car"
"""Relationship from the prim of number plates to the prim of their car."""
_Id = TypeVar("_Id", bound=np.integer[Any])
CITYSCAPES: dict[str, str] = {entry.label: entry.cityscapes for entry in CLASSES}
"""Name of the nearest Cityscapes class of each semantic class."""
_NUMBERS = {entry.label: entry.number for entry in CLASSES}
"""Id of each semantic class by name."""


class NumberPlates(NamedTuple):
    """The front and rear number plates of a car.

    Attributes
    ----------
    car
        The car's id.
    text
        Text on the plates.
    """

    car: int
    text: str


@dataclass(frozen=True, eq=False)
class Labels:
    """The labelled objects of a stage.

    Attributes
    ----------
    classes_version
        Version of the table of classes for the ids (`garage2usd.objects.CLASSES_VERSION`).
    classes
        All classes by their id.
    ids
        Instance id of each object by its path; a point of an instancer has its number in brackets after the
        instancer's path.
    class_ids
        Class id by the object's id.
    plates
        The number plates of cars by their own ids.
    parts
        Id of the object that each other part with an own id belongs to, such as a pose of a person who walks.
    """

    classes_version: int
    classes: Mapping[int, SemanticClass]
    ids: Mapping[str, int]
    class_ids: Mapping[int, int]
    plates: Mapping[int, NumberPlates] = field(default_factory=dict)
    parts: Mapping[int, int] = field(default_factory=dict)

    def instance_of(self, number: int) -> int:
        """Return an object's id in instance pictures and point clouds: plates and parts have the id of their object."""
        return self.plates[number].car if number in self.plates else self.parts.get(number, number)

    def instances_of(self, ids: NDArray[_Id]) -> NDArray[_Id]:
        """Return the instance ids in pictures and point clouds for an array of object ids, 0 for none; of any shape."""
        distinct, which = np.unique(ids, return_inverse=True)
        found = np.array([self.instance_of(number) for number in distinct.tolist()], dtype=ids.dtype)
        return found[which].reshape(ids.shape)

    def with_plates(self, paths: Iterable[str]) -> list[str]:
        """Return the paths of some objects, and of the number plates of the cars among them."""
        paths = list(paths)
        cars = {self.ids[path] for path in paths if path in self.ids}
        own = {number for number, plates in self.plates.items() if plates.car in cars}
        return [*paths, *(path for path, number in self.ids.items() if number in own)] if own else paths

    def paths_of(self, names: frozenset[str]) -> Iterator[str]:
        """Return the paths of the objects of some classes."""
        wanted = {number for number, entry in self.classes.items() if entry.name in names}
        return (path for path, number in self.ids.items() if self.class_ids[number] in wanted)


def read_labels(stage: Usd.Stage, path: Path | None) -> Labels:
    """Read the label table beside a stage; without one, number the stage's labelled prims in their order.

    Parameters
    ----------
    stage
        The stage.
    path
        File of the stage; the table of ``garage.usdc`` is ``garage_labels.json`` beside it. None for a stage in memory.

    Raises
    ------
    ConfigError
        If the table cannot be read.
    StageError
        If it is not a label table, or contradicts itself.
    """
    table = read_label_table(path) if path else None
    if table is None:
        return _labels_of(stage)
    return Labels(
        classes_version=table.classes_version,
        classes={entry.id: entry for entry in table.classes},
        ids={path: entry.id for path, entry in table.by_path()},
        class_ids={entry.id: entry.class_id for _, entry in table.by_path()},
        plates={number: NumberPlates(car, text) for number, car, text in table.number_plates},
    )


def owner_of(path: str, ids: Mapping[str, int]) -> int:
    """Return the id of the nearest labelled prim among a prim and its parents; 0 without one."""
    while path and path not in ids:
        path = path[: max(path.rfind("/"), path.rfind("["))]  # a point's parent is its instancer
    return ids.get(path, 0)


def _labels_of(stage: Usd.Stage) -> Labels:
    """Number the labelled prims of a stage; known classes keep their ids, and others follow by name."""
    found = [
        (placed.path, placed.label) for placed in placed_objects(stage, np.eye(4), with_looks=False) if placed.label
    ]
    others = sorted({name for _, name in found} - _NUMBERS.keys())
    number_of = {**_NUMBERS, **{name: number for number, name in enumerate(others, max(_NUMBERS.values()) + 1)}}
    if max(number_of.values()) > LARGEST_CLASS_ID or len(found) > LARGEST_ID:
        names = f"{len(number_of)} classes of {len(found)} objects"
        raise StageError(stage.GetRootLayer().realPath, f"{names} are too many")
    classes = {
        number: SemanticClass(name=name, id=number, cityscapes=CITYSCAPES.get(name))
        for name, number in number_of.items()
    }
    ids = {path: number for number, (path, _) in enumerate(found, 1)}
    class_ids = {number: number_of[name] for number, (_, name) in enumerate(found, 1)}
    return Labels(CLASSES_VERSION, classes, ids, class_ids, dict(_plates_of(stage, ids)))


def _plates_of(stage: Usd.Stage, ids: Mapping[str, int]) -> Iterator[tuple[int, NumberPlates]]:
    """Yield the id of each prim of number plates, with the id of its car and the text on the plates."""
    for path, number in ids.items():
        if "[" in path:  # a point of an instancer is not a prim
            continue
        prim = stage.GetPrimAtPath(path)
        cars = prim.GetRelationship(CAR_OF_PLATE).GetTargets() if prim.HasRelationship(CAR_OF_PLATE) else []
        if cars and str(cars[0]) in ids:
            yield number, NumberPlates(ids[str(cars[0])], str(prim.GetAttribute(PLATE_TEXT).Get() or ""))
