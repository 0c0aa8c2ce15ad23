"""The manifest of a data set: one row per garage with its properties, files and digests."""

import json
from collections.abc import Iterable, Sequence
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from garage2usd.common.settings import Record


class FileEntry(Record):
    """A file of a garage: suffix after the garage's key, size and SHA-256."""

    suffix: str
    bytes: int
    sha256: str


class LinkEntry(Record):
    """A ramp between two levels: its kind, such as ``straight``, their names, and the direction ``down`` or ``up``."""

    kind: str
    upper: str
    lower: str
    direction: str


class ManifestRow(Record):
    """The manifest row of a garage.

    Attributes
    ----------
    number
        Number of the garage, from 0.
    key
        Prefix of its files' paths, such as ``train-000003/00000312``; empty if it failed.
    split, shard
        Its split and shard, such as ``train`` and ``train-000003``.
    seed, attempt
        Its seed, and the number of the draw.
    alternatives
        Name of the alternative drawn from each group of the recipe.
    country
        ISO 3166 code of its profile's country; empty if the profile names none.
    config_digest, structure_digest
        As in its report.
    plan_digest
        Digest of its plan in squares, equal for rotations and reflections.
    rows, cols
        Shape of S.
    squares
        Number of squares inside the contour, on all levels.
    levels, level_stalls, links
        Number of levels, number of stalls for cars on each of them, the top one first, and the ramps between them.
    stalls, standard_stalls, ev_stalls, accessible_stalls
        Numbers of stalls for cars, in total and of the three uses.
    angled_stalls, parallel_stalls
        Numbers of stalls for cars at an angle to their lane and parallel to it; the others are perpendicular.
    stall_width_m, stall_length_m, aisle_width_m
        Medians over the perpendicular stalls of the standard size (over all stalls if there are none): their width and
        length, and the clear width between the columns of the aisle in front of them.
    cars, perpendicular_cars, nose_out_cars
        Numbers of parked cars, of those in perpendicular stalls, and of those among the latter that stand nose out.
    lanes_m, one_way_lanes_m
        Length of the lanes without portals and ramps, and of those that are one-way.
    loops, longest_dead_end_m, area_per_stall_m2, gross_area_per_stall_m2, stair_cores, mean_lux
        As in its report; over several levels the sum of the loops and of the cores, the longest dead end, and the means
        over all stalls; squares of ramps are ground of the gross area only.
    difficulty, difficulty_score
        Difficulty of the garage (`garage2usd.datasets.difficulty`); empty and -1 if it is not rated or no stall is
        proven.
    normal_stalls, complex_stalls, extreme_stalls, unproven_stalls
        Numbers of stalls for cars of each level, and of those without a proven drive; 0 if difficulty is not rated.
    arrivals, departures, walks
        Numbers of cars that arrive and leave while the garage is operated, and of walks of people; 0 without traffic.
    encounters, least_ttc_s, waits, longest_wait_s
        As of `garage2usd.traffic.encounters.Encounters`; the least time to a collision is -1 if there is none.
    check_errors, check_warnings
        Numbers of findings of the rules that `garage2usd build` checks.
    files
        Its files.
    error
        Reason for its failure; empty if it was made.
    """

    number: int
    key: str
    split: str
    shard: str
    seed: int
    attempt: int
    alternatives: dict[str, str]
    country: str = ""
    config_digest: str = ""
    structure_digest: str = ""
    plan_digest: str = ""
    rows: int = 0
    cols: int = 0
    squares: int = 0
    levels: int = 0
    level_stalls: tuple[int, ...] = ()
    links: tuple[LinkEntry, ...] = ()
    stalls: int = 0
    standard_stalls: int = 0
    ev_stalls: int = 0
    accessible_stalls: int = 0
    angled_stalls: int = 0
    parallel_stalls: int = 0
    stall_width_m: float = 0.0
    stall_length_m: float = 0.0
    aisle_width_m: float = 0.0
    cars: int = 0
    perpendicular_cars: int = 0
    nose_out_cars: int = 0
    lanes_m: float = 0.0
    one_way_lanes_m: float = 0.0
    loops: int = 0
    longest_dead_end_m: float = 0.0
    area_per_stall_m2: float = 0.0
    gross_area_per_stall_m2: float = 0.0
    stair_cores: int = 0
    mean_lux: float = 0.0
    difficulty: str = ""
    difficulty_score: float = -1.0
    normal_stalls: int = 0
    complex_stalls: int = 0
    extreme_stalls: int = 0
    unproven_stalls: int = 0
    arrivals: int = 0
    departures: int = 0
    walks: int = 0
    encounters: int = 0
    least_ttc_s: float = -1.0
    waits: int = 0
    longest_wait_s: float = 0.0
    check_errors: int = 0
    check_warnings: int = 0
    files: tuple[FileEntry, ...] = ()
    error: str = ""


_FILE = pa.struct([("suffix", pa.string()), ("bytes", pa.int64()), ("sha256", pa.string())])
_TYPES: dict[Any, pa.DataType] = {int: pa.int64(), float: pa.float64(), str: pa.string()}
_LINK = pa.struct([(name, pa.string()) for name in LinkEntry.model_fields])
_NESTED = {
    "alternatives": pa.string(),
    "files": pa.list_(_FILE),
    "level_stalls": pa.list_(pa.int64()),
    "links": pa.list_(_LINK),
}
MANIFEST_SCHEMA = pa.schema(
    [
        pa.field(name, _NESTED.get(name) or _TYPES[field.annotation], nullable=False)
        for name, field in ManifestRow.model_fields.items()
    ]
)
"""Columns of ``manifest.parquet``: the fields of `ManifestRow`, ``alternatives`` as JSON, none nullable."""


def manifest_table(rows: Sequence[ManifestRow]) -> pa.Table:
    """Convert manifest rows to a table."""
    return pa.Table.from_pylist([_record(row) for row in rows], schema=MANIFEST_SCHEMA)


def rows_of_table(table: pa.Table) -> list[ManifestRow]:
    """Convert a table to manifest rows."""
    return [_row(row) for row in table.to_pylist()]


def text_of_rows(rows: Iterable[ManifestRow]) -> str:
    """Format manifest rows as JSON lines with the table's columns."""
    return "".join(json.dumps(_record(row), separators=(",", ":")) + "\n" for row in rows)


def rows_of_text(text: str) -> list[ManifestRow]:
    """Parse manifest rows from JSON lines; raises ValueError for invalid lines."""
    return [_row(json.loads(line)) for line in text.splitlines()]


def table_bytes(table: pa.Table) -> bytes:
    """Serialize a table to reproducible Parquet bytes."""
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink, compression="zstd")
    return bytes(sink.getvalue())


def _row(values: dict[str, Any]) -> ManifestRow:
    return ManifestRow.model_validate({**values, "alternatives": json.loads(values["alternatives"])})


def _record(row: ManifestRow) -> dict[str, Any]:
    values = row.model_dump(mode="json")
    return {**values, "alternatives": json.dumps(values["alternatives"], sort_keys=True, separators=(",", ":"))}
