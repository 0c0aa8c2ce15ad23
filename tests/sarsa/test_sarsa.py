"""The compiled Sarsa follows the decision process action for action, and faults in it are found."""

import os
import subprocess
import sys
from collections import Counter

import pytest
from hypothesis import Phase
from support.sample_files import REPOSITORY
from support.sarsa.following import check_states, following
from support.sarsa.mutants import MUTANTS

from garage2usd.native import LIBRARY

test_learn_follows_the_decision_process = following(examples=200, phases=tuple(Phase))


def test_the_table_tells_states_apart_as_the_decision_process_does():
    check_states()


def test_names_of_faults_are_unique():
    assert max(Counter(mutant.name for mutant in MUTANTS).values()) == 1


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.name)
def test_each_fault_fits_one_place(mutant):
    assert (LIBRARY.parent / f"{mutant.file}.c").read_text().count(mutant.old) == 1
    assert mutant.new != mutant.old


@pytest.mark.soak
def test_every_fault_is_found():
    command = [sys.executable, "-m", "support.sarsa.mutations"]
    environment = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    run = subprocess.run(
        command, env=environment, cwd=REPOSITORY / "tests", capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.endswith(f"{len(MUTANTS)} of {len(MUTANTS)} caught\n")
