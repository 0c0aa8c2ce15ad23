"""Surveys as CSV: one stall a line, as a rectangle with a heading or by its four corners."""

import csv
import io
import math
import re
from collections.abc import Mapping
from pathlib import Path

from garage2usd.common.documents import read_text
from garage2usd.common.spelling import nearest
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import Point, StallUse
from garage2usd.native import elementary
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import Survey
from garage2usd.survey.text import number_of, positive_of, refuse

_RECTANGLE = ("x", "y", "width_m", "length_m", "heading_deg")
_CORNERS = tuple(f"{axis}{corner}" for corner in range(1, 5) for axis in "xy")
_OPTIONAL = ("id", "use", "size", "number")
_MOST_DEG = 36000.0
_SEPARATORS = (",", ";", "\t", "|")
_SEPARATOR_LINE = re.compile(r'"?sep=(.)"?\r?\n', re.IGNORECASE)
"""First line by which spreadsheets are told the separator."""
_DECIMAL_COMMA = re.compile(r"^([-+]?\d*),(\d+)$")


def read_csv_survey(path: Path) -> Survey:
    """Read a survey of rectangles or quads.

    Parameters
    ----------
    path
        A text with a header and a line for each stall, its fields separated by commas, semicolons, tabs or bars; with
        another separator than the comma, numbers may have decimal commas. The header has
        ``x, y, width_m, length_m, heading_deg``, where (x, y) is the middle and the heading is that of a car parked
        nose in, in degrees counter-clockwise from x; or ``x1, y1, ..., x4, y4`` in order around the stall. Both may
        have ``id, use, size, number``. If it has both, the rectangle is read. Coordinates are in metres, y upwards.

    Raises
    ------
    ConfigError
        For a header or a field that is wrong, with its line.
    """
    text = read_text(path, field="SOURCE", otherwise="cp1252")
    told = _SEPARATOR_LINE.match(text)
    text = text[told.end() :] if told else text
    lines = (line for line in text.splitlines() if line.strip())
    head = next(lines, "")
    separator = told[1] if told else max(_SEPARATORS, key=head.count)
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    skipped = 1 if told else 0
    parts = SurveyParts()
    columns: list[str] = []
    try:
        for row in rows:
            fields = [field.strip() for field in row]
            if not any(fields):
                continue
            if not columns:
                names = [field.lower() for field in fields]
                columns = _checked(names[: len(names) - _empty_ends(names)], path)
                continue
            place = f"{path.name}: line {rows.line_num + skipped}"
            fields = fields[: max(len(columns), len(fields) - _empty_ends(fields))]  # spreadsheets add empty ones
            if separator != ",":
                fields = [_DECIMAL_COMMA.sub(r"\1.\2", field) for field in fields]
            if len(fields) != len(columns):
                refuse(place, f"{len(fields)} fields", f"{len(columns)} fields, as in the header")
            _add(parts, dict(zip(columns, fields, strict=True)), place, len(parts.stalls) + len(parts.unread) + 1)
    except csv.Error as error:
        refuse(f"{path.name}: line {rows.line_num + skipped}", str(error), "a line of CSV")
    if not columns:
        refuse("SOURCE", str(path), f"a header with {', '.join(_RECTANGLE)} or {', '.join(_CORNERS)}")
    return parts.survey()


def _empty_ends(fields: list[str]) -> int:
    """Count the empty fields at the end of a line."""
    return next((count for count, field in enumerate(reversed(fields)) if field), len(fields))


def _checked(columns: list[str], path: Path) -> list[str]:
    """Return the names of columns if they are those of one of the two forms."""
    place = f"{path.name}: header"
    known = (*_RECTANGLE, *_CORNERS, *_OPTIONAL)
    for number, column in enumerate(columns):
        if column not in known:
            refuse(place, column, f"one of the columns {', '.join(known)}{nearest(column, known)}")
        if column in columns[:number]:
            refuse(place, column, "each column once")
    if not any(set(needed) <= set(columns) for needed in (_RECTANGLE, _CORNERS)):
        refuse(place, ", ".join(columns), f"all of {', '.join(_RECTANGLE)}, or all of {', '.join(_CORNERS)}")
    return columns


def _add(parts: SurveyParts, row: Mapping[str, str], place: str, number: int) -> None:
    name = row.get("id", "") or str(number)
    use, size = row.get("use", "").lower(), row.get("size", "").lower()
    if use and use not in set(StallUse):
        refuse(f"{place}, use", use, f"one of {', '.join(StallUse)}")
    if size and size not in set(SizeClass):
        refuse(f"{place}, size", size, f"one of {', '.join(SizeClass)}")
    mouth_at: Point | None = None
    if all(column in row for column in _RECTANGLE):
        corners = _rectangle(row, place)
        mouth_at = (corners[0][0] + corners[1][0]) / 2, (corners[0][1] + corners[1][1]) / 2
    else:
        values = [number_of(row[column], f"{place}, {column}") for column in _CORNERS]
        corners = [(x, -y) for x, y in zip(values[::2], values[1::2], strict=True)]
    parts.add_stall(
        name,
        corners,
        mouth_at=mouth_at,
        use=StallUse(use or StallUse.STANDARD),
        size=SizeClass(size or SizeClass.STANDARD),
        number=row.get("number", ""),
    )


def _rectangle(row: Mapping[str, str], place: str) -> list[Point]:
    """Return the corners (x, z) of a rectangle, those of its mouth first."""
    x, y = (number_of(row[column], f"{place}, {column}") for column in ("x", "y"))
    width_m, length_m = (positive_of(row[column], f"{place}, {column}") for column in ("width_m", "length_m"))
    heading = number_of(row["heading_deg"], f"{place}, heading_deg", most=_MOST_DEG, unit="degrees")
    heading_rad = math.radians(heading)
    cos, sin = elementary.cos(heading_rad), elementary.sin(heading_rad)
    ends = [(-1, 1), (-1, -1), (1, -1), (1, 1)]
    return [
        (
            x + along * length_m / 2 * cos - left * width_m / 2 * sin,
            -(y + along * length_m / 2 * sin + left * width_m / 2 * cos),
        )
        for along, left in ends
    ]
