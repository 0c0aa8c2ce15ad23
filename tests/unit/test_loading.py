"""What commands load before they begin: seconds that all users wait."""

import subprocess
import sys

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
