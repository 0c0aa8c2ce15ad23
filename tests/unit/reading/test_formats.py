"""The report and the table of labels: one model each, from which the very file is written and by which all read it."""

import json
import math
from operator import delitem, setitem

import pytest
from click.testing import CliRunner
from pxr import Usd
from support.sample_files import SAMPLES

from garage2usd.cli import main
from garage2usd.common.documents import json_text
from garage2usd.common.errors import ReportError, StageError
from garage2usd.config import GarageConfig
from garage2usd.garage_sources import check
from garage2usd.reading.label_table import read_label_table
from garage2usd.reading.labels import read_labels
from garage2usd.reading.report import read_report
from garage2usd.view.viewer.reading import read_scene


@pytest.fixture(scope="module")
def build(builds):
    return builds(next(path for path in SAMPLES if path.stem == "paper_7x9"), "usdc")


def test_a_report_that_was_read_is_written_as_it_was(build):
    report = read_report(build.report)
    assert json_text(report.model_dump(mode="json")) == build.report.read_text()
    assert report.config == build.garage.config
    assert report.garage_config().site.structure == str(build.garage.plan.structure)
    assert [stall.centre_m for stall in report.levels[0].stalls] == [
        stall.centre_m for stall in build.garage.layout.stalls
    ]


def test_a_table_that_was_read_holds_what_was_written(build):
    table = read_label_table(build.stage)
    assert table.model_dump(mode="json") == json.loads(build.labels.read_text())


def level(report):
    (only,) = report["levels"]
    return only


REPORTS = {
    "seed: Field required": lambda report: report.pop("seed"),
    "levels.0.R.2: got 'wide'; allowed: a number": lambda report: level(report)["R"].insert(2, "wide"),
    "levels.0.S.0: got 7; allowed: text": lambda report: level(report)["S"].insert(0, 7),
    "levels.0.score.stalls: got 0.5; allowed: a whole number": lambda report: report["levels"][0]["score"].update(
        stalls=0.5
    ),
    "levels.0.unreachable_stalls.0: got 3; allowed: text": lambda report: report["levels"][0].update(
        unreachable_stalls=[3]
    ),
}


@pytest.mark.parametrize("said", REPORTS)
def test_all_who_read_a_report_name_what_is_wrong_alike(build, tmp_path, said):
    document = json.loads(build.report.read_text())
    REPORTS[said](document)
    path = tmp_path / "g_report.json"
    path.write_text(json.dumps(document))
    with pytest.raises(ReportError) as caught:
        read_report(path)
    assert str(caught.value).startswith(f"{path}: not a report of a build: {said}")
    with pytest.raises(ReportError) as caught:
        check(path)
    assert said in str(caught.value)


def test_a_wrong_setting_in_a_report_is_named_as_one(build, tmp_path):
    document = json.loads(build.report.read_text())
    document["config"]["fittings"]["lane_lux"] = -1
    (tmp_path / "g_report.json").write_text(json.dumps(document))
    for command in ("plan", "check"):
        result = CliRunner().invoke(main, [command, str(tmp_path / "g_report.json")])
        assert result.exit_code == 1
        assert "fittings.lane_lux: got -1; allowed: " in result.output


def test_a_report_of_another_version_may_lack_what_nobody_reads(build, tmp_path):
    document = json.loads(build.report.read_text())
    of_whole = {key: document[key] for key in ("seed", "config")}
    (level,) = document["levels"]
    matrices = {key: level[key] for key in ("S", "R", "C")}
    for kept in (
        {**of_whole, "levels": [{"name": "U1", "floor_m": 0.0, **matrices}], "of_tomorrow": 1},
        {**of_whole, **matrices},  # the first form, which had no levels
    ):
        (tmp_path / "g_report.json").write_text(json.dumps(kept))
        again = read_report(tmp_path / "g_report.json").garage_config()
        assert again == read_report(build.report).garage_config()
        findings, _ = check(tmp_path / "g_report.json")
        assert not [finding for finding in findings if finding.rule == "report-stalls"]


def test_the_first_form_of_a_report_of_several_levels_is_read(tmp_path):
    garage = GarageConfig(seed=1, building={"levels": 2}).model_dump(mode="json")
    level = {"S": ["E.X"], "R": [8.1] * 3, "C": [8.1], "seed": 2, "config": garage}
    levels = [{"name": name, "floor_m": floor_m, "report": level} for name, floor_m in (("U1", 0.0), ("U2", -3.6))]
    path = tmp_path / "g_report.json"
    path.write_text(json.dumps({"seed": 1, "config": garage, "tape": "a/b/c", "links": [], "levels": levels}))
    read = read_report(path)
    assert [(each.name, each.floor_m, each.S) for each in read.levels] == [
        ("U1", 0.0, ("E.X",)),
        ("U2", -3.6, ("E.X",)),
    ]
    assert (read.seed, read.tape) == (1, "a/b/c")


def wall(table, number):
    return table["objects"]["/Garage/Walls"][number]


TABLES = {
    "objects./Garage/Walls.3.1: got 0; allowed: greater than or equal": lambda table: setitem(wall(table, 3), 1, 0),
    "objects./Garage/Walls.2.2: Field required": lambda table: delitem(wall(table, 2), slice(2, None)),
    "objects./Garage/Walls.1.3.0: got 'x'; allowed: a number": lambda table: setitem(wall(table, 1)[3], 0, "x"),
    "objects./Garage/Walls.1.4.2: got nan; allowed: a finite": lambda table: setitem(wall(table, 1)[4], 2, math.nan),
    "a path or an id occurs twice": lambda table: table["objects"]["/Garage/Walls"].append(wall(table, 0)),
    "objects: got []; allowed: an object": lambda table: table.update(objects=[]),
    "columns.0: got 'id'; allowed: 'name'": lambda table: setitem(table["columns"], 0, "id"),
    "classes.0.id: got 256; allowed: less than or equal to 255": lambda table: table["classes"][0].update(id=256),
}


@pytest.mark.parametrize("said", TABLES)
def test_viewer_and_renderer_refuse_a_table_of_labels_alike(build, tmp_path, said):
    table = json.loads(build.labels.read_text())
    TABLES[said](table)
    (tmp_path / "g_labels.json").write_text(json.dumps(table))
    stage = Usd.Stage.Open(str(build.stage))
    for read in (read_labels, read_scene):
        with pytest.raises(StageError) as caught:
            read(stage, tmp_path / "g.usdc")
        assert str(caught.value).startswith(f"{tmp_path / 'g_labels.json'}: not a table of labels: {said}")
