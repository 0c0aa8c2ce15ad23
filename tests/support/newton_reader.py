"""Newton, a physics engine, in a process that takes stage after stage, as it needs two seconds to start."""

import contextlib
import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

needs_newton = pytest.mark.skipif(
    any(importlib.util.find_spec(name) is None for name in ("newton", "newton_usd_schemas")),
    reason="newton is not installed",
)
_SCRIPT = Path(__file__).parents[1] / "clients" / "newton_dump.py"


@contextlib.contextmanager
def running_newton():
    """What gives newton's version, number of bodies and colliders of a stage, each with kind, place and size."""
    with (
        tempfile.TemporaryFile("w+") as said,
        subprocess.Popen(
            [sys.executable, str(_SCRIPT)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said, text=True
        ) as process,
    ):

        def load(stage):
            print(stage, file=process.stdin, flush=True)
            answer = process.stdout.readline()
            if not answer:
                process.wait()
                said.seek(0)
                raise AssertionError(f"newton died of {stage}: {said.read()}")
            return json.loads(answer)

        yield load
        process.stdin.close()
