"""Types as on other systems, whose modules mypy reads by another branch; `make test` checks them for this one."""

import subprocess
import sys

import pytest
from support.sample_files import REPOSITORY


@pytest.mark.soak
@pytest.mark.parametrize("platform", ["win32", "darwin"])
def test_types_hold_on_other_systems(platform):
    command = [sys.executable, "-m", "mypy", "--platform", platform, "--cache-dir", f".mypy_cache/{platform}"]
    checked = subprocess.run(command, cwd=REPOSITORY, check=False, capture_output=True, text=True, timeout=600)
    assert checked.returncode == 0, checked.stdout
