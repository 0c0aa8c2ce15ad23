"""Tables of tracks: read back they are equal, and readers of others find the same rows."""

import csv
import json
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from support.hand_made_tracks import car, hand_made, track_of, tracks_of
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.garage import garage_as_made
from garage2usd.common.errors import TracksError
from garage2usd.driving.tracks import COLUMNS, Tracks
from garage2usd.maps.track_tables import read_tracks, write_track_csv, write_track_parquet

WRITERS = {".parquet": write_track_parquet, ".csv": write_track_csv}


@pytest.fixture(scope="module")
def tracks():
    garage = garage_as_made(garage2usd.generate(garage2usd.GarageConfig(**SETTINGS)), source="garage", kind="plan")
    whole = hand_made(garage)
    return replace(whole, tracks=(*whole.tracks, replace(whole.tracks[0], agent=car('car_ö 1, "a"', "van", "grey"))))


def assert_equal(one, other):
    heads = [(t.step_s, t.duration_s, t.source, t.facts, t.log, [track.agent for track in t]) for t in (one, other)]
    assert heads[0] == heads[1]
    for track, same in zip(one, other, strict=True):
        assert track.stall == same.stall
        for name in (*COLUMNS, "state", "level"):
            column, expected = getattr(track, name), getattr(same, name)
            assert column.dtype == expected.dtype
            np.testing.assert_array_equal(column, expected)


@pytest.mark.parametrize("suffix", WRITERS)
def test_tables_come_back_equal_and_are_reproducible(tracks, suffix, tmp_path):
    files = [tmp_path / f"{name}{suffix}" for name in "ab"]
    for file in files:
        WRITERS[suffix](file, tracks)
    assert files[0].read_bytes() == files[1].read_bytes()
    assert_equal(read_tracks(files[0]), tracks.rounded())


@pytest.mark.parametrize("suffix", WRITERS)
def test_tracks_without_agents_come_back(suffix, tmp_path):
    empty = Tracks((), 0.1, 5.0, "g", {"seed": 1}, ("none came",))
    WRITERS[suffix](tmp_path / f"a{suffix}", empty)
    assert_equal(read_tracks(tmp_path / f"a{suffix}"), empty)


def test_a_stranger_reads_the_csv(tracks, tmp_path):
    write_track_csv(tmp_path / "a.csv", tracks)
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["agent"] == "car_000"]
    (track,) = (track for track in tracks if track.agent.name == "car_000")
    for name, digits in COLUMNS.items():
        np.testing.assert_allclose([float(row[name]) for row in rows], getattr(track, name), atol=0.6 * 10.0**-digits)
    assert [row["state"] for row in rows if row["stall"]] == ["parked", "parked"]
    heading = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert [agent["kind"] for agent in heading["agents"]].count("person") == 1
    assert heading["facts"]["seed"] == 3


def test_places_far_away_keep_their_decimals(tmp_path):
    far = tracks_of(track_of(car("car_000"), [0.0, 0.1], x_m=[123456.7891, 123456.7892], speed_m_s=0.0))
    write_track_parquet(tmp_path / "a.parquet", far)
    assert_equal(read_tracks(tmp_path / "a.parquet"), far.rounded())


def test_twenty_five_minutes_of_eighty_agents_take_three_megabytes(tmp_path):
    rng = np.random.default_rng(5)

    def one(number):
        times = np.round(np.arange(0, 150, 0.1) + 0.1 * int(rng.integers(13_000)), 6)
        turns = np.cumsum(np.cumsum(rng.normal(size=(8, len(times))) * 1e-3, axis=1), axis=1)
        names = [name for name in COLUMNS if name != "time_s"]
        return track_of(car(f"car_{number:03}"), times, **dict(zip(names, turns * 0.1, strict=True)))

    busy = replace(tracks_of(*map(one, range(80))), duration_s=1500.0)
    assert sum(map(len, busy)) == 120_000
    write_track_parquet(tmp_path / "a.parquet", busy)
    assert (tmp_path / "a.parquet").stat().st_size < 3e6


@pytest.mark.parametrize("suffix", WRITERS)
def test_what_is_no_table_of_tracks_is_one_line(tracks, suffix, tmp_path):
    file = tmp_path / f"a{suffix}"
    WRITERS[suffix](file, tracks)
    whole = file.read_bytes()
    for data in (b"", whole[: len(whole) // 2], b"agent,x_m\n1,2\n", whole.replace(b"parked", b"parket")):
        file.write_bytes(data)
        with pytest.raises(TracksError) as caught:
            read_tracks(file)
        assert "\n" not in str(caught.value)
    file.unlink()
    with pytest.raises(TracksError, match="No such file"):
        read_tracks(file)


def test_a_table_of_others_is_named(tmp_path):
    table = tmp_path / "a.parquet"
    pq.write_table(pa.table({"a": [1]}), table)
    with pytest.raises(TracksError, match=r"a\.parquet: is no table of tracks: has no garage2usd_tracks"):
        read_tracks(table)
    with pytest.raises(TracksError, match=r"ends in \.parquet or \.csv"):
        read_tracks(tmp_path / "a.txt")
