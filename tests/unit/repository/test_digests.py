"""Garages are what they were when ``benchmarks/digests.json`` was written, in every format, byte by byte.

These are a few of them; ``make digests`` compares all.
"""

import importlib.util
import json

import pytest
from support.sample_files import REPOSITORY
from support.soak import soak_but

SPEC = importlib.util.spec_from_file_location("digests", REPOSITORY / "benchmarks/digests.py")
digests = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(digests)

STORED = json.loads(digests.STORED.read_text())
SETTINGS = dict(digests.configurations())


def test_each_garage_has_digests_and_no_other_has():
    assert set(STORED) == set(SETTINGS)


@pytest.mark.parametrize("name", soak_but(["given_small", "import_rows"], ["given_small", *digests.QUICK]))
def test_a_garage_is_what_it_was(name):
    """A change that is meant is written by ``make digests WRITE=1``, and the commit says what changed and why."""
    found = digests.digests_of(SETTINGS[name])
    stored = STORED[name]
    keys = {*found, *stored} - digests.OF_MACHINE
    assert sorted(key for key in keys if found.get(key) != stored.get(key)) == []
