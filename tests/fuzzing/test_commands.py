"""Some hostile inputs into all commands; ``python tests/fuzzing/command_fuzz.py`` runs ten thousand."""

import subprocess
import sys
from pathlib import Path


def test_hostile_inputs_end_in_success_or_one_line_of_error_quickly_and_write_nothing_elsewhere():
    script = Path(__file__).with_name("command_fuzz.py")
    run = subprocess.run(
        [sys.executable, script, "--count", "96", "--seed", "7"], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout
    assert "96 inputs" in run.stdout
