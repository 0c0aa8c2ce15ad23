"""The table of labels beside a stage, JSON: the model that its writer and all who read it share."""

from pathlib import Path
from typing import Annotated, Self

from pydantic import Field, ValidationError, model_validator

from garage2usd.documents import is_file, read_bytes
from garage2usd.errors import StageError
from garage2usd.settings import Record, first_fault

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


class LabelledObject(Record):
    """An object of a stage.

    Attributes
    ----------
    path
        Of its prim; a point of an instancer has its number in brackets after the instancer's path.
    id
        Instance id from 1.
    class_name
        Name of its class, ``class`` in the file.
    min_m, max_m
        (x, y, z) of the corners of its bounds in the world, for people and programs of their own.
    """

    path: str
    id: Annotated[int, Field(ge=1, le=LARGEST_ID)]
    class_name: Annotated[str, Field(alias="class")]
    min_m: tuple[float, float, float] | None = None
    max_m: tuple[float, float, float] | None = None


class LabelTable(Record):
    """All classes, and all objects with a path and an id of their own."""

    classes: tuple[SemanticClass, ...]
    objects: tuple[LabelledObject, ...]

    @model_validator(mode="after")
    def _agrees_with_itself(self) -> Self:
        names = {entry.name for entry in self.classes}
        for entry in self.objects:
            if entry.class_name not in names:
                raise ValueError(f"{entry.path} is of the class {entry.class_name!r}, which is not listed")
        for values in ({entry.path for entry in self.objects}, {entry.id for entry in self.objects}):
            if len(values) < len(self.objects):
                raise ValueError("a path or an id occurs twice")
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
    text = read_bytes(path, field="labels", max_bytes=_MAX_FILE_BYTES)
    try:
        return LabelTable.model_validate_json(text)
    except ValidationError as error:
        raise StageError(path, f"not a table of labels: {first_fault(error)}") from None
