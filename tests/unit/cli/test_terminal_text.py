"""Terminals get no control characters of files, no cursor where there is none, and no warnings of libraries."""

import io
import json
import os
import subprocess
import sys

import pytest
from click.testing import CliRunner

from garage2usd.cli import bars, main
from garage2usd.cli.process import ShownText

ESCAPES = "\x1b[2J\x1b]0;owned\x07\u202e"


def write_lot(path):
    stall = {"type": "Polygon", "coordinates": [[[0, 0], [2.5, 0], [2.5, 5], [0, 0]]]}
    properties = {"kind": "stall", "name": f"{ESCAPES}\nError: all is lost"}
    feature = {"type": "Feature", "properties": properties, "geometry": stall}
    whole = {**stall, "coordinates": [[[0, 0], [2.5, 0], [2.5, 5], [0, 5], [0, 0]]]}
    lane = {"type": "LineString", "coordinates": [[-5, 8], [9, 8]]}
    features = [
        feature,
        {"type": "Feature", "properties": {"kind": "stall", "name": "a"}, "geometry": whole},
        {"type": "Feature", "properties": {"kind": "lane"}, "geometry": lane},
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "coordinates": "metres", "features": features}))
    return path


def test_names_from_files_are_shown_on_one_line(tmp_path):
    result = CliRunner().invoke(
        main, ["import", str(write_lot(tmp_path / "a.geojson")), "--no-proofs", "-o", str(tmp_path / "a.usda")]
    )
    assert result.exit_code == 0
    (line,) = [line for line in result.stderr.splitlines() if line.startswith("not placed: ")]
    assert line == r"not placed: \x1b[2J\x1b]0;owned\x07\u202e\nError: all is lost: a stall of 3 corners instead of 4"


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_the_streams_of_the_program_show_control_characters(encoding):
    code = (
        "from garage2usd.cli.process import open_streams as o; import click; o(); click.echo('ä\\x1b[2J\\x9b\\r!\\t')"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, "PYTHONIOENCODING": encoding}, capture_output=True, check=True
    )
    shown = {"utf-8": "ä", "ascii": r"\xe4"}[encoding]
    assert said.stdout.decode() in {shown + r"\x9b\r!" + "\t\n", shown + r"\x1b[2J\x9b\r!" + "\t\n"}


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(("terminal", "has_cursor"), [("dumb", False), ("xterm", True)])
def test_bars_move_a_cursor_only_where_there_is_one(monkeypatch, terminal, has_cursor):
    monkeypatch.setenv("TERM", terminal)
    below = Terminal()
    with bars.Bars(ShownText(below)) as progress:
        progress("plan", 1, 2)
        progress.announce(f"read {ESCAPES}")
    assert ("\x1b[?25l" in below.getvalue()) == has_cursor
    assert r"\x1b]0;owned\x07\u202e" in below.getvalue()
    assert "\x1b]0" not in below.getvalue()


def test_messages_of_usd_are_told_without_its_source(tmp_path, capfd):
    path = tmp_path / "a.usda"
    path.write_text('#usda 1.0\n(defaultPrim = "Garage")\ndef Xform "Garage" (references = @nope.usda@)\n{\n}\n')
    assert CliRunner().invoke(main, ["check", str(path)]).exit_code == 1
    assert capfd.readouterr().err == ""
    result = CliRunner().invoke(main, ["export", str(path), "-o", str(tmp_path / "a.glb")])
    assert capfd.readouterr().err == ""
    (line,) = [line for line in result.stderr.splitlines() if "nope.usda" in line]
    assert line.startswith("in the stage: In </Garage>: Could not open asset @nope.usda@")
    assert "0x" not in line
