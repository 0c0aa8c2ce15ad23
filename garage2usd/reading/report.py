"""The report of a build, in JSON: the model shared by its writer and its readers."""
# Over 300 lines: the records of one file stand together in the order of its keys.

import math
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    AliasChoices,
    Field,
    SerializerFunctionWrapHandler,
    ValidationError,
    model_serializer,
    model_validator,
)

from garage2usd.common.documents import MAX_REPORT_BYTES, read_json
from garage2usd.common.errors import ConfigError, ReportError
from garage2usd.common.settings import Record, first_fault
from garage2usd.config import GarageConfig, LookConfig, config_from_mapping
from garage2usd.config.stalls import GivenRun, SizeClass
from garage2usd.garage import StallKind
from garage2usd.garage.levels import level_name
from garage2usd.layout.ceiling.lighting import LightLevels
from garage2usd.planning import Principles, Score


class PlanFigures(Record):
    """Figures of a plan, or their differences between two plans."""

    value: float
    stalls: int
    area_per_planned_stall_m2: float = Field(
        validation_alias=AliasChoices("area_per_planned_stall_m2", "area_per_stall_m2")  # as it was called before
    )


class LearningFigures(Record):
    """Figures of the plan found by learning alone, and the gain by polish."""

    learnt: PlanFigures
    polish: PlanFigures
    episodes: int
    steps: int


class CirculationFigures(Record):
    """Circulation of traffic: its figures, the required rules of R1 to R4, and the violated ones with their places."""

    loops: int
    longest_dead_end_m: float
    longest_dead_end_squares: int
    longest_stretch_m: float
    longest_stretch_squares: int
    blocks: int
    rules_asked: tuple[str, ...]
    rules_broken: dict[str, str]
    neither_share: float


class DirectionFigures(Record):
    """One-way aisles: their number and share of the lanes, and the detour of drives against two-way aisles."""

    one_way_stretches: int
    two_way_stretches: int
    one_way_share: float
    mean_drive_m: float
    detour: float


class StairCore(Record):
    """A stair core: (row, col) of its square, (x, z) of its door, and the stalls that it replaces."""

    square: tuple[int, int]
    door_m: tuple[float, float]
    in_place_of: tuple[str, ...]


class FireCompartment(Record):
    """A fire compartment with its numbers of stalls and of doors of stair cores."""

    name: str
    area_m2: float
    stalls: int
    stair_cores: int


class ReportedStall(Record):
    """A stall in a report; squares are (row, col), its centre is (x, z), and `occupied` is true with a car in it.

    That car may be a misparked one of the adjacent stall named by `blocked_by`. A stall that was surveyed has no
    squares, but its `id` in the source, its corners, and whether a car was proven to drive in and out.
    """

    name: str
    number: str
    type: str
    use: str
    square: tuple[int, int] | None = None
    access_square: tuple[int, int] | None = None
    centre_m: tuple[float, float]
    yaw_rad: float
    width_m: float
    length_m: float
    kind: str = StallKind.PERPENDICULAR
    angle_rad: float = round(math.pi / 2, 6)
    size: str = SizeClass.STANDARD
    occupied: bool | None = None
    blocked_by: str | None = None
    id: str | None = None
    corners_m: tuple[tuple[float, float], ...] | None = None
    proof: str | None = None

    @model_serializer(mode="wrap")
    def _what_is_unusual(self, handler: SerializerFunctionWrapHandler) -> dict[str, object]:
        """Serialize the stall, without what is unknown, and default values of `kind`, `angle_rad` and `size`."""
        told: dict[str, object] = handler(self)
        usual = {name: field.default for name, field in type(self).model_fields.items()}
        if all(told[name] == usual[name] for name in _OF_SHAPE):
            for name in _OF_SHAPE:
                del told[name]
        return {name: value for name, value in told.items() if value is not None or name == "occupied"}


_OF_SHAPE = ("kind", "angle_rad", "size")


class UnmetClause(Record):
    """A profile clause violated in some places of the garage, or one that no rule checks, which has no places."""

    clause: str
    places: int
    reason: str
    measured: float | None = None
    required: float | None = None
    unit: str = ""


class LevelReport(Record):
    """One level in a report, key by key in the order of the file.

    ``source_name`` is the name of an imported level in its file. ``S`` has the rows of symbols, ``R`` and ``C`` are
    metres by column and by row; landings of ramps are portals of ``S``. They, and what else squares are needed for, are
    missing for a level that was surveyed. An entry of ``stalls`` that is not a stall is kept unchanged:
    `garage2usd.checks` reports it.
    """

    name: str
    source_name: str | None = Field(None, exclude_if=lambda name: name is None)
    floor_m: float
    structure_digest: str | None = None
    look: LookConfig | None = None
    tape: str | None = None
    rank: str | None = None
    S: tuple[str, ...] | None = None
    R: tuple[float, ...] | None = None
    C: tuple[float, ...] | None = None
    one_way: tuple[tuple[tuple[int, int], tuple[int, int]], ...] = ()
    directions: DirectionFigures | None = None
    stall_runs: tuple[GivenRun, ...] = ()
    score: Score | None = None
    learning: LearningFigures | None = None
    principles: Principles | None = None
    circulation: CirculationFigures | None = None
    area_per_stall_m2: float | None = None
    gross_area_per_stall_m2: float | None = None
    parking_stalls: int | None = None
    stall_uses: dict[str, int] | None = None
    illuminance: LightLevels | None = None
    not_designed_to: tuple[UnmetClause, ...] | None = None
    lane_kinds: dict[str, int] | None = None
    object_counts: dict[str, int] | None = None
    columns_at_mouths: tuple[str, ...] | None = None
    unreachable_stalls: tuple[str, ...] = ()
    undecided_stalls: tuple[str, ...] = ()
    stair_cores: tuple[StairCore, ...] = ()
    fire_compartments: tuple[FireCompartment, ...] = ()
    stalls: tuple[Annotated[ReportedStall | Any, Field(union_mode="left_to_right")], ...] | None = None
    learning_curve: tuple[float, ...] = ()

    @model_validator(mode="after")
    def _has_squares_whole(self) -> Self:
        matrices = {"S": self.S, "R": self.R, "C": self.C}
        lacking = [name for name, matrix in matrices.items() if matrix is None]
        if lacking and len(lacking) < len(matrices):
            raise ValueError(f"{lacking[0]}: Field required")
        return self


