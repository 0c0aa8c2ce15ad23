"""Some hostile inputs into all commands; ``python -m support.fuzzing.command_fuzz`` in ``tests`` runs ten thousand."""

import subprocess
import sys

import pytest
from support.sample_files import REPOSITORY
from support.soak import soak_but


@pytest.mark.parametrize("count", soak_but(1, [24, 300]))
def test_hostile_inputs_end_in_success_or_one_line_of_error_quickly_and_write_nothing_elsewhere(count):
    command = [sys.executable, "-m", "support.fuzzing.command_fuzz", "--count", str(count), "--seed", "7"]
    run = subprocess.run(command, cwd=REPOSITORY / "tests", capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout
    assert f"{count} inputs" in run.stdout
