"""Compiled functions have one form each, as each further one is compiled anew on a user's first build."""

import json
import os
import subprocess
import sys
from pathlib import Path

import support


def test_each_compiled_function_has_one_form(tmp_path):
    done = subprocess.run(
        [sys.executable, Path(support.__file__).with_name("signatures.py")],
        env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
        stdout=subprocess.PIPE,
        check=True,
    )
    found = json.loads(done.stdout)
    assert found["compiled"] > 60
    # one for each type of number that rows hold
    assert len(found["several"].pop("garage2usd.compiled.copy_row")) <= 4
    assert not found["several"]
