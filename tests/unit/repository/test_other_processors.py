"""The same garages on an older processor: this one without its vector units, of which libraries make other roundings.

NumPy, OpenBLAS and the C library choose code by the processor, and their sines, logarithms and products of matrices
differ in the last bits. `release/arm64.py` does the same with an emulated Arm.
"""

import os
import platform
import subprocess
import sys

import numpy as np
import pytest
from support.sample_files import REPOSITORY

GARAGES = ("uk_1",)
ROUNDINGS = """
import hashlib, math
import numpy as np
angles = np.linspace(-7, 7, 20_001)
print(hashlib.sha256(np.exp(angles).tobytes()).hexdigest())
print(hashlib.sha256(np.array([math.sin(one) for one in angles.tolist()]).tobytes()).hexdigest())
print(hashlib.sha256(np.linalg.inv(angles[:1600].reshape(-1, 4, 4) + np.eye(4)).tobytes()).hexdigest())
"""
WAYS = """
import hashlib
import numpy as np
from garage2usd.driving.car import Pose
from garage2usd.driving.path import Path
from garage2usd.driving.turns import Steering, joining_pieces
for yaw in np.linspace(-1.5, 1.5, 61).tolist():
    for pieces in joining_pieces(Pose(0.0, 0.0, 0.3), Pose(4.0, -19.0, yaw), Steering(0.2, 0.1)):
        way = Path(Pose(0.0, 0.0, 0.3), pieces)
        points = way.at(np.linspace(0.0, way.length_m, 200))
        told = np.stack([points.x_m, points.z_m, points.yaw_rad, points.curvature_per_m])
        print(len(pieces), hashlib.sha256(told.tobytes()).hexdigest())
"""


def older():
    """The environment in which libraries take the processor for one of 2008."""
    found = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    usable = ("AVX2", "FMA", "FMA4", "AVX", "AVX512F", "AVX2_Usable", "FMA_Usable")
    return os.environ | {
        "NPY_DISABLE_CPU_FEATURES": " ".join(found),
        "OPENBLAS_CORETYPE": "Nehalem",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{name}" for name in usable),
    }


def said(code_or_script, *arguments, environment):
    run = subprocess.run(
        [sys.executable, *code_or_script, *arguments],
        env=environment | {"PYTHONPATH": str(REPOSITORY)},
        cwd=REPOSITORY,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode in {0, 1}, run.stderr
    return run.stdout.splitlines()


pytestmark = pytest.mark.skipif(
    platform.machine() != "x86_64" or sys.platform != "linux", reason="only there libraries are told what to use"
)


def test_the_older_processor_rounds_otherwise():
    now, then = (said(("-c", ROUNDINGS), environment=dict(each)) for each in (os.environ, older()))
    assert len(now) == 3
    assert all(one != other for one, other in zip(now, then, strict=True)), "this processor is as the older one"


def test_smooth_paths_are_the_same_to_the_last_bit():
    now, then = (said(("-c", WAYS), environment=dict(each)) for each in (os.environ, older()))
    assert len(now) > 50
    assert now == then


@pytest.mark.soak
def test_garages_are_the_same(tmp_path):
    script = (str(REPOSITORY / "benchmarks/digests.py"), "--file", str(tmp_path / "digests.json"))
    written = said(script, "--write", *GARAGES, environment=dict(os.environ))
    assert len(written) == len(GARAGES)
    assert said(script, *GARAGES, environment=older()) == [f"{line.split()[0]}: same" for line in written]
