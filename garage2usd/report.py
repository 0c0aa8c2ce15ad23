"""Writing of the JSON report of a build, whose model is in `garage2usd.reading.report`."""
# Over 300 lines: all facts of the report are gathered in one place.

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from garage2usd.common.documents import json_text
from garage2usd.common.errors import ConfigError
from garage2usd.common.package import VERSION
from garage2usd.config import GarageConfig
from garage2usd.driving import StallProof
from garage2usd.garage import Stall
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout import Layout
from garage2usd.layout.egress.exits import compartment_name
from garage2usd.layout.measures import FloorArea
from garage2usd.layout.shell.well import SLAB_M
from garage2usd.layout.surveyed import SurveyedFloor
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
    LevelReport,
    PlanFigures,
    Report,
    ReportedLink,
    ReportedStall,
    StairCore,
    SurveyFigures,
    UnmetClause,
)
from garage2usd.structure.grid import Cell, Structure

_CURVE_POINTS, _RETURN_DECIMALS = 500, 1
"""Points of the learning curve, each the mean of ten of 5000 episodes (the whole curve would be half of a report), and
decimals of returns, since neighbouring points differ by about ten."""
_DECIMALS = 6
"""Decimals of metres and radians in stalls."""


def write_report(path: Path, report: Report) -> None:
    """Write a report as JSON."""
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
    garage: Garage,
    *,
    seconds: Mapping[str, float],
    unmet: Sequence[Sequence[UnmetClause]] | None = None,
    learning: LearningFigures | None = None,
    survey: SurveyFigures | None = None,
    proofs: Sequence[StallProof] = (),
    remarks: Sequence[str] = (),
) -> Report:
    """Make the report of a garage; it is reproducible, except for ``seconds``.

    Parameters
    ----------
    garage
        The garage.
    seconds
        Duration of each step in seconds.
    unmet
        Clauses of the profile that the design of each level violates; None if unknown.
    learning
        Results of learning, for the plan of a single level without its archive.
    survey
        Figures of an import; None for a generated garage.
    proofs
        Proofs of the stalls of an imported garage, if requested.
    remarks
        What an import mended or added.

    Notes
    -----
    ``tape`` and ``rank`` are null if no single drive of an agent makes the lanes (see `garage2usd.planning.tape`); the
    rank is a hexadecimal number of any length. ``polish_gain`` is the gain of hill climbing over the best y' of
    learning. ``S`` is a list of rows of symbols (see `garage2usd.structure.grid.Cell`), ``R`` and ``C`` are metres by
    column and by row, stall centres are (x, z) in metres.
    """
    config = garage.config
    return Report(
        version=VERSION,
        seed=config.seed,
        config_digest=config.digest(),
        config=config,
        tape=_tape_or_none(lambda: garage.tape) if garage.plans else None,
        parking_stalls=garage.parking_stalls,
        **area_figures([level.layout for level in garage.levels]),
        remarks=(*config.remarks(), *garage.remarks, *remarks),
        survey=survey,
        links=reported_links(garage),
        levels=tuple(
            _level_report(level, None if unmet is None else unmet[number], learning, proofs)
            for number, level in enumerate(garage.levels)
        ),
        seconds={step: round(value, 4) for step, value in seconds.items()},
    )


def _level_report(
    level: GarageLevel,
    unmet: Sequence[UnmetClause] | None,
    learning: LearningFigures | None,
    proofs: Sequence[StallProof],
) -> LevelReport:
    layout = level.layout
    return LevelReport(
        name=level.name,
        source_name=level.source_name or None,
        floor_m=level.floor_m,
        look=layout.look,
        **area_figures([layout]),
        parking_stalls=layout.parking_stalls,
        stall_uses={str(use): count for use, count in sorted(Counter(s.use for s in layout.quads).items())},
        illuminance=layout.illuminance,
        not_designed_to=None if unmet is None else tuple(unmet),
        object_counts=layout.counts(),
        unreachable_stalls=tuple(sorted(layout.unreachable)),
        undecided_stalls=tuple(sorted(layout.undecided)),
        **(_surveyed(level, proofs) if level.planned is None else _planned(level, learning)),
    )


