"""Reader of reports and plans as garages; a faulty plan is read as far as possible, so that rules report its faults."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.layout_reader import level_of_layout, level_without_layout
from garage2usd.common.documents import MAX_REPORT_BYTES, read_json, read_text
from garage2usd.common.errors import ConfigError, UnreachableStallError
from garage2usd.config import GarageConfig, config_from_mapping, load_config
from garage2usd.config.files import is_array_file, matrices_of
from garage2usd.config.site import check_one_level
from garage2usd.driving import without_unreachable
from garage2usd.garage import Fault, Stall
from garage2usd.layout import Layout, lay_out
from garage2usd.layout.parking.stalls import planned_stalls
from garage2usd.planning import Plan, evaluate, given_plan, runs_of_settings, with_directions, with_stall_kinds
from garage2usd.profiles import Profile
from garage2usd.reading.report import Report, ReportedStall
from garage2usd.site import with_sides
from garage2usd.site.contour import check_structure
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph, unproven_lane_graph
from garage2usd.structure.lanes import given_directions

_FIELD = "PATH"
_MOVED_M = 0.001


def garage_of_plan(
    path: Path, *, report: Report | None = None, profile: Profile | None = None
) -> tuple[BuiltGarage, GarageConfig]:
    """Read a garage from a report of one level, a configuration with a structure, or a plan.

    Parameters
    ----------
    path
        A report (``.json``), a configuration (``.toml``), or a structure as text, JSON or a NumPy file.
    report
        The report, if the file is one.
    profile
        Profile for the sizes of a plan without any.

    Returns
    -------
    tuple
        The garage, of one level, and the configuration of its layout.

    Raises
    ------
    ConfigError
        If the file is none of these, or a setting is invalid.
    """
    if report is not None:
        return _of_report(report, path), report.config
    suffix = path.suffix.lower()
    if suffix == ".toml":
        config = load_config(path)
        return garage_of_config(config, path, kind="plan"), config
    if is_array_file(path):
        config = config_from_mapping(_given(profile) | matrices_of(path, field=_FIELD))
        return garage_of_config(config, path, kind="plan"), config
    if suffix != ".json":
        text = read_text(path, field=_FIELD)
        config = config_from_mapping(_given(profile) | {"site": {"structure": text}})
        return garage_of_config(config, path, kind="plan"), config
    document = read_json(path, field=_FIELD, max_bytes=MAX_REPORT_BYTES)
    config = config_from_mapping(_given(profile) | _settings_of(document, path))
    return garage_of_config(config, path, kind="plan"), config


def _given(profile: Profile | None) -> dict[str, Any]:
    return {} if profile is None else {"profile": profile}


def _settings_of(document: Any, path: Path) -> dict[str, Any]:  # noqa: ANN401 - whatever JSON holds
    """Return the settings of a structure in JSON: rows of S, or S with R and C."""
    matrices = document if isinstance(document, dict) else {"S": document}
    settings: dict[str, Any] = {"site": {"structure": _drawing(matrices.get("S"), path)}}
    sizes = {"column_widths_m": matrices.get("R"), "row_depths_m": matrices.get("C")}
    return settings | {"bay": {name: value for name, value in sizes.items() if value is not None}}


def _drawing(rows: Any, path: Path) -> str:  # noqa: ANN401
    if isinstance(rows, str):
        return rows
    if isinstance(rows, list) and rows and all(isinstance(row, str) for row in rows):
        return "\n".join(rows)
    if isinstance(rows, list) and rows and all(isinstance(row, list) for row in rows):
        return "\n".join(" ".join(str(cell) for cell in row) for row in rows)
    raise ConfigError(_FIELD, str(path), "a report, or S as rows of symbols or numbers")


def garage_of_config(config: GarageConfig, path: Path, *, kind: str = "plan", with_objects: bool = True) -> BuiltGarage:
    """Read a garage from a configuration with lanes; without objects, only what its squares tell, which is quick.

    Raises
    ------
    ConfigError
        If the configuration has no lanes, or a setting is invalid.
    """
    check_one_level(config.building)
    if config.site.structure is None:
        raise ConfigError(_FIELD, str(path), "a plan with lanes; build this configuration first and check what is made")
    structure = with_sides(cells_from_text(config.site.structure, field="site.structure"), config.bay)
    plan = with_directions(given_plan(structure, bay=config.bay), config)
    return _read(with_stall_kinds(plan, config), config, path, kind=kind, with_objects=with_objects)


def _of_report(report: Report, path: Path) -> BuiltGarage:
    (level,) = report.levels
    assert level.S is not None
    assert level.R is not None
    assert level.C is not None
    structure = Structure.from_arrays(cells_from_text("\n".join(level.S), field="S"), level.R, level.C)
    told, unreachable = level.stalls, level.unreachable_stalls
    directions = given_directions(structure, level.one_way, field="one_way")
    plan = Plan(
        structure,
        evaluate(structure, bay=report.config.bay),
        runs=tuple(runs_of_settings(level.stall_runs, report.config, directions)),
        directions=directions,
    )
    return _read(plan, report.config, path, kind="report", listed=told, unreachable=unreachable)


def _read(
    plan: Plan,
    config: GarageConfig,
    path: Path,
    *,
    kind: str,
    listed: Sequence[Any] | None = None,
    unreachable: Sequence[str] | None = None,
    with_objects: bool = True,
) -> BuiltGarage:
    structure = plan.structure
    if not (structure.cells == Cell.LANE).any():
        raise ConfigError(_FIELD, str(path), "a plan with lanes; build it first and check what is made")
    graph = unproven_lane_graph(structure, config.bay, plan.runs, plan.directions)
    layout, refusal = _laid_out(plan, config, unreachable) if with_objects else (None, None)
    if layout is None:
        faults = () if refusal is None else (Fault("plan-refused", "", None, refusal),)
        stalls = planned_stalls(graph, config.bay)
        source = str(path)
        level = level_without_layout(structure, graph.lanes, stalls, source=source, kind=kind, faults=faults)
        return BuiltGarage.of_level(level)
    differences = () if listed is None else tuple(report_differences(layout, listed))
    return BuiltGarage.of_level(level_of_layout(layout, source=str(path), kind=kind, faults=differences))


def _laid_out(plan: Plan, config: GarageConfig, unreachable: Sequence[str] | None) -> tuple[Layout | None, str | None]:
    """Lay out a plan; return None and the reason if it is refused, without a reason for faults that rules report.

    The unreachable stalls are those in a report, or else those found as in a build.
    """
    try:
        check_structure(plan.structure.cells)
        graph = build_lane_graph(plan.structure, config.bay, plan.runs, plan.directions)
    except (ConfigError, UnreachableStallError):
        return None, None
    if not graph.stall_rows:
        return None, "no square beside a lane takes a stall"
    try:
        layout = lay_out(plan.structure, graph, config, unreachable=unreachable or ())
        if unreachable is None and config.plan.unreachable_stalls.are_proven:
            layout = without_unreachable(layout, config)
    except ConfigError as error:
        if error.field.startswith("bay."):
            return None, str(error)
        raise
    return layout, None


def report_differences(layout: Layout, listed: Sequence[Any]) -> list[Fault]:
    """Compare a report's list of stalls with the layout of its configuration and matrices."""
    made = {stall.name: stall for stall in layout.quads}
    faults = []
    for entry in listed:
        name = entry.name if isinstance(entry, ReportedStall) else _name_in(entry)
        stall = made.pop(name, None)
        if stall is None:
            faults.append(Fault("report-stalls", name, None, "the report lists a stall that its plan does not have"))
        elif not (isinstance(entry, ReportedStall) and _is_told(stall, entry)):
            faults.append(Fault("report-stalls", name, stall.centre, "the report tells another place, size or use"))
    return faults + [
        Fault("report-stalls", name, stall.centre, "the report does not list it") for name, stall in made.items()
    ]


def _name_in(entry: Any) -> str:  # noqa: ANN401
    """Return a name for an entry of the report's list that is not a stall."""
    return str(entry.get("name")) if isinstance(entry, dict) else repr(entry)[:80]


def _is_told(stall: Stall, entry: ReportedStall) -> bool:
    told = (*entry.centre_m, entry.width_m, entry.length_m)
    real = (*stall.centre, stall.width_m, stall.length_m)
    return entry.use == stall.use and all(abs(one - other) <= _MOVED_M for one, other in zip(told, real, strict=True))