class ReportedLink(Record):
    """A one-way ramp between two levels; squares are (row, col), from its head to its foot."""

    kind: str
    upper: str
    lower: str
    direction: str
    squares: tuple[tuple[int, int], ...]
    head: tuple[int, int]
    foot: tuple[int, int]
    rise_m: float
    run_m: float
    steepest_percent: float
    clear_width_m: float
    clear_height_m: float


class SurveyFigures(Record):
    """What was imported: name and digest of the file, how it was turned and shifted, and what became of its parts.

    ``unplaced`` and ``changed`` have the ``id`` of a part in the file, and the ``reason`` or ``change``.
    """

    source: str | None = None
    source_digest: str | None = None
    turn_deg: float
    shift_m: tuple[float, float]
    origin_deg: tuple[float, float] | None = None
    unplaced: tuple[dict[str, str], ...]
    changed: tuple[dict[str, str], ...]
    lane_m: float


class Report(Record):
    """A build report, key by key in the order of the file.

    The keys that reproduce the garage are required: ``seed``, ``config``, and for one level its ``S``, ``R`` and ``C``,
    for several the ``tape`` of the ramps and of all levels. All others are optional.
    """

    version: str = ""
    seed: int
    config_digest: str = ""
    config: GarageConfig
    tape: str | None = None
    parking_stalls: int | None = None
    area_per_stall_m2: float | None = None
    gross_area_per_stall_m2: float | None = None
    remarks: tuple[str, ...] = ()
    survey: SurveyFigures | None = None
    links: tuple[ReportedLink, ...] = ()
    levels: tuple[LevelReport, ...] = Field(min_length=1)
    seconds: dict[str, float] | None = None

    @model_validator(mode="before")
    @classmethod
    def _with_levels(cls, document: Any) -> Any:  # noqa: ANN401 - whatever JSON holds
        """Return a document of the first form, which had the facts of an only level beside those of the garage."""
        if not isinstance(document, dict):
            return document
        levels = document.get("levels")
        if not isinstance(levels, list | tuple):
            levels = [{"name": level_name(0), "floor_m": 0.0, **document}]
        elif not all(isinstance(level, dict) for level in levels):
            return document
        flat = [{**level, **level["report"]} if isinstance(level.get("report"), dict) else level for level in levels]
        return {**document, "levels": flat}

    def garage_config(self) -> GarageConfig:
        """Return the settings that reproduce a garage of one level without planning, from its lanes and sizes.

        Raises
        ------
        ConfigError
            If this version does not allow the sizes or the lanes.
        """
        (level,) = self.levels
        settings = self.config.model_dump(mode="json")
        sizes = {"column_widths_m": level.R, "row_depths_m": level.C, "dimensioned": False}
        site = {"structure": "\n".join(level.S or ())}
        stalls = {**settings["stalls"], "runs": level.stall_runs, "only_runs": bool(level.stall_runs)}
        if self.config.stalls.is_free and not level.stall_runs:  # the choice was the usual stall
            stalls["kinds"] = {StallKind.PERPENDICULAR: 1}
        bay = {**settings["bay"], **sizes}
        plan = {**settings["plan"], "one_way": level.one_way}
        changed = {"seed": self.seed, "bay": bay, "stalls": stalls, "plan": plan, "site": site}
        return config_from_mapping({**settings, **changed})


def read_report(path: Path) -> Report:
    """Read the report of a build whose garage has squares.

    Raises
    ------
    ConfigError
        If the file cannot be read, or this version does not allow a setting in it.
    ReportError
        If the file is not such a report; names the key, its value and the allowed values.
    """
    return report_of(read_json(path, field="report", max_bytes=MAX_REPORT_BYTES), path)


def report_of(document: Any, path: Path) -> Report:  # noqa: ANN401 - whatever JSON holds
    """Convert a JSON document to a report; raises as `read_report`."""
    try:
        report = Report.model_validate(document)
    except ValidationError as error:
        raise _refusal(error, path, document) from None
    if any(level.S is None for level in report.levels):
        raise _of_import(path) if report.survey else ReportError(path, "not a report of a build: S: Field required")
    return report


def _refusal(error: ValidationError, path: Path, document: Any) -> ConfigError | ReportError:  # noqa: ANN401
    """Return the error of a report of an import or of a setting, else of the first invalid key."""
    if isinstance(document, dict) and "unplaced" in document:  # as imports had reports of their own before
        return _of_import(path)
    for fault in error.errors(include_url=False):
        cause = fault.get("ctx", {}).get("error")
        if isinstance(cause, ConfigError):
            return cause
    return ReportError(path, f"not a report of a build: {first_fault(error)}")


def _of_import(path: Path) -> ReportError:
    plan = f"{path.stem.removesuffix('_report')}_plan.png"
    return ReportError(path, f"the report of an import, whose garage has no squares: its plan is {plan}")
