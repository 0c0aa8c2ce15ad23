"""Plans of a data set: drawn, compared up to symmetry, and redrawn if duplicate."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

import numpy as np
import pyarrow as pa
from pydantic import Field

from garage2usd.common.errors import ConfigError, Garage2UsdError, MissingExtraError
from garage2usd.common.settings import Record
from garage2usd.config import GarageConfig
from garage2usd.datasets.difficulty import Level, garage_difficulty, stall_difficulties
from garage2usd.datasets.recipe import Distinct, Recipe
from garage2usd.pipeline import generate, generate_plan
from garage2usd.planning import Plan, evaluate, read_tail, tail_of
from garage2usd.reading.report import LearningFigures
from garage2usd.report import learning_figures
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.symmetry import plan_digest

__all__ = [
    "DrawnPlan",
    "PlanDraw",
    "chunks",
    "error_line",
    "plan_table",
    "planned",
    "plans_of",
    "proportional",
    "replanned",
]

Key = TypeVar("Key")

_CHUNK = 8
_SAME = 1e-9


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
        S with lanes, one string of symbols per row (see `garage2usd.structure.grid.Cell`); empty if drawing failed.
    column_widths_mm, row_depths_mm
        R and C in millimetres.
    tail
        Directions of aisles and kinds of stalls, as in the tape of a plan (`garage2usd.planning.tail_of`); empty if
        aisles are two-way and stalls of the usual kind.
    digest
        Digest of S, equal for rotations and reflections (`garage2usd.structure.symmetry.plan_digest`).
    gave_way
        Required rules of circulation that the plan violates, with their places.
    learning
        Result of learning, before hill climbing.
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
    column_widths_mm: tuple[int, ...] = ()
    row_depths_mm: tuple[int, ...] = ()
    tail: str = ""
    digest: str = ""
    gave_way: dict[str, str] = Field(default_factory=dict)
    learning: LearningFigures | None = None
    level: Level | None = None
    error: str = ""

    @property
    def structure(self) -> Structure:
        """The structure of the plan: S, R and C."""
        cells = cells_from_text("\n".join(self.rows), field="S")
        return Structure(cells, np.array(self.column_widths_mm), np.array(self.row_depths_mm))


def planned(recipe: Recipe, requests: Sequence[tuple[int, int]]) -> list[DrawnPlan]:
    """Draw the settings of garages and plan their lanes.

    Parameters
    ----------
    recipe
        The recipe.
    requests
        (number, attempt) of each garage to draw.
    """
    return [_planned(recipe, number, attempt) for number, attempt in requests]


def _planned(recipe: Recipe, number: int, attempt: int) -> DrawnPlan:
    seed = recipe.garage_seed(number, attempt)
    try:
        config, alternatives = recipe.drawn(seed, number)
        plan = generate_plan(config)
        level = _level(config, plan) if recipe.difficulty else None
    except (OSError, MissingExtraError):  # a failure of the machine, not of this garage
        raise
    except Exception as error:  # noqa: BLE001 - one garage that fails does not end ten thousand
        return DrawnPlan(number=number, attempt=attempt, seed=seed, error=error_line(error))
    structure = plan.structure
    return DrawnPlan(
        number=number,
        attempt=attempt,
        seed=seed,
        alternatives=alternatives,
        rows=tuple(str(structure).splitlines()),
        column_widths_mm=tuple(structure.column_widths_mm.tolist()),
        row_depths_mm=tuple(structure.row_depths_mm.tolist()),
        tail=tail_of(plan),
        digest=plan_digest(structure.cells),
        gave_way=dict(plan.gave_way),
        learning=learning_figures(plan, config),
        level=level,
    )


def _level(config: GarageConfig, plan: Plan) -> Level | None:
    return garage_difficulty(stall_difficulties(generate(config, plan=plan))).level


def error_line(error: Exception) -> str:
    """Format an error in one line."""
    text = " ".join(str(error).split())
    return text if isinstance(error, Garage2UsdError) else f"{type(error).__name__}: {text}"


def replanned(drawn: DrawnPlan, config: GarageConfig) -> Plan:
    """Replan a drawn garage, without the intermediate plans of learning."""
    structure = drawn.structure
    directions, runs = read_tail(structure, drawn.tail, config)
    score = evaluate(structure, bay=config.bay, plan=config.plan, runs=runs)
    return Plan(structure, score, gave_way=drawn.gave_way, runs=runs, directions=directions)


class PlanDraw:
    """Selection of distinct plans: each garage is redrawn until its plan differs from all earlier ones.

    If two garages draw the same plan at the same attempt, the one with the lower number keeps it. A plan accepted at an
    earlier attempt is kept. The result is therefore independent of the order in which plans are made.

    Parameters
    ----------
    recipe
        The recipe.
    known
        Plans drawn before, in an interrupted run.
    """

    def __init__(self, recipe: Recipe, known: Iterable[DrawnPlan] = ()) -> None:
        self._recipe = recipe
        self._found = {(drawn.number, drawn.attempt): drawn for drawn in known}
        self._taken: dict[int, DrawnPlan] = {}
        self._digests: set[str] = set()
        self._pending = list(range(recipe.count))
        self._room = proportional(recipe.difficulty, recipe.count)
        self._attempt = 0

    def add(self, drawn: Iterable[DrawnPlan]) -> None:
        """Add drawn plans."""
        self._found.update(((each.number, each.attempt), each) for each in drawn)

    def missing(self) -> list[tuple[int, int]]:
        """Return the (number, attempt) pairs to draw next; empty if every garage has a plan or no attempts left.

        Raises
        ------
        ConfigError
            If every garage is infeasible.
        """
        while self._pending and self._attempt < self._recipe.attempts:
            requests = [(number, self._attempt) for number in self._pending]
            missing = [each for each in requests if each not in self._found]
            if missing:
                return missing
            self._pending = [number for number, attempt in requests if not self._takes(self._found[number, attempt])]
            self._attempt += 1
        missing_levels = {level: count for level, count in self._room.items() if count}
        if missing_levels and any(not self._found[number, self._attempt - 1].error for number in self._pending):
            wanted = proportional(self._recipe.difficulty, self._recipe.count)
            said = ", ".join(f"{count} of {wanted[level]} {level}" for level, count in missing_levels.items())
            allowed = f"shares that its garages reach in {self._recipe.attempts} attempts each; not found were {said}"
            raise ConfigError("difficulty", dict(self._recipe.difficulty), allowed)
        if not self._taken:
            raise ConfigError(
                "garage", self._why(0), f"settings by which one of {self._recipe.count} garages is possible"
            )
        return []

    def plans(self) -> list[DrawnPlan]:
        """Return one plan for each garage, by number; with an error if its attempts are exhausted."""
        return [
            self._taken.get(number)
            or DrawnPlan(
                number=number,
                attempt=self._recipe.attempts - 1,
                seed=self._recipe.garage_seed(number, self._recipe.attempts - 1),
                error=f"{self._why(number)} ({self._recipe.attempts} attempts)",
            )
            for number in range(self._recipe.count)
        ]

    def _takes(self, drawn: DrawnPlan) -> bool:
        is_there = self._recipe.distinct is Distinct.PLAN and drawn.digest in self._digests
        if drawn.error or is_there:
            return False
        if self._room:
            if drawn.level is None or not self._room.get(drawn.level):
                return False
            self._room[drawn.level] -= 1
        self._taken[drawn.number] = drawn
        self._digests.add(drawn.digest)
        return True

    def _why(self, number: int) -> str:
        """Return the error of a garage's last attempt."""
        return self._found[number, self._recipe.attempts - 1].error or "its plans are those of other garages"


