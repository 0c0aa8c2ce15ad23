"""Tracks as tables, one row for each sample: Parquet, and CSV with a JSON file beside it; and their reader."""

import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import TracksError
from garage2usd.common.package import VERSION, of_extra
from garage2usd.driving.tracks import COLUMNS, Agent, AgentClass, AgentState, Track, Tracks

with of_extra("a table of tracks", "traffic"):
    import pyarrow as pa
    import pyarrow.csv as pa_csv
    import pyarrow.parquet as pq

TABLE_SUFFIXES = (".parquet", ".csv")
"""Extensions of tables."""
_KEY = "garage2usd_tracks"
"""Key of the JSON text in the metadata of a Parquet file's schema."""
_FORM = 1
_STATES = [state.name.lower() for state in AgentState]
_LEVEL = 9
_FLOATS = {name: pa.float64() for name in COLUMNS}
_TYPES = {"agent": pa.string(), **_FLOATS, "state": pa.string(), "level": pa.int8(), "stall": pa.string()}


def write_track_parquet(path: Path, tracks: Tracks) -> None:
    """Write tracks as a Parquet file.

    Notes
    -----
    Rows are ordered by agent and time. The metadata of the schema hold step, duration, source, facts, log and agents as
    JSON under ``garage2usd_tracks``. Numbers have the decimals of `garage2usd.driving.tracks.COLUMNS`, in single
    precision where that preserves them.
    """
    table = _table(tracks)
    for number, (name, digits) in enumerate(COLUMNS.items(), 1):
        single = table[name].to_numpy().astype(np.float32)
        if (np.round(single.astype(np.float64), digits) == table[name].to_numpy()).all():
            table = table.set_column(number, name, pa.array(single))
    # the bytes of numbers that change steadily compress best by their significance
    pq.write_table(
        table.replace_schema_metadata({_KEY: json.dumps(_heading(tracks), sort_keys=True)}),
        path,
        compression="zstd",
        compression_level=_LEVEL,
        use_dictionary=["agent", "state", "level", "stall"],
        column_encoding=dict.fromkeys(COLUMNS, "BYTE_STREAM_SPLIT"),
        row_group_size=max(table.num_rows, 1),
    )


def write_track_csv(path: Path, tracks: Tracks) -> tuple[Path, ...]:
    """Write tracks as CSV, and step, duration, source, facts, log and agents as JSON beside it; return both files."""
    heading = path.with_suffix(".json")
    pa_csv.write_csv(_table(tracks), path, pa_csv.WriteOptions(quoting_style="needed"))
    heading.write_bytes(f"{json.dumps(_heading(tracks), indent=1, sort_keys=True)}\n".encode())
    return path, heading


def read_tracks(path: str | Path) -> Tracks:
    """Read tracks from a table that `write_track_parquet` or `write_track_csv` wrote.

    Raises
    ------
    TracksError
        If the file, or the JSON file beside a CSV, is missing, damaged or of another form.
    """
    place = Path(path)
    if place.suffix.lower() not in TABLE_SUFFIXES:
        raise TracksError(path, f"the path of a table of tracks ends in {' or '.join(TABLE_SUFFIXES)}")
    try:
        if place.suffix.lower() == ".parquet":
            with place.open("rb") as file:
                table = pq.ParquetFile(file).read()
            heading = json.loads((table.schema.metadata or {})[_KEY.encode()])
        else:
            heading = json.loads(place.with_suffix(".json").read_text(encoding="utf-8"))
            # an empty text is a stall without a name
            options = pa_csv.ConvertOptions(column_types=_TYPES, strings_can_be_null=False)
            table = pa_csv.read_csv(place, convert_options=options)
        return _tracks(table, heading)
    except KeyError as error:
        name = error.args[0].decode() if isinstance(error.args[0], bytes) else error.args[0]
        raise TracksError(path, f"is no table of tracks: has no {name}") from None
    except (pa.ArrowException, OSError, ValueError, TypeError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error).partition("\n")[0]
        raise TracksError(path, f"is no table of tracks: {reason}") from None


