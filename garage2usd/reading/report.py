"""The report of a build, in JSON: the model shared by its writer and its readers."""

import math
import re
from collections.abc import Collection
from pathlib import Path
from typing import Annotated, Any

from pydantic import AliasChoices, Field, SerializerFunctionWrapHandler, ValidationError, model_serializer

from garage2usd.common.documents import MAX_REPORT_BYTES, read_text
from garage2usd.common.errors import ConfigError, ReportError
from garage2usd.common.settings import Record, first_fault
from garage2usd.config import GarageConfig, LookConfig, config_from_mapping
from garage2usd.config.stalls import GivenRun, SizeClass
from garage2usd.garage import StallKind
from garage2usd.layout.ceiling.lighting import LightLevels
from garage2usd.planning import Principles, Score

__all__ = [
    "CirculationFigures",
    "DirectionFigures",
    "FireCompartment",
    "LearningFigures",
    "PlanFigures",
    "Report",
    "ReportedStall",
    "StairCore",
    "UnmetClause",
    "read_report",
    "report_of",
]


_OTHER_REPORTS = re.compile(r'"(?P<key>levels|unplaced)":\s*\[')
"""Lists in the reports of a garage of several levels and of an import; as a setting ``levels`` is a number."""


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

    That car may be a misparked one of the adjacent stall named by `blocked_by`.
    """

    name: str
    number: str
    type: str
    use: str
    square: tuple[int, int]
    access_square: tuple[int, int]
    centre_m: tuple[float, float]
    yaw_rad: float
    width_m: float
    length_m: float
    kind: str = StallKind.PERPENDICULAR
    angle_rad: float = round(math.pi / 2, 6)
    size: str = SizeClass.STANDARD
    occupied: bool | None = None
    blocked_by: str | None = None

    @model_serializer(mode="wrap")
    def _what_is_unusual(self, handler: SerializerFunctionWrapHandler) -> dict[str, object]:
        """Serialize the stall, without default values of `blocked_by`, `kind`, `angle_rad` and `size`."""
        told: dict[str, object] = handler(self)
        usual = {name: field.default for name, field in type(self).model_fields.items()}
        if all(told[name] == usual[name] for name in _OF_SHAPE):
            for name in _OF_SHAPE:
                del told[name]
        if self.blocked_by is None:
            del told["blocked_by"]
        return told


_OF_SHAPE = ("kind", "angle_rad", "size")


class UnmetClause(Record):
    """A profile clause violated in some places of the garage, or one that no rule checks, which has no places."""

    clause: str
    places: int
    reason: str
    measured: float | None = None
    required: float | None = None
    unit: str = ""


class Report(Record):
    """A build report, key by key in the order of the file.

    The keys that reproduce the garage are required: ``seed``, ``config``, ``S`` as rows of symbols, ``R`` and ``C`` as
    metres by column and by row. All others are optional. An entry of ``stalls`` that is not a stall is kept unchanged:
    `garage2usd.checks` reports it.
    """

    version: str = ""
    seed: int
    config_digest: str = ""
    structure_digest: str = ""
    config: GarageConfig
    look: LookConfig | None = None
    tape: str | None = None
    rank: str | None = None
    S: tuple[str, ...]
    R: tuple[float, ...]
    C: tuple[float, ...]
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
    remarks: tuple[str, ...] = ()
    lane_kinds: dict[str, int] | None = None
    object_counts: dict[str, int] | None = None
    columns_at_mouths: tuple[str, ...] | None = None
    unreachable_stalls: tuple[str, ...] = ()
    undecided_stalls: tuple[str, ...] = ()
    stair_cores: tuple[StairCore, ...] = ()
    fire_compartments: tuple[FireCompartment, ...] = ()
    stalls: tuple[Annotated[ReportedStall | Any, Field(union_mode="left_to_right")], ...] | None = None
    learning_curve: tuple[float, ...] = ()
    seconds: dict[str, float] | None = None

    def garage_config(self) -> GarageConfig:
        """Return the settings that reproduce the garage without planning, from its lanes and sizes.

        Raises
        ------
        ConfigError
            If this version does not allow the sizes or the lanes.
        """
        settings = self.config.model_dump(mode="json")
        sizes = {"column_widths_m": self.R, "row_depths_m": self.C, "dimensioned": False}
        site = {"structure": "\n".join(self.S)}
        stalls = {**settings["stalls"], "runs": self.stall_runs, "only_runs": bool(self.stall_runs)}
        if self.config.stalls.is_free and not self.stall_runs:  # the choice was the usual stall
            stalls["kinds"] = {StallKind.PERPENDICULAR: 1}
        bay = {**settings["bay"], **sizes}
        plan = {**settings["plan"], "one_way": self.one_way}
        changed = {"seed": self.seed, "bay": bay, "stalls": stalls, "plan": plan, "site": site}
        return config_from_mapping({**settings, **changed})


def read_report(path: Path) -> Report:
    """Read the report of a build.

    Raises
    ------
    ConfigError
        If the file cannot be read, or this version does not allow a setting in it.
    ReportError
        If the file is not a report; names the key, its value and the allowed values.
    """
    text = read_text(path, field="report", max_bytes=MAX_REPORT_BYTES)
    try:
        return Report.model_validate_json(text)
    except ValidationError as error:
        raise _refusal(error, path, {match["key"] for match in _OTHER_REPORTS.finditer(text)}) from None


def report_of(document: Any, path: Path) -> Report:  # noqa: ANN401 - whatever JSON holds
    """Convert a JSON document to a report; raises as `read_report`."""
    try:
        return Report.model_validate(document)
    except ValidationError as error:
        keys = {*document} if isinstance(document, dict) else set()
        raise _refusal(error, path, keys) from None


def _refusal(error: ValidationError, path: Path, keys: Collection[str]) -> ConfigError | ReportError:
    """Return the error of a report of another kind or of a setting, else of the first invalid key."""
    if "levels" in keys:
        return ReportError(path, "the report of a garage of several levels, which has a report for each of them")
    if "unplaced" in keys:
        plan = f"{path.stem.removesuffix('_report')}_plan.png"
        return ReportError(path, f"the report of an import, whose garage has no squares: its plan is {plan}")
    for fault in error.errors(include_url=False):
        cause = fault.get("ctx", {}).get("error")
        if isinstance(cause, ConfigError):
            return cause
    return ReportError(path, f"not a report of a build: {first_fault(error)}")
