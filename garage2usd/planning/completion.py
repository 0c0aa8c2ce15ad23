"""Directions and stalls for planned lanes, and the choice among the best lanes by the stalls that they hold."""

from collections.abc import Iterator
from dataclasses import replace

from garage2usd.config import GarageConfig
from garage2usd.config.plan import Choice
from garage2usd.garage import StallKind
from garage2usd.planning.circulation import circulation, rules_of
from garage2usd.planning.dimensions import dimensioned
from garage2usd.planning.orientation import with_directions
from garage2usd.planning.plan import Plan
from garage2usd.planning.score import evaluate
from garage2usd.planning.stall_kinds import floor_per_stall_m2, with_stall_kinds
from garage2usd.structure.grid import Cell

__all__ = ["completed"]

_FINALISTS = 12
"""Plans of the archive that are laid out with their stalls."""


def completed(plan: Plan, config: GarageConfig) -> Plan:
    """Give a plan of lanes its directions and stalls.

    Parameters
    ----------
    plan
        Lanes, with the archive of other plans if they were learnt.
    config
        Which directions and kinds are asked for.

    Returns
    -------
    Plan
        The lanes of the plan if all stalls are perpendicular and of the standard size, if lanes, runs or directions are
        given, and if the plan is to be drawn from the archive. Else the lanes, among the best of the archive that keep
        as many rules of circulation, with the least floor per stall, or with the best score where R and C are given.

    Raises
    ------
    ConfigError, GenerationError
        As `with_directions` and `with_stall_kinds`.

    Notes
    -----
    Lanes are learnt and polished for perpendicular stalls. The others are counted run by run, which no table of squares
    holds, so that the best lanes for them are found among the finalists.
    """
    first = with_stall_kinds(with_directions(plan, config), config)
    is_given = config.stalls.runs or config.plan.one_way or config.plan.choice is Choice.DRAW
    if not first.runs or is_given:
        return first
    decided = _decided(config, first)
    others = (with_stall_kinds(with_directions(lanes, config), decided) for lanes in _finalists(plan, config))
    return min([first, *others], key=lambda found: _rank(found, config))


def _finalists(plan: Plan, config: GarageConfig) -> Iterator[Plan]:
    """Yield the other lanes at the top of the archive, with the sides that the planner gives them."""
    cells = plan.structure.cells
    rules = rules_of(config.plan, squares=int(((cells == Cell.FREE) | (cells == Cell.LANE)).sum()))
    for entry in plan.archive[:_FINALISTS]:
        faults = circulation(entry.structure).faults(rules)
        if len(faults) > len(plan.gave_way) or (entry.structure.cells == cells).all():
            continue
        structure = dimensioned(entry.structure, config.bay)
        score = evaluate(structure, bay=config.bay, plan=config.plan)
        yield replace(plan, structure=structure, score=score, gave_way=faults)


def _decided(config: GarageConfig, plan: Plan) -> GarageConfig:
    """Return settings with the kind that was chosen for a plan, where kinds are free."""
    if not config.stalls.is_free:
        return config
    shape = plan.runs[0].shape
    angle_deg = shape.angle_deg if shape.kind is StallKind.ANGLED else None
    return config.model_copy(update={"stalls": config.stalls.of_kind(shape.kind, angle_deg)})


def _rank(plan: Plan, config: GarageConfig) -> tuple[int, float]:
    figure = floor_per_stall_m2(plan) if any(config.bay.chosen_sides) else -plan.score.value
    return len(plan.gave_way), figure
