"""Planning and driving under the sanitizers of addresses and of undefined behaviour."""

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support.hatch_building import compile_loops
from support.sample_files import REPOSITORY

from garage2usd.native import LIBRARY

SANITIZED = ("-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
CHECKED = (*SANITIZED, "-UNDEBUG")
"""With the bounds of arrays, which `AT` and `IN` check."""


@pytest.fixture(scope="module")
def runtimes(tmp_path_factory):
    """What is preloaded; skips, which is a failure in CI, where the compiler has no sanitizers."""
    compiler = shlex.split(os.environ.get("CC", "cc"))
    found = []
    for name in ("libasan.so", "libubsan.so"):
        try:
            run = subprocess.run([*compiler, f"-print-file-name={name}"], capture_output=True, text=True, check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            pytest.skip(f"{compiler[0]} names no {name}: {error}")
        if not Path(run.stdout.strip()).is_absolute():
            pytest.skip(f"{compiler[0]} has no {name}")
        found.append(run.stdout.strip())
    return " ".join(found)


def run_of(folder, runtimes, fault=None, flags=CHECKED):
    for path in LIBRARY.parent.iterdir():
        if path.suffix in {".c", ".h"}:
            shutil.copy(path, folder)
    if fault:
        name, old, new = fault
        text = (folder / name).read_text()
        assert text.count(old) == 1
        (folder / name).write_text(text.replace(old, new))
    compile_loops(folder / LIBRARY.name, folder, flags)
    environment = os.environ | {"LD_PRELOAD": runtimes, "ASAN_OPTIONS": "detect_leaks=0", "PYTHONPATH": str(REPOSITORY)}
    command = [sys.executable, "-m", "support.sanitized_loops", str(folder / LIBRARY.name)]
    return subprocess.run(
        command, env=environment, cwd=REPOSITORY / "tests", capture_output=True, text=True, check=False
    )


@pytest.mark.soak
def test_planning_and_driving_are_clean(tmp_path, runtimes):
    run = run_of(tmp_path, runtimes)
    assert (run.returncode, run.stdout) == (0, "clean\n"), run.stderr


@pytest.mark.soak
def test_a_write_past_an_array_is_found(tmp_path, runtimes):
    old = "q < ground->cells.count; q++) {\n        AT(board->cells, q)"
    run = run_of(tmp_path, runtimes, ("board.c", old, old.replace("q < ", "q <= ")), SANITIZED)
    assert run.returncode != 0
    assert "AddressSanitizer: heap-buffer-overflow" in run.stderr


READ_PAST_A_ROW = "board.c", "square, AT(edges, square))", "square, 16 + AT(edges, square))"
"""Takes the stalls of the square beside, which the sanitizers find nothing wrong with."""


@pytest.mark.soak
def test_a_read_past_a_row_is_found_by_its_bounds(tmp_path, runtimes):
    run = run_of(tmp_path, runtimes, READ_PAST_A_ROW)
    assert run.returncode != 0
    assert "of columns of ground->capacity, which has 16" in run.stderr
