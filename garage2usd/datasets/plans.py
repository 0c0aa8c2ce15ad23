"""Plans of a data set: drawn, compared up to symmetry, and redrawn if duplicate."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from garage2usd.common.errors import ConfigError, Garage2UsdError, MissingExtraError
from garage2usd.config import GarageConfig
from garage2usd.datasets.difficulty import GarageDifficulty, garage_difficulty, stall_difficulties
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.recipe import Distinct, Recipe
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.pipeline import generate, generate_plan
from garage2usd.planning import Plan, evaluate, read_tail, tail_of
from garage2usd.report import learning_figures
from garage2usd.site.levels import ramps_of_tape
from garage2usd.structure.grid import Structure
from garage2usd.structure.symmetry import levels_digest

Key = TypeVar("Key")

_CHUNK = 8
_SAME = 1e-9


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
        made = _plan_fields(config, recipe)
    except (OSError, MissingExtraError):  # a failure of the machine, not of this garage
        raise
    except Exception as error:  # noqa: BLE001 - one garage that fails does not end ten thousand
        return DrawnPlan(number=number, attempt=attempt, seed=seed, error=error_line(error))
    return DrawnPlan(number=number, attempt=attempt, seed=seed, alternatives=alternatives, **made)


def _plan_fields(config: GarageConfig, recipe: Recipe) -> dict[str, Any]:
    """Plan a garage; return the fields of its `DrawnPlan`."""
    if recipe.difficulty or config.building.levels > 1:  # routes over ramps and difficulty need the layout
        garage = generate(config)
        plans, level = garage.plans, rated(*garage.levels).level if recipe.difficulty else None
    else:
        garage, plans, level = None, (generate_plan(config),), None
    top, *lower = [plan.structure for plan in plans]
    fields = {
        **_sides(top),
        "rows": _rows(top),
        "lower": tuple(map(_rows, lower)),
        "digest": levels_digest([plan.structure.cells for plan in plans]),
        "level": level,
    }
    if garage is not None and lower:
        gave_way = {
            each.place.in_whole(rule, joint=" "): place
            for each in garage.levels
            for rule, place in each.plan.gave_way.items()
        }
        return fields | {"tape": garage.tape, "gave_way": gave_way}
    (plan,) = plans
    learning = learning_figures(plan, config)
    return fields | {"tail": tail_of(plan), "gave_way": dict(plan.gave_way), "learning": learning}


def _sides(structure: Structure) -> dict[str, tuple[int, ...]]:
    return {
        "column_widths_mm": tuple(structure.column_widths_mm.tolist()),
        "row_depths_mm": tuple(structure.row_depths_mm.tolist()),
    }


def _rows(structure: Structure) -> tuple[str, ...]:
    return tuple(str(structure).splitlines())


def rated(*levels: GarageLevel) -> GarageDifficulty:
    """Rate the difficulty of a garage by the stalls of its levels."""
    return garage_difficulty([stall for level in levels for stall in stall_difficulties(level)])


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


def remade(drawn: DrawnPlan, config: GarageConfig) -> Garage:
    """Make a drawn garage again: one level from its plan, several from their tape.

    Raises
    ------
    ConfigError
        If the tape does not give the plans of all levels, as of a damaged table.
    """
    if not drawn.tape:
        return generate(config, plan=replanned(drawn, config))
    garage = generate(config, tape=drawn.tape)
    made = garage.building.levels
    if [_rows(structure) for structure in made] != [drawn.rows, *drawn.lower] or made[0] != drawn.structure:
        raise ConfigError("tape", drawn.tape, f"that of the plans of garage {drawn.number}")
    return garage


def landings_of(drawn: DrawnPlan, recipe: Recipe) -> tuple[tuple[int, int], ...]:
    """Return (row, col) of the landings of the top level of a drawn garage; none of a garage of one level."""
    if not drawn.tape:
        return ()
    config, _ = recipe.drawn(drawn.seed, drawn.number)
    return tuple(link.head for link in ramps_of_tape(drawn.tape.partition("/")[0], config).links)


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