def _table(tracks: Tracks) -> "pa.Table":
    """Make the table of the rounded samples."""
    whole = tracks.rounded().tracks
    columns = {name: pa.array(_joined([getattr(track, name) for track in whole], np.float64)) for name in COLUMNS}
    names = [[""], *([name for _, _, name in track.stall] for track in whole)]
    stalls = {name: number for number, name in enumerate(dict.fromkeys(name for own in names for name in own))}
    counts = list(map(len, whole))
    codes = {
        "agent": (np.repeat(np.arange(len(whole)), counts), [track.agent.name for track in whole]),
        "state": (_joined([track.state for track in whole], np.int8), _STATES),
        "stall": (_joined([_stall_codes(track, stalls) for track in whole], np.int32), [*stalls]),
    }
    columns |= {
        name: pa.DictionaryArray.from_arrays(pa.array(code.astype(np.int32)), pa.array(words, pa.string()))
        for name, (code, words) in codes.items()
    }
    columns["level"] = pa.array(_joined([track.level for track in whole], np.int8))
    return pa.table({name: columns[name] for name in _TYPES})


def _joined(columns: list[NDArray[Any]], kind: type[np.generic]) -> NDArray[Any]:
    joined: NDArray[Any] = np.concatenate([np.zeros(0, kind), *columns]).astype(kind)
    return joined


def _stall_codes(track: Track, stalls: Mapping[str, int]) -> NDArray[np.int32]:
    codes = np.zeros(len(track), np.int32)
    for start, end, name in track.stall:
        codes[start:end] = stalls[name]
    return codes


def _heading(tracks: Tracks) -> dict[str, object]:
    """All of the tracks that is not a sample."""
    return {
        "form": _FORM,
        "version": VERSION,
        "step_s": tracks.step_s,
        "duration_s": tracks.duration_s,
        "source": tracks.source,
        "facts": dict(tracks.facts),
        "log": list(tracks.log),
        "samples": sum(map(len, tracks)),
        "agents": [asdict(track.agent) for track in tracks],
    }


def _tracks(table: "pa.Table", heading: Mapping[str, Any]) -> Tracks:
    if heading["form"] != _FORM:
        raise ValueError(f"its form is {heading['form']}, not {_FORM}")
    if heading["samples"] != table.num_rows:
        raise ValueError(f"{table.num_rows} of {heading['samples']} samples are there")
    columns = {name: np.round(table[name].to_numpy().astype(np.float64), digits) for name, digits in COLUMNS.items()}
    words = {name: table[name].combine_chunks().dictionary_encode() for name in ("agent", "state", "stall")}
    codes = {name: _codes(column) for name, column in words.items()}
    number_of = {name: int(AgentState[name.upper()]) for name in words["state"].dictionary.to_pylist()}
    state = np.array([number_of[name] for name in words["state"].dictionary.to_pylist()], np.int8)[codes["state"]]
    level = table["level"].to_numpy().astype(np.int8)
    stalls = words["stall"].dictionary.to_pylist()
    borders = np.flatnonzero(np.diff(codes["agent"], prepend=-1, append=-1)) if table.num_rows else np.zeros(1, int)
    agents = words["agent"].dictionary.to_pylist()
    rows = {agents[codes["agent"][start]]: slice(start, end) for start, end in pairwise(borders.tolist())}
    if len(rows) != len(borders) - 1:
        raise ValueError("rows of an agent do not follow one another")
    found = []
    for entry in heading["agents"]:
        agent = Agent(
            **{**{field.name: entry[field.name] for field in fields(Agent)}, "kind": AgentClass(entry["kind"])}
        )
        own = rows.pop(agent.name)
        samples = {name: column[own] for name, column in columns.items()}
        stall = _intervals(codes["stall"][own], stalls)
        found.append(Track(agent, **samples, state=state[own], level=level[own], stall=stall))
    if rows:
        raise ValueError(f"{next(iter(rows))} is none of its agents")
    return Tracks(
        tuple(found),
        heading["step_s"],
        heading["duration_s"],
        heading["source"],
        heading["facts"],
        tuple(heading["log"]),
    )


def _codes(column: "pa.DictionaryArray") -> NDArray[np.int64]:
    codes: NDArray[np.int64] = column.indices.to_numpy(zero_copy_only=False).astype(np.int64)
    return codes


def _intervals(codes: NDArray[np.int64], names: list[str]) -> tuple[tuple[int, int, str], ...]:
    """Stalls of samples as (first, past the last, name)."""
    borders = [0, *(np.flatnonzero(np.diff(codes)) + 1).tolist(), len(codes)]
    return tuple(
        (start, end, names[codes[start]]) for start, end in pairwise(borders) if start < end and names[codes[start]]
    )
