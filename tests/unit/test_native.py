"""Python and C agree about what they hand to each other, which nothing else would notice but a crash."""

import numpy as np
import pytest
from support.c_declarations import c_functions, c_structs, python_functions, same_type

from garage2usd.native import load


def test_python_declares_each_function_as_c_has_it():
    in_python, of_c, structs = python_functions(), c_functions(), c_structs()
    assert in_python.keys() == of_c.keys()
    assert len(of_c) > 10
    for name, hints in in_python.items():
        *takes, returns = hints.values()
        assert same_type(returns, of_c[name].returns, structs), name
        assert len(takes) == len(of_c[name].takes), name
        for (argument, hint), c_type in zip(hints.items(), of_c[name].takes, strict=False):
            assert same_type(hint, c_type, structs), f"{name}: {argument} is {hint} in Python, {c_type} in C"


def test_arrays_of_other_numbers_or_with_gaps_are_refused():
    from garage2usd.planning.archive import next_random

    for array in (np.zeros(1, np.int64), np.zeros((2, 2), np.uint64).T):
        with pytest.raises(TypeError, match="uint64"):
            next_random(array)


def test_a_missing_library_says_what_to_do(tmp_path):
    with pytest.raises(RuntimeError, match="install garage2usd"):
        load(tmp_path / "loops.so")
