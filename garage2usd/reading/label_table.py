"""The table of labels beside a stage, JSON: the model that its writer and all who read it share."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, FiniteFloat, ValidationError, model_validator

from garage2usd.common.documents import is_file, read_text
from garage2usd.common.errors import StageError
from garage2usd.common.settings import Record, first_fault

__all__ = ["LARGEST_CLASS_ID", "LARGEST_ID", "LabelTable", "LabelledObject", "SemanticClass", "read_label_table"]

LARGEST_ID = 2**24 - 1
"""Ids of more than 24 bits fit no instance picture."""
LARGEST_CLASS_ID = 255
"""Classes have eight bits in a picture of classes."""
_MAX_FILE_BYTES = 1024 * 1024 * 1024


class SemanticClass(Record):
    """A class of objects: its name, its id from 1, and the nearest class of Cityscapes, where one is known."""

    name: str
    id: Annotated[int, Field(ge=1, le=LARGEST_CLASS_ID)]
    cityscapes: str | None = None


class LabelledObject(NamedTuple):
    """An object of a stage: a row of the table.

    Attributes
    ----------
    name
        Of its prim; a piece of an object has it after the object's and a slash, a point of an instancer its number in
        brackets after the instancer's.
    id
        Instance id from 1.
    class_id
        Id of its class.
    min_m, max_m
        (x, y, z) of the corners of its bounds in the world, for people and programs of their own.
    """

    name: str
    id: Annotated[int, Field(ge=1, le=LARGEST_ID)]
    class_id: int
    min_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None
    max_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None


class LabelTable(Record):
    """All classes, and all objects with a path and an id of their own.

    Attributes
    ----------
    classes_version
        Of the table of classes (`garage2usd.objects.CLASSES_VERSION`); tables of the first say none.
    classes
        The classes.
    columns
        What the columns of the rows are called.
    objects
        The rows of objects by the path of the prim that is their parent, which thousands of them have in common.
    parked
        Ids of each stall that a car stands in, and of that car.
    number_plates
        Ids of the plates of each car and of that car, and what is to be read on them.
    """

    classes_version: Annotated[int, Field(ge=1)] = 1
    classes: tuple[SemanticClass, ...]
    columns: tuple[Literal["name"], Literal["id"], Literal["class_id"], Literal["min_m"], Literal["max_m"]] = (
        "name",
        "id",
        "class_id",
        "min_m",
        "max_m",
    )
    objects: dict[str, tuple[LabelledObject, ...]]
    parked: tuple[tuple[int, int], ...] = ()
    number_plates: tuple[tuple[int, int, str], ...] = ()

    def by_path(self) -> Iterator[tuple[str, LabelledObject]]:
        """Path of each object's prim, and the object."""
        return ((f"{parent}/{row.name}", row) for parent, rows in self.objects.items() for row in rows)

    @model_validator(mode="after")
    def _agrees_with_itself(self) -> Self:
        classes = {entry.id for entry in self.classes}
        paths, ids = [], []
        for path, row in self.by_path():
            if row.class_id not in classes:
                raise ValueError(f"{path} is of the class {row.class_id}, which is not listed")
            paths.append(path)
            ids.append(row.id)
        for values in (paths, ids):
            if len(set(values)) < len(values):
                raise ValueError("a path or an id occurs twice")
        named = {
            "parked": {number for pair in self.parked for number in pair},
            "number_plates": {number for plates, car, _ in self.number_plates for number in (plates, car)},
        }
        for key, numbers in named.items():
            unknown = numbers.difference(ids)
            if unknown:
                raise ValueError(f"{key} names the id {min(unknown)}, which no object has")
        return self


def read_label_table(stage: Path) -> LabelTable | None:
    """Read the table beside a stage, ``garage_labels.json`` for ``garage.usdc``; None where there is none.

    Raises
    ------
    ConfigError
        If it cannot be read.
    StageError
        If it is not such a table; names the key, its value and what is allowed.
    """
    path = stage.with_name(f"{stage.stem}_labels.json")
    if not is_file(path):
        return None
    text = read_text(path, field="labels", max_bytes=_MAX_FILE_BYTES)
    try:
        return LabelTable.model_validate_json(text)
    except ValidationError as error:
        raise StageError(path, f"not a table of labels: {first_fault(error)}") from None
