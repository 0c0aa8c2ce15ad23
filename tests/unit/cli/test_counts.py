"""How many stalls a garage has, and its floor for each, is one figure wherever it is told."""

import json
import re
import struct
import tarfile
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from click.testing import CliRunner
from support.data_sets import SMALL, small_recipe

from garage2usd.as_built.garage import garage_as_made
from garage2usd.checks import findings_of
from garage2usd.cli import main
from garage2usd.config import GarageConfig
from garage2usd.datasets import make_dataset
from garage2usd.datasets.making import PAGE_FILE
from garage2usd.garage import StallUse
from garage2usd.pipeline import generate
from garage2usd.profiles import read_profile
from garage2usd.reading.files import open_stage
from garage2usd.reading.report import read_report
from garage2usd.view.drawing import to_svg
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.viewer import read_scene
from garage2usd.view.viewer.wire import encode_scene

SEED = 3
SITE = "........\n.======.\n.=....=.\n.=....=.\n.======X\n.=......\nE=......" + 6 * "\n.=......"
"""With a dead end so long that a stall is kept free for turning."""
SETTINGS = {"seed": SEED, "site": {"structure": SITE}, "parking": {"accessible_share": 0.1}}


@pytest.fixture(scope="module")
def garage():
    made = generate(GarageConfig(**SETTINGS))
    uses = {stall.use for stall in made.layout.stalls}
    assert {StallUse.TURNING, StallUse.ACCESS_AISLE} <= uses
    return made


@pytest.fixture(scope="module")
def counted(garage):
    """What is counted by hand: stalls that cars park in, and the floor for each of them."""
    structure = garage.layout.structure
    stalls = sum(stall.use not in {"turning", "access_aisle", "unreachable"} for stall in garage.layout.stalls)
    assert 0 < stalls < len(garage.layout.stalls)
    floor = np.outer(structure.row_depths_mm / 1000, structure.column_widths_mm / 1000)[structure.cells != -1].sum()
    return stalls, float(floor / stalls)


@pytest.fixture(scope="module")
def built(garage, tmp_path_factory):
    folder = tmp_path_factory.mktemp("counts")
    lines = [f"seed = {SEED}", '[site]\nstructure = """', SITE, '"""', "[parking]", "accessible_share = 0.1"]
    (folder / "g.toml").write_text("\n".join(lines))
    result = CliRunner().invoke(main, ["build", str(folder / "g.toml"), "-o", str(folder / "g.usda")])
    assert result.exit_code == 0, result.output
    return folder, result.output


def test_build_and_report_tell_the_same(counted, built):
    stalls, area_m2 = counted
    folder, told = built
    report = json.loads((folder / "g_report.json").read_text())
    assert re.search(rf"^ +stalls  {stalls} \(.*; kept free: .*access aisle", told, re.MULTILINE)
    assert f"m2/stall  {area_m2:.1f} net, {area_m2:.1f} gross, with ramps and obstacles\n" in told
    assert len(re.findall(r"m2.{0,4}stall", told)) == 1
    assert report["parking_stalls"] == stalls
    assert report["area_per_stall_m2"] == pytest.approx(area_m2, abs=1e-3)
    assert sum(part["stalls"] for part in report["levels"][0]["fire_compartments"]) == stalls


def test_the_plan_tells_it_twice(counted, garage):
    stalls, area_m2 = counted
    sheet = ET.fromstring(to_svg(draw_plan(garage.layout)))
    told = " ".join(sheet.itertext())
    assert {int(number) for number in re.findall(r"(\d+) stalls", told)} == {stalls}
    assert f"{area_m2:.1f} m2 a stall" in told


def test_check_and_viewer_count_so(counted, garage, built):
    stalls, _ = counted
    steps = {"steps": [[10, 1]], "above_percent": 100, "unit": "count", "source": "us", "confidence": "low"}
    subject = garage_as_made(garage, source="", kind="report")
    profile = read_profile({"name": "client", "accessible_stalls": steps})
    (finding,) = (finding for finding in findings_of(subject, profile) if finding.rule == "accessible-count")
    assert (finding.required, finding.message) == (stalls, f"too few accessible stalls among {stalls}")
    folder, _ = built
    data = encode_scene(read_scene(open_stage(folder / "g.usda"), folder / "g.usda"))
    header = json.loads(data[8 : 8 + struct.unpack_from("<I", data, 4)[0]])
    assert header["lanes"]["parkingStalls"] == stalls


def test_a_data_set_counts_so(tmp_path):
    garage = {**SMALL["garage"], "parking": {"accessible_share": 0.2}}
    recipe = small_recipe(count=1, splits={"train": 1}, shards={"garages": 1}, garage=garage)
    (row,) = make_dataset(recipe, tmp_path / "set").rows
    with tarfile.open(tmp_path / "set" / "shards" / "train-000000.tar") as archive:
        (name,) = (name for name in archive.getnames() if name.endswith("report.json"))
        told = json.load(archive.extractfile(name))
    (uses,) = (level["stall_uses"] for level in told["levels"])
    kept_free = {"access_aisle", "turning", "unreachable"} & uses.keys()
    stalls = sum(count for use, count in uses.items() if use not in kept_free)
    assert kept_free
    assert row.stalls == told["parking_stalls"] == stalls == row.standard_stalls + row.ev_stalls + row.accessible_stalls
    assert row.area_per_stall_m2 == told["area_per_stall_m2"]
    page = (tmp_path / "set" / PAGE_FILE).read_text()
    assert f"{stalls} stalls, {row.area_per_stall_m2:.1f} m2 a stall" in page


def test_a_report_of_before_is_read(built):
    folder, _ = built
    report = json.loads((folder / "g_report.json").read_text())
    figures = {"value": 50.0, "stalls": 80}
    report["levels"][0]["learning"] = {
        "learnt": {**figures, "area_per_stall_m2": 30.5},
        "polish": {**figures, "area_per_stall_m2": -1.0},
        "episodes": 1,
        "steps": 1,
    }
    del report["parking_stalls"], report["levels"][0]["not_designed_to"]
    (folder / "old_report.json").write_text(json.dumps(report))
    learning = read_report(folder / "old_report.json").levels[0].learning
    assert (learning.learnt.area_per_planned_stall_m2, learning.polish.area_per_planned_stall_m2) == (30.5, -1.0)
