"""Wide tests and the rest: each test runs in one of the two, each wide one in one part; durations are noted."""

import json
import subprocess
import sys
import time
from collections import Counter
from types import SimpleNamespace

import pytest
from support import durations
from support.affected_tests import files_of_tests
from support.durations import outdated, processor_time_s, read_durations, soak_key, write_durations
from support.soak import PARTS, chosen, soak_but


def item(nodeid, *, wide):
    return SimpleNamespace(nodeid=nodeid, get_closest_marker=lambda name: name == "soak" or None if wide else None)


ITEMS = [
    *(item(f"tests/{k}.py::test_{case}", wide=True) for k in range(20) for case in "xy"),
    *(item(f"tests/{k}.py::narrow", wide=False) for k in range(5)),
]


def test_each_test_runs_in_one_of_the_two_and_each_wide_one_in_one_part():
    narrow, left = chosen(ITEMS, soak=False, part=None, durations={})
    assert [one.nodeid for one in narrow] == [f"tests/{k}.py::narrow" for k in range(5)]
    wide, rest = chosen(ITEMS, soak=True, part=None, durations={})
    assert (left, rest) == (wide, narrow)
    parts = [chosen(ITEMS, soak=True, part=part, durations={})[0] for part in range(PARTS)]
    assert Counter(one.nodeid for part in parts for one in part) == Counter(one.nodeid for one in wide)
    keys = [{soak_key(one.nodeid) for one in part} for part in parts]
    assert sum(map(len, keys)) == len(set().union(*keys))  # tests of a file share what its fixtures make


def test_parts_take_about_the_same_time():
    noted = {f"tests/{k}.py::soak": 10.0 + 7 * k for k in range(20)}
    parts = [chosen(ITEMS, soak=True, part=part, durations=noted)[0] for part in range(PARTS)]
    seconds = [sum(noted[key] for key in {soak_key(one.nodeid) for one in part}) for part in parts]
    assert max(seconds) < 1.3 * min(seconds)


def test_cases_but_the_kept_ones_are_wide():
    cases = soak_but(1, [("a", 1), ("b", 2)])
    assert cases[0] == ("a", 1)
    assert (cases[1].values, [mark.name for mark in cases[1].marks]) == (("b", 2), ["soak"])
    assert [getattr(case, "values", None) for case in soak_but(["b"], "abc")] == [("a",), None, ("c",)]
    with pytest.raises(ValueError, match="no case is"):
        soak_but(["d"], "abc")


def test_each_test_file_has_an_entry_and_each_entry_a_file():
    noted = {key.partition("::")[0] for key in read_durations()}
    assert noted == set(files_of_tests()), "run new files with --write-durations, and drop entries of old ones"


def test_processor_time_counts_programs_that_still_run():
    before_s = processor_time_s()
    with subprocess.Popen([sys.executable, "-c", "print(sum(range(10**7)), flush=True); input()"],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE) as program:  # fmt: skip
        program.stdout.readline()
        running_s = processor_time_s() - before_s
        program.communicate(b"\n")
    ended_s = processor_time_s() - before_s
    assert 0.05 < running_s <= ended_s + 0.02
    time.sleep(0.3)
    assert processor_time_s() - before_s < ended_s + 0.2  # sleep is free


def report(nodeid, seconds):
    return SimpleNamespace(nodeid=nodeid, when="teardown", user_properties=[("processor_time_s", seconds)])


def test_durations_are_noted_by_file_and_by_its_wide_tests(tmp_path, monkeypatch):
    monkeypatch.setattr(durations, "FILE", tmp_path / "durations.json")
    durations.FILE.write_text('{"tests/b.py": 1.0}')
    write_durations([report("tests/a.py::one[x]", 1.0), report("tests/a.py::two", 2.5)], soak=False)
    write_durations([report("tests/a.py::wide[x]", 20.0), report("tests/a.py::wide[y]", 5.0)], soak=True)
    assert json.loads(durations.FILE.read_text()) == {"tests/a.py": 3.5, "tests/a.py::soak": 25.0, "tests/b.py": 1.0}


def test_entries_that_are_off_by_more_than_half_are_told_even_on_a_slower_machine(tmp_path, monkeypatch):
    monkeypatch.setattr(durations, "FILE", tmp_path / "durations.json")
    durations.FILE.write_text(json.dumps({f"tests/{name}.py": 10.0 for name in "abcd"}))
    took = {"a": 20.0, "b": 21.0, "c": 8.0, "d": 19.0, "e": 60.0, "short": 0.1}
    off = outdated([report(f"tests/{name}.py::one", seconds) for name, seconds in took.items()], soak=False)
    assert off == [("tests/c.py", 10.0, 8.0), ("tests/e.py", None, 60.0)]
