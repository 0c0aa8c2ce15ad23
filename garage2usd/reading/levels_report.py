"""The report of a garage of several levels, in JSON: a report for each level, and the ramps between them."""

import re
from pathlib import Path

from pydantic import ValidationError

from garage2usd.common.documents import MAX_REPORT_BYTES, read_text
from garage2usd.common.errors import ReportError
from garage2usd.common.settings import Record, first_fault
from garage2usd.config import GarageConfig
from garage2usd.reading.report import Report

__all__ = ["LevelReport", "LevelsReport", "ReportedLink", "read_levels_report"]

_LEVELS = re.compile(r'"levels":\s*\[')
"""A list in such a report; as a setting ``levels`` is a number."""


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


class LevelReport(Record):
    """One level: its name, the height of its floor, and its report as a garage of its own."""

    name: str
    floor_m: float
    report: Report


class LevelsReport(Record):
    """The report of a garage of several levels, key by key in the order of the file.

    ``tape`` is the random process of the ramps and of all levels. In the report of a level landings are portals of S.
    """

    version: str = ""
    seed: int
    config_digest: str = ""
    config: GarageConfig
    tape: str | None = None
    parking_stalls: int
    area_per_stall_m2: float | None = None
    gross_area_per_stall_m2: float | None = None
    remarks: tuple[str, ...] = ()
    links: tuple[ReportedLink, ...]
    levels: tuple[LevelReport, ...]
    seconds: dict[str, float] | None = None


def read_levels_report(path: Path) -> LevelsReport | None:
    """Read the report of a garage of several levels; None from a file that is none.

    Raises
    ------
    ConfigError
        If the file cannot be read.
    ReportError
        If it is a damaged report of several levels.
    """
    text = read_text(path, field="report", max_bytes=MAX_REPORT_BYTES)
    try:
        return LevelsReport.model_validate_json(text)
    except ValidationError as error:
        if _LEVELS.search(text) is None:
            return None
        raise ReportError(path, f"not a report of a garage of several levels: {first_fault(error)}") from None
