"""Selected garages of a recipe by number, from its data set or drawn anew."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from garage2usd.common.errors import ConfigError
from garage2usd.contact_sheet import SheetGarage
from garage2usd.datasets.drawn_plan import DrawnPlan, plans_of
from garage2usd.datasets.making import PLAN_FILE
from garage2usd.datasets.plans import planned, replanned
from garage2usd.datasets.recipe import RECIPE_FILE, Recipe, load_recipe


def chosen_garages(path: Path, numbers: Sequence[int]) -> Iterator[SheetGarage]:
    """Yield selected garages of a recipe, each as soon as it is planned.

    Parameters
    ----------
    path
        The recipe. For a data set's own ``recipe.json``, the plans are read from the data set. For any other recipe
        each garage is drawn until it is feasible; a data set redraws it if its plan is a duplicate.
    numbers
        Numbers of the garages, from 0.

    Raises
    ------
    ConfigError
        If the recipe is invalid, has no garage with one of the numbers, or one of them is infeasible.
    """
    recipe = load_recipe(path)
    plans = path.with_name(PLAN_FILE)
    made = plans_of(_table(plans)) if path.name == RECIPE_FILE and plans.is_file() else None
    for number in numbers:
        if made is not None and number >= len(made):
            raise ConfigError("seeds", number, f"numbers of garages of the data set: 0 to {len(made) - 1}")
        drawn = _drawn(recipe, number) if made is None else made[number]
        if drawn.error:
            raise ConfigError("seeds", number, f"a garage that is possible ({drawn.error})")
        config, _ = recipe.drawn(drawn.seed, drawn.number)
        plan = None if drawn.tape else replanned(drawn, config)
        yield SheetGarage(f"garage {number}", config, plan, drawn.tape or None)


def _drawn(recipe: Recipe, number: int) -> DrawnPlan:
    """Draw the first feasible plan of a garage, or the last attempt if none is feasible."""
    for attempt in range(recipe.attempts):
        (drawn,) = planned(recipe, [(number, attempt)])
        if not drawn.error:
            break
    return drawn


def _table(path: Path) -> pa.Table:
    try:
        return pq.read_table(path)
    except (OSError, pa.ArrowException) as error:
        raise ConfigError("CONFIG", str(path), f"the plans of a data set ({error})") from None
