"""``garage2usd check`` and ``build --profile`` on the command line."""

import json
import time

import pytest
from click.testing import CliRunner
from pxr import Usd
from support.small_garage import PLAN, SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.cli import main

RING = "...E...\n.=====.\n.=...=.\n.=...=.\n.=====.\n...X..."


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("made") / "g.usdz")


def test_stage_and_report_of_a_build_say_the_same(made):
    tables = []
    for path in (made.stage, made.report):
        result = run("check", path)
        assert result.exit_code == 0, result.output
        tables.append(result.output)
    assert tables[0] == tables[1]
    header, finding, clauses, summary = tables[0].splitlines()
    assert header.split()[:3] == ["severity", "rule", "place"]
    assert finding.split()[:2] == ["warning", "personnel-exits"]
    assert clauses == "35 clauses of cn-jgj100 checked"
    assert summary == "checked against cn-jgj100: 0 error, 1 warning, 0 info"
    assert "certified" not in tables[0]


def test_json_holds_every_finding_with_its_figures(tmp_path):
    settings = f'[site]\nstructure = """{RING}"""\n[bay]\nstall_width_m = 2.3\ndimensioned = false\n'
    (tmp_path / "plan.toml").write_text(settings)
    result = run("check", tmp_path / "plan.toml", "--json")
    assert result.exit_code == 1
    document = json.loads(result.stdout)
    assert document["checked_against"] == "cn-jgj100"
    found = [finding for finding in document["findings"] if finding["rule"] == "stall-width"]
    assert document["counts"]["error"] == len(found) > 20
    assert found[0].keys() >= {"place", "position_m", "severity", "source", "message"}
    assert (found[0]["measured"], found[0]["required"], found[0]["unit"]) == (2.3, 2.4, "m")
    table = run("check", tmp_path / "plan.toml").output.splitlines()
    assert sum("stall-width" in line for line in table) == 11
    assert f"... and {len(found) - 10} more of stall-width" in table


def test_another_profile_asks_for_other_things(made):
    result = run("check", made.stage, "--profile", "us-ada")
    assert result.exit_code == 1
    assert "stall-width" in result.output
    assert "8.5 ft" not in result.output
    assert "2.591 m" in result.output


def test_a_stage_says_what_it_was_designed_to(tmp_path):
    (tmp_path / "g.toml").write_text(f'[site]\nstructure = """{PLAN}"""\n[stage]\ntexture_quality = "low"\n')
    result = run("build", tmp_path / "g.toml", "--profile", "us-ada", "--output", tmp_path / "g.usda")
    assert result.exit_code == 0, result.output
    stage = Usd.Stage.Open(str(tmp_path / "g.usda"))
    assert stage.GetDefaultPrim().GetCustomDataByKey("profile") == "us-ada"
    assert json.loads((tmp_path / "g_report.json").read_text())["config"]["profile"] == "us-ada"
    for name in ("g.usda", "g_report.json"):
        checked = run("check", tmp_path / name)
        assert checked.exit_code == 0, checked.output
        assert "checked against us-ada: 0 error" in checked.output


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["none.usda"], 1, "PATH: got 'none.usda'; allowed: an existing file"),
        (["."], 2, "is a directory"),
        (["plan.txt", "--profile", "iso"], 2, "one of cn-jgj100, de-garvo, uk-istructe, us-ada"),
        (["empty.txt"], 1, "rows of equal length"),
        (["--rules"], 2, "No such option"),
    ],
)
def test_bad_usage_is_said_in_one_line(arguments, code, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plan.txt").write_text(PLAN)
    (tmp_path / "empty.txt").write_text("")
    result = run("check", *arguments)
    assert result.exit_code == code, result.output
    assert said in result.output


def test_a_small_stage_is_checked_in_a_moment(made):
    start = time.process_time()
    run("check", made.stage)
    assert time.process_time() - start < 5
