"""The planted faults of ``mutations.py`` still fit the sources."""

from collections import Counter

import pytest
from support.unity import reader
from support.unity.mutants import MUTANTS


def test_names_are_unique():
    assert max(Counter(mutant.name for mutant in MUTANTS).values()) == 1


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.name)
def test_each_fits_one_place(mutant):
    assert (reader.PACKAGE / mutant.source).read_text().count(mutant.old) == 1
    assert mutant.new != mutant.old
