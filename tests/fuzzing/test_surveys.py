"""Damaged surveys of every format into ``import``: a hundred, and six hundred in the soak."""

import subprocess
import sys

import pytest
from support.fuzzing.survey_inputs import draw_survey_case
from support.sample_files import REPOSITORY
from support.soak import soak_but
from support.survey_files import program_files
from support.survey_texts import TEXTS

from garage2usd.survey.reader import SURVEY_SUFFIXES


@pytest.mark.parametrize("count", soak_but(1, [50, 100, 600]))
def test_a_damaged_survey_is_imported_or_ends_in_one_line_within_a_minute_and_a_gigabyte(count):
    command = [sys.executable, "-m", "support.fuzzing.survey_fuzz", "--count", str(count), "--seed", str(count)]
    run = subprocess.run(command, cwd=REPOSITORY / "tests", capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    assert f"{count} inputs" in run.stdout


def test_every_format_has_sound_files_that_are_damaged():
    sound = {f".{suffix}": [text.encode()] for suffix, text in TEXTS.items()} | program_files()
    assert sound.keys() | {".json", ".osm.xml"} >= set(SURVEY_SUFFIXES)
    cases = [draw_survey_case(sound, 1, number) for number in range(200)]
    changed = [next(iter(case.files.values())) not in sound[case.arguments[1][3:]] for case in cases]
    assert sum(changed) > 180
    assert cases == [draw_survey_case(sound, 1, number) for number in range(200)]
