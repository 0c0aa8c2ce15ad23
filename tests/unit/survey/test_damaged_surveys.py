"""Whatever stands in a file, a survey is read or one error of garage2usd names what is wrong."""

import math
import re

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.survey_texts import TEXTS

from garage2usd.common.errors import Garage2UsdError
from garage2usd.survey.reader import read_survey

PIECES = [
    "0",
    "-1",
    "1e309",
    "nan",
    "1e12",
    "",
    "abc",
    "[]",
    "{}",
    "null",
    '"',
    "<",
    ">",
    ";",
    "\n",
    "\x00",
    "é",
    "2",
    "true",
]


@pytest.mark.parametrize("suffix", sorted(TEXTS))
def test_the_whole_file_is_read(tmp_path, suffix):
    path = tmp_path / f"lot.{suffix}"
    path.write_text(TEXTS[suffix])
    survey = read_survey(path)
    assert survey.stalls
    assert survey.unread == ()


@pytest.mark.parametrize("suffix", sorted(TEXTS))
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused(tmp_path, suffix, data):
    text = TEXTS[suffix]
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(text)))
        end = min(len(text), start + data.draw(st.integers(0, 12)))
        text = text[:start] + data.draw(st.sampled_from(PIECES)) + text[end:]
    path = tmp_path / f"lot.{suffix}"
    path.write_text(text, encoding="utf-8")
    try:
        survey = read_survey(path)
    except Garage2UsdError:
        return
    points = [point for stall in survey.stalls for point in stall.corners]
    points += [point for lane in survey.lanes for point in lane.points]
    assert all(math.isfinite(value) for point in points for value in point)


NUMBERS = ["0", "-1", "1e308", "-1e12", "1e-300", "1e7", "nan", "abc", "-0.0"]


@pytest.mark.parametrize("suffix", sorted(TEXTS))
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_file_with_other_numbers_is_read_or_refused(tmp_path, suffix, data):
    parts = re.split(r"(?<![\w.])(-?\d+(?:\.\d+)?)(?![\w.])", TEXTS[suffix])
    for index in data.draw(st.sets(st.integers(0, len(parts) // 2 - 1), min_size=1, max_size=3)):
        parts[2 * index + 1] = data.draw(st.sampled_from(NUMBERS))
    path = tmp_path / f"lot.{suffix}"
    path.write_text("".join(parts))
    try:
        survey = read_survey(path)
    except Garage2UsdError:
        return
    points = [point for stall in survey.stalls for point in stall.corners]
    points += [point for lane in survey.lanes for point in lane.points]
    assert all(math.isfinite(value) for point in points for value in point)
