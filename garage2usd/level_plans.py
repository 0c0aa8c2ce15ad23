"""Plans of the levels of a garage: lanes, directions and kinds of stalls, on R and C that all levels share.

The ramps are drawn first, from a random stream of their own. Each level is then planned by the planner of one level,
with the landings as its portals; the levels below take over R and C of the top one.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.common.processes import run_in_forks
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.common.randomness import Step, derived_seed
from garage2usd.config import BayConfig, GarageConfig
from garage2usd.config.site import BuildingConfig
from garage2usd.garage_model import TAPE_JOINT
from garage2usd.planning import (
    Plan,
    alternatives,
    completed,
    evaluate,
    given_plan,
    is_of_lanes_alone,
    plan_lanes,
    play_plan,
)
from garage2usd.planning.dimensions import aisle_side_mm, lines_with_aisles
from garage2usd.planning.stall_kinds import no_stalls
from garage2usd.site.levels import (
    LevelSites,
    make_level_sites,
    make_street_site,
    ramps_are_free,
    ramps_of_tape,
    with_ramps_room,
)
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneSquares, build_lane_graph
from garage2usd.structure.stalls import square_capacity

ATTEMPTS = 4
"""Most places of the ramps that are tried until cars reach every stall: some leave no room to turn before a ramp."""


class PlannedLevel(NamedTuple):
    """The plan of a level, the site that it was planned on, and the settings of this level alone."""

    plan: Plan
    site: Structure
    config: GarageConfig


def sites_and_tapes(config: GarageConfig, tape: str | None, attempt: int) -> tuple[LevelSites, list[str | None]]:
    """Make the sites of all levels, and split a tape into the tapes of the levels.

    Ramps are read from the tape, or drawn, in each attempt at another place. Errors as for `generate`.
    """
    levels = config.building.levels
    if tape is None or levels == 1:
        return make_level_sites(config, attempt), [tape] * levels
    street = make_street_site(config)
    links, *tapes = tape.split(TAPE_JOINT)
    wanted = f"the tape of {config.building.ramps} ramps and the tapes of {levels} levels, joined by {TAPE_JOINT}"
    try:
        ramps = ramps_of_tape(links, config)
    except (ValueError, KeyError):
        raise ConfigError("tape", tape, wanted) from None
    if len(tapes) != levels or not ramps_are_free(street.cells, ramps, levels):
        raise ConfigError("tape", tape, f"{wanted}, on free squares of the site")
    return LevelSites(street, ramps, levels), list(tapes)


def sites_of_plans(config: GarageConfig, plans: Sequence[Plan]) -> LevelSites:
    """Make the sites of given plans, with the ramps at the places that the plans have.

    Raises
    ------
    ConfigError
        If the plans are not those of all levels of such a garage.
    """
    levels = config.building.levels
    if len(plans) != levels:
        raise ConfigError("plan", f"{len(plans)} plans", f"{levels}, one for each level")
    for attempt in range(ATTEMPTS):
        try:
            sites = make_level_sites(config, attempt)
        except GenerationError:
            if not attempt:
                raise
            break
        if sites.ramps is None or all(_is_on(plan, sites, level) for level, plan in enumerate(plans)):
            return sites
    raise ConfigError("plan", str(plans[0].structure), "plans made with these settings and this seed")


def plan_levels(
    sites: LevelSites,
    config: GarageConfig,
    tapes: Sequence[str | None],
    *,
    given: Sequence[Plan] = (),
    jobs: int = 1,
    progress: Progress = silent,
) -> list[PlannedLevel]:
    """Plan all levels, the lower ones on R and C of the top one.

    Parameters
    ----------
    sites, tapes
        As from `sites_and_tapes`.
    config
        The settings of the garage.
    given
        Existing plans of all levels, if any.
    jobs
        Maximum number of levels that are planned at a time. The plans do not depend on it.
    progress
        Called with the progress of long steps.

    Notes
    -----
    If R and C are chosen, a row or column of squares along which only a lower level has an aisle is widened on all
    levels.
    """

    def level(number: int, on: Structure, bay: BayConfig, told: Progress = progress) -> PlannedLevel:
        static, of_level = on.with_cells(sites.cells(number)), config
        if sites.ramps is not None:
            seed = derived_seed(config.seed, Step.LEVELS, number) if number else config.seed
            changes = {"seed": seed, "building": BuildingConfig(), "bay": bay}
            of_level = config.model_copy(update=changes)
        if given:
            return PlannedLevel(given[number], static, of_level)
        top = on if number else None
        plan = _planned(static, of_level, tape=tapes[number], top=top, bay=config.bay, progress=told)
        return PlannedLevel(plan, static, of_level)

    top = level(0, sites.street, config.bay)
    if sites.ramps is None:
        return [top]
    bay, told = _fixed(config.bay, top.plan.structure), silent if jobs > 1 else progress
    lower = [partial(level, number, top.plan.structure, bay, told) for number in range(1, sites.count)]
    made = run_in_forks(lower, jobs)
    found = [top, *(counted("levels", made, len(lower), progress) if jobs > 1 else made)]
    sides = with_ramps_room(
        _with_aisles([planned.plan.structure for planned in found], config.bay), sites.ramps, config
    )
    bay = _fixed(bay, sides)
    return [
        PlannedLevel(_on_sides(plan, sides, bay, config), static, of_level.model_copy(update={"bay": bay}))
        for plan, static, of_level in found
    ]


def lane_squares_of(plan: Plan, config: GarageConfig) -> LaneSquares:
    """Return the lanes and rows of stalls of a plan. Errors as for `garage2usd.generate`."""
    graph = build_lane_graph(plan.structure, config.bay, plan.runs, plan.directions)
    if not graph.stall_rows:
        raise no_stalls(plan, config)
    return graph


def _planned(
    site: Structure,
    config: GarageConfig,
    *,
    tape: str | None,
    top: Structure | None,
    bay: BayConfig,
    progress: Progress,
) -> Plan:
    """Plan the lanes of a site, their directions and the kinds of stalls.

    Given ones are taken, a tape is replayed, and the others are learnt and drawn. Below a top level, the lanes are
    those of the archive that suit its sides of squares best, as far as `bay` leaves them to be chosen.
    """
    has_lanes = bool((site.cells == Cell.LANE).any())
    if tape is not None:
        if has_lanes:
            raise ConfigError("tape", tape, "no tape beside a structure that has lanes")
        played = play_plan(site, tape, config)
        return completed(played, config) if is_of_lanes_alone(tape) else played
    if has_lanes:
        return completed(given_plan(site, bay=config.bay, plan=config.plan), config)
    plan = plan_lanes(site, plan=config.plan, bay=config.bay, seed=config.seed, start=top, progress=progress)
    if top is not None and any(bay.chosen_sides):
        plan = min(alternatives(plan, config), key=lambda found: _floor_per_stall_m2([top, found.structure], bay))
    return completed(plan, config)


def _floor_per_stall_m2(levels: list[Structure], bay: BayConfig) -> float:
    """Floor of levels over their perpendicular stalls, with the sides of squares that the aisles of all need."""
    sides = _with_aisles(levels, bay)
    sized = [sides.with_cells(level.cells) for level in levels]
    stalls = sum(int(square_capacity(level, bay).sum()) for level in sized)
    return sum(level.floor_m2 for level in sized) / stalls if stalls else math.inf


def _is_on(plan: Plan, sites: LevelSites, level: int) -> bool:
    """Return True if a plan has the same obstacles, ramps and portals as the site of a level."""
    cells, static = plan.structure.cells, sites.cells(level)
    return bool(cells.shape == static.shape and (np.where(cells == Cell.LANE, Cell.FREE, cells) == static).all())


def _with_aisles(levels: list[Structure], bay: BayConfig) -> Structure:
    """Widen the rows and columns of squares of the top level for the aisles of all levels, where R and C are chosen."""
    top = levels[0]
    sides = [top.row_depths_mm.copy(), top.column_widths_mm.copy()]
    for level in levels[1:]:
        for axis, (is_chosen, are_aisles) in enumerate(zip(bay.chosen_sides, lines_with_aisles(level), strict=True)):
            if is_chosen:
                sides[axis][are_aisles] = np.maximum(sides[axis][are_aisles], aisle_side_mm(bay))
    return Structure(top.cells, sides[1], sides[0])


def _on_sides(plan: Plan, sides: Structure, bay: BayConfig, config: GarageConfig) -> Plan:
    """Return a plan with R and C of another structure."""
    structure = sides.with_cells(plan.structure.cells)
    if structure == plan.structure:
        return plan
    return replace(plan, structure=structure, score=evaluate(structure, bay=bay, plan=config.plan))


def _fixed(bay: BayConfig, structure: Structure) -> BayConfig:
    """Return the settings with R and C of the top level."""
    sides = {
        "column_widths_m": tuple((structure.column_widths_mm / 1000).tolist()),
        "row_depths_m": tuple((structure.row_depths_mm / 1000).tolist()),
    }
    return bay.model_copy(update=sides)
