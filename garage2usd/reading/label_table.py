"""The label table beside a stage, in JSON: the model shared by its writer and its readers."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, NamedTuple, Self

from pydantic import Field, FiniteFloat, ValidationError, model_validator

from garage2usd.common.documents import is_file, read_text
from garage2usd.common.errors import StageError
from garage2usd.common.settings import Record, first_fault

LARGEST_ID = 2**24 - 1
"""Greatest instance id: instance pictures have 24 bits."""
LARGEST_CLASS_ID = 255
"""Greatest class id: semantic pictures have 8 bits."""
_MAX_FILE_BYTES = 1024 * 1024 * 1024


class SemanticClass(Record):
    """A semantic class of objects: its name, its id from 1, and the nearest Cityscapes class, if known."""

    name: str
    id: Annotated[int, Field(ge=1, le=LARGEST_CLASS_ID)]
    cityscapes: str | None = None


class LabelledObject(NamedTuple):
    """An object of a stage: a row of the label table.

    Attributes
    ----------
    name
        Name of its prim. The name of an object's piece follows the object's name and a slash; the number of an
        instancer's point follows the instancer's name in brackets.
    id
        Instance id from 1.
    class_id
        Id of its class.
    min_m, max_m
        (x, y, z) of the corners of its bounding box in the world, for people and other programs.
    """

    name: str
    id: Annotated[int, Field(ge=1, le=LARGEST_ID)]
    class_id: int
    min_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None
    max_m: tuple[FiniteFloat, FiniteFloat, FiniteFloat] | None = None


class LabelTable(Record):
    """All semantic classes, and all objects with a path and an id of their own.

    Attributes
    ----------
    classes_version
        Version of the table of classes (`garage2usd.objects.CLASSES_VERSION`); tables of the first version have none.
    classes
        Semantic classes.
    columns
        Names of the columns of the rows.
    objects
        Rows of objects by the path of their parent prim.
    parked
        Ids of each stall with a car, and of that car.
    number_plates
        Ids of each car's plates and of the car, and the text on the plates.
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
        """Return each object by the path of its prim."""
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
    """Read the label table beside a stage, ``garage_labels.json`` for ``garage.usdc``; None without one.

    Raises
    ------
    ConfigError
        If the file cannot be read.
    StageError
        If the file is not a label table; names the key, its value and the allowed values.
    """
    path = stage.with_name(f"{stage.stem}_labels.json")
    if not is_file(path):
        return None
    text = read_text(path, field="labels", max_bytes=_MAX_FILE_BYTES)
    try:
        return LabelTable.model_validate_json(text)
    except ValidationError as error:
        raise StageError(path, f"not a table of labels: {first_fault(error)}") from None
