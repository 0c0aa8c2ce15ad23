"""The plan of a garage that is being drawn, and what `check` finds on it, as the page is told."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from garage2usd.as_built.plan_reader import garage_of_config
from garage2usd.checks import Finding, findings_of
from garage2usd.common.errors import ConfigError, Garage2UsdError, UnreachableStallError
from garage2usd.config import GarageConfig
from garage2usd.drafts.change import LANE
from garage2usd.garage import LaneGraph, LaneKind, Stall
from garage2usd.garage_model import Garage
from garage2usd.garage_sources import built_source
from garage2usd.site import with_sides
from garage2usd.site.levels import make_level_sites
from garage2usd.structure.grid import Structure, cells_from_text

_DIGITS = 3
_SOURCE = "this drawing"
Told = dict[str, Any]
"""A message to the page, as JSON has it."""


def has_lanes(config: GarageConfig) -> bool:
    """True if the lanes are drawn, so that nothing is left to be planned."""
    structure = config.site.structure
    return structure is not None and any(symbol in structure for symbol in (LANE, "1"))


def sketch_of(config: GarageConfig, planned: Garage | None) -> Told:
    """Draw the plan again, without what takes more than a moment.

    Parameters
    ----------
    config
        The settings.
    planned
        The garage that was planned for them, if it was.

    Returns
    -------
    dict
        ``levels`` with the rows of S, stalls and lanes of each; ``rows_m`` and ``cols_m``, the sides of squares;
        ``state``: ``drawn`` if the lanes are given, ``planned`` or ``open``; and ``findings``.
    """
    try:
        if planned is not None:
            told = _planned_levels(planned)
            return _sketch("planned", planned.levels[0].plan.structure, told, ())
        if has_lanes(config) and config.building.levels == 1:
            built = garage_of_config(config, Path(_SOURCE), with_objects=False)
            (level,) = built.levels
            structure = level.structure or _bare(config)
            told = [_level("", structure, level.stalls, level.lanes)]
            sketch = _sketch("drawn", structure, told, findings_of(built, config.standard))
            return {**sketch, "findings": [*sketch["findings"], *_empty_runs(config, structure, level.stalls)]}
        sites = make_level_sites(config)
        names = [f"U{number + 1}" for number in range(sites.count)] if sites.count > 1 else [""]
        told = [_level(name, sites.site(number)) for number, name in enumerate(names)]
        return _sketch("open", sites.street, told, ())
    except Garage2UsdError as error:
        return _refused(config, error)


def checked(config: GarageConfig, planned: Garage | None) -> Told:
    """Lay a garage out with all its objects and check it, as `check` does; a second or more for a large one.

    Returns
    -------
    dict
        ``findings``, and ``levels`` with the stalls as they are among stair cores, with their uses and numbers; empty
        where there is nothing to lay out.
    """
    try:
        if planned is not None:
            findings = [_told(finding) for finding in built_source(planned, source=_SOURCE).findings()]
            return {"findings": findings, "levels": _planned_levels(planned)}
        if has_lanes(config):
            built = garage_of_config(config, Path(_SOURCE))
            (level,) = built.levels
            structure = level.structure or _bare(config)
            findings = [_told(finding) for finding in findings_of(built, config.standard)]
            findings += _empty_runs(config, structure, level.stalls)
            return {"findings": findings, "levels": [_level("", structure, level.stalls, level.lanes)]}
    except Garage2UsdError as error:
        return {"findings": [_problem(error)], "levels": []}
    return {"findings": [], "levels": []}


def _planned_levels(planned: Garage) -> list[Told]:
    return [
        _level(level.name, level.plan.structure, level.layout.quads, level.layout.lane_graph)
        for level in planned.levels
    ]


def _empty_runs(config: GarageConfig, structure: Structure, stalls: Iterable[Stall]) -> list[Told]:
    """Tell the given runs on whose squares no stall fits, as `check` says nothing of stalls that are not there."""
    centres = [stall.centre for stall in stalls]
    xs_m, zs_m = structure.column_edges_m, structure.row_edges_m
    told = []
    for run in config.stalls.runs:
        (row, col), (last_row, last_col) = run.first, run.last
        left, right, top, bottom = xs_m[col], xs_m[last_col + 1], zs_m[row], zs_m[last_row + 1]
        if not any(left <= x <= right and top <= z <= bottom for x, z in centres):
            told.append(
                {
                    "severity": "warning",
                    "rule": "stalls.runs",
                    "message": f"no {run.kind} stall of size {run.size} fits on squares of these sides",
                    "place": f"{list(run.first)}",
                    "at": [round(float(left + right) / 2, _DIGITS), round(float(top + bottom) / 2, _DIGITS)],
                }
            )
    return told


def _sketch(state: str, structure: Structure, levels: list[Told], findings: Iterable[Finding]) -> Told:
    return {
        "state": state,
        "levels": levels,
        "rows_m": (structure.row_depths_mm / 1000).tolist(),
        "cols_m": (structure.column_widths_mm / 1000).tolist(),
        "findings": [_told(finding) for finding in findings],
    }


def _level(name: str, structure: Structure, stalls: Iterable[Stall] = (), lanes: LaneGraph | None = None) -> Told:
    return {
        "name": name,
        "rows": str(structure).splitlines(),
        "stalls": [
            {
                "name": stall.name,
                "number": stall.number,
                "use": stall.use.value,
                "kind": stall.kind.value,
                "corners": [[round(x, _DIGITS), round(z, _DIGITS)] for x, z in stall.corners],
            }
            for stall in stalls
        ],
        "ways": [] if lanes is None else _ways(lanes),
    }


def _ways(lanes: LaneGraph) -> list[list[float]]:
    """Return the one-way edges of the lanes and those at portals, each as x and z of its start and of its end."""
    found = []
    for edge in lanes.edges:
        start, end = (lanes.nodes[number] for number in (edge.start, edge.end))
        if start.kind == LaneKind.EXIT or end.kind == LaneKind.ENTRANCE:
            start, end = end, start
        elif not edge.one_way and start.kind != LaneKind.ENTRANCE and end.kind != LaneKind.EXIT:
            continue
        found.append([round(each, _DIGITS) for node in (start, end) for each in node.position])
    return found


def _refused(config: GarageConfig, error: Garage2UsdError) -> Told:
    """Tell a drawing that is not a garage yet, and why."""
    try:
        bare = _bare(config)
    except Garage2UsdError:
        rows, cols = config.site.shape
        side_m = config.bay.square_side_m
        squares = {"name": "", "rows": ["." * cols] * rows, "stalls": [], "ways": []}
        sketch = {"levels": [squares], "rows_m": [side_m] * rows, "cols_m": [side_m] * cols}
        return {**sketch, "state": "refused", "findings": [_problem(error)]}
    return {**_sketch("refused", bare, [_level("", bare)], ()), "findings": [_problem(error, bare)]}


def _bare(config: GarageConfig) -> Structure:
    if config.site.structure is None:
        raise ConfigError("site.structure", None, "a drawing")
    return with_sides(cells_from_text(config.site.structure, field="site.structure"), config.bay)


def _problem(error: Garage2UsdError, structure: Structure | None = None) -> Told:
    at = None
    if isinstance(error, UnreachableStallError) and structure is not None:
        row, col = error.cells[0]
        edges = structure.column_edges_m, structure.row_edges_m
        at = [float(edges[0][col : col + 2].mean()), float(edges[1][row : row + 2].mean())]
    rule = error.field if isinstance(error, ConfigError) else "plan"
    return {"severity": "error", "rule": rule, "message": str(error).splitlines()[0], "place": "", "at": at}


def _told(finding: Finding) -> Told:
    position = finding.position_m
    return {
        "severity": finding.severity.value,
        "rule": finding.rule,
        "message": finding.message,
        "place": finding.place,
        "at": None if position is None else [round(each, _DIGITS) for each in position],
    }
