"""Workers: tasks whose workers are lost, and tasks that lose every worker."""

import subprocess
import sys

import pytest

CRASH = """
import os
from garage2usd.datasets import cluster

def crash(task):
    os._exit(1) if task == "bad" else None
    return task

if __name__ == "__main__":
    cluster._TRIES = 2
    with cluster.workers(count=1) as pool:
        try:
            print(list(pool.each(crash, ["good", "bad"])))
        except cluster.DataSetError as error:
            print(error)
"""


@pytest.mark.soak
def test_a_task_that_crashes_every_worker_is_given_up(tmp_path):
    script = tmp_path / "crash.py"
    script.write_text(CRASH)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False, timeout=300)
    assert done.stdout == "crash: lost its workers 2 times over\n", done.stderr