def _planned(level: GarageLevel, learning: LearningFigures | None) -> dict[str, Any]:
    """Return the facts of a level that its squares tell."""
    plan, layout, config = level.plan, level.layout, level.config
    structure, tape, squares = plan.structure, _tape_or_none(lambda: plan_tape_of(plan)), layout.node_squares().tolist()
    return {
        "structure_digest": structure.digest(),
        "tape": tape,
        "rank": None if tape is None else hex(rank_of(tape)),
        "S": tuple(str(structure).splitlines()),
        "R": tuple(structure.R[0].tolist()),
        "C": tuple(structure.C[:, 0].tolist()),
        "one_way": tuple((stretch[0], stretch[1]) for stretch in plan.one_way_stretches),
        "directions": _directions(plan, config),
        "stall_runs": settings_of_runs(plan.runs, plan.directions),
        "score": plan.score,
        "learning": learning or learning_figures(plan, config),
        "principles": principles(structure, bay=config.bay),
        "circulation": _circulation(structure, config),
        "lane_kinds": layout.source.kinds_of_squares(),
        "columns_at_mouths": layout.columns_at_mouths() if config.bay.column_setback_m else None,
        "stair_cores": tuple(
            StairCore(square=core.square, door_m=core.door_m, in_place_of=core.stalls) for core in layout.cores
        ),
        "fire_compartments": _compartments(layout),
        "stalls": tuple(_reported(stall, squares[stall.access]) for stall in layout.quads),
        "learning_curve": _mean_returns(plan),
    }


def _surveyed(level: GarageLevel, proofs: Sequence[StallProof]) -> dict[str, Any]:
    """Return the stalls of a level that was surveyed, with their ids in the source."""
    proven = {level.place.own_name(proof.stall): proof.outcome.value for proof in proofs}
    layout = level.layout
    floor = layout.source
    assert isinstance(floor, SurveyedFloor)
    return {
        "stalls": tuple(
            _reported(stall).model_copy(
                update={
                    "id": fitted.source.name,
                    "corners_m": tuple((round(x, 4), round(z, 4)) for x, z in stall.corners),
                    "proof": proven.get(stall.name),
                }
            )
            for stall, fitted in zip(layout.quads, floor.fitted, strict=True)
        )
    }


def reported_links(garage: Garage) -> tuple[ReportedLink, ...]:
    """Return the records of the ramps between levels; none of a single level."""
    building = garage.building
    clear_m = min(garage.config.fittings.ceiling_height_m, building.storey_m - SLAB_M)
    links: list[ReportedLink] = []
    for upper, lower in pairwise(garage.levels):
        layout = lower.layout
        if isinstance(layout.source, SurveyedFloor):
            links += _surveyed_links(upper, lower, layout.source)
            continue
        lanes = layout.well.lanes(layout.structure) if layout.well else ()
        links += [
            ReportedLink(
                kind=link.kind,
                upper=upper.name,
                lower=lower.name,
                direction="down" if link.is_down else "up",
                squares=link.squares,
                head=link.head,
                foot=link.foot,
                rise_m=building.storey_m,
                run_m=round(lane.run_m, 6),
                steepest_percent=round(100 * lane.slope, 3),
                clear_width_m=lane.width_m,
                clear_height_m=round(clear_m, 6),
            )
            for link, lane in zip(building.links, lanes, strict=True)
        ]
    return tuple(links)


def _surveyed_links(upper: GarageLevel, lower: GarageLevel, floor: SurveyedFloor) -> Iterator[ReportedLink]:
    """Yield the records of the ramps up from a level that was surveyed; they have no squares."""
    source = upper.layout.source
    assert isinstance(source, SurveyedFloor)
    heads = [*source.landings][len(source.part.ramps.up) :]
    feet = [*floor.landings]
    for index, ramp in enumerate(floor.part.ramps.up):
        yield ReportedLink(
            kind="surveyed",
            upper=upper.name,
            lower=lower.name,
            direction="down" if ramp.is_down else "up",
            squares=(),
            head=heads[source.part.ramps.down.index(ramp)],
            foot=feet[index],
            rise_m=ramp.storey.rise_m,
            run_m=round(ramp.line.length_m, 6),
            steepest_percent=round(100 * ramp.slope, 3),
            clear_width_m=round(ramp.line.width_m, 6),
            clear_height_m=round(lower.config.fittings.clear_height_m, 6),
        )


def _reported(stall: Stall, access_square: tuple[int, int] | None = None) -> ReportedStall:
    """Record of a stall, where it has squares with those that identify it and its lane in files."""
    facts, (x, z) = dict(stall.facts), stall.centre
    return ReportedStall(
        name=stall.name,
        number=str(stall.number or ""),
        type=str(facts["type"]),
        use=stall.use,
        square=None if access_square is None else (int(facts["row"]), int(facts["column"])),
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


def _tape_or_none(make: Callable[[], str]) -> str | None:
    try:
        return make()
    except ConfigError:  # for lanes given by the user in several pieces
        return None
