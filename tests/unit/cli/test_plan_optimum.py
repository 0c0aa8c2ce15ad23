"""`garage2usd plan --optimum`: the proven optimum beside the score of a plan."""

import re

import pytest
from click.testing import CliRunner
from support.planning_reference import OPTIMUM, drawn, score
from support.sample_files import SAMPLES

import garage2usd
from garage2usd.cli import main

GATE = """
[site]
structure = '''
{drawing}
'''
[bay]
square_side_m = 8.1
[plan]
circulation = "{circulation}"
dead_ends = "allow"
"""
COMB = "\n".join([".=..=..=."] * 5 + [".=======.", "..E...X.."])
LOOPS = 69.8571
"""Proven by another program for dead ends of two squares."""


def told(tmp_path, text, *arguments):
    (tmp_path / "garage.toml").write_text(text)
    picture = tmp_path / "plan.svg"
    result = CliRunner().invoke(main, ["plan", str(tmp_path / "garage.toml"), "-o", str(picture), *arguments])
    return result, picture


def figures(output):
    return dict(re.findall(r"^ *(score|optimum)  (.*)$", output, re.MULTILINE))


def test_a_plan_is_told_as_a_share_of_the_proven_optimum(tmp_path):
    result, picture = told(tmp_path, GATE.format(drawing=COMB, circulation="allow"), "--optimum")
    assert result.exit_code == 0, result.output
    value, best = score(drawn(COMB))[0], OPTIMUM["G1"]
    assert figures(result.output) == {
        "score": f"{value:.2f}",
        "optimum": f"proven optimum {best:.2f}; this plan has {100 * value / best:.1f} % of it",
    }
    assert picture.exists()


def test_a_plan_that_breaks_the_rules_is_told_as_such(tmp_path):
    result, _ = told(tmp_path, GATE.format(drawing=COMB, circulation="loops"), "--optimum")
    assert figures(result.output)["optimum"] == (
        f"proven optimum {LOOPS:.2f}; this plan has more, as it breaks the rules of circulation"
    )


def test_an_optimum_below_zero_has_no_shares(tmp_path):
    text = GATE.format(drawing="E===X\n.....", circulation="allow") + "parking_time_weight = -40.0\n"
    result, _ = told(tmp_path, text, "--optimum")
    assert re.fullmatch(r"proven optimum -[0-9.]+; this plan has [0-9.]+ less", figures(result.output)["optimum"])


def test_without_the_option_nothing_is_proven(tmp_path):
    result, _ = told(tmp_path, GATE.format(drawing=COMB, circulation="allow"))
    assert figures(result.output) == {}


@pytest.mark.parametrize(
    ("plan", "said"),
    [
        ("", "site: got '11 x 16 squares'; allowed: a side of at most 10 with dead ends of up to 2 squares"),
        ("longest_stretch_cells = 12", "plan.longest_stretch_cells: got 12; allowed: 0"),
    ],
)
def test_a_site_that_is_too_large_is_refused_in_one_line(tmp_path, plan, said):
    rows = ["E" + "=" * 14 + "X"] + ["." * 16] * (10 if not plan else 3)
    result, picture = told(tmp_path, GATE.format(drawing="\n".join(rows), circulation="loops") + plan, "--optimum")
    assert result.exit_code == 1
    (line,) = result.output.strip().splitlines()
    assert said in line
    assert not picture.exists()


def test_the_package_has_the_function():
    config = garage2usd.load_config(next(path for path in SAMPLES if path.stem == "paper_7x9"))
    garage = garage2usd.generate(config)
    best = garage2usd.find_optimum(garage.plan.structure, bay=config.bay, plan=config.plan, known=garage.plan.structure)
    assert isinstance(best, garage2usd.Optimum)
    assert best.score.value >= garage.plan.score.value
    again = garage2usd.generate(garage2usd.GarageConfig(site={"structure": str(best.structure)}, bay=config.bay))
    assert again.plan.score.value == pytest.approx(best.score.value)
