"""Modules of the folder `benchmarks`, which is no package: they import each other by name."""

import importlib
import sys
from pathlib import Path

_FOLDER = Path(__file__).parents[2] / "benchmarks"


def benchmark(name):
    """A module by its name; no other module may take the place of one of its neighbours' names afterwards."""
    sys.path.append(str(_FOLDER))  # last, as some are called like packages that the tests use
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(_FOLDER))
