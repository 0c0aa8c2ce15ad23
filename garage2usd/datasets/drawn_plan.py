"""A drawn plan of a data set, with the kind of its contour, and the table of all drawn plans."""

import json
from collections.abc import Sequence
from enum import StrEnum
from itertools import pairwise

import numpy as np
import pyarrow as pa
import shapely
from pydantic import Field

from garage2usd.common.settings import Record
from garage2usd.datasets.difficulty import Level
from garage2usd.reading.report import LearningFigures
from garage2usd.structure.grid import CellArray, Mask, Structure, cells_from_text, outside_squares


class DrawnPlan(Record):
    """A drawn plan of a data set, or the reason for its failure.

    Attributes
    ----------
    number, attempt
        Number of the garage and number of its draw, both from 0.
    seed
        Seed of the garage, from which its settings are drawn.
    alternatives
        Name of the alternative of each group of the recipe.
    rows
        S with lanes, one string of symbols per row (see `garage2usd.structure.grid.Cell`), of the top level; empty if
        drawing failed.
    lower
        S of each level below the top one, likewise.
    column_widths_mm, row_depths_mm
        R and C in millimetres.
    tail
        Directions of aisles and kinds of stalls, as in the tape of a plan (`garage2usd.planning.tail_of`); empty if
        aisles are two-way and stalls of the usual kind.
    tape
        Tape of a garage of several levels: its ramps and the lanes of each level; empty for one level.
    digest
        Digest of S of all levels, equal for rotations and reflections (`garage2usd.structure.symmetry.levels_digest`).
    gave_way
        Required rules of circulation that the plan violates, with their places; on all levels.
    learning
        Result of learning, before hill climbing; None for several levels.
    level
        Difficulty of the garage; None if the recipe does not control levels.
    error
        Reason for the failure; empty if the garage was planned.
    """

    number: int
    attempt: int
    seed: int
    alternatives: dict[str, str] = Field(default_factory=dict)
    rows: tuple[str, ...] = ()
    lower: tuple[tuple[str, ...], ...] = ()
    column_widths_mm: tuple[int, ...] = ()
    row_depths_mm: tuple[int, ...] = ()
    tail: str = ""
    tape: str = ""
    digest: str = ""
    gave_way: dict[str, str] = Field(default_factory=dict)
    learning: LearningFigures | None = None
    level: Level | None = None
    error: str = ""

    @property
    def structure(self) -> Structure:
        """The structure of the plan, or of the top level: S, R and C."""
        return Structure(_cells(self.rows), np.array(self.column_widths_mm), np.array(self.row_depths_mm))

    def levels_cells(self) -> tuple[CellArray, ...]:
        """Return S of each level, the top one first."""
        return tuple(_cells(rows) for rows in (self.rows, *self.lower))


_SCHEMA = pa.schema(
    [
        pa.field("number", pa.int64(), nullable=False),
        pa.field("attempt", pa.int32(), nullable=False),
        pa.field("seed", pa.int64(), nullable=False),
        pa.field("alternatives", pa.map_(pa.string(), pa.string()), nullable=False),
        pa.field("rows", pa.list_(pa.string()), nullable=False),
        pa.field("lower", pa.list_(pa.list_(pa.string())), nullable=False),
        pa.field("column_widths_mm", pa.list_(pa.int32()), nullable=False),
        pa.field("row_depths_mm", pa.list_(pa.int32()), nullable=False),
        pa.field("tail", pa.string(), nullable=False),
        pa.field("tape", pa.string(), nullable=False),
        pa.field("digest", pa.string(), nullable=False),
        pa.field("gave_way", pa.map_(pa.string(), pa.string()), nullable=False),
        pa.field("learning", pa.string(), nullable=False),
        pa.field("level", pa.string(), nullable=True),
        pa.field("error", pa.string(), nullable=False),
    ]
)

_OF_SOME = ("lower", "tail", "tape")
"""Columns that many data sets do without."""


def plan_table(plans: Sequence[DrawnPlan]) -> pa.Table:
    """Convert plans to a table, the inverse of `plans_of`; results of learning are JSON.

    The columns ``lower``, ``tail`` and ``tape`` are left out where no plan has them.
    """
    schema = _SCHEMA
    for column in _OF_SOME:
        if not any(getattr(drawn, column) for drawn in plans):
            schema = schema.remove(schema.get_field_index(column))
    rows = []
    for drawn in plans:
        row = drawn.model_dump(mode="json")
        for name in ("alternatives", "gave_way"):
            row[name] = sorted(row[name].items())
        row["learning"] = "" if drawn.learning is None else drawn.learning.model_dump_json()
        rows.append(row)
    return pa.Table.from_pylist(rows, schema=schema)


def plans_of(table: pa.Table) -> list[DrawnPlan]:
    """Convert a table to plans."""
    plans = []
    for row in table.to_pylist():
        for name in ("alternatives", "gave_way"):
            row[name] = dict(row[name])
        row["learning"] = json.loads(row["learning"]) if row["learning"] else None
        plans.append(DrawnPlan.model_validate(row))
    return plans


def _cells(rows: Sequence[str]) -> CellArray:
    return cells_from_text("\n".join(rows), field="S")


class ContourShape(StrEnum):
    """Shape of a garage's contour, independent of rotation and reflection."""

    RECTANGLE = "rectangle"
    L = "L"
    T = "T"
    U = "U"
    OTHER = "other"


_SHAPE_OF = {
    "1111": ContourShape.RECTANGLE,
    "011111": ContourShape.L,
    "01101111": ContourShape.T,
    "00111111": ContourShape.U,
}
"""Contour shapes by their sequence of corners, 1 convex and 0 reflex, rotated to the least numeral."""


def contour_shape(cells: CellArray) -> ContourShape:
    """Classify the contour of a garage by the sequence of its corners.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Notes
    -----
    A rectangle has four convex corners; an L has one reflex corner in addition. The two reflex corners of a U are
    adjacent, at the bottom of its recess. Those of a T have the two corners of its stem between them. Every other
    shape, such as a step or a Z, is other. The contour is that of squares, not metres; obstacles inside are ignored.
    """
    return _SHAPE_OF.get(_least_turned(_corners(~outside_squares(cells))), ContourShape.OTHER)


def _corners(is_inside: Mask) -> str:
    """Return the corners of an outline in order, as in `_SHAPE_OF`; empty unless the outline is a single ring."""
    rows, cols = np.nonzero(is_inside)
    ground = shapely.union_all(shapely.box(cols, rows, cols + 1, rows + 1))
    if not isinstance(ground, shapely.Polygon) or ground.is_empty or ground.interiors:
        return ""
    ring = [*shapely.orient_polygons(ground).exterior.coords]
    steps = [(x - before_x, y - before_y) for (before_x, before_y), (x, y) in pairwise([*ring, ring[1]])]
    turns = [x * next_y - y * next_x for (x, y), (next_x, next_y) in pairwise(steps)]
    return "".join(str(int(turn > 0)) for turn in turns if turn)


def _least_turned(corners: str) -> str:
    """Rotate and reflect a sequence of corners to its least numeral."""
    both = (corners, corners[::-1])
    return min((way[start:] + way[:start] for way in both for start in range(len(way))), default="")
