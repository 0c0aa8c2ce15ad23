"""The report of a build: what was made and what reproduces it, as JSON."""

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.documents import MAX_REPORT_BYTES, read_bytes
from garage2usd.errors import ConfigError, ReportError
from garage2usd.layout import Layout
from garage2usd.layout.compartments import compartment_name
from garage2usd.planning import (
    Plan,
    area_per_stall_m2,
    dimensioned,
    evaluate,
    measured_circulation,
    neither_share,
    principles,
    rank_of,
    tape_of,
)
from garage2usd.planning.circulation import rules_of
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneGraph
from garage2usd.version import VERSION

__all__ = ["read_report", "write_report"]


def write_report(
    path: Path,
    *,
    config: GarageConfig,
    plan: Plan,
    graph: LaneGraph,
    layout: Layout,
    seconds: Mapping[str, float],
) -> None:
    """Write everything but ``seconds`` so that the same configuration, seed and version give the same text.

    Notes
    -----
    ``tape`` and ``rank`` are null where no single agent makes the lanes (see `garage2usd.planning.tape`); the rank is a
    hexadecimal number of any length. ``polish_gain`` is what polish added to the best y' that learning met. ``S`` is a
    list of rows of symbols (see `garage2usd.structure.grid.Cell`), ``R`` and ``C`` are metres by column and by row,
    stall centres are (x, z) in metres.
    """
    structure = plan.structure
    score = plan.score
    tape = _tape(structure)
    document = {
        "version": VERSION,
        "seed": config.seed,
        "config_digest": config.digest(),
        "structure_digest": structure.digest(),
        "config": config.model_dump(mode="json"),
        "tape": tape,
        "rank": None if tape is None else hex(rank_of(tape)),
        "S": str(structure).splitlines(),
        "R": structure.R[0].tolist(),
        "C": structure.C[:, 0].tolist(),
        "score": {
            "value": score.value,
            "stalls": score.stalls,
            "parking_time_squares": score.parking_time_squares,
            "unused_squares": score.unused_squares,
        },
        "learning": _learning(plan, config),
        "principles": asdict(principles(structure, bay=config.bay)),
        "circulation": _circulation(structure, config),
        "area_per_stall_m2": round(layout.area_per_stall_m2, 3),
        "stall_uses": {use.value: count for use, count in sorted(Counter(s.use for s in layout.stalls).items())},
        "illuminance": asdict(layout.illuminance),
        "lane_kinds": graph.kind_counts(),
        "object_counts": layout.counts(),
        "unreachable_stalls": sorted(layout.unreachable),
        "stair_cores": [
            {"square": core.square, "door_m": core.door_m, "in_place_of": list(core.stalls)} for core in layout.cores
        ],
        "fire_compartments": _compartments(layout),
        "stalls": [
            {
                "name": stall.name,
                "number": stall.number,
                "type": str(stall.stall_type),
                "use": str(stall.use),
                "square": stall.square,
                "access_square": stall.access_square,
                "centre_m": stall.centre_m,
                "yaw_rad": stall.yaw_rad,
                "width_m": stall.width_m,
                "length_m": stall.length_m,
            }
            for stall in layout.stalls
        ],
        "learning_curve": plan.learning_curve.tolist(),
        "seconds": {step: round(value, 4) for step, value in seconds.items()},
    }
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def _learning(plan: Plan, config: GarageConfig) -> dict[str, Any] | None:
    """What learning alone found, and what polish added to it; None where nothing was learnt."""
    if plan.learnt is None:
        return None
    found = dimensioned(plan.learnt.structure, config.bay)
    score = evaluate(found, bay=config.bay, plan=config.plan)
    plan_found = {
        "value": score.value,
        "stalls": score.stalls,
        "area_per_stall_m2": round(area_per_stall_m2(found, config.bay), 3),
    }
    return {
        "learnt": plan_found,
        "polish": {
            "value": plan.score.value - score.value,
            "stalls": plan.score.stalls - score.stalls,
            "area_per_stall_m2": round(
                area_per_stall_m2(plan.structure, config.bay) - plan_found["area_per_stall_m2"], 3
            ),
        },
        "episodes": len(plan.learning_curve),
        "steps": plan.steps,
    }


def _compartments(layout: Layout) -> list[dict[str, Any]]:
    """Name, area, stalls and doors of stair cores of each fire compartment."""
    structure, numbers = layout.structure, layout.compartments
    areas = np.outer(structure.row_depths_mm, structure.column_widths_mm) / 1e6
    on = numbers[tuple(layout.stalls.square.T)]
    doors = Counter(int(numbers[core.lane]) for core in layout.cores)
    return [
        {
            "name": compartment_name(number),
            "area_m2": round(float(areas[numbers == number].sum()), 2),
            "stalls": int((on == number).sum()),
            "stair_cores": doors[number],
        }
        for number in range(1, int(numbers.max(initial=0)) + 1)
    ]


class _Report(BaseModel):
    """What makes the garage of a report again."""

    seed: int
    config: dict[str, Any]
    S: list[str]
    R: list[float]
    C: list[float]


def read_report(path: Path) -> GarageConfig:
    """Settings that make the garage of a report again, without planning: its lanes and sizes are given.

    Raises
    ------
    ConfigError
        If the file cannot be read, or a setting in it is not allowed by this version.
    ReportError
        If it is not a report.
    """
    text = read_bytes(path, field="report", max_bytes=MAX_REPORT_BYTES)
    try:
        report = _Report.model_validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"])) or "JSON"
        raise ReportError(path, f"no report of a build: {place}: {first['msg']}") from None
    bay = {**_section(report, "bay", path), "column_widths_m": report.R, "row_depths_m": report.C, "dimensioned": False}
    site = {"structure": "\n".join(report.S)}
    return config_from_mapping({**report.config, "seed": report.seed, "bay": bay, "site": site})


def _section(report: _Report, name: str, path: Path) -> dict[str, Any]:
    section = report.config.get(name)
    if not isinstance(section, dict):
        raise ReportError(path, f"no report of a build: config.{name}: not a table")
    return section


def _circulation(structure: Structure, config: GarageConfig) -> dict[str, Any]:
    """How traffic circulates, in an architect's figures, and which of the rules that were asked for are broken."""
    found = measured_circulation(structure)
    squares = int(((structure.cells == Cell.FREE) | (structure.cells == Cell.LANE)).sum())
    rules = rules_of(config.plan, squares=squares)
    asked = {
        "R1": rules.is_asked,
        "R2": rules.asks_loop,
        "R3": rules.is_asked,
        "R4": rules.stretch_squares > 0,
    }
    return {
        "loops": found.circulation.loops,
        "longest_dead_end_m": found.dead_end_m,
        "longest_dead_end_squares": found.circulation.dead_end_squares,
        "longest_stretch_m": found.stretch_m,
        "longest_stretch_squares": found.circulation.longest_stretch_squares,
        "blocks": len(found.circulation.blocks),
        "rules_asked": [name for name, is_asked in asked.items() if is_asked],
        "rules_broken": found.circulation.faults(rules),
        "neither_share": round(neither_share(structure, config.bay), 4),
    }


def _tape(structure: Structure) -> str | None:
    try:
        return tape_of(structure)
    except ConfigError:  # lanes drawn by hand in several pieces
        return None