def proportional(ratios: Mapping[Key, float], total: int) -> dict[Key, int]:
    """Apportion a total to integer shares by ratios, by the method of largest remainders (Hamilton)."""
    if not ratios:
        return {}
    shares = np.array(list(ratios.values())) / sum(ratios.values()) * total
    counts = np.floor(shares + _SAME).astype(np.int64)
    left = np.argsort(-(shares - counts), kind="stable")[: total - int(counts.sum())]
    counts[left] += 1
    return dict(zip(ratios, counts.tolist(), strict=True))


def chunks(requests: Sequence[tuple[int, int]]) -> list[Sequence[tuple[int, int]]]:
    """Split requests for plans into tasks of some seconds, so that a lost worker costs little."""
    return [requests[first : first + _CHUNK] for first in range(0, len(requests), _CHUNK)]


_SCHEMA = pa.schema(
    [
        pa.field("number", pa.int64(), nullable=False),
        pa.field("attempt", pa.int32(), nullable=False),
        pa.field("seed", pa.int64(), nullable=False),
        pa.field("alternatives", pa.map_(pa.string(), pa.string()), nullable=False),
        pa.field("rows", pa.list_(pa.string()), nullable=False),
        pa.field("column_widths_mm", pa.list_(pa.int32()), nullable=False),
        pa.field("row_depths_mm", pa.list_(pa.int32()), nullable=False),
        pa.field("tail", pa.string(), nullable=False),
        pa.field("digest", pa.string(), nullable=False),
        pa.field("gave_way", pa.map_(pa.string(), pa.string()), nullable=False),
        pa.field("learning", pa.string(), nullable=False),
        pa.field("level", pa.string(), nullable=True),
        pa.field("error", pa.string(), nullable=False),
    ]
)


def plan_table(plans: Sequence[DrawnPlan]) -> pa.Table:
    """Convert plans to a table, the inverse of `plans_of`; results of learning are JSON.

    The column ``tail`` is left out where no plan has one.
    """
    schema = _SCHEMA if any(drawn.tail for drawn in plans) else _SCHEMA.remove(_SCHEMA.get_field_index("tail"))
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
