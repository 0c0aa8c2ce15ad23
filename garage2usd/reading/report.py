"""The report of a build, JSON: the model that its writer and all who read it share."""

from pathlib import Path
from typing import Annotated, Any

from pydantic import AliasChoices, Field, SerializerFunctionWrapHandler, ValidationError, model_serializer

from garage2usd.common.documents import MAX_REPORT_BYTES, read_text
from garage2usd.common.errors import ConfigError, ReportError
from garage2usd.common.settings import Record, first_fault
from garage2usd.config import GarageConfig, LookConfig, config_from_mapping
from garage2usd.layout.ceiling.lighting import LightLevels
from garage2usd.planning import Principles, Score

__all__ = [
    "CirculationFigures",
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


class PlanFigures(Record):
    """The figures of a plan, or what they differ by between two."""

    value: float
    stalls: int
    area_per_planned_stall_m2: float = Field(
        validation_alias=AliasChoices("area_per_planned_stall_m2", "area_per_stall_m2")  # as it was called before
    )


class LearningFigures(Record):
    """What learning alone found, and what polish added to it."""

    learnt: PlanFigures
    polish: PlanFigures
    episodes: int
    steps: int


class CirculationFigures(Record):
    """How traffic circulates, which of R1 to R4 were asked for, and which of these are broken, with where."""

    loops: int
    longest_dead_end_m: float
    longest_dead_end_squares: int
    longest_stretch_m: float
    longest_stretch_squares: int
    blocks: int
    rules_asked: tuple[str, ...]
    rules_broken: dict[str, str]
    neither_share: float


class StairCore(Record):
    """A stair core: (row, col) of its square, (x, z) of its door, and the stalls in whose place it stands."""

    square: tuple[int, int]
    door_m: tuple[float, float]
    in_place_of: tuple[str, ...]


class FireCompartment(Record):
    """A fire compartment with how many stalls and doors of stair cores it has."""

    name: str
    area_m2: float
    stalls: int
    stair_cores: int


class ReportedStall(Record):
    """A stall; squares are (row, col), its centre is (x, z), and `occupied` says whether a car stands in it.

    That may be a misparked car of the next stall, whose name `blocked_by` is.
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
    occupied: bool | None = None
    blocked_by: str | None = None

    @model_serializer(mode="wrap")
    def _where_it_is_blocked(self, handler: SerializerFunctionWrapHandler) -> dict[str, object]:
        """Without `blocked_by` where nothing blocks it, as nothing does in most garages."""
        told: dict[str, object] = handler(self)
        if self.blocked_by is None:
            del told["blocked_by"]
        return told


class UnmetClause(Record):
    """A clause of the profile that the garage misses in some places, or that nothing checks, which has none."""

    clause: str
    places: int
    reason: str
    measured: float | None = None
    required: float | None = None
    unit: str = ""


class Report(Record):
    """A report, key by key in the order of the file.

    What makes the garage again has to be there: ``seed``, ``config``, ``S`` as rows of symbols, ``R`` and ``C`` as
    metres by column and by row. A report may lack the rest. An entry of ``stalls`` that is not a stall is kept as it
    stands, for `garage2usd.checks` to name.
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
    score: Score | None = None
    learning: LearningFigures | None = None
    principles: Principles | None = None
    circulation: CirculationFigures | None = None
    area_per_stall_m2: float | None = None
    parking_stalls: int | None = None
    stall_uses: dict[str, int] | None = None
    illuminance: LightLevels | None = None
    not_designed_to: tuple[UnmetClause, ...] | None = None
    lane_kinds: dict[str, int] | None = None
    object_counts: dict[str, int] | None = None
    unreachable_stalls: tuple[str, ...] = ()
    undecided_stalls: tuple[str, ...] = ()
    stair_cores: tuple[StairCore, ...] = ()
    fire_compartments: tuple[FireCompartment, ...] = ()
    stalls: tuple[Annotated[ReportedStall | Any, Field(union_mode="left_to_right")], ...] | None = None
    learning_curve: tuple[float, ...] = ()
    seconds: dict[str, float] | None = None

    def garage_config(self) -> GarageConfig:
        """Settings that make the garage again, without planning: its lanes and sizes are given.

        Raises
        ------
        ConfigError
            If the sizes or the lanes are not allowed by this version.
        """
        settings = self.config.model_dump(mode="json")
        sizes = {"column_widths_m": self.R, "row_depths_m": self.C, "dimensioned": False}
        site = {"structure": "\n".join(self.S)}
        return config_from_mapping({**settings, "seed": self.seed, "bay": {**settings["bay"], **sizes}, "site": site})


def read_report(path: Path) -> Report:
    """Read a report.

    Raises
    ------
    ConfigError
        If the file cannot be read, or a setting in it is not allowed by this version.
    ReportError
        If it is not a report; names the key, its value and what is allowed.
    """
    text = read_text(path, field="report", max_bytes=MAX_REPORT_BYTES)
    try:
        return Report.model_validate_json(text)
    except ValidationError as error:
        raise _refusal(error, path) from None


def report_of(document: Any, path: Path) -> Report:  # noqa: ANN401 - whatever JSON holds
    """The report that a JSON document is; raises as `read_report`."""
    try:
        return Report.model_validate(document)
    except ValidationError as error:
        raise _refusal(error, path) from None


def _refusal(error: ValidationError, path: Path) -> ConfigError | ReportError:
    """The error of a setting, else that of the first key that is wrong."""
    for fault in error.errors(include_url=False):
        cause = fault.get("ctx", {}).get("error")
        if isinstance(cause, ConfigError):
            return cause
    return ReportError(path, f"not a report of a build: {first_fault(error)}")
