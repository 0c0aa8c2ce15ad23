"""What commands load before they begin: seconds that all users wait."""

import subprocess
import sys
from importlib import import_module

import pytest

SLOW = ("scipy", "bpy", "gymnasium")


@pytest.mark.parametrize(
    ("module", "slow"),
    [
        ("garage2usd.pipeline", SLOW),
        ("garage2usd.checks", SLOW),
        ("garage2usd.cli", (*SLOW, "numpy", "pydantic", "pxr")),
        ("garage2usd.datasets.cluster", (*SLOW, "matplotlib", "pyarrow", "pxr")),
        ("garage2usd.datasets.making", (*SLOW, "distributed", "matplotlib")),
    ],
)
def test_is_loaded_without(module, slow):
    code = f"import sys, {module}; print(*(name for name in {slow!r} if name in sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True, text=True)
    assert not done.stdout.split()


@pytest.mark.parametrize("package", ["garage2usd", "garage2usd.datasets"])
def test_each_public_name_that_is_loaded_on_first_use_is_there(package):
    module = import_module(package)
    assert [name for name in module.__all__ if not hasattr(module, name)] == []
