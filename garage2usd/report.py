"""Writing of the JSON report of a build, whose model is in `garage2usd.reading.report`."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.common.json_text import json_text
from garage2usd.common.settings import Record
from garage2usd.common.version import VERSION
from garage2usd.config import GarageConfig
from garage2usd.garage import Stall
from garage2usd.layout import Layout
from garage2usd.layout.egress.compartments import compartment_name
from garage2usd.layout.floor_area import FloorArea
from garage2usd.planning import (
    Plan,
    area_per_stall_m2,
    dimensioned,
    driven_lengths,
    evaluate,
    measured_circulation,
    neither_share,
    plan_tape_of,
    principles,
    rank_of,
    settings_of_runs,
)
from garage2usd.planning.circulation import rules_of
from garage2usd.reading.report import (
    CirculationFigures,
    DirectionFigures,
    FireCompartment,
    LearningFigures,
    PlanFigures,
    Report,
    ReportedStall,
    StairCore,
    UnmetClause,
)
from garage2usd.structure.grid import Cell, Structure

__all__ = ["area_figures", "learning_figures", "make_report", "write_report"]

_CURVE_POINTS, _RETURN_DECIMALS = 500, 1
"""Points of the learning curve, each the mean of ten of 5000 episodes (the whole curve would be half of a report), and
decimals of returns, since neighbouring points differ by about ten."""
_DECIMALS = 6
"""Decimals of metres and radians in stalls."""


def write_report(path: Path, report: Record) -> None:
    """Write a report as JSON: that of a garage of one level, or of several."""
    path.write_text(json_text(report.model_dump(mode="json")), encoding="utf-8", newline="\n")


def area_figures(layouts: Sequence[Layout]) -> dict[str, float | None]:
    """Return the floor of all levels for each stall that cars park in, net and gross; null without any stall."""
    stalls = sum(layout.parking_stalls for layout in layouts)
    net_m2, gross_m2 = map(math.fsum, zip(*(layout.area for layout in layouts), strict=True))
    net_m2, gross_m2 = FloorArea(net_m2, gross_m2).per_stall(stalls)
    return {
        "area_per_stall_m2": round(net_m2, 3) if stalls else None,
        "gross_area_per_stall_m2": round(gross_m2, 3) if stalls else None,
    }


def make_report(
    *,
    config: GarageConfig,
    plan: Plan,
    layout: Layout,
    seconds: Mapping[str, float],
    learning: LearningFigures | None = None,
    unmet: Sequence[UnmetClause] | None = None,
) -> Report:
    """Make the report of a garage; it is reproducible, except for ``seconds``.

    Parameters
    ----------
    config, plan, layout
        The garage.
    seconds
        Duration of each step in seconds.
    learning
        Results of learning, for a plan without its archive.
    unmet
        Clauses of the profile that the design violates; None if unknown.

    Notes
    -----
    ``tape`` and ``rank`` are null if no single drive of an agent makes the lanes (see `garage2usd.planning.tape`); the
    rank is a hexadecimal number of any length. ``polish_gain`` is the gain of hill climbing over the best y' of
    learning. ``S`` is a list of rows of symbols (see `garage2usd.structure.grid.Cell`), ``R`` and ``C`` are metres by
    column and by row, stall centres are (x, z) in metres.
    """
    structure = plan.structure
    tape = _tape(plan)
    return Report(
        version=VERSION,
        seed=config.seed,
        config_digest=config.digest(),
        structure_digest=structure.digest(),
        config=config,
        look=layout.look,
        tape=tape,
        rank=None if tape is None else hex(rank_of(tape)),
        S=tuple(str(structure).splitlines()),
        R=tuple(structure.R[0].tolist()),
        C=tuple(structure.C[:, 0].tolist()),
        one_way=tuple((stretch[0], stretch[1]) for stretch in plan.one_way_stretches),
        directions=_directions(plan, config),
        stall_runs=settings_of_runs(plan.runs, plan.directions),
        score=plan.score,
        learning=learning or learning_figures(plan, config),
        principles=principles(structure, bay=config.bay),
        circulation=_circulation(structure, config),
        **area_figures([layout]),
        parking_stalls=layout.parking_stalls,
        stall_uses={str(use): count for use, count in sorted(Counter(s.use for s in layout.quads).items())},
        illuminance=layout.illuminance,
        not_designed_to=None if unmet is None else tuple(unmet),
        remarks=config.remarks(),
        lane_kinds=layout.source.kinds_of_squares(),
        object_counts=layout.counts(),
        columns_at_mouths=layout.columns_at_mouths() if config.bay.column_setback_m else None,
        unreachable_stalls=tuple(sorted(layout.unreachable)),
        undecided_stalls=tuple(sorted(layout.undecided)),
        stair_cores=tuple(
            StairCore(square=core.square, door_m=core.door_m, in_place_of=core.stalls) for core in layout.cores
        ),
        fire_compartments=_compartments(layout),
        stalls=tuple(
            _reported(stall, squares[stall.access])
            for squares in [layout.node_squares().tolist()]
            for stall in layout.quads
        ),
        learning_curve=_mean_returns(plan),
        seconds={step: round(value, 4) for step, value in seconds.items()},
    )


def _reported(stall: Stall, access_square: tuple[int, int]) -> ReportedStall:
    """Record of a stall, with the squares that identify it and its lane in files."""
    facts, (x, z) = dict(stall.facts), stall.centre
    return ReportedStall(
        name=stall.name,
        number=str(stall.number or ""),
        type=str(facts["type"]),
        use=stall.use,
        square=(int(facts["row"]), int(facts["column"])),
        access_square=access_square,
        centre_m=(round(x, _DECIMALS), round(z, _DECIMALS)),
        yaw_rad=round(stall.yaw_rad, _DECIMALS),
        width_m=round(stall.width_m, _DECIMALS),
        length_m=round(stall.length_m, _DECIMALS),
        kind=stall.kind,
        angle_rad=round(math.radians(stall.slant_deg), _DECIMALS),
        size=stall.size,
        occupied=stall.is_occupied,
        blocked_by=stall.blocked_by,
    )


def _mean_returns(plan: Plan) -> tuple[float, ...]:
    """Learning curve as means over groups of nearly equal size, at most `_CURVE_POINTS` of them."""
    returns = plan.learning_curve
    parts = np.array_split(returns, max(1, min(len(returns), _CURVE_POINTS)))
    return tuple(round(float(part.mean()), _RETURN_DECIMALS) for part in parts if len(part))


def learning_figures(plan: Plan, config: GarageConfig) -> LearningFigures | None:
    """Return the results of learning alone and the gain by hill climbing; None if nothing was learned."""
    if plan.learnt is None:
        return None
    found = dimensioned(plan.learnt.structure, config.bay)
    score = evaluate(found, bay=config.bay, plan=config.plan)
    area_m2 = round(area_per_stall_m2(found, config.bay), 3)
    return LearningFigures(
        learnt=PlanFigures(value=score.value, stalls=score.stalls, area_per_planned_stall_m2=area_m2),
        polish=PlanFigures(
            value=plan.score.value - score.value,
            stalls=plan.score.stalls - score.stalls,
            area_per_planned_stall_m2=round(area_per_stall_m2(plan.structure, config.bay) - area_m2, 3),
        ),
        episodes=len(plan.learning_curve),
        steps=plan.steps,
    )


def _compartments(layout: Layout) -> tuple[FireCompartment, ...]:
    structure, numbers = layout.structure, layout.compartments
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / 1e6
    squares = [(fact["row"], fact["column"]) for fact in (dict(s.facts) for s in layout.quads if s.takes_cars)]
    on = numbers[tuple(np.array(squares, dtype=np.intp).reshape(-1, 2).T)]
    doors = Counter(int(numbers[core.lane]) for core in layout.cores)
    return tuple(
        FireCompartment(
            name=compartment_name(number),
            area_m2=round(float(areas[numbers == number].sum()), 2),
            stalls=int((on == number).sum()),
            stair_cores=doors[number],
        )
        for number in range(1, int(numbers.max(initial=0)) + 1)
    )


def _directions(plan: Plan, config: GarageConfig) -> DirectionFigures | None:
    """Figures of one-way aisles; None if there are none."""
    one_way, every = plan.one_way_stretches, plan.stretches
    if not one_way:
        return None
    lengths = driven_lengths(plan, config, plan.directions)
    steps = [sum(len(stretch) - 1 for stretch in stretches) for stretches in (one_way, every)]
    return DirectionFigures(
        one_way_stretches=len(one_way),
        two_way_stretches=len(every) - len(one_way),
        one_way_share=round(steps[0] / steps[1], 4),
        mean_drive_m=round(lengths.directed_m, 2),
        detour=round(lengths.detour, 4),
    )


def _circulation(structure: Structure, config: GarageConfig) -> CirculationFigures:
    found = measured_circulation(structure)
    squares = int(((structure.cells == Cell.FREE) | (structure.cells == Cell.LANE)).sum())
    rules = rules_of(config.plan, squares=squares)
    asked = {
        "R1": rules.is_asked,
        "R2": rules.asks_loop,
        "R3": rules.is_asked,
        "R4": rules.stretch_squares > 0,
    }
    return CirculationFigures(
        loops=found.circulation.loops,
        longest_dead_end_m=found.dead_end_m,
        longest_dead_end_squares=found.circulation.dead_end_squares,
        longest_stretch_m=found.stretch_m,
        longest_stretch_squares=found.circulation.longest_stretch_squares,
        blocks=len(found.circulation.blocks),
        rules_asked=tuple(name for name, is_asked in asked.items() if is_asked),
        rules_broken=found.circulation.faults(rules),
        neither_share=round(neither_share(structure, config.bay), 4),
    )


def _tape(plan: Plan) -> str | None:
    try:
        return plan_tape_of(plan)
    except ConfigError:  # for lanes given by the user in several pieces
        return None
