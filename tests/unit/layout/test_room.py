"""Sizes that no garage can have are refused with the setting at fault; what can be built says what its check finds."""

import pytest
from click.testing import CliRunner

from garage2usd import GarageConfig, build
from garage2usd.as_built.garage import garage_as_made
from garage2usd.checks import RULES, check_layout, findings_of
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.layout.parking.stalls import tight_stalls
from garage2usd.pipeline import generate

QUICK = {"episodes": 30, "starts": 1}
DRAWING = "....\nE==X\n...."
TURNED_AWAY = """
#######
E====.#
#..=..X
#..====
#..=..#
#######
"""
UNIFORM = {"dimensioned": False}


@pytest.mark.parametrize("structure", [None, DRAWING], ids=["planned", "given"])
@pytest.mark.parametrize(
    ("bay", "field", "least"),
    [
        ({"square_side_m": 5.0}, "bay.square_side_m", "at least 5.3 m"),
        ({"square_side_m": 5.29}, "bay.square_side_m", "at least 5.3 m"),
        ({"square_side_m": 6.0, "stall_length_m": 7.0}, "bay.square_side_m", "at least 7 m"),
        ({"square_side_m": 6.0, "stall_width_m": 5.5}, "bay.square_side_m", "at least 6.1 m"),
        ({"column_widths_m": 5.0, "row_depths_m": 5.2}, "bay.column_widths_m, bay.row_depths_m", "3 and 5.3 m"),
    ],
)
def test_squares_too_small_for_any_stall_are_named_before_planning(structure, bay, field, least):
    site = {} if structure is None else {"structure": structure}
    with pytest.raises(ConfigError) as caught:
        generate(GarageConfig(site=site, bay={**UNIFORM, **bay}, plan={"episodes": 1_000_000, "starts": 1000}))
    assert caught.value.field == field
    assert least in str(caught.value)


def test_the_least_square_that_is_told_holds_a_stall():
    garage = generate(GarageConfig(site={"structure": DRAWING}, bay={**UNIFORM, "square_side_m": 5.3}))
    assert len(garage.layout.stalls) == 4


def test_stalls_are_in_doubt_beside_narrow_aisles_alone():
    wide, narrow = (
        generate(GarageConfig(seed=1, plan=QUICK, bay={**UNIFORM, "square_side_m": side})) for side in (6.2, 6.19)
    )
    assert not tight_stalls(wide.layout.lane_graph, wide.layout.quads)
    lanes = narrow.layout.lane_graph
    found = tight_stalls(lanes, narrow.layout.quads)
    assert found == tuple(stall for stall in narrow.layout.quads if stall.takes_cars)
    aisles = [lanes.clear_aisle_m(stall.access, stall.outwards) for stall in found]
    assert aisles == pytest.approx([5.49] * len(found))


def test_default_garages_need_no_proof(monkeypatch):
    def fail(*_args, **_options):
        raise AssertionError("a garage that is in no doubt was proven")

    monkeypatch.setattr("garage2usd.pipeline.refuse_undrivable", fail)
    for dimensioned in (False, True):
        generate(GarageConfig(seed=2, plan=QUICK, bay={"dimensioned": dimensioned}))
    with pytest.raises(AssertionError, match="no doubt"):
        generate(GarageConfig(seed=2, plan=QUICK, bay={**UNIFORM, "square_side_m": 5.4}))


def test_what_cannot_be_driven_is_refused_and_leaves_its_plan(tmp_path):
    (tmp_path / "g.toml").write_text(
        f'[site]\nstructure = """{TURNED_AWAY}"""\n'
        "[bay]\nrow_depths_m = [8.1, 8.1, 5.4, 3.2, 5.4, 8.1]\ncolumn_widths_m = 8.1\n"
    )
    arguments = ["build", str(tmp_path / "g.toml"), "-o", str(tmp_path / "out" / "g.usda")]
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 1
    assert "bay.row_depths_m" in result.output
    assert "not into Stall_r0" in result.output
    assert {file.name for file in (tmp_path / "out").iterdir()} == {"g_failed_plan.json", "g_failed_plan.png"}
    assert "kept, as far as it was planned: " in result.output


@pytest.mark.parametrize("side_m", [8.1, 5.4])
def test_a_build_says_what_its_check_finds(side_m, tmp_path):
    site = f'[site]\nstructure = """{DRAWING}"""\n'
    (tmp_path / "g.toml").write_text(f"{site}[bay]\nsquare_side_m = {side_m}\ndimensioned = false\n")
    result = CliRunner().invoke(main, ["build", str(tmp_path / "g.toml"), "-o", str(tmp_path / "g.usda")])
    assert result.exit_code == 0, result.output
    (line,) = (line for line in result.output.splitlines() if line.split()[0] == "check")
    told = CliRunner().invoke(main, ["check", str(tmp_path / "g_report.json")])
    errors, warnings, infos = (
        int(word) for word in told.output.splitlines()[-1].replace(",", "").split() if word.isdigit()
    )
    words = [("error", errors), ("warning", warnings), ("remark", infos)]
    expected = ", ".join(f"{count} {word}{'s' * (count != 1)}" for word, count in words if count)
    assert f" clauses of cn-jgj100 checked: {expected} (" in line
    assert line.endswith(f"garage2usd check {tmp_path / 'g_report.json'}")
    assert bool(errors) == (side_m < 8)


def test_the_check_of_a_build_is_that_of_its_report_without_the_long_rules(tmp_path):
    config = GarageConfig(site={"structure": DRAWING}, bay={"square_side_m": 5.4, "dimensioned": False})
    made = build(config, tmp_path / "g.usda")
    garage = made.garage
    subject = garage_as_made(garage, source="", kind="report")
    assert list(made.findings) == findings_of(subject, config.standard) == check_layout(garage.layout, config)
    assert (
        {"aisle-width", "portal-width"} <= {finding.rule for finding in made.findings} < {rule.name for rule in RULES}
    )
