"""Surveys that exhaust a reader, or mean something else than they say: read, or one line."""

import json
import subprocess
import sys
import time

import numpy as np
import pytest
from support.fuzzing.survey_inputs import ENTITIES
from support.survey_texts import TEXTS

from garage2usd.common.errors import ConfigError
from garage2usd.survey import geojson_survey, parts, text
from garage2usd.survey.reader import read_survey


def square(x, y, width, length):
    return [[x, y], [x + width, y], [x + width, y + length], [x, y + length], [x, y]]


def write(path, rings, **members):
    features = [
        {
            "type": "Feature",
            "properties": {"kind": kind},
            "geometry": {"type": "LineString" if kind == "lane" else "Polygon", "coordinates": coordinates},
        }
        for kind, coordinates in rings
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features, **members}))
    return path


@pytest.mark.parametrize("suffix", ["osm", "xodr"])
@pytest.mark.parametrize("entities", ENTITIES)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_entities_are_refused_before_they_are_expanded(tmp_path, suffix, entities, encoding):
    path = tmp_path / f"a.{suffix}"
    header = f'<?xml version="1.0" encoding="{encoding}"?>'
    path.write_bytes((header + entities + TEXTS[suffix]).encode(encoding))
    with pytest.raises(ConfigError, match="without a document type declaration"):
        read_survey(path)


def test_a_lot_on_the_antimeridian_is_that_of_any_other_place(tmp_path):
    size = 2.5e-5, 5e-5
    here = write(tmp_path / "a.geojson", [("stall", [square(9 + at * size[0], 0, *size)]) for at in range(-6, 6)])
    rings = [[[(x + 180) % 360 - 180, y] for x, y in square(180 + at * size[0], 0.0, *size)] for at in range(-6, 6)]
    there = write(tmp_path / "b.geojson", [("stall", [ring]) for ring in rings])
    one, other = read_survey(here), read_survey(there)
    corners = [np.array([stall.corners for stall in survey.stalls]) for survey in (one, other)]
    assert corners[0].shape == (12, 4, 2)
    np.testing.assert_allclose(*corners, atol=0.02)  # the origin is rounded to a tenth of a metre
    assert other.origin_deg == (pytest.approx(2.5e-5), pytest.approx(180, abs=1e-5))
    rings[0][0][0] -= 10
    with pytest.raises(ConfigError, match="points within 100 km of the others"):
        read_survey(write(tmp_path / "c.geojson", [("stall", [ring]) for ring in rings]))


def test_swapped_axes_are_said(tmp_path):
    turned = [[y, x] for x, y in square(116.4, 39.9, 2e-5, 5e-5)]
    with pytest.raises(ConfigError, match=r"the longitude comes first, and these seem to be swapped$"):
        read_survey(write(tmp_path / "a.geojson", [("stall", [turned])]))
    with pytest.raises(ConfigError, match=r'metres need the member "coordinates"'):
        read_survey(write(tmp_path / "a.geojson", [("stall", [square(512000.0, 4200000.0, 2.5, 5.0)])]))


def test_a_file_of_too_many_stalls_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(parts, "MOST_STALLS", 5)
    lot = [("stall", [square(2.5 * at, 0, 2.5, 5)]) for at in range(6)]
    with pytest.raises(ConfigError, match=r"more than 5 stalls'; allowed: 5 stalls in a file$"):
        read_survey(write(tmp_path / "a.geojson", lot, coordinates="metres"))
    assert len(read_survey(write(tmp_path / "a.geojson", lot[1:], coordinates="metres")).stalls) == 5


@pytest.mark.parametrize("suffix", ["osm", "xodr", "geojson"])
def test_a_file_that_would_take_a_gigabyte_is_not_read(tmp_path, monkeypatch, suffix):
    assert text._MOST_BYTES * 30 < 1024**3
    monkeypatch.setattr(text, "_MOST_BYTES", 100)
    monkeypatch.setattr(geojson_survey, "_MOST_BYTES", 100)
    path = tmp_path / f"a.{suffix}"
    path.write_text(TEXTS[suffix])
    with pytest.raises(ConfigError, match="a file of at most 100 bytes"):
        read_survey(path)


def test_outlines_of_very_many_points_are_simplified(tmp_path):
    turn = np.linspace(0, 2 * np.pi, 50_000)
    around = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    wave = [[x, 20 + np.sin(x)] for x in np.linspace(-30, 30, 50_000).tolist()]
    rings = [
        ("stall", [square(0, 0, 2.5, 5)]),
        ("stall", [(3 * around + (20, 0)).tolist()]),
        ("outline", [(50 * around).tolist()]),
        ("lane", wave),
    ]
    start = time.process_time()
    read = read_survey(write(tmp_path / "a.geojson", rings, coordinates="metres"))
    assert time.process_time() - start < 10
    assert len(read.stalls) == 1
    assert [part.reason.split(" of ")[0] for part in read.unread] == ["a stall"]
    assert 50 < len(read.outline) < 1000
    assert np.abs(np.hypot(*np.array(read.outline).T) - 50).max() < 0.02
    assert len(read.lanes[0].points) < 1000


def test_names_do_not_reach_the_terminal(tmp_path):
    lot = {
        "type": "Feature",
        "id": "\x1b]0;owned\x07\x1b[31m\u202e",
        "properties": {"kind": "stall", "number": "\x1b[2J7"},
        "geometry": {"type": "Polygon", "coordinates": [[*square(0, 0, 2.5, 5)[:3], [0, 0]]]},
    }
    whole = {**lot, "geometry": {"type": "Polygon", "coordinates": [square(0, 0, 2.5, 5)]}}
    lane = {**lot, "properties": {"kind": "lane"}, "geometry": {"type": "LineString", "coordinates": [[-9, 8], [9, 8]]}}
    path = tmp_path / "a.geojson"
    document = {"type": "FeatureCollection", "coordinates": "metres", "features": [lot, whole, lane]}
    path.write_text(json.dumps(document))
    command = [sys.executable, "-m", "garage2usd", "import", str(path), "-o", str(tmp_path / "o/a.usda"), "--no-proofs"]
    run = subprocess.run(command, capture_output=True, check=False)
    said = (run.stdout + run.stderr).decode()
    assert run.returncode == 0, said
    assert "not placed" in said
    assert not {"\x1b", "\x07", "\u202e"} & set(said)
